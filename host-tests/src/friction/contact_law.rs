//! Size and stiffness of a Hertzian contact as powers of its load, with the dissertation's simplification beside the exact law.

use ellip::{elliprd, elliprf, elliprg};

use super::linear_ball::EllipseLaw;
use crate::error::{ReferenceError, within};

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

/// Complete elliptic integrals `(K, E)` of an ellipse with the axis ratio `k`.
fn complete(k: f64) -> Option<(f64, f64)> {
    Some((
        elliprf(0.0, k * k, 1.0).ok()?,
        2.0 * elliprg(0.0, k * k, 1.0).ok()?,
    ))
}

impl HertzLaw {
    /// From the relative principal radii `relative_radius_1 <= relative_radius_2`, m, (either order) and the contact modulus
    /// `1/((1 - nu_1^2)/E_1 + (1 - nu_2^2)/E_2)`, Pa.
    ///
    /// Axis ratio from `R''/R' = (E/k^2 - K)/(K - E)`; `a = (3 E R_s F/(pi k^2 E*))^(1/3)`,
    /// `R_s = R' R''/(R' + R'')`; `deflection = 3 F K/(2 pi a E*)`.
    ///
    /// Source: Lin 2019, appendix B. Corrected: the left side of (B.8) is the larger radius over the smaller; (B.1) holds the
    /// factor `F2` of the deflection, not `F1`; the exponents of (B.11) are 1/3.
    ///
    /// # Errors
    /// When a value is not positive, or the ratio of the radii is above 1e4.
    pub fn new(
        relative_radius_1: f64,
        relative_radius_2: f64,
        contact_modulus: f64,
        eccentricity: Eccentricity,
    ) -> Result<Self, ReferenceError> {
        within("relative_radius_1", relative_radius_1, 1e-9, 1e6)?;
        within("relative_radius_2", relative_radius_2, 1e-9, 1e6)?;
        within("contact_modulus", contact_modulus, 1.0, 1e15)?;
        let (small, large) = (
            relative_radius_1.min(relative_radius_2),
            relative_radius_1.max(relative_radius_2),
        );
        let ratio = within("relative_radius_2", large / small, 1.0, 1e4)?;
        // (E/k^2 - K)/(K - E) = B/(k^2 D) with B = (E - k^2 K)/e^2, D = (K - E)/e^2: falls steadily in k, 1 at the circle.
        let shape = |k: f64| {
            let d = elliprd(0.0, k * k, 1.0).unwrap_or(f64::NAN) / 3.0;
            (elliprf(0.0, k * k, 1.0).unwrap_or(f64::NAN) - d) / (k * k * d)
        };
        let (mut low, mut high) = (1e-3_f64, 1.0_f64);
        for _ in 0..200 {
            let middle = (low * high).sqrt();
            if shape(middle) > ratio {
                low = middle;
            } else {
                high = middle;
            }
        }
        let k = (low * high).sqrt();
        let out = ReferenceError::OutOfRange {
            field: "relative_radius_2",
            value: ratio,
            min: 1.0,
            max: 1e4,
        };
        let (first, second) = complete(k).ok_or(out)?;
        let pi = std::f64::consts::PI;
        Ok(match eccentricity {
            Eccentricity::Exact => {
                let relative = small * large / (small + large);
                let a = (3.0 * second * relative / (pi * k * k * contact_modulus)).cbrt();
                Self {
                    ellipse: EllipseLaw {
                        semi_major_constant: a,
                        axis_ratio: k,
                    },
                    compliance: 1.5 * first / (pi * a * contact_modulus),
                }
            }
            Eccentricity::Ignored => {
                let equivalent = (small * large).sqrt();
                let mean = (0.75 * equivalent / contact_modulus).cbrt();
                Self {
                    ellipse: EllipseLaw {
                        semi_major_constant: mean / k.sqrt(),
                        axis_ratio: k,
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
