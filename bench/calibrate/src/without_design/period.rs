//! Period of a deviation along the way, from what a model leaves over.

use std::f64::consts::TAU;

use crate::without_design::closed_loop::size;

/// Periods of the whole way: the longest that is looked for has so many.
const FEWEST: f64 = 4.0;
/// The shortest has so many.
const MOST: f64 = 500.0;
/// Steps of the sensor in the shortest period.
const STEPS: f64 = 50.0;
/// Tried places in the width of a line of the spectrum, which is one period of the whole way.
const FINENESS: f64 = 6.0;
/// Share of the residual's power from which a deviation counts.
const SHARE: f64 = 0.1;

/// The period whose sine and cosine explain most of a residual at these positions, rad or m; `None` where none explains a tenth of
/// its power.
pub fn period(position: &[f64], residual: &[f64], resolution: f64) -> Option<f64> {
    let low = position.iter().copied().fold(f64::INFINITY, f64::min);
    let high = position.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let travel = high - low;
    if !(travel > 0.0) || position.len() != residual.len() {
        return None;
    }
    let finest = if resolution > 0.0 {
        (travel / (STEPS * resolution)).min(MOST)
    } else {
        MOST
    };
    let places = ((finest - FEWEST) * FINENESS).max(0.0) as usize;
    let power = size(residual).powi(2);
    (0..=places)
        .map(|place| travel / (FEWEST + place as f64 / FINENESS))
        .map(|period| (explained(position, residual, period) / power, period))
        .max_by(|one, other| one.0.total_cmp(&other.0))
        .filter(|(share, _)| *share > SHARE)
        .map(|(_, period)| period)
}

/// Mean square that a sine and a cosine of this period explain.
fn explained(position: &[f64], residual: &[f64], period: f64) -> f64 {
    let (mut cc, mut cs, mut ss, mut c, mut s) = (0.0, 0.0, 0.0, 0.0, 0.0);
    for (position, residual) in position.iter().zip(residual) {
        let (sine, cosine) = (TAU * position / period).sin_cos();
        cc += cosine * cosine;
        cs += cosine * sine;
        ss += sine * sine;
        c += cosine * residual;
        s += sine * residual;
    }
    let determinant = cc * ss - cs * cs;
    if !(determinant > 1e-9 * cc * ss) {
        return 0.0;
    }
    let (a, b) = (
        (ss * c - cs * s) / determinant,
        (cc * s - cs * c) / determinant,
    );
    (a * c + b * s) / position.len() as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    /// There and back over 0.2 m.
    fn travel() -> Vec<f64> {
        (0..4000)
            .map(|sample| 0.1 * (1.0 - (TAU * f64::from(sample) / 4000.0).cos()))
            .collect()
    }

    #[test]
    fn a_ripple_is_found_and_noise_is_none() {
        let position = travel();
        // A golden-ratio sequence in place of noise: even, and without a period.
        let noise = |sample: usize| (sample as f64 * 0.618_034).fract() - 0.5;
        let rippled: Vec<f64> = position
            .iter()
            .enumerate()
            .map(|(sample, place)| 0.4 * (TAU * place / 2.5e-3 + 1.0).sin() + noise(sample))
            .collect();
        let found = period(&position, &rippled, 1e-7).unwrap();
        // Half of the distance of tried places: a sixth of a period in eighty.
        assert!(
            (found / 2.5e-3 - 1.0).abs() < 0.5 / (80.0 * FINENESS) + 1e-3,
            "{found}"
        );
        let plain: Vec<f64> = (0..position.len()).map(noise).collect();
        assert_eq!(period(&position, &plain, 1e-7), None);
    }

    #[test]
    fn what_stands_still_has_none() {
        assert_eq!(period(&[1.0; 8], &[1.0; 8], 1e-7), None);
        assert_eq!(period(&[], &[], 1e-7), None);
    }
}
