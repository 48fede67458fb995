//! Fits whose answer is known.

use super::problem::Separable;
use super::search::fit;
use super::toys::{STRIBECK, noise, stribeck_toy};
use super::uncertainty::uncertainty;

/// Without noise the truth comes back from a first guess that is off by a factor of three: to the differences' step squared, 1e-4, over the
/// tolerance of the descent.
#[test]
fn a_curve_without_noise_is_found() {
    let toy = stribeck_toy(&[0.0; 1500], 0.0);
    let found = fit(&toy).unwrap();
    let values = found.nonlinear.iter().chain(&found.linear);
    for (value, wanted) in values.zip(STRIBECK.0.iter().chain(&STRIBECK.1)) {
        assert!((value / wanted - 1.0).abs() < 1e-6, "{value} {wanted}");
    }
    assert!(found.residual_rms() < 1e-6);
}

/// A linear parameter whose best value is beyond its bound stays at the bound, and the others are best beside it.
#[test]
fn a_bound_of_a_linear_parameter_is_kept() {
    let mut toy = stribeck_toy(&noise(1, 1500, 0.0), 0.1);
    toy.linear[2].low = 0.0;
    let found = fit(&toy).unwrap();
    assert_eq!(found.linear[2], 0.0);
    let columns = toy.evaluate(&found.nonlinear).columns;
    let pull = |column: &[f64]| -> f64 {
        let rows = column.iter().zip(&found.residual);
        rows.map(|(x, left)| x * left).sum::<f64>()
    };
    let size = |column: &[f64]| column.iter().map(|x| x * x).sum::<f64>();
    for column in &columns[..2] {
        assert!(pull(column).abs() < 1e-9 * size(column).sqrt() * found.cost().sqrt());
    }
}

/// Of 60 runs with noise of memory 0.9 between rows, nine of ten intervals hold: 60 x 0.95 less three deviations is 52.
#[test]
fn intervals_hold_under_noise_with_a_memory() {
    let mut held = [0; 5];
    for seed in 0..60 {
        let toy = stribeck_toy(&noise(seed, 1500, 0.9), 0.2);
        let sure = uncertainty(&toy, &fit(&toy).unwrap());
        let truth = STRIBECK.0.iter().chain(&STRIBECK.1);
        for ((held, interval), truth) in held.iter_mut().zip(&sure.intervals).zip(truth) {
            *held += usize::from((interval.low..=interval.high).contains(truth));
        }
    }
    assert!(held.iter().all(|held| *held >= 52), "{held:?}");
}

#[test]
fn a_first_guess_beyond_its_bounds_is_named() {
    let mut toy = stribeck_toy(&[0.0; 1500], 0.0);
    toy.nonlinear[1].start = 1e3;
    let refusal = fit(&toy).unwrap_err();
    assert!(refusal.message().contains("stribeck_speed"));
    toy.target.truncate(4);
    let refusal = fit(&toy).unwrap_err();
    assert!(refusal.message().contains("too few"));
}
