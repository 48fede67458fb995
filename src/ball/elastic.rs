//! One ball of a ball screw in elastic grooves: its place, its motion, its friction, renewed step by step.
//!
//! | file | what | runs in |
//! |---|---|---|
//! | `grooves` | both grooves with their contacts, folded once | set-up |
//! | `contact` | one contact: load, friction, and what it adds to the equations | every renewal |
//! | `equations` | the seven equations of a ball and their solution | every renewal |
//! | `renewal` | one Newton step of place and motion together | every renewal |
//! | `ring` | balls that are renewed in turn, and their laws between | every tick |
//! | `start` | place and motion from nothing | start, reversal |

mod contact;
mod equations;
mod grooves;
mod renewal;
pub(crate) mod ring;
mod start;

pub use grooves::ElasticGrooves;
pub use renewal::{BallInputs, Renewal, Settled};
