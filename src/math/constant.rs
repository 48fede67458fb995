//! The kernels of set-up, which a constant can take: a design that is folded when firmware is compiled costs no
//! code and no time on the target, and one out of range does not compile.
//!
//! Cube root, sine and cosine are always our own here, whatever backend serves the loop.

pub use super::own::{cbrt, cbrt_squared, sin_cos};

/// Square root, correctly rounded, by integers: the same bits as [`math::sqrt`](super::sqrt), which a constant
/// cannot take because it is an instruction.
///
/// NaN and negative numbers give NaN; -0 gives -0; infinity gives infinity. Some 250 cycles on a Cortex-M4F: for
/// set-up only.
#[must_use]
pub const fn sqrt(x: f32) -> f32 {
    const TWO_TO_24: f32 = 16_777_216.0;
    // False for NaN.
    if x > 0.0 && x <= f32::MAX {
        if x < f32::MIN_POSITIVE {
            normal_root(x * TWO_TO_24) * (1.0 / 4096.0)
        } else {
            normal_root(x)
        }
    } else if x < 0.0 {
        f32::NAN
    } else {
        x
    }
}

/// Root of a positive normal number, a bit at a time: `root` grows as long as its square stays within the
/// significand, of which `remainder` is left.
const fn normal_root(x: f32) -> f32 {
    const SIGNIFICAND_BITS: u32 = 23;
    const BIAS: i32 = 127;
    let bits = x.to_bits();
    let exponent = (bits >> SIGNIFICAND_BITS) as i32 - BIAS;
    let one = 1 << SIGNIFICAND_BITS;
    let significand = (bits & (one - 1)) | one;
    // Where the exponent is odd, one factor of two goes to the significand, so that the exponent can be halved. One bit
    // more than the root has is found, for rounding.
    let mut remainder = significand << (1 + (exponent & 1));
    let (mut root, mut doubled) = (0, 0);
    let mut bit = one << 1;
    while bit != 0 {
        let grown = doubled + bit;
        if grown <= remainder {
            doubled = grown + bit;
            remainder -= grown;
            root += bit;
        }
        remainder <<= 1;
        bit >>= 1;
    }
    // The bit beyond the last decides alone: no square root lies half-way between two numbers.
    let rounded = (root + 1) >> 1;
    f32::from_bits(rounded + (((exponent >> 1) + BIAS - 1) as u32).wrapping_shl(SIGNIFICAND_BITS))
}
