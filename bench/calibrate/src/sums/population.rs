//! Mean and spread of a parameter between traces, each with an error of its own.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use statrs::distribution::{ContinuousCDF, StudentsT};

use super::reference::Reference;
use super::sum::Sum;
use crate::fit::problem::{inner, outer};

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

/// Traces whose variance lies in one half octave.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Class {
    pub traces: u64,
    pub variance: Sum,
    /// Standard deviations by the model's own errors.
    pub model_error: Sum,
    pub deviation: Sum,
    pub squares: Sum,
}

/// Means over traces, each with the weight `w` of its variance.
struct Weighted {
    mean: f64,
    /// Sum of the weights.
    weight: f64,
    /// Mean of the standard deviations by the model's own errors, which are the same in all traces.
    model_error: f64,
    /// `sum w (q - mean)^2`.
    square: f64,
}

/// Means at a spread's square.
fn weighted(classes: &BTreeMap<i32, Class>, spread: f64) -> Weighted {
    let each = || {
        classes.values().map(|class| {
            let traces = class.traces as f64;
            (
                1.0 / (class.variance.total() / traces + spread),
                traces,
                class,
            )
        })
    };
    let weight: f64 = each().map(|(weight, traces, _)| weight * traces).sum();
    let mean_of = |sum: fn(&Class) -> Sum| -> f64 {
        let terms = each().map(|(weight, _, class)| weight * sum(class).total());
        terms.sum::<f64>() / weight
    };
    let mean = mean_of(|class| class.deviation);
    let square = |(weight, traces, class): (f64, f64, &Class)| {
        weight * (class.squares.total() - mean * (2.0 * class.deviation.total() - traces * mean))
    };
    Weighted {
        mean,
        weight,
        model_error: mean_of(|class| class.model_error),
        square: each().map(square).sum(),
    }
}

/// A parameter's population from its classes, by half octaves of the traces' variance.
pub(super) fn population(reference: &Reference, classes: &BTreeMap<i32, Class>) -> Population {
    let traces: u64 = classes.values().map(|class| class.traces).sum();
    let freedom = traces as f64 - 1.0;
    let mut spread = 0.0;
    if traces > 1 && weighted(classes, 0.0).square > freedom {
        // `sum w (q - mean)^2` falls as the spread grows; without their own errors the traces spread at most by their squares.
        let (mut low, mut high) = (
            0.0,
            classes
                .values()
                .map(|class| class.squares.total())
                .sum::<f64>(),
        );
        for _ in 0..100 {
            spread = 0.5 * (low + high);
            *(if weighted(classes, spread).square > freedom {
                &mut low
            } else {
                &mut high
            }) = spread;
        }
    }
    let Weighted {
        mean,
        weight,
        model_error,
        ..
    } = weighted(classes, spread);
    let scale = reference.scale();
    let at = |away: f64| outer(scale, inner(scale, reference.value) + mean + away);
    let student = |freedom: f64| {
        StudentsT::new(0.0, 1.0, freedom).map_or(f64::INFINITY, |law| law.inverse_cdf(0.975))
    };
    // One trace alone has its own error only.
    let quantile = if traces > 1 { student(freedom) } else { 1.96 };
    let shared = 1.96 * model_error;
    let half = (quantile / weight.sqrt()).hypot(shared);
    let ahead = (traces > 2)
        .then(|| (student(freedom - 1.0) * (spread + 1.0 / weight).sqrt()).hypot(shared));
    Population {
        name: reference.name.clone(),
        traces,
        mean: at(0.0),
        mean_interval: [at(-half), at(half)],
        spread: (traces > 1).then(|| spread.sqrt()),
        next: ahead.map(|half| [at(-half), at(half)]),
    }
}
