//! Samples that are not to be believed: marked, and bridged by a straight line, so that every signal stays finite.
//!
//! | fault | rule |
//! |---|---|
//! | wrong | up to ten samples stand off the cubic through their four neighbours by more than the channel's noise, the change of its slope there and its travel meanwhile |
//! | lost | a channel repeats one number more often than its noise does by chance, while the mechanism moves |
//! | clipped | an effort that never repeats a number stays at its largest or smallest one |
//!
//! An effort, a load or a speed may rise and fall within a tick: several such samples are wrong only where all are one number or no two
//! neighbours agree, and an effort or a load is right where the motion answers to it.

use std::f64::consts::TAU;
use std::ops::Range;

use crate::units::{Dimension, Part, Quantity};

use crate::channels::{range, resolution};
use crate::clock::{LONGEST_GAP, cubic, median_tick};
use crate::table::{Column, Table};

/// Longest run of wrong samples: what the clock fills.
const LONGEST: usize = LONGEST_GAP as usize;
/// Largest share of a column that is marked.
const MOST: f64 = 0.05;
/// Samples of a window whose noise is looked at, and fewest of a trace.
const WINDOW: usize = 128;
/// Share of a window that wrong samples leave alone: one of them disturbs the cubics of five, so that a tenth may be wrong.
const QUIET: f64 = 0.5;
/// Noise over the quiet share of the noisiest window. Of white noise the distance from the cubic is 1.39 standard deviations, and half of
/// its sizes are below 0.67 of that: twelve of them are 11 deviations.
const BEYOND_NOISE: f64 = 12.0;
/// A window this many times as noisy as three quarters of the others is full of wrong samples.
const DENSE: f64 = 4.0;
/// Smallest spike of a speed or an effort, over its whole range: smaller ones are kinks, or do no harm.
const KINK: f64 = 1e-3;
/// Steps of a sensor that flickers.
const FLICKER: f64 = 3.0;
/// A position that jumps by this many times the fastest travel of a tick is none of the mechanism.
const JUMPS: f64 = 3.0;
/// Longest tick, s, within which a mechanism cannot reach such speeds: motors need some milliseconds.
const JUMP_TICK: f64 = 5e-3;
/// Largest share of samples that equal the one before, of a channel that does not repeat by itself.
const REPEATS: f64 = 0.25;
/// Lost runs that are chance, in a trace.
const CHANCE: f64 = 0.01;
/// Samples behind a run in which the mechanism moves on.
const NEAR: usize = 64;
/// Travel that is none, over the whole.
const REST: f64 = 1e-3;
/// Fewest equal samples at a limit, and the share of a column below which they are chance.
const CLIPPED: (usize, f64) = (5, 1e-3);
/// How often the samples that are left are judged anew.
const MOST_PASSES: usize = 50;
/// Stretches of rows that a sentence names.
const NAMED: usize = 8;

/// Why samples are not believed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Fault {
    /// Dropouts, spikes, wrong words.
    Wrong,
    /// The channel was lost.
    Lost,
    /// The effort was cut off at its limits.
    Clipped,
    /// Several of the channel's own samples in a row were missing.
    Missing,
}

/// Samples of a column that are not believed.
#[derive(Clone, Debug, PartialEq)]
pub struct LeftOut {
    /// Name of the column.
    pub column: String,
    /// Why.
    pub fault: Fault,
    /// Samples of the table.
    pub samples: Vec<Range<usize>>,
    /// The same in rows of the file, the first and the last; the first row under the heading is 1.
    pub rows: Vec<(usize, usize)>,
}

impl LeftOut {
    /// Number of samples.
    pub fn count(&self) -> usize {
        self.samples.iter().map(Range::len).sum()
    }

    /// A sentence.
    pub fn told(&self) -> String {
        let rows = self.rows.iter().take(NAMED).map(|(first, last)| {
            if first == last {
                first.to_string()
            } else {
                format!("{first} to {last}")
            }
        });
        let rows: Vec<String> = rows.collect();
        let more = if self.rows.len() > NAMED { ", ..." } else { "" };
        let why = match self.fault {
            Fault::Wrong => "off what the mechanism can do (dropouts or spikes)",
            Fault::Lost => {
                "of one number to the last digit while the mechanism moves (a channel that is lost)"
            }
            Fault::Clipped => "at the largest or smallest number (as if clipped)",
            Fault::Missing => "missing, several in a row",
        };
        format!(
            "column {}: samples {why} are left out: {}, in rows {}{more}",
            self.column,
            self.count(),
            rows.join(", "),
        )
    }
}

