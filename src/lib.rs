//! placeholder
#![no_std]

pub mod contact;
pub mod error;
pub mod math;

pub use contact::*;
pub use error::{Error, Range};
/// Published slope
pub const PUBLISHED_SLOPE: f32 = 1.38;
/// Placeholder, replaced by the model's fault flags.
pub struct Faults;
