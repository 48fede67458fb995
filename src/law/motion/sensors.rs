//! Sensors of the nut's angle.

use crate::error::{Error, Range, attempt, in_range};
use crate::stored::{Fingerprint, Fingerprinted, Port, Refusal, Stored};

/// Largest turn of a tick, rad (m).
pub const LARGEST_TURN: Range = Range::new(1e-6, 1e3);

pub(super) const fn within_half(largest_turn: f32, half: f32) -> Result<f32, Error> {
    let most = half.min(LARGEST_TURN.maximum);
    in_range("largest_turn", largest_turn, LARGEST_TURN.minimum, most)
}

/// Turn between two readings.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Turn {
    /// The turn, rad (m); none at the first reading.
    Measured(f32),
    /// Beyond the largest turn of a tick, and cut to that.
    Limited(f32),
    /// The reading is not valid. Friction holds; the next reading's turn spans the gap.
    Unknown,
}

impl Turn {
    /// The turn to apply, rad (m): 0 where it is unknown.
    #[inline]
    pub const fn angle(self) -> f32 {
        match self {
            Self::Measured(turn) | Self::Limited(turn) => turn,
            Self::Unknown => 0.0,
        }
    }

    /// Whether the turn is as it was read.
    #[inline]
    #[must_use]
    pub const fn is_measured(self) -> bool {
        matches!(self, Self::Measured(_))
    }

    #[inline]
    pub(super) fn within(turn: f32, largest: f32) -> Self {
        if turn > largest {
            Self::Limited(largest)
        } else if turn < -largest {
            Self::Limited(-largest)
        } else {
            Self::Measured(turn)
        }
    }
}

/// A sensor of the nut's angle: constants, folded at set-up.
pub trait NutAngle {
    /// A reading of the sensor.
    type Reading: Copy;
    /// The last good reading.
    type State: Copy + core::fmt::Debug + PartialEq;

    /// No reading yet.
    const FRESH: Self::State;

    /// Whether this sensor can have left such a state.
    fn is_valid_state(&self, state: &Self::State) -> bool {
        let _ = state;
        true
    }

    /// The turn since the last good reading; bounded time, no panic.
    fn turn(&self, state: &mut Self::State, reading: Self::Reading) -> Turn;
}

/// Parameters of a counter of angle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CountSensorParameters {
    /// Counts after which the counter starts again at 0: 2 to `u32::MAX`; 0 for a counter of all 32 bits.
    pub period: u32,
    /// Turn of the nut for one count, rad (m), negative where the counter runs the other way; size 1e-9 to 1.
    /// A motor's encoder of 14 bits with a belt of ratio 2.5: `2 pi / 16384 / 2.5`.
    pub turn_per_count: f32,
    /// Largest turn of the nut between two readings, rad (m): largest speed times the longest gap, within
    /// [`LARGEST_TURN`](super::LARGEST_TURN), and at most half a period.
    pub largest_turn: f32,
}

/// Nut angle from a counter: `dtheta = ((n - n_last + P/2) mod P - P/2) turn_per_count`, the shorter way round.
///
/// The difference is exact, the turn rounded once (below 2^24 counts). A count of the period or more is no reading. 60 cycles.
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

    #[inline]
    const fn counts(&self, last: u32, now: u32) -> i32 {
        let forward = now.wrapping_sub(last);
        if self.period == 0 {
            return forward.cast_signed();
        }
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

const COUNTS: u32 = 1;

impl Stored for CountReading {
    const BYTES: usize = 5;

    fn exchange<P: Port>(&mut self, port: &mut P) -> Result<(), Refusal> {
        let (mut known, mut last) = (self.0.is_some(), self.0.unwrap_or(0));
        port.flag("known", &mut known)?;
        port.word(&mut last)?;
        self.0 = known.then_some(last);
        Ok(())
    }
}

impl Fingerprinted for CountSensor {
    fn fingerprint(&self, fingerprint: &mut Fingerprint) {
        fingerprint.count(COUNTS);
        fingerprint.count(self.period);
        fingerprint.number(self.turn_per_count);
    }
}

/// Parameters of an angle in radians.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WrappedAngleParameters {
    /// Smallest angle, rad: -1e6 to 1e6; 0 or minus half a period.
    pub lowest: f32,
    /// Turn after which it starts again at `lowest`, rad, as the sensor rounds it: 1e-3 to 1e6.
    pub period: f32,
    /// Largest turn of the nut between two readings, rad: within [`LARGEST_TURN`](super::LARGEST_TURN), and at most half a period.
    pub largest_turn: f32,
}

