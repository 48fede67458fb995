//! Friction of a Hertzian contact that slips in any direction and spins, in closed form.

use core::f32::consts::FRAC_1_SQRT_2;

use crate::error::{Error, attempt, in_range};
use crate::math::elliptic::{incomplete, narrow_integral};
use crate::math::{self, constant};

/// Points of interpolation of the two elliptic integrals.
const POINTS: usize = 10;

/// Chebyshev points in the order of Leja, in which Newton's form loses no digits.
const CHEBYSHEV: [f32; POINTS] = [
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

/// Square of the velocity centre's distance from the contact, in semi-major axes, from which the far
/// field serves.
const FAR: f32 = 4.0;

/// Largest `sqrt(lambda)` next to it.
const LARGEST_ROOT: f32 = 2.0;

/// Smallest axis ratio, that of a conformity of about 0.5005.
const SMALLEST_AXIS_RATIO: f32 = 0.02;

/// Largest axis ratio; beyond it differences of the elliptic integrals lose too many digits.
const LARGEST_AXIS_RATIO: f32 = 0.95;

/// Dissipation of one contact with slip along both axes and spin: exact.
///
/// A contact of ball and groove with semi-axes `a >= b = k a` slips with `V_1` along its major axis
/// (across the ball path), with `V_2` along its minor axis (along the path) and spins with `w`. Its power
/// loss is the mean distance of the velocity centre from the points of the ellipse, weighed by the
/// pressure:
///
/// ```text
/// D = mu F a |w| P(x, z)        x = V_2/(a w)        z = V_1/(a w)
/// P = 3/16 (C0 + 2 C1 x² + 2 C2 z² - C3 x⁴ - 2 C4 x² z² - C5 z⁴)
/// ```
///
/// The Laplacian of a distance is its reciprocal, and the mean of the reciprocal is the potential of a
/// Hertzian pressure, an integral over the confocal ellipses. Integrated twice:
///
/// ```text
/// C1 = ∫ T/(1 + s)   C2 = ∫ T/(k² + s)   C3 = ∫ T/(1 + s)²   C4 = ∫ T/((1 + s)(k² + s))
/// C5 = ∫ T/(k² + s)²    T = sqrt(s/((1 + s)(k² + s)))    s from lambda to infinity
/// ```
///
/// `lambda` is the largest root of `x²/(1 + lambda) + z²/(k² + lambda) = 1`, zero inside the ellipse: there
/// `P` is a polynomial. By parts all follow from `C1` and `C2`. The derivatives of `P` by `lambda` vanish up
/// to the second, so that force and Hessian are those of the polynomial as well. These are the integrals
/// (3.16)-(3.18) and (3.68) of Lin 2019, which that dissertation evaluates by quadrature.
///
/// `C1` and `C2` are combinations of Carlson's integrals; they and `C5` are found at set-up and interpolated in
/// `sqrt(lambda)/(sqrt(lambda) + sqrt(k))`. Beyond two semi-major axes two terms of the multipole series
/// serve.
///
/// Input: axis ratio 0.02 to 0.95 at set-up; slips and spins up to 1e15 in the loop.
///
/// Largest errors against quadrature of the contact integral, axis ratios 0.05 to 0.95, slips of any direction
/// from 1e-4 to 1e4 semi-major axes times the spin (rms in brackets): forces 3.1e-4 (1.2e-5) of their limit,
/// moment 3.1e-4 (1.5e-5) of `mu F a`, power 1.4e-4 (9e-6) of itself, second derivatives 3.7e-3 (1.8e-4) of the
/// sum of those by the two slips. From an axis ratio of 0.2 on forces are within 6e-5; at 0.02 within 1e-3.
/// The largest ones arise where the far field takes over.
///
/// Cost in the loop: three square roots and two divisions inside the contact, four and three outside, where
/// three polynomials of ten terms are evaluated.
///
/// ```
/// use epas_friction::contact::SlipMap;
/// let map = SlipMap::new(0.25)?;
/// let (semi_major, spin) = (2e-4, 20.0);
/// let spinning = map.dissipation(0.0, 0.0, spin, semi_major, 0.0);
/// assert!((spinning.moment / semi_major - 0.4021).abs() < 1e-4); // 3/8 E
/// let sliding = map.dissipation(3.0, 4.0, 0.0, semi_major, 0.0);
/// assert!((sliding.across - 0.6).abs() < 1e-5 && (sliding.along - 0.8).abs() < 1e-5);
/// # Ok::<(), epas_friction::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct SlipMap {
    axis_ratio: f32,
    square: f32,
    inverse_eccentricity: f32,
    /// `sqrt(k)`, and what brings the interpolation's variable to -1 to 1.
    scale: f32,
    stretch: f32,
    inside: Coefficients,
    first: [f32; POINTS],
    second: [f32; POINTS],
    fifth: [f32; POINTS],
    /// `C3`, `C4`, `C5` of the far field's quartic.
    quartic: [f32; 3],
}

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

