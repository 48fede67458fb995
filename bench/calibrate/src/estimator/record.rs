//! A trace as the estimator takes it: motion, its sensor's step and noise, what is left out.

use std::ops::Range;

use super::kernel::Kernel;
use super::stretches::{Stretch, of_position, of_speed};
use crate::trace::Trace;
use crate::trace::channels::{median, moments, resolution};

/// Shares of a kernel's half-width: within which a step of the sensor must come, and over which the sign of a load is told.
pub const QUARTER: usize = 4;

/// Steps of a position's sensor, or deviations of its noise, within which the direction is not told.
const STEPS: f64 = 2.0;
const DEVIATIONS: f64 = 8.0;

/// The same of a speed, and the share of its largest size below which it has no direction.
const DEVIATIONS_OF_SPEED: f64 = 4.0;
const STANDS: f64 = 0.01;

/// Least length of a rest, s.
const RESTS: f64 = 0.3;

/// Deviation over mean of a speed that counts as one.
const ONE_SPEED: f64 = 0.05;

#[derive(Clone, Debug)]
pub struct Record {
    pub name: String,
    pub tick: f64,
    pub speed_alone: bool,
    /// What was measured of the motion, rad or rad/s (m, m/s): a position, between the instants at which its count changes on a straight
    /// line, or a speed.
    pub motion: Vec<f64>,
    /// Position, or the integral of the speed, rad or m.
    pub path: Vec<f64>,
    /// Effort that acts on the mechanism, N m or N.
    pub effort: Vec<f64>,
    /// Load, N, or its effort.
    pub load: Option<Vec<f64>>,
    pub load_is_effort: bool,
    /// Standard deviation of the motion's sensor, rad or rad/s (m, m/s).
    pub noise: f64,
    /// Distance that tells a direction, rad or rad/s (m, m/s).
    least: f64,
    /// Position as it was counted; the smoothed speed where that alone was measured.
    counted: Vec<f64>,
    /// Samples left out before each sample, and in all.
    left_out: Vec<u32>,
}

impl Record {
    pub fn of(trace: &Trace, more: &[Range<usize>]) -> Self {
        let mut bad = vec![0; trace.len() + 1];
        for range in trace.left_out.iter().chain(more) {
            bad[range.start.min(trace.len())..range.end.min(trace.len())].fill(1);
        }
        let mut before = 0;
        for bad in &mut bad {
            before += std::mem::replace(bad, before);
        }
        let record = Self {
            name: trace.name.clone(),
            tick: trace.step,
            speed_alone: false,
            motion: Vec::new(),
            path: trace.position.clone(),
            effort: trace.acting().into_owned(),
            load: trace.load.clone(),
            load_is_effort: trace.load_is_effort,
            noise: 0.0,
            least: 0.0,
            counted: Vec::new(),
            left_out: bad,
        };
        match trace.speed.as_ref().filter(|_| trace.position_summed) {
            Some(speed) => record.with_speed(speed),
            None => record.with_position(&trace.position, trace.resolution),
        }
    }

    fn with_position(self, position: &[f64], step: f64) -> Self {
        let (motion, noise, least) = if step > 0.0 {
            (between_counts(position), step / 12_f64.sqrt(), STEPS * step)
        } else {
            let noise = white_noise(position);
            (position.to_vec(), noise, DEVIATIONS * noise)
        };
        Self {
            motion,
            path: position.to_vec(),
            counted: position.to_vec(),
            noise,
            least,
            ..self
        }
    }

    fn with_speed(self, speed: &[f64]) -> Self {
        let step = resolution(speed);
        let largest = speed.iter().fold(0.0_f64, |most, w| most.max(w.abs()));
        let least = (STEPS * step).max(STANDS * largest);
        let (noise, least) = if step > 0.0 {
            (step / 12_f64.sqrt(), least)
        } else {
            let noise = white_noise(speed);
            (noise, least.max(DEVIATIONS_OF_SPEED * noise))
        };
        Self {
            speed_alone: true,
            motion: speed.to_vec(),
            counted: Kernel::new(3, self.tick).along(0, speed),
            noise,
            least,
            ..self
        }
    }

