//! Samples that no mechanism makes: dropouts and spikes of a channel.
//!
//! A sample is left out where it stands off the cubic through its four neighbours by more than the channel's own noise,
//! by more than the speed changes there, and by more than the channel moves on meanwhile: to get there and back, the
//! mechanism would need a speed that it has neither before nor after. A run of up to ten such samples is left out where
//! the channel goes on behind it as before. An angle may start again after a turn.
//!
//! An effort or a load can rise and fall within a tick, and a run of such samples may be a pulse. There a run is left
//! out only where all its samples are the same number to the last digit, which a noisy channel never reads by itself, or
//! where no two neighbours agree, which no pulse does; and it stays where the motion answers to it.
//!
//! Where samples that stand off are dense, they spoil the neighbours of others. So what was found is taken out, and the
//! rest is judged anew, until nothing more is found; and the noise of a stretch in which they are dense is that of its
//! samples that agree with any two neighbours.
//!
//! A word that is lost reads the same number each time. A number that a channel reads far more often than those beside it, and that mostly
//! stands off its neighbours, is such a word: it says nothing about the channel's noise, and is left out where half the distance shows it.
//! So many of them may stand close together.

#[cfg(test)]
mod tests;

use std::collections::{HashMap, HashSet};
use std::f64::consts::TAU;

use crate::trace::channels::{range, resolution};
use crate::trace::clock::{LONGEST_GAP, MOST_MISSING, cubic, median_tick};
use crate::trace::table::{Column, Table};
use epas_traces::units::{Dimension, Part, Quantity};

/// Longest run that is left out: what the clock fills.
const LONGEST: usize = LONGEST_GAP as usize;
/// Samples of a window whose roughness is looked at, and fewest of a channel.
const WINDOW: usize = 128;
/// Share of a window that outliers leave alone: a run of ten disturbs the cubics of 14 samples, a tenth of the window.
const QUIET: f64 = 0.75;
/// Noise beyond which a sample is none of it, over the quiet share of the roughest window. Of white noise the distance from
/// the cubic is 1.39 standard deviations, three quarters of its sizes are below 1.15 of that: seven of them are 11
/// deviations, and of a Laplace distribution's samples 6 in 100,000 are beyond.
const BEYOND_NOISE: f64 = 7.0;
/// The same of the distances from the nearest of the lines through one neighbour on each side: how many of them are
/// looked at, the share that outliers leave alone, and the factor that makes of it the quiet share of white noise.
const PAIRS: usize = 3;
const QUIET_PAIRS: f64 = 0.6;
const PAIRS_TO_CUBIC: f64 = 7.4;
/// A window whose distances from the cubics are this many times what those from the lines say is full of outliers.
const DENSE: f64 = 3.0;
/// Share of a window's samples that repeat the one before, from which on an effort, a load or a speed is one of a slower
/// raster, whose plateaus agree with their neighbours.
const HELD: f64 = 0.5;
/// Steps of the sensor that flicker.
const FLICKER: f64 = 3.0;
/// A position that jumps by this many times the fastest travel of a tick is none of the mechanism.
pub(super) const JUMPS: f64 = 3.0;
/// Longest tick, s, within which a mechanism cannot leave and reach such speeds: motors need some milliseconds for it.
pub(super) const JUMP_TICK: f64 = 5e-3;
/// Fewest samples of one number that may be a lost word, and how many times as many they are as those of the numbers beside it.
const WORD: (usize, f64) = (5, 10.0);
/// Numbers on both sides of one that its count is compared with.
const BESIDE: usize = 16;
/// Share of the noise's limit beyond which a lost word stands off: four deviations instead of seven times the quiet share.
const WORD_BEYOND: f64 = 0.5;
/// Fewest samples of a window whose neighbours are no lost words.
const LEFT: usize = 16;
/// Rows that a message names.
const NAMED: usize = 12;

/// Samples of a column that were left out.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LeftOut {
    /// Name of the column.
    pub column: String,
    /// Their rows in the file; the first row under the heading is 1.
    pub rows: Vec<usize>,
}

