//! The model at a point, its slopes there, and the count of evaluations.

use std::cell::{Cell, RefCell};
use std::rc::Rc;

use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

use super::checks::is_finite;
use super::coordinates::Coordinates;
use super::projection::Projection;
use crate::fit::problem::{Evaluation, Separable};

/// A model that is not finite counts as one that misses every row by this many times the largest target, so that the step there is
/// taken back.
const MISSED: f64 = 1e3;

/// A problem with its coordinates and the number of its evaluations.
pub(super) struct Model<'a> {
    pub(super) problem: &'a dyn Separable,
    pub(super) coordinates: Coordinates,
    /// Step of the differences, relative.
    pub(super) step: f64,
    evaluations: Cell<usize>,
    latest: RefCell<Option<Rc<Slopes>>>,
}

/// The model's best linear parameters and residual at some nonlinear ones.
#[derive(Clone)]
pub(super) struct Point {
    /// Outer coordinates.
    pub(super) outer: Vec<f64>,
    /// Nonlinear parameters.
    pub(super) values: Vec<f64>,
    /// The model there.
    pub(super) evaluation: Rc<Evaluation>,
    /// Linear parameters and the weighted residual.
    pub(super) projection: Projection,
    /// Sum of the squares of the weighted residual.
    pub(super) cost: f64,
    /// Whether the model is finite.
    pub(super) finite: bool,
}

/// Slopes of the model over the inner coordinates.
pub(super) struct Slopes {
    values: Vec<f64>,
    both: bool,
    each: Vec<Evaluation>,
}

impl<'a> Model<'a> {
    pub(super) fn new(problem: &'a dyn Separable, step: f64) -> Self {
        let coordinates = Coordinates::new(problem.nonlinear());
        Self {
            problem,
            coordinates,
            step,
            evaluations: Cell::new(0),
            latest: RefCell::new(None),
        }
    }

    pub(super) fn evaluations(&self) -> usize {
        self.evaluations.get()
    }

    fn count(&self, evaluations: usize) {
        self.evaluations.set(self.evaluations.get() + evaluations);
    }

    /// The point at these nonlinear parameters, under the square roots of the weights.
    pub(super) fn point(&self, outer: Vec<f64>, values: Vec<f64>, roots: &[f64]) -> Point {
        self.count(1);
        let evaluation = self.problem.evaluate(&values);
        self.point_of(outer, values, Rc::new(evaluation), roots)
    }

    /// The same point under other weights.
    pub(super) fn reweighted(&self, point: &Point, roots: &[f64]) -> Point {
        self.point_of(
            point.outer.clone(),
            point.values.clone(),
            Rc::clone(&point.evaluation),
            roots,
        )
    }

    fn point_of(
        &self,
        outer: Vec<f64>,
        values: Vec<f64>,
        evaluation: Rc<Evaluation>,
        roots: &[f64],
    ) -> Point {
        let target = self.problem.target();
        let (rows, columns) = (target.len(), self.problem.linear().len());
        let shape = evaluation.fixed.len() == rows
            && evaluation.columns.len() == columns
            && evaluation.columns.iter().all(|column| column.len() == rows);
        let finite = shape && is_finite(&evaluation);
        let (matrix, wanted) = if finite {
            let wanted = target
                .iter()
                .zip(&evaluation.fixed)
                .zip(roots)
                .map(|((t, f), root)| (t - f) * root);
            let weighted = evaluation
                .columns
                .iter()
                .flat_map(|column| column.iter().zip(roots).map(|(x, root)| x * root));
            (
                DMatrix::from_iterator(rows, columns, weighted),
                DVector::from_iterator(rows, wanted),
            )
        } else {
            let largest = target
                .iter()
                .fold(f64::MIN_POSITIVE, |most, value| value.abs().max(most));
            (
                DMatrix::zeros(rows, columns),
                DVector::from_element(rows, MISSED * largest),
            )
        };
        let projection = Projection::new(&matrix, &wanted, self.problem.linear());
        let cost = projection.residual.norm_squared();
        Point {
            outer,
            values,
            evaluation,
            projection,
            cost,
            finite,
        }
    }

