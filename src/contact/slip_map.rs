//! Friction of a Hertzian contact that slips in any direction and spins.
//!
//! | file | what | runs in |
//! |---|---|---|
//! | `looped` | the map (`LoopSlipMap`) | step of both ball screws; made at set-up |
//! | `nodes` | where the integrals are sampled, and the series of the far field | set-up of `looped` |

pub(crate) mod looped;
mod nodes;