/// `P` with its derivatives by `x` (along) and `z` (across), and `M = P - x P_x - z P_z`.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Potential {
    moment: f32,
    along: f32,
    across: f32,
    along_along: f32,
    mixed: f32,
    across_across: f32,
}

/// One contact at given slip and spin, over `mu F`.
///
/// The Hessian of the potential by slip and spin is the form with the three stiffnesses of `dV_1 - tilt_across
/// dw` and `dV_2 - tilt_along dw`, plus `stick dw²`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct SlipFriction {
    /// The potential, m/s; with no stick spin the power loss.
    pub potential: f32,
    /// Power loss, m/s: forces times slips and moment times spin.
    pub power: f32,
    /// Derivative by the slip across the track, -1 to 1.
    pub across: f32,
    /// Derivative by the slip along the track, -1 to 1.
    pub along: f32,
    /// Derivative by the spin, m.
    pub moment: f32,
    /// Second derivative by the slip across the track, s/m.
    pub stiffness_across: f32,
    /// Mixed second derivative by the two slips, s/m.
    pub stiffness_mixed: f32,
    /// Second derivative by the slip along the track, s/m.
    pub stiffness_along: f32,
    /// Slip across the track that keeps the velocity centre where it is, per spin, m.
    pub tilt_across: f32,
    /// Slip along the track that keeps the velocity centre where it is, per spin, m.
    pub tilt_along: f32,
    /// What the stick treatment adds along the spin, m s.
    pub stick: f32,
    /// `a W`: slip along the track that carries the velocity centre to the end of the ellipse, m/s.
    pub rim: f32,
}

impl SlipMap {
    /// Maps of a contact with the axis ratio `b/a`. For set-up: it evaluates elliptic integrals at eleven places.
    ///
    /// # Errors
    /// [`Error`] naming `axis_ratio` where it is not within 0.02 to 0.95.
    pub const fn new(axis_ratio: f32) -> Result<Self, Error> {
        let k = attempt!(checked_axis_ratio(axis_ratio));
        let square = k * k;
        let scale = constant::sqrt(k);
        let largest = LARGEST_ROOT / (LARGEST_ROOT + scale);
        let mut first = [0.0; POINTS];
        let mut second = [0.0; POINTS];
        let mut fifth = [0.0; POINTS];
        let mut point = 0;
        while point < POINTS {
            let part = 0.5 * (1.0 + CHEBYSHEV[point]) * largest;
            let root = scale * part / (1.0 - part);
            let lambda = root * root;
            let (along, across) = incomplete(square, lambda);
            let stretch = root + scale;
            first[point] = along * stretch;
            second[point] = across * stretch;
            let narrow = if lambda < square {
                let (long, short) = (1.0 + lambda, square + lambda);
                let weight = 2.0 * lambda * root / constant::sqrt(long * short);
                let both = (across - along) / ((1.0 - k) * (1.0 + k));
                (across - both - weight / short) / (3.0 * square)
            } else {
                narrow_integral(square, root)
            };
            fifth[point] = narrow * (square + lambda) * stretch;
            point += 1;
        }
        let (along, across) = incomplete(square, 0.0);
        let mut map = Self {
            axis_ratio: k,
            square,
            inverse_eccentricity: 1.0 / ((1.0 - k) * (1.0 + k)),
            scale,
            stretch: 2.0 / largest,
            inside: Coefficients {
                whole: 0.0,
                along: 0.0,
                across: 0.0,
                along_along: 0.0,
                both: 0.0,
                across_across: 0.0,
            },
            first: divided_differences(first),
            second: divided_differences(second),
            fifth: divided_differences(fifth),
            quartic: far_quartic(square),
        };
        let narrow = (across - (across - along) * map.inverse_eccentricity) / (3.0 * square);
        map.inside = map.complete(along, across, narrow, 0.0, 1.0);
        Ok(map)
    }

    /// Axis ratio of the ellipse.
    #[inline]
    #[must_use]
    pub const fn axis_ratio(&self) -> f32 {
        self.axis_ratio
    }