/// Nut angle in radians: `dtheta = theta - theta_last`, the shorter way round.
///
/// Differences of neighbours are exact (Sterbenz) where neither is over twice the other; across the end the turn is rounded once. An angle outside
/// `lowest` to `lowest + period` or NaN is no reading. 65 cycles.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct WrappedAngle {
    pub(super) lowest: f32,
    pub(super) highest: f32,
    half: f32,
    largest_turn: f32,
}

/// The last angle, where there was one.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct AngleReading(pub(super) Option<f32>);

impl WrappedAngle {
    /// Constants of an angle.
    pub const fn new(parameters: WrappedAngleParameters) -> Result<Self, Error> {
        let WrappedAngleParameters {
            lowest,
            period,
            largest_turn,
        } = parameters;
        attempt!(in_range("lowest", lowest, -1e6, 1e6));
        attempt!(in_range("period", period, 1e-3, 1e6));
        let half = 0.5 * period;
        attempt!(within_half(largest_turn, half));
        Ok(Self {
            lowest,
            highest: lowest + period,
            half,
            largest_turn,
        })
    }

    #[inline]
    fn difference(&self, last: f32, now: f32) -> f32 {
        let turn = now - last;
        if turn > self.half {
            (self.lowest - last) - (self.highest - now)
        } else if turn < -self.half {
            (self.highest - last) + (now - self.lowest)
        } else {
            turn
        }
    }
}

impl NutAngle for WrappedAngle {
    type Reading = f32;
    type State = AngleReading;

    const FRESH: Self::State = AngleReading(None);

    fn is_valid_state(&self, state: &Self::State) -> bool {
        state
            .0
            .is_none_or(|last| last >= self.lowest && last <= self.highest)
    }

    #[inline]
    fn turn(&self, state: &mut Self::State, reading: f32) -> Turn {
        if !(reading >= self.lowest && reading <= self.highest) {
            return Turn::Unknown;
        }
        let last = state.0.replace(reading);
        Turn::within(
            last.map_or(0.0, |last| self.difference(last, reading)),
            self.largest_turn,
        )
    }
}

const ANGLE: u32 = 2;

impl Stored for AngleReading {
    const BYTES: usize = 5;

    fn exchange<P: Port>(&mut self, port: &mut P) -> Result<(), Refusal> {
        let (mut known, mut last) = (self.0.is_some(), self.0.unwrap_or(0.0));
        port.flag("known", &mut known)?;
        port.number("reading", &mut last, Range::new(-3e6, 3e6))?;
        self.0 = known.then_some(last);
        Ok(())
    }
}

impl Fingerprinted for WrappedAngle {
    fn fingerprint(&self, fingerprint: &mut Fingerprint) {
        fingerprint.count(ANGLE);
        fingerprint.numbers(&[self.lowest, self.highest]);
    }
}

/// Turn from a speed, `dtheta = omega_N dt`: for simulations, and sensors without an angle. Noise adds up: `sigma sqrt(t dt)` after a time `t`. NaN is
/// no reading, and its turn is lost. Cost: 30 modelled cycles.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct SpeedOverTick {
    tick: f32,
    largest_turn: f32,
}

impl SpeedOverTick {
    /// Constants: the tick, s (1e-7 to 10), and the largest turn of one, rad (m) ([`LARGEST_TURN`]).
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

const SPEED: u32 = 3;

impl Fingerprinted for SpeedOverTick {
    fn fingerprint(&self, fingerprint: &mut Fingerprint) {
        fingerprint.count(SPEED);
    }
}
