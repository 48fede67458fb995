//! A linear ball bearing with four-point contact.

use super::profile::ContactAngle;
use super::profile::GrooveSize;
use super::profile::{BALL_RADIUS, LARGEST_CONTACT_ANGLE};
use crate::error::{Error, attempt, in_range};
use crate::material::Material;

/// What a drawing prints of a linear ball bearing with gothic-arch grooves; unchecked.
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

/// A linear ball bearing whose every number has been checked: the grooves are straight, so that the
/// relative radii at a contact are the ball's along the track and those of ball and groove across it.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct LinearBearing {
    parameters: LinearBearingParameters,
    groove_radius: f32,
    clearance: f32,
    contact_angle: ContactAngle,
}

impl LinearBearing {
    /// Checks every field and folds the constants. Set-up only; a constant can take it, as that of
    /// [`BallScrew::new`](super::BallScrew::new).
    ///
    /// # Errors
    /// [`Error`] naming `ball_radius`, `conformity` or `groove_radius`, `contact_angle`, or a
    /// material's field.
    pub const fn new(parameters: LinearBearingParameters) -> Result<Self, Error> {
        let ball_radius = attempt!(BALL_RADIUS.checked("ball_radius", parameters.ball_radius));
        let contact_angle = attempt!(in_range(
            "contact_angle",
            parameters.contact_angle,
            0.01,
            LARGEST_CONTACT_ANGLE
        ));
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

    /// The numbers that the design was made from.
    #[inline]
    #[must_use]
    pub const fn parameters(&self) -> &LinearBearingParameters {
        &self.parameters
    }

    /// Ball radius, m.
    #[inline]
    #[must_use]
    pub const fn ball_radius(&self) -> f32 {
        self.parameters.ball_radius
    }

    /// Groove radius, m.
    #[inline]
    #[must_use]
    pub const fn groove_radius(&self) -> f32 {
        self.groove_radius
    }

    /// Groove radius less ball radius, m, without the cancellation of their difference.
    #[inline]
    #[must_use]
    pub const fn clearance(&self) -> f32 {
        self.clearance
    }

    /// Nominal contact angle, by its cosine and sine.
    #[inline]
    #[must_use]
    pub const fn contact_angle(&self) -> ContactAngle {
        self.contact_angle
    }
}
