use super::*;
use crate::calibrate::separable::{FitSettings, fit};
use crate::calibrate::toys::{STRIBECK, noise, stribeck_toy};

/// Runs whose interval holds the truth, and the mean ratio of standard error to the runs' own spread, for each parameter.
fn coverage(runs: u64, rows: usize, memory: f64) -> Vec<(&'static str, u64, f64)> {
    let settings = FitSettings {
        starts: 1,
        finished: 1,
        ..FitSettings::default()
    };
    let truth: Vec<f64> = STRIBECK.0.iter().chain(&STRIBECK.1).copied().collect();
    let mut held = vec![0; truth.len()];
    let mut errors = vec![vec![]; truth.len()];
    let mut deviations = vec![0.0; truth.len()];
    let mut names = vec![];
    for run in 0..runs {
        let mut toy = stribeck_toy(&noise(run, rows, memory), 0.2);
        for (parameter, value) in toy.nonlinear.iter_mut().zip(STRIBECK.0) {
            parameter.start = 1.2 * value;
        }
        let found = uncertainty(&toy, &fit(&toy, &settings).unwrap());
        names = found
            .intervals
            .iter()
            .map(|interval| interval.name)
            .collect();
        for (k, interval) in found.intervals.iter().enumerate() {
            held[k] += u64::from((interval.low..=interval.high).contains(&truth[k]));
            errors[k].push(inner(interval.scale, interval.value) - inner(interval.scale, truth[k]));
            deviations[k] += interval.standard_error / runs as f64;
        }
    }
    let spread =
        |errors: &[f64]| (errors.iter().map(|e| e * e).sum::<f64>() / errors.len() as f64).sqrt();
    (0..truth.len())
        .map(|k| (names[k], held[k], deviations[k] / spread(&errors[k])))
        .collect()
}

/// 60 runs of 1,500 rows whose noise has a memory of 0.68, as that of a filtered trace. Were 95 % true, fewer than 51 of 60 would be
/// held in 1 of 1,000 tests of one parameter. The naive covariance, 2.3 times too narrow here, would hold 36.
#[test]
fn intervals_hold_the_truth() {
    for (name, held, ratio) in coverage(60, 1500, 0.68) {
        assert!(held >= 51, "{name}: {held} of 60, {ratio}");
    }
}

/// Held in 400 runs each, at least and at most of the five parameters (nominal 380):
#[test]
#[ignore = "1,600 fits, 3 minutes; run with --ignored --nocapture"]
fn intervals_hold_the_truth_at_length() {
    for (rows, memory) in [(6000, 0.68), (3000, 0.0), (1500, 0.9), (6000, 0.95)] {
        for (name, held, ratio) in coverage(400, rows, memory) {
            println!(
                "{rows} rows, memory {memory}: {name} {held} of 400, error given over found {ratio:.3}"
            );
            assert!((360..=396).contains(&held), "{name}");
        }
    }
}
