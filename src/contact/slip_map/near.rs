//! A contact whose velocity centre lies in or near it: elliptic integrals, interpolated.

use core::f32::consts::FRAC_1_SQRT_2;

use super::nodes::{Variable, divided_differences};
use super::potential::Potential;
use crate::math;
use crate::math::elliptic::incomplete;

/// Points of interpolation of the two elliptic integrals.
const POINTS: usize = 10;

/// Chebyshev points in the order of Leja, in which Newton's form loses no digits.
pub(crate) const CHEBYSHEV: [f32; POINTS] = [
    0.987_688_36,
    -0.987_688_36,
    -0.156_434_46,
    0.453_990_5,
    -FRAC_1_SQRT_2,
    FRAC_1_SQRT_2,
    -0.453_990_5,
    0.891_006_5,
    -0.891_006_5,
    0.156_434_46,
];

/// The near field: six coefficients by `lambda`, of which three are interpolated.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(super) struct NearField {
    /// `k²`, and `1/(1 - k²)`.
    square: f32,
    inverse_eccentricity: f32,
    /// `sqrt(k)`, and the factor with which the interpolation's variable runs from -1 to 1.
    scale: f32,
    stretch: f32,
    /// Coefficients inside the ellipse, where `lambda` is 0.
    inside: Coefficients,
    /// Divided differences of `C1`, `C2` and `C5` at the nodes, times `sqrt(lambda) + sqrt(k)` (`C5` also times
    /// `k² + lambda`), which leaves smooth functions.
    first: [f32; POINTS],
    second: [f32; POINTS],
    fifth: [f32; POINTS],
}

/// `C0` to `C5`, in this order: numbers without unit, as all lengths here are over the semi-major axis.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
struct Coefficients {
    whole: f32,
    along: f32,
    across: f32,
    along_along: f32,
    both: f32,
    across_across: f32,
}

impl Coefficients {
    const NONE: Self = Self {
        whole: 0.0,
        along: 0.0,
        across: 0.0,
        along_along: 0.0,
        both: 0.0,
        across_across: 0.0,
    };
}

impl NearField {
    /// From the axis ratio `k`: elliptic integrals at ten places, and at the centre.
    pub(super) const fn new(k: f32) -> Self {
        let square = k * k;
        let variable = Variable::new(k);
        let mut first = [0.0; POINTS];
        let mut second = [0.0; POINTS];
        let mut fifth = [0.0; POINTS];
        let mut point = 0;
        while point < POINTS {
            let node = variable.at(CHEBYSHEV[point]);
            first[point] = node.first * node.sum;
            second[point] = node.second * node.sum;
            fifth[point] = node.fifth * (square + node.lambda) * node.sum;
            point += 1;
        }
        let (along, across) = incomplete(square, 0.0);
        let mut near = Self {
            square,
            inverse_eccentricity: 1.0 / ((1.0 - k) * (1.0 + k)),
            scale: variable.scale,
            stretch: variable.stretch(),
            inside: Coefficients::NONE,
            first: divided_differences(first, &CHEBYSHEV),
            second: divided_differences(second, &CHEBYSHEV),
            fifth: divided_differences(fifth, &CHEBYSHEV),
        };
        let narrow = (across - (across - along) * near.inverse_eccentricity) / (3.0 * square);
        near.inside = near.complete(along, across, narrow, 0.0, 1.0);
        near
    }

    /// `k²`.
    #[inline]
    pub(super) const fn square(&self) -> f32 {
        self.square
    }

    /// Friction force across the track over `mu F` where the velocity centre lies `place`, in semi-major axes, from the contact's
    /// centre along the track; `square` is its square.
    #[inline]
    pub(super) fn share_across(&self, place: f32, square: f32) -> f32 {
        let coefficients = if square <= self.square {
            self.inside
        } else {
            self.outside(square - self.square)
        };
        0.75 * place * (coefficients.across - coefficients.across_across * square)
    }

    /// The potential; `along2`, `across2` and `distance2` are the squares and their sum.
    #[inline]
    pub(super) fn potential(
        &self,
        along: f32,
        across: f32,
        (along2, across2): (f32, f32),
        distance2: f32,
    ) -> Potential {
        // lambda² + 2 excess lambda - constant_term = 0.
        let constant_term = self.square * (along2 - 1.0) + across2;
        let coefficients = if constant_term > 0.0 {
            let excess = 0.5 * (1.0 + self.square - distance2);
            let root = math::sqrt(excess * excess + constant_term);
            let lambda = if excess > 0.0 {
                constant_term / (excess + root)
            } else {
                root - excess
            };
            self.outside(lambda)
        } else {
            self.inside
        };
        let Coefficients {
            whole,
            along: first,
            across: second,
            along_along,
            both,
            across_across,
        } = coefficients;
        let (a, b, c) = (
            along_along * along2,
            both * across2,
            across_across * across2,
        );
        let d = both * along2;
        Potential {
            moment: 0.1875
                * (whole
                    + along2 * (3.0 * a + 6.0 * b - 2.0 * first)
                    + across2 * (3.0 * c - 2.0 * second)),
            along: 0.75 * along * (first - a - b),
            across: 0.75 * across * (second - d - c),
            along_along: 0.75 * (first - 3.0 * a - b),
            mixed: -1.5 * both * along * across,
            across_across: 0.75 * (second - d - 3.0 * c),
        }
    }

    /// Coefficients at `lambda` between 0 and 4.
    #[inline]
    fn outside(&self, lambda: f32) -> Coefficients {
        let root = math::sqrt(lambda);
        let (long, short) = (1.0 + lambda, self.square + lambda);
        // One division for both reciprocals.
        let (product, sum) = (long * short, root + self.scale);
        let both = 1.0 / (product * sum);
        let (inverse, scaled) = (both * sum, both * product);
        let place = self.stretch * (root * scaled) - 1.0;
        let (mut along, mut across, mut narrow) = (0.0, 0.0, 0.0);
        let differences = self.first.iter().zip(&self.second).zip(&self.fifth);
        for (((first, second), fifth), point) in differences.zip(&CHEBYSHEV).rev() {
            let distance = place - point;
            along = along * distance + first;
            across = across * distance + second;
            narrow = narrow * distance + fifth;
        }
        let weight = 2.0 * lambda * root * math::sqrt(inverse);
        self.complete(
            along * scaled,
            across * scaled,
            narrow * scaled * (long * inverse),
            weight,
            short * inverse,
        )
    }

    /// The other coefficients by parts, with `weight = 2 lambda T` and the reciprocal of `1 + lambda`.
    ///
    /// `C5` by parts would be a difference divided by `k²`, which leaves nothing of it far from a slender
    /// ellipse.
    #[inline]
    const fn complete(
        &self,
        along: f32,
        across: f32,
        across_across: f32,
        weight: f32,
        long: f32,
    ) -> Coefficients {
        let both = (across - along) * self.inverse_eccentricity;
        Coefficients {
            whole: weight + along + self.square * across,
            along,
            across,
            along_along: (1.0 / 3.0) * (along - self.square * both - weight * long),
            both,
            across_across,
        }
    }
}
