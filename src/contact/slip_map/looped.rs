//! Friction of a contact that slips in any direction and spins, for the balls that a step renews.

use super::nodes::{FAR, Variable, divided_differences, quartic};
use crate::contact::integrals::checked_axis_ratio;
use crate::error::{Error, attempt};
use crate::math::elliptic::incomplete;
use crate::math::{self, constant};

/// Terms of the two polynomials.
const TERMS: usize = 8;

/// Chebyshev points in the order of Leja, in which divided differences lose no digits.
const CHEBYSHEV: [f32; TERMS] = [
    0.980_785_3,
    -0.980_785_3,
    -0.195_090_32,
    0.555_570_23,
    -0.555_570_23,
    0.831_469_6,
    -0.831_469_6,
    0.195_090_32,
];

/// Friction of one contact with slip along both axes and spin, with two polynomials of eight terms and one division.
///
/// Of the five integrals of `contact/integrals.rs` two are interpolated, `C4` and `C5`; the others are sums of
/// positive terms, with `w = 2 lambda T` and the factors `l = 1 + lambda` and `s = k² + lambda`:
///
/// ```text
/// C3 = k² C5 + (1 - k²) w/(3 l s)    C1 = k² C4 + 3 C3 + w/l    C2 = C4 + 3 k² C5 + w/s    C0 = w + C1 + k² C2
/// ```
///
/// These are the integrations by parts of the integrals (3.16)-(3.18) and (3.68) of Lin 2019.
///
/// Largest errors against the integrals: forces 2.6e-4 of their limit from an axis ratio of 0.15 on, 8.3e-4 from 0.1 on, and
/// 4.3e-4 where the velocity centre is more than two semi-major axes away; second derivatives 5.5e-4 of the sum of those by
/// both slips, 7.8e-3 just beyond two semi-major axes.
///
/// All is done in squares of speeds, the spin's being that of the end of the ellipse, `a W`: then one division
/// serves all quotients.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct LoopSlipMap {
    /// `k = b/a`, 0.02 to 0.95.
    axis_ratio: f32,
    /// `k²`, `(1 - k²)/3`.
    square: f32,
    third_eccentricity: f32,
    /// `sqrt(k)`, and the factor with which the interpolation's variable runs from -1 to 1.
    scale: f32,
    stretch: f32,
    /// `C0` to `C5` inside the ellipse, without unit as all here.
    inside: [f32; 6],
    /// Polynomials of `C4` and `C5`, lowest power first, times `(sqrt(lambda) + sqrt(k)) sqrt(l s)` and
    /// `(sqrt(lambda) + sqrt(k)) s`.
    fourth: [f32; TERMS],
    fifth: [f32; TERMS],
    /// Coefficients of the multipole series' second term.
    quartic: [f32; 3],
}

/// Integrals over the ellipse of a contact, by squares of speeds, that its friction and the second derivatives are made of. Speeds
/// are in the unit of the slips that come in.
struct Integrals {
    /// 1 / the speed `a W` of the spin at the end of the ellipse, 1/speed.
    inverse_end: f32,
    /// `C0`, `C1`, `C2`.
    whole: f32,
    first: f32,
    second: f32,
    /// `C3`, `C4`, `C5` over `(a W)²`, 1/speed².
    third: f32,
    fourth: f32,
    fifth: f32,
}

/// Friction of one contact over its limit `mu F`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct LoopSlip {
    /// Derivatives of the potential by slip across and along the track, -1 to 1, and by spin, in the unit of length of the slips.
    pub(crate) across: f32,
    pub(crate) along: f32,
    pub(crate) moment: f32,
    /// Second derivatives by the slips, 1/speed.
    pub(crate) across_across: f32,
    pub(crate) mixed: f32,
    pub(crate) along_along: f32,
    /// Spin over the square of `W`, 1/spin: slips times it keep the velocity centre where it is.
    pub(crate) tilt: f32,
    /// Second derivative along the spin that the stick treatment adds, length over spin.
    pub(crate) stick: f32,
}

/// Slips, spin and size of a contact: in m/s, rad/s and m, or over a common length and the nut's speed, as elastic balls have them.
#[derive(Clone, Copy)]
pub(crate) struct Slips {
    /// Slip across and along the track.
    pub(crate) across: f32,
    pub(crate) along: f32,
    /// Spin about the normal.
    pub(crate) spin: f32,
    /// Square of the spin below which the contact sticks, above 0.
    pub(crate) stick: f32,
    /// Square of the semi-major axis, above 0.
    pub(crate) size: f32,
}

