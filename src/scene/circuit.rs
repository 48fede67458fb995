//! The circuit of balls that both trains have: its track, the loaded zone and the phase of the groove that passes by.

pub(crate) mod deviation;
mod zone;

pub use deviation::{DeviationMap, HIGHEST_ORDER, Harmonic, LARGEST_DEVIATION};
pub(super) use zone::Sharing;
use zone::{Lengths, LoadedZone};

use crate::ball::{LoadShare, LoadShares};
use crate::error::{Error, Range, attempt, in_range};
use crate::stored::{Fingerprint, Port, Refusal, Stored};
use crate::train::{IMPEDANCE_RANGE, LARGEST_TRAVEL, Track, Train};
/// Impedance of a ball that no load presses into its grooves, N: it goes along with its neighbours. Not zero, because a train divides
/// by it; a loaded ball has some 500 N (100 N of load in the bearing of Lin 2019, Table 3.3), which such a ball does not feel.
pub(crate) const UNLOADED: f32 = 1e-6;
const _: () = assert!(UNLOADED >= IMPEDANCE_RANGE.0);

/// Longest track, in turns of the maps: ratios of phases fit into 32 bits.
pub(crate) const LONGEST_TRACK: f32 = 1000.0;

/// Longest return over the loaded part: positions in the load table fit into 32 bits.
const LONGEST_RETURN: f32 = 250.0;

/// Largest part of a map's period by which the passing groove may advance in a tick: its sense would be
/// lost beyond.
const LARGEST_ADVANCE: f32 = 0.499;

/// Configuration of a circuit. "Motion" is the nut's angle, rad, or the carriage's travel, m.
pub(crate) struct CircuitConfiguration {
    pub(crate) balls: u16,
    /// Loaded part of the track, m.
    pub(crate) loaded_length: f32,
    /// The same in turns of the maps.
    pub(crate) loaded_turns: f32,
    /// Return, m: there balls carry no load.
    pub(crate) return_length: f32,
    /// Length of the track in one turn of the maps, m.
    pub(crate) turn_length: f32,
    /// Distance of the centres of two balls in contact, along the track, m.
    pub(crate) pitch: f32,
    /// Travel of a nominal ball along the track, m per unit of motion; above zero.
    pub(crate) travel_per_motion: f32,
    /// Motion in which the passing groove advances by one turn of the maps, rad or m.
    pub(crate) motion_per_turn: f32,
    /// Deviation of the groove that passes by: screw, rail.
    pub(crate) passing_deviation: &'static DeviationMap,
    /// Deviation of the groove of the body in which balls recirculate: nut, carriage.
    pub(crate) recirculating_deviation: &'static DeviationMap,
    /// Load of a ball over the mean load, along the loaded part.
    pub(crate) load_shares: LoadShares,
    /// Time between two ticks, s.
    pub(crate) tick: f32,
    /// Largest speed of the motion, rad/s or m/s.
    pub(crate) largest_speed: f32,
}

/// Constants of a closed track of balls with its loaded zone.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(crate) struct Circuit {
    pub(crate) zone: LoadedZone,
    pub(super) track: Track,
    balls: u16,
    /// 1 / mean number of loaded balls.
    per_loaded_ball: f32,
    /// Travel of the balls along the track in a tick, over the speed of the motion; negative.
    travel: f32,
    /// Advance of the passing groove's phase in a tick, in units of it, over the speed of the motion.
    advance: f32,
}

/// State of a circuit of up to `N` balls.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct CircuitState<const N: usize> {
    /// The balls on the track.
    pub train: Train<N>,
    phase: Phase,
}

impl CircuitConfiguration {
    /// Checks and folds a circuit of up to so many balls.
    pub(crate) const fn folded(&self, most: usize) -> Result<Circuit, Error> {
        let longest = LONGEST_RETURN * self.loaded_length;
        attempt!(in_range("return_length", self.return_length, 0.0, longest));
        let length = self.loaded_length + self.return_length;
        attempt!(in_range("balls", self.balls as f32, 1.0, most as f32));
        let track = attempt!(Track::new(length, self.pitch, self.balls as usize));
        let zone = attempt!(LoadedZone::new(
            &Lengths {
                loaded: self.loaded_turns,
                returning: self.return_length / self.turn_length,
                length: length / self.turn_length,
                pitch: self.pitch / self.turn_length,
            },
            self.passing_deviation,
            self.recirculating_deviation,
            self.load_shares,
        ));
        let fastest = LARGEST_TRAVEL * length / (self.travel_per_motion * self.largest_speed);
        let tick = attempt!(in_range("tick", self.tick, 0.0, fastest));
        let period = self.motion_per_turn * self.passing_deviation.turns() as f32;
        let sensed = LARGEST_ADVANCE * period / self.largest_speed;
        attempt!(in_range("tick", tick, 0.0, sensed));
        Ok(Circuit {
            zone,
            track,
            balls: self.balls,
            per_loaded_ball: length / (self.loaded_length * self.balls as f32),
            travel: -self.travel_per_motion * tick,
            advance: zone.phase_per_turn() * tick / self.motion_per_turn,
        })
    }
}

