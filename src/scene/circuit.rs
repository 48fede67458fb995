//! The circuit of balls that both trains have: its track, the loaded zone and the phase of the groove that passes by.

pub(crate) mod deviation;

use deviation::PHASE_BITS;
pub use deviation::{DeviationMap, HIGHEST_ORDER, Harmonic, LARGEST_DEVIATION};

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
        self.phase.units
    }

    #[inline(always)]
    pub(crate) fn advance(&mut self, circuit: &Circuit, speed: f32) {
        let units = speed * circuit.advance + self.phase.remainder;
        let whole = units as i32;
        self.phase.units = self.phase.units.wrapping_add_signed(whole);
        self.phase.remainder = units - whole as f32;
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

/// Fraction bits of the ratio of the load table's entries.
const FRACTION_BITS: u32 = 16;

/// Deviation maps of both grooves and the shares of the load, in integers along the track: first the loaded part of the body in which balls
/// recirculate (nut, carriage), then the return. The other groove (screw, rail) passes by.
///
/// Between load and return is a run-in of one pitch, half of it on either side of the border (of the whole return where that is shorter):
/// on it a ball takes up its load in proportion to the way, so that as many balls carry in the mean as stand on the loaded part, and where
/// balls touch the sum of their parts is the same at every angle. A track without return has no run-in.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(crate) struct LoadedZone {
    /// Half the length of a run-in, that of a whole one, and that from the begin of the first to the end of the last, in units of 2^-32 of
    /// the track.
    half_run_in: u32,
    run_in: u32,
    length: u32,
    /// 1 / length of a run-in.
    per_run_in: f32,
    /// Entries of the load table along the whole track.
    entries: u32,
    /// Phase of each map at the end of the track, in units of 2^-20 of its period.
    passing_ratio: u32,
    recirculating_ratio: u32,
    /// The same at half a run-in.
    passing_offset: u32,
    recirculating_offset: u32,
    passing: &'static DeviationMap,
    recirculating: &'static DeviationMap,
    shares: LoadShares,
}

/// Deviations of the grooves at the contacts of a loaded ball, as multiples of [`LoadedZone::units`].
pub(crate) struct LoadedBall {
    pub(crate) passing: f32,
    pub(crate) recirculating: f32,
    /// Part of its load which it carries on the run-in, above 0; 1 between the run-ins.
    pub(crate) run_in: f32,
}

/// How the balls share a load `F` at their present positions: a ball carries `F w/sum(w)`, with its share of the mean load times its part on
/// the run-in as weight `w`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Sharing {
    /// Sum of all weights, and 1 / it; both 0 where no ball is loaded.
    pub(crate) weights: f32,
    pub(crate) per_weight: f32,
    /// Largest weight, and the least of the balls between the run-ins; where none is there, both are the largest.
    pub(crate) extremes: [f32; 2],
}

pub(crate) struct Lengths {
    pub(crate) loaded: f32,
    pub(crate) returning: f32,
    pub(crate) length: f32,
    /// Distance of the centres of two balls in contact.
    pub(crate) pitch: f32,
}

impl LoadedZone {
    pub(crate) const fn new(
        lengths: &Lengths,
        passing: &'static DeviationMap,
        recirculating: &'static DeviationMap,
        shares: LoadShares,
    ) -> Result<Self, Error> {
        let shares = attempt!(shares.checked());
        let Lengths {
            loaded,
            returning,
            length,
            pitch,
        } = *lengths;
        let entries =
            shares.positive.len() as f32 * length / loaded * (1_u32 << FRACTION_BITS) as f32;
        // Half of it on either side of a border: one is no longer than the return, in which both meet, nor than the loaded part.
        let run_in = pitch.min(returning).min(loaded);
        let half_run_in = (0.5 * run_in / length * UNITS) as u32;
        let run_in = 2 * half_run_in;
        // Without a return the whole track, but for the unit that does not fit into 32 bits.
        let loaded = ((1.0 - returning / length) * UNITS) as u32;
        let (passing_ratio, recirculating_ratio) = (
            phase_ratio(passing, length),
            phase_ratio(recirculating, length),
        );
        Ok(Self {
            half_run_in,
            run_in,
            length: loaded.saturating_add(run_in),
            per_run_in: if run_in > 0 { 1.0 / run_in as f32 } else { 0.0 },
            entries: entries as u32,
            passing_ratio,
            recirculating_ratio,
            passing_offset: scaled(half_run_in, passing_ratio),
            recirculating_offset: scaled(half_run_in, recirculating_ratio),
            passing,
            recirculating,
            shares,
        })
    }

