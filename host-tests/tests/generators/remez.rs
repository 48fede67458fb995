//! The best uniform approximation by a polynomial or a quotient of two, by the exchange algorithm of Remez.
//!
//! No maintained crate offers it for functions of the caller: those that carry the name design digital filters.

use nalgebra::{DMatrix, DVector};

/// Points at which the error is looked at; extremes between them are found by a parabola.
const GRID: usize = 4000;

/// `f(x)` near enough to `(n_0 + n_1 x + ...) / (1 + d_1 x + ...)`.
#[derive(Clone, Debug)]
pub struct Fit {
    pub numerator: Vec<f64>,
    pub denominator: Vec<f64>,
    pub error: f64,
}

impl Fit {
    pub fn at(&self, x: f64) -> f64 {
        polynomial(&self.numerator, x) / polynomial(&self.denominator, x)
    }
}

pub fn polynomial(coefficients: &[f64], x: f64) -> f64 {
    coefficients.iter().rev().fold(0.0, |sum, c| sum * x + c)
}

/// The quotient of degrees `numerator` and `denominator` whose largest `weight(x) |fit(x) - f(x)|` is least.
///
/// The error of that quotient takes its largest size, with alternating sign, at `numerator + denominator + 2` places (Chebyshev). Each
/// round solves for the quotient whose error does so at assumed places, and then moves the places to the extremes of the error it finds.
pub fn minimax(
    f: impl Fn(f64) -> f64,
    weight: impl Fn(f64) -> f64,
    (low, high): (f64, f64),
    (numerator, denominator): (usize, usize),
) -> Fit {
    let unknowns = numerator + denominator + 2;
    let mut places: Vec<f64> = (0..unknowns)
        .map(|i| {
            let turn = std::f64::consts::PI * i as f64 / (unknowns - 1) as f64;
            low * (high / low).powf(0.5 - 0.5 * turn.cos())
        })
        .collect();
    for _ in 0..100 {
        let fit = levelled(&f, &weight, &places, numerator, denominator);
        let error = |x| weight(x) * (fit.at(x) - f(x));
        let extremes = extremes(error, (low, high));
        assert!(
            extremes.len() >= unknowns,
            "the error has {} extremes of {unknowns}",
            extremes.len()
        );
        // Of more extremes than are needed, the run of neighbours with the largest ones: the smaller end goes.
        let mut kept = &extremes[..];
        while kept.len() > unknowns {
            let (first, last) = (kept[0].1.abs(), kept[kept.len() - 1].1.abs());
            kept = if first < last {
                &kept[1..]
            } else {
                &kept[..kept.len() - 1]
            };
        }
        let largest = kept.iter().fold(0.0, |most: f64, e| most.max(e.1.abs()));
        let least = kept.iter().fold(f64::MAX, |least, e| least.min(e.1.abs()));
        places = kept.iter().map(|e| e.0).collect();
        if largest < least * (1.0 + 1e-7) {
            return Fit {
                error: largest,
                ..fit
            };
        }
    }
    panic!("the exchange did not settle");
}

/// The quotient whose weighted error has one size and alternating signs at given places.
fn levelled(
    f: impl Fn(f64) -> f64,
    weight: impl Fn(f64) -> f64,
    places: &[f64],
    numerator: usize,
    denominator: usize,
) -> Fit {
    let unknowns = places.len();
    let mut fit = Fit {
        numerator: vec![0.0; numerator + 1],
        denominator: vec![0.0; denominator + 1],
        error: 0.0,
    };
    fit.denominator[0] = 1.0;
    // `n(x) - (f + error/weight) d(x) = 0` is linear but for the product of the error and the denominator, which is
    // taken from the round before.
    for _ in 0..200 {
        let mut matrix = DMatrix::zeros(unknowns, unknowns);
        let mut right = DVector::zeros(unknowns);
        for (row, &x) in places.iter().enumerate() {
            let sign = if row % 2 == 0 { 1.0 } else { -1.0 };
            for power in 0..=numerator {
                matrix[(row, power)] = x.powi(power as i32);
            }
            for power in 1..=denominator {
                matrix[(row, numerator + power)] = -f(x) * x.powi(power as i32);
            }
            matrix[(row, unknowns - 1)] = -sign / weight(x) * polynomial(&fit.denominator, x);
            right[row] = f(x);
        }
        let found = matrix
            .full_piv_lu()
            .solve(&right)
            .expect("places are distinct");
        let change = (found[unknowns - 1] - fit.error).abs();
        fit.numerator
            .copy_from_slice(&found.as_slice()[..=numerator]);
        fit.denominator[1..].copy_from_slice(&found.as_slice()[numerator + 1..unknowns - 1]);
        fit.error = found[unknowns - 1];
        if change <= 1e-13 * fit.error.abs() {
            break;
        }
    }
    fit
}

pub fn extremes(error: impl Fn(f64) -> f64, (low, high): (f64, f64)) -> Vec<(f64, f64)> {
    // Closer together at the ends, where the extremes are.
    let place = |i: usize| {
        let turn = std::f64::consts::PI * i as f64 / GRID as f64;
        0.5 * (low + high) - 0.5 * (high - low) * turn.cos()
    };
    let mut found: Vec<(f64, f64)> = Vec::new();
    for i in 0..=GRID {
        let (x, value) = (place(i), error(place(i)));
        match found.last_mut() {
            Some(last) if last.1 * value >= 0.0 => {
                if value.abs() > last.1.abs() {
                    *last = (x, value);
                }
            }
            _ => found.push((x, value)),
        }
    }
    for extreme in &mut found {
        let step = 1e-3 * (extreme.0 - low).min(high - extreme.0);
        if step > 0.0 {
            // The vertex of the parabola through three points.
            let (before, here, after) =
                (error(extreme.0 - step), extreme.1, error(extreme.0 + step));
            let bend = before - 2.0 * here + after;
            let shift = (0.5 * (before - after) / bend).clamp(-1.0, 1.0);
            let x = extreme.0 + if shift.is_nan() { 0.0 } else { shift * step };
            if error(x).abs() > here.abs() {
                *extreme = (x, error(x));
            }
        }
    }
    found
}

/// Asserts that an error alternates between at least `count` extremes of one size, to a part of `within`, and returns the largest one.
///
/// By the theorem of de la Vallée-Poussin the best fit of the same form is no better than the least of them: the fit
/// is within that part of the best.
pub fn equioscillates(
    name: &str,
    error: impl Fn(f64) -> f64,
    interval: (f64, f64),
    count: usize,
    within: f64,
) -> f64 {
    let found = extremes(error, interval);
    let largest = found.iter().fold(0.0, |most: f64, e| most.max(e.1.abs()));
    let level = found
        .iter()
        .filter(|e| e.1.abs() >= (1.0 - within) * largest)
        .count();
    assert!(level >= count, "{name}: {found:?}");
    largest
}
