//! One Newton step of a ball's place and motion together.

use super::contact::{Pressed, Reach, add, within};
use super::equations::{Axial, Motion, Shared, Step, solved};
use super::grooves::{ElasticGroove, ElasticGrooves};
use crate::math::{self, inverse_cube_roots};

/// Largest change of the motion in a step: sum of the sizes of its four parts, over the nut's speed.
///
/// A bound for motions far from all balance. From 0.7 on balls settle alike, in 5.2 to 5.8 renewals in the mean; at 0.35
/// they take 7.4. Of 3000 balls with play 100, 148 and 199 never rest at 0.7, 1.4 and 2.8. Without the bound, or at 0.35,
/// one of 24 rings with preload stays in a limit cycle.
const LARGEST_TURN: f32 = 1.4;

/// Largest change of a place in a step, over the deflection of a contact under all of the ball's load and what an oversized
/// ball gives way without.
///
/// A longer step may leave the groove: without a bound 208 of 3000 light balls (up to 5 N) lose their contacts when the
/// grooves turn, 180 to 184 with bounds from 0.5 to 4. Shorter ones keep balls with play from their place within fifty
/// renewals: 360 of 3000 at 0.25, 159 at 0.5, 148 at 1, 122 at 2, 113 at 4. Other balls settle alike from 0.25 to 4.
/// More than 1 gains little, and in a ring without play whose load swings by a factor 2.8 a round torques that are not flagged
/// are off by up to 0.76 of the true one at 2 and five times it at 4; at 1 all of them are flagged.
const LARGEST_SHIFT: f32 = 1.0;

/// Part of a step below which the place is left out of the motion's equations: far from balance the coupled step may lead
/// away from it, that of the motion alone never does, because its power is convex.
///
/// Always coupled, 26 of 3000 balls as promised, 189 heavy ones (to 3 kN) and 304 with play never rest. At 0.05 these are 2,
/// 6, 237; at 0.1 0, 6, 148; at 0.2 1, 8, 106; at 0.4 5, 22, 145.
const LEAST_TAKEN: f32 = 0.1;

/// Load of a contact over the axial load of the ball below which it does not limit steps.
///
/// Hardly felt by the ball, such a contact would cut steps short: balls settle in 5.5, 5.3, 5.1 and 4.9 renewals in the mean
/// at 0, 0.02, 0.04 and 0.1. Up to 0.04 none of 3000 as promised is without rest, and 47 or 48 light ones; at 0.1 these are
/// 2 and 89, and one of 24 rings with preload stays in a limit cycle.
const LIGHT: f32 = 0.02;

/// Place and motion of a ball; lengths over the ball radius, speeds over the nut's.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Settled {
    /// Radially outward; axially in the screw's groove and in the nut's.
    pub(super) place: [f32; 3],
    /// Angular velocity about the radial axis, the track, and the axis across both.
    pub(super) turning: [f32; 3],
    /// Speed along the track.
    pub(super) speed: f32,
}

/// What a ball is under. Nothing is checked; numbers beyond the ranges give a [lost](field@Renewal::lost) ball or one that
/// does not settle.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct BallInputs {
    /// Axial force of the screw on the ball, N: size 1e-3 to 1e7. Positive carried by SL and NR, negative by SR and NL.
    pub axial_load: f32,
    /// Force of the neighbours along the track, N: positive pushes the ball in the direction in which the nut turns. A ball has
    /// a balance up to about `2 mu F`, with the friction coefficient `mu` and the force `F` of a main contact.
    pub force: f32,
    /// Largest friction forces that both neighbours put on the ball across the track, N: their sum, 0 or more, and that of the
    /// ball in front less that of the ball behind, no larger than the sum.
    pub rubbing: [f32; 2],
    /// How far the screw's contact angles deviate from the nominal one, rad: SR by this much, SL by its opposite; up to 0.2.
    pub screw_deviation: f32,
    /// How far the nut's do, rad: NR by this much, NL by its opposite; up to 0.2.
    pub nut_deviation: f32,
    /// Friction coefficient of ball and grooves: 1e-6 to 0.5.
    pub friction: f32,
    /// Radial gap of every contact at the centred ball, m: play above 0, oversize below; -0.02 to 0.05 of the ball radius
    /// ([`Clearance`](crate::Clearance)).
    pub clearance: f32,
}

