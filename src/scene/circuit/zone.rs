//! Where on the track balls carry load, and what they find there.

use super::UNITS;
use super::deviation::{DeviationMap, PHASE_BITS};
use crate::ball::{LoadShare, LoadShares};
use crate::error::{Error, attempt};

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
        self.shares.of(negative)
    }

    #[inline(always)]
    pub(crate) fn at(&self, position: u32, phase: u32) -> Option<LoadedBall> {
        let place = position.wrapping_add(self.half_run_in);
        let run_in = self.run_in(place)?;
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
    #[inline(always)]
    pub(crate) fn sharing(
        &self,
        positions: impl Iterator<Item = u32>,
        balls: u16,
        shares: &'static [LoadShare],
    ) -> Sharing {
        if self.is_closed()
            && let [all] = shares
        {
            let (balls, share) = (f32::from(balls), all.share());
            return Sharing {
                weights: balls * share,
                per_weight: 1.0 / (balls * share),
                extremes: [share; 2],
            };
        }
        let (mut weights, mut largest) = (0.0, 0.0);
        let mut least = f32::INFINITY;
        for position in positions {
            let place = position.wrapping_add(self.half_run_in);
            let Some(run_in) = self.run_in(place) else {
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
    #[inline(always)]
    pub(crate) fn part(&self, position: u32) -> f32 {
        if self.is_closed() {
            return 1.0;
        }
        let place = position.wrapping_add(self.half_run_in);
        self.run_in(place).unwrap_or(0.0)
    }

    /// Part of its load that a ball carries at a place from the begin of the first run-in on; none in the return.
    #[inline(always)]
    fn run_in(&self, place: u32) -> Option<f32> {
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
            return all.share();
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
        let of = |share: Option<&LoadShare>| share.map_or(1.0, LoadShare::share);
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
    fn spread(balls: u32, step: u32) -> impl Iterator<Item = u32> + Clone {
        let distance = move |ball, step| {
            let steps = u64::from(balls) * u64::from(STEPS);
            ((1_u64 << 32) * u64::from(ball * STEPS + step) / steps) as u32
        };
        (0..balls).map(move |ball| distance(ball, step))
    }

    fn loads(zone: &LoadedZone, positions: impl Iterator<Item = u32> + Clone) -> [f32; MOST] {
        let shares = zone.shares(false);
        let sharing = zone.sharing(positions.clone(), positions.clone().count() as u16, shares);
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
                    let sharing = zone.sharing(positions.clone(), balls as u16, zone.shares(false));
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
            let sharing = zone.sharing(spread(39, step), 39, zone.shares(false));
            // Lengths of the track are folded to 2^-24 of it.
            assert!((sharing.weights / 36.5 - 1.0).abs() < 1e-5, "{sharing:?}");
            let now = loads(&zone, spread(39, step));
            for (now, before) in now.iter().zip(&last) {
                assert!((now - before).abs() < 1.01 / (36.5 * STEPS as f32));
            }
            last = now;
        }
        let closed = self::zone([37.0, 0.0, 1.0], LoadShares::EVEN);
        let sharing = closed.sharing(spread(37, 1), 37, closed.shares(false));
        assert_eq!((sharing.weights, sharing.extremes), (37.0, [1.0; 2]));
        let positions = [0, 1, u32::MAX].into_iter();
        assert_eq!(
            closed.sharing(positions, 3, closed.shares(true)).weights,
            3.0
        );
    }

    #[test]
    fn a_zone_without_a_ball_loads_none() {
        let zone = zone([0.5, 4.5, 0.4], LoadShares::EVEN);
        let far = [1 << 31].into_iter();
        let sharing = zone.sharing(far.clone(), 1, zone.shares(false));
        assert_eq!((sharing.per_weight, sharing.weights), (0.0, 0.0));
        assert_eq!(loads(&zone, far), [0.0; MOST]);
    }
}
