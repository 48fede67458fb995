//! Scalar kernels in f32: square root, cube root and its square, sine and cosine.
//!
//! | kernel | largest error: own | `libm` | `micromath` |
//! |---|---|---|---|
//! | [`sqrt`] | correctly rounded (the FPU's instruction) | correctly rounded | 6.1e-2 relative |
//! | [`cbrt`] | 0.52 ulp | 0.5 ulp | 4e-2 relative |
//! | [`cbrt_squared`] | 0.54 ulp | 2 ulp | 8e-2 relative |
//! | [`sin_cos`] | 6.3e-8 absolute, 2.0e-7 relative | 6e-8 absolute | 1.1e-3 absolute |
//!
//! The figures of our own are those of a sweep over every positive finite f32 (angles: every one up to 2 pi). `libm` computes cube root, sine and
//! cosine in double precision: over a thousand instructions each on a Cortex-M4F. Our own have one table of 320 bytes, for sine and cosine.
//!
//! The features `libm` and `micromath` replace cube root, sine and cosine by theirs, `micromath` also the square root where the target has no
//! instruction for one; with both `libm` serves. Set-up calls the functions of [`constant`], so that the compiler can do all of it.

pub mod constant;
pub mod elliptic;
pub mod own;

#[cfg(feature = "libm")]
mod libm;
#[cfg(all(feature = "micromath", not(feature = "libm")))]
mod micromath;
#[doc(hidden)]
pub mod powers;
mod sqrt;

#[cfg(feature = "libm")]
use self::libm as backend;
#[cfg(all(feature = "micromath", not(feature = "libm")))]
use self::micromath as backend;
#[cfg(not(any(feature = "libm", feature = "micromath")))]
use own as backend;

pub(crate) use powers::inverse_cube_roots;
pub use sqrt::sqrt;
pub(crate) use sqrt::sqrt_pair;

/// Cube root of any number, odd. Own backend: at most 0.52 ulp over every finite f32; zeros keep their sign, infinities are returned, NaN gives NaN.
#[inline]
pub fn cbrt(x: f32) -> f32 {
    backend::cbrt(x)
}

/// Square of the cube root, `|x|^(2/3)`. Own backend: at most 0.54 ulp over every finite f32. Zeros give 0, infinities infinity, NaN NaN.
#[inline]
pub fn cbrt_squared(x: f32) -> f32 {
    backend::cbrt_squared(x)
}

/// Cube root and its square, for little more than the price of one.
#[inline]
pub fn cbrt_and_squared(x: f32) -> (f32, f32) {
    backend::cbrt_and_squared(x)
}

/// Sine and cosine of an angle, rad.
///
/// Own backend: for `|x| <= 2 pi` at most 6.3e-8 absolute and 2.0e-7 relative, also next to the zeros; for `|x| <= 8192` at most
/// 9e-8 absolute. A finite angle beyond gives `(0, 1)`, NaN and infinities NaN. The sine of either zero is +0.
#[inline]
pub fn sin_cos(x: f32) -> (f32, f32) {
    backend::sin_cos(x)
}

#[cfg(all(test, feature = "libm", feature = "micromath"))]
mod tests {
    /// To the bit: `micromath` errs by percents.
    #[test]
    fn libm_serves_of_two_backends() {
        for x in [2.0_f32, -0.3, 1e-20, 7e9] {
            assert_eq!(super::cbrt(x).to_bits(), ::libm::cbrtf(x).to_bits());
        }
        assert_eq!(super::sin_cos(1.0), ::libm::sincosf(1.0));
    }
}