impl BallInputs {
    /// A ball without deviations and neighbours under an axial load, N, with a friction coefficient and a clearance, m.
    #[inline(always)]
    pub(super) const fn alone(axial_load: f32, friction: f32, clearance: f32) -> Self {
        Self {
            axial_load,
            force: 0.0,
            rubbing: [0.0; 2],
            screw_deviation: 0.0,
            nut_deviation: 0.0,
            friction,
            clearance,
        }
    }
}

/// What a renewal finds.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Renewal {
    /// Speed along the track, m per unit of nut speed.
    pub speed: f32,
    /// Change of the true speed with the force along the track, m/N per unit of the size of the nut's speed.
    pub compliance: f32,
    /// Power lost in the contacts, N m: the ball's friction torque on the nut.
    pub torque: f32,
    /// Axial force that the contacts carry, N.
    pub carried: f32,
    /// Loads of SL, SR, NL, NR before the step, N.
    pub loads: [f32; 4],
    /// Part of the Newton step that was taken, 0 to 1; below 1 the ball is far from its balance.
    pub taken: f32,
    /// Both contacts of a groove are open, or a number is not finite: the ball stays as it was, and compliance, torque and
    /// carried force are zero. It needs [`ElasticGrooves::start`].
    pub lost: bool,
}

impl Renewal {
    /// Whether both light contacts are open: then one groove sticks, and the speed hangs on a friction that is not known
    /// as well as elsewhere.
    #[inline]
    #[must_use]
    pub fn two_point(&self) -> bool {
        self.loads.iter().filter(|load| **load > 0.0).count() < 3
    }

    const fn lost(speed: f32, loads: [f32; 4]) -> Self {
        Self {
            speed,
            compliance: 0.0,
            torque: 0.0,
            carried: 0.0,
            loads,
            taken: 0.0,
            lost: true,
        }
    }
}

/// What the contacts of a ball put on it.
struct Contacts {
    shared: Shared,
    /// Derivative of the power by the motion in the screw's groove alone, N.
    on_screw: Motion,
    screw: Axial,
    nut: Axial,
    /// Those of SL, SR, NL, NR.
    reaches: [Reach; 4],
}

impl Contacts {
    const NONE: Self = Self {
        shared: Shared::NONE,
        on_screw: Shared::NONE.forces,
        screw: Axial::NONE,
        nut: Axial::NONE,
        reaches: [Reach::NONE; 4],
    };
}

impl Settled {
    #[inline(always)]
    const fn motion(&self) -> Motion {
        let [x, y, z] = self.turning;
        Motion {
            speed: self.speed,
            x,
            y,
            z,
        }
    }
}

impl ElasticGrooves {
    /// Arc centres of a groove's left and right side from its middle, over the ball radius; `side` is 1 of the screw and
    /// -1 of the nut.
    #[inline(always)]
    pub(super) fn arcs(
        &self,
        groove: &ElasticGroove,
        side: f32,
        deviation: f32,
    ) -> [(f32, f32); 2] {
        // Cosine and sine of the deviation, to 0.2 rad.
        let square = deviation * deviation;
        let cos = groove.centre * (1.0 - square * (0.5 - (1.0 / 24.0) * square));
        let sin =
            groove.centre * (deviation * (1.0 - square * ((1.0 / 6.0) - (1.0 / 120.0) * square)));
        let (cc, ss) = (self.cos * cos, self.sin * sin);
        let (sc, cs) = (self.sin * cos, self.cos * sin);
        // Left: the contact angle less the deviation; right: with it.
        [(side * (cc + ss), sc - cs), (side * (cc - ss), -(sc + cs))]
    }

