//! Outliers get less weight: soft-L1 loss by repeated weighting (Holland and Welsch 1977).

use super::descent::{Effort, descend};
use super::model::{Model, Point};

/// Median of absolute values to the standard deviation of a normal distribution.
const MEDIAN_TO_DEVIATION: f64 = 1.4826;

/// Most passes.
const PASSES: usize = 8;

/// Weights that change by less than this stand.
const STANDS: f64 = 5e-4;

/// Scale of a residual that outliers do not move: 1.4826 x the median of its absolute values.
pub(super) fn scale(residual: &[f64]) -> f64 {
    let mut sizes: Vec<f64> = residual.iter().map(|value| value.abs()).collect();
    let middle = sizes.len() / 2;
    if sizes.is_empty() {
        0.0
    } else {
        MEDIAN_TO_DEVIATION * *sizes.select_nth_unstable_by(middle, f64::total_cmp).1
    }
}

/// Roots of the weights: weight 1 / sqrt(1 + (r / bend)^2), the soft-L1 loss' slope over that of the square.
fn roots(residual: &[f64], bend: f64) -> Vec<f64> {
    if !(bend > 0.0) {
        return vec![1.0; residual.len()];
    }
    residual
        .iter()
        .map(|value| (1.0 + (value / bend).powi(2)).powf(-0.25))
        .collect()
}

/// Repeats the fit under the weights of its residual until they stand. Gives the point and the weights' roots.
pub(super) fn settle(
    model: &Model,
    start: Point,
    scales: f64,
    effort: Effort,
) -> (Point, Vec<f64>) {
    let residual = model.residual(&start);
    let mut weights = roots(&residual, scales * scale(&residual));
    let mut point = start;
    for _ in 0..PASSES {
        point = descend(
            model,
            model.reweighted(&point, &weights),
            &weights,
            effort,
            None,
        )
        .0;
        let residual = model.residual(&point);
        let next = roots(&residual, scales * scale(&residual));
        let moved = next
            .iter()
            .zip(&weights)
            .fold(0.0f64, |most, (a, b)| most.max((a - b).abs()));
        if moved < STANDS {
            break;
        }
        weights = next;
    }
    let point = model.reweighted(&point, &weights);
    (point, weights)
}