impl LeftOut {
    /// A sentence.
    pub fn told(&self) -> String {
        let count = self.rows.len();
        let many = if count == 1 {
            "sample stands"
        } else {
            "samples stand"
        };
        format!(
            "column {}: {count} {many} off what the mechanism can do (dropouts or spikes), left out and interpolated: {}",
            self.column,
            listed(&self.rows)
        )
    }
}

fn listed(rows: &[usize]) -> String {
    let names: Vec<String> = rows.iter().take(NAMED).map(ToString::to_string).collect();
    let more = if rows.len() > NAMED { ", ..." } else { "" };
    let word = if rows.len() == 1 { "row" } else { "rows" };
    format!("{word} {}{more}", names.join(", "))
}

/// Replaces what no mechanism makes by what stands about it; what was left out, column by column.
///
/// # Errors
/// A column with too many such samples, or a position that jumps.
pub fn clean(table: &mut Table) -> Result<Vec<LeftOut>, String> {
    if table.times.len() < WINDOW {
        return Ok(Vec::new());
    }
    let mut found = Vec::new();
    let mut motion: Option<Roughness> = None;
    let mut order: Vec<usize> = (0..table.columns.len()).collect();
    // What moves comes first: it judges the others.
    order.sort_by_key(|place| rank(table.columns[*place].quantity));
    for place in order {
        let quantity = table.columns[place].quantity;
        if !judged(quantity) {
            continue;
        }
        let column = &table.columns[place];
        let (values, samples) = cleaned(table, column, motion.as_ref())?;
        let rows: Vec<usize> = samples.iter().map(|sample| table.row(*sample)).collect();
        check_share(&column.name, column.values.len(), &rows)?;
        if !samples.is_empty() {
            let column = &mut table.columns[place];
            column.values = values;
            column.left_out = samples;
            found.push(LeftOut {
                column: column.name.clone(),
                rows,
            });
        }
        if rank(quantity) <= 1 && motion.is_none() {
            let column = &table.columns[place];
            motion = Some(Channel::of(&table.times, &column.values, column, &[]).roughness());
        }
    }
    Ok(found)
}

/// The values of a column with what no mechanism makes replaced by what stands about it, and those samples.
fn cleaned(
    table: &Table,
    column: &Column,
    motion: Option<&Roughness>,
) -> Result<(Vec<f64>, Vec<usize>), String> {
    let mut kept: Vec<usize> = (0..column.values.len()).collect();
    let mut first = None;
    loop {
        let of = |all: &[f64]| -> Vec<f64> { kept.iter().map(|sample| all[*sample]).collect() };
        let (times, values) = (of(&table.times), of(&column.values));
        let channel = Channel::of(&times, &values, column, &kept);
        let rough = channel.roughness();
        let (found, jumps) = if rough.measured {
            channel.runs(&rough, motion, table)
        } else {
            (Vec::new(), None)
        };
        // What seems to jump may come back once its neighbours are out. More than are left out need not be found.
        let many = (kept.len() as f64) < (1.0 - MOST_MISSING) * column.values.len() as f64;
        if found.is_empty() || many {
            return jumps
                .filter(|_| found.is_empty())
                .or(first.filter(|_| many))
                .map_or_else(|| Ok(channel.filled(&table.times, &column.values)), Err);
        }
        first = first.or(jumps);
        let mut found = found.into_iter().peekable();
        let mut place = 0;
        kept.retain(|_| {
            place += 1;
            found.next_if_eq(&(place - 1)).is_none()
        });
    }
}

/// Positions, then speeds, then what acts.
const fn rank(quantity: Quantity) -> u8 {
    match quantity {
        Quantity::Position(_) => 0,
        Quantity::Speed(_) => 1,
        _ => 2,
    }
}

/// Whether a column is measured: what is wanted, or known, may jump.
const fn judged(quantity: Quantity) -> bool {
    !matches!(
        quantity,
        Quantity::Time | Quantity::ReferencePosition | Quantity::KnownForce | Quantity::KnownTorque
    )
}

fn check_share(name: &str, all: usize, rows: &[usize]) -> Result<(), String> {
    if rows.len() as f64 <= MOST_MISSING * all as f64 {
        return Ok(());
    }
    Err(format!(
        "column {name}: {} of {all} samples stand off what the mechanism can do, as a loose plug or a word that is torn makes them ({}): at most {:.0} % are left out",
        rows.len(),
        listed(rows),
        100.0 * MOST_MISSING
    ))
}