impl LoopSlipMap {
    /// Maps of a contact with the axis ratio `b/a`. For set-up: it evaluates elliptic integrals at nine places.
    ///
    /// # Errors
    /// [`Error`] naming `axis_ratio` where it is not within 0.02 to 0.95.
    pub const fn new(axis_ratio: f32) -> Result<Self, Error> {
        let k = attempt!(checked_axis_ratio(axis_ratio));
        let square = k * k;
        let eccentricity = (1.0 - k) * (1.0 + k);
        let variable = Variable::new(k);
        let mut fourth = [0.0; TERMS];
        let mut fifth = [0.0; TERMS];
        let mut point = 0;
        while point < TERMS {
            let node = variable.at(CHEBYSHEV[point]);
            let (long, short) = (1.0 + node.lambda, square + node.lambda);
            fourth[point] =
                (node.second - node.first) / eccentricity * node.sum * constant::sqrt(long * short);
            fifth[point] = node.fifth * node.sum * short;
            point += 1;
        }
        let (along, across) = incomplete(square, 0.0);
        let both = (across - along) / eccentricity;
        let inside = [
            along + square * across,
            along,
            across,
            (along - square * both) / 3.0,
            both,
            (across - both) / (3.0 * square),
        ];
        Ok(Self {
            axis_ratio: k,
            square,
            third_eccentricity: eccentricity / 3.0,
            scale: variable.scale,
            stretch: variable.stretch(),
            inside,
            fourth: polynomial(fourth),
            fifth: polynomial(fifth),
            quartic: quartic(square),
        })
    }

    /// Friction under slips and a spin; `size` and `stick` must be positive.
    #[inline(always)]
    pub(crate) fn at(&self, slips: &Slips) -> LoopSlip {
        let &Slips {
            across,
            along,
            spin,
            stick,
            size,
        } = slips;
        let squares = (along * along, across * across);
        let rim = spin * spin + stick;
        let end2 = size * rim;
        let distance2 = squares.0 + squares.1;
        if distance2 <= FAR * end2 {
            self.near(slips, squares, distance2, end2)
        } else {
            self.far(slips, squares, distance2, end2)
        }
    }

    /// The velocity centre lies in the ellipse or near it.
    #[inline(always)]
    fn near(
        &self,
        slips: &Slips,
        (along2, across2): (f32, f32),
        distance2: f32,
        end2: f32,
    ) -> LoopSlip {
        let beyond = self.square * (along2 - end2) + across2;
        let Integrals {
            inverse_end,
            whole,
            first,
            second,
            third,
            fourth,
            fifth,
        } = if beyond > 0.0 {
            self.outside(beyond, distance2, end2)
        } else {
            self.within(end2)
        };
        let (a, b, c, d) = (
            third * along2,
            fourth * across2,
            fifth * across2,
            fourth * along2,
        );
        let scale = 0.75 * inverse_end;
        let (along, across) = (scale * (first - a - b), scale * (second - d - c));
        let twice = scale + scale;
        let inverse2 = inverse_end * inverse_end;
        let arm = 0.1875
            * inverse_end
            * (whole
                + inverse2
                    * (along2 * (3.0 * (a + b + b) - (first + first))
                        + across2 * (3.0 * c - (second + second))));
        let arm = slips.size * arm;
        let inverse_rim = slips.size * inverse2;
        LoopSlip {
            across: across * slips.across,
            along: along * slips.along,
            moment: arm * slips.spin,
            across_across: across - twice * c,
            mixed: -twice * fourth * (slips.along * slips.across),
            along_along: along - twice * a,
            tilt: slips.spin * inverse_rim,
            stick: arm * slips.stick * inverse_rim,
        }
    }

    /// The velocity centre lies outside of the ellipse, `beyond` its edge.
    #[inline(always)]
    fn outside(&self, beyond: f32, distance2: f32, end2: f32) -> Integrals {
        // lambda² + 2 excess lambda - beyond end² = 0.
        let excess = 0.5 * (end2 + self.square * end2 - distance2);
        let (end, distance) = math::sqrt_pair(end2, excess * excess + beyond * end2);
        let lambda = distance - excess;
        let (long, short) = (end2 + lambda, self.square * end2 + lambda);
        let (root, product) = math::sqrt_pair(lambda, long * short);
        let sum = root + self.scale * end;
        // One division for three reciprocals.
        let (sum_end, sum_product) = (sum * end, sum * product);
        let all = 1.0 / (sum_end * product);
        let inverse_end = all * sum_product;
        let inverse_product = all * sum_end;
        let inverse_sum = all * (end * product);
        let place = self.stretch * (root * inverse_sum) - 1.0;
        let (p4, p5) = self.polynomials(place);
        let scaled = end * inverse_sum * inverse_product;
        let weight = 2.0 * lambda * root * inverse_product * inverse_end;
        let inverse2 = inverse_product * inverse_product;
        let (over_long, over_short) = (weight * (short * inverse2), weight * (long * inverse2));
        let fourth = p4 * scaled;
        let fifth = p5 * scaled * (long * inverse_product);
        let narrow = self.square * fifth;
        let third = narrow + self.third_eccentricity * end2 * (weight * inverse2);
        let first = end2 * (self.square * fourth + 3.0 * third + over_long);
        let second = end2 * (fourth + 3.0 * narrow + over_short);
        let whole = weight + first + self.square * second;
        Integrals {
            inverse_end,
            whole,
            first,
            second,
            third,
            fourth,
            fifth,
        }
    }

