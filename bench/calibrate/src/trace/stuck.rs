//! A channel that stays at one and the same number while the mechanism moves: a sensor or a bus that is lost for a while.
//!
//! Up to ten such samples are single faults ([`super::outliers`]). A longer stretch cannot be filled, and would be taken for a measurement.
//! It is known by the channel's own noise, which repeats a number to the last digit by chance only; a channel that does so by itself, as
//! one of coarse steps or of a slower raster, is not judged. A speed is lost where it leaves within a tick for a number, stays there, and
//! comes back to where it was, or where it stays while it rises or falls, and goes on within a tick from where it would be by then: a mechanism
//! would need time for either.

#[cfg(test)]
mod tests;

use std::ops::Range;

use crate::trace::channels::{range, resolution};
use crate::trace::clock::{LONGEST_GAP, MOST_MISSING, median_tick};
use crate::trace::outliers::{JUMP_TICK, JUMPS};
use crate::trace::table::{Column, Table};
use epas_traces::units::Quantity;

/// Longest run that is a single fault, samples.
const LONGEST: usize = LONGEST_GAP as usize;
/// Largest share of samples that equal the one before, of a channel that does not repeat by itself: eleven of them in a row are chance once
/// in four million samples.
const REPEATS: f64 = 0.25;
/// Least share of the samples that are in no long run.
const OTHERS: f64 = 0.25;
/// Samples on both sides of a run that are looked at, and the share of turning points among them from which they are noisy.
const NEAR: usize = 64;
const TURNS: f64 = 0.25;
/// How near to where it was a speed comes back, over how far it went.
const BACK: f64 = 0.25;
/// How near to where it would be by then a speed goes on that was held, over how far it jumps.
const GOES_ON: f64 = 0.5;
/// How near to a limit the next number is, over the whole range.
const BESIDE_LIMIT: f64 = 0.1;
/// Travel that is none, over the whole.
const REST: f64 = 1e-3;

/// Finds where a speed, an effort or a load is lost while the mechanism moves, lays a straight line through it, and says so; of a
/// temperature it says so only. The stretches, as samples of the table, in which nothing counts.
///
/// # Errors
/// More of a column than is left out of it; its rows and the number.
pub fn clean(table: &mut Table) -> Result<Vec<Range<usize>>, String> {
    let position = |column: &&Column| matches!(column.quantity, Quantity::Position(_));
    let speed = |column: &&Column| matches!(column.quantity, Quantity::Speed(_));
    let [position, speed] = [
        table.columns.iter().find(position),
        table.columns.iter().find(speed),
    ];
    let motion = position.or(speed);
    let (mut all, mut notes, mut filled) = (Vec::new(), Vec::new(), Vec::new());
    for (place, column) in table.columns.iter().enumerate() {
        let found = match column.quantity {
            // Beside a position it is compared, and not used.
            Quantity::Speed(_) if position.is_none() => lost_speed(&table.times, &column.values),
            Quantity::MotorTorque
            | Quantity::MotorForce
            | Quantity::Load
            | Quantity::LoadTorque
            | Quantity::Temperature => stuck(&column.values),
            _ => continue,
        };
        let effort = matches!(
            column.quantity,
            Quantity::MotorTorque | Quantity::MotorForce
        );
        let own = matches!(column.quantity, Quantity::Speed(_));
        let lost: Vec<Range<usize>> = found
            .into_iter()
            .filter(|run| own || motion.is_none_or(|motion| travels(motion, run)))
            .filter(|run| !(effort && meant(&column.values, run, motion)))
            .collect();
        let Some(first) = lost.first() else {
            continue;
        };
        let count: usize = lost.iter().map(Range::len).sum();
        let stays = format!(
            "column {}: it stays at {} to the last digit from row {} to {}{}, while the mechanism moves",
            column.name,
            (column.values[first.start] - column.unit.offset) / column.unit.factor,
            table.row(first.start),
            table.row(first.end - 1),
            match lost.len() {
                1 => String::new(),
                stretches => format!(", and so in {stretches} stretches, {count} samples in all"),
            },
        );
        if column.quantity == Quantity::Temperature {
            notes.push(format!("{stays}, and is taken as it is"));
        } else if count as f64 > MOST_MISSING * column.values.len() as f64 {
            return Err(format!(
                "{stays}: the channel was lost, or is held, for more than {:.0} % of the trace; cut the trace there",
                100.0 * MOST_MISSING
            ));
        } else {
            notes.push(format!("{stays}, as a channel that is lost: left out"));
            filled.extend(lost.iter().map(|run| (place, run.clone())));
            all.extend(lost);
        }
    }
    for (place, run) in filled {
        bridge(&table.times, &mut table.columns[place].values, &run);
    }
    table.notes.extend(notes);
    Ok(all)
}

