//! One sample clock for a trace: its tick, gaps, jitter.

use std::ops::Range;

use crate::trace::Repairs;

/// Distance from the tick, in ticks, within which a sample counts as on it.
const ON_TICK: f64 = 0.1;
/// Distance, in ticks, below which nothing is interpolated.
const EXACT: f64 = 1e-3;
/// Samples of a stretch whose mean tick is taken.
const STRETCH: usize = 16;
/// Longest gap that is filled, in ticks.
pub const LONGEST_GAP: f64 = 10.0;
/// Largest share of samples that may be missing, and of samples that may stand twice.
pub const MOST_MISSING: f64 = 0.02;
/// Largest root mean square of the distance from the tick, in ticks.
const MOST_JITTER: f64 = 0.3;
/// Distance of samples, in ticks, below which no cubic is laid through them.
const SQUEEZED: f64 = 0.2;
/// Largest share of samples that may have the tick of the one before.
const MOST_SHARED: f64 = 0.1;
/// Slowest tick, s: friction's transitions are over within less.
const SLOWEST: f64 = 0.05;
/// Shortest tick, s.
const FASTEST: f64 = 1e-7;
/// Fewest samples.
const FEWEST: usize = 100;

/// A clock that ticks evenly, and where its ticks lie among the samples.
#[derive(Clone, Debug, PartialEq)]
pub struct Clock {
    /// Time of the first tick, s.
    pub start: f64,
    /// Tick, s.
    pub step: f64,
    /// What has to be repaired.
    pub repairs: Repairs,
    /// Times of the samples, and how each tick comes from them; none where every sample is on its tick.
    times: Vec<f64>,
    places: Vec<Place>,
}

/// Where a tick lies among the samples.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Place {
    /// The sample on the tick, or the one before.
    sample: u32,
    /// Whether the tick lies between it and the next.
    between: bool,
}

impl Clock {
    /// The clock of samples at these times, which rise, of which so many stood twice and were dropped.
    ///
    /// # Errors
    /// Too few samples, no even tick, gaps that are too long or too many.
    pub fn of(times: Vec<f64>, repeated: usize) -> Result<Self, String> {
        let samples = times.len();
        if samples < FEWEST {
            return Err(format!("{samples} samples are too few: at least {FEWEST}"));
        }
        let all = samples + repeated;
        if repeated as f64 > MOST_MISSING * all as f64 {
            return Err(format!(
                "{repeated} of {all} samples have the time of the one before: the time has too few digits, or samples stand twice"
            ));
        }
        let median = median_tick(&times, STRETCH / 2);
        check_tick(median)?;
        check_gaps(&times, median)?;
        match Self::even(&times, repeated) {
            Ok(clock) => Ok(clock),
            Err(why) => match free_tick(&times) {
                Some(step) => Self::free(times, step, repeated),
                None => Err(why),
            },
        }
    }

    /// The clock of a tick that is even.
    fn even(times: &[f64], repeated: usize) -> Result<Self, String> {
        let samples = times.len();
        let (start, step, rough) = grid(times)?;
        if rough > MOST_JITTER {
            return Err(format!(
                "the samples have no even tick: they stand {rough:.2} ticks of {step:.6} s off it (root mean square, at most {MOST_JITTER}); where their times are exact, resample them to even ticks"
            ));
        }
        let last = times.last().copied().unwrap_or_default();
        let ticks = ((last - start) / step + ON_TICK) as usize + 1;
        // The count proper comes with the places; no list is made for what cannot be right.
        if ticks as f64 > (1.0 + 2.0 * MOST_MISSING) * samples as f64 {
            return Err(missing(ticks - samples, ticks));
        }
        let mut clock = Self::ticking(start, step, repeated);
        clock.place(times.to_vec(), ticks);
        let found = clock.repairs.missing;
        if found as f64 > MOST_MISSING * ticks as f64 {
            return Err(missing(found, ticks));
        }
        Ok(clock)
    }

    /// A clock of even ticks for samples without: every tick is interpolated.
    fn free(times: Vec<f64>, step: f64, repeated: usize) -> Result<Self, String> {
        let first = times.first().copied().unwrap_or_default();
        let last = times.last().copied().unwrap_or_default();
        let ticks = ((last - first) / step) as usize + 1;
        let left_out = times
            .windows(2)
            .map(|pair| ((pair[1] - pair[0]) / step).round().max(1.0) as usize - 1)
            .sum();
        if left_out as f64 > MOST_MISSING * ticks as f64 {
            return Err(missing(left_out, ticks));
        }
        let mut clock = Self::ticking(first, step, repeated);
        clock.place(times, ticks);
        clock.repairs.missing = left_out;
        clock.repairs.jittered = 0;
        clock.repairs.free_running = ticks;
        Ok(clock)
    }

