//! What a trace has that the equation has not, or has wrongly: the likeliest cause with its evidence.
//!
//! In this order, because each earlier cause makes the later ones look true: numbers that ran over; exchanged columns; sign, unit and ratio
//! of the load; a turned sign; a load that follows the position; a ripple over the angle; a late channel; friction that differs by
//! direction or falls away from rest.

use std::f64::consts::{PI, TAU};

use rustfft::FftPlanner;
use rustfft::num_complex::Complex;

use super::choice::{Estimate, Wanted, estimate};
use super::fit::{Block, dot, solver};
use super::record::Record;
use super::rows::Rows;
use super::terms::Term;
use crate::page::shown::digits;
use crate::trace::channels::{median, range, resolution};
use crate::trace::{Coordinate, Trace};

/// Share of the effort that is left from which on nothing is explained, and from which on a fit is doubted.
const NOTHING: f64 = 0.9;
const DOUBTED: f64 = 0.5;

/// What a trace tells with all that was found in it.
#[derive(Clone, Debug)]
pub struct Diagnosis {
    /// The numbers.
    pub estimate: Estimate,
    /// Sentences on what was found.
    pub words: Vec<String>,
    /// The ripple over the position, or the load that follows it: its wave number, 1/rad or 1/m.
    pub wave: Option<f64>,
}

/// What a record tells, and what is in it beside the equation.
///
/// # Errors
/// Why the trace is refused: what is wrong with it.
pub fn diagnose(record: &Record, trace: &Trace) -> Result<Diagnosis, String> {
    let names = Names::of(trace);
    let Some(found) = screened(record, &names)? else {
        return Err("no stretch of one direction is long enough to tell anything: move to and fro by more, or faster, than the sensor's steps".into());
    };
    with_more(record, found, &names)
}

/// What a record tells by the equation alone, where nothing is wrong with its columns; nothing where no stretch is long enough.
fn screened(record: &Record, names: &Names<'_>) -> Result<Option<Estimate>, String> {
    if let Some(word) = ran_over(&record.effort, names) {
        return Err(word);
    }
    let found = estimate_of(record, &Wanted::default());
    if let Some(word) = exchanged(record, found.as_ref(), names) {
        return Err(word);
    }
    let wrong = found
        .as_ref()
        .and_then(|found| of_signs(record, found, names));
    wrong.map_or(Ok(found), Err)
}

/// What is wrong with sign, unit or ratio.
fn of_signs(record: &Record, found: &Estimate, names: &Names<'_>) -> Option<String> {
    load(found, names)
        .or_else(|| hidden_jump(record, found, names))
        .or_else(|| turned(record, found, names))
}

/// What is wrong with a trace whose friction has another equation, and how late a channel is.
///
/// # Errors
/// Why the trace is refused.
pub fn wrong(record: &Record, trace: &Trace) -> Result<Option<String>, String> {
    let names = Names::of(trace);
    let found = screened(record, &names)?;
    if let Some(word) = found
        .as_ref()
        .and_then(|found| apart(record, found, &names))
    {
        return Err(word);
    }
    Ok(found
        .and_then(|found| late(record, &found, &[]))
        .map(|(_, word)| word))
}

/// Adds the terms that the residual asks for.
fn with_more(record: &Record, found: Estimate, names: &Names<'_>) -> Result<Diagnosis, String> {
    let mut words = Vec::new();
    let (mut found, mut wave) = (found, None);
    let moves = found.of(Term::OneSpeed).is_none();
    if moves && !record.speed_alone {
        if let Some((better, number, word)) = load_of_position(record, &found, names) {
            (found, wave) = (better, Some(number));
            words.push(word);
        } else if let Some((better, number, word)) = ripple(record, &found, names) {
            (found, wave) = (better, Some(number));
            words.push(word);
        }
    }
    let more = wave.map_or_else(Vec::new, |wave| vec![Term::Sine(wave), Term::Cosine(wave)]);
    if moves
        && !record.speed_alone
        && let Some(word) = apart(record, &found, names)
    {
        return Err(word);
    }
    if let Some((better, word)) = late(record, &found, &more) {
        found = better;
        words.push(word);
    }
    if moves {
        words.extend(asymmetry(record, &found, &more, names));
        if let Some((better, word)) = stribeck(record, &found, &more, names) {
            found = better;
            words.push(word);
        }
    }
    words.extend(zero(record, &found, &more, names));
    words.extend(doubts(&found, names));
    if found.fit.relative > NOTHING {
        let word = format!(
            "nothing in the trace explains its effort: {:.0} % of it are left; is the right column the {}, and does what moves belong to it?",
            100.0 * found.fit.relative,
            names.effort
        );
        return Err(word);
    }
    Ok(Diagnosis {
        estimate: found,
        words,
        wave,
    })
}

