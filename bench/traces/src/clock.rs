//! One sample clock for a trace: its tick, gaps, jitter.

use std::ops::Range;

use crate::channels::median;
use crate::table::Table;

/// Distance from the tick, in ticks, within which a sample counts as on it.
const ON_TICK: f64 = 0.1;
/// Distance, in ticks, below which nothing is interpolated.
const EXACT: f64 = 1e-3;
/// Samples of a stretch whose mean tick is taken.
const STRETCH: usize = 16;
/// Longest gap that is filled, in ticks.
pub const LONGEST_GAP: f64 = 10.0;
/// Distance of neighbours, in ticks, from which a sample between them is missing.
const GAP: f64 = 1.75;
/// Largest share of samples that may be missing, and of samples that may stand twice.
const MOST_MISSING: f64 = 0.02;
/// Largest root mean square of the distance from the tick, in ticks.
const MOST_JITTER: f64 = 0.3;
/// Distance of samples, in ticks, below which no cubic is laid through them.
const SQUEEZED: f64 = 0.2;
/// Largest share of samples that may have the tick of the one before.
const MOST_SHARED: f64 = 0.1;
/// Slowest tick, s: steady runs are recorded so.
const SLOWEST: f64 = 0.2;
/// Shortest tick, s.
const FASTEST: f64 = 1e-7;
const FEWEST: usize = 100;
/// Share of ticks near their median from which samples come from a raster.
const RASTER: f64 = 0.9;

/// A clock that ticks evenly, and where its ticks lie among the samples.
#[derive(Clone, Debug, PartialEq)]
pub struct Clock {
    /// Time of the first tick, s.
    pub start: f64,
    /// Tick, s.
    pub step: f64,
    /// Samples that are missing, in gaps that are filled.
    pub missing: usize,
    /// Samples whose time is off by more than a tenth of a tick, and are interpolated.
    pub jittered: usize,
    /// Samples of a clock that runs free, without an even tick: all of them are interpolated.
    pub free_running: usize,
    /// Ticks in gaps between samples.
    pub filled: Vec<Range<usize>>,
    times: Vec<f64>,
    /// The sample before each tick; none where every sample is on its tick.
    places: Vec<usize>,
}

impl Clock {
    /// The clock of samples at these times, which rise, of which so many stood twice and were dropped.
    pub fn of(times: Vec<f64>, repeated: usize) -> Result<Self, String> {
        let samples = times.len();
        if samples < FEWEST {
            return Err(format!("{samples} samples are too few: at least {FEWEST}"));
        }
        few_repeated(samples, repeated)?;
        let median = median_tick(&times, STRETCH / 2);
        check_tick(median)?;
        check_gaps(&times, median)?;
        let (start, step, free) = match (grid(&times), free_tick(&times)) {
            (Ok((start, step)), _) => (start, step, false),
            (Err(_), Some(step)) => (times[0], step, true),
            (Err(why), None) => return Err(why),
        };
        let ticks = ((times[samples - 1] - start) / step + ON_TICK) as usize + 1;
        let mut missing = ticks.saturating_sub(samples);
        if free {
            let gaps = times.windows(2).map(|pair| (pair[1] - pair[0]) / step);
            missing = gaps.map(|gap| gap.round().max(1.0) as usize - 1).sum();
        }
        // No list is made for what cannot be right.
        if missing as f64 > MOST_MISSING * ticks as f64 {
            return Err(format!(
                "{missing} of {ticks} samples are missing: at most {:.0} % are filled",
                100.0 * MOST_MISSING
            ));
        }
        let mut clock = Self {
            start,
            step,
            missing,
            jittered: 0,
            free_running: 0,
            filled: Vec::new(),
            times,
            places: Vec::with_capacity(ticks),
        };
        clock.place(ticks, free);
        Ok(clock)
    }

    /// Finds every tick among the samples, and counts what has to be repaired.
    fn place(&mut self, ticks: usize, free: bool) {
        let mut sample = 0;
        let mut even = ticks == self.times.len() && !free;
        let mut interpolated = 0usize;
        for tick in 0..ticks {
            let time = self.start + self.step * tick as f64;
            while self.times.get(sample + 1).is_some_and(|next| *next <= time) {
                sample += 1;
            }
            self.places.push(sample);
            let before = self.times[sample];
            let after = self.times.get(sample + 1).copied().unwrap_or(before);
            let near = ON_TICK * self.step;
            let last = after <= before;
            let on_tick = if (time - before).abs() <= near || last {
                Some(sample)
            } else {
                (after - time <= near).then_some(sample + 1)
            };
            even &= on_tick == Some(tick);
            if on_tick.is_some() {
                continue;
            }
            interpolated += 1;
            if after - before > GAP * self.step {
                match self.filled.last_mut().filter(|gap| gap.end == tick) {
                    Some(gap) => gap.end = tick + 1,
                    None => self.filled.push(tick..tick + 1),
                }
            }
        }
        if free {
            self.free_running = ticks;
        } else {
            // What there are fewer samples than ticks was never there; the others are beside their tick.
            self.jittered = interpolated.saturating_sub(self.missing);
        }
        if even {
            self.places.clear();
        }
    }

