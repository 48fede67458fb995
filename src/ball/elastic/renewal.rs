//! One Newton step of a ball's place and motion together.

use super::contact::{Motion, Touch};
use super::groove::{Axial, Conditions, Follows, Shared};
use super::grooves::{ElasticGroove, ElasticGrooves};

/// Largest change of the motion in a step: sum over its parts, over the nut's speed.
const LARGEST_TURN: f32 = 0.3;

/// Largest change of a place in a step over the deflection of a contact under the ball's load.
const LARGEST_SHIFT: f32 = 1.0;

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
    /// How far the arcs of the screw's and the nut's groove are turned, rad.
    pub screw_deviation: f32,
    /// The nut's.
    pub nut_deviation: f32,
    /// Friction coefficient.
    pub friction: f32,
    /// Radial gap of every contact at the centred ball, m.
    pub clearance: f32,
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
}

impl ElasticGrooves {
    /// Contacts of both grooves at a place.
    #[inline(always)]
    pub(super) fn touches(
        &self,
        groove: &ElasticGroove,
        side: f32,
        (x, z): (f32, f32),
        deviation: f32,
        clearance: f32,
    ) -> [Option<Touch>; 2] {
        // Cosine and sine of the deviation, to 0.2 rad.
        let square = deviation * deviation;
        let cos = 1.0 - square * (0.5 - (1.0 / 24.0) * square);
        let sin = deviation * (1.0 - square * ((1.0 / 6.0) - (1.0 / 120.0) * square));
        let centre = side * groove.centre;
        let (cc, ss) = (self.cos * cos, self.sin * sin);
        let (sc, cs) = (self.sin * cos, self.cos * sin);
        // Left: the contact angle less the deviation; right: with it.
        [
            Touch::at(
                groove,
                (x, z),
                (centre * (cc + ss), groove.centre * (sc - cs)),
                clearance,
            ),
            Touch::at(
                groove,
                (x, z),
                (centre * (cc - ss), -groove.centre * (sc + cs)),
                clearance,
            ),
        ]
    }

    /// One Newton step of the seven equations of a ball.
    pub fn renew(&self, state: &mut Settled, inputs: &BallInputs) -> Renewal {
        let conditions = Conditions {
            friction: inputs.friction,
            clearance: inputs.clearance / self.ball_radius,
        };
        let [x, screw_z, nut_z] = state.place;
        let [turn_x, turn_y, turn_z] = state.turning;
        let motion = Motion {
            speed: state.speed,
            x: turn_x,
            y: turn_y,
            z: turn_z,
        };
        let mut shared = Shared::NONE;
        let touches = self.touches(
            &self.screw,
            1.0,
            (x, screw_z),
            inputs.screw_deviation,
            conditions.clearance,
        );
        let screw = Axial::of(&self.screw, &touches, &motion, &conditions, &mut shared);
        let touches = self.touches(
            &self.nut,
            -1.0,
            (x, nut_z),
            inputs.nut_deviation,
            conditions.clearance,
        );
        let nut = Axial::of(&self.nut, &touches, &motion, &conditions, &mut shared);
        shared.forces[3] -= inputs.force;
        let needed = (inputs.axial_load - self.sin_lead * screw.along) / self.cos_lead;
        let carried = self.cos_lead * screw.force + self.sin_lead * screw.along;
        let raw = shared.forces;
        let power = shared.power;
        let on_screw = screw.eliminated(needed, &mut shared);
        let in_nut = nut.eliminated(-needed, &mut shared);
        let (dx, turn, pivot) = solved(&mut shared);
        let ds = following(&on_screw, dx, &turn);
        let dn = following(&in_nut, dx, &turn);
        let [wx, wy, wz, dv] = turn;

        let reach = {
            let load = inputs.axial_load.abs() / (self.sin * self.cos_lead);
            let root = crate::math::cbrt(load);
            LARGEST_SHIFT * root * root / self.screw.stiffness
        };
        let sum = wx.abs() + wy.abs() + wz.abs() + dv.abs();
        let shift = larger(dx.abs(), larger(ds.abs(), dn.abs()));
        let mut taken = 1.0;
        if sum > LARGEST_TURN {
            taken = LARGEST_TURN / sum;
        }
        if shift * taken > reach {
            taken = reach / shift;
        }
        state.place = [x - taken * dx, screw_z - taken * ds, nut_z - taken * dn];
        state.turning = [
            turn_x - taken * wx,
            turn_y - taken * wy,
            turn_z - taken * wz,
        ];
        state.speed = motion.speed - taken * dv;
        let [rx, ry, rz, rv] = raw;
        let change = rx * wx + ry * wy + rz * wz + (rv + inputs.force) * dv;
        let [left, right] = screw.loads;
        let [far_left, far_right] = nut.loads;
        Renewal {
            speed: state.speed * self.ball_radius,
            compliance: self.ball_radius / pivot,
            torque: (power - taken * change) * self.ball_radius,
            carried,
            loads: [left, right, far_left, far_right],
            taken,
        }
    }
}

