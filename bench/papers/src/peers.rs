//! Friction laws in use today beside the crate's elements that remember, over the same paths.
//!
//! Units are those of the reference: angles over the breakaway angle, torques over the limit under the reference load. All laws are taken without what depends
//! on speed (Stribeck curve, viscous part, damping of bristles): at the speeds of a reversal that adds nothing.

pub mod candidates;
pub mod compare;
mod laws;
pub mod noise;
pub mod paths;

use epas_reference::presliding::answers::{Path, Tick};

pub trait Law {
    fn follow(&mut self, tick: &Tick) -> f64;

    fn energy(&self) -> f64;
}

pub fn torques(law: &mut dyn Law, path: &Path<'_>) -> Vec<f64> {
    std::iter::once(0.0)
        .chain(path.ticks().map(|tick| law.follow(&tick)))
        .collect()
}
