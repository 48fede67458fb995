//! Constants of a ball in a linear bearing.

use super::four_point::{FourPointBall, Track};
use crate::error::{Error, in_range};
use crate::math;

/// Spin below which a contact counts as sticking, in units of track speed over ball radius; contacts of
/// a ball in four-point contact spin with about half that unit.
const STICK_SPIN: f32 = 0.01;

/// What a four-point contact linear bearing and its contact ellipse give to a ball.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct LinearBallParameters {
    /// Ball radius `R_B`, m; 1e-5 to 1.
    pub ball_radius: f32,
    /// Nominal contact angle `beta_0`, rad; 0.05 to 1.5.
    pub contact_angle: f32,
    /// Axis ratio `k = b/a` of the contact ellipse; 0.01 to 1.
    pub axis_ratio: f32,
    /// Semi-major axis `a` over the cube root of the contact force, m/N^(1/3); 1e-8 to 1. In the symbols
    /// of Lin 2019, eq. (3.36): `Psi R_B^(1/3)`.
    pub semi_major_coefficient: f32,
    /// Coulomb friction coefficient `mu` of ball and groove; 1e-6 to 10.
    pub friction: f32,
}

impl LinearBallParameters {
    pub(super) fn checked(&self) -> Result<Self, Error> {
        in_range("ball_radius", self.ball_radius, 1e-5, 1.0)?;
        in_range("contact_angle", self.contact_angle, 0.05, 1.5)?;
        in_range(
            "semi_major_coefficient",
            self.semi_major_coefficient,
            1e-8,
            1.0,
        )?;
        in_range("friction", self.friction, 1e-6, 10.0)?;
        Ok(*self)
    }
}

impl FourPointBall {
    /// A ball in a linear bearing: the bottom groove rests, the top groove moves with the track speed.
    ///
    /// Errors of the speed deviation, relative to `v/2`, against the minimum of the exact dissipation,
    /// four contact angles within ±3 degrees of 45 degrees, side-force ratio up to 0.8 (300 random
    /// sets, largest and rms): start 5.0e-2...
    ///
    /// # Errors
    /// [`Error`] naming the field of [`LinearBallParameters`] that is out of range.
    pub fn linear(parameters: &LinearBallParameters) -> Result<Self, Error> {
        let parameters = parameters.checked()?;
        let (_, cos) = math::sin_cos(parameters.contact_angle);
        // Half the track speed along, and no slip at the bottom: R_B omega_x cos(beta_0) = v/2.
        let track = Track::new(
            parameters.axis_ratio,
            parameters.semi_major_coefficient,
            parameters.ball_radius,
            0.5 / cos,
        )?;
        Ok(Self::folded(
            parameters.friction,
            parameters.contact_angle,
            0.5,
            STICK_SPIN,
            track,
            track,
        ))
    }
}