    fn ticking(start: f64, step: f64, repeated: usize) -> Self {
        Self {
            start,
            step,
            repairs: Repairs {
                repeated,
                ..Repairs::default()
            },
            times: Vec::new(),
            places: Vec::new(),
        }
    }

    /// Finds every tick among the samples, and counts what has to be repaired.
    fn place(&mut self, times: Vec<f64>, ticks: usize) {
        let mut sample = 0;
        let mut places = Vec::with_capacity(ticks);
        let mut even = ticks == times.len();
        let mut interpolated = 0usize;
        for tick in 0..ticks {
            let time = self.start + self.step * tick as f64;
            while times.get(sample + 1).is_some_and(|next| *next <= time) {
                sample += 1;
            }
            let before = times.get(sample).copied().unwrap_or(time);
            let after = times.get(sample + 1).copied().unwrap_or(before);
            let near = ON_TICK * self.step;
            let on_tick = if (time - before).abs() <= near || after <= before {
                Some(sample)
            } else {
                (after - time <= near).then_some(sample + 1)
            };
            if on_tick.is_none() {
                interpolated += 1;
            }
            even &= on_tick == Some(tick);
            // On an uneven clock a small distance counts as well.
            let exact = on_tick.filter(|on| {
                let own = times.get(*on).copied().unwrap_or(time);
                (time - own).abs() <= EXACT * self.step || time < before || after <= before
            });
            places.push(Place {
                sample: exact.unwrap_or(sample) as u32,
                between: exact.is_none(),
            });
        }
        // What there are fewer samples than ticks was never there; the others are beside their tick.
        self.repairs.missing = ticks.saturating_sub(times.len());
        self.repairs.jittered = interpolated.saturating_sub(self.repairs.missing);
        if !even {
            self.places = places;
            self.times = times;
        }
    }

    /// The ticks about some times.
    pub fn ticks(&self, times: &Range<f64>) -> Range<usize> {
        let at = |time: f64| (time - self.start) / self.step;
        // Times have roundings; a tick more on either side does no harm.
        (at(times.start).floor().max(0.0) as usize)..(at(times.end).ceil().max(0.0) as usize + 1)
    }

    /// The channel at every tick: a sample where one is on it, else on the cubic through the four about it.
    pub fn resample(&self, channel: Vec<f64>) -> Vec<f64> {
        if self.places.is_empty() {
            return channel;
        }
        let at = |index: usize| channel.get(index).copied().unwrap_or_default();
        self.places
            .iter()
            .enumerate()
            .map(|(tick, place)| {
                let sample = place.sample as usize;
                if !place.between {
                    return at(sample);
                }
                let near = neighbours(sample, channel.len());
                let times = near.map(|index| self.times.get(index).copied().unwrap_or_default());
                let time = self.start + self.step * tick as f64;
                if let Some(cubic) = cubic(times, near.map(at), time, SQUEEZED * self.step) {
                    return cubic;
                }
                let [before, after] = [sample, sample + 1].map(|index| {
                    let time = self.times.get(index).copied().unwrap_or_default();
                    (time, at(index))
                });
                before.1 + (after.1 - before.1) * (time - before.0) / (after.0 - before.0)
            })
            .collect()
    }
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
    let mut ticks: Vec<f64> = times
        .iter()
        .zip(times.iter().skip(samples))
        .map(|(a, b)| (b - a) / samples as f64)
        .collect();
    let middle = ticks.len() / 2;
    if middle >= ticks.len() {
        return 0.0;
    }
    *ticks.select_nth_unstable_by(middle, f64::total_cmp).1
}

fn check_tick(tick: f64) -> Result<(), String> {
    if tick > SLOWEST {
        return Err(format!(
            "tick = {tick} s is too slow: at most {SLOWEST} s (a column in milliseconds is named time_ms)"
        ));
    }
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

fn missing(missing: usize, ticks: usize) -> String {
    format!(
        "{missing} of {ticks} samples are missing: at most {:.0} % are filled",
        100.0 * MOST_MISSING
    )
}

/// Mean tick of a clock that runs free: its distances vary, each by itself. Where samples come evenly and only their times
/// jitter, a distance that is too long is followed by one too short, and neighbours correlate by -0.5.
fn free_tick(times: &[f64]) -> Option<f64> {
    /// Half way between those two.
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

/// First tick, tick, and the root mean square of the samples' distance from their ticks, in ticks.
fn grid(times: &[f64]) -> Result<(f64, f64, f64), String> {
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
    let mut offsets: Vec<f64> = follow(times, step)
        .map(|(tick, time)| time - first - step * tick)
        .collect();
    // Most samples are on their tick, whatever the others do.
    let middle = offsets.len() / 2;
    let offset = *offsets.select_nth_unstable_by(middle, f64::total_cmp).1;
    let square: f64 = offsets.iter().map(|x| (x - offset) * (x - offset)).sum();
    let rough = (square / offsets.len() as f64).sqrt();
    Ok((first + offset, step, rough / step))
}
