//! Which rows of a trace are fitted and which score the models: blocks by turns, so that every manoeuvre is in both.

use crate::fit::problem::{Evaluation, LinearParameter, Parameter, Separable};

/// Blocks of a trace. Every third one is not fitted.
const BLOCKS: usize = 12;

/// The rows of a problem that are fitted, or the others.
pub struct Blocks<'a> {
    whole: &'a dyn Separable,
    fitted: bool,
    target: Vec<f64>,
}

impl<'a> Blocks<'a> {
    /// Two thirds of the rows, in blocks.
    pub fn fitted(whole: &'a dyn Separable) -> Self {
        Self::new(whole, true)
    }

    /// The other third.
    pub fn unseen(whole: &'a dyn Separable) -> Self {
        Self::new(whole, false)
    }

    fn new(whole: &'a dyn Separable, fitted: bool) -> Self {
        Self {
            whole,
            fitted,
            target: cut(whole.target(), fitted),
        }
    }
}

fn cut(rows: &[f64], fitted: bool) -> Vec<f64> {
    let block = |row: usize| row * BLOCKS / rows.len().max(1);
    let rows = rows.iter().enumerate();
    rows.filter(|(row, _)| (block(*row) % 3 != 2) == fitted)
        .map(|(_, value)| *value)
        .collect()
}

impl Separable for Blocks<'_> {
    fn nonlinear(&self) -> &[Parameter] {
        self.whole.nonlinear()
    }

    fn linear(&self) -> &[LinearParameter] {
        self.whole.linear()
    }

    fn target(&self) -> &[f64] {
        &self.target
    }

    fn row_step(&self) -> f64 {
        self.whole.row_step()
    }

    fn evaluate(&self, nonlinear: &[f64]) -> Evaluation {
        let Evaluation { fixed, columns } = self.whole.evaluate(nonlinear);
        Evaluation {
            fixed: cut(&fixed, self.fitted),
            columns: columns.iter().map(|rows| cut(rows, self.fitted)).collect(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::cut;

    #[test]
    fn a_third_is_left_out_in_four_blocks() {
        let rows: Vec<f64> = (0..36).map(f64::from).collect();
        let unseen = cut(&rows, false);
        let blocks = [6, 7, 8, 15, 16, 17, 24, 25, 26, 33, 34, 35].map(f64::from);
        assert_eq!(unseen, blocks);
        assert_eq!(cut(&rows, true).len(), 24);
        assert!(cut(&[], true).is_empty());
    }
}
