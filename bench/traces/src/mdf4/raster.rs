//! Channels of several rasters on one: that of the quantity which moves.
//!
//! A channel of the master's group, or of one with the same times, is taken as it is. Any other is interpolated linearly between
//! its two neighbouring samples; an angle that starts again after a turn, along the shorter way. Beyond its first and last sample
//! a channel is held for one tick of its own, and the trace is cut where it has none. Invalid samples count as missing: those of
//! the master's raster are left out with their row, those of another one are interpolated over.

use std::f64::consts::TAU;

use super::samples::Samples;
use super::table::Times;
use crate::channels::median;
use crate::table::{Column, Table};
use crate::units::{Dimension, Quantity, Unit, cut};

/// Largest share of samples that may be invalid: what `calibrate` fills.
const MOST_INVALID: f64 = 0.02;
/// Longest distance of two samples that is interpolated over, in ticks.
const LONGEST_GAP: f64 = 11.0;
/// Least share of the master's samples that every channel covers.
const LEAST_COVERED: f64 = 0.9;

#[derive(Clone, Debug)]
pub struct Track {
    pub name: String,
    pub quantity: Quantity,
    pub unit: Unit,
    pub group: usize,
    pub samples: Samples,
}

/// Puts all channels on the raster of one group.
pub fn align(times: &Times, tracks: &[Track], master: usize) -> Result<Table, String> {
    let own = times
        .get(&master)
        .ok_or("the file is damaged: a group lost its time")?;
    let direct = |track: &Track| {
        track.group == master
            || times
                .get(&track.group)
                .is_some_and(|other| other.values == own.values)
    };
    let mut notes = Vec::new();
    let mut keep = valid_rows(own, "time", &mut notes)?;
    for track in tracks.iter().filter(|track| direct(track)) {
        let rows = valid_rows(&track.samples, &track.name, &mut notes)?;
        for (keep, row) in keep.iter_mut().zip(rows) {
            *keep &= row;
        }
    }
    let mut others = Vec::new();
    for track in tracks.iter().filter(|track| !direct(track)) {
        let time = times
            .get(&track.group)
            .ok_or("the file is damaged: a group lost its time")?;
        others.push((track.name.as_str(), Curve::of(time, track, &mut notes)?));
    }
    let rows: Vec<usize> = (0..own.values.len())
        .filter(|row| keep.get(*row) == Some(&true))
        .collect();
    let rows = covered(&own.values, rows, &others, &mut notes)?;
    let at = |values: &[f64]| -> Vec<f64> {
        rows.iter()
            .filter_map(|row| values.get(*row).copied())
            .collect()
    };
    let grid = at(&own.values);
    let mut curves = others.iter();
    let mut columns = Vec::new();
    for track in tracks {
        let values = if direct(track) {
            at(&track.samples.values)
        } else {
            let (name, curve) = curves
                .next()
                .ok_or("the file is damaged: a channel lost its samples")?;
            notes.push(format!(
                "channel {}: {} samples, interpolated linearly to {}",
                cut(name),
                curve.times.len(),
                grid.len()
            ));
            curve
                .resample(&grid)
                .map_err(|message| format!("channel {}: {message}", cut(name)))?
        };
        let what = (track.quantity, track.unit);
        columns.push(Column::of((track.name.clone(), 0), what, values));
    }
    Ok(Table::of(&grid, columns, notes))
}

/// Which samples are valid; a note where some are not.
fn valid_rows(samples: &Samples, name: &str, notes: &mut Vec<String>) -> Result<Vec<bool>, String> {
    let (all, invalid) = (samples.values.len(), samples.invalid());
    if invalid == 0 {
        return Ok(vec![true; all]);
    }
    let said = format!(
        "channel {}: {invalid} of {all} samples are marked invalid or are NaN or infinite",
        cut(name)
    );
    if invalid as f64 > MOST_INVALID * all as f64 {
        return Err(format!(
            "{said}: at most {:.0} % count as missing",
            100.0 * MOST_INVALID
        ));
    }
    notes.push(format!("{said} and count as missing"));
    Ok(samples.valid.clone())
}

