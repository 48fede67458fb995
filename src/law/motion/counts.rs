//! Counts of an encoder.

use super::turn::{NutAngle, Turn, within_half};
use crate::error::{Error, Range, attempt, in_range};

/// A counter of angle as it is set up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CountSensorParameters {
    /// Counts after which the counter starts again at 0: 2 to `u32::MAX`; 0 for a counter of all 32 bits.
    pub period: u32,
    /// Turn of the nut for one count, rad (m), negative where the counter runs the other way; size 1e-9 to 1.
    /// A motor's encoder of 14 bits with a belt of ratio 2.5: `2 pi / 16384 / 2.5`.
    pub turn_per_count: f32,
    /// Most that the nut turns between two readings, rad (m): largest speed times the longest gap. [`LARGEST_TURN`](super::LARGEST_TURN), and at
    /// most half a period: a counter cannot tell more.
    pub largest_turn: f32,
}

/// Nut angle from a counter: `dtheta = ((n - n_last + P/2) mod P - P/2) turn_per_count`, the shorter way round.
///
/// The difference is exact, the turn rounded once (below 2^24 counts). A count of the period or more is no reading. Half
/// a period is taken as backwards. 60 cycles.
///
/// ```
/// use epas_friction::law::motion::{CountSensor, CountSensorParameters, NutAngle, Turn};
///
/// const SENSOR: CountSensor = match CountSensor::new(CountSensorParameters {
///     period: 16384,
///     turn_per_count: 2.0 * core::f32::consts::PI / 16384.0,
///     largest_turn: 0.5,
/// }) {
///     Ok(sensor) => sensor,
///     Err(_) => panic!(),
/// };
/// let mut last = CountSensor::FRESH;
/// assert_eq!(SENSOR.turn(&mut last, 16_380), Turn::Measured(0.0));
/// assert_eq!(SENSOR.turn(&mut last, 99_999), Turn::Unknown);
/// assert_eq!(SENSOR.turn(&mut last, 4), Turn::Measured(8.0 * 2.0 * core::f32::consts::PI / 16384.0));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct CountSensor {
    pub(super) period: u32,
    pub(super) turn_per_count: f32,
    largest_turn: f32,
}

/// The last count, where there was one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct CountReading(pub(super) Option<u32>);

impl CountSensor {
    /// Constants of a counter.
    ///
    /// # Errors
    /// The field that is out of range.
    pub const fn new(parameters: CountSensorParameters) -> Result<Self, Error> {
        let CountSensorParameters {
            period,
            turn_per_count,
            largest_turn,
        } = parameters;
        if period == 1 {
            return Err(Error::OutOfRange {
                field: "period",
                value: 1.0,
                allowed: Range::new(2.0, u32::MAX as f32),
            });
        }
        let size = attempt!(in_range("turn_per_count", turn_per_count.abs(), 1e-9, 1.0));
        let counts = if period == 0 {
            4_294_967_296.0
        } else {
            period as f32
        };
        attempt!(within_half(largest_turn, 0.5 * counts * size));
        Ok(Self {
            period,
            turn_per_count,
            largest_turn,
        })
    }

    /// Counts from `last` to `now`, the shorter way.
    #[inline(always)]
    const fn counts(&self, last: u32, now: u32) -> i32 {
        let forward = now.wrapping_sub(last);
        if self.period == 0 {
            return forward.cast_signed();
        }
        // Both are below the period.
        let forward = if now < last {
            forward.wrapping_add(self.period)
        } else {
            forward
        };
        if forward >= self.period - self.period / 2 {
            forward.wrapping_sub(self.period).cast_signed()
        } else {
            forward.cast_signed()
        }
    }
}

impl NutAngle for CountSensor {
    type Reading = u32;
    type State = CountReading;

    const FRESH: Self::State = CountReading(None);

    fn is_valid_state(&self, state: &Self::State) -> bool {
        state
            .0
            .is_none_or(|last| self.period == 0 || last < self.period)
    }

    #[inline]
    fn turn(&self, state: &mut Self::State, reading: u32) -> Turn {
        if self.period != 0 && reading >= self.period {
            return Turn::Unknown;
        }
        let last = state.0.replace(reading);
        let counts = last.map_or(0, |last| self.counts(last, reading));
        Turn::within(counts as f32 * self.turn_per_count, self.largest_turn)
    }
}
