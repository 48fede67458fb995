//! The ball of a ball screw: a third contact, slip across the track, and what follows from them.

mod row;

pub use row::{GrooveFit, ScrewBallLoop, ScrewRow, ScrewTick};
pub(crate) use row::{LoopSums, largest_deviation};
