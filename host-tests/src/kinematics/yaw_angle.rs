//! The yaw angle at which a contact has no side slip.

use std::f64::consts::PI;

use roots::{SimpleConvergency, find_root_brent};

use super::input::{KinematicsInput, Raceway};
use super::revised::Revised;
use crate::error::ReferenceError;

/// Yaw angle at which side slip vanishes at a contact, rad, by Brent's method within 20° of zero.
pub fn yaw_without_side_slip(
    input: &KinematicsInput,
    raceway: Raceway,
) -> Result<f64, ReferenceError> {
    Revised::new(input)?;
    let side = |yaw_angle: f64| {
        Revised::new(&KinematicsInput {
            yaw_angle,
            ..*input
        })
        .map_or(f64::NAN, |revised| revised.side_slip(raceway, 0.0))
    };
    let limit = 20.0 * PI / 180.0;
    let mut convergency = SimpleConvergency {
        eps: 1e-14,
        max_iter: 100,
    };
    find_root_brent(-limit, limit, side, &mut convergency).map_err(|_| {
        ReferenceError::input("yaw_angle", "side slip does not vanish within 20 degrees")
    })
}