/// Share of the effort that is left from which on it is said.
const MUCH: f64 = 0.2;

/// What no drive has: friction or losses below zero, much of the effort unexplained.
fn doubts(found: &Estimate, names: &Names<'_>) -> Vec<String> {
    let below = |term: Term| {
        let (value, half) = found.of(term)?;
        (value < -half).then_some((value, half))
    };
    let mut words = Vec::new();
    for (term, name) in [
        (Term::Coulomb, "Coulomb friction"),
        (Term::OneSpeed, "friction"),
        (Term::Viscous, "viscous friction"),
    ] {
        if let Some((value, half)) = below(term) {
            words.push(format!(
                "{name} is {} +- {}, below zero, which none is: the equation lacks a term; the numbers beside it are in doubt too",
                digits(value, 3),
                digits(half, 2)
            ));
        }
    }
    for (term, name) in [
        (Term::Driving, "driving loss"),
        (Term::BackDriving, "back-driving loss"),
    ] {
        if let Some((value, half)) = below(term) {
            words.push(format!(
                "the {name} is {} +- {}, below zero, which none is: {} reads too much or too little, or has an offset",
                digits(value, 3),
                digits(half, 2),
                names.load
            ));
        }
    }
    if (MUCH..NOTHING).contains(&found.fit.relative) {
        words.push(format!(
            "the equation leaves {:.0} % of the effort: something acts that is not in it, and the intervals do not hold that",
            100.0 * found.fit.relative
        ));
    }
    words
}

/// Names of a trace's columns, and units.
struct Names<'a> {
    effort: &'a str,
    load: &'a str,
    motion: &'a str,
    unit: &'static str,
    length: &'static str,
    /// Columns between which a gear's ratio is missing.
    without_ratio: Option<[&'a str; 2]>,
}

impl<'a> Names<'a> {
    fn of(trace: &'a Trace) -> Self {
        let [effort, load, unit, length] = match trace.coordinate {
            Coordinate::Rotation => ["motor_torque", "load_torque", "N m", "rad"],
            Coordinate::Translation => ["motor_force", "axial_load", "N", "m"],
        };
        let origins = &trace.origins;
        let motion = origins.motion.as_ref().map(|(name, _)| name.as_str());
        Self {
            effort: Some(origins.effort.as_str())
                .filter(|name| !name.is_empty())
                .unwrap_or(effort),
            load: origins.load.as_deref().unwrap_or(load),
            motion: motion.unwrap_or("the position"),
            unit,
            length,
            without_ratio: origins.without_ratio(),
        }
    }
}

fn estimate_of(record: &Record, wanted: &Wanted) -> Option<Estimate> {
    estimate(std::slice::from_ref(record), wanted)
}

/// A fit that a drive cannot have.
fn bad(found: &Estimate) -> bool {
    let below = |term: Term| found.of(term).is_some_and(|(value, half)| value < -half);
    found.fit.relative > DOUBTED || below(Term::Coulomb) || below(Term::Inertia)
}

/// An effort that fills a power of two of its steps, and jumps by as much between two samples.
fn ran_over(effort: &[f64], names: &Names<'_>) -> Option<String> {
    let step = resolution(effort);
    let (low, high) = range(effort);
    [8, 10, 12, 16].into_iter().find_map(|bits| {
        let whole = step * 2_f64.powi(bits);
        let jumps = effort.windows(2).filter(|pair| (pair[1] - pair[0]).abs() > 0.8 * whole);
        let count = jumps.count();
        let fills = (0.85 * whole..=1.0001 * whole).contains(&(high - low));
        (step > 0.0 && fills && count > 1).then(|| {
            let why = if low >= -0.5 * step {
                "a number that was read without its sign"
            } else {
                "a number that ran over its range"
            };
            format!(
                "{} jumps by 2^{bits} of its steps ({} {}) between two samples, {count} times: {why}",
                names.effort,
                digits(whole, 4),
                names.unit
            )
        })
    })
}

