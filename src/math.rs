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

#[cfg(feature = "libm")]
use self::libm as backend;
#[cfg(all(feature = "micromath", not(feature = "libm")))]
use self::micromath as backend;
#[cfg(not(any(feature = "libm", feature = "micromath")))]
use own as backend;

pub(crate) use powers::inverse_cube_roots;

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

/// Square root, correctly rounded.
///
/// NaN and negative numbers give NaN (of unspecified sign); -0 gives -0; infinity gives infinity. One instruction on an Arm
/// core with a floating-point unit (14 cycles on a Cortex-M4F) and on x86-64; `libm` elsewhere.
#[inline]
pub fn sqrt(x: f32) -> f32 {
    target::sqrt(x)
}

/// Two square roots: on an Arm core fewer cycles together, because registers move while the other root is computed.
#[inline]
pub fn sqrt_pair(x: f32, y: f32) -> (f32, f32) {
    target::sqrt_pair(x, y)
}

#[cfg(all(target_arch = "arm", target_abi = "eabihf"))]
mod target {
    #[allow(unsafe_code)]
    #[inline(always)]
    pub fn sqrt_pair(x: f32, y: f32) -> (f32, f32) {
        let first: u32;
        let second: u32;
        // SAFETY: as below; `s1` is declared as overwritten, too.
        unsafe {
            core::arch::asm!(
                "vmov s0, {first}",
                "vmov s1, {second}",
                "vsqrt.f32 s0, s0",
                "vsqrt.f32 s1, s1",
                "vmov {first}, s0",
                "vmov {second}, s1",
                first = inout(reg) x.to_bits() => first,
                second = inout(reg) y.to_bits() => second,
                out("s0") _,
                out("s1") _,
                options(pure, nomem, nostack),
            );
        }
        (f32::from_bits(first), f32::from_bits(second))
    }

    /// No safe way leads to this instruction: `core::f32::math` is unstable, and the class of single-precision registers is refused.
    #[allow(unsafe_code)]
    #[inline(always)]
    pub fn sqrt(x: f32) -> f32 {
        let bits: u32;
        // SAFETY: the instruction reads and writes only the registers named here, and no memory. Every Arm target with the hard-float ABI has it. The
        // flags are not declared as preserved: an inexact root sets a sticky bit of FPSCR.
        unsafe {
            core::arch::asm!(
                "vmov s0, {value}",
                "vsqrt.f32 s0, s0",
                "vmov {value}, s0",
                value = inout(reg) x.to_bits() => bits,
                out("s0") _,
                options(pure, nomem, nostack),
            );
        }
        f32::from_bits(bits)
    }
}

#[cfg(all(target_arch = "x86_64", target_feature = "sse"))]
mod target {
    use core::arch::x86_64::{_mm_cvtss_f32, _mm_set_ss, _mm_sqrt_ss};

    #[allow(unsafe_code)]
    #[inline(always)]
    pub fn sqrt(x: f32) -> f32 {
        // SAFETY: SSE is enabled for the whole build, as the condition on this module says.
        unsafe { _mm_cvtss_f32(_mm_sqrt_ss(_mm_set_ss(x))) }
    }

    #[inline(always)]
    pub fn sqrt_pair(x: f32, y: f32) -> (f32, f32) {
        (sqrt(x), sqrt(y))
    }
}

#[cfg(not(any(
    all(target_arch = "arm", target_abi = "eabihf"),
    all(target_arch = "x86_64", target_feature = "sse")
)))]
mod target {
    #[cfg(all(feature = "micromath", not(feature = "libm")))]
    #[inline(always)]
    pub fn sqrt(x: f32) -> f32 {
        super::micromath::sqrt(x)
    }

    #[cfg(not(all(feature = "micromath", not(feature = "libm"))))]
    #[inline(always)]
    pub fn sqrt(x: f32) -> f32 {
        ::libm::sqrtf(x)
    }

    #[inline(always)]
    pub fn sqrt_pair(x: f32, y: f32) -> (f32, f32) {
        (sqrt(x), sqrt(y))
    }
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