    /// Target less model at every row, without weights.
    pub(super) fn residual(&self, point: &Point) -> Vec<f64> {
        let mut residual: Vec<f64> = self
            .problem
            .target()
            .iter()
            .zip(&point.evaluation.fixed)
            .map(|(target, fixed)| target - fixed)
            .collect();
        for (column, value) in point
            .evaluation
            .columns
            .iter()
            .zip(&point.projection.values)
        {
            residual
                .iter_mut()
                .zip(column)
                .for_each(|(left, x)| *left -= value * x);
        }
        residual
    }

    /// Slopes at a point: from both sides, or from one where that is enough.
    pub(super) fn slopes(&self, point: &Point, both: bool) -> Rc<Slopes> {
        let known = self
            .latest
            .borrow()
            .as_ref()
            .filter(|old| old.values == point.values && (old.both || !both))
            .cloned();
        if let Some(known) = known {
            return known;
        }
        let (problem, coordinates, step, values) =
            (self.problem, &self.coordinates, self.step, &point.values);
        let here: &Evaluation = &point.evaluation;
        let sides: Vec<([f64; 2], f64)> = (0..values.len())
            .map(|k| coordinates.beside(values, k, step, both))
            .collect();
        let asked: Vec<(usize, f64)> = sides
            .iter()
            .enumerate()
            .flat_map(|(k, (pair, _))| pair.map(|value| (k, value)))
            .filter(|(k, value)| *value != values[*k])
            .collect();
        self.count(asked.len());
        let found: Vec<Evaluation> = asked
            .par_iter()
            .map(|(k, value)| {
                let mut moved = values.clone();
                moved[*k] = *value;
                problem.evaluate(&moved)
            })
            .collect();
        let mut found = found.iter();
        let each = sides
            .iter()
            .enumerate()
            .map(|(k, (pair, distance))| {
                let [below, above] = pair.map(|value| {
                    if value == values[k] {
                        here
                    } else {
                        found.next().unwrap_or(here)
                    }
                });
                slope(below, above, *distance)
            })
            .collect();
        let slopes = Rc::new(Slopes {
            values: point.values.clone(),
            both,
            each,
        });
        *self.latest.borrow_mut() = Some(Rc::clone(&slopes));
        slopes
    }
}

/// Difference over distance, column by column.
fn slope(below: &Evaluation, above: &Evaluation, distance: f64) -> Evaluation {
    let over = |(low, high): (&Vec<f64>, &Vec<f64>)| -> Vec<f64> {
        let quotient = |(a, b): (&f64, &f64)| {
            let quotient = (b - a) / distance;
            // A neighbour outside the model's domain says nothing.
            if quotient.is_finite() { quotient } else { 0.0 }
        };
        low.iter().zip(high).map(quotient).collect()
    };
    Evaluation {
        fixed: over((&below.fixed, &above.fixed)),
        columns: below.columns.iter().zip(&above.columns).map(over).collect(),
    }
}

impl Slopes {
    /// Slope of the whole model over each inner coordinate at these linear parameters, each row times its weight's root.
    pub(super) fn of_model(&self, linear: &[f64], roots: &[f64]) -> DMatrix<f64> {
        let mut matrix = DMatrix::zeros(roots.len(), self.each.len());
        for (mut into, slope) in matrix.column_iter_mut().zip(&self.each) {
            for (into, value) in into.iter_mut().zip(&slope.fixed) {
                *into = *value;
            }
            for (column, value) in slope.columns.iter().zip(linear) {
                for (into, x) in into.iter_mut().zip(column) {
                    *into += value * x;
                }
            }
            for (into, root) in into.iter_mut().zip(roots) {
                *into *= root;
            }
        }
        matrix
    }
}
