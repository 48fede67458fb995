//! What traces tell together: the population of each parameter, and the traces that stand out.
//!
//! The spread of a population is Paule and Mandel's (1982), which solves `sum w (q - mean)^2 = n - 1`, `w = 1/(variance + spread^2)`,
//! over the inner coordinates `q` of all traces.
//!
//! Errors of the model itself are the same in every trace of a screw. No mean takes them out: they widen the interval of the mean, by as
//! much as the traces say each of itself, and have no part in the weights or the spread.

use roots::{SimpleConvergency, find_root_brent};
use serde::Serialize;

use super::answered::Answered;
use crate::estimator::fit::quantile;

/// Half of a 95 % interval over its standard deviation.
pub const HALF_INTERVAL: f64 = 1.96;

/// Standard deviations beyond which a trace stands out: of a normal population one in 1.7 million does by chance.
const OUT: f64 = 5.0;

/// Median of the distances from the median, of a normal population, over its standard deviation.
const MEDIAN_DISTANCE: f64 = 0.6745;

/// Traces of which a median says something.
const ENOUGH: usize = 5;

/// A parameter of the traces together.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Population {
    /// Name.
    pub name: String,
    /// Traces that tell it.
    pub traces: u64,
    /// Mean of the traces (geometric where the scale is logarithmic).
    pub mean: f64,
    /// 95 % interval of the mean.
    pub mean_interval: [f64; 2],
    /// Standard deviation between the traces beyond their own errors: of the value, or of its logarithm. `None` with one trace.
    pub spread: Option<f64>,
    /// Interval that holds the next unit with 95 %. `None` with fewer than three traces.
    pub next: Option<[f64; 2]>,
}

/// A parameter of a trace that is far from the others'.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Outlier {
    /// Name of the trace's file.
    pub trace: String,
    /// Name of the parameter.
    pub parameter: String,
    /// Its value there.
    pub value: f64,
    /// Median of all traces.
    pub median: f64,
    /// Distance from the median in standard deviations: of the population and of the trace's own error together.
    pub deviations: f64,
}

struct Told {
    place: f64,
    variance: f64,
    model_error: f64,
}

/// Names in the order of their first appearance, with their scale.
fn names<'a>(all: &[&'a Answered]) -> Vec<(&'a str, bool)> {
    let mut names: Vec<(&str, bool)> = Vec::new();
    for answered in all {
        for (name, logarithmic) in answered.names.iter().zip(&answered.logarithmic) {
            if !names.iter().any(|(known, _)| known == name) {
                names.push((name, *logarithmic));
            }
        }
    }
    names
}

fn outer(logarithmic: bool, place: f64) -> f64 {
    if logarithmic { place.exp() } else { place }
}

/// Mean and spread of every parameter that a trace tells.
pub fn populations(all: &[&Answered]) -> Vec<Population> {
    let names = names(all).into_iter();
    names
        .map(|(name, logarithmic)| {
            let told = all.iter().filter_map(|answered| {
                let k = answered.names.iter().position(|own| own == name)?;
                Some(Told {
                    place: answered.inner(k),
                    variance: answered.variance(k),
                    model_error: answered.model_errors[k],
                })
            });
            population(name, logarithmic, &told.collect::<Vec<_>>())
        })
        .collect()
}

/// Sum of the weights at a spread's square, and the means with them: of the places, and of the model's errors.
fn weighted(told: &[Told], spread: f64) -> [f64; 3] {
    let mut sums = [0.0; 3];
    for one in told {
        let weight = 1.0 / (one.variance + spread);
        sums[0] += weight;
        sums[1] += weight * one.place;
        sums[2] += weight * one.model_error;
    }
    [sums[0], sums[1] / sums[0], sums[2] / sums[0]]
}

/// Square of the spread. `sum w (q - mean)^2` falls as it grows; without their own errors the traces spread at most by their squares.
fn spread(told: &[Told]) -> f64 {
    let freedom = told.len() as f64 - 1.0;
    let excess = |spread: f64| {
        let [_, mean, _] = weighted(told, spread);
        let squares = told
            .iter()
            .map(|one| (one.place - mean).powi(2) / (one.variance + spread));
        squares.sum::<f64>() - freedom
    };
    let [_, mean, _] = weighted(told, 0.0);
    let most: f64 = told.iter().map(|one| (one.place - mean).powi(2)).sum();
    if !(excess(0.0) > 0.0 && most > 0.0) {
        return 0.0;
    }
    let mut end = SimpleConvergency {
        eps: 1e-15,
        max_iter: 200,
    };
    // As a part of the most, so that one tolerance fits every unit.
    most * find_root_brent(0.0, 1.0, |part: f64| excess(most * part), &mut end).unwrap_or(0.0)
}

fn population(name: &str, logarithmic: bool, told: &[Told]) -> Population {
    let traces = told.len();
    let freedom = traces as f64 - 1.0;
    let spread = if traces > 1 { spread(told) } else { 0.0 };
    let [weight, mean, model_error] = weighted(told, spread);
    let shared = HALF_INTERVAL * model_error;
    let around = |half: f64| {
        let half = half.hypot(shared);
        [-half, half].map(|away| outer(logarithmic, mean + away))
    };
    // One trace alone has its own error only.
    let wide = if traces > 1 {
        quantile(freedom, 1)
    } else {
        HALF_INTERVAL
    };
    Population {
        name: name.into(),
        traces: traces as u64,
        mean: outer(logarithmic, mean),
        mean_interval: around(wide / weight.sqrt()),
        spread: (traces > 1).then(|| spread.sqrt()),
        next: (traces > 2)
            .then(|| around(quantile(freedom - 1.0, 1) * (spread + 1.0 / weight).sqrt())),
    }
}

/// Traces far from the median of a parameter: name of the trace, value, standard error. The median and the median distance hardly move
/// with what stands out, as mean and spread do.
pub fn outliers(parameter: &str, told: &[(&str, f64, f64)]) -> Vec<Outlier> {
    if told.len() < ENOUGH {
        return Vec::new();
    }
    let median = middle(told.iter().map(|one| one.1).collect());
    let spread = middle(told.iter().map(|one| (one.1 - median).abs()).collect()) / MEDIAN_DISTANCE;
    let outlier = |(trace, value, error): &(&str, f64, f64)| Outlier {
        trace: (*trace).into(),
        parameter: parameter.into(),
        value: *value,
        median,
        deviations: (value - median) / spread.hypot(*error).max(f64::MIN_POSITIVE),
    };
    let all = told.iter().map(outlier);
    all.filter(|one| one.deviations.abs() > OUT).collect()
}

/// Median; the mean of both middle ones where there are two.
fn middle(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    let (low, high) = ((values.len() - 1) / 2, values.len() / 2);
    0.5 * (values[low] + values[high])
}
