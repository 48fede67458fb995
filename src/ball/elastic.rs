//! One ball of a ball screw in elastic grooves: its place, its motion, its friction, renewed step by step.
//!
//! | file | what | runs in |
//! |---|---|---|
//! | `constants` | what all balls of a screw have in common | set-up |
//! | `grooves` | both grooves with their contacts, folded once | set-up |
//! | `contact` | one contact: load, friction, and what it adds to the equations | every renewal |
//! | `equations` | the seven equations of a ball and their solution | every renewal |
//! | `law` | what a ball does between two renewals | every tick |
//! | `load_law` | friction of a nominal ball over the load | start; every tick |
//! | `nominal` | a ball that stands for all that are alike | start; every tick |
//! | `renewal` | one Newton step of place and motion together | every renewal |
//! | `resistance` | rolling resistance of all contacts | every renewal |
//! | `ring` | balls that are renewed in turn | every tick |
//! | `start` | place and motion from nothing | start, reversal |
//! | `stored` | states as bytes | around ignition |

pub(crate) mod constants;
mod contact;
mod equations;
mod grooves;
pub(crate) mod law;
pub(crate) mod load_law;
pub(crate) mod nominal;
mod renewal;
mod resistance;
pub(crate) mod ring;
mod start;
mod stored;

pub use grooves::ElasticGrooves;
pub use renewal::{BallInputs, Renewal, Settled};
