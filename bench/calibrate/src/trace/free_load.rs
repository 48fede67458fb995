//! A load that never leaves its own noise: a sensor without a load, or under one that stays.
//!
//! Noise has no memory for long: the means of blocks of it vary by far less than its samples. A load that the screw
//! carries varies with the manoeuvre, or where it alternates fast, the effort follows it.

/// Length of a block, s, and fewest samples of one.
const BLOCK: (f64, usize) = (0.5, 64);
/// Fewest blocks.
const FEWEST: usize = 8;
/// Deviation of the blocks' means over that of the samples, of what is noise: noise of one independent sample in a
/// sixteenth of a block has this.
const MEANS: f64 = 0.25;
/// Largest distance from the mean, in deviations: a minute of normal noise at 1 kHz reaches 4.5.
const EXCURSION: f64 = 6.0;
/// A mean of so many deviations is a load that stays.
const STAYS: f64 = 2.0;

/// What a load's channel holds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LoadKind {
    /// A load that changes, or a channel too short to tell.
    Changes,
    /// Noise about nothing: its mean and deviation, N.
    Noise(f64, f64),
    /// Noise about a load that stays: its mean and deviation, N.
    Constant(f64, f64),
}

/// What a load's channel holds, beside the effort, of samples every `step` seconds.
pub fn kind(load: &[f64], effort: &[f64], step: f64) -> LoadKind {
    let block = ((BLOCK.0 / step) as usize).max(BLOCK.1);
    let blocks = load.len() / block;
    if blocks < FEWEST {
        return LoadKind::Changes;
    }
    let (mean, deviation) = moments(load);
    let means: Vec<f64> = load
        .chunks_exact(block)
        .map(|block| moments(block).0)
        .collect();
    let far = load
        .iter()
        .map(|load| (load - mean).abs())
        .fold(0.0, f64::max);
    // Noise with a memory of a sixteenth of a block: four deviations of a correlation by chance.
    let chance = 1.0 / (blocks as f64).sqrt();
    let noise = deviation > 0.0
        && moments(&means).1 <= MEANS * deviation
        && far <= EXCURSION * deviation
        && correlation(load, effort).abs() <= chance;
    if !noise {
        LoadKind::Changes
    } else if mean.abs() <= STAYS * deviation {
        LoadKind::Noise(mean, deviation)
    } else {
        LoadKind::Constant(mean, deviation)
    }
}

/// Mean and standard deviation.
fn moments(signal: &[f64]) -> (f64, f64) {
    let count = signal.len().max(1) as f64;
    let mean = signal.iter().sum::<f64>() / count;
    let square: f64 = signal.iter().map(|x| (x - mean) * (x - mean)).sum();
    (mean, (square / count).sqrt())
}

/// Correlation of two signals; 0 where one never changes.
pub fn correlation(one: &[f64], other: &[f64]) -> f64 {
    let ((mean, deviation), (mean_other, deviation_other)) = (moments(one), moments(other));
    let both: f64 = one
        .iter()
        .zip(other)
        .map(|(one, other)| (one - mean) * (other - mean_other))
        .sum();
    let size = deviation * deviation_other * one.len() as f64;
    if size > 0.0 { both / size } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;
    use crate::fit::toys::noise;

    const STEP: f64 = 1e-3;
    const SAMPLES: usize = 20_000;

    /// An effort of reversals at 0.7 Hz.
    fn effort() -> Vec<f64> {
        (0..SAMPLES)
            .map(|k| 0.04 * (TAU * 0.7 * STEP * k as f64).sin().signum())
            .collect()
    }

    fn load(of: impl Fn(f64, f64) -> f64, memory: f64) -> Vec<f64> {
        noise(7, SAMPLES, memory)
            .iter()
            .enumerate()
            .map(|(k, noise)| of(STEP * k as f64, *noise))
            .collect()
    }

    #[test]
    fn noise_is_no_load_whatever_its_memory() {
        // A memory of 0.9 of a tick: 19 samples count as one.
        for memory in [0.0, 0.5, 0.9] {
            let free = load(|_, noise| 0.3 + 4.0 * noise, memory);
            let found = kind(&free, &effort(), STEP);
            assert!(matches!(found, LoadKind::Noise(..)), "{memory}: {found:?}");
            let dead_weight = load(|_, noise| 500.0 + 4.0 * noise, memory);
            let found = kind(&dead_weight, &effort(), STEP);
            let LoadKind::Constant(mean, _) = found else {
                panic!("{memory}: {found:?}");
            };
            assert!((mean - 500.0).abs() < 1.0);
        }
    }

    #[test]
    fn what_changes_or_drives_the_effort_is_a_load() {
        let slow = load(
            |time, noise| 12.0 * (TAU * 0.1 * time).sin() + 4.0 * noise,
            0.0,
        );
        assert_eq!(kind(&slow, &effort(), STEP), LoadKind::Changes);
        // Whole periods in a block: the effort follows it.
        let fast = load(
            |time, noise| 40.0 * (TAU * 8.0 * time).sin() + 4.0 * noise,
            0.0,
        );
        let follows: Vec<f64> = effort()
            .iter()
            .zip(&fast)
            .map(|(effort, load)| effort + 1e-3 * load)
            .collect();
        assert_eq!(kind(&fast, &follows, STEP), LoadKind::Changes);
        let pulse = load(
            |time, noise| {
                if (3.0..3.02).contains(&time) {
                    90.0
                } else {
                    noise
                }
            },
            0.0,
        );
        assert_eq!(kind(&pulse, &effort(), STEP), LoadKind::Changes);
        assert_eq!(kind(&[1.0; 100], &[1.0; 100], STEP), LoadKind::Changes);
    }
}