/// A column with its times, of those samples that are left.
struct Channel<'a> {
    name: &'a str,
    /// Their places in the column; nothing where all are left.
    kept: &'a [usize],
    times: &'a [f64],
    values: &'a [f64],
    quantity: Quantity,
    /// Whether it is an angle that starts again after a turn.
    wraps: bool,
    tick: f64,
}

/// How rough a channel is.
struct Roughness {
    /// Whether it has noise or steps of a sensor: what has neither was not measured, and its pulses are meant.
    measured: bool,
    /// Distance of every sample from the cubic through its neighbours; 0 at the ends.
    off: Vec<f64>,
    /// Distance beyond which it is no noise.
    noise: f64,
    /// Whether a sample reads a lost word; nothing where none is lost.
    lost: Vec<bool>,
}

impl Roughness {
    /// Distance beyond which a sample is no noise.
    fn beyond(&self, sample: usize) -> f64 {
        if self.is_lost(sample) {
            WORD_BEYOND * self.noise
        } else {
            self.noise
        }
    }

    fn is_lost(&self, sample: usize) -> bool {
        self.lost.get(sample) == Some(&true)
    }
}

/// What stands about a run: the two samples before, the two behind.
struct About {
    places: [usize; 4],
    /// Values, from the sample before the run on.
    values: [f64; 4],
    /// By how much the run may stand off the cubic.
    allowed: f64,
}

impl<'a> Channel<'a> {
    fn of(times: &'a [f64], values: &'a [f64], column: &'a Column, kept: &'a [usize]) -> Self {
        let angle = matches!(column.quantity, Quantity::Position(part) if turns(part, column.unit.dimension));
        Self {
            name: &column.name,
            kept,
            times,
            values,
            quantity: column.quantity,
            wraps: angle && wraps(values),
            tick: median_tick(times, 1),
        }
    }

    /// A difference; of an angle that wraps, the shorter way.
    fn between(&self, from: usize, to: usize) -> f64 {
        let moved = self.values[to] - self.values[from];
        if self.wraps {
            moved - TAU * (moved / TAU).round()
        } else {
            moved
        }
    }

    /// What stands about the samples after `before` and before `after`.
    fn about(&self, before: usize, after: usize, noise: f64) -> Option<About> {
        let last = self.values.len() - 1;
        if before == 0 || after >= last {
            return None;
        }
        let places = [before - 1, before, after, after + 1];
        let [a, b, c, d] = places.map(|place| self.times[place]);
        let [back, over, on] = [
            self.between(places[0], before),
            self.between(before, after),
            self.between(after, places[3]),
        ];
        let (first, second) = (back / (b - a), on / (d - c));
        let span = c - b;
        let goes_on = (over - 0.5 * span * (first + second)).abs();
        Some(About {
            places,
            values: [-back, 0.0, over, over + on],
            allowed: noise + 0.5 * span * (second - first).abs() + goes_on,
        })
    }

    /// Distance of a sample from the cubic through what stands about it.
    fn off(&self, sample: usize, about: &About) -> f64 {
        let times = about.places.map(|place| self.times[place]);
        let expected = cubic(times, about.values, self.times[sample], 0.0).unwrap_or(0.0);
        let off = self.between(about.places[1], sample) - expected;
        if self.wraps {
            off - TAU * (off / TAU).round()
        } else {
            off
        }
    }

