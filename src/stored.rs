//! State as bytes: what a model knows when the ignition goes off, for the next time that it goes on.
//!
//! Called outside the interrupt, by firmware that keeps the state; a scene that is not kept links nothing of it.
//! [`FrictionModel::export`](crate::FrictionModel::export) and
//! [`FrictionModel::import`](crate::FrictionModel::import) are made of it.
//!
//! # Block
//!
//! Numbers are little-endian, an `f32` is stored as its bits.
//!
//! | bytes | what |
//! |---|---|
//! | 0 to 3 | `EPAF` |
//! | 4, 5 | version of the layout, [`VERSION`] |
//! | 6, 7 | kind of scene |
//! | 8, 9 | number of balls in the circuit, 0 without one |
//! | 10, 11 | length of the whole block |
//! | 12 to 15 | fingerprint of the constants that the state is read with |
//! | 16 on | the state |
//! | last 4 | [`crc32`] of all before |
//!
//! A block is refused for the first of these that is wrong: its first bytes, its version, its length, its checksum, its scene, its
//! balls, its constants, a number. A block with the right checksum but numbers that no model leaves is refused too.
//!
//! A state has one description, [`Stored::exchange`], which runs in both directions: what is written is what is read.

mod block;
mod checksum;
mod port;
mod refusal;

pub(crate) use block::{Block, OVERHEAD};
pub use block::{Label, VERSION};
pub(crate) use checksum::crc32_of_words;
pub use checksum::{Fingerprint, Fingerprinted, crc32};
pub use port::{Port, Stored};
pub use refusal::Refusal;