    #[must_use]
    pub fn exchanged(&self) -> Self {
        let other = Self {
            speed_alone: false,
            effort: self.path.clone(),
            load: None,
            ..self.clone()
        };
        other.with_position(&self.effort, resolution(&self.effort))
    }

    /// Position as the kernels smooth it, rad or m.
    pub fn places(&self) -> &[f64] {
        if self.speed_alone {
            &self.path
        } else {
            &self.motion
        }
    }

    pub fn len(&self) -> usize {
        self.effort.len()
    }

    /// Whether nothing of some samples, given by the first and the last, is left out.
    pub fn sound(&self, first: usize, last: usize) -> bool {
        let of = |sample: usize| self.left_out.get(sample).copied();
        of(first) == of(last + 1) && of(first).is_some()
    }

    /// Standard deviation of the sensor's noise in a derivative behind a kernel.
    pub fn noise_in(&self, kernel: &Kernel, derivative: usize) -> f64 {
        let weights = kernel.weights(self.order(derivative)).iter();
        self.noise * weights.map(|w| w * w).sum::<f64>().sqrt()
    }

    /// Where it rests: no progress that its sensor tells for 0.3 s or longer.
    pub fn rests(&self) -> Vec<Range<usize>> {
        let mut rests = Vec::new();
        let mut from = 0;
        for sample in 1..=self.len() {
            let moved = self.counted.get(sample).is_none_or(|now| {
                if self.speed_alone {
                    now.abs() > self.least
                } else {
                    (now - self.counted[from]).abs() >= self.least && *now != self.counted[from]
                }
            });
            if moved {
                if (sample - from) as f64 * self.tick >= RESTS {
                    rests.push(from..sample);
                }
                from = sample;
            }
        }
        rests
    }

    /// Stretches of one direction for a kernel of a half-width, samples.
    pub fn stretches(&self, half: usize) -> Vec<Stretch> {
        if self.speed_alone {
            of_speed(&self.motion, &self.counted, &self.path, self.least)
        } else {
            of_position(&self.counted, self.least, (half / QUARTER).max(3))
        }
    }

    /// A derivative of the motion: 0 the position or nothing, 1 the speed, 2 the acceleration, 3 its rate; as the kernel's own order.
    pub const fn order(&self, derivative: usize) -> usize {
        if self.speed_alone {
            derivative.saturating_sub(1)
        } else {
            derivative
        }
    }

    /// Median size of the speed where it moves, rad/s or m/s.
    pub fn speed_of_motion(&self) -> f64 {
        let kernel = Kernel::new(3, self.tick);
        let stretches = self.stretches(12);
        let samples = stretches.iter().flat_map(|of| of.first..=of.last);
        let size = |sample| kernel.at(self.order(1), &self.motion, sample).abs();
        median(samples.map(size).collect())
    }

    /// The one speed, rad/s or m/s, at which it moves, and the samples in which it does: the middle four fifths, where a start and a stop
    /// may stand at the ends.
    pub fn one_speed(&self) -> Option<(f64, Range<usize>)> {
        let count = self.len();
        let half = (count / 40).max(1);
        let speed = Kernel::new(half, self.tick).along(self.order(1), &self.motion);
        let tenth = count / 10;
        let of = |range: Range<usize>| -> Option<(f64, Range<usize>)> {
            let part = speed.get(range.clone())?;
            let (mean, deviation) = moments(part.iter().copied());
            (part.len() > 2 && deviation < ONE_SPEED * mean.abs()).then_some((mean, range))
        };
        let middle = of(tenth..count - tenth)?;
        Some(of(0..count).unwrap_or(middle))
    }
}

