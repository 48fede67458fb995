//! An angle without its noise.

use super::play::{Play, PlayState};
use super::turn::{NutAngle, Turn};
use crate::error::{Error, attempt};

/// An angle sensor `A` behind a [`Play`]: noise within the play turns nothing.
///
/// For friction that is compensated. Elements that follow a noisy angle are shaken: springs with short travel slip to and fro,
/// friction sets in earlier than it should, and the compensation drives what it ought to follow
/// ([`compensation`](crate::law::compensation)). Behind a play as wide as the noise they stand still with the nut; after a reversal they
/// are late by its width, `2 half_width`. 30 cycles beyond the sensor's.
///
/// ```
/// use epas_friction::law::motion::{CountSensor, CountSensorParameters, NutAngle, Deadband, Turn};
///
/// let counts = CountSensor::new(CountSensorParameters {
///     period: 16384,
///     turn_per_count: 1e-3,
///     largest_turn: 0.5,
/// })?;
/// let sensor = Deadband::new(counts, 2.5e-3)?;
/// let mut last = Deadband::<CountSensor>::FRESH;
/// for noisy in [100, 101, 99, 102, 98, 100] {
///     assert_eq!(sensor.turn(&mut last, noisy), Turn::Measured(0.0));
/// }
/// assert!(matches!(sensor.turn(&mut last, 110), Turn::Measured(turn) if (turn - 7.5e-3).abs() < 1e-8));
/// # Ok::<(), epas_friction::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Deadband<A> {
    pub(super) angle: A,
    pub(super) play: Play,
}

/// The last good reading, and where the play is.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct DeadbandReading<S> {
    pub(super) reading: S,
    pub(super) play: PlayState,
}

impl<A: Copy> Deadband<A> {
    /// A sensor behind a play of `half_width`, rad (m): 0 to 1e3; at least half the width of the noise, counts included.
    ///
    /// # Errors
    /// [`Error`] naming `half_width`.
    pub const fn new(angle: A, half_width: f32) -> Result<Self, Error> {
        let play = attempt!(Play::new(half_width));
        Ok(Self { angle, play })
    }
}

impl<A: NutAngle> NutAngle for Deadband<A> {
    type Reading = A::Reading;
    type State = DeadbandReading<A::State>;

    const FRESH: Self::State = DeadbandReading {
        reading: A::FRESH,
        play: PlayState::FRESH,
    };

    fn is_valid_state(&self, state: &Self::State) -> bool {
        self.angle.is_valid_state(&state.reading) && self.play.holds(&state.play)
    }

    #[inline]
    fn turn(&self, state: &mut Self::State, reading: A::Reading) -> Turn {
        let moved = |state: &mut PlayState, turn| self.play.follow(state, turn).turn;
        match self.angle.turn(&mut state.reading, reading) {
            Turn::Measured(turn) => Turn::Measured(moved(&mut state.play, turn)),
            Turn::Limited(turn) => Turn::Limited(moved(&mut state.play, turn)),
            Turn::Unknown => Turn::Unknown,
        }
    }
}
