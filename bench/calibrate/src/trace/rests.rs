//! Where a trace stands still.
//!
//! Between two steps of its sensor, or within its noise, a motion has no direction; friction at rest is anything up to
//! breakaway, or nothing where the drive is off. Such samples belong to no direction of sliding and are left out of every
//! regression, on both sides of it. What they can tell is that friction is at least as large as the effort there. A stop in
//! which the effort follows a load is none.

use std::borrow::Cow;
use std::collections::VecDeque;
use std::ops::Range;

use epas_traces::clock::LONGEST_GAP;

use crate::signals::noise::white_noise;
use crate::trace::Trace;
use crate::trace::channels::{range, resolution};
use crate::trace::clipped::clipped;
use crate::trace::free_load::correlation;

/// Shortest rest, s. A weave of 0.6 rad at 0.2 Hz stays for 0.22 s within a step of 6 mrad (a coarse encoder of ten bits)
/// where it turns round: a rest is longer.
const SHORTEST: f64 = 0.3;
/// Shortest rest, s, of a motion that stops and starts faster than any smooth turn.
const SHORTEST_STOP: f64 = 0.05;
/// How far a smooth turn goes, in the bands that it stays within: as it leaves with the square of the time, a position moves on by three
/// bands within half of its stay, with the fourth power by 15. What goes further stood still.
const STOP: f64 = 15.0;
/// The same of a speed, which leaves with the third power at most.
const STOP_SPEED: f64 = 8.0;
/// Fewest samples of a rest.
const FEWEST: usize = 8;
/// Steps of a sensor that flickers between two values; a sample that was interpolated may lie beyond them by a little.
const FLICKER: f64 = 1.25;
/// White noise beyond this share of the sensor's step is no rounding.
const ROUNDING: f64 = 0.4;
/// Range of some hundred samples of white noise, and the largest of them, in standard deviations.
const SPREAD: (f64, f64) = (8.0, 4.0);
/// Deviations of a mean that are no motion.
const MEAN: f64 = 3.0;

/// Correlation of effort and load from which most of the effort's changes are the load's: a half of their square.
const FOLLOWS: f64 = 0.7;

/// Stretches that say nothing of sliding, in order: at rest, where a channel was lost, or where the effort is clipped.
pub fn rests(trace: &Trace) -> Vec<Range<usize>> {
    let still = still(trace);
    let clipped = clipped(&trace.effort, &still);
    // A longer stretch than the clock fills says nothing by what bridges it.
    let long = |stretch: &&Range<usize>| stretch.len() as f64 > LONGEST_GAP;
    let lost = trace.left_out.iter().filter(long).cloned().collect();
    let mut all = [still, lost, clipped].concat();
    all.sort_by_key(|stretch| stretch.start);
    let mut joined: Vec<Range<usize>> = Vec::new();
    for stretch in all {
        match joined.last_mut() {
            Some(last) if last.end >= stretch.start => last.end = last.end.max(stretch.end),
            _ => joined.push(stretch),
        }
    }
    joined
}

/// Stretches at rest, in order.
pub fn still(trace: &Trace) -> Vec<Range<usize>> {
    let window = |time: f64| ((time / trace.step).ceil() as usize).max(FEWEST);
    let windows = [SHORTEST_STOP, SHORTEST].map(window);
    let mut rests = match trace.speed.as_deref().filter(|_| trace.position_summed) {
        Some(speed) => of_speed(speed, windows),
        None => of_position(&trace.position, trace.resolution, windows),
    };
    rests.retain(|rest| !holds(trace, rest));
    rests
}

/// Whether a drive holds against a load that changes: such a stop tells the load's gain, and what is remembered of the friction.
fn holds(trace: &Trace, rest: &Range<usize>) -> bool {
    let load = trace
        .load
        .as_deref()
        .and_then(|load| load.get(rest.clone()));
    let effort = trace.effort.get(rest.clone());
    load.zip(effort)
        .is_some_and(|(load, effort)| correlation(load, effort) > FOLLOWS)
}

/// A signal without its rests.
pub fn moving<'a>(signal: &'a [f64], rests: &[Range<usize>]) -> Cow<'a, [f64]> {
    if rests.is_empty() {
        return Cow::Borrowed(signal);
    }
    let starts = std::iter::once(0).chain(rests.iter().map(|rest| rest.end));
    let ends = rests.iter().map(|rest| rest.start).chain([signal.len()]);
    let stretches = starts
        .zip(ends)
        .filter_map(|(start, end)| signal.get(start..end));
    Cow::Owned(stretches.flatten().copied().collect())
}

/// The noise of a signal beyond its rounding.
fn noise(signal: &[f64], resolution: f64) -> f64 {
    let white = white_noise(signal);
    if white <= ROUNDING * resolution {
        0.0
    } else {
        white
    }
}

