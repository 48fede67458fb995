//! Turn from a speed, where there is no angle.

use super::turn::{LARGEST_TURN, NutAngle, Turn};
use crate::error::{Error, attempt, in_range};

/// Turn from a speed: `dtheta = omega_N dt`.
///
/// For simulations, whose speed has no noise, and for sensors without an angle. Noise adds up: `sigma sqrt(t dt)` after a time
/// `t`, 1.6 mrad after a second of 0.05 rad/s at 1 kHz. A speed that is no number is no reading, and its turn is lost.
/// Cost: 30 modelled cycles.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct SpeedOverTick {
    tick: f32,
    largest_turn: f32,
}

impl SpeedOverTick {
    /// Constants: the tick, s (1e-7 to 10), and the largest turn of one, rad (m) ([`LARGEST_TURN`]).
    ///
    /// # Errors
    /// The field that is out of range.
    pub const fn new(tick: f32, largest_turn: f32) -> Result<Self, Error> {
        attempt!(in_range("tick", tick, 1e-7, 10.0));
        attempt!(LARGEST_TURN.checked("largest_turn", largest_turn));
        Ok(Self { tick, largest_turn })
    }
}

impl NutAngle for SpeedOverTick {
    type Reading = f32;
    type State = ();

    const FRESH: Self::State = ();

    #[inline]
    fn turn(&self, (): &mut Self::State, reading: f32) -> Turn {
        // Infinity is a limited turn.
        if reading.is_nan() {
            Turn::Unknown
        } else {
            Turn::within(reading * self.tick, self.largest_turn)
        }
    }
}
