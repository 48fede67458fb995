//! The ball of a ball screw in closed form, for comparison: a third contact, slip across the track, and what follows from them. No step runs it.

mod row;
mod tick;

pub use row::{GrooveFit, RowContacts, ScrewRow};
pub(crate) use tick::largest_deviation;
pub use tick::{ScrewTick, ScrewTickBall};