/// Where the position stays within a step of its sensor, or its noise, for the longer window, or for the shorter one between a stop and a
/// start.
fn of_position(position: &[f64], resolution: f64, [short, long]: [usize; 2]) -> Vec<Range<usize>> {
    let (low, high) = range(position);
    let rounding = 1e-12 * (high - low);
    let band = (FLICKER * resolution)
        .max(SPREAD.0 * noise(position, resolution))
        .max(rounding);
    let far = |from: usize, to: usize| (position[to] - position[from]).abs() > STOP * band;
    // Windows of a slow motion join to a stretch that goes on.
    let stays = |rest: &Range<usize>| {
        let (low, high) = range(&position[rest.clone()]);
        high - low <= 2.0 * band
    };
    let stop = |rest: &Range<usize>| stays(rest) && stops(rest, position.len(), far);
    with_stops(
        within(position, band, long),
        within(position, band, short).into_iter().filter(stop),
    )
}

/// Where a signal stays within a band for a window.
fn within(position: &[f64], band: f64, window: usize) -> Vec<Range<usize>> {
    let (mut least, mut most) = (VecDeque::new(), VecDeque::new());
    let mut rests = Vec::new();
    let mut first = 0;
    for (sample, value) in position.iter().enumerate() {
        push(&mut least, sample, |other| position[other] >= *value);
        push(&mut most, sample, |other| position[other] <= *value);
        while let (Some(lowest), Some(highest)) = (least.front(), most.front()) {
            let (lowest, highest): (usize, usize) = (*lowest, *highest);
            if position[highest] - position[lowest] <= band {
                break;
            }
            first = lowest.min(highest) + 1;
            least.retain(|other| *other >= first);
            most.retain(|other| *other >= first);
        }
        if sample + 1 - first >= window {
            add(&mut rests, first..sample + 1);
        }
    }
    rests
}

/// Rests, and short ones that are apart from them, in order.
fn with_stops(
    mut rests: Vec<Range<usize>>,
    short: impl Iterator<Item = Range<usize>>,
) -> Vec<Range<usize>> {
    let apart = |rest: &Range<usize>| {
        let at = rests.partition_point(|other| other.end < rest.start);
        rests.get(at).is_none_or(|other| rest.end < other.start)
    };
    let short: Vec<Range<usize>> = short.filter(apart).collect();
    rests.extend(short);
    rests.sort_by_key(|rest| rest.start);
    rests
}

/// Whether a short rest lies between a stop and a start: `far` says so of its first or last sample and one that is half its length away. At
/// an end of the trace there is nothing to be seen.
fn stops(rest: &Range<usize>, samples: usize, far: impl Fn(usize, usize) -> bool) -> bool {
    let half = rest.len() / 2;
    let before = rest.start.checked_sub(half);
    let after = rest.end - 1 + half;
    before.is_some_and(|before| far(rest.start, before))
        && after < samples
        && far(rest.end - 1, after)
}

/// Adds a sample behind those of a list that it does not outdo.
fn push(list: &mut VecDeque<usize>, sample: usize, outdone: impl Fn(usize) -> bool) {
    while list.back().is_some_and(|last| outdone(*last)) {
        list.pop_back();
    }
    list.push_back(sample);
}

/// Where the speed, and its mean over a window, are no more than a step of its sensor or its noise: over the longer window, or over the
/// shorter one between a stop and a start.
fn of_speed(speed: &[f64], [short, long]: [usize; 2]) -> Vec<Range<usize>> {
    let (short, largest) = slow(speed, short);
    let far = |_: usize, to: usize| speed[to].abs() > STOP_SPEED * largest;
    let stop = |rest: &Range<usize>| stops(rest, speed.len(), far);
    with_stops(slow(speed, long).0, short.into_iter().filter(stop))
}

/// Where the speed, and its mean over a window, are no more than a step of its sensor or its noise, and the largest such speed.
fn slow(speed: &[f64], window: usize) -> (Vec<Range<usize>>, f64) {
    let step = resolution(speed);
    let noise = noise(speed, step);
    let largest = (FLICKER * step).max(SPREAD.1 * noise);
    let mean = (0.5 * step).max(MEAN * noise / (window as f64).sqrt());
    let mut rests = Vec::new();
    let (mut sum, mut first) = (0.0, 0);
    for (sample, value) in speed.iter().enumerate() {
        if value.abs() > largest {
            (sum, first) = (0.0, sample + 1);
            continue;
        }
        sum += value;
        if sample + 1 - first > window {
            sum -= speed[sample - window];
            first += 1;
        }
        if sample + 1 - first == window && sum.abs() <= mean * window as f64 {
            add(&mut rests, first..sample + 1);
        }
    }
    (rests, largest)
}

/// Adds a stretch, and joins it with the last one where they touch.
fn add(rests: &mut Vec<Range<usize>>, stretch: Range<usize>) {
    match rests.last_mut() {
        Some(last) if last.end >= stretch.start => last.end = stretch.end,
        _ => rests.push(stretch),
    }
}
