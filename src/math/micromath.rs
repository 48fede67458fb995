//! The kernels by `micromath`: small and fast, with errors of percents.

use ::micromath::F32Ext;

/// Square root.
#[inline]
#[allow(dead_code)] // Only where the target has no instruction for it.
pub fn sqrt(x: f32) -> f32 {
    F32Ext::sqrt(x)
}

/// Cube root.
#[inline]
pub fn cbrt(x: f32) -> f32 {
    if x == 0.0 || !x.is_finite() {
        return x;
    }
    F32Ext::powf(x.abs(), 1.0 / 3.0).copysign(x)
}

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

/// Sine and cosine.
#[inline]
pub fn sin_cos(x: f32) -> (f32, f32) {
    (F32Ext::sin(x), F32Ext::cos(x))
}