    /// Shares of the balls where the load is below zero, or where it is not.
    #[inline(always)]
    pub(crate) const fn shares(&self, negative: bool) -> &'static [LoadShare] {
        if negative {
            self.shares.negative
        } else {
            self.shares.positive
        }
    }

    #[inline(always)]
    pub(crate) fn at(&self, position: u32, phase: u32) -> Option<LoadedBall> {
        let run_in = self.run_in(position)?;
        let place = position.wrapping_add(self.half_run_in);
        // Counted from the begin of the first run-in, so that nothing jumps where the track closes within it.
        let along = |ratio, offset| scaled(place, ratio).wrapping_sub(offset);
        let passing = along(self.passing_ratio, self.passing_offset);
        let passing = passing.wrapping_add(phase >> (32 - PHASE_BITS));
        let recirculating = along(self.recirculating_ratio, self.recirculating_offset);
        Some(LoadedBall {
            passing: self.passing.units(passing) as f32,
            recirculating: self.recirculating.units(recirculating) as f32,
            run_in,
        })
    }

    /// How balls at these positions share a load, by the [`LoadedZone::shares`] of this tick.
    #[inline(never)]
    pub(crate) fn sharing(
        &self,
        positions: impl ExactSizeIterator<Item = u32>,
        shares: &'static [LoadShare],
    ) -> Sharing {
        if self.is_closed()
            && let [all] = shares
        {
            let (balls, share) = (positions.len() as f32, all.share);
            return Sharing {
                weights: balls * share,
                per_weight: 1.0 / (balls * share),
                extremes: [share; 2],
            };
        }
        let (mut weights, mut largest) = (0.0, 0.0);
        let mut least = f32::INFINITY;
        for position in positions {
            let Some(run_in) = self.run_in(position) else {
                continue;
            };
            let weight = run_in * self.share(position, shares);
            weights += weight;
            if weight > largest {
                largest = weight;
            }
            if run_in == 1.0 && weight < least {
                least = weight;
            }
        }
        Sharing {
            weights,
            per_weight: if weights > 0.0 { 1.0 / weights } else { 0.0 },
            extremes: [largest, if least < largest { least } else { largest }],
        }
    }

    #[inline(always)]
    pub(crate) const fn is_closed(&self) -> bool {
        self.run_in == 0
    }

    /// Part of its load that a ball carries at a position; 0 in the return.
    #[inline(never)]
    pub(crate) fn part(&self, position: u32) -> f32 {
        self.run_in(position).unwrap_or(0.0)
    }

    /// The same, none in the return.
    #[inline(always)]
    fn run_in(&self, position: u32) -> Option<f32> {
        let place = position.wrapping_add(self.half_run_in);
        let left = self.length.checked_sub(place)?;
        let nearest = if place < left { place } else { left };
        if nearest >= self.run_in {
            Some(1.0)
        } else if nearest > 0 {
            Some(nearest as f32 * self.per_run_in)
        } else {
            None
        }
    }

    /// Share at a position: linear between the middles of the table's parts; beyond the first and the last it is theirs, unless the track closes.
    #[inline(always)]
    pub(crate) fn share(&self, position: u32, shares: &'static [LoadShare]) -> f32 {
        const ONE: u32 = 1 << FRACTION_BITS;
        if let [all] = shares {
            return all.share;
        }
        let place = position.wrapping_add(self.half_run_in);
        let position = place.saturating_sub(self.half_run_in);
        let from_middle = scaled(position, self.entries) + ONE / 2;
        let entry = (from_middle / ONE) as usize;
        let (above, below) = (shares.get(entry), shares.get(entry.wrapping_sub(1)));
        let (above, below) = if self.is_closed() {
            (above.or(shares.first()), below.or(shares.last()))
        } else {
            (above.or(below), below.or(above))
        };
        let of = |share: Option<&LoadShare>| share.map_or(1.0, |share| share.share);
        let fraction = (from_middle % ONE) as f32 * (1.0 / ONE as f32);
        of(below) + fraction * (of(above) - of(below))
    }

    #[inline(always)]
    pub(crate) const fn units(&self) -> (f32, f32) {
        (self.passing.unit(), self.recirculating.unit())
    }

    #[inline]
    pub(crate) fn passing_turns(&self) -> f32 {
        f32::from(self.passing.turns())
    }

    /// Phase of the passing groove, in units of 2^-32, per turn or wavelength.
    pub(crate) const fn phase_per_turn(&self) -> f32 {
        UNITS / self.passing.turns() as f32
    }
}

#[inline(always)]
const fn scaled(position: u32, ratio: u32) -> u32 {
    ((position as u64 * ratio as u64) >> 32) as u32
}

/// Phase of a map at the end of a track of `length` turns, in units of 2^-20 of its period.
const fn phase_ratio(map: &DeviationMap, length: f32) -> u32 {
    let ratio = length / map.turns() as f32;
    (ratio * (1_u32 << PHASE_BITS) as f32) as u32
}

#[cfg(test)]
mod tests {
    use super::*;

    const MOST: usize = 39;
    const STEPS: u32 = 2_000;

    static SHARES: [LoadShare; 3] = match [
        LoadShare::new(0.4),
        LoadShare::new(1.3),
        LoadShare::new(0.9),
    ] {
        [Ok(first), Ok(second), Ok(third)] => [first, second, third],
        _ => panic!("a share is out of range"),
    };

    fn zone([loaded, returning, pitch]: [f32; 3], shares: LoadShares) -> LoadedZone {
        let length = loaded + returning;
        let lengths = Lengths {
            loaded,
            returning,
            length,
            pitch,
        };
        let zone = LoadedZone::new(&lengths, &DeviationMap::NONE, &DeviationMap::NONE, shares);
        zone.unwrap_or_else(|error| panic!("{error}"))
    }