/// A motion as a kernel smooths it, at every sample.
#[derive(Clone, Debug)]
pub struct Smoothed {
    /// rad or m.
    pub position: Vec<f64>,
    /// rad/s or m/s.
    pub speed: Vec<f64>,
    /// rad/s^2 or m/s^2.
    pub acceleration: Vec<f64>,
    /// Standard deviations of the sensor's noise in speed and acceleration.
    pub noise: [f64; 2],
}

/// Half-width of the kernel of a smoothed motion, s.
const SMOOTHED: f64 = 12e-3;

impl Smoothed {
    /// That of a trace, behind a kernel of 12 ms to each side, four samples at least.
    pub fn of(trace: &Trace) -> Self {
        let half = ((SMOOTHED / trace.step).round() as usize).max(4);
        let kernel = Kernel::new(half, trace.step);
        Self::by(&Record::of(trace, &[]), &kernel, 1)
    }

    /// That of a record behind a kernel, at every so many of its samples.
    pub fn by(record: &Record, kernel: &Kernel, stride: usize) -> Self {
        let along = |order: usize, signal: &[f64]| {
            let samples = (0..record.len()).step_by(stride);
            samples.map(|k| kernel.at(order, signal, k)).collect()
        };
        Self {
            position: along(0, record.places()),
            speed: along(record.order(1), &record.motion),
            acceleration: along(record.order(2), &record.motion),
            noise: [1, 2].map(|k| record.noise_in(kernel, k)),
        }
    }
}

/// Standard deviation of white noise, by the median of its fourth differences, whose variance is 70 times its own.
pub fn white_noise(signal: &[f64]) -> f64 {
    let sizes = signal
        .windows(5)
        .filter_map(|window| match window {
            [a, b, c, d, e] => Some((a - 4.0 * b + 6.0 * c - 4.0 * d + e).abs()),
            _ => None,
        })
        .collect();
    median(sizes) / (0.6745 * 70_f64.sqrt())
}

/// A counted position on straight lines between the instants at which its count changes, each half way between both counts.
fn between_counts(position: &[f64]) -> Vec<f64> {
    let mut changes = position
        .windows(2)
        .enumerate()
        .filter(|(_, pair)| pair[0] != pair[1])
        .map(|(sample, pair)| (sample as f64 + 0.5, 0.5 * (pair[0] + pair[1])));
    let (Some(mut before), Some(mut after)) = (changes.next(), changes.next()) else {
        return position.to_vec();
    };
    (0..position.len())
        .map(|sample| {
            let time = sample as f64;
            while time > after.0
                && let Some(next) = changes.next()
            {
                (before, after) = (after, next);
            }
            let share = ((time - before.0) / (after.0 - before.0)).clamp(0.0, 1.0);
            before.1 + share * (after.1 - before.1)
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_count_is_half_way_where_it_changes() {
        let counted = [0.0, 0.0, 1.0, 1.0, 1.0, 2.0, 2.0];
        let found = between_counts(&counted);
        // Half way at 1.5 and 4.5: a third of a count a sample between them.
        let wanted = [0.5, 0.5, 2.0 / 3.0, 1.0, 4.0 / 3.0, 1.5, 1.5];
        for (found, wanted) in found.iter().zip(wanted) {
            assert!((found - wanted).abs() < 1e-12, "{found:?}");
        }
        assert_eq!(between_counts(&[1.0, 1.0]), [1.0, 1.0]);
    }

    #[test]
    fn white_noise_is_told_beside_a_motion() {
        let noise = crate::fit::toys::noise(3, 5000, 0.0);
        let signal: Vec<f64> = noise
            .iter()
            .enumerate()
            .map(|(k, noise)| 30.0 * (0.01 * k as f64).sin() + 0.02 * noise)
            .collect();
        assert!((white_noise(&signal) / 0.02 - 1.0).abs() < 0.06);
        assert_eq!(white_noise(&[1.0]), 0.0);
    }
}