#[inline(always)]
fn following(follows: &Follows, dx: f32, turn: &[f32; 4]) -> f32 {
    let mut step = follows.right - follows.place * dx;
    for (by, part) in follows.motion.iter().zip(turn) {
        step -= by * part;
    }
    step
}

/// The radial step, the steps of the motion (x, y, z, speed), and the stiffness of the speed against a force along the track.
#[inline(always)]
fn solved(shared: &mut Shared) -> (f32, [f32; 4], f32) {
    let inverse = 1.0 / shared.by_place;
    let right = inverse * shared.radial;
    let by = shared.by_motion.map(|by| inverse * by);
    for ((force, row), by_place) in shared
        .forces
        .iter_mut()
        .zip(&mut shared.forces_by_motion)
        .zip(shared.forces_by_place)
    {
        *force -= by_place * right;
        for (entry, by) in row.iter_mut().zip(by) {
            *entry -= by_place * by;
        }
    }
    let [mut r0, mut r1, mut r2, mut r3] = shared.forces;
    let [a, b, c, d] = shared.forces_by_motion;
    let [a0, a1, a2, a3] = a;
    let i0 = 1.0 / a0;
    let (a1, a2, a3) = (a1 * i0, a2 * i0, a3 * i0);
    r0 *= i0;
    let [b0, b1, b2, b3] = b;
    let (b1, b2, b3) = (b1 - b0 * a1, b2 - b0 * a2, b3 - b0 * a3);
    r1 -= b0 * r0;
    let i1 = 1.0 / b1;
    let (b2, b3) = (b2 * i1, b3 * i1);
    r1 *= i1;
    let [c0, c1, c2, c3] = c;
    let (c1, c2, c3) = (c1 - c0 * a1, c2 - c0 * a2, c3 - c0 * a3);
    r2 -= c0 * r0;
    let (c2, c3) = (c2 - c1 * b2, c3 - c1 * b3);
    r2 -= c1 * r1;
    let i2 = 1.0 / c2;
    let c3 = c3 * i2;
    r2 *= i2;
    let [d0, d1, d2, d3] = d;
    let (d1, d2, d3) = (d1 - d0 * a1, d2 - d0 * a2, d3 - d0 * a3);
    r3 -= d0 * r0;
    let (d2, d3) = (d2 - d1 * b2, d3 - d1 * b3);
    r3 -= d1 * r1;
    let d3 = d3 - d2 * c3;
    r3 -= d2 * r2;
    let speed = r3 / d3;
    let z = r2 - c3 * speed;
    let y = r1 - b2 * z - b3 * speed;
    let x = r0 - a1 * y - a2 * z - a3 * speed;
    let turn = [x, y, z, speed];
    let mut dx = right;
    for (by, part) in by.iter().zip(turn) {
        dx -= by * part;
    }
    (dx, turn, d3)
}

#[inline(always)]
const fn larger(first: f32, second: f32) -> f32 {
    if first > second { first } else { second }
}