    fn roughness(&self) -> Roughness {
        let samples = self.values.len();
        let mut off = vec![0.0; samples];
        for (sample, off) in off.iter_mut().enumerate().skip(2) {
            if let Some(about) = self.about(sample - 1, sample + 1, 0.0) {
                *off = self.off(sample, &about).abs();
            }
        }
        let nearest = self.nearest();
        // Roundings of the numbers themselves.
        let (low, high) = range(self.values);
        let rounding = 1e-9 * (high - low);
        let steps = FLICKER * resolution(self.values);
        let noise = |quiet: f64| BEYOND_NOISE * quiet + steps;
        let often = often(self.values);
        let about = |sample: usize| sample.saturating_sub(2)..(sample + 3).min(samples);
        let without = |sample: usize| !often[about(sample)].contains(&true);
        let (all, others) = (
            self.roughest(&off, &nearest, 0, |_| true).unwrap_or(0.0),
            (often.contains(&true))
                .then(|| self.roughest(&off, &nearest, LEFT, without))
                .flatten(),
        );
        let lost = others.map_or_else(Vec::new, |quiet| {
            self.lost(often, &off, WORD_BEYOND * noise(quiet) + rounding)
        });
        let quiet = if lost.is_empty() {
            all
        } else {
            let without = |sample: usize| !lost[about(sample)].contains(&true);
            self.roughest(&off, &nearest, LEFT, without).unwrap_or(all)
        };
        let noise = noise(quiet);
        Roughness {
            measured: noise > rounding,
            off,
            noise: noise + rounding,
            lost,
        }
    }

    /// Distance of every sample from the nearest of the lines through one of its neighbours on each side; 0 at the ends.
    fn nearest(&self) -> Vec<f64> {
        let samples = self.values.len();
        let mut nearest = vec![0.0; samples];
        let inner = samples.saturating_sub(PAIRS);
        for (sample, nearest) in nearest.iter_mut().enumerate().take(inner).skip(PAIRS) {
            let lines = (1..=PAIRS).flat_map(|back| (1..=PAIRS).map(move |on| (back, on)));
            let off = |(back, on): (usize, usize)| {
                let (before, after) = (sample - back, sample + on);
                let share = (self.times[sample] - self.times[before])
                    / (self.times[after] - self.times[before]);
                let over = self.between(before, after);
                (self.between(before, sample) - share * over).abs()
            };
            *nearest = lines.map(off).fold(f64::INFINITY, f64::min);
        }
        nearest
    }

    /// The quiet share of the roughest window, of samples that count; nothing where no window has so many of them.
    fn roughest(
        &self,
        off: &[f64],
        nearest: &[f64],
        fewest: usize,
        counts: impl Fn(usize) -> bool,
    ) -> Option<f64> {
        (0..off.len())
            .step_by(WINDOW)
            .filter(|start| 2 * (off.len() - start) > WINDOW)
            .filter_map(|start| {
                let window = start..(start + WINDOW).min(off.len());
                let values = &self.values[window.clone()];
                let repeats = values.windows(2).filter(|pair| pair[0] == pair[1]).count();
                let held = rank(self.quantity) > 0 && repeats as f64 > HELD * values.len() as f64;
                let samples: Vec<usize> = window.filter(|sample| counts(*sample)).collect();
                if samples.is_empty() || samples.len() < fewest {
                    return None;
                }
                let quiet = |of: &[f64], share: f64| {
                    let mut sizes: Vec<f64> = samples.iter().map(|sample| of[*sample]).collect();
                    let place = (share * sizes.len() as f64) as usize;
                    *sizes.select_nth_unstable_by(place, f64::total_cmp).1
                };
                let by_cubics = quiet(off, QUIET);
                let by_lines = PAIRS_TO_CUBIC * quiet(nearest, QUIET_PAIRS);
                Some(if !held && by_cubics > DENSE * by_lines {
                    by_lines
                } else {
                    by_cubics
                })
            })
            .reduce(f64::max)
    }

    /// Those of the numbers that are read often that mostly stand off their neighbours by more than this; nothing where there are none.
    fn lost(&self, mut often: Vec<bool>, off: &[f64], beyond: f64) -> Vec<bool> {
        let mut counts: HashMap<u64, (usize, usize)> = HashMap::new();
        // Within a stretch that stays there is nothing to stand off from.
        let inner = |sample: usize| {
            let near = self.values.get(sample.saturating_sub(1)..sample + 2);
            near.is_some_and(|near| near.iter().all(|value| *value == self.values[sample]))
        };
        for (sample, _) in often.iter().enumerate().filter(|(_, often)| **often) {
            if inner(sample) {
                continue;
            }
            let (all, far) = counts.entry(bits(self.values[sample])).or_default();
            *all += 1;
            *far += usize::from(off[sample] > beyond);
        }
        for (often, value) in often.iter_mut().zip(self.values) {
            let mostly = |(all, far): &(usize, usize)| 2 * far > *all;
            *often = *often && counts.get(&bits(*value)).is_some_and(mostly);
        }
        if often.contains(&true) {
            often
        } else {
            Vec::new()
        }
    }

