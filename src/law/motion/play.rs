//! A backlash, and a sensor behind one.

use super::sensors::{NutAngle, Turn};
use crate::error::{Error, Range, attempt, in_range};
use crate::stored::{Fingerprint, Fingerprinted, Port, Refusal, Stored};

/// A play of `half_width` to either side: the output follows the turn only beyond it, `p <- clamp(p + dtheta, -h, h)`, moved `= dtheta - dp`. As
/// wide as the noise of an encoder, it keeps a row of balls from turning round with every count. NaN counts as no turn. Cost: 40 modelled cycles.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Play {
    pub(super) half_width: f32,
}

/// Position of the turn within its play, and direction of the output's last motion.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct PlayState {
    pub(super) position: f32,
    pub(super) direction: f32,
}

/// Motion of the output.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Moved {
    /// Turn, rad (m).
    pub turn: f32,
    /// Direction of its last motion: 1 or -1; 0 before the first.
    pub direction: f32,
}

impl PlayState {
    /// In the middle of the play, and not moved yet.
    pub const FRESH: Self = Self {
        position: 0.0,
        direction: 0.0,
    };

    /// Turn from the middle of the play, rad (m), within its half width.
    pub const fn position(&self) -> f32 {
        self.position
    }

    /// Direction of the output's last motion: 1 or -1; 0 before the first.
    pub const fn direction(&self) -> f32 {
        self.direction
    }
}

impl Play {
    /// A play of `half_width`, rad (m): 0 to 1e3. Without width the output follows every turn.
    pub const fn new(half_width: f32) -> Result<Self, Error> {
        let half_width = attempt!(in_range("half_width", half_width, 0.0, 1e3));
        Ok(Self { half_width })
    }

    #[inline]
    pub(crate) const fn half_width(&self) -> f32 {
        self.half_width
    }

    /// Cuts a state of another play to this one.
    pub(crate) const fn take_over(&self, state: &mut PlayState) {
        if state.position.abs() > self.half_width {
            state.position = self.half_width.copysign(state.position);
        }
    }

    /// Motion of the output under a turn, rad (m).
    #[inline]
    pub fn follow(&self, state: &mut PlayState, turn: f32) -> Moved {
        let position = state.position + turn;
        let turn = if position > self.half_width {
            state.position = self.half_width;
            state.direction = 1.0;
            position - self.half_width
        } else if position < -self.half_width {
            state.position = -self.half_width;
            state.direction = -1.0;
            position + self.half_width
        } else {
            // A NaN stays outside.
            if !position.is_nan() {
                state.position = position;
            }
            0.0
        };
        Moved {
            turn,
            direction: state.direction,
        }
    }
}

impl Stored for PlayState {
    const BYTES: usize = 8;

    fn exchange<P: Port>(&mut self, port: &mut P) -> Result<(), Refusal> {
        port.number("position", &mut self.position, Range::new(-1e3, 1e3))?;
        port.number("direction", &mut self.direction, Range::new(-1.0, 1.0))
    }
}

impl Play {
    pub(crate) fn holds(&self, state: &PlayState) -> bool {
        state.position.abs() <= self.half_width && [-1.0, 0.0, 1.0].contains(&state.direction)
    }

    pub(crate) fn fingerprint(&self, fingerprint: &mut Fingerprint) {
        fingerprint.number(self.half_width);
    }
}

/// An angle sensor `A` behind a [`Play`] as wide as its noise, for friction that is compensated
/// ([`compensation`](crate::law::compensation)): elements stand still with the nut, and after a reversal are late by `2 half_width`. 30 cycles
/// beyond the sensor's.
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

/// The last good reading, and the state of the play.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct DeadbandReading<S> {
    pub(super) reading: S,
    pub(super) play: PlayState,
}

impl<A: Copy> Deadband<A> {
    /// A sensor behind a play of `half_width`, rad (m), 0 to 1e3: at least half the width of the noise, counts included.
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

const STEADY: u32 = 4;

impl<S: Stored> Stored for DeadbandReading<S> {
    const BYTES: usize = S::BYTES + PlayState::BYTES;

    fn exchange<P: Port>(&mut self, port: &mut P) -> Result<(), Refusal> {
        self.reading.exchange(port)?;
        self.play.exchange(port)
    }
}

impl<A: Fingerprinted> Fingerprinted for Deadband<A> {
    fn fingerprint(&self, fingerprint: &mut Fingerprint) {
        fingerprint.count(STEADY);
        self.angle.fingerprint(fingerprint);
        self.play.fingerprint(fingerprint);
    }
}