/// The rows that every other channel covers.
fn covered(
    times: &[f64],
    rows: Vec<usize>,
    others: &[(&str, Curve)],
    notes: &mut Vec<String>,
) -> Result<Vec<usize>, String> {
    let mut covered = rows;
    for (name, curve) in others {
        let before = covered.clone();
        let [first, last] = curve.span();
        covered.retain(|row| {
            times
                .get(*row)
                .is_some_and(|time| (first..=last).contains(time))
        });
        if covered.len() == before.len() {
            continue;
        }
        let ends = [before.first(), before.last()].map(|row| {
            row.and_then(|row| times.get(*row))
                .copied()
                .unwrap_or(f64::NAN)
        });
        let said = format!(
            "channel {} has samples from {first} to {last} s, the trace from {} to {} s",
            cut(name),
            ends[0],
            ends[1]
        );
        if (covered.len() as f64) < LEAST_COVERED * before.len() as f64 {
            return Err(format!(
                "{said}: at least {:.0} % of it must be covered",
                100.0 * LEAST_COVERED
            ));
        }
        notes.push(format!("{said}: the rest is cut off"));
    }
    Ok(covered)
}

struct Curve {
    times: Vec<f64>,
    values: Vec<f64>,
    /// Median distance of its samples, s.
    tick: f64,
    /// Whether it is an angle that starts again after a turn; then the ends of its range.
    turn: Option<(f64, f64)>,
}

