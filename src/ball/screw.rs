//! The ball of a ball screw: a third contact, slip across the track, and what follows from them.

mod across;
mod row;

pub use row::{GrooveFit, LoadShare, ScrewBallLoop, ScrewRow, ScrewTick};
