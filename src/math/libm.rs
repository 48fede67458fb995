//! The kernels by `libm`: accurate, in soft double precision on a Cortex-M4F.

/// Cube root.
#[inline]
#[must_use]
pub fn cbrt(x: f32) -> f32 {
    ::libm::cbrtf(x)
}

/// Square of the cube root.
#[inline]
#[must_use]
pub fn cbrt_squared(x: f32) -> f32 {
    let root = ::libm::cbrtf(x);
    root * root
}

/// Cube root and its square.
#[inline]
#[must_use]
pub fn cbrt_and_squared(x: f32) -> (f32, f32) {
    let root = ::libm::cbrtf(x);
    (root, root * root)
}

/// Sine and cosine.
#[inline]
#[must_use]
pub fn sin_cos(x: f32) -> (f32, f32) {
    ::libm::sincosf(x)
}
