//! Our own kernels: single precision throughout, made for a core whose division takes 14 cycles, whose
//! fused multiply-add takes 3 and whose double precision is software.

/// Adding and subtracting it rounds to the nearest integer, and leaves that integer in the low bits.
const ROUND: f32 = 12_582_912.0; // 1.5 x 2^23

/// Largest angle, rad, that [`sin_cos`] reduces.
pub const LARGEST_ANGLE: f32 = 8192.0;

/// A cube root as `rough (1 + correction)` with `rough` of eight bits.
struct Root {
    rough: f32,
    correction: f32,
}

/// Cube root; see [`math::cbrt`](super::cbrt).
#[inline]
#[must_use]
pub fn cbrt(x: f32) -> f32 {
    if is_special(x) {
        return special(x).0;
    }
    let Root { rough, correction } = root(x.abs());
    (rough + rough * correction).copysign(x)
}

/// Square of the cube root; see [`math::cbrt_squared`](super::cbrt_squared).
#[inline]
#[must_use]
pub fn cbrt_squared(x: f32) -> f32 {
    if is_special(x) {
        return special(x).1;
    }
    squared(&root(x.abs()))
}

/// Cube root and its square; see [`math::cbrt_and_squared`](super::cbrt_and_squared).
#[inline]
#[must_use]
pub fn cbrt_and_squared(x: f32) -> (f32, f32) {
    if is_special(x) {
        return special(x);
    }
    let root = root(x.abs());
    (
        (root.rough + root.rough * root.correction).copysign(x),
        squared(&root),
    )
}

/// `rough²` is exact (16 bits), so that only the last sum rounds to a half ulp.
#[inline]
fn squared(root: &Root) -> f32 {
    let square = root.rough * root.rough;
    square + square * (root.correction * (2.0 + root.correction))
}

/// True for zeros, subnormals, infinities and NaN, of either sign.
#[inline]
fn is_special(x: f32) -> bool {
    const SMALLEST_NORMAL: u32 = 0x0080_0000;
    const NORMAL_SPAN: u32 = 0x7f00_0000;
    (x.to_bits() & 0x7fff_ffff).wrapping_sub(SMALLEST_NORMAL) >= NORMAL_SPAN
}

/// Cube root and its square where [`is_special`] holds.
#[cold]
fn special(x: f32) -> (f32, f32) {
    const SCALE: f32 = 16_777_216.0; // 2^24
    if x == 0.0 {
        (x, 0.0)
    } else if x.is_finite() {
        // A subnormal, brought to the normal range by a cube of two.
        let root = root(x.abs() * SCALE);
        (
            (root.rough + root.rough * root.correction).copysign(x) * (1.0 / 256.0),
            squared(&root) * (1.0 / 65_536.0),
        )
    } else {
        (x, x * x)
    }
}

/// Cube root of a positive normal number.
///
/// 1. `y`, about `x^(-1/3)`: the exponent divided by -3 in integers (error 3.5 %), then one step of
///    second order on `c = x y³` (error below 2^-12), without a division.
/// 2. `rough`: `x y²` rounded to eight bits, so that its cube is exact in 24 bits, and exact too is
///    `x - rough³`, the difference of two neighbours.
/// 3. With `e = (x - rough³) / rough³`, at most 0.0124: `(1 + e)^(1/3) = 1 + e/3 - e²/9 + 5 e³/81`,
///    cut off below 1e-9. The correction is small, its roundings smaller still; what is left is the
///    rounding of the caller's last sum.
#[inline]
fn root(x: f32) -> Root {
    const EXPONENT: u32 = 0x548c_2b4b;
    let start = f32::from_bits(EXPONENT - x.to_bits() / 3);
    let closeness = x * start * (start * start);
    let inverse = start * (1.752_319_7 - closeness * (1.250_952_4 - 0.509_381_83 * closeness));
    let rough = f32::from_bits(((x * inverse * inverse).to_bits() + 0x8000) & 0xffff_0000);

    let cube = rough * rough * rough;
    let excess = (x - cube) / cube;
    Root {
        rough,
        correction: excess * (0.333_333_34 - excess * (0.111_111_11 - excess * 0.061_728_396)),
    }
}

/// Sine and cosine; see [`math::sin_cos`](super::sin_cos).
///
/// The nearest multiple of pi/2 is taken away in four parts, the first three of so few bits that their
/// products and differences are exact: the rest keeps full relative precision, however small it is.
/// Sine and cosine of the rest, at most pi/4, are the classic minimax polynomials of Cephes; the
/// multiple's last two bits exchange them and set their signs without a branch.
#[inline]
#[must_use]
pub fn sin_cos(x: f32) -> (f32, f32) {
    const PART_1: f32 = 1.570_312_5;
    const PART_2: f32 = 4.837_512_969_970_703e-4;
    const PART_3: f32 = 7.549533620476723e-08;
    const PART_4: f32 = 2.5633440682570896e-12;

    if x.abs() > LARGEST_ANGLE || x.is_nan() {
        return if x.is_finite() {
            (0.0, 1.0)
        } else {
            (f32::NAN, f32::NAN)
        };
    }
    let shifted = x * core::f32::consts::FRAC_2_PI + ROUND;
    let multiple = shifted - ROUND;
    let quadrant = shifted.to_bits();
    let rest =
        ((x - multiple * PART_1) - multiple * PART_2) - multiple * PART_3 - multiple * PART_4;

    let square = rest * rest;
    let sin = rest
        + rest * (square * (-1.666_665_5e-1 + square * (8.332_161e-3 - square * 1.951_529_6e-4)));
    let cos = (1.0 - 0.5 * square)
        + (square * square)
            * (4.166_664_6e-2 + square * (-1.388_731_6e-3 + square * 2.443_315_7e-5));

    let exchange = quadrant & 1 != 0;
    let (for_sin, for_cos) = if exchange { (cos, sin) } else { (sin, cos) };
    let sin_sign = (quadrant & 2) << 30;
    let cos_sign = (quadrant.wrapping_add(1) & 2) << 30;
    (
        f32::from_bits(for_sin.to_bits() ^ sin_sign),
        f32::from_bits(for_cos.to_bits() ^ cos_sign),
    )
}
