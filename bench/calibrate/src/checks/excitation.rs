//! What a trace excites, and so what it can tell.

use std::ops::Range;

use crate::checks::finding::{Finding, FindingKind};
use crate::checks::relation::root_mean_square;
use crate::signals::Motion;
use crate::trace::channels::range;
use crate::trace::rests::moving;
use crate::trace::{Coordinate, Trace};

/// Share of the speed's root mean square below which a motion rests.
const REST: f64 = 0.02;
/// Least share of the moving time in the rarer direction.
const RARER: f64 = 0.01;
/// Fewest samples that move.
const MOVING: usize = 50;
/// Fewest reversals that show how the friction turns.
const REVERSALS: usize = 10;
/// Ratio of the fastest to the slowest of one speed, and the share of the moving time that has it; the rest are starts and stops.
const ONE_SPEED: f64 = 1.3;
const MOSTLY: f64 = 0.9;
/// Share of the largest load below which its deviation is no change.
const LOAD_CHANGES: f64 = 0.1;
/// Range of temperature below which there is no change, K.
const TEMPERATURE_CHANGES: f64 = 5.0;
/// A fifth of the least breakaway travel that is usual: 2 mrad of a nut, 5 um of a carriage.
const FINE_ENOUGH: [f64; 2] = [0.4e-3, 1e-6];

/// Says for how long the trace rests, and within which efforts it stayed there.
///
/// # Errors
/// A trace that rests throughout.
pub fn stands_still(
    trace: &Trace,
    rests: &[Range<usize>],
    findings: &mut Vec<Finding>,
) -> Result<(), String> {
    let samples: usize = rests.iter().map(Range::len).sum();
    if samples == 0 {
        return Ok(());
    }
    if trace.len() - samples < MOVING {
        return Err(format!(
            "the trace rests: its position or speed leaves the sensor's step, or its noise, in {} of {} samples only; no friction of sliding shows",
            trace.len() - samples,
            trace.len()
        ));
    }
    let at_rest: Vec<f64> = rests
        .iter()
        .filter_map(|rest| trace.effort.get(rest.clone()))
        .flatten()
        .copied()
        .collect();
    let (low, high) = range(&at_rest);
    let many = if rests.len() == 1 {
        "stretch"
    } else {
        "stretches"
    };
    findings.push(Finding::new(
        FindingKind::Rests,
        samples as f64,
        format!(
            "the trace stands still for {:.2} s of {:.2} s, in {} {many}: such samples belong to no direction of sliding and are left out; the effort there is {low:.3e} to {high:.3e}",
            samples as f64 * trace.step,
            trace.len() as f64 * trace.step,
            rests.len()
        ),
    ));
    Ok(())
}

/// Shares of the samples that move forwards and backwards.
fn directions(motion: &Motion) -> [f64; 2] {
    let slow = rest(motion);
    let share = |direction: f64| {
        let count = motion
            .speed
            .iter()
            .filter(|w| direction * **w > slow)
            .count();
        count as f64 / motion.speed.len().max(1) as f64
    };
    [share(1.0), share(-1.0)]
}

/// Speed below which the motion rests: what its noise may be, or little of what it is.
fn rest(motion: &Motion) -> f64 {
    let (noise, little) = (
        4.0 * motion.noise[0],
        REST * root_mean_square(&motion.speed),
    );
    if noise > little { noise } else { little }
}

/// Whether the motion goes both ways.
pub fn both_ways(motion: &Motion) -> bool {
    let [forwards, backwards] = directions(motion);
    forwards.min(backwards) > RARER * (forwards + backwards)
}

/// Number of times that the motion turns back, rests left out.
fn reversals(motion: &Motion) -> usize {
    let slow = rest(motion);
    let mut last = 0.0;
    let mut count = 0;
    for speed in motion.speed.iter().filter(|w| w.abs() > slow) {
        let direction = 1.0_f64.copysign(*speed);
        if last != 0.0 && direction != last {
            count += 1;
        }
        last = direction;
    }
    count
}

/// The speed, where it has one size for most of the time that the trace moves. A speed that was measured is not smoothed for it:
/// starts and stops are short.
pub fn one_speed(trace: &Trace, motion: &Motion, rests: &[Range<usize>]) -> Option<f64> {
    const MOST: usize = 100_000;
    let slow = rest(motion);
    let measured = trace.speed.as_deref().filter(|_| trace.position_summed);
    let moves = moving(measured.unwrap_or(&motion.speed), rests);
    let mut speeds: Vec<f64> = moves
        .iter()
        .step_by(moves.len() / MOST + 1)
        .map(|w| w.abs())
        .filter(|w| *w > slow)
        .collect();
    speeds.sort_by(f64::total_cmp);
    let middle = speeds.get(speeds.len() / 2).copied()?;
    let within = |limit: f64| speeds.partition_point(|speed| *speed < limit);
    let near = within(middle * ONE_SPEED.sqrt()) - within(middle / ONE_SPEED.sqrt());
    (near as f64 > MOSTLY * speeds.len() as f64).then_some(middle)
}

