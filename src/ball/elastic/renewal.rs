//! One Newton step of a ball's place and motion together.

use super::contact::{Pressed, Reach, add, within};
use super::equations::{Axial, Motion, Shared, Step, solved};
use super::grooves::{ElasticGroove, ElasticGrooves};
use crate::math::{self, inverse_cube_roots};

/// Largest change of the motion in a step: sum over its parts, over the nut's speed.
const LARGEST_TURN: f32 = 1.4;

/// Largest change of a place in a step over the deflection of a contact under the ball's load.
const LARGEST_SHIFT: f32 = 1.0;

/// Part of a step below which the place is left out of the motion's equations: far from balance the coupled step may lead
/// away from it, that of the motion alone never does, because its power is convex.
const LEAST_TAKEN: f32 = 0.1;

/// Load over the axial load below which a contact does not limit steps.
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

/// What a ball is under.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct BallInputs {
    /// Axial force of the screw on the ball, N; not 0. Positive carried by SL and NR, negative by SR and NL.
    pub axial_load: f32,
    /// Force of the neighbours along the track, N.
    pub force: f32,
    /// Largest friction forces that both neighbours put on the ball across the track, N: their sum, and that of the ball in
    /// front less that of the ball behind.
    pub rubbing: [f32; 2],
    /// How far the arcs of the screw's and the nut's groove are turned, rad.
    pub screw_deviation: f32,
    /// The nut's.
    pub nut_deviation: f32,
    /// Friction coefficient.
    pub friction: f32,
    /// Radial gap of every contact at the centred ball, m.
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
    /// Part of the step that was taken.
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

    /// One Newton step of the seven equations of a ball.
    ///
    /// A ball that has lost both contacts of a groove, or whose numbers are not finite, stays as it is: see
    /// `lost`.
    #[inline(never)]
    pub fn renew(&self, state: &mut Settled, inputs: &BallInputs) -> Renewal {
        let clearance = inputs.clearance * self.per_radius;
        let [x, screw_z, nut_z] = state.place;
        let motion = state.motion();
        let mut all = Contacts::NONE;
        self.press(&mut all, state.place, &motion, inputs);
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

    /// Adds the contacts that carry to the equations of a ball.
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
