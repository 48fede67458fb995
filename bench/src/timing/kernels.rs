//! The scalar kernels of each backend, as the crate has them.

pub use epas_friction::math::own;

#[path = "../../../src/math/libm.rs"]
#[allow(dead_code)]
pub mod libm;

#[path = "../../../src/math/micromath.rs"]
#[allow(dead_code)]
pub mod micromath;
