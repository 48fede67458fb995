//! The ball of a ball screw: a third contact, slip across the track, and what follows from them.

mod contacts;
mod fit;
mod raceway;
mod row;
mod speeds;
mod tick;

pub use fit::GrooveFit;
pub use row::ScrewRow;
pub(crate) use speeds::largest_deviation;
pub use tick::{LoopBall, LoopSums, ScrewLoop, ScrewTick, ScrewTickBall};
