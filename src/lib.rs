//! placeholder
#![no_std]

pub mod ball;
pub mod contact;
pub mod error;
pub mod math;

pub use ball::*;
pub use contact::*;
pub use error::{Error, Range};
/// Placeholder, replaced by the model's fault flags.
pub struct Faults;
