//! The circuit of balls that both trains have: its track, the loaded zone, the phase of the groove that passes by, and
//! their checks.

mod configuration;
pub(crate) mod deviation;
mod phase;
mod stored;
mod zone;

pub use configuration::CircuitState;
pub(super) use configuration::{Circuit, CircuitConfiguration, LONGEST_TRACK, UNLOADED};
pub use deviation::{DeviationMap, HIGHEST_ORDER, Harmonic, LARGEST_DEVIATION};
pub(super) use zone::Sharing;
