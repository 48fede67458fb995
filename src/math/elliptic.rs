//! Elliptic integrals and the arcsine, for set-up and constants.

use core::f32::consts::FRAC_PI_2;

use super::constant;

/// Steps of the arithmetic-geometric mean: each squares the relative difference of the two means.
const MEAN_STEPS: u8 = 5;

const ARC_SINE_STEPS: u8 = 6;

/// Steps of Carlson's duplication: each divides the spread of the arguments by four.
const DUPLICATIONS: u8 = 9;

/// Panels of [`narrow_integral`], each half as long as its distance from zero: up to 1300 times the lower limit.
const PANELS: u8 = 18;

/// Gauss-Legendre nodes on -1 to 1 and their weights.
#[doc(hidden)]
pub const GAUSS: [(f32, f32); 5] = [
    (-0.906_179_85, 0.236_926_88),
    (-0.538_469_3, 0.478_628_67),
    (0.0, 0.568_888_9),
    (0.538_469_3, 0.478_628_67),
    (0.906_179_85, 0.236_926_88),
];

/// Complete elliptic integrals of the modulus `e = sqrt(1 - k^2)`.
pub struct Complete {
    /// First kind, `K`.
    pub first: f32,
    /// Second kind, `E`.
    pub second: f32,
    /// `(1 - e^2/2 - E/K)/e^4`: near a circle, where it is 1/16, differences of `K` and `E` over powers of `e`
    /// ([`FrictionMap`](crate::contact::FrictionMap)) lose no digits with it.
    pub tail: f32,
}

/// Complete elliptic integrals of an ellipse with the axis ratio `k`, 0.001 to 1, by the arithmetic-geometric mean:
/// `K = pi/(2 mean)` and `E = K (1 - e^2/2 - sum)`, with the sum of `2^(i-1) c_i^2` from `i = 1` on and half the differences `c_i` of the two
/// means (Abramowitz and Stegun 17.6), whose factor `e^2` the tail leaves out.
pub const fn complete(k: f32) -> Complete {
    let eccentricity2 = (1.0 - k) * (1.0 + k);
    let mut arithmetic = 1.0;
    let mut geometric = k;
    let mut sum = 0.5 * (1.0 - k) * (1.0 + k);
    // c_1/e^2, and from then on c_(i+1) = c_i^2/(4 mean_(i+1)).
    let mut reduced = 0.5 / (1.0 + k);
    let mut tail = 0.0;
    let mut weight = 1.0;
    let mut step = 0;
    while step < MEAN_STEPS {
        let half_difference = 0.5 * (arithmetic - geometric);
        let mean = 0.5 * (arithmetic + geometric);
        if step > 0 {
            reduced = reduced * reduced * eccentricity2 / (4.0 * mean);
        }
        geometric = constant::sqrt(arithmetic * geometric);
        arithmetic = mean;
        sum += weight * half_difference * half_difference;
        tail += weight * reduced * reduced;
        weight *= 2.0;
        step += 1;
    }
    let first = FRAC_PI_2 / arithmetic;
    Complete {
        first,
        second: first * (1.0 - sum),
        tail,
    }
}

/// Two integrals from which the friction of a contact follows (`C1` and `C2` in `contact/integrals.rs`), over `s`
/// from `lambda` to infinity, with the axis ratio's square `k²`, here `square`:
///
/// ```text
/// C1 = ∫ T/(1 + s) ds     C2 = ∫ T/(k² + s) ds     T = sqrt(s/((1 + s)(k² + s)))
/// ```
///
/// They are `2 R_F - 2/3 R_D` and `2 R_F - 2/3 k² R_D` with Carlson's integrals of the arguments `lambda`, `k² + lambda`,
/// `1 + lambda`, the last of `R_D` being `1 + lambda` for `C1` and `k² + lambda` for `C2`, by his duplication.
pub(crate) const fn incomplete(square: f32, lambda: f32) -> (f32, f32) {
    let (mut x, mut y, mut z) = (lambda, square + lambda, 1.0 + lambda);
    let mut weight = 1.0;
    let (mut long, mut short) = (0.0, 0.0);
    let mut duplication = 0;
    while duplication < DUPLICATIONS {
        let (a, b, c) = (constant::sqrt(x), constant::sqrt(y), constant::sqrt(z));
        let step = a * b + b * c + c * a;
        long += weight / (c * (z + step));
        short += weight / (b * (y + step));
        weight *= 0.25;
        x = 0.25 * (x + step);
        y = 0.25 * (y + step);
        z = 0.25 * (z + step);
        duplication += 1;
    }
    let (mean_long, mean_short) = (0.2 * (x + y + 3.0 * z), 0.2 * (x + z + 3.0 * y));
    let first = 2.0 / constant::sqrt((x + y + z) * (1.0 / 3.0));
    let long = 3.0 * long + weight / (mean_long * constant::sqrt(mean_long));
    let short = 3.0 * short + weight / (mean_short * constant::sqrt(mean_short));
    (
        first - (2.0 / 3.0) * long,
        first - (2.0 / 3.0) * square * short,
    )
}

/// A third one (`C5` in `contact/integrals.rs`), `∫ T/(k² + s)² ds`, over `s` from `root²` to infinity, by Gauss-Legendre quadrature in `sqrt(s)`.
pub(crate) const fn narrow_integral(square: f32, root: f32) -> f32 {
    let mut sum = 0.0;
    let mut end = root;
    let mut panel = 0;
    while panel < PANELS {
        let mut point = 0;
        while point < GAUSS.len() {
            let (node, weight) = GAUSS[point];
            let part = 0.5 * (1.0 + node);
            let r = end * (1.0 + 0.5 * part);
            let r2 = r * r;
            let short = 1.0 / (square + r2);
            let value = 2.0 * r2 * short * short * constant::sqrt(short / (1.0 + r2));
            sum += 0.25 * weight * end * value;
            point += 1;
        }
        end *= 1.5;
        panel += 1;
    }
    sum
}

/// `asin(x)` for `x` in 0 to 0.9, by Newton's method from `x`.
pub(crate) const fn arc_sine(x: f32) -> f32 {
    let mut angle = x;
    let mut step = 0;
    while step < ARC_SINE_STEPS {
        let (sin, cos) = constant::sin_cos(angle);
        angle += (x - sin) / cos;
        step += 1;
    }
    angle
}
