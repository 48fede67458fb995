//! Friction laws in use today beside the crate's elements that remember, over the same paths.
//!
//! Units are those of the reference: angles over the breakaway angle, torques over the limit under the reference load. All laws are taken without what depends
//! on speed (Stribeck curve, viscous part, damping of bristles): at the speeds of a reversal that adds nothing.
//!
//! | file | what |
//! |---|---|
//! | [`dahl`] | Dahl 1968 and LuGre (Canudas de Wit and others 1995), whose bristles are Dahl's; explicit and implicit steps |
//! | [`elasto_plastic`] | elasto-plastic bristles (Dupont and others 2002) |
//! | [`generalized`] | generalized Maxwell slip (Al-Bender, Lampaert and Swevers 2005) |
//! | [`multiplied`] | elements whose torque is multiplied by the load, as in tyre models |
//! | [`remembered`] | the crate's elements |
//! | [`candidates`] | all of them with their constants |
//! | [`fit`] | constants of the peers, as good as they can be |
//! | [`noise`] | counts of an encoder, and speeds at rest |
//! | [`paths`] | paths over which laws are compared |
//! | [`compare`] | what is compared |

pub mod candidates;
pub mod compare;
mod dahl;
mod elasto_plastic;
pub mod fit;
mod generalized;
mod multiplied;
pub mod noise;
pub mod paths;
mod remembered;

use epas_reference::presliding::answers::{Path, Tick};

/// A law of friction over angle, with what it remembers.
pub trait Law {
    /// Torque after a tick.
    fn follow(&mut self, tick: &Tick) -> f64;

    /// Stored energy, over limit times breakaway angle.
    fn energy(&self) -> f64;
}

/// Torques of a law over a path: one for every angle, the first zero.
pub fn torques(law: &mut dyn Law, path: &Path<'_>) -> Vec<f64> {
    std::iter::once(0.0)
        .chain(path.ticks().map(|tick| law.follow(&tick)))
        .collect()
}

/// Limit in the direction of a turn.
fn limit(tick: &Tick) -> f64 {
    if tick.turn < 0.0 {
        tick.limits.backward
    } else {
        tick.limits.forward
    }
}