    /// Samples that no mechanism makes, in order; and what is to be said of the first jump that does not come back.
    fn runs(
        &self,
        rough: &Roughness,
        motion: Option<&Roughness>,
        table: &Table,
    ) -> (Vec<usize>, Option<String>) {
        let fastest = self.fastest(rough);
        let samples = self.values.len();
        let [start, end] = self.ends(rough.noise, fastest);
        let mut found: Vec<usize> = (0..start).collect();
        let mut jumps = None;
        let mut sample = start + 1;
        while sample < end.min(samples - 1) {
            let left = sample - 1;
            let jump = self.between(left, sample);
            let beyond = rough.beyond(sample);
            if jump.abs() <= beyond && rough.off[sample] <= beyond {
                sample += 1;
                continue;
            }
            if let Some(run) = self.run(sample, rough, motion) {
                sample = run.last().map_or(sample, |last| *last) + 2;
                found.extend(run);
                continue;
            }
            if jumps.is_none() && self.jumps(left, jump, rough.noise, fastest) {
                jumps = Some((sample, jump));
            }
            sample += 1;
        }
        found.extend(end..samples);
        let said = jumps.map(|(sample, jump)| {
            format!(
                "column {}: it jumps by {jump:.4} before row {} (at {} s) and does not come back, {:.0} times as far as the mechanism travels in a tick: the sensor lost its place, or two records are joined; cut the trace there",
                self.name,
                table.row(self.kept[sample]),
                self.times[sample],
                jump.abs() / (fastest * self.tick).max(f64::MIN_POSITIVE)
            )
        });
        (found, said)
    }

    /// Samples between those of a position's ends that have no two neighbours on one side and jump to their one.
    fn ends(&self, noise: f64, fastest: f64) -> [usize; 2] {
        let last = self.values.len() - 1;
        let jumps = |before: &usize| {
            let jump = self.between(*before, before + 1);
            self.jumps(*before, jump, noise, fastest)
        };
        let start = [1, 0].into_iter().find(jumps).map_or(0, |place| place + 1);
        let end = [last - 2, last - 1].into_iter().find(jumps);
        [start, end.map_or(last + 1, |place| place + 1)]
    }

    /// The shortest run that starts at a sample and stands off at its first and last: all its samples that do.
    fn run(
        &self,
        sample: usize,
        rough: &Roughness,
        motion: Option<&Roughness>,
    ) -> Option<Vec<usize>> {
        for last in sample..sample + LONGEST {
            let about = self.about(sample - 1, last + 1, rough.beyond(sample))?;
            let far = |sample: &usize| self.off(*sample, &about).abs() > about.allowed;
            if far(&sample) && far(&last) {
                let run: Vec<usize> = (sample..=last).filter(far).collect();
                return self.believed(&run, rough, motion).then_some(run);
            }
        }
        None
    }

    /// Whether a run of samples that stand off is a fault: of an effort, a load or a speed, one word, or samples of which no
    /// two neighbours agree; of an effort or a load those stay where the motion answers.
    fn believed(&self, run: &[usize], rough: &Roughness, motion: Option<&Roughness>) -> bool {
        let rank = rank(self.quantity);
        let mut pairs = run.windows(2).map(|pair| (pair[0], pair[1]));
        let same = |(one, other): (usize, usize)| self.values[one] == self.values[other];
        let apart = |(one, other): (usize, usize)| {
            other > one + 1 || (self.values[one] - self.values[other]).abs() > rough.noise
        };
        rank == 0
            || run.len() > 1 && pairs.clone().all(same)
            || pairs.all(apart)
                && (rank == 1 || !run.iter().any(|place| answered(self.kept[*place], motion)))
    }

    /// Whether a position moves farther than the mechanism can.
    fn jumps(&self, before: usize, jump: f64, noise: f64, fastest: f64) -> bool {
        let time = (self.times[before + 1] - self.times[before]).max(self.tick);
        rank(self.quantity) == 0
            && self.tick <= JUMP_TICK
            && jump.abs() > noise + JUMPS * fastest * time
    }

