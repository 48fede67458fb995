//! The train of balls: ball-to-ball contacts, clusters, recirculation.
//!
//! | | what it is |
//! |---|---|
//! | [`Press`] | forces between balls from their free speeds, compliances and distances: one exact pass |
//! | [`Train`] | the balls' positions on a closed track, and a tick that moves them |

mod ball;
mod intake;
mod pool;
mod press;
mod track;

pub use press::{IMPEDANCE_RANGE, LARGEST_FREE_SPEED, Press};
pub(crate) use track::Track;
pub use track::{BallContact, LARGEST_TRAVEL, Train};
