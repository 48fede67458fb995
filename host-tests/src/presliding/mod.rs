//! Friction before sliding.

pub mod physics;