impl Curve {
    /// From the valid samples; of samples at the same time, the first.
    fn of(time: &Samples, track: &Track, notes: &mut Vec<String>) -> Result<Self, String> {
        let rows = valid_rows(time, "time", notes)?;
        let valid = valid_rows(&track.samples, &track.name, notes)?;
        let (mut times, mut values) = (Vec::new(), Vec::new());
        let all = time
            .values
            .iter()
            .zip(&track.samples.values)
            .zip(rows.iter().zip(valid));
        for ((time, value), (row, valid)) in all {
            if *row && valid && times.last() != Some(time) {
                times.push(*time);
                values.push(*value);
            }
        }
        if times.len() < 2 {
            return Err(format!(
                "channel {} has {} samples: at least 2",
                cut(&track.name),
                times.len()
            ));
        }
        let tick = median(times.windows(2).map(|pair| pair[1] - pair[0]).collect());
        let angle = track.unit.dimension == Dimension::Angle
            && matches!(
                track.quantity,
                Quantity::Position(_) | Quantity::ReferencePosition
            );
        let ends = values
            .iter()
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| {
                (x.min(low), x.max(high))
            });
        Ok(Self {
            turn: (angle && ends.1 - ends.0 <= 1.01 * TAU).then_some(ends),
            times,
            values,
            tick,
        })
    }

    fn span(&self) -> [f64; 2] {
        let [first, last] =
            [self.times.first(), self.times.last()].map(|time| time.copied().unwrap_or_default());
        [first - self.tick, last + self.tick]
    }

    /// The values at these times, which rise.
    fn resample(&self, grid: &[f64]) -> Result<Vec<f64>, String> {
        let mut next = 0;
        let mut out = Vec::with_capacity(grid.len());
        for time in grid {
            while self.times.get(next).is_some_and(|own| own <= time) {
                next += 1;
            }
            let after = self.times.get(next).zip(self.values.get(next));
            let before = next
                .checked_sub(1)
                .and_then(|place| self.times.get(place).zip(self.values.get(place)));
            out.push(match (before, after) {
                (Some((start, low)), Some((end, high))) => {
                    if end - start > LONGEST_GAP * self.tick {
                        return Err(format!("a gap of {:.4} s after {start} s: at most {} ticks of {:.6} s are filled", end - start, LONGEST_GAP - 1.0, self.tick));
                    }
                    let share = (time - start) / (end - start);
                    self.between(*low, *high, share)
                }
                (Some((_, value)), None) | (None, Some((_, value))) => *value,
                (None, None) => return Err("it has no samples".into()),
            });
        }
        Ok(out)
    }

    /// The value at a share of the way; of an angle that wraps, the shorter way, within its range.
    fn between(&self, low: f64, high: f64, share: f64) -> f64 {
        if share == 0.0 {
            return low;
        }
        match self.turn {
            Some((least, most)) if (high - low).abs() > 0.5 * TAU => {
                let way = high - low - TAU * (high - low).signum();
                let value = low + share * way;
                if value > most {
                    value - TAU
                } else if value < least {
                    value + TAU
                } else {
                    value
                }
            }
            _ => low + share * (high - low),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::units::{Part, heading};

    fn track(name: &str, group: usize, values: Vec<f64>) -> Track {
        let (quantity, unit) = heading(name).unwrap().unwrap();
        Track {
            name: name.into(),
            quantity,
            unit,
            group,
            samples: Samples {
                values,
                valid: Vec::new(),
            },
        }
    }

    fn times(groups: &[&[f64]]) -> Times {
        groups
            .iter()
            .enumerate()
            .map(|(group, times)| {
                let samples = Samples {
                    values: times.to_vec(),
                    valid: Vec::new(),
                };
                (group, samples)
            })
            .collect()
    }

    #[test]
    fn another_raster_is_interpolated_and_held_for_a_tick() {
        let grid = [0.0, 0.25, 0.5, 0.75, 1.0, 1.25, 1.5];
        let tracks = vec![
            track("nut_speed", 0, vec![1.0; 7]),
            track("axial_load", 1, vec![10.0, 20.0, 30.0]),
        ];
        let table = align(&times(&[&grid, &[0.25, 0.75, 1.25]]), &tracks, 0).unwrap();
        assert_eq!(table.times, grid);
        assert_eq!(
            table.columns[1].values,
            [10.0, 10.0, 15.0, 20.0, 25.0, 30.0, 30.0]
        );
        assert!(table.notes[0].contains("interpolated"), "{:?}", table.notes);
    }

    #[test]
    fn an_angle_is_interpolated_over_its_turn() {
        let curve = |values: Vec<f64>| {
            Curve::of(
                &times(&[&[0.0, 1.0, 2.0]])[&0],
                &track("nut_position_rad", 0, values),
                &mut Vec::new(),
            )
            .unwrap()
        };
        let wrapped = curve(vec![0.0, TAU - 0.1, 0.1]);
        // Half of 0.2 rad beyond the largest value: at the turn, one rounding of a sum of that size.
        let middle = wrapped.resample(&[1.5]).unwrap()[0];
        assert!(middle.abs() < 2.0 * f64::EPSILON * TAU, "{middle}");
        let plain = curve(vec![0.0, 9.0, 1.0]);
        assert_eq!(plain.resample(&[1.5]).unwrap(), [5.0]);
        assert_eq!(
            track("nut_position_rad", 0, Vec::new()).quantity,
            Quantity::Position(Part::Nut)
        );
    }

    #[test]
    fn too_little_cover_gaps_and_invalid_samples_are_refused() {
        let grid: Vec<f64> = (0..100).map(f64::from).collect();
        let speed = track("nut_speed", 0, vec![1.0; 100]);
        let refused = |other: &[f64]| {
            let load = track("axial_load", 1, vec![1.0; other.len()]);
            align(&times(&[&grid, other]), &[speed.clone(), load], 0).map(|table| table.times.len())
        };
        let message = refused(&grid[..50]).unwrap_err();
        assert!(message.contains("90 %"), "{message}");
        // 95 samples and one tick held.
        assert_eq!(refused(&grid[..95]), Ok(96));
        let gap: Vec<f64> = grid
            .iter()
            .copied()
            .filter(|time| !(30.0..42.0).contains(time))
            .collect();
        let message = refused(&gap).unwrap_err();
        assert!(
            message.contains("a gap of 13.0000 s after 29 s"),
            "{message}"
        );
        let mut invalid = speed.clone();
        invalid.samples.valid = (0..100).map(|sample| sample % 50 != 3).collect();
        let table = align(&times(&[&grid]), &[invalid.clone()], 0).unwrap();
        assert_eq!(table.times.len(), 98);
        invalid.samples.valid[0] = false;
        let message = align(&times(&[&grid]), &[invalid], 0).unwrap_err();
        assert!(message.contains("3 of 100 samples"), "{message}");
    }
}
