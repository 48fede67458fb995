//! A linear ball bearing with four-point contact.

use super::profile::{BALL_RADIUS, ContactAngle, GrooveSize, LARGEST_CONTACT_ANGLE};
use crate::error::{Error, attempt, in_range};
use crate::material::Material;

/// Numbers of a linear ball bearing with gothic-arch grooves in a drawing; unchecked.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct LinearBearingParameters {
    /// Ball radius, m, 1e-4 to 0.05.
    pub ball_radius: f32,
    /// Size of the grooves.
    pub groove: GrooveSize,
    /// Nominal contact angle, rad, 0.01 to [`LARGEST_CONTACT_ANGLE`].
    pub contact_angle: f32,
    /// Material of the balls.
    pub ball_material: Material,
    /// Material of the grooves.
    pub groove_material: Material,
}

/// A linear ball bearing whose every number has been checked; its grooves are straight.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct LinearBearing {
    parameters: LinearBearingParameters,
    groove_radius: f32,
    clearance: f32,
    contact_angle: ContactAngle,
}

impl LinearBearing {
    /// Checks every field and folds the constants.
    pub const fn new(parameters: LinearBearingParameters) -> Result<Self, Error> {
        let ball_radius = attempt!(BALL_RADIUS.checked("ball_radius", parameters.ball_radius));
        let (angle, largest) = (parameters.contact_angle, LARGEST_CONTACT_ANGLE);
        let contact_angle = attempt!(in_range("contact_angle", angle, 0.01, largest));
        attempt!(parameters.ball_material.checked());
        attempt!(parameters.groove_material.checked());
        let (groove_radius, clearance) =
            attempt!(parameters.groove.radius_and_clearance(ball_radius));
        Ok(Self {
            parameters,
            groove_radius,
            clearance,
            contact_angle: ContactAngle::new(contact_angle),
        })
    }

    /// Parameters of the design.
    pub const fn parameters(&self) -> &LinearBearingParameters {
        &self.parameters
    }

    /// Ball radius, m.
    pub const fn ball_radius(&self) -> f32 {
        self.parameters.ball_radius
    }

    /// Groove radius, m.
    pub const fn groove_radius(&self) -> f32 {
        self.groove_radius
    }

    /// Groove radius less ball radius, m, without the cancellation of their difference.
    pub const fn clearance(&self) -> f32 {
        self.clearance
    }

    /// Nominal contact angle, by its cosine and sine.
    pub const fn contact_angle(&self) -> ContactAngle {
        self.contact_angle
    }
}