/// Marks what is not to be believed in every measured column.
pub fn mark(table: &mut Table) -> Result<(), String> {
    if table.times.len() < WINDOW {
        return Ok(());
    }
    let mut order: Vec<usize> = (0..table.columns.len()).collect();
    // What moves comes first: it judges the others. What is wanted, or known, may jump.
    order.retain(|place| rank(table.columns[*place].quantity) < 3);
    order.sort_by_key(|place| rank(table.columns[*place].quantity));
    let mut motion: Option<(usize, Vec<bool>)> = None;
    for place in order {
        let column = &table.columns[place];
        let rank = rank(column.quantity);
        let changes = motion.as_ref().map_or(&[][..], |(_, changes)| changes);
        let (wrong, own_changes) = wrong(table, column, changes)?;
        leave_out(table, place, Fault::Wrong, runs(&wrong))?;
        if rank < 2 && motion.is_none() {
            motion = Some((place, own_changes));
        }
        let column = &table.columns[place];
        let moving = motion.as_ref().map(|(place, _)| &table.columns[*place]);
        let (lost, clipped) = (lost(column, moving), clipped(column));
        leave_out(table, place, Fault::Lost, lost)?;
        leave_out(table, place, Fault::Clipped, clipped)?;
    }
    Ok(())
}

/// Leaves samples of a column out.
pub fn leave_out(
    table: &mut Table,
    place: usize,
    fault: Fault,
    samples: Vec<Range<usize>>,
) -> Result<(), String> {
    if samples.is_empty() {
        return Ok(());
    }
    let rows = samples
        .iter()
        .map(|run| (table.row(run.start), table.row(run.end - 1)));
    let found = LeftOut {
        column: table.columns[place].name.clone(),
        fault,
        rows: rows.collect(),
        samples,
    };
    let own = table.left_out.iter().chain([&found]);
    let own = own.filter(|other| other.column == found.column && other.fault != Fault::Missing);
    let (count, all) = (own.map(LeftOut::count).sum::<usize>(), table.times.len());
    if count as f64 > MOST * all as f64 {
        return Err(format!(
            "{}; {count} of {all} samples of this column are too many (at most {:.0} %): cut the trace, or mend the channel",
            found.told(),
            100.0 * MOST
        ));
    }
    let column = &mut table.columns[place];
    bridge(&table.times, column, &found.samples);
    column
        .left_out
        .extend(found.samples.iter().cloned().flatten());
    column.left_out.sort_unstable();
    table.left_out.push(found);
    Ok(())
}

/// Lays straight lines through runs, of an angle that wraps the shorter way; holds what is beside one at an end.
pub fn bridge(times: &[f64], column: &mut Column, runs: &[Range<usize>]) {
    let wraps = wraps(column);
    let values = &mut column.values;
    for run in runs {
        let before = run.start.checked_sub(1).unwrap_or(run.end);
        let after = if run.end < values.len() {
            run.end
        } else {
            before
        };
        if before >= values.len() {
            continue;
        }
        let (from, start) = (values[before], times[before]);
        let over = turned(values[after] - from, wraps);
        for sample in run.clone() {
            let share = (times[sample] - start) / (times[after] - start);
            values[sample] = from + if share.is_finite() { share * over } else { 0.0 };
        }
    }
}

/// Positions, then speeds, then what acts, then what is not measured.
const fn rank(quantity: Quantity) -> u8 {
    match quantity {
        Quantity::Position(_) => 0,
        Quantity::Speed(_) => 1,
        Quantity::Time
        | Quantity::ReferencePosition
        | Quantity::KnownForce
        | Quantity::KnownTorque => 3,
        _ => 2,
    }
}

/// Stretches of places that rise.
pub fn runs(places: &[usize]) -> Vec<Range<usize>> {
    places
        .chunk_by(|one, next| one + 1 == *next)
        .filter_map(|run| Some(*run.first()?..run.last()? + 1))
        .collect()
}

/// A difference of angles; of one that wraps, the shorter way.
fn turned(difference: f64, wraps: bool) -> f64 {
    if wraps {
        difference - TAU * (difference / TAU).round()
    } else {
        difference
    }
}

