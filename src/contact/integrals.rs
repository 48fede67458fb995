//! Integrals from which the friction of a contact follows, found at set-up.

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

/// `C5` of [`SlipMap`](super::SlipMap) at `lambda = root²` from `C1` and `C2`: by parts where `lambda` is below `k²`,
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