/// Lays a straight line through a run.
fn bridge(times: &[f64], values: &mut [f64], run: &Range<usize>) {
    let before = run.start.checked_sub(1).unwrap_or(run.end);
    let after = if run.end < values.len() {
        run.end
    } else {
        before
    };
    let (Some(from), Some(to)) = (values.get(before).copied(), values.get(after).copied()) else {
        return;
    };
    let span = times[after] - times[before];
    for sample in run.clone() {
        let share = if span > 0.0 {
            (times[sample] - times[before]) / span
        } else {
            0.0
        };
        values[sample] = from + share * (to - from);
    }
}

/// Runs of one number that are longer than a single fault.
fn long_runs(values: &[f64]) -> Vec<Range<usize>> {
    let mut start = 0;
    let mut runs = Vec::new();
    for same in values.chunk_by(|a, b| a == b) {
        if same.len() > LONGEST {
            runs.push(start..start + same.len());
        }
        start += same.len();
    }
    runs
}

/// Whether a channel is noisy about a run: of white noise two samples of three are turning points.
fn noisy(values: &[f64], run: &Range<usize>) -> bool {
    let before = values.get(run.start.saturating_sub(NEAR)..run.start);
    let after = values.get(run.end..(run.end + NEAR).min(values.len()));
    let (mut turns, mut all) = (0, 0);
    for side in before.into_iter().chain(after) {
        let near = side.windows(3);
        all += near.len();
        turns += near
            .filter(|near| (near[1] - near[0]) * (near[2] - near[1]) < 0.0)
            .count();
    }
    turns as f64 > TURNS * all as f64
}

/// Long runs of a noisy channel that does not repeat by itself.
fn stuck(values: &[f64]) -> Vec<Range<usize>> {
    let runs = long_runs(values);
    let within: usize = runs.iter().map(Range::len).sum();
    let others = (values.len() - within) as f64;
    let all = values.windows(2).filter(|pair| pair[0] == pair[1]).count();
    let repeated = all - (within - runs.len());
    if others < OTHERS * values.len() as f64 || repeated as f64 > REPEATS * others {
        return Vec::new();
    }
    runs.into_iter().filter(|run| noisy(values, run)).collect()
}

/// Long runs that a speed leaves within a tick for where it was, where it came within a tick, or for where it would be by then, where it was
/// held; and those of a speed whose noise never repeats a number, but not at zero, which may be a rest.
fn lost_speed(times: &[f64], speed: &[f64]) -> Vec<Range<usize>> {
    let tick = median_tick(times, 1);
    let moving = |run: &Range<usize>| speed[run.start] != 0.0;
    let mut noisy = stuck(speed);
    noisy.retain(moving);
    if tick > JUMP_TICK {
        return noisy;
    }
    let fastest = speed
        .windows(6)
        .map(|near| {
            let mut changes = [0, 1, 2, 3, 4].map(|place| (near[place + 1] - near[place]).abs());
            changes.sort_by(f64::total_cmp);
            changes[2]
        })
        .fold(0.0, f64::max);
    let (low, high) = range(speed);
    // Of a coarse sensor a slow speed goes to and fro by a step.
    let step = resolution(speed);
    let mut runs = long_runs(speed);
    runs.retain(|run| {
        if noisy.contains(run) {
            return true;
        }
        let Some(before) = run.start.checked_sub(1).filter(|_| run.end < speed.len()) else {
            return false;
        };
        // A gap of the clock leaves time for more.
        let jump = |from: usize, to: usize| {
            let ticks = ((times[to] - times[from]) / tick).max(1.0);
            let jump = (speed[to] - speed[from]).abs();
            if jump > JUMPS * (fastest * ticks + step) + REST * (high - low) {
                jump
            } else {
                0.0
            }
        };
        let (to, back) = (jump(before, run.start), jump(run.end - 1, run.end));
        let returns = (speed[run.end] - speed[before]).abs() <= BACK * to.min(back);
        if to > 0.0 {
            return back > 0.0 && returns;
        }
        let slope = |from: usize| {
            let to = from + LONGEST;
            let change = speed.get(to).map(|after| after - speed[from]);
            change.map_or(0.0, |change| change / (times[to] - times[from]))
        };
        let slopes = slope(before.saturating_sub(LONGEST)) + slope(run.end);
        let went_on = 0.5 * slopes * (times[run.end] - times[before]);
        let off = speed[run.end] - speed[before] - went_on;
        back > 0.0 && moving(run) && off.abs() <= GOES_ON * back
    });
    runs
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

/// Whether an effort stays because it is clipped at a limit, next to which it is at other times, or because the drive is off until the motion
/// stops.
fn meant(values: &[f64], run: &Range<usize>, motion: Option<&Column>) -> bool {
    let (low, high) = range(values);
    let value = values[run.start];
    let others = values.iter().filter(|other| **other != value);
    let nearest = others
        .map(|other| (other - value).abs())
        .fold(f64::INFINITY, f64::min);
    if (value == low || value == high) && nearest < BESIDE_LIMIT * (high - low) {
        return true;
    }
    let behind = run.end..run.end + NEAR;
    value == 0.0
        && motion.is_none_or(|motion| behind.end > values.len() || !travels(motion, &behind))
}
