//! How sure a fit is: intervals of its parameters, and their covariance.

use nalgebra::DMatrix;

use super::problem::{Parameter, Scale, Separable, inner, outer};
use super::search::{Found, at_bound, slopes};
use crate::estimator::fit::{Block, fit as least_squares};

/// Half of a 95 % interval over its standard error.
pub const QUANTILE: f64 = 1.959_964;

/// Rows of a piece, where rows stand at a third of their kernel's half-width: eight half-widths.
const PIECE: usize = 24;

#[derive(Clone, Debug, PartialEq)]
pub struct Interval {
    pub name: &'static str,
    pub unit: &'static str,
    pub scale: Scale,
    pub value: f64,
    /// Low end of the 95 % interval, not below the low bound.
    pub low: f64,
    /// High end, not above the high bound.
    pub high: f64,
    /// Standard error of the inner coordinate.
    pub standard_error: f64,
    /// What the model's own errors make of it: part of the standard error, not of the covariance, and the same in every trace.
    pub model_error: f64,
    /// Half width of the interval in the inner coordinate, whatever the bounds.
    pub half_width: f64,
    pub bounds: [f64; 2],
    pub at_bound: bool,
}

/// How sure a fit is. Lists and matrices have the nonlinear parameters before the linear ones.
#[derive(Clone, Debug, PartialEq)]
pub struct Uncertainty {
    pub intervals: Vec<Interval>,
    pub covariance: DMatrix<f64>,
    pub effective_rows: f64,
}

impl Interval {
    /// Takes its place in the inner coordinate, with the standard error there and what the model's own errors add. One at a bound stays.
    pub fn settle(&mut self, place: f64, standard_error: f64, model_error: f64) {
        let [low, high] = self.bounds;
        let value = outer(self.scale, place);
        let inside = (low..=high).contains(&value);
        if value.is_finite() && !(self.at_bound && inside) {
            self.at_bound |= !inside;
            self.value = value.max(low).min(high);
        }
        self.model_error = model_error;
        self.standard_error = standard_error.hypot(model_error);
        self.half_width = QUANTILE * self.standard_error;
        let end = |side: f64| {
            let place = inner(self.scale, self.value) + side * self.half_width;
            outer(self.scale, place).max(low).min(high)
        };
        (self.low, self.high) = (end(-1.0), end(1.0));
    }
}

/// Intervals of a fit without a width yet.
pub fn intervals(problem: &dyn Separable, found: &Found) -> Vec<Interval> {
    let interval = |(of, value): (&Parameter, &f64)| Interval {
        name: of.name,
        unit: of.unit,
        scale: of.scale,
        value: *value,
        low: *value,
        high: *value,
        standard_error: 0.0,
        model_error: 0.0,
        half_width: 0.0,
        bounds: [of.low, of.high],
        at_bound: at_bound(of, *value),
    };
    let nonlinear = problem.nonlinear().iter().zip(&found.nonlinear);
    let linear = problem.linear().iter().zip(&found.linear);
    nonlinear.chain(linear).map(interval).collect()
}

/// How sure a fit of rows in the order of time is: by the jackknife over pieces of the linearised problem.
pub fn uncertainty(problem: &dyn Separable, found: &Found) -> Uncertainty {
    let columns = slopes(problem, &found.nonlinear, &found.linear);
    let pieces: Vec<usize> = (0..found.residual.len()).map(|row| row / PIECE).collect();
    let count = columns.len();
    let block = Block {
        columns,
        target: found.residual.clone(),
        noise: DMatrix::zeros(count, count),
        stretches: pieces.clone(),
        pieces,
    };
    let fit = least_squares(&[block], &|coefficients| coefficients.to_vec());
    let mut intervals = intervals(problem, found);
    for (interval, half) in intervals.iter_mut().zip(&fit.half_widths) {
        let place = inner(interval.scale, interval.value);
        interval.settle(place, half / QUANTILE, 0.0);
    }
    Uncertainty {
        intervals,
        covariance: fit.covariance,
        effective_rows: effective_rows(&found.residual),
    }
}

pub fn correlation(covariance: &DMatrix<f64>) -> DMatrix<f64> {
    DMatrix::from_fn(covariance.nrows(), covariance.ncols(), |i, j| {
        let size = (covariance[(i, i)] * covariance[(j, j)]).sqrt();
        if i == j || !(size > 0.0) {
            f64::from(u8::from(i == j))
        } else {
            (covariance[(i, j)] / size).clamp(-1.0, 1.0)
        }
    })
}

/// The window of a summed correlation: so many correlation times (Sokal 1997).
const WINDOW: f64 = 5.0;

/// Rows that count as one: 1 + 2 x the sum of the correlations, over the shortest window that holds five of them; at least 1.
fn correlation_time(rows: &[f64]) -> f64 {
    let power: f64 = rows.iter().map(|x| x * x).sum();
    if !(power > 0.0) {
        return 1.0;
    }
    let mut time = 1.0;
    for lag in 1..rows.len() / 2 {
        let product: f64 = rows.iter().skip(lag).zip(rows).map(|(a, b)| a * b).sum();
        time += 2.0 * product / power;
        if lag as f64 >= WINDOW * time {
            break;
        }
    }
    time.clamp(1.0, rows.len() as f64 / 2.0)
}

pub fn effective_rows(rows: &[f64]) -> f64 {
    rows.len() as f64 / correlation_time(rows)
}
