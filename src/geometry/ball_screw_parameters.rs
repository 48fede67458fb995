//! What a drawing says of a ball screw.

use super::limits::{BALL_RADIUS, LARGEST_CONTACT_ANGLE, LEAD, PITCH_RADIUS};
use super::profile::GrooveSize;
use crate::error::{Error, attempt, in_range};
use crate::material::Material;

/// What a catalogue or a drawing prints of a ball screw; unchecked.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct BallScrewParameters {
    /// Radius `r_m` of the cylinder on which the ball centres run, m, 1e-3 to 0.5; half the
    /// nominal diameter where a catalogue prints no pitch circle.
    pub pitch_radius: f32,
    /// Axial travel of the nut in one turn, m, 0 to 0.2; 0 is a ball bearing.
    pub lead: f32,
    /// Ball radius `r_b`, m, 1e-4 to 0.05, up to 0.9 of the pitch radius.
    pub ball_radius: f32,
    /// Size of the screw's groove.
    pub screw_groove: GrooveSize,
    /// Size of the nut's groove.
    pub nut_groove: GrooveSize,
    /// Nominal contact angle `beta_0`, rad, 0.01 to [`LARGEST_CONTACT_ANGLE`].
    pub contact_angle: f32,
    /// Material of the balls.
    pub ball_material: Material,
    /// Material of screw and nut.
    pub groove_material: Material,
}

impl BallScrewParameters {
    /// Refuses numbers out of range; the sizes of the grooves are checked with their profiles.
    pub(super) const fn checked(&self) -> Result<(), Error> {
        attempt!(PITCH_RADIUS.checked("pitch_radius", self.pitch_radius));
        attempt!(LEAD.checked("lead", self.lead));
        let track = 0.9 * self.pitch_radius;
        let largest_ball = if track < BALL_RADIUS.maximum {
            track
        } else {
            BALL_RADIUS.maximum
        };
        attempt!(in_range(
            "ball_radius",
            self.ball_radius,
            BALL_RADIUS.minimum,
            largest_ball
        ));
        attempt!(in_range(
            "contact_angle",
            self.contact_angle,
            0.01,
            LARGEST_CONTACT_ANGLE
        ));
        attempt!(self.ball_material.checked());
        attempt!(self.groove_material.checked());
        Ok(())
    }
}