    /// Friction over `mu F` at a slip across and along the track, m/s, and a spin, rad/s, of a contact with the
    /// semi-major axis `a`, m, with stick treated smoothly as in
    /// [`FrictionMap::dissipation`](crate::contact::FrictionMap::dissipation): `|w|` becomes
    /// `W = sqrt(w² + stick_spin²)` in the potential.
    ///
    /// Slips are those at the contact's centre. The friction force on the ball is `-mu F across`,
    /// `-mu F along`, the moment `-mu F moment`. `semi_major` must be positive. Of slips that are infinite or no
    /// number the forces are those of sliding; potential and power then are none either.
    #[inline]
    #[must_use]
    pub fn dissipation(
        &self,
        across: f32,
        along: f32,
        spin: f32,
        semi_major: f32,
        stick_spin: f32,
    ) -> SlipFriction {
        let stick2 = stick_spin * stick_spin + 1e-30;
        let rim = semi_major * math::sqrt(spin * spin + stick2);
        let inverse_rim = 1.0 / rim;
        let inverse_spin = semi_major * inverse_rim;
        let inverse_spin2 = inverse_spin * inverse_spin;
        let at = self.at(along * inverse_rim, across * inverse_rim);

        let sliding = across * at.across + along * at.along;
        let arm = semi_major * at.moment;
        let spin_moment = arm * spin * inverse_spin;
        let tilt = spin * inverse_spin2;
        SlipFriction {
            potential: sliding + rim * at.moment,
            power: sliding + spin_moment * spin,
            across: at.across,
            along: at.along,
            moment: spin_moment,
            stiffness_across: at.across_across * inverse_rim,
            stiffness_mixed: at.mixed * inverse_rim,
            stiffness_along: at.along_along * inverse_rim,
            tilt_across: across * tilt,
            tilt_along: along * tilt,
            stick: arm * stick2 * inverse_spin * inverse_spin2,
            rim,
        }
    }

    /// Friction force over `mu F` under a slip across the track, where the spin moves the rim with `rim = a |w|`.
    #[inline]
    pub(crate) fn share_across(&self, slip: f32, rim: f32) -> f32 {
        let place = slip / rim;
        let square = place * place;
        if square <= FAR {
            let coefficients = if square <= self.square {
                self.inside
            } else {
                self.outside(square - self.square)
            };
            0.75 * place * (coefficients.across - coefficients.across_across * square)
        } else {
            self.far(0.0, place, square).across
        }
    }

    #[inline]
    fn at(&self, along: f32, across: f32) -> Potential {
        let (along2, across2) = (along * along, across * across);
        let distance2 = along2 + across2;
        // False for NaN.
        if distance2 <= FAR {
            // lambda² + excess lambda - rest = 0.
            let rest = self.square * (along2 - 1.0) + across2;
            let coefficients = if rest > 0.0 {
                let excess = 0.5 * (1.0 + self.square - distance2);
                let root = math::sqrt(excess * excess + rest);
                let lambda = if excess > 0.0 {
                    rest / (excess + root)
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
        } else {
            self.far(along, across, distance2)
        }
    }

    /// Two terms of the multipole series beyond the distance itself.
    #[inline]
    fn far(&self, along: f32, across: f32, distance2: f32) -> Potential {
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
        let narrow = 0.2 * self.square;
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

/// An axis ratio that the integrals are good for.
pub(super) const fn checked_axis_ratio(axis_ratio: f32) -> Result<f32, Error> {
    in_range(
        "axis_ratio",
        axis_ratio,
        SMALLEST_AXIS_RATIO,
        LARGEST_AXIS_RATIO,
    )
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

/// Mean of `p² (4 l² - p²)/8` with `l` along and `p` across the direction of the velocity centre: the
/// coefficients of `x⁴`, `x² z²`, `z⁴`. Fourth moments of a Hertzian pressure are 3/35, k²/35 and 3 k⁴/35.
const fn far_quartic(square: f32) -> [f32; 3] {
    let (long, mixed, short) = (3.0 / 35.0, square / 35.0, 3.0 * square * square / 35.0);
    [
        0.125 * (4.0 * mixed - short),
        0.125 * (4.0 * long + 4.0 * short - 22.0 * mixed),
        0.125 * (4.0 * mixed - long),
    ]
}

const fn divided_differences(mut values: [f32; POINTS]) -> [f32; POINTS] {
    let mut order = 1;
    while order < POINTS {
        // Backwards, so that what stands before a value is still of the order below.
        let mut place = POINTS - 1;
        while place >= order {
            values[place] =
                (values[place] - values[place - 1]) / (CHEBYSHEV[place] - CHEBYSHEV[place - order]);
            place -= 1;
        }
        order += 1;
    }
    values
}