impl Circuit {
    pub(crate) const fn per_loaded_ball(&self) -> f32 {
        self.per_loaded_ball
    }

    /// Travel of a nominal ball along the track in a tick at a speed of the motion, m.
    #[inline(always)]
    pub(crate) fn travel(&self, speed: f32) -> f32 {
        speed * self.travel
    }

    #[inline(never)]
    pub(crate) fn sharing<const N: usize>(
        &self,
        state: &CircuitState<N>,
        shares: &'static [LoadShare],
    ) -> Sharing {
        self.zone
            .sharing(state.train.positions(), self.balls, shares)
    }

    #[inline(never)]
    pub(crate) fn part(&self, position: u32) -> f32 {
        self.zone.part(position)
    }

    pub(crate) fn fingerprint(&self, fingerprint: &mut Fingerprint) {
        self.track.fingerprint(fingerprint);
        fingerprint.number(self.zone.passing_turns());
    }
}

impl<const N: usize> CircuitState<N> {
    /// Balls at equal distances, before the first tick.
    #[inline(always)]
    pub(crate) fn new(circuit: &Circuit) -> Self {
        Self {
            train: Train::spread(circuit.track, usize::from(circuit.balls)),
            phase: Phase::default(),
        }
    }

    /// Whether its balls stand on the track of this circuit.
    pub(crate) const fn is_on(&self, circuit: &Circuit) -> Result<(), Error> {
        self.train.is_on(&circuit.track, circuit.balls)
    }

    /// Phase of the passing groove, in units of 2^-32 of its period.
    #[inline(always)]
    pub(crate) const fn phase(&self) -> u32 {
        self.phase.units()
    }

    #[inline(always)]
    pub(crate) fn advance(&mut self, circuit: &Circuit, speed: f32) {
        self.phase.advance(speed * circuit.advance);
    }

    /// Sets the motion from which the passing groove's deviations are counted, in turns of the maps.
    pub(crate) fn set_turns(&mut self, circuit: &Circuit, turns: f32) {
        self.phase.set(turns / circuit.zone.passing_turns());
    }
}

impl<const N: usize> Stored for CircuitState<N> {
    const BYTES: usize = <Train<N> as Stored>::BYTES + 8;

    fn exchange<P: Port>(&mut self, port: &mut P) -> Result<(), Refusal> {
        self.train.exchange(port)?;
        self.phase.exchange(port)
    }
}

/// Units of a period of the passing groove, and of a track.
const UNITS: f32 = 4_294_967_296.0;

#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
struct Phase {
    /// Units of 2^-32 of a period.
    units: u32,
    /// Part of the advance so far that is not yet a whole unit.
    remainder: f32,
}

impl Phase {
    #[inline(always)]
    const fn units(&self) -> u32 {
        self.units
    }

    #[inline(always)]
    fn advance(&mut self, units: f32) {
        let units = units + self.remainder;
        let whole = units as i32;
        self.units = self.units.wrapping_add_signed(whole);
        self.remainder = units - whole as f32;
    }

    /// Sets the phase to a number of periods, of which only the fraction counts; NaN, and what is beyond 8e6 periods,
    /// counts as 0.
    fn set(&mut self, periods: f32) {
        let periods = if periods.abs() < 8_388_608.0 {
            periods
        } else {
            0.0
        };
        let fraction = periods - periods as i32 as f32;
        // In half periods, because a whole one does not fit into 31 bits and a sign.
        let half = (fraction * (0.5 * UNITS)) as i32;
        self.units = (half as u32).wrapping_mul(2);
        self.remainder = 0.0;
    }
}

impl Stored for Phase {
    const BYTES: usize = 8;

    fn exchange<P: Port>(&mut self, port: &mut P) -> Result<(), Refusal> {
        port.word(&mut self.units)?;
        port.number("remainder", &mut self.remainder, Range::new(-1.0, 1.0))
    }
}
