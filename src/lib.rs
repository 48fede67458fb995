//! placeholder
#![no_std]

pub mod error;
pub mod kinematics;
pub mod math;

pub use error::{Error, Range};
/// Placeholder, replaced by the model's fault flags.
pub struct Faults;
