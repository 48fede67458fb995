//! Square root by the FPU's instruction where there is one.

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
        super::super::other::sqrt(x)
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
