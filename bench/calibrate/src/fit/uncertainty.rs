//! How sure a fit is: intervals that respect that neighbouring rows err alike, correlations, and the direction the rows cannot see.
//!
//! The covariance is the sandwich of an M-estimator, `B^-1 M B^-1`. `B` is the information of the rows, each with the slope of its
//! loss' derivative; `M` is the long-run covariance of the rows' pulls on the parameters (Newey and West 1987, Bartlett's weights).
//! It is in inner coordinates: a parameter with a logarithmic scale has the covariance of its logarithm, and so an interval of factors.

use nalgebra::DMatrix;
use statrs::distribution::{ContinuousCDF, StudentsT};

use crate::fit::problem::{Scale, Separable};
use crate::fit::separable::{Fit, inner, inner_slope, outer};
use crate::signals::autocorrelation::{effective_rows, lags};

/// Singular values below this part of the largest are rounding; a direction there has an interval without an end in practice.
const ROUNDING: f64 = 1e-12;

/// Probability that an interval is to hold its parameter with.
const CONFIDENCE: f64 = 0.95;

/// Intervals are made wider by this. Measured: in 4 x 400 runs of a Stribeck curve with noise of memory 0 to 0.95 (the long test of this
/// module), intervals without it held each parameter in 88.5 to 97.8 % of the runs; a long-run variance from a finite record is small
/// on average, and smaller still where the slopes are as slow as the noise. With it they held it in 94.2 to 99 %.
const WIDER: f64 = 1.2;

/// One parameter with its interval.
#[derive(Clone, Debug, PartialEq)]
pub struct Interval {
    /// Name.
    pub name: &'static str,
    /// Unit.
    pub unit: &'static str,
    /// Scale of its inner coordinate.
    pub scale: Scale,
    /// Best value.
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
    /// Bounds.
    pub bounds: [f64; 2],
    /// Whether the value is at a bound.
    pub at_bound: bool,
}

impl Interval {
    /// Takes a standard error of the inner coordinate, and `quantile` of them as half of the interval.
    pub fn spread(&mut self, standard_error: f64, quantile: f64) {
        self.standard_error = standard_error;
        self.half_width = quantile * standard_error;
        let end = |side: f64| {
            let place = inner(self.scale, self.value) + side * self.half_width;
            outer(self.scale, place).clamp(self.bounds[0], self.bounds[1])
        };
        (self.low, self.high) = (end(-1.0), end(1.0));
    }
}

/// How sure a fit is. All lists and matrices have the nonlinear parameters before the linear ones.
#[derive(Clone, Debug, PartialEq)]
pub struct Uncertainty {
    /// Parameters with their intervals.
    pub intervals: Vec<Interval>,
    /// Covariance of the inner coordinates.
    pub covariance: DMatrix<f64>,
    /// Correlations, -1 to 1.
    pub correlation: DMatrix<f64>,
    /// Singular values of the slopes over the inner coordinates, each column scaled to 1; the largest first.
    pub singular_values: Vec<f64>,
    /// Largest over smallest of them.
    pub condition: f64,
    /// Direction that the rows see least, as parts of the scaled columns; its squares sum to 1.
    pub null_direction: Vec<f64>,
    /// Lags of the long-run covariance.
    pub lags: usize,
    /// Rows that count as independent.
    pub effective_rows: f64,
    /// Standard deviation of a row's residual.
    pub noise: f64,
    /// Half width of an interval over its standard error.
    pub quantile: f64,
}

/// The rows' slopes over the inner coordinates (logarithms, or values), nonlinear parameters before linear ones.
pub fn inner_jacobian(problem: &dyn Separable, fit: &Fit) -> DMatrix<f64> {
    let mut jacobian = fit.jacobian.clone();
    for (k, (parameter, value)) in problem.nonlinear().iter().zip(&fit.nonlinear).enumerate() {
        jacobian
            .column_mut(k)
            .scale_mut(1.0 / inner_slope(parameter.scale, *value));
    }
    jacobian
}

/// How sure a fit of this problem is.
pub fn uncertainty(problem: &dyn Separable, fit: &Fit) -> Uncertainty {
    let jacobian = inner_jacobian(problem, fit);
    let (rows, count) = jacobian.shape();
    let effective = effective_rows(&fit.residual);
    let lags = lags(&fit.residual);
    let Bread {
        inverse,
        scales,
        singular_values,
        null_direction,
    } = bread(&jacobian, &fit.weights);
    let filling = filling(&jacobian, fit, &scales, lags + 1);
    // Each parameter takes one independent row's noise out of the residual.
    let freedom = (effective - count as f64).max(1.0);
    let mut covariance = &inverse * filling * &inverse * (effective / freedom).max(1.0);
    for (k, scale) in scales.iter().enumerate() {
        covariance.row_mut(k).scale_mut(1.0 / scale);
        covariance.column_mut(k).scale_mut(1.0 / scale);
    }
    let quantile = quantile(freedom, (lags + 1) as f64 / rows as f64);
    let deviations = deviations(&covariance);
    let smallest = singular_values.last().copied().unwrap_or(1.0);
    let largest = singular_values.first().copied().unwrap_or(1.0);
    Uncertainty {
        intervals: intervals(problem, fit, &deviations, quantile),
        correlation: correlation(&covariance),
        covariance,
        condition: largest / smallest.max(largest * f64::EPSILON),
        singular_values,
        null_direction,
        lags,
        effective_rows: effective,
        noise: (fit.residual.iter().map(|r| r * r).sum::<f64>()
            / (rows as f64 * freedom / (freedom + count as f64)))
            .sqrt(),
        quantile,
    }
}

