//! The scalar kernels of each backend, as the crate has them.

pub use epas_friction::math::own;

/// The backend that the feature `libm` chooses.
#[path = "../../../src/math/libm.rs"]
#[allow(dead_code)]
pub mod libm;

/// The backend that the feature `micromath` chooses.
#[path = "../../../src/math/micromath.rs"]
#[allow(dead_code)]
pub mod micromath;
