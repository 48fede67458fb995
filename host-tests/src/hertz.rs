//! The exact Hertzian contact ellipse, by Carlson's elliptic integrals.

use ellip::{elliprd, elliprf};
use roots::{SimpleConvergency, find_root_brent};

use crate::error::{ReferenceError, within};

/// Contact modulus of two bodies given as Young's modulus (Pa) and Poisson's ratio, Pa: `1/E* = (1 - nu1²)/E1 + (1 - nu2²)/E2`.
pub fn contact_modulus(first: (f64, f64), second: (f64, f64)) -> f64 {
    let compliance = |(youngs_modulus, poisson_ratio): (f64, f64)| {
        (1.0 - poisson_ratio * poisson_ratio) / youngs_modulus
    };
    1.0 / (compliance(first) + compliance(second))
}

/// A Hertzian contact: constants to be multiplied by powers of the load.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hertz {
    /// Axis ratio `k = b/a`.
    pub axis_ratio: f64,
    /// Semi-major axis per cube root of the load, m/N^(1/3).
    pub semi_major: f64,
    /// Semi-minor axis per cube root of the load, m/N^(1/3).
    pub semi_minor: f64,
    /// Deflection per load to the power 2/3, m/N^(2/3).
    pub deflection: f64,
    /// Largest pressure per cube root of the load, Pa/N^(1/3).
    pub max_pressure: f64,
}

/// The contact under a load.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ellipse {
    /// Semi-major axis, m.
    pub semi_major: f64,
    /// Semi-minor axis, m.
    pub semi_minor: f64,
    /// Approach of the bodies, m.
    pub deflection: f64,
    /// Pressure in the centre, Pa.
    pub max_pressure: f64,
}

/// Complete elliptic integrals `(K, E)` of the modulus `sqrt(1 - k²)`.
pub fn complete_integrals(axis_ratio: f64) -> Result<(f64, f64), ReferenceError> {
    let square = axis_ratio * axis_ratio;
    let failed = |_| ReferenceError::input("axis_ratio", "no elliptic integral");
    let first = elliprf(0.0, square, 1.0).map_err(failed)?;
    // E = k² (RD(0, k², 1) + RD(0, 1, k²)) / 3: a sum of positive terms.
    let second = square / 3.0
        * (elliprd(0.0, square, 1.0).map_err(failed)?
            + elliprd(0.0, 1.0, square).map_err(failed)?);
    Ok((first, second))
}

/// Axis ratio `k = b/a` that solves `(E/k² - K) / (K - E) = ratio`, ratio of the larger to the smaller relative radius.
///
/// In Carlson's form the equation is `RD(0, 1, k²) / RD(0, k², 1) = ratio`, without a difference, also
/// at the circle; solved for `ln(k)` by Brent's method.
pub fn axis_ratio(radius_ratio: f64) -> Result<f64, ReferenceError> {
    within("radius_ratio", radius_ratio, 1.0, 1e8)?;
    let target = radius_ratio.ln();
    let residual = |log_ratio: f64| {
        let square = (2.0 * log_ratio).exp();
        match (elliprd(0.0, 1.0, square), elliprd(0.0, square, 1.0)) {
            (Ok(steep), Ok(flat)) => (steep / flat).ln() - target,
            _ => f64::NAN,
        }
    };
    if residual(0.0) >= 0.0 {
        return Ok(1.0);
    }
    let mut convergency = SimpleConvergency {
        eps: 4e-15,
        max_iter: 200,
    };
    find_root_brent(-12.0, 0.0, residual, &mut convergency)
        .map(f64::exp)
        .map_err(|error| ReferenceError::input("radius_ratio", format!("{error:?}")))
}

impl Hertz {
    /// From the two relative radii, m in either order, and the contact modulus, Pa.
    pub fn new(
        relative_radius_1: f64,
        relative_radius_2: f64,
        contact_modulus: f64,
    ) -> Result<Self, ReferenceError> {
        within("relative_radius_1", relative_radius_1, 1e-12, 1e12)?;
        within("relative_radius_2", relative_radius_2, 1e-12, 1e12)?;
        within("contact_modulus", contact_modulus, 1e-3, 1e18)?;
        let (small, large) = if relative_radius_1 <= relative_radius_2 {
            (relative_radius_1, relative_radius_2)
        } else {
            (relative_radius_2, relative_radius_1)
        };
        let axis_ratio =
            axis_ratio(large / small).map_err(|error| error.renamed("relative_radius_2"))?;
        let (first, second) = complete_integrals(axis_ratio)?;
        let equivalent = small / (1.0 + small / large);
        let pi = std::f64::consts::PI;
        let semi_major =
            (3.0 * second * equivalent / (pi * axis_ratio * axis_ratio * contact_modulus)).cbrt();
        let semi_minor = axis_ratio * semi_major;
        Ok(Self {
            axis_ratio,
            semi_major,
            semi_minor,
            deflection: 3.0 * first / (2.0 * pi * semi_major * contact_modulus),
            max_pressure: 3.0 / (2.0 * pi * semi_major * semi_minor),
        })
    }

    /// The contact under `load`, N.
    pub fn at(&self, load: f64) -> Ellipse {
        let root = load.max(0.0).cbrt();
        Ellipse {
            semi_major: self.semi_major * root,
            semi_minor: self.semi_minor * root,
            deflection: self.deflection * root * root,
            max_pressure: self.max_pressure * root,
        }
    }
}
