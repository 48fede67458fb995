//! What the map is made from at set-up: where their integrals are sampled, and the polynomial through the samples.

use crate::contact::integrals::fifth_integral;
use crate::math::constant;
use crate::math::elliptic::incomplete;

/// Square of the velocity centre's distance from the contact, in semi-major axes, from which the far
/// field serves. Its first term left out falls with the sixth power of the distance: from 1.5 semi-axes on the largest
/// errors would be six times as large.
pub(super) const FAR: f32 = 4.0;

/// Largest `sqrt(lambda)` in the near field: two semi-axes away `lambda` is below 4.
const LARGEST_ROOT: f32 = 2.0;

/// The variable that integrals are interpolated in, `sqrt(lambda)/(sqrt(lambda) + sqrt(k))`, brought to -1 to 1.
pub(super) struct Variable {
    axis_ratio: f32,
    /// `sqrt(k)`.
    pub(super) scale: f32,
    /// Its largest value in the near field, before it is brought to -1 to 1.
    largest: f32,
}

/// The integrals at one node.
pub(super) struct Node {
    pub(super) lambda: f32,
    /// `C1`, `C2` and `C5`.
    pub(super) first: f32,
    pub(super) second: f32,
    pub(super) fifth: f32,
    /// `sqrt(lambda) + sqrt(k)`.
    pub(super) sum: f32,
}

impl Variable {
    /// Of the axis ratio `k`.
    pub(super) const fn new(axis_ratio: f32) -> Self {
        let scale = constant::sqrt(axis_ratio);
        Self {
            axis_ratio,
            scale,
            largest: LARGEST_ROOT / (LARGEST_ROOT + scale),
        }
    }

    /// What brings the variable to 0 to 2.
    pub(super) const fn stretch(&self) -> f32 {
        2.0 / self.largest
    }

    /// The integrals where the variable is `node`, -1 to 1.
    pub(super) const fn at(&self, node: f32) -> Node {
        let part = 0.5 * (1.0 + node) * self.largest;
        let root = self.scale * part / (1.0 - part);
        let lambda = root * root;
        let (first, second) = incomplete(self.axis_ratio * self.axis_ratio, lambda);
        Node {
            lambda,
            first,
            second,
            fifth: fifth_integral(self.axis_ratio, lambda, root, first, second),
            sum: root + self.scale,
        }
    }
}

/// Newton's divided differences of values at these nodes.
pub(super) const fn divided_differences<const N: usize>(
    mut values: [f32; N],
    nodes: &[f32; N],
) -> [f32; N] {
    let mut order = 1;
    while order < N {
        // Backwards, so that what stands before a value is still of the order below.
        let mut place = N - 1;
        while place >= order {
            values[place] =
                (values[place] - values[place - 1]) / (nodes[place] - nodes[place - order]);
            place -= 1;
        }
        order += 1;
    }
    values
}

/// `C3`, `C4` and `C5` of the multipole series' second term, from the square of the axis ratio.
///
/// Mean of `p² (4 l² - p²)/8` with `l` along and `p` across the direction of the velocity centre: the
/// coefficients of `x⁴`, `x² z²`, `z⁴`. Fourth moments of a Hertzian pressure are 3/35, k²/35 and 3 k⁴/35.
pub(super) const fn quartic(square: f32) -> [f32; 3] {
    let (long, mixed, short) = (3.0 / 35.0, square / 35.0, 3.0 * square * square / 35.0);
    [
        0.125 * (4.0 * mixed - short),
        0.125 * (4.0 * long + 4.0 * short - 22.0 * mixed),
        0.125 * (4.0 * mixed - long),
    ]
}
