//! Friction of a Hertzian contact that slips in any direction and spins: set-up and near field, far field.
//!
//! | file | what | runs in |
//! |---|---|---|
//! | `looped` | all of it with fewer terms, near and far field of its own (`LoopSlipMap`) | step of both ball screws; made at set-up |
//! | `map` | [`SlipMap`], the exact one, and what it returns | direct: no scene links it; in `refined` the map of `ScrewBall` |
//! | `near` | its near field: velocity centre in the ellipse or within two semi-major axes | with `map` |
//! | `far` | its far field, beyond | with `map` |
//! | `potential` | what both fields return | with `map` |
//! | `nodes` | where the integrals are sampled, and the series of the far field | set-up of `looped` and of `map` |

mod far;
pub(crate) mod looped;
mod map;
pub(crate) mod near;
mod nodes;
mod potential;

pub use map::{SlipFriction, SlipMap};