    /// The largest speed that holds for three of five ticks, away from lost words.
    fn fastest(&self, rough: &Roughness) -> f64 {
        let speeds: Vec<f64> = (1..self.values.len())
            .map(|sample| {
                let time = self.times[sample] - self.times[sample - 1];
                self.between(sample - 1, sample) / time
            })
            .collect();
        speeds
            .windows(5)
            .enumerate()
            .filter(|(first, _)| !(*first..first + 6).any(|sample| rough.is_lost(sample)))
            .map(|(_, near)| {
                let mut near = [near[0], near[1], near[2], near[3], near[4]];
                near.sort_by(f64::total_cmp);
                near[2].abs()
            })
            .fold(0.0, f64::max)
    }

    /// All values of the column, those that are not left replaced by the cubic through what stands about them, and held at
    /// an end; and the samples that are not left.
    fn filled(&self, times: &[f64], all: &[f64]) -> (Vec<f64>, Vec<usize>) {
        let mut values = all.to_vec();
        let mut filled = Vec::new();
        let (low, high) = range(self.values);
        let mut after = 0;
        for (sample, value) in values.iter_mut().enumerate() {
            if self.kept.get(after) == Some(&sample) {
                after += 1;
                continue;
            }
            filled.push(sample);
            let before = after.checked_sub(1);
            let about = before.and_then(|before| self.about(before, after, 0.0));
            let (Some(before), Some(about)) = (before, about) else {
                *value = self.values[before.unwrap_or(after)];
                continue;
            };
            let places = about.places.map(|place| self.times[place]);
            let expected = cubic(places, about.values, times[sample], 0.0).unwrap_or(0.0);
            *value = self.values[before] + expected;
            if self.wraps && *value > high {
                *value -= TAU;
            } else if self.wraps && *value < low {
                *value += TAU;
            }
        }
        (values, filled)
    }
}

/// The bits of a number; zero has no sign.
fn bits(value: f64) -> u64 {
    (value + 0.0).to_bits()
}

/// Whether a sample reads a number that is read far more often than those beside it.
fn often(values: &[f64]) -> Vec<bool> {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let counts: Vec<(f64, usize)> = sorted
        .chunk_by(|a, b| a == b)
        .filter_map(|same| Some((*same.first()?, same.len())))
        .collect();
    let found: HashSet<u64> = (0..counts.len())
        .filter(|place| {
            let (_, own) = counts[*place];
            let near = place.saturating_sub(BESIDE)..(place + BESIDE + 1).min(counts.len());
            let others = near.len() - 1;
            let sum: usize = counts[near].iter().map(|(_, count)| count).sum();
            let beside = (sum - own) as f64 / others.max(1) as f64;
            own >= WORD.0 && own as f64 > WORD.1 * beside
        })
        .map(|place| bits(counts[place].0))
        .collect();
    values
        .iter()
        .map(|value| found.contains(&bits(*value)))
        .collect()
}

/// Whether the motion changes about a sample by more than its noise: then an effort's peak was real.
fn answered(sample: usize, motion: Option<&Roughness>) -> bool {
    motion.is_some_and(|motion| {
        let near = sample.saturating_sub(2)..(sample + 3).min(motion.off.len());
        motion.off[near].iter().any(|off| *off > motion.noise)
    })
}

/// Whether a position is an angle.
const fn turns(part: Part, dimension: Dimension) -> bool {
    matches!(dimension, Dimension::Angle)
        || !matches!(part, Part::Carriage) && matches!(dimension, Dimension::Unsaid)
}

/// Whether an angle starts again after a turn, whatever a few of its samples do.
fn wraps(values: &[f64]) -> bool {
    let jumps = values
        .windows(2)
        .filter(|pair| (pair[1] - pair[0]).abs() > 0.5 * TAU)
        .count();
    if jumps == 0 {
        return false;
    }
    let mut sorted = values.to_vec();
    let tail = (MOST_MISSING * values.len() as f64) as usize;
    let last = sorted.len() - 1 - tail;
    sorted.sort_by(f64::total_cmp);
    sorted[last] - sorted[tail] <= 1.01 * TAU
}