/// Whether a column is an angle that starts again after a turn, whatever a few of its samples do.
fn wraps(column: &Column) -> bool {
    let Quantity::Position(part) = column.quantity else {
        return false;
    };
    let angle = match column.unit.dimension {
        Dimension::Angle => true,
        Dimension::Unsaid => part != Part::Carriage,
        _ => false,
    };
    let jumps = |pair: &[f64]| (pair[1] - pair[0]).abs() > 0.5 * TAU;
    if !angle || !column.values.windows(2).any(jumps) {
        return false;
    }
    let mut sorted = column.values.clone();
    let tail = (MOST * sorted.len() as f64) as usize;
    sorted.sort_by(f64::total_cmp);
    sorted[sorted.len() - 1 - tail] - sorted[tail] <= 1.01 * TAU
}

/// Wrong samples of a column, in order, and where it changes by more than its noise. What is found is taken out, and the rest is judged
/// anew: wrong samples spoil the neighbours of others.
fn wrong(
    table: &Table,
    column: &Column,
    moves: &[bool],
) -> Result<(Vec<usize>, Vec<bool>), String> {
    let all = || 0..column.values.len();
    let wraps = wraps(column);
    let mut wrong = vec![false; all().len()];
    let mut passes = 0;
    loop {
        passes += 1;
        let kept: Vec<usize> = all().filter(|sample| !wrong[*sample]).collect();
        let channel = Channel::of(table, column, wraps, kept);
        let (found, jump) = channel.found(moves);
        for place in &found {
            wrong[channel.kept[*place]] = true;
        }
        // What seems to jump may come back once its neighbours are out. More than are left out need not be found.
        let many = (channel.kept.len() as f64) < (1.0 - MOST) * wrong.len() as f64;
        if !found.is_empty() && !many && passes < MOST_PASSES {
            continue;
        }
        if let Some((sample, jump)) = jump.filter(|_| !many) {
            return Err(format!(
                "column {}: it jumps by {jump:.4} before row {} (at {} s) and does not come back, farther than the mechanism travels in a tick: the sensor lost its place, or two records are joined; cut the trace there",
                column.name,
                table.row(sample),
                table.times[sample],
            ));
        }
        let mut changes = vec![true; wrong.len()];
        for (sample, off) in channel.kept.iter().zip(&channel.off) {
            changes[*sample] = *off > channel.noise;
        }
        return Ok((all().filter(|sample| wrong[*sample]).collect(), changes));
    }
}

/// The samples of a column that are left.
struct Channel {
    kept: Vec<usize>,
    times: Vec<f64>,
    values: Vec<f64>,
    rank: u8,
    wraps: bool,
    tick: f64,
    /// Distance of every sample from the cubic through its neighbours; 0 at the ends.
    off: Vec<f64>,
    /// Distance beyond which it is no noise.
    noise: f64,
    /// Whether the channel has noise or steps of a sensor: what has neither was not measured, and its pulses are meant.
    measured: bool,
}

/// What stands about a run: the two samples before, the two behind, from the sample before on.
struct About {
    times: [f64; 4],
    values: [f64; 4],
    /// By how much the run may stand off the cubic.
    allowed: f64,
}

impl Channel {
    fn of(table: &Table, column: &Column, wraps: bool, kept: Vec<usize>) -> Self {
        let of = |all: &[f64]| -> Vec<f64> { kept.iter().map(|sample| all[*sample]).collect() };
        let (times, values) = (of(&table.times), of(&column.values));
        let mut channel = Self {
            rank: rank(column.quantity),
            wraps,
            tick: median_tick(&times, 1),
            off: vec![0.0; values.len()],
            noise: 0.0,
            measured: false,
            kept,
            times,
            values,
        };
        for sample in 2..channel.values.len().saturating_sub(2) {
            let off = channel.about(sample - 1, sample + 1, 0.0);
            channel.off[sample] = off.map_or(0.0, |about| channel.off(sample, &about).abs());
        }
        let mut quiet: Vec<f64> = channel.off.chunks(WINDOW).map(quiet).collect();
        quiet.retain(|quiet| *quiet > 0.0);
        quiet.sort_by(f64::total_cmp);
        let most = quiet.get(quiet.len() * 3 / 4).map(|usual| DENSE * usual);
        let noisiest = quiet.last().copied().unwrap_or(0.0);
        let noise = BEYOND_NOISE * noisiest.min(most.unwrap_or(0.0));
        let noise = noise + FLICKER * resolution(&channel.values);
        let (low, high) = range(&channel.values);
        // Roundings of the numbers themselves; a speed or an effort may have a kink, and a smaller spike does no harm.
        let rounding = 1e-9 * (high - low);
        let kink = if channel.rank == 0 {
            0.0
        } else {
            KINK * (high - low)
        };
        channel.noise = (noise + rounding).max(kink);
        channel.measured = noise > rounding;
        channel
    }

