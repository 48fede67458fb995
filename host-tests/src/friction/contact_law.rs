//! Size and stiffness of a Hertzian contact as powers of its load, with the dissertation's simplification beside the exact law.

use super::linear_ball::EllipseLaw;
use crate::error::ReferenceError;
use crate::hertz::Hertz;

/// Which correction for the eccentricity of the ellipse enters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Eccentricity {
    /// Exact Hertz theory.
    Exact,
    /// The factor `F1` of (B.1), (B.7), (B.10) taken as one, as the dissertation does for Tables 3.2 and B.1. The axis ratio stays exact.
    Ignored,
}

/// Contact laws `a = semi_major_constant F^(1/3)`, `b = axis_ratio a`, `deflection = compliance F^(2/3)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HertzLaw {
    /// Ellipse.
    pub ellipse: EllipseLaw,
    /// Deflection per load to the power 2/3, m/N^(2/3).
    pub compliance: f64,
}

impl HertzLaw {
    /// From the relative principal radii, m, in either order, and the contact modulus, Pa, as [`Hertz::new`].
    ///
    /// Source: Lin 2019, appendix B. Corrected: the left side of (B.8) is the larger radius over the smaller; (B.1) holds the
    /// factor `F2` of the deflection, not `F1`; the exponents of (B.11) are 1/3.
    pub fn new(
        relative_radius_1: f64,
        relative_radius_2: f64,
        contact_modulus: f64,
        eccentricity: Eccentricity,
    ) -> Result<Self, ReferenceError> {
        let hertz = Hertz::new(relative_radius_1, relative_radius_2, contact_modulus)?;
        Ok(match eccentricity {
            Eccentricity::Exact => hertz.into(),
            Eccentricity::Ignored => {
                let equivalent = (relative_radius_1 * relative_radius_2).sqrt();
                let mean = (0.75 * equivalent / contact_modulus).cbrt();
                Self {
                    ellipse: EllipseLaw {
                        semi_major_constant: mean / hertz.axis_ratio.sqrt(),
                        axis_ratio: hertz.axis_ratio,
                    },
                    compliance: (9.0 / (16.0 * contact_modulus * contact_modulus * equivalent))
                        .cbrt(),
                }
            }
        })
    }

    /// Load at a deflection, m; zero when the surfaces part.
    pub fn load(&self, deflection: f64) -> f64 {
        (deflection.max(0.0) / self.compliance).powf(1.5)
    }
}

impl From<Hertz> for HertzLaw {
    fn from(hertz: Hertz) -> Self {
        Self {
            ellipse: hertz.into(),
            compliance: hertz.deflection,
        }
    }
}

impl From<Hertz> for EllipseLaw {
    fn from(hertz: Hertz) -> Self {
        Self {
            semi_major_constant: hertz.semi_major,
            axis_ratio: hertz.axis_ratio,
        }
    }
}