/// How much the load changes: its deviation from its mean, over its largest value; 0 without.
fn load_changes(load: &[f64]) -> f64 {
    let (low, high) = range(load);
    let largest = high.max(-low);
    let count = load.len().max(1) as f64;
    let mean = load.iter().sum::<f64>() / count;
    let square = load.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>() / count;
    if largest > 0.0 {
        square.sqrt() / largest
    } else {
        0.0
    }
}

/// Adds what the trace cannot tell.
///
/// # Errors
/// A trace that tells nothing.
pub fn add(
    trace: &Trace,
    motion: &Motion,
    rests: &[Range<usize>],
    findings: &mut Vec<Finding>,
) -> Result<(), String> {
    let mut add =
        |kind, figure, message: String| findings.push(Finding::new(kind, figure, message));
    let both_ways = both_ways(motion);
    let one_speed = one_speed(trace, motion, rests);
    let changes = load(trace, &mut add);
    if let (Some(speed), false, false) = (one_speed, both_ways, changes) {
        return Err(format!(
            "one speed ({speed:.4}) in one direction without a change of load: friction, offset and drag are one number; move both ways, at several speeds"
        ));
    }
    if let Some(speed) = one_speed {
        add(
            FindingKind::ConstantSpeed,
            speed,
            format!("the trace moves at one speed ({speed:.4}): what depends on speed is not told"),
        );
    }
    let reversals = reversals(motion);
    if both_ways {
        if reversals < REVERSALS {
            add(
                FindingKind::FewReversals,
                reversals as f64,
                format!(
                    "the motion turns back {reversals} times only: how friction turns is told badly"
                ),
            );
        }
    } else {
        add(
            FindingKind::OneDirection,
            directions(motion)[0],
            "the motion goes one way: friction and offset are one number".into(),
        );
    }
    let acceleration = root_mean_square(&motion.acceleration);
    if acceleration < 3.0 * motion.noise[1] {
        add(
            FindingKind::NoAcceleration,
            acceleration / motion.noise[1],
            "the acceleration hardly stands out of its noise: inertia is not told".into(),
        );
    }
    let fine = match trace.coordinate {
        Coordinate::Rotation => FINE_ENOUGH[0],
        Coordinate::Translation => FINE_ENOUGH[1],
    };
    if trace.resolution > fine {
        add(
            FindingKind::CoarsePosition,
            trace.resolution,
            format!(
                "the position's sensor has steps of {:.3e}: what happens before sliding takes a few of them only",
                trace.resolution
            ),
        );
    }
    Ok(())
}

/// Adds what load and temperature do not tell; whether the load changes.
fn load(trace: &Trace, add: &mut impl FnMut(FindingKind, f64, String)) -> bool {
    let changes = trace.load.as_deref().map(load_changes);
    match (&trace.load, changes) {
        (Some(load), Some(0.0)) => {
            let value = load.first().copied().unwrap_or_default();
            let kind = if value == 0.0 {
                FindingKind::NoLoad
            } else {
                FindingKind::DeadChannel
            };
            add(
                kind,
                value,
                format!("the load is {value} N at every sample: what depends on load is not told"),
            );
        }
        (Some(_), Some(changes)) if changes < LOAD_CHANGES => add(
            FindingKind::ConstantLoad,
            changes,
            format!(
                "the load varies by {:.1} % only: what depends on load is not told apart from what does not",
                100.0 * changes
            ),
        ),
        (None, _) => add(
            FindingKind::NoLoad,
            0.0,
            "the trace has no load: what depends on load is not told".into(),
        ),
        _ => {}
    }
    let span = trace.temperature.as_deref().map(|temperature| {
        let (low, high) = range(temperature);
        high - low
    });
    if !span.is_some_and(|span| span >= TEMPERATURE_CHANGES) {
        let span = span.unwrap_or(0.0);
        add(
            FindingKind::ConstantTemperature,
            span,
            format!("the temperature varies by {span:.1} K: what depends on it is not told"),
        );
    }
    changes.is_some_and(|changes| changes >= LOAD_CHANGES)
}