/// Position and effort are exchanged: the other way round the equation holds.
fn exchanged(record: &Record, found: Option<&Estimate>, names: &Names<'_>) -> Option<String> {
    let left = found.map_or(1.0, |found| found.fit.relative);
    if record.speed_alone || left < DOUBTED {
        return None;
    }
    let other = estimate_of(&record.exchanged(), &Wanted::default())?;
    let (inertia, half) = other.of(Term::Inertia)?;
    let (coulomb, _) = other.of(Term::Coulomb)?;
    let holds = other.fit.relative < 0.2_f64.min(0.5 * left);
    (holds && inertia > 2.0 * half && coulomb > 0.0).then(|| {
        format!(
            "{} and {} are exchanged: the other way round the equation leaves {:.0} % of the effort, as it stands {:.0} %",
            names.motion,
            names.effort,
            100.0 * other.fit.relative,
            100.0 * left
        )
    })
}

/// Largest travel of a drive over its angle, m/rad: a rack of a pinion of 0.4 m, a lead of 1.3 m.
const LONGEST: f64 = 0.2;

/// Sign, unit or ratio of the load, by how much of it the effort carries: `((1 + driving_loss) + (1 - back_driving_loss))/2`.
fn load(found: &Estimate, names: &Names<'_>) -> Option<String> {
    if let Some((gain, half)) = found.of(Term::Gain)
        && gain.abs() - half > LONGEST
    {
        let Names { load, effort, .. } = names;
        return Some(format!(
            "a newton of {load} takes {} N m of {effort}, as on a lever of that many metres: is the load in kN? Then its name is {load}_kN; or is the torque in mN m ({effort}_mNm)?",
            digits(gain, 3)
        ));
    }
    let ((driving, half), (back, _)) = (found.of(Term::Driving)?, found.of(Term::BackDriving)?);
    let carried = 1.0 + 0.5 * (driving - back);
    let sure = half < 0.2 * carried.abs().max(0.1);
    if bad(found) && found.fit.relative > DOUBTED || !sure || (0.7..1.4).contains(&carried) {
        return None;
    }
    let cause = if (-1.4..-0.7).contains(&carried) {
        // A turned effort turns the friction too.
        let coulomb = found.of(Term::Coulomb).map_or(0.0, |(coulomb, _)| coulomb);
        let turned = if coulomb < 0.0 {
            names.effort
        } else {
            names.load
        };
        format!("turn the sign of {turned}")
    } else if (700.0..1400.0).contains(&carried) {
        format!(
            "{} is in m{}, or {} in k{}",
            names.effort, names.unit, names.load, names.unit
        )
    } else if (7e-4..1.4e-3).contains(&carried) {
        format!(
            "{} is in k{}, or {} in m{}",
            names.effort, names.unit, names.load, names.unit
        )
    } else {
        let ratio = digits(1.0 / carried, 3);
        match names.without_ratio {
            Some([one, other]) => format!(
                "a gear between {one} and {other} would do that: give --ratio (here {ratio}), or mend a unit"
            ),
            None => format!("mend a unit, or give the ratio of a gear (--ratio; here {ratio})"),
        }
    };
    Some(format!(
        "{} carries {} times {}: {cause}",
        names.effort,
        digits(carried, 3),
        names.load
    ))
}

/// A jump that hides in the turns: Coulomb friction below zero beside a sound inertia and drag.
fn hidden_jump(record: &Record, found: &Estimate, names: &Names<'_>) -> Option<String> {
    let (coulomb, half) = found.of(Term::Coulomb)?;
    let above = |term: Term| found.of(term).is_some_and(|(value, _)| value > 0.0);
    let step = resolution(&record.effort);
    let (low, high) = range(&record.effort);
    let whole = [8, 10, 12, 16].map(|bits| step * 2_f64.powi(bits));
    let whole = whole
        .into_iter()
        .find(|whole| *whole > 0.0 && (high - low..3.0 * (high - low)).contains(whole))?;
    (coulomb < -half && above(Term::Inertia) && above(Term::Viscous)).then(|| {
        format!(
            "Coulomb friction is {} {} beside a sound inertia: {} ran over by {} {} at the turns, a power of two of its steps",
            digits(coulomb, 3),
            names.unit,
            names.effort,
            digits(whole, 4),
            names.unit
        )
    })
}

