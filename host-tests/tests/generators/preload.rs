//! Two Hertzian springs pressed against each other.

use epas_friction::ball::{CLOSING, LOST, QUARTIC};

use crate::remez::{equioscillates, minimax, polynomial};

/// A third of the load over the preload at a displacement `x` over the preload's deflection.
fn third(x: f64) -> f64 {
    ((1.0 + x).powf(1.5) - (1.0 - x).powf(1.5)) / 3.0
}

/// The displacement at a third of a load, by bisection.
fn displacement(load: f64) -> f64 {
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..80 {
        let middle = 0.5 * (low + high);
        if third(middle) < load {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high)
}

#[test]
fn the_displacement_takes_the_best_series() {
    // x = t (1 + s p(s)) with s = t²: p is fitted, the weight of its error in x is s t. Below s = 1e-4 the bisection leaves
    // no digits of p, and the weight is 1e-6.
    let end = third(1.0) * third(1.0);
    let interval = (1e-4, end);
    let exact = |s: f64| (displacement(s.sqrt()) / s.sqrt() - 1.0) / s;
    let weight = |s: f64| s * s.sqrt();
    let best = minimax(exact, weight, interval, (2, 0));
    let stored = CLOSING.map(f64::from);
    // Five digits are stored, rounded to half a unit of the last one, 5e-6. Ten of it change the displacement by 5e-6, a hundredth of the error.
    for (found, stored) in best.numerator.iter().zip(stored) {
        assert!((found - stored).abs() < 5e-6, "{found} {stored}");
    }
    let error = |s: f64| weight(s) * (polynomial(&stored, s) - exact(s));
    // Measured: 4.22e-4.
    assert!(equioscillates("displacement", error, interval, 4, 0.01) < 4.3e-4);
}

#[test]
fn the_sum_of_both_forces_meets_the_load_where_a_side_is_lost() {
    let lost = 8.0_f64.sqrt();
    // Derived: both are rounded to f32, by at most 2^-24 = 6.0e-8.
    assert!((f64::from(LOST) / lost - 1.0).abs() < 6e-8);
    // 2 + y²/12 (1 + q y²) = y at y = 2 sqrt(2).
    let quartic = (12.0 * (lost - 2.0) / 8.0 - 1.0) / 8.0;
    assert!((f64::from(QUARTIC) / quartic - 1.0).abs() < 6e-8);
    // Largest error in between against F (1 ± x)^(3/2).
    let worst = (1..1000)
        .map(|step| {
            let x = f64::from(step) / 1000.0;
            let load = 3.0 * third(x);
            let square = load * load;
            let sum = 2.0 + square / 12.0 * (1.0 + square * quartic);
            sum / ((1.0 + x).powf(1.5) + (1.0 - x).powf(1.5)) - 1.0
        })
        .fold(0.0_f64, |worst, error| worst.max(error.abs()));
    // Measured: 8.35e-3.
    assert!(worst < 8.4e-3);
}
