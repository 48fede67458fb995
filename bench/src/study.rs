//! The case studies of Lin 2019 that report and timing share.

use std::f64::consts::FRAC_PI_4;

use epas_friction::LinearBallParameters;
use epas_reference::friction::linear_ball::{EllipseLaw, LinearBall, contact_forces};

/// Friction coefficient of balls and grooves.
pub const FRICTION: f64 = 0.1;
/// Load on a ball across the track and down, N.
pub const NORMAL_LOAD: f64 = 100.0;

const BALL_RADIUS: f64 = 0.005;
/// The ellipse of Table 3.3 (conformity 0.56, steel).
const AXIS_RATIO: f64 = 0.232_146_373;
const PSI: f64 = 5.3073e-4;

fn semi_major_constant() -> f64 {
    PSI * BALL_RADIUS.cbrt()
}

/// The ball of Table 3.3 for the crate.
pub fn linear_ball() -> LinearBallParameters {
    LinearBallParameters {
        ball_radius: BALL_RADIUS as f32,
        contact_angle: FRAC_PI_4 as f32,
        axis_ratio: AXIS_RATIO as f32,
        semi_major_coefficient: semi_major_constant() as f32,
        friction: FRICTION as f32,
    }
}

/// The ball of Table 3.3 with its bottom groove turned by so many degrees, under a side force of so many
/// times the normal load (Section 3.3.4).
pub fn turned_ball(degrees: f64, side_force_ratio: f64) -> LinearBall {
    let turn = degrees.to_radians();
    let contact_angles = [-turn, turn, 0.0, 0.0].map(|deviation| FRAC_PI_4 + deviation);
    LinearBall {
        ball_radius: BALL_RADIUS,
        friction: FRICTION,
        contact_angles,
        contact_forces: contact_forces(contact_angles, NORMAL_LOAD * side_force_ratio, NORMAL_LOAD)
            .map(|force| force.max(0.0)),
        ellipse: EllipseLaw {
            semi_major_constant: semi_major_constant(),
            axis_ratio: AXIS_RATIO,
        },
    }
}
