//! Levenberg-Marquardt on the residual that the linear parameters leave.
//!
//! The slope of that residual is Kaufman's: the part of the model's own slope that the columns cannot reach. What it leaves out of the
//! full one (Golub and Pereyra) lies within the columns' reach and does not change the gradient, so the minimum is the same; it takes
//! no evaluations beyond those of the model's slope.

use std::cell::{Cell, RefCell};

use levenberg_marquardt::{LeastSquaresProblem, LevenbergMarquardt};
use nalgebra::storage::Owned;
use nalgebra::{DMatrix, DVector, Dyn};

use super::model::{Model, Point};

/// First step relative to the outer coordinates, which are 0.4 to 3.6: about a tenth to one of a bounded range.
const FIRST_STEP: f64 = 0.3;

/// How a descent ends, and how its slopes are found.
#[derive(Clone, Copy, Debug)]
pub(super) struct Effort {
    /// Relative change of cost that ends it.
    pub(super) tolerance: f64,
    /// Most slopes.
    pub(super) slopes: usize,
    /// Most points.
    pub(super) points: usize,
    /// Slopes from both sides.
    pub(super) both: bool,
}

/// The neighbourhood of a known minimum, in inner coordinates.
#[derive(Clone)]
pub(super) struct Neighbourhood {
    /// Its place.
    pub(super) inner: Vec<f64>,
    /// Its cost.
    pub(super) cost: f64,
    /// Information about the nonlinear parameters, in units in which 1 is one standard deviation.
    pub(super) information: DMatrix<f64>,
    /// Rows that count as independent.
    pub(super) effective_rows: f64,
}

impl Neighbourhood {
    /// Squared distance in standard deviations.
    pub(super) fn distance(&self, inner: &[f64]) -> f64 {
        let away = DVector::from_iterator(
            inner.len(),
            inner.iter().zip(&self.inner).map(|(a, b)| a - b),
        );
        (&self.information * &away).dot(&away)
    }

    /// Twice the difference in log-likelihood; positive where the other cost is larger.
    pub(super) fn difference(&self, cost: f64) -> f64 {
        self.effective_rows * (cost / self.cost).ln()
    }
}

struct Descent<'a> {
    model: &'a Model<'a>,
    roots: &'a [f64],
    effort: Effort,
    known: Option<&'a Neighbourhood>,
    point: Point,
    best: Point,
    points: usize,
    slopes: Cell<usize>,
    /// Whether the known minimum was reached.
    reached: RefCell<bool>,
}

impl LeastSquaresProblem<f64, Dyn, Dyn> for Descent<'_> {
    type ResidualStorage = Owned<f64, Dyn>;
    type JacobianStorage = Owned<f64, Dyn, Dyn>;
    type ParameterStorage = Owned<f64, Dyn>;

    fn set_params(&mut self, outer: &DVector<f64>) {
        if outer.as_slice() == self.best.outer {
            self.point = self.best.clone();
            return;
        }
        if self.points >= self.effort.points {
            return;
        }
        self.points += 1;
        let outer = outer.as_slice().to_vec();
        let values = self.model.coordinates.values(&outer);
        self.point = self.model.point(outer, values, self.roots);
        if self.point.cost < self.best.cost {
            self.best = self.point.clone();
        }
    }

    fn params(&self) -> DVector<f64> {
        DVector::from_column_slice(&self.point.outer)
    }

    fn residuals(&self) -> Option<DVector<f64>> {
        (self.points < self.effort.points).then(|| self.point.projection.residual.clone())
    }

    fn jacobian(&self) -> Option<DMatrix<f64>> {
        let close = self.known.is_some_and(|known| {
            known.difference(self.point.cost) < 1.0
                && known.distance(&self.model.coordinates.inner(&self.point.values)) < 1.0
        });
        if close {
            *self.reached.borrow_mut() = true;
        }
        if close || self.slopes.get() >= self.effort.slopes || !self.point.finite {
            return None;
        }
        self.slopes.set(self.slopes.get() + 1);
        let mut jacobian = projected(self.model, &self.point, self.roots, self.effort.both);
        let slopes = self.model.coordinates.slopes(&self.point.outer);
        for (mut column, slope) in jacobian.column_iter_mut().zip(slopes) {
            column *= -slope;
        }
        Some(jacobian)
    }
}

/// The part of the model's slope over the inner coordinates that the columns cannot reach.
pub(super) fn projected(model: &Model, point: &Point, roots: &[f64], both: bool) -> DMatrix<f64> {
    let mut slope = model
        .slopes(point, both)
        .of_model(&point.projection.values, roots);
    point.projection.reject(&mut slope);
    slope
}

/// Goes down from a point; the answer is the best point met, and whether that is the known minimum.
pub(super) fn descend(
    model: &Model,
    start: Point,
    roots: &[f64],
    effort: Effort,
    known: Option<&Neighbourhood>,
) -> (Point, bool) {
    if start.values.is_empty() {
        return (start, known.is_some());
    }
    let descent = Descent {
        model,
        roots,
        effort,
        known,
        best: start.clone(),
        point: start,
        points: 0,
        slopes: Cell::new(0),
        reached: RefCell::new(false),
    };
    let method = LevenbergMarquardt::new()
        .with_ftol(effort.tolerance)
        .with_xtol(1e-2 * effort.tolerance.sqrt())
        .with_gtol(1e-2 * effort.tolerance.sqrt())
        .with_stepbound(FIRST_STEP);
    let (descent, _) = method.minimize(descent);
    let reached = *descent.reached.borrow();
    (descent.best, reached)
}