    /// The ticks about some times.
    pub fn ticks(&self, first: f64, last: f64) -> Range<usize> {
        let at = |time: f64| (time - self.start) / self.step;
        let start = (at(first) + ON_TICK).floor().max(0.0) as usize;
        start..((at(last) - ON_TICK).ceil().max(0.0) as usize + 1).max(start + 1)
    }

    /// The channel at every tick: a sample where one is on it, else on the cubic through the four about it.
    pub fn resample(&self, channel: Vec<f64>) -> Vec<f64> {
        if self.places.is_empty() {
            return channel;
        }
        let at = |index: usize| channel.get(index).copied().unwrap_or_default();
        let time_of = |index: usize| self.times.get(index).copied().unwrap_or_default();
        let ticks = self.places.iter().enumerate();
        ticks
            .map(|(tick, sample)| {
                let (sample, time) = (*sample, self.start + self.step * tick as f64);
                let (before, after) = (time_of(sample), time_of(sample + 1));
                if (time - before).abs() <= EXACT * self.step || time < before || after <= before {
                    return at(sample);
                }
                let near = neighbours(sample, channel.len());
                let cubic = cubic(near.map(time_of), near.map(at), time, SQUEEZED * self.step);
                let slope = (at(sample + 1) - at(sample)) / (after - before);
                cubic.unwrap_or(at(sample) + slope * (time - before))
            })
            .collect()
    }
}

/// Refuses samples that stand twice too often, and of samples that come from a raster a gap, and a slow tick of a time whose unit the file does
/// not name; those of a solver may stand anywhere.
pub fn check_raster(table: &Table) -> Result<(), String> {
    let times = &table.times[..];
    few_repeated(times.len(), table.repeated)?;
    let median = median_tick(times, STRETCH / 2);
    let near = |pair: &&[f64]| (0.5..1.5).contains(&((pair[1] - pair[0]) / median));
    let even = times.windows(2).filter(near).count();
    if times.len() < FEWEST || (even as f64) < RASTER * times.len() as f64 {
        return Ok(());
    }
    if !table.time_unit_said {
        check_slow(median)?;
    }
    check_gaps(times, median)
}

fn few_repeated(samples: usize, repeated: usize) -> Result<(), String> {
    let all = samples + repeated;
    if repeated as f64 <= MOST_MISSING * all as f64 || repeated == 1 {
        return Ok(());
    }
    Err(format!(
        "{repeated} of {all} samples have the time of the one before: the time has too few digits, or samples stand twice"
    ))
}

/// The four samples about the interval after this one; those at the ends for intervals there.
fn neighbours(sample: usize, samples: usize) -> [usize; 4] {
    let first = sample.saturating_sub(1).min(samples.saturating_sub(4));
    [0, 1, 2, 3].map(|next| first + next)
}

/// The cubic through four samples at a time (Lagrange); `None` where two of them stand closer than the noise of their values
/// allows.
pub fn cubic(times: [f64; 4], values: [f64; 4], time: f64, closest: f64) -> Option<f64> {
    let close = times
        .windows(2)
        .any(|pair| matches!(pair, [a, b] if !(b - a > closest)));
    let share = |own: f64| -> f64 {
        times
            .iter()
            .filter(|other| **other != own)
            .map(|other| (time - other) / (own - other))
            .product()
    };
    (!close).then(|| {
        times
            .into_iter()
            .zip(values)
            .map(|(own, value)| share(own) * value)
            .sum()
    })
}

/// Median of the mean ticks of so many samples.
pub fn median_tick(times: &[f64], samples: usize) -> f64 {
    let pairs = times.iter().zip(times.iter().skip(samples));
    median(pairs.map(|(a, b)| (b - a) / samples as f64).collect())
}

fn check_slow(tick: f64) -> Result<(), String> {
    if tick <= SLOWEST {
        return Ok(());
    }
    Err(format!(
        "tick = {tick} s is too slow: at most {SLOWEST} s (a column in milliseconds is named time_ms; time_s says that it is in seconds, for simulate)"
    ))
}