/// Power out of friction: over closed ways inertia and a load of the position give none.
fn turned(record: &Record, found: &Estimate, names: &Names<'_>) -> Option<String> {
    let (coulomb, _) = found
        .of(Term::Coulomb)
        .or_else(|| found.of(Term::OneSpeed))?;
    let share = energy(record);
    let taken = coulomb < 0.0 && share < -0.02 || bad(found) && share < -0.1;
    taken.then(|| {
        format!(
            "the effort takes power from friction over closed ways ({:.0} % of what flows): turn the sign of {}, or of the motion",
            -100.0 * share,
            names.effort
        )
    })
}

/// Work of the effort, without its median, over the sum of its sizes.
fn energy(record: &Record) -> f64 {
    let own = record.load.as_deref().filter(|_| record.load_is_effort);
    let at = |sample: usize| record.effort[sample] - own.map_or(0.0, |load| load[sample]);
    let efforts: Vec<f64> = (0..record.len()).map(at).collect();
    let median = median(efforts.clone());
    let (mut work, mut size) = (0.0, 0.0);
    for (effort, pair) in efforts.iter().zip(record.path.windows(2)) {
        let part = (effort - median) * (pair[1] - pair[0]);
        work += part;
        size += part.abs();
    }
    work / size.max(f64::MIN_POSITIVE)
}

/// A better fit with a wave of the position, chosen again over all kernels.
fn with_wave(record: &Record, wave: f64) -> Option<Estimate> {
    let wanted = Wanted {
        more: vec![Term::Sine(wave), Term::Cosine(wave)],
        ..Wanted::default()
    };
    estimate_of(record, &wanted)
}

fn amplitude(found: &Estimate, wave: f64) -> f64 {
    let of = |term: Term| found.of(term).map_or(0.0, |(value, _)| value);
    of(Term::Sine(wave)).hypot(of(Term::Cosine(wave)))
}

/// A load that follows the position: a sine and a cosine of it, of a turn or of a part of the stroke, take two fifths of the residual.
fn load_of_position(
    record: &Record,
    found: &Estimate,
    names: &Names<'_>,
) -> Option<(Estimate, f64, String)> {
    let (low, high) = range(&record.path);
    let stroke = high - low;
    let mut waves = [1.5, 3.0, 6.0].map(|part| part / stroke).to_vec();
    if names.length == "rad" && stroke < 30.0 {
        waves.insert(0, 1.0);
    }
    let mut best: Option<(f64, f64)> = None;
    for wave in waves {
        let wanted = Wanted {
            more: vec![Term::Sine(wave), Term::Cosine(wave)],
            kernel: Some((found.length, found.settling)),
            ..Wanted::default()
        };
        let Some(other) = estimate_of(record, &wanted) else {
            continue;
        };
        let left = other.fit.residual_rms;
        if !bad(&other) && best.is_none_or(|(_, before)| left < 0.8 * before) {
            best = Some((wave, left));
        }
    }
    let (wave, left) = best?;
    if left > 0.6 * found.fit.residual_rms {
        return None;
    }
    let better = with_wave(record, wave)?;
    let word = format!(
        "a load that follows the position is not in the trace: a wave of {} {} over {} {} takes the residual from {:.1} to {:.1} %; give {}",
        digits(amplitude(&better, wave), 3),
        names.unit,
        digits(TAU / wave, 3),
        names.length,
        100.0 * found.fit.relative,
        100.0 * better.fit.relative,
        names.load
    );
    Some((better, wave, word))
}

/// Bins of the position, share of the residual's variance, height over the median line, and periods in the stroke of a ripple.
const BINS: usize = 4096;
const SHARE: f64 = 0.2;
const HEIGHT: f64 = 30.0;
const PERIODS: f64 = 5.0;

