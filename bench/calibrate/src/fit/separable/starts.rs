//! Starts, and whether the answer depends on them.

use nalgebra::DVector;

use super::descent::{Neighbourhood, projected};
use super::model::{Model, Point};
use crate::fit::problem::Separable;
use crate::signals::autocorrelation::effective_rows;

/// Two minima cannot be told apart when twice their difference in log-likelihood is below this (odds of e^5).
const INDISTINGUISHABLE: f64 = 10.0;

/// Two minima are different when they are so many standard deviations, squared, from each other.
const DIFFERENT: f64 = 25.0;

/// Two minima are as good as each other, whatever their likelihoods say, when their residuals' sums of squares differ by less than
/// this part: what a model leaves out can turn so little.
const NEARLY: f64 = 0.005;

/// A residual below this part of the target is rounding.
const ROUNDING: f64 = 1e-7;

/// One start and its end.
#[derive(Clone, Debug, PartialEq)]
pub struct Start {
    /// Nonlinear parameters at the start.
    pub start: Vec<f64>,
    /// Nonlinear parameters at the end.
    pub end: Vec<f64>,
    /// Root of the mean square of the residual at the end.
    pub residual_rms: f64,
    /// How it ended.
    pub outcome: Outcome,
}

/// How a start ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// Given up after the coarse pass.
    Coarse,
    /// At the best answer.
    Best,
    /// At another answer whose residual cannot be told from the best one's.
    Rival,
    /// At a minimum with a larger residual.
    Worse,
}

/// Whether the answer depends on the start.
#[derive(Clone, Debug, PartialEq)]
pub enum Verdict {
    /// No nonlinear parameter, or one start only was asked for.
    Single,
    /// So many starts came to the same answer, and none to a rival.
    Agreed(usize),
    /// Only one start found the best answer; all others ended at clearly larger residuals.
    FoundOnce {
        /// Whether it was the given one, which knows more than a place within the bounds.
        given: bool,
    },
    /// Starts ended at different answers with indistinguishable residuals.
    DependsOnStart {
        /// Parameters that differ.
        names: Vec<&'static str>,
    },
}

/// Start points in the unit cube that fill it evenly (Roberts' additive recurrence), the same in every run.
pub(super) fn fractions(count: usize, dimensions: usize) -> Vec<Vec<f64>> {
    // The root of x^(d+1) = x + 1, by its own iteration, which contracts.
    let golden = (0..64).fold(2.0f64, |x, _| {
        (1.0 + x).powf(1.0 / (dimensions as f64 + 1.0))
    });
    let coordinate =
        |point: usize, axis: usize| (0.5 + point as f64 * golden.powi(-(axis as i32 + 1))).fract();
    // A margin, since the corners of wide bounds are seldom near an answer.
    let inside = |part: f64| 0.05 + 0.9 * part;
    (1..=count)
        .map(|point| {
            (0..dimensions)
                .map(|axis| inside(coordinate(point, axis)))
                .collect()
        })
        .collect()
}

/// The neighbourhood of a minimum.
pub(super) fn neighbourhood(model: &Model, point: &Point, roots: &[f64]) -> Neighbourhood {
    let rows = roots.len() as f64;
    let effective_rows = effective_rows(point.projection.residual.as_slice());
    let size: f64 = model
        .problem
        .target()
        .iter()
        .map(|value| value * value)
        .sum();
    let cost = point
        .cost
        .max(ROUNDING * ROUNDING * size)
        .max(f64::MIN_POSITIVE);
    let slope = projected(model, point, roots, true);
    // One of `effective_rows` rows carries the variance of a row.
    let information = slope.tr_mul(&slope) * (effective_rows / rows) / (cost / rows);
    Neighbourhood {
        inner: model.coordinates.inner(&point.values),
        cost,
        information,
        effective_rows,
    }
}

/// How an end compares with the best.
pub(super) fn outcome(model: &Model, best: &Neighbourhood, end: &Point) -> Outcome {
    let difference = best.difference(end.cost.max(best.cost));
    let nearly = end.cost < (1.0 + NEARLY) * best.cost;
    let different =
        best.distance(&model.coordinates.inner(&end.values)) > DIFFERENT + 4.0 * difference;
    match (difference < INDISTINGUISHABLE || nearly, different) {
        (true, true) => Outcome::Rival,
        (true, false) if difference < INDISTINGUISHABLE => Outcome::Best,
        _ => Outcome::Worse,
    }
}

/// Parameters by which two answers differ: by more than three standard deviations, or the one that differs most.
pub(super) fn differing(
    problem: &dyn Separable,
    best: &Neighbourhood,
    inner: &[f64],
) -> Vec<&'static str> {
    let away = DVector::from_iterator(
        inner.len(),
        inner.iter().zip(&best.inner).map(|(a, b)| (a - b).abs()),
    );
    let deviations: Vec<f64> = (0..inner.len())
        .map(|k| away[k] * best.information[(k, k)].max(0.0).sqrt())
        .collect();
    let most = deviations
        .iter()
        .fold(0.0f64, |most, value| most.max(*value));
    let counts = |deviation: &f64| *deviation > 3.0 || *deviation >= most;
    problem
        .nonlinear()
        .iter()
        .zip(&deviations)
        .filter(|(_, value)| counts(value))
        .map(|(p, _)| p.name)
        .collect()
}
