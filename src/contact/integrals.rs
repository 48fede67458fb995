//! Integrals from which the friction of a contact follows, found at set-up.
//!
//! A contact of ball and groove with semi-axes `a >= b = k a` slips with `V_1` along its major axis (across the ball path), with
//! `V_2` along its minor axis (along the path) and spins with `w`. Its power loss is the mean distance of the velocity centre
//! from the points of the ellipse, weighed by the pressure:
//!
//! ```text
//! D = mu F a |w| P(x, z)        x = V_2/(a w)        z = V_1/(a w)
//! P = 3/16 (C0 + 2 C1 x² + 2 C2 z² - C3 x⁴ - 2 C4 x² z² - C5 z⁴)
//! ```
//!
//! The Laplacian of a distance is its reciprocal, and the mean of the reciprocal is the potential of a Hertzian pressure, an
//! integral over the confocal ellipses. Integrated twice:
//!
//! ```text
//! C1 = ∫ T/(1 + s)   C2 = ∫ T/(k² + s)   C3 = ∫ T/(1 + s)²   C4 = ∫ T/((1 + s)(k² + s))
//! C5 = ∫ T/(k² + s)²    T = sqrt(s/((1 + s)(k² + s)))    s from lambda to infinity
//! ```
//!
//! `lambda` is the largest root of `x²/(1 + lambda) + z²/(k² + lambda) = 1`, zero inside the ellipse: there `P` is a polynomial.
//! By parts all follow from `C1` and `C2`. The derivatives of `P` by `lambda` vanish up to the second, so that force and Hessian
//! are those of the polynomial as well. These are the integrals (3.16)-(3.18) and (3.68) of Lin 2019, which that dissertation
//! evaluates by quadrature.

use crate::error::{Error, in_range};
use crate::math::constant;
use crate::math::elliptic::narrow_integral;

/// Smallest axis ratio, that of a conformity of about 0.5005.
const SMALLEST_AXIS_RATIO: f32 = 0.02;

/// Largest axis ratio; beyond it differences of the elliptic integrals lose too many digits.
const LARGEST_AXIS_RATIO: f32 = 0.95;

/// An axis ratio that the integrals are good for.
pub(super) const fn checked_axis_ratio(axis_ratio: f32) -> Result<f32, Error> {
    in_range(
        "axis_ratio",
        axis_ratio,
        SMALLEST_AXIS_RATIO,
        LARGEST_AXIS_RATIO,
    )
}

/// `C5` at `lambda = root²` from `C1` and `C2`: by parts where `lambda` is below `k²`,
/// and beyond by quadrature, where the difference by parts would leave nothing of it.
pub(super) const fn fifth_integral(k: f32, lambda: f32, root: f32, first: f32, second: f32) -> f32 {
    let square = k * k;
    if lambda < square {
        let (long, short) = (1.0 + lambda, square + lambda);
        let weight = 2.0 * lambda * root / constant::sqrt(long * short);
        let fourth = (second - first) / ((1.0 - k) * (1.0 + k));
        (second - fourth - weight / short) / (3.0 * square)
    } else {
        narrow_integral(square, root)
    }
}
