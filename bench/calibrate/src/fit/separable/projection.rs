//! Linear parameters by least squares within their bounds, and what of a vector the columns cannot reach.
//!
//! The columns are orthogonalised once (Householder); bounds are kept by an active set on the small triangle that is left (Stark and
//! Parker 1995), which no package offers apart from general quadratic programs with an interior point.

use nalgebra::{DMatrix, DVector};

use crate::fit::problem::LinearParameter;

/// Singular values of the unit columns below this part of the largest are noise of rounding: the shortest solution is taken there.
const RANK: f64 = 1e-10;

/// Linear parameters at their best, and what is left.
#[derive(Clone, Debug)]
pub(super) struct Projection {
    /// Best values.
    pub(super) values: Vec<f64>,
    /// Target less columns times values.
    pub(super) residual: DVector<f64>,
    /// Orthonormal base of the columns whose parameters are not at a bound.
    base: DMatrix<f64>,
}

impl Projection {
    /// Solves `columns p = target` in the least squares' sense within the parameters' bounds.
    pub(super) fn new(
        columns: &DMatrix<f64>,
        target: &DVector<f64>,
        parameters: &[LinearParameter],
    ) -> Self {
        let count = columns.ncols();
        if count == 0 {
            return Self {
                values: vec![],
                residual: target.clone(),
                base: DMatrix::zeros(target.len(), 0),
            };
        }
        let norms: Vec<f64> = columns.column_iter().map(|column| column.norm()).collect();
        let norms: Vec<f64> = norms
            .into_iter()
            .map(|norm| if norm > 0.0 { norm } else { 1.0 })
            .collect();
        let mut unit = columns.clone();
        for (mut column, norm) in unit.column_iter_mut().zip(&norms) {
            column /= *norm;
        }
        let factors = unit.qr();
        let (orthogonal, triangle) = (factors.q(), factors.r());
        let wanted = orthogonal.tr_mul(target);
        let small = Small {
            triangle: &triangle,
            wanted: &wanted,
            low: parameters
                .iter()
                .zip(&norms)
                .map(|(parameter, norm)| parameter.low * norm)
                .collect(),
            high: parameters
                .iter()
                .zip(&norms)
                .map(|(parameter, norm)| parameter.high * norm)
                .collect(),
        };
        let (scaled, free) = small.solve();
        let values: Vec<f64> = scaled
            .iter()
            .zip(&norms)
            .map(|(value, norm)| value / norm)
            .collect();
        let residual = target - columns * DVector::from_column_slice(&values);
        Self {
            values,
            residual,
            base: orthogonal * range(&small.chosen(&free)),
        }
    }

    /// The part of the matrix' columns that the free columns cannot reach.
    pub(super) fn reject(&self, matrix: &mut DMatrix<f64>) {
        if self.base.ncols() > 0 {
            let reached = self.base.tr_mul(matrix);
            matrix.gemm(-1.0, &self.base, &reached, 1.0);
        }
    }
}

/// Orthonormal base of what a matrix reaches.
fn range(matrix: &DMatrix<f64>) -> DMatrix<f64> {
    if matrix.ncols() == 0 {
        return DMatrix::zeros(matrix.nrows(), 0);
    }
    let parts = matrix.clone().svd(true, false);
    let limit = RANK * parts.singular_values.max();
    let kept: Vec<usize> = (0..parts.singular_values.len())
        .filter(|k| parts.singular_values[*k] > limit)
        .collect();
    parts.u.map_or_else(
        || DMatrix::zeros(matrix.nrows(), 0),
        |u| u.select_columns(&kept),
    )
}

/// Least squares on a small square matrix with bounds.
struct Small<'a> {
    triangle: &'a DMatrix<f64>,
    wanted: &'a DVector<f64>,
    low: Vec<f64>,
    high: Vec<f64>,
}

impl Small<'_> {
    fn chosen(&self, free: &[bool]) -> DMatrix<f64> {
        let chosen: Vec<usize> = (0..free.len()).filter(|k| free[*k]).collect();
        self.triangle.select_columns(&chosen)
    }

    /// The free parameters at their best, the others as they are.
    fn best(&self, values: &DVector<f64>, free: &[bool]) -> DVector<f64> {
        let mut held = values.clone();
        for (value, free) in held.iter_mut().zip(free) {
            if *free {
                *value = 0.0;
            }
        }
        let chosen = self.chosen(free);
        let mut best = values.clone();
        if chosen.ncols() == 0 {
            return best;
        }
        let parts = chosen.svd(true, true);
        let limit = RANK * parts.singular_values.max();
        if let Ok(solution) = parts.solve(
            &(self.wanted - self.triangle * held),
            limit.max(f64::MIN_POSITIVE),
        ) {
            for (k, value) in (0..free.len()).filter(|k| free[*k]).zip(solution.iter()) {
                best[k] = *value;
            }
        }
        best
    }

    /// The longest part of the way from `values` to `best` that stays within the bounds, and the parameter that ends it.
    fn way(&self, values: &DVector<f64>, best: &DVector<f64>) -> (f64, Option<usize>) {
        let mut way = (1.0, None);
        for k in 0..values.len() {
            let bound = best[k].clamp(self.low[k], self.high[k]);
            if bound != best[k] {
                let part = (bound - values[k]) / (best[k] - values[k]);
                if part < way.0 || way.1.is_none() {
                    way = (part.clamp(0.0, 1.0), Some(k));
                }
            }
        }
        way
    }

    /// The parameter at a bound that the cost would most like to leave it.
    fn released(&self, values: &DVector<f64>, free: &[bool]) -> Option<usize> {
        let pull = self
            .triangle
            .tr_mul(&(self.wanted - self.triangle * values));
        let size = RANK * self.wanted.norm();
        let wish = |k: usize| {
            if values[k] <= self.low[k] {
                pull[k]
            } else {
                -pull[k]
            }
        };
        (0..free.len())
            .filter(|k| !free[*k] && wish(*k) > size)
            .max_by(|a, b| wish(*a).total_cmp(&wish(*b)))
    }

    /// Best values within the bounds, and which are not at one.
    fn solve(&self) -> (DVector<f64>, Vec<bool>) {
        let count = self.low.len();
        let mut free = vec![true; count];
        let mut values = self.best(&DVector::zeros(count), &free);
        for k in 0..count {
            let inside = values[k].clamp(self.low[k], self.high[k]);
            free[k] = inside == values[k];
            values[k] = inside;
        }
        // Each pass lowers the cost or binds one parameter; the limit only guards against cycles of rounding.
        for _ in 0..10 * count + 10 {
            let best = self.best(&values, &free);
            let (part, stop) = self.way(&values, &best);
            values += (best - &values) * part;
            if let Some(k) = stop {
                values[k] = values[k].clamp(self.low[k], self.high[k]);
                let middle_is_below = values[k] - self.low[k] < self.high[k] - values[k];
                values[k] = if middle_is_below {
                    self.low[k]
                } else {
                    self.high[k]
                };
                free[k] = false;
            } else if let Some(k) = self.released(&values, &free) {
                free[k] = true;
            } else {
                break;
            }
        }
        (values, free)
    }
}
