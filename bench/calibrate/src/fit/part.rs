//! A part of a problem's rows.

use std::ops::Range;

use crate::fit::problem::{Evaluation, LinearParameter, Parameter, Separable};

/// The rows of a problem that are within a range.
pub struct Part<'a> {
    whole: &'a dyn Separable,
    rows: Range<usize>,
}

impl<'a> Part<'a> {
    /// The rows before this share of all, 0 to 1.
    pub fn before(whole: &'a dyn Separable, share: f64) -> Self {
        let rows = 0..border(whole, share);
        Self { whole, rows }
    }

    /// The rows from this share of all on.
    pub fn after(whole: &'a dyn Separable, share: f64) -> Self {
        let rows = border(whole, share)..whole.target().len();
        Self { whole, rows }
    }
}

fn border(whole: &dyn Separable, share: f64) -> usize {
    (whole.target().len() as f64 * share.clamp(0.0, 1.0)) as usize
}

impl Separable for Part<'_> {
    fn nonlinear(&self) -> &[Parameter] {
        self.whole.nonlinear()
    }

    fn linear(&self) -> &[LinearParameter] {
        self.whole.linear()
    }

    fn target(&self) -> &[f64] {
        &self.whole.target()[self.rows.clone()]
    }

    fn row_step(&self) -> f64 {
        self.whole.row_step()
    }

    fn evaluate(&self, nonlinear: &[f64]) -> Evaluation {
        let Evaluation { fixed, columns } = self.whole.evaluate(nonlinear);
        let cut = |rows: &Vec<f64>| rows[self.rows.clone()].to_vec();
        Evaluation {
            fixed: cut(&fixed),
            columns: columns.iter().map(cut).collect(),
        }
    }
}

/// Target less model at every row.
pub fn residual(problem: &dyn Separable, nonlinear: &[f64], linear: &[f64]) -> Vec<f64> {
    let Evaluation { fixed, columns } = problem.evaluate(nonlinear);
    let mut residual: Vec<f64> = problem
        .target()
        .iter()
        .zip(&fixed)
        .map(|(target, fixed)| target - fixed)
        .collect();
    for (column, value) in columns.iter().zip(linear) {
        for (residual, entry) in residual.iter_mut().zip(column) {
            *residual -= value * entry;
        }
    }
    residual
}
