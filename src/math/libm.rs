//! The kernels by `libm`: accurate, in soft double precision on a Cortex-M4F.

pub use ::libm::{cbrtf as cbrt, sincosf as sin_cos};

/// Square of the cube root.
#[inline]
pub fn cbrt_squared(x: f32) -> f32 {
    let root = cbrt(x);
    root * root
}

/// Cube root and its square.
#[inline]
pub fn cbrt_and_squared(x: f32) -> (f32, f32) {
    let root = cbrt(x);
    (root, root * root)
}