    /// One Newton step of the seven equations of a ball (head of [`elastic`](crate::ball::elastic)), in the frame in which the
    /// nut turns forward.
    ///
    /// ```text
    /// x := x - t J^-1 r(x)        0 < t <= 1
    /// ```
    ///
    /// with the unknowns `x`, lengths over the ball radius and velocities over the nut's; what is unbalanced `r`, N; its
    /// derivatives `J`, without how friction changes when a contact's normal turns; and the part `t` of the step that keeps
    /// every contact near the slip and the load it has. Where `t` falls below a tenth, motion and place step apart.
    ///
    /// A ball that has lost both contacts of a groove, or whose numbers are not finite, stays as it is: see
    /// [`lost`](field@Renewal::lost).
    ///
    /// Errors once settled, and cost: [`SCREW_RENEWAL`](crate::promises::SCREW_RENEWAL); compliance within 2.4 %, 0.4 % rms.
    /// From [`ElasticGrooves::start`] on the torque of such balls stays within 1e-3 after 5 renewals in the mean, 24 for 99
    /// %; with play after 19, and one in twenty stays in a limit cycle of balls in two contacts.
    ///
    /// Source: Lin 2019, (2.11)-(2.14), (3.65)-(3.69), (3.75); step lengths are this crate's own.
    #[inline(never)]
    pub fn renew(&self, state: &mut Settled, inputs: &BallInputs) -> Renewal {
        let clearance = inputs.clearance * self.per_radius;
        let [x, screw_z, nut_z] = state.place;
        let motion = state.motion();
        let mut all = Contacts::NONE;
        self.press(&mut all, state.place, &motion, inputs);
        // Here and below `a`, `b`, `c`, `d` are the contacts SL, SR, NL, NR.
        let Contacts {
            shared,
            on_screw,
            screw,
            nut,
            reaches: [a, b, c, d],
        } = &mut all;
        let loads = [a.load, b.load, c.load, d.load];
        // Friction along the track carries a part of the axial load.
        let along = -on_screw.speed;
        let needed = (inputs.axial_load - self.sin_lead * along) * self.per_cos_lead;
        let total = shared.forces;
        let on_ball = self.rub(&motion, inputs.rubbing, shared);
        let [radial, across] = on_ball;
        shared.radial += radial;
        let unbalanced = [screw.force - needed, nut.force + needed + across];
        let mut step = solved(shared, screw, nut, unbalanced, inputs.force);
        let reaches = [&*a, b, c, d];
        let mut taken = self.limited(&step, reaches, inputs.axial_load, clearance);
        if taken < LEAST_TAKEN || step.compliance <= 0.0 {
            shared.uncouple(screw, nut);
            step = solved(shared, screw, nut, unbalanced, inputs.force);
            taken = self.limited(&step, reaches, inputs.axial_load, clearance);
        }
        let moved = motion.plus(&step.motion, -taken);
        // Power lost is the ball's forces times its motion, less those in the nut times the nut's.
        let power = moved.dot(&total) - self.nut.base.dot(&total.plus(on_screw, -1.0));
        let lost = !(taken * step.compliance < f32::MAX && power.abs() < f32::MAX);
        if lost {
            return Renewal::lost(state.speed * self.ball_radius, loads);
        }
        state.place = [
            x - taken * step.radial,
            screw_z - taken * step.screw,
            nut_z - taken * step.nut,
        ];
        state.turning = [moved.x, moved.y, moved.z];
        state.speed = moved.speed;
        Renewal {
            speed: moved.speed * self.ball_radius,
            compliance: self.ball_radius * step.compliance,
            torque: power * self.ball_radius,
            carried: self.cos_lead * screw.force + self.sin_lead * along,
            loads,
            taken,
            lost,
        }
    }

