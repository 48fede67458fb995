//! The train of balls: ball-to-ball contacts, clusters, recirculation.

mod press;

pub use press::{COMPLIANCE_RANGE, LARGEST_FREE_SPEED, Press};
