//! Friction of a Hertzian contact that slips in any direction and spins: set-up and near field, far field.

mod far;
pub(crate) mod looped;
mod map;
pub(crate) mod near;
mod nodes;
mod potential;

pub use map::{SlipFriction, SlipMap};
