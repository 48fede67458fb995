//! What one channel of a trace needs before it is used: angles without jumps, the step of its sensor.

use std::f64::consts::TAU;

/// Most samples that a sensor's step is found from: more tell no more.
const MOST: usize = 200_000;

/// Largest turn between two samples of an angle that wraps, in turns: half a turn could be one of either direction.
const LARGEST_TURN: f64 = 0.4;

/// Joins the turns of an angle, rad, that starts again after a full turn. An angle that goes beyond one turn is left alone.
pub fn unwrap(angle: &mut [f64]) -> Result<(), String> {
    let (low, high) = range(angle);
    let jumps = angle
        .windows(2)
        .any(|pair| matches!(pair, [a, b] if (b - a).abs() > 0.5 * TAU));
    // Beyond a turn by what a sensor's noise may add.
    if !jumps || high - low > 1.01 * TAU {
        return Ok(());
    }
    let mut turns = 0.0;
    let mut last = angle.first().copied().unwrap_or_default();
    for (sample, value) in angle.iter_mut().enumerate() {
        let moved = *value - last;
        last = *value;
        let whole = (moved / TAU).round();
        let turn = (moved / TAU - whole).abs();
        if turn > LARGEST_TURN {
            return Err(format!(
                "the angle wraps and moves by {turn:.2} turns before sample {sample}: which way cannot be told; sample faster"
            ));
        }
        turns -= whole;
        *value += turns * TAU;
    }
    Ok(())
}

/// Median: of an even number the upper of the two in the middle; 0 of none.
pub fn median(mut values: Vec<f64>) -> f64 {
    let middle = values.len() / 2;
    if values.is_empty() {
        return 0.0;
    }
    *values.select_nth_unstable_by(middle, f64::total_cmp).1
}

/// Mean and standard deviation.
pub fn moments(values: impl Iterator<Item = f64> + Clone) -> (f64, f64) {
    let count = values.clone().count().max(1) as f64;
    let mean = values.clone().sum::<f64>() / count;
    let square: f64 = values.map(|x| (x - mean).powi(2)).sum();
    (mean, (square / count).sqrt())
}

/// Smallest and largest value.
pub fn range(signal: &[f64]) -> (f64, f64) {
    signal
        .iter()
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| {
            (low.min(*x), high.max(*x))
        })
}

/// Step of a sensor that rounds, found from the distances between the values that occur; 0 where there is none to be seen.
pub fn resolution(signal: &[f64]) -> f64 {
    let stride = signal.len() / MOST + 1;
    let mut values: Vec<f64> = signal.iter().step_by(stride).copied().collect();
    values.sort_by(f64::total_cmp);
    let (Some(first), Some(last)) = (values.first(), values.last()) else {
        return 0.0;
    };
    // Below it, two values are the same number with different roundings.
    let rounding = 1e-11 * (last - first) + 4.0 * f64::EPSILON * first.abs().max(last.abs());
    let mut gaps: Vec<f64> = values
        .windows(2)
        .map(|pair| match pair {
            [a, b] => b - a,
            _ => 0.0,
        })
        .filter(|gap| *gap > rounding)
        .collect();
    // Fewer distances than this tell nothing.
    if gaps.len() < 10 {
        return 0.0;
    }
    gaps.sort_by(f64::total_cmp);
    // Smaller distances than the step come from numbers printed with few digits.
    [0.005, 0.1, 0.25, 0.5, 0.75]
        .into_iter()
        .filter_map(|share| gaps.get((share * gaps.len() as f64) as usize).copied())
        .find_map(|candidate| step_of(&gaps, candidate))
        .unwrap_or(0.0)
}

/// The step near this one that the distances are multiples of.
fn step_of(gaps: &[f64], candidate: f64) -> Option<f64> {
    /// Largest multiple that is looked at: the error of the candidate grows with it.
    const LARGEST: f64 = 10.0;
    /// Distance from a multiple that counts as none; random distances keep it in a fifth of all cases.
    const NEAR: f64 = 0.1;
    const SHARE: f64 = 0.95;
    let (mut looked, mut near, mut sum, mut multiples) = (0usize, 0usize, 0.0, 0.0);
    for gap in gaps {
        let multiple = gap / candidate;
        if !(NEAR..=LARGEST).contains(&multiple) {
            continue;
        }
        looked += 1;
        let whole = multiple.round();
        if whole >= 1.0 && (multiple - whole).abs() < NEAR {
            near += 1;
            sum += gap;
            multiples += whole;
        }
    }
    let known = looked >= 10 && near as f64 >= SHARE * looked as f64;
    // Where most distances are left out, the rest may be chance.
    let many = looked as f64 >= 0.2 * gaps.len() as f64;
    (known && many).then(|| sum / multiples)
}
