//! Scenes of the crate as objects: one tick, or a whole trace.

pub mod caged;
pub mod columns;
pub mod remembering;
pub mod trains;