/// A torque that repeats over the position.
fn ripple(record: &Record, found: &Estimate, names: &Names<'_>) -> Option<(Estimate, f64, String)> {
    // Short kernels let it through.
    let sharp = Wanted {
        kernel: Some((found.length.min(6e-3), found.settling)),
        ..Wanted::default()
    };
    let sharp = estimate_of(record, &sharp)?;
    let rows = sharp.rows.first()?.as_ref()?;
    let places: Vec<f64> = rows
        .centres
        .iter()
        .map(|centre| record.path[*centre])
        .collect();
    let (wave, share) = strongest_wave(&places, &sharp.fit.residual)?;
    if share < SHARE {
        return None;
    }
    let better = with_wave(record, wave)?;
    let period = TAU / wave;
    let turns = if names.length == "rad" {
        format!("{} a turn", digits(wave, 4))
    } else {
        format!("a period of {} m", digits(period, 4))
    };
    let word = format!(
        "the effort has a ripple over the position: {turns}, {} {}, {:.0} % of what the equation leaves; it is in the fit",
        digits(amplitude(&better, wave), 3),
        names.unit,
        100.0 * share
    );
    Some((better, wave, word))
}

/// Wave number of the strongest line of a residual over the position, and its share of the variance.
pub fn strongest_wave(places: &[f64], residual: &[f64]) -> Option<(f64, f64)> {
    let (low, high) = range(places);
    let stroke = high - low;
    let bins = BINS.min(places.len() / 4);
    if bins < 64 || !(stroke > 0.0) {
        return None;
    }
    let mean = residual.iter().sum::<f64>() / residual.len().max(1) as f64;
    let mut sums = vec![(0.0, 0.0_f64); bins];
    for (place, rest) in places.iter().zip(residual) {
        let bin = (((place - low) / stroke * bins as f64) as usize).min(bins - 1);
        sums[bin].0 += rest - mean;
        sums[bin].1 += 1.0;
    }
    let mut line: Vec<Complex<f64>> = sums
        .iter()
        .map(|(sum, count)| Complex::new(sum / count.max(1.0), 0.0))
        .collect();
    line.resize(2 * bins, Complex::new(0.0, 0.0));
    FftPlanner::new()
        .plan_fft_forward(2 * bins)
        .process(&mut line);
    let powers: Vec<f64> = line[..bins].iter().map(Complex::norm_sqr).collect();
    let first = (2.0 * PERIODS).ceil() as usize;
    let top = (first..bins).max_by(|one, other| powers[*one].total_cmp(&powers[*other]))?;
    if powers[top] < HEIGHT * median(powers[first..].to_vec()) {
        return None;
    }
    let total: f64 = residual.iter().map(|rest| (rest - mean).powi(2)).sum();
    let near = (-10..=10).map(|part| (top as f64 + 0.1 * f64::from(part)) * PI / stroke);
    near.map(|wave| (wave, explained(places, residual, mean, wave) / total))
        .max_by(|one, other| one.1.total_cmp(&other.1))
}

/// Squares that a sine and a cosine of the position take from a residual.
fn explained(places: &[f64], residual: &[f64], mean: f64, wave: f64) -> f64 {
    let [mut ss, mut sc, mut cc, mut sr, mut cr] = [0.0; 5];
    for (place, rest) in places.iter().zip(residual) {
        let (sine, cosine) = (wave * place).sin_cos();
        let rest = rest - mean;
        ss += sine * sine;
        sc += sine * cosine;
        cc += cosine * cosine;
        sr += sine * rest;
        cr += cosine * rest;
    }
    let determinant = ss * cc - sc * sc;
    if determinant <= 0.0 {
        return 0.0;
    }
    (cc * sr * sr - 2.0 * sc * sr * cr + ss * cr * cr) / determinant
}

/// Longest shift of a channel that is sought, s; from so many ticks and this much less left with it, a trace is refused, but not where effort and
/// motion alone are apart by less than this time, which is in the fit.
const LATEST: f64 = 0.1;
const LATE: (isize, f64) = (3, 1.3);
const IN_THE_FIT: f64 = 0.02;

