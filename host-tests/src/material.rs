//! Elastic constants of screw, nut, rails and balls.

use crate::error::{ReferenceError, within};
use crate::hertz::contact_modulus;

/// Elastic constants of one body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Elastic {
    /// Young's modulus, Pa, 1e6 to 1e13.
    pub youngs_modulus: f64,
    /// Poisson's ratio, 0 to 0.49.
    pub poisson_ratio: f64,
}

impl Elastic {
    /// Steel of the dissertation: 210 GPa (its tables print N/mm² by mistake) and 0.28.
    pub const STEEL: Self = Self {
        youngs_modulus: 210e9,
        poisson_ratio: 0.28,
    };

    /// Refuses what is no elastic body.
    pub fn check(&self) -> Result<(), ReferenceError> {
        within("youngs_modulus", self.youngs_modulus, 1e6, 1e13)?;
        within("poisson_ratio", self.poisson_ratio, 0.0, 0.49)?;
        Ok(())
    }

    /// Shear modulus, Pa: `E / (2 (1 + nu))`.
    pub fn shear_modulus(&self) -> f64 {
        self.youngs_modulus / (2.0 * (1.0 + self.poisson_ratio))
    }

    /// Contact modulus with another body, Pa.
    pub fn contact_modulus(&self, other: &Self) -> f64 {
        contact_modulus(
            (self.youngs_modulus, self.poisson_ratio),
            (other.youngs_modulus, other.poisson_ratio),
        )
    }
}
