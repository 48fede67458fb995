//! A ball bearing: a ball screw without lead.

use super::ball_screw::{BallScrew, BallScrewParameters};
use super::profile::GrooveSize;
use crate::error::{Error, attempt};
use crate::material::Material;

/// What a catalogue or a drawing prints of a four-point or angular contact ball bearing; unchecked.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct BallBearingParameters {
    /// Radius of the circle on which the ball centres run, m, 1e-3 to 0.5.
    pub pitch_radius: f32,
    /// Ball radius, m, 1e-4 to 0.05, up to 0.9 of the pitch radius.
    pub ball_radius: f32,
    /// Size of the inner race's groove.
    pub inner_groove: GrooveSize,
    /// Size of the outer race's groove.
    pub outer_groove: GrooveSize,
    /// Nominal contact angle, rad, 0.01 to [`LARGEST_CONTACT_ANGLE`](super::LARGEST_CONTACT_ANGLE).
    pub contact_angle: f32,
    /// Material of the balls.
    pub ball_material: Material,
    /// Material of the races.
    pub groove_material: Material,
}

/// A ball bearing whose every number has been checked.
///
/// Its inner race is [`Groove::Screw`](super::Groove::Screw), its outer race
/// [`Groove::Nut`](super::Groove::Nut) of a [`BallScrew`] with lead 0, so that each formula exists
/// once.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct BallBearing(BallScrew);

impl BallBearing {
    /// Checks every field and folds the constants. Set-up only; a constant can take it, as that of
    /// [`BallScrew::new`].
    ///
    /// # Errors
    /// As [`BallScrew::new`].
    pub const fn new(parameters: BallBearingParameters) -> Result<Self, Error> {
        Ok(Self(attempt!(BallScrew::new(BallScrewParameters {
            pitch_radius: parameters.pitch_radius,
            lead: 0.0,
            ball_radius: parameters.ball_radius,
            screw_groove: parameters.inner_groove,
            nut_groove: parameters.outer_groove,
            contact_angle: parameters.contact_angle,
            ball_material: parameters.ball_material,
            groove_material: parameters.groove_material,
        }))))
    }

    /// The bearing as a ball screw with lead 0.
    #[inline]
    #[must_use]
    pub const fn as_ball_screw(&self) -> &BallScrew {
        &self.0
    }
}