/// One channel that comes later or earlier than all others: the effort, or the load.
fn apart(record: &Record, found: &Estimate, names: &Names<'_>) -> Option<String> {
    let rows = found.rows.first()?.as_ref()?;
    let block = Block::of(record, rows, &found.terms);
    let own = record.load.as_deref().filter(|_| record.load_is_effort);
    let load = own.map_or_else(|| vec![0.0; rows.len()], |load| rows.sums(0, load));
    let effort = rows.sums(0, &record.effort);
    let of_effort = shift(rows, &block.columns, (&record.effort, 1.0), &load);
    let of_load = own.and_then(|own| shift(rows, &block.columns, (own, -1.0), &effort));
    let told = [(of_effort, names.effort, 1.0), (of_load, names.load, -1.0)];
    let told = told.into_iter().filter_map(|(found, name, sign)| {
        let (by, left) = found?;
        Some((by, left, name, sign))
    });
    let (by, _, name, _) = told.min_by(|one, other| one.1.total_cmp(&other.1))?;
    let time = record.tick * by as f64;
    let in_the_fit = own.is_none() && time.abs() < IN_THE_FIT;
    (!in_the_fit).then(|| {
        format!(
            "{name} comes {:.0} ms {} than the other channels, which it fits best there: shift the channels to one clock",
            1e3 * time.abs(),
            if by > 0 { "later" } else { "earlier" }
        )
    })
}

/// By how many samples a channel, times its sign, less `rest` comes later than what the columns explain, where that leaves far less; and what it leaves.
fn shift(
    rows: &Rows,
    columns: &[Vec<f64>],
    (channel, sign): (&[f64], f64),
    rest: &[f64],
) -> Option<(isize, f64)> {
    let solver = solver(columns)?;
    let left = |by: isize| -> f64 {
        let mut target = rows.later(by, channel);
        for (target, rest) in target.iter_mut().zip(rest) {
            *target = sign * (*target - rest);
        }
        for (column, value) in columns.iter().zip(&solver(&target)) {
            for (target, entry) in target.iter_mut().zip(column) {
                *target -= value * entry;
            }
        }
        dot(&target, &target).sqrt()
    };
    let least = |shifts: &mut dyn Iterator<Item = isize>| {
        let tried = shifts.map(|by| (by, left(by)));
        tried.min_by(|one, other| one.1.total_cmp(&other.1))
    };
    // Behind the kernel a channel changes little within half of it.
    let step = (rows.kernel.half() / 2).max(1) as isize;
    let most = (LATEST / rows.kernel.tick()).ceil() as isize / step;
    let (near, _) = least(&mut (-most..=most).map(|k| k * step))?;
    let (by, less) = least(&mut (near - step..=near + step))?;
    (by.abs() >= LATE.0 && LATE.1 * less < left(0)).then_some((by, less))
}

/// The lag of a measured speed, or of effort and position against each other.
fn late(record: &Record, found: &Estimate, more: &[Term]) -> Option<(Estimate, String)> {
    let milliseconds =
        |(lag, half): (f64, f64)| format!("{:.2} +- {:.2} ms", 1e3 * lag, 1e3 * half);
    if record.speed_alone {
        let (lag, half) = found.of(Term::Lag)?;
        let word = if lag > half {
            format!(
                "the measured speed is {} late: it is in the fit",
                milliseconds((lag, half))
            )
        } else {
            return None;
        };
        return Some((found.clone(), word));
    }
    let sure = |estimate: &Estimate| {
        let told = estimate.of(Term::Lag);
        told.filter(|(lag, half)| lag.abs() > 1.5 * half && lag.abs() > record.tick)
    };
    let mut wanted = Wanted {
        more: more.to_vec(),
        lag: true,
        kernel: Some((found.length, found.settling)),
    };
    sure(&estimate_of(record, &wanted)?)?;
    wanted.kernel = None;
    let better = estimate_of(record, &wanted)?;
    let (lag, half) = sure(&better)?;
    let side = if lag < 0.0 { "later" } else { "earlier" };
    let word = format!(
        "the effort comes {} {side} than the motion: it is in the fit; put both on one clock",
        milliseconds((lag.abs(), half))
    );
    Some((better, word))
}

