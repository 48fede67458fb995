//! A contact angle with its sine and cosine, so that no formula has to take them again.

use crate::error::{Error, attempt, in_range};
use crate::math::constant;

/// Angle between the contact normal and the plane normal to the axis, through its cosine and sine.
///
/// The curvature formulas need only these two numbers. In the loop a changed contact angle costs one
/// [`sin_cos`](constant::sin_cos), by our own kernel whatever backend serves the rest; an unchanged one costs nothing.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct ContactAngle {
    /// Cosine of the contact angle, 0 to 1.
    pub cos: f32,
    /// Sine of the contact angle, 0 to 1.
    pub sin: f32,
}

impl ContactAngle {
    /// Cosine and sine of `angle`, rad, useful range 0 to pi/2.
    #[inline]
    #[must_use]
    pub const fn new(angle: f32) -> Self {
        let (sin, cos) = constant::sin_cos(angle);
        Self { cos, sin }
    }

    /// As [`ContactAngle::new`] with the range 0 to pi/2 checked.
    ///
    /// # Errors
    /// [`Error`] naming `contact_angle`.
    pub const fn checked(angle: f32) -> Result<Self, Error> {
        let largest = core::f32::consts::FRAC_PI_2;
        Ok(Self::new(attempt!(in_range(
            "contact_angle",
            angle,
            0.0,
            largest
        ))))
    }
}