fn check_tick(tick: f64) -> Result<(), String> {
    check_slow(tick)?;
    if !(tick >= FASTEST) {
        return Err(format!(
            "tick = {tick} s is too short: at least {FASTEST} s"
        ));
    }
    Ok(())
}

/// Mean tick over stretches of sixteen samples, in which a jitter counts less and a gap is a whole number of ticks.
fn mean_tick(times: &[f64]) -> f64 {
    let rough = median_tick(times, STRETCH / 2);
    let (sum, ticks) = times
        .iter()
        .zip(times.iter().skip(STRETCH))
        .map(|(a, b)| (b - a, ((b - a) / rough).round()))
        .fold((0.0, 0.0), |(sum, ticks), (time, more)| {
            (sum + time, ticks + more)
        });
    sum / ticks
}

/// The tick nearest to each time, and the time. The ticks follow a clock that drifts, by a tenth of each distance.
fn follow(times: &[f64], step: f64) -> impl Iterator<Item = (f64, f64)> {
    const FOLLOWS: f64 = 0.1;
    let mut start = times.first().copied().unwrap_or_default();
    times.iter().map(move |time| {
        let tick = ((time - start) / step).round();
        start += FOLLOWS * (time - start - step * tick);
        (tick, *time)
    })
}

/// Refuses a gap that is too long to be filled.
fn check_gaps(times: &[f64], median: f64) -> Result<(), String> {
    for (sample, pair) in times.windows(2).enumerate() {
        if let [before, after] = pair
            && after - before > (LONGEST_GAP + 1.0) * median
        {
            return Err(format!(
                "a gap of {:.4} s after {before} s (sample {sample}): at most {LONGEST_GAP} ticks of {median:.6} s are filled; cut the trace there",
                after - before
            ));
        }
    }
    Ok(())
}

/// Mean tick of a clock that runs free: its distances vary, each by itself. Where samples come evenly and only their times
/// jitter, a distance that is too long is followed by one too short, and neighbours correlate by -0.5.
fn free_tick(times: &[f64]) -> Option<f64> {
    const FREE: f64 = -0.25;
    /// Largest deviation of the distances, over their mean, whose gaps a cubic bridges.
    const MOST_SPREAD: f64 = 0.5;
    let median = median_tick(times, 1);
    let ordinary: Vec<f64> = times
        .windows(2)
        .map(|pair| pair[1] - pair[0])
        .filter(|tick| *tick < 1.5 * median)
        .collect();
    let count = ordinary.len() as f64;
    let mean = ordinary.iter().sum::<f64>() / count;
    let square: f64 = ordinary.iter().map(|tick| (tick - mean).powi(2)).sum();
    let both: f64 = ordinary
        .windows(2)
        .map(|pair| (pair[0] - mean) * (pair[1] - mean))
        .sum();
    let free = both > FREE * square && square <= count * (MOST_SPREAD * mean).powi(2);
    (free && 2.0 * count > times.len() as f64).then_some(mean)
}

/// First tick and tick of samples that come evenly.
fn grid(times: &[f64]) -> Result<(f64, f64), String> {
    let first = times.first().copied().unwrap_or_default();
    let last = times.last().copied().unwrap_or_default();
    // A time printed with few digits, or one that jitters, has a median that is off; the mean of longer stretches is not.
    let ticks = follow(times, mean_tick(times)).map(|(tick, _)| tick);
    let ticks = ticks.last().unwrap_or_default();
    if !(ticks >= 1.0) {
        return Err("the samples have no even tick".into());
    }
    let step = (last - first) / ticks;
    let mut last_tick = -1.0;
    let mut shared = 0usize;
    for (tick, _) in follow(times, step) {
        shared += usize::from(tick <= last_tick);
        last_tick = tick;
    }
    if shared as f64 > MOST_SHARED * times.len() as f64 {
        return Err(format!(
            "the samples have no even tick: {shared} of {} share theirs of {step:.6} s with the one before",
            times.len()
        ));
    }
    let offsets: Vec<f64> = follow(times, step)
        .map(|(tick, time)| time - first - step * tick)
        .collect();
    // Most samples are on their tick, whatever the others do.
    let offset = median(offsets.clone());
    let square: f64 = offsets.iter().map(|x| (x - offset) * (x - offset)).sum();
    let rough = (square / offsets.len() as f64).sqrt() / step;
    if !(rough <= MOST_JITTER) {
        return Err(format!(
            "the samples have no even tick: they stand {rough:.2} ticks of {step:.6} s off it (root mean square, at most {MOST_JITTER}); where their times are exact, resample them to even ticks"
        ));
    }
    Ok((first + offset, step))
}
