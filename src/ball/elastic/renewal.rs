//! One Newton step of a ball's place and motion together.

use super::contact::Touch;
use super::equations::{Axial, Motion, Shared, Step, solved};
use super::grooves::{ElasticGroove, ElasticGrooves};
use crate::math::inverse_cube_roots;

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
    #[inline]
    pub fn renew(&self, state: &mut Settled, inputs: &BallInputs) -> Renewal {
        let clearance = inputs.clearance * self.per_radius;
        let friction = inputs.friction;
        let [x, screw_z, nut_z] = state.place;
        let [turn_x, turn_y, turn_z] = state.turning;
        let motion = Motion {
            speed: state.speed,
            x: turn_x,
            y: turn_y,
            z: turn_z,
        };
        let mut shared = Shared::NONE;
        let mut screw = Axial::NONE;
        let touches = self.touches(
            &self.screw,
            1.0,
            (x, screw_z),
            inputs.screw_deviation,
            clearance,
        );
        let mut loads = [0.0; 4];
        let [left, right, far_left, far_right] = &mut loads;
        for (touch, load) in touches.iter().zip([left, right]) {
            if let Some(touch) = touch {
                *load = touch.load;
                touch.add(&self.screw, &motion, friction, &mut screw, &mut shared);
            }
        }
        let on_screw = shared.forces;
        let [base_y, base_z, base_speed] = self.nut.base;
        let relative = Motion {
            speed: motion.speed - base_speed,
            x: motion.x,
            y: motion.y - base_y,
            z: motion.z - base_z,
        };
        let mut nut = Axial::NONE;
        let touches = self.touches(&self.nut, -1.0, (x, nut_z), inputs.nut_deviation, clearance);
        for (touch, load) in touches.iter().zip([far_left, far_right]) {
            if let Some(touch) = touch {
                *load = touch.load;
                touch.add(&self.nut, &relative, friction, &mut nut, &mut shared);
            }
        }
        // Friction along the track carries a part of the axial load.
        let along = -on_screw.speed;
        let needed = (inputs.axial_load - self.sin_lead * along) * self.per_cos_lead;
        let carried = self.cos_lead * screw.force + self.sin_lead * along;
        let step = solved(
            &shared,
            &screw,
            &nut,
            [screw.force - needed, nut.force + needed],
            inputs.force,
        );
        let taken = self.limited(&step, inputs.axial_load);
        state.place = [
            x - taken * step.radial,
            screw_z - taken * step.screw,
            nut_z - taken * step.nut,
        ];
        let moved = motion.plus(&step.motion, -taken);
        state.turning = [moved.x, moved.y, moved.z];
        state.speed = moved.speed;
        // Power lost is the ball's forces times its motion, less those in the nut times the nut's.
        let total = &shared.forces;
        let into_nut = base_y * (total.y - on_screw.y)
            + base_z * (total.z - on_screw.z)
            + base_speed * (total.speed - on_screw.speed);
        Renewal {
            speed: moved.speed * self.ball_radius,
            compliance: self.ball_radius * step.compliance,
            torque: (moved.dot(total) - into_nut) * self.ball_radius,
            carried,
            loads,
            taken,
        }
    }

    /// Part of a step that is taken.
    #[inline(always)]
    fn limited(&self, step: &Step, axial_load: f32) -> f32 {
        let reach = LARGEST_SHIFT * self.deflection(axial_load);
        let Motion { speed, x, y, z } = step.motion;
        let sum = x.abs() + y.abs() + z.abs() + speed.abs();
        let shift = larger(step.radial.abs(), larger(step.screw.abs(), step.nut.abs()));
        let mut taken = 1.0;
        if sum > LARGEST_TURN {
            taken = LARGEST_TURN / sum;
        }
        if shift * taken > reach {
            taken = reach / shift;
        }
        taken
    }

    /// Deflection of a screw contact under all of a ball's load, over the ball radius.
    #[inline(always)]
    pub(super) fn deflection(&self, axial_load: f32) -> f32 {
        let normal = axial_load.abs() * self.per_axial_load;
        let [inverse, _] = inverse_cube_roots([normal, 1.0]);
        normal * inverse * self.screw.per_stiffness
    }
}

#[inline(always)]
const fn larger(first: f32, second: f32) -> f32 {
    if first > second { first } else { second }
}
