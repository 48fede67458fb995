//! Scalar kernels (placeholder bodies; the interface stays).

/// Square root.
#[inline]
pub fn sqrt(x: f32) -> f32 {
    libm::sqrtf(x)
}
/// Cube root, odd in `x`.
#[inline]
pub fn cbrt(x: f32) -> f32 {
    libm::cbrtf(x)
}
/// Square of the cube root.
#[inline]
pub fn cbrt_squared(x: f32) -> f32 {
    let c = libm::cbrtf(x);
    c * c
}
/// Sine and cosine.
#[inline]
pub fn sin_cos(x: f32) -> (f32, f32) {
    (libm::sinf(x), libm::cosf(x))
}