/// Standard deviations of a covariance.
pub fn deviations(covariance: &DMatrix<f64>) -> Vec<f64> {
    let variances = covariance.diagonal();
    variances
        .iter()
        .map(|variance| variance.max(0.0).sqrt())
        .collect()
}

/// Correlations of a covariance.
pub fn correlation(covariance: &DMatrix<f64>) -> DMatrix<f64> {
    let deviations = deviations(covariance);
    DMatrix::from_fn(covariance.nrows(), covariance.ncols(), |i, j| {
        let size = deviations[i] * deviations[j];
        if i == j || !(size > 0.0) {
            f64::from(u8::from(i == j))
        } else {
            (covariance[(i, j)] / size).clamp(-1.0, 1.0)
        }
    })
}

struct Bread {
    /// Inverse of the information of the scaled columns.
    inverse: DMatrix<f64>,
    /// Norms of the columns.
    scales: Vec<f64>,
    singular_values: Vec<f64>,
    null_direction: Vec<f64>,
}

/// The information and its inverse. The soft-L1 loss' derivative `w r`, `w = 1 / sqrt(1 + (r / bend)^2)`, has the slope `w^3`.
fn bread(jacobian: &DMatrix<f64>, weights: &[f64]) -> Bread {
    let count = jacobian.ncols();
    let mut scaled = jacobian.clone();
    for (mut row, weight) in scaled.row_iter_mut().zip(weights) {
        row *= weight.powf(1.5);
    }
    let scales: Vec<f64> = scaled
        .column_iter()
        .map(|column| {
            if column.norm() > 0.0 {
                column.norm()
            } else {
                1.0
            }
        })
        .collect();
    for (mut column, scale) in scaled.column_iter_mut().zip(&scales) {
        column /= *scale;
    }
    if count == 0 {
        return Bread {
            inverse: DMatrix::zeros(0, 0),
            scales,
            singular_values: vec![],
            null_direction: vec![],
        };
    }
    let parts = scaled.qr().r().svd(false, true);
    let directions = parts.v_t.unwrap_or_else(|| DMatrix::identity(count, count));
    let floor = ROUNDING * parts.singular_values.max();
    let over = parts
        .singular_values
        .map(|value| value.max(floor).max(f64::MIN_POSITIVE).powi(-2));
    let inverse = directions.tr_mul(&(DMatrix::from_diagonal(&over) * &directions));
    let singular_values: Vec<f64> = parts.singular_values.iter().copied().collect();
    let null_direction = directions.row(count - 1).iter().copied().collect();
    Bread {
        inverse,
        scales,
        singular_values,
        null_direction,
    }
}

/// Long-run covariance of the rows' pulls on the scaled parameters. With Bartlett's weights it is the mean over all windows of `window`
/// rows, those that hang over the ends too, of the squares of the windows' sums.
fn filling(jacobian: &DMatrix<f64>, fit: &Fit, scales: &[f64], window: usize) -> DMatrix<f64> {
    let (rows, count) = jacobian.shape();
    let mut pulls = DMatrix::zeros(count, rows);
    for (t, mut pull) in pulls.column_iter_mut().enumerate() {
        let size = fit.weights[t] * fit.residual[t];
        for (k, value) in pull.iter_mut().enumerate() {
            *value = size * jacobian[(t, k)] / scales[k];
        }
    }
    let mut sums = DMatrix::zeros(count, rows + window - 1);
    let mut sum = nalgebra::DVector::zeros(count);
    for (t, mut into) in sums.column_iter_mut().enumerate() {
        if t < rows {
            sum += pulls.column(t);
        }
        if t >= window {
            sum -= pulls.column(t - window);
        }
        into.copy_from(&sum);
    }
    &sums * sums.transpose() / window as f64
}

/// Half width of a 95 % interval in standard errors: [`WIDER`] times Student's at this many degrees of freedom, and wider by what a window of `share`
/// of the rows costs (Kiefer and Vogelsang 2005, table 1, Bartlett: 1.9600 + 2.9694 b + 0.4160 b^2 - 0.5324 b^3).
pub(super) fn quantile(freedom: f64, share: f64) -> f64 {
    let student = StudentsT::new(0.0, 1.0, freedom)
        .map_or(f64::INFINITY, |law| law.inverse_cdf(0.5 + 0.5 * CONFIDENCE));
    WIDER * student * (1.9600 + share * (2.9694 + share * (0.4160 - share * 0.5324))) / 1.9600
}

fn intervals(
    problem: &dyn Separable,
    fit: &Fit,
    deviations: &[f64],
    quantile: f64,
) -> Vec<Interval> {
    let nonlinear = problem
        .nonlinear()
        .iter()
        .map(|p| (p.name, p.unit, p.scale, [p.low, p.high]));
    let linear = problem
        .linear()
        .iter()
        .map(|p| (p.name, p.unit, Scale::Linear, [p.low, p.high]));
    let values = fit.nonlinear.iter().chain(&fit.linear);
    let interval =
        |(((name, unit, scale, bounds), value), error): (((_, _, Scale, [f64; 2]), &f64), &f64)| {
            let mut interval = Interval {
                name,
                unit,
                scale,
                value: *value,
                low: *value,
                high: *value,
                standard_error: 0.0,
                model_error: 0.0,
                half_width: 0.0,
                bounds,
                at_bound: fit.at_bound.contains(&name),
            };
            interval.spread(*error, quantile);
            interval
        };
    nonlinear
        .chain(linear)
        .zip(values)
        .zip(deviations)
        .map(interval)
        .collect()
}

#[cfg(test)]
mod tests;