    /// Balls at equal distances, by this part of 2000 of their distance from the start.
    fn spread(balls: u32, step: u32) -> impl ExactSizeIterator<Item = u32> + Clone {
        let distance = move |ball, step| {
            let steps = u64::from(balls) * u64::from(STEPS);
            ((1_u64 << 32) * u64::from(ball * STEPS + step) / steps) as u32
        };
        (0..balls).map(move |ball| distance(ball, step))
    }

    fn loads(
        zone: &LoadedZone,
        positions: impl ExactSizeIterator<Item = u32> + Clone,
    ) -> [f32; MOST] {
        let shares = zone.shares(false);
        let sharing = zone.sharing(positions.clone(), shares);
        let weight = |position| zone.part(position) * zone.share(position, shares);
        let mut loads = [0.0; MOST];
        for (load, position) in loads.iter_mut().zip(positions) {
            *load = weight(position) * sharing.per_weight;
        }
        loads
    }

    /// At every angle; and in the mean as many balls carry as stand on the loaded part.
    #[test]
    fn loads_add_up() {
        for (balls, lengths) in [
            (39, [36.5, 2.5, 0.98]),
            (39, [38.6, 0.4, 1.0]),
            (37, [37.0, 0.0, 1.0]),
            (5, [0.4, 4.6, 0.9]),
            (3, [2.0, 9.0, 0.5]),
        ] {
            let mut carrying = 0.0;
            for shares in [LoadShares::EVEN, LoadShares::same(&SHARES)] {
                let zone = zone(lengths, shares);
                for step in 0..STEPS {
                    let positions = spread(balls, step);
                    let sharing = zone.sharing(positions.clone(), zone.shares(false));
                    let loads = loads(&zone, positions);
                    let sum: f64 = loads.iter().copied().map(f64::from).sum();
                    let expected = if sharing.weights > 0.0 { 1.0 } else { 0.0 };
                    // A rounding of each addition of the sum, two of each load.
                    let rounding = f64::from(balls + 2) * f64::from(f32::EPSILON) / 2.0;
                    assert!((sum - expected).abs() <= rounding, "{step}: {sum}");
                    assert!(loads.iter().all(|load| (0.0..=1.0).contains(load)));
                    if shares == LoadShares::EVEN {
                        carrying += f64::from(sharing.weights) / f64::from(STEPS);
                    }
                }
            }
            let [loaded, returning, _] = lengths.map(f64::from);
            let expected = f64::from(balls) * loaded / (loaded + returning);
            assert!((carrying / expected - 1.0).abs() < 1e-3, "{carrying}");
        }
    }

    #[test]
    fn shares_are_linear() {
        for (returning, at_start) in [(0.0, 0.65), (1.0, 0.4)] {
            let zone = zone([9.0, returning, 0.5], LoadShares::same(&SHARES));
            for (at, expected) in [
                (0.0, at_start),
                (1.5, 0.4),
                (3.0, 0.85),
                (4.5, 1.3),
                (7.0, 29.0 / 30.0),
            ] {
                let position = (at / (9.0 + returning) * UNITS) as u32;
                let share = zone.share(position, zone.shares(false));
                // The middle of a part is known to 2^-16 of it.
                assert!((share - expected).abs() < 3e-5, "{at}: {share}");
            }
        }
    }

    /// A step changes each load by no more than its part of the largest one; where balls touch, the sum of their weights stays.
    #[test]
    fn loads_change_with_the_way() {
        let zone = zone([36.5, 2.5, 1.0], LoadShares::EVEN);
        let mut last = loads(&zone, spread(39, 0));
        for step in 1..=STEPS {
            let sharing = zone.sharing(spread(39, step), zone.shares(false));
            // Lengths of the track are folded to 2^-24 of it.
            assert!((sharing.weights / 36.5 - 1.0).abs() < 1e-5, "{sharing:?}");
            let now = loads(&zone, spread(39, step));
            for (now, before) in now.iter().zip(&last) {
                assert!((now - before).abs() < 1.01 / (36.5 * STEPS as f32));
            }
            last = now;
        }
        let closed = self::zone([37.0, 0.0, 1.0], LoadShares::EVEN);
        let sharing = closed.sharing(spread(37, 1), closed.shares(false));
        assert_eq!((sharing.weights, sharing.extremes), (37.0, [1.0; 2]));
        let positions = [0, 1, u32::MAX].into_iter();
        assert_eq!(closed.sharing(positions, closed.shares(true)).weights, 3.0);
    }

    #[test]
    fn a_zone_without_a_ball_loads_none() {
        let zone = zone([0.5, 4.5, 0.4], LoadShares::EVEN);
        let far = [1 << 31].into_iter();
        let sharing = zone.sharing(far.clone(), zone.shares(false));
        assert_eq!((sharing.per_weight, sharing.weights), (0.0, 0.0));
        assert_eq!(loads(&zone, far), [0.0; MOST]);
    }
}
