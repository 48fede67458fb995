//! A load that never leaves its own noise: a sensor without a load, or under one that stays.
//!
//! The means of blocks of noise vary by far less than its samples. A load that the screw carries varies with the manoeuvre, or where it
//! alternates fast, the effort follows it.

use crate::trace::channels::moments;

/// Length of a block, s, and fewest samples of one.
const BLOCK: (f64, usize) = (0.5, 64);
const FEWEST: usize = 8;
/// Deviation of the blocks' means over that of the samples: noise of one independent sample in a sixteenth of a block has this.
const MEANS: f64 = 0.25;
/// Largest distance from the mean, in deviations: a minute of normal noise at 1 kHz reaches 4.5.
const EXCURSION: f64 = 6.0;

/// Mean and standard deviation of a load that is noise about one value, beside the effort, of samples every `step` seconds; `None` where
/// it changes, or is too short to tell.
pub fn noise(load: &[f64], effort: &[f64], step: f64) -> Option<(f64, f64)> {
    let block = ((BLOCK.0 / step) as usize).max(BLOCK.1);
    let blocks = load.len() / block;
    if blocks < FEWEST {
        return None;
    }
    let (mean, deviation) = moments(load.iter().copied());
    let means = load
        .chunks_exact(block)
        .map(|block| moments(block.iter().copied()).0);
    let means: Vec<f64> = means.collect();
    let far = load
        .iter()
        .any(|load| (load - mean).abs() > EXCURSION * deviation);
    // Noise with a memory of a sixteenth of a block: four deviations of a correlation by chance.
    let chance = 1.0 / (blocks as f64).sqrt();
    let noise = deviation > 0.0
        && !far
        && moments(means.iter().copied()).1 <= MEANS * deviation
        && correlation(load, effort).abs() <= chance;
    noise.then_some((mean, deviation))
}

/// Correlation of two signals; 0 where one never changes.
pub fn correlation(one: &[f64], other: &[f64]) -> f64 {
    let ((mean, deviation), (mean_other, deviation_other)) =
        (moments(one.iter().copied()), moments(other.iter().copied()));
    let pairs = one.iter().zip(other);
    let both: f64 = pairs
        .map(|(one, other)| (one - mean) * (other - mean_other))
        .sum();
    let size = deviation * deviation_other * one.len() as f64;
    if size > 0.0 { both / size } else { 0.0 }
}