    fn between(&self, from: usize, to: usize) -> f64 {
        turned(self.values[to] - self.values[from], self.wraps)
    }

    /// What stands about the samples after `before` and before `after`.
    fn about(&self, before: usize, after: usize, noise: f64) -> Option<About> {
        if before == 0 || after + 1 >= self.values.len() {
            return None;
        }
        let times @ [a, b, c, d] = [before - 1, before, after, after + 1].map(|k| self.times[k]);
        let [back, over, on] = [
            self.between(before - 1, before),
            self.between(before, after),
            self.between(after, after + 1),
        ];
        let (first, second, span) = (back / (b - a), on / (d - c), c - b);
        let goes_on = (over - 0.5 * span * (first + second)).abs();
        Some(About {
            times,
            values: [-back, 0.0, over, over + on].map(|value| value + self.values[before]),
            allowed: noise + 0.5 * span * (second - first).abs() + goes_on,
        })
    }

    /// Distance of a sample from the cubic through what stands about it.
    fn off(&self, sample: usize, about: &About) -> f64 {
        let expected = cubic(about.times, about.values, self.times[sample], 0.0);
        let expected = expected.unwrap_or(about.values[1]);
        turned(self.values[sample] - expected, self.wraps)
    }

    /// Wrong samples, in order, and the first jump that does not come back.
    fn found(&self, moves: &[bool]) -> (Vec<usize>, Option<(usize, f64)>) {
        let last = self.values.len() - 1;
        let fastest = self.fastest();
        let (mut found, mut jump) = (Vec::new(), None);
        let mut sample = 1;
        while self.measured && sample <= last {
            let step = self.between(sample - 1, sample);
            if step.abs() <= self.noise && self.off[sample] <= self.noise {
                sample += 1;
                continue;
            }
            if let Some(run) = self.run(sample, moves) {
                sample = run.last().map_or(sample, |last| *last) + 2;
                found.extend(run);
                continue;
            }
            let time = (self.times[sample] - self.times[sample - 1]).max(self.tick);
            if step.abs() > self.noise + JUMPS * fastest * time {
                let held = self.held(sample - 1);
                let travel = fastest * (self.times[sample] - self.times[held]);
                match sample {
                    // The position stood still and goes on from where it would be.
                    _ if held + 1 < sample && step.abs() <= self.noise + travel => {
                        found.extend(held + 1..sample);
                    }
                    // At an end there are no two neighbours to come back to.
                    1 | 2 => found.extend(0..sample),
                    _ if sample + 1 >= last => {
                        found.extend(sample..=last);
                        break;
                    }
                    _ => jump = jump.or(Some((self.kept[sample], step))),
                }
            }
            sample += 1;
        }
        found.dedup();
        (found, jump)
    }

    /// The first of the equal samples up to this one.
    fn held(&self, sample: usize) -> usize {
        let value = self.values[sample];
        let equal = self.values[..sample].iter().rev();
        sample - equal.take_while(|other| **other == value).count()
    }

    /// The shortest run from a sample on whose first and last stand off; those of its samples that do.
    fn run(&self, sample: usize, moves: &[bool]) -> Option<Vec<usize>> {
        for last in sample..sample + LONGEST {
            let about = self.about(sample - 1, last + 1, self.noise)?;
            let far = |sample: &usize| self.off(*sample, &about).abs() > about.allowed;
            if far(&sample) && far(&last) {
                let run: Vec<usize> = (sample..=last).filter(far).collect();
                return self.believed(&run, moves).then_some(run);
            }
        }
        None
    }

    /// Whether samples that stand off are a fault.
    fn believed(&self, run: &[usize], moves: &[bool]) -> bool {
        let pairs = || run.windows(2).map(|pair| (pair[0], pair[1]));
        let same = |(one, other): (usize, usize)| self.values[one] == self.values[other];
        let apart = |(one, other): (usize, usize)| {
            other > one + 1 || self.between(one, other).abs() > self.noise
        };
        let answered = |place: &usize| {
            let sample = self.kept[*place];
            let near = sample.saturating_sub(2)..(sample + 3).min(moves.len());
            moves.get(near).is_some_and(|near| near.contains(&true))
        };
        self.rank == 0
            || run.len() > 1 && pairs().all(same)
            || pairs().all(apart) && (self.rank == 1 || !run.iter().any(answered))
    }

