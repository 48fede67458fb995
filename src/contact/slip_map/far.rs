//! A contact whose velocity centre lies far from it: the multipole series.

use super::nodes::quartic;
use super::potential::Potential;
use crate::math;

/// The far field: the distance itself and two terms of the multipole series.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(super) struct FarField {
    /// `C3`, `C4`, `C5` of the quartic.
    quartic: [f32; 3],
}

impl FarField {
    /// From the square of the axis ratio.
    pub(super) const fn new(square: f32) -> Self {
        Self {
            quartic: quartic(square),
        }
    }

    /// Two terms of the multipole series beyond the distance itself.
    #[inline]
    pub(super) fn potential(
        &self,
        along: f32,
        across: f32,
        distance2: f32,
        square: f32,
    ) -> Potential {
        // Sliding without spin is as far as a million semi-axes; NaN as well.
        let (along, across, distance2) = if distance2 < 1e12 {
            (along, across, distance2)
        } else {
            limited(along, across)
        };
        let inverse = 1.0 / math::sqrt(distance2);
        let inverse2 = inverse * inverse;
        let (n, t) = (along * inverse, across * inverse);
        let (n2, t2) = (n * n, t * t);
        let [c3, c4, c5] = self.quartic;
        // Mean squares of the ellipse are 1/5 and k²/5 of the semi-major axis.
        let narrow = 0.2 * square;
        let second = 0.5 * (0.2 * t2 + narrow * n2) * inverse2;
        let fourth = (c3 * n2 * n2 + c4 * n2 * t2 + c5 * t2 * t2) * (inverse2 * inverse2);
        let down = 3.0 * second + 7.0 * fourth;
        let quartic_along = (4.0 * c3 * n2 + 2.0 * c4 * t2) * (inverse2 * inverse2);
        let quartic_across = (4.0 * c5 * t2 + 2.0 * c4 * n2) * (inverse2 * inverse2);
        let (wide2, narrow2) = (0.2 * inverse2, narrow * inverse2);
        let fade = 15.0 * second - 1.0;
        Potential {
            moment: (2.0 * second + 4.0 * fourth) / inverse,
            along: n * (1.0 - down + narrow2 + quartic_along),
            across: t * (1.0 - down + wide2 + quartic_across),
            along_along: inverse * (1.0 + n2 * (fade - 6.0 * narrow2) + narrow2 - 3.0 * second),
            mixed: inverse * (n * t * (fade - 3.0 * (narrow2 + wide2))),
            across_across: inverse * (1.0 + t2 * (fade - 6.0 * wide2) + wide2 - 3.0 * second),
        }
    }
}

/// A place far away, brought back to a distance of a million; what is not a number counts as zero, and two
/// of them as far away across.
#[cold]
fn limited(along: f32, across: f32) -> (f32, f32, f32) {
    let number = |x: f32| if x.is_nan() { 0.0 } else { x };
    let (along, across) = (number(along), number(across));
    let (u, v) = (along.abs(), across.abs());
    let size = if u > v { u } else { v };
    if size.is_finite() && size > 1e-30 {
        let scale = 1e6 / size;
        let (along, across) = (along * scale, across * scale);
        (along, across, along * along + across * across)
    } else if u == f32::INFINITY {
        (1e6_f32.copysign(along), 0.0, 1e12)
    } else {
        (0.0, 1e6_f32.copysign(across), 1e12)
    }
}
