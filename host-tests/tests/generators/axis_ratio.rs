//! Axis ratio of a contact ellipse from the ratio of its relative radii.

use epas_friction::hertz::{
    AXIS_RATIO_DENOMINATOR as DENOMINATOR, AXIS_RATIO_NUMERATOR as NUMERATOR,
};
use epas_reference::hertz::axis_ratio;

use crate::remez::{Fit, equioscillates, minimax};

/// Ratio of the relative radii up to which the fit holds.
const LARGEST_RATIO: f64 = 1e5;

/// `k/x²` with `x = (R1/R2)^(1/3)`.
fn departure(x: f64) -> f64 {
    axis_ratio(1.0 / (x * x * x)).unwrap_or(f64::NAN) / (x * x)
}

#[test]
fn the_quotient_is_within_a_percent_of_the_best_one() {
    let interval = (LARGEST_RATIO.cbrt().recip(), 1.0);
    let best = minimax(departure, |x| 1.0 / departure(x), interval, (5, 4));
    let stored = Fit {
        numerator: NUMERATOR.map(f64::from).to_vec(),
        denominator: DENOMINATOR.map(f64::from).to_vec(),
        error: 0.0,
    };
    let error = |x| stored.at(x) / departure(x) - 1.0;
    // It was fitted up to a ratio of 1.0076e5, where its last extreme has the size of the others; at 1e5 that has nine
    // tenths of it. The coefficients' roundings, 3e-8 of their terms, are 0.3 % of the error.
    let largest = equioscillates("axis ratio", error, interval, 11, 0.1);
    let further = (1.0076e5_f64.cbrt().recip(), 1.0);
    equioscillates("axis ratio, to 1.0076e5", error, further, 11, 0.01);
    assert!(largest < 1.02e-5 && largest < 1.01 * best.error);
    // The two quotients agree to a seventh of their error; their coefficients only to 0.3 %, because numerator and
    // denominator can grow alike.
    for step in 0..=1000 {
        let x = interval.0 + (1.0 - interval.0) * f64::from(step) / 1000.0;
        assert!((stored.at(x) / best.at(x) - 1.0).abs() < 1.5e-6, "{x}");
    }
}