    /// Adds the contacts that carry to the equations of a ball; `a`, `b`, `c`, `d` are SL, SR, NL, NR.
    #[inline(always)]
    fn press(
        &self,
        all: &mut Contacts,
        [x, screw_z, nut_z]: [f32; 3],
        motion: &Motion,
        inputs: &BallInputs,
    ) {
        let clearance = inputs.clearance * self.per_radius;
        let friction = inputs.friction;
        let Contacts {
            shared,
            on_screw,
            screw,
            nut,
            reaches: [a, b, c, d],
        } = all;
        let groove = &self.screw;
        let [left, right] = self.arcs(groove, 1.0, inputs.screw_deviation);
        if let Some(pressed) = Pressed::at(groove, (x, screw_z), left, clearance) {
            add(groove, pressed, motion, friction, screw, shared, a);
        }
        if let Some(pressed) = Pressed::at(groove, (x, screw_z), right, clearance) {
            add(groove, pressed, motion, friction, screw, shared, b);
        }
        *on_screw = shared.forces;
        let groove = &self.nut;
        let relative = motion.plus(&groove.base, -1.0);
        let [left, right] = self.arcs(groove, -1.0, inputs.nut_deviation);
        if let Some(pressed) = Pressed::at(groove, (x, nut_z), left, clearance) {
            add(groove, pressed, &relative, friction, nut, shared, c);
        }
        if let Some(pressed) = Pressed::at(groove, (x, nut_z), right, clearance) {
            add(groove, pressed, &relative, friction, nut, shared, d);
        }
    }

    /// Adds the friction of both neighbours, which are taken to turn as the ball does: moments against its turning, and what
    /// this brings along the track. Gives the force on the ball, radial and axial.
    ///
    /// Lin 2019, eqs. (3.73)-(3.75), with `cos(beta_BB)` as 1. Left out are the moment about the track, how both balls differ in their
    /// turning about it, and the outward part of the force between balls.
    #[inline(always)]
    fn rub(&self, motion: &Motion, [sum, difference]: [f32; 2], shared: &mut Shared) -> [f32; 2] {
        let (x, z) = (motion.x, motion.z - self.orbit * motion.speed);
        let inverse = 1.0 / (math::sqrt(x * x + z * z) + 1e-6);
        let (ux, uz) = (x * inverse, z * inverse);
        let against = Motion {
            speed: -uz * self.orbit,
            x: ux,
            y: 0.0,
            z: uz,
        };
        shared.forces = shared.forces.plus(&against, sum);
        let stiffness = 0.5 * sum * inverse;
        shared.hessian.xx += stiffness * uz * uz;
        shared.hessian.xz -= stiffness * ux * uz;
        shared.hessian.zz += stiffness * ux * ux;
        [difference * uz, -difference * ux]
    }

    /// Part of a step that is taken.
    #[inline(always)]
    fn limited(&self, step: &Step, reaches: [&Reach; 4], axial_load: f32, clearance: f32) -> f32 {
        let Motion { speed, x, y, z } = step.motion;
        let sum = x.abs() + y.abs() + z.abs() + speed.abs();
        let shift = larger(step.radial.abs(), larger(step.screw.abs(), step.nut.abs()));
        // Contacts of an oversized ball give way without a load too.
        let reach = LARGEST_SHIFT * (self.deflection(axial_load) + larger(-clearance, 0.0));
        let light = LIGHT * axial_load.abs();
        let [a, b, c, d] = reaches;
        let allows = |reach: &Reach| reach.load <= light || reach.allows(&step.motion);
        if sum <= LARGEST_TURN && shift <= reach && allows(a) && allows(b) && allows(c) && allows(d)
        {
            1.0
        } else {
            let taken = within(within(1.0, sum, LARGEST_TURN), shift, reach);
            shortened(&step.motion, reaches, light, taken)
        }
    }

    /// Deflection of a screw contact under all of a ball's load, over the ball radius.
    #[inline(always)]
    pub(super) fn deflection(&self, axial_load: f32) -> f32 {
        let normal = axial_load.abs() * self.per_axial_load;
        let [inverse, _] = inverse_cube_roots([normal, 1.0]);
        normal * inverse * self.screw.per_stiffness
    }
}

/// Part of a step that all contacts allow, at most `taken`.
#[cold]
#[inline(never)]
fn shortened(step: &Motion, reaches: [&Reach; 4], light: f32, taken: f32) -> f32 {
    let mut taken = taken;
    for reach in reaches {
        if reach.load > light {
            taken = reach.allowed(step, taken);
        }
    }
    taken
}

#[inline(always)]
const fn larger(first: f32, second: f32) -> f32 {
    if first > second { first } else { second }
}
