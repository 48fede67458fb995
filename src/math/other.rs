//! The kernels by `libm`, accurate, in soft double precision on a Cortex-M4F, or by `micromath`, small and fast, with errors of percents.

#[cfg(feature = "libm")]
mod kernels {
    pub use ::libm::{cbrtf as cbrt, sincosf as sin_cos};
}

#[cfg(not(feature = "libm"))]
mod kernels {
    use ::micromath::F32Ext;

    #[allow(dead_code)] // Only where the target has no instruction for it.
    #[inline]
    pub fn sqrt(x: f32) -> f32 {
        F32Ext::sqrt(x)
    }

    #[inline]
    pub fn cbrt(x: f32) -> f32 {
        if x == 0.0 || !x.is_finite() {
            return x;
        }
        F32Ext::powf(x.abs(), 1.0 / 3.0).copysign(x)
    }

    #[inline]
    pub fn sin_cos(x: f32) -> (f32, f32) {
        (F32Ext::sin(x), F32Ext::cos(x))
    }
}

pub use kernels::*;

#[inline]
pub fn cbrt_squared(x: f32) -> f32 {
    let root = cbrt(x);
    root * root
}

#[inline]
pub fn cbrt_and_squared(x: f32) -> (f32, f32) {
    let root = cbrt(x);
    (root, root * root)
}
