//! Elastic constants of balls and grooves.

use crate::error::{Error, attempt, in_range};

/// An isotropic elastic material.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Material {
    /// Young's modulus, Pa, 1e6 to 1e13.
    pub youngs_modulus: f32,
    /// Poisson's ratio, 0 to 0.5.
    pub poisson_ratio: f32,
    /// Density, kg/m³, 1 to 1e5.
    pub density: f32,
}

impl Material {
    /// Bearing steel of Lin 2019, Tables 2.1, 3.6 and 4.1, with the density of Lin, Velinsky, Ravani 1994.
    pub const STEEL: Self = Self {
        youngs_modulus: 210e9,
        poisson_ratio: 0.28,
        density: 7800.0,
    };

    /// Silicon nitride, the usual ceramic ball (310 GPa, 0.27, 3200 kg/m³).
    pub const SILICON_NITRIDE: Self = Self {
        youngs_modulus: 310e9,
        poisson_ratio: 0.27,
        density: 3200.0,
    };

    /// The material, checked.
    pub const fn checked(self) -> Result<Self, Error> {
        attempt!(in_range("youngs_modulus", self.youngs_modulus, 1e6, 1e13));
        attempt!(in_range("poisson_ratio", self.poisson_ratio, 0.0, 0.5));
        attempt!(in_range("density", self.density, 1.0, 1e5));
        Ok(self)
    }

    /// Compliance of a half space of this material, `(1 - nu²) / E`, 1/Pa.
    pub const fn half_space_compliance(&self) -> f32 {
        (1.0 - self.poisson_ratio * self.poisson_ratio) / self.youngs_modulus
    }
}

/// Contact modulus of two bodies, Pa: `1/E* = (1 - nu1²)/E1 + (1 - nu2²)/E2` (Lin 2019, eq. (B.6)).
///
/// Steel on steel: 113.9 GPa. Some texts, Alberdi et al. among them, print twice this value as `E'`.
///
/// ```
/// use epas_friction::Material;
/// use epas_friction::material::contact_modulus;
/// let steel = contact_modulus(&Material::STEEL, &Material::STEEL);
/// assert!((steel - 113.93229e9).abs() < 1e5);
/// ```
pub const fn contact_modulus(first: &Material, second: &Material) -> f32 {
    1.0 / (first.half_space_compliance() + second.half_space_compliance())
}