    /// The largest speed of a position that holds for three of five ticks; of anything else, which may jump, none.
    fn fastest(&self) -> f64 {
        if self.rank > 0 || self.tick > JUMP_TICK {
            return f64::INFINITY;
        }
        let speed = |k: usize| self.between(k - 1, k) / (self.times[k] - self.times[k - 1]);
        (5..self.values.len())
            .map(|last| {
                let mut near = [last - 4, last - 3, last - 2, last - 1, last].map(speed);
                near.sort_by(f64::total_cmp);
                near[2].abs()
            })
            .fold(0.0, f64::max)
    }
}

fn quiet(off: &[f64]) -> f64 {
    let mut sizes = off.to_vec();
    let place = (QUIET * sizes.len() as f64) as usize;
    *sizes.select_nth_unstable_by(place, f64::total_cmp).1
}

/// Runs of more equal samples than this.
fn equal(values: &[f64], longest: usize) -> Vec<Range<usize>> {
    let mut start = 0;
    let runs = values.chunk_by(|a, b| a == b).map(|same| {
        start += same.len();
        start - same.len()..start
    });
    runs.filter(|run| run.len() > longest).collect()
}

/// Share of samples that equal the one before by chance, away from long runs; `None` where it is too large to say anything, or most of the
/// channel is in such runs.
fn repeats(values: &[f64], runs: &[Range<usize>]) -> Option<f64> {
    let within: usize = runs.iter().map(Range::len).sum();
    let others = (values.len() - within) as f64;
    let all = values.windows(2).filter(|pair| pair[0] == pair[1]).count();
    let repeated = (all + runs.len()).saturating_sub(within).max(1);
    let share = repeated as f64 / others;
    (others >= REPEATS * values.len() as f64 && share <= REPEATS).then_some(share)
}

/// Stretches in which a speed, an effort or a load is lost while the mechanism moves.
fn lost(column: &Column, motion: Option<&Column>) -> Vec<Range<usize>> {
    let values = &column.values;
    let acts = rank(column.quantity) > 0 && column.quantity != Quantity::Temperature;
    let Some(share) = repeats(values, &equal(values, LONGEST)).filter(|_| acts) else {
        return Vec::new();
    };
    // So many repeats in a row are chance.
    let chance = (values.len() as f64 / CHANCE).ln() / -share.ln();
    let (low, high) = range(values);
    let moves = |run: &Range<usize>| motion.is_none_or(|motion| travels(motion, run));
    let mut runs = equal(values, chance.ceil() as usize);
    runs.retain(|run| {
        let value = values[run.start];
        let behind = run.end..(run.end + NEAR).min(values.len());
        match column.quantity {
            Quantity::Speed(_) => value != 0.0,
            // At a limit it is clipped; at zero the drive may be off until the motion stops.
            Quantity::MotorTorque | Quantity::MotorForce => {
                moves(run) && value != low && value != high && (value != 0.0 || moves(&behind))
            }
            _ => moves(run),
        }
    });
    // A ramp that never repeats is no noise: of white noise two samples of three are turning points.
    let turns = values.windows(3);
    let turns = turns.filter(|near| (near[1] - near[0]) * (near[2] - near[1]) < 0.0);
    if turns.count() as f64 > REPEATS * values.len() as f64 {
        runs
    } else {
        Vec::new()
    }
}

/// Whether a position or a speed shows motion in a stretch.
fn travels(motion: &Column, run: &Range<usize>) -> bool {
    let (low, high) = range(&motion.values);
    let (least, most) = range(&motion.values[run.clone()]);
    if matches!(motion.quantity, Quantity::Speed(_)) {
        most.max(-least) > REST.sqrt() * high.max(-low)
    } else {
        most - least > REST * (high - low)
    }
}

/// Stretches in which an effort stands at its limits. Zero is none: the drive is off.
fn clipped(column: &Column) -> Vec<Range<usize>> {
    let effort = matches!(
        column.quantity,
        Quantity::MotorTorque | Quantity::MotorForce
    );
    let values = &column.values;
    let (low, high) = range(values);
    let mut runs = equal(values, CLIPPED.0 - 1);
    let varies = effort && low < high && repeats(values, &runs).is_some();
    runs.retain(|run| {
        let value = values[run.start];
        varies && value != 0.0 && (value == low || value == high)
    });
    let stay: usize = runs.iter().map(Range::len).sum();
    if stay as f64 > CLIPPED.1 * values.len() as f64 {
        runs
    } else {
        Vec::new()
    }
}
