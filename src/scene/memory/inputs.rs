//! Inputs of a scene with memory, and their largest ages.

use crate::error::{Error, Range};
use crate::law::fade::Fade;

/// Inputs of a scene with memory at a tick.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct WithMemoryInputs<I, R> {
    /// Speed and loads. The friction coefficient follows this speed; the memory follows the angle.
    pub scene: I,
    /// Reading of the angle sensor.
    pub reading: R,
    /// Time since the loads were found, s, 0 or more; 0 where they are of this tick.
    pub load_age: f32,
    /// Temperature of the screw, K, 150 to 500.
    pub temperature: f32,
    /// Time since the temperature was found, s, 0 or more.
    pub temperature_age: f32,
}

/// How old a load may be.
///
/// An age that is no number is too old; one below zero counts as none. What fades is friction; the torque that holds the load, and the
/// efficiency beside it, are those of the whole load.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Freshness {
    /// Age up to which a load counts as it is, s, 0 to 1e3.
    pub load_hold: f32,
    /// Time after that in which it fades to none, s, 1e-6 to 1e3.
    pub load_fade: f32,
}

impl Freshness {
    /// Loads of the last 10 ms as they are, which fade in 90 ms. Assumed, not measured: an estimator that runs every 10 ms is never
    /// too late, and a tenth of a second after its last value the load counts as zero.
    pub const DEFAULT: Self = Self {
        load_hold: 0.01,
        load_fade: 0.09,
    };

    /// These times, checked, as the factor of a load by its age.
    ///
    /// # Errors
    /// [`Error`] naming `load_hold` or `load_fade`.
    pub(super) const fn fade(self) -> Result<Fade, Error> {
        Fade::new(
            ("load_hold", self.load_hold, Range::new(0.0, 1e3)),
            ("load_fade", self.load_fade, Range::new(1e-6, 1e3)),
        )
    }
}