/// Zero error of a load's channel: it moves the sign of the load's power, so that losses step by `-c (driving_loss + back_driving_loss)/2` where the measured
/// load changes from assisting to opposing. As an effort that is always there it is one with the offset.
fn zero(record: &Record, found: &Estimate, more: &[Term], names: &Names<'_>) -> Option<String> {
    found.of(Term::Driving).and(found.of(Term::BackDriving))?;
    let other = surely(record, found, more, (Term::LoadZero, found.settling))?;
    let (step, half) = other.of(Term::LoadZero)?;
    let ((driving, _), (back, _)) = (other.of(Term::Driving)?, other.of(Term::BackDriving)?);
    let [zero, half] = [step, half].map(|of| -2.0 * of / (driving + back));
    Some(format!(
        "{} reads {} +- {} {} without a load: set its zero; the offset holds it",
        names.load,
        digits(zero, 2),
        digits(half.abs(), 2),
        names.unit
    ))
}

/// Residual with a viscous friction that differs by direction over that without, below which it is named.
const TAKES: f64 = 0.97;

/// A term more that is twice its interval from zero, with the kernel that was chosen.
fn surely(
    record: &Record,
    found: &Estimate,
    more: &[Term],
    (term, settling): (Term, f64),
) -> Option<Estimate> {
    let wanted = Wanted {
        more: [more, &[term]].concat(),
        lag: !record.speed_alone && found.of(Term::Lag).is_some(),
        kernel: Some((found.length, settling)),
    };
    let other = estimate_of(record, &wanted)?;
    let (value, half) = other.of(term)?;
    (value.abs() > 2.0 * half).then_some(other)
}

/// Viscous friction that differs by direction.
fn asymmetry(
    record: &Record,
    found: &Estimate,
    more: &[Term],
    names: &Names<'_>,
) -> Option<String> {
    found.of(Term::Offset)?;
    let other = surely(record, found, more, (Term::Asymmetry, found.settling))?;
    if other.fit.residual_rms > TAKES * found.fit.residual_rms {
        return None;
    }
    let ((drag, _), (differs, half)) = (other.of(Term::Viscous)?, other.of(Term::Asymmetry)?);
    let (offset, offset_half) = other.of(Term::Offset)?;
    Some(format!(
        "viscous friction differs by direction: {} forward, {} backward, each +- {}; the offset is {} +- {} {} then",
        digits(drag + differs, 3),
        digits(drag - differs, 3),
        digits(half, 2),
        digits(offset, 3),
        digits(offset_half, 2),
        names.unit
    ))
}

/// Speeds over which friction changes towards rest, over one that a tenth of the rows exceed. A faster one is a drag that is not linear.
const STRIBECK: [f64; 3] = [0.02, 0.05, 0.12];

/// Friction that is larger, or smaller, near rest: `s T_S exp(-|w|/w_s)`, the speed one of three, well below those of the motion.
fn stribeck(
    record: &Record,
    found: &Estimate,
    more: &[Term],
    names: &Names<'_>,
) -> Option<(Estimate, String)> {
    found.of(Term::Coulomb)?;
    let rows = found.rows.first()?.as_ref()?;
    let speeds = rows.sums(record.order(1), &record.motion).into_iter();
    let mut speeds: Vec<f64> = speeds.map(f64::abs).collect();
    speeds.sort_by(f64::total_cmp);
    let fast = speeds[speeds.len() * 9 / 10];
    let tried = STRIBECK.map(|share| Term::Stribeck(share * fast));
    let best = tried
        .into_iter()
        // Slow rows are those near the turns.
        .filter_map(|term| Some((term, surely(record, found, more, (term, 0.0))?)))
        .min_by(|one, other| one.1.fit.residual_rms.total_cmp(&other.1.fit.residual_rms))?;
    let term = best.0;
    let Term::Stribeck(speed) = term else {
        return None;
    };
    let wanted = Wanted {
        more: [more, &[term]].concat(),
        lag: !record.speed_alone && found.of(Term::Lag).is_some(),
        kernel: None,
    };
    let better = estimate_of(record, &wanted)?;
    let (rise, half) = better.of(term)?;
    let (coulomb, _) = better.of(Term::Coulomb)?;
    if rise.abs() < 2.0 * half || coulomb <= 0.0 {
        return None;
    }
    let word = format!(
        "friction {} towards rest by {} +- {} {} over {} {}/s: it is in the fit",
        if rise > 0.0 { "rises" } else { "falls" },
        digits(rise.abs(), 3),
        digits(half, 2),
        names.unit,
        digits(speed, 2),
        names.length
    );
    Some((better, word))
}