    /// The velocity centre lies in the ellipse.
    #[inline(always)]
    fn within(&self, end2: f32) -> Integrals {
        let inverse_end = 1.0 / math::sqrt(end2);
        let inverse2 = inverse_end * inverse_end;
        let [whole, first, second, c3, c4, c5] = self.inside;
        Integrals {
            inverse_end,
            whole,
            first,
            second,
            third: c3 * inverse2,
            fourth: c4 * inverse2,
            fifth: c5 * inverse2,
        }
    }

    /// The polynomials of `C4` and `C5` at a place from -1 to 1, side by side.
    #[inline(always)]
    fn polynomials(&self, place: f32) -> (f32, f32) {
        let [a0, a1, a2, a3, a4, a5, a6, a7] = self.fourth;
        let [b0, b1, b2, b3, b4, b5, b6, b7] = self.fifth;
        let (p, q) = (a7 * place + a6, b7 * place + b6);
        let (p, q) = (p * place + a5, q * place + b5);
        let (p, q) = (p * place + a4, q * place + b4);
        let (p, q) = (p * place + a3, q * place + b3);
        let (p, q) = (p * place + a2, q * place + b2);
        let (p, q) = (p * place + a1, q * place + b1);
        (p * place + a0, q * place + b0)
    }

    /// The velocity centre lies far away: the distance itself and two terms of the multipole series.
    #[inline(always)]
    fn far(
        &self,
        slips: &Slips,
        (along2, across2): (f32, f32),
        distance2: f32,
        end2: f32,
    ) -> LoopSlip {
        let distance = math::sqrt(distance2);
        // One division for both reciprocals.
        let both = 1.0 / (distance * end2);
        let (inverse, inverse_end2) = (both * end2, both * distance);
        let inverse2 = inverse * inverse;
        let (n2, t2) = (along2 * inverse2, across2 * inverse2);
        let size = end2 * inverse2;
        let [c3, c4, c5] = self.quartic;
        // Mean squares of the ellipse are 1/5 and k²/5 of the semi-major axis.
        let (wide, narrow) = (0.2 * size, 0.2 * self.square * size);
        let second = 0.5 * (wide * t2 + narrow * n2);
        let size2 = size * size;
        let (u, v) = ((c3 * n2 + c4 * t2) * size2, c5 * t2 * size2);
        let fourth = u * n2 + v * t2;
        let down = 1.0 - (3.0 * second + 7.0 * fourth);
        let mixed = 2.0 * c4 * size2;
        let along = inverse * (down + narrow + 4.0 * c3 * n2 * size2 + mixed * t2);
        let across = inverse * (down + wide + 4.0 * v + mixed * n2);
        let fade = 15.0 * second - 1.0;
        let base = 1.0 - 3.0 * second;
        let arm = slips.size * inverse_end2 * distance * (2.0 * second + 4.0 * fourth);
        let inverse_rim = slips.size * inverse_end2;
        LoopSlip {
            across: across * slips.across,
            along: along * slips.along,
            moment: arm * slips.spin,
            across_across: inverse * (base + wide + t2 * (fade - 6.0 * wide)),
            mixed: (slips.along * slips.across)
                * (inverse * inverse2)
                * (fade - 3.0 * (narrow + wide)),
            along_along: inverse * (base + narrow + n2 * (fade - 6.0 * narrow)),
            tilt: slips.spin * inverse_rim,
            stick: arm * slips.stick * inverse_rim,
        }
    }
}

/// Powers, lowest first, of the polynomial with these values at the nodes: Newton's divided differences, multiplied out.
const fn polynomial(values: [f32; TERMS]) -> [f32; TERMS] {
    let values = divided_differences(values, &CHEBYSHEV);
    let mut powers = [0.0; TERMS];
    let mut node = TERMS;
    while node > 0 {
        node -= 1;
        // powers (x - node) + difference
        let mut power = TERMS - 1;
        while power > 0 {
            powers[power] = powers[power - 1] - CHEBYSHEV[node] * powers[power];
            power -= 1;
        }
        powers[0] = values[node] - CHEBYSHEV[node] * powers[0];
    }
    powers
}

#[cfg(test)]
mod tests;
