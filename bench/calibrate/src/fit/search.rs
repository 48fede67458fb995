//! Fit of a separable problem: the linear parameters are eliminated by least squares within their bounds (variable projection), the few
//! others are found by Levenberg-Marquardt (MINPACK's, crate `levenberg-marquardt`) in coordinates that keep their bounds.
//!
//! A parameter `q` has an inner coordinate `y` (its logarithm, or itself), in which its information is nearly constant, and an outer one `u`,
//! `y = low + (high - low) (1 + sin(u - 2))/2` (as in MINUIT), in which every step stays within the bounds; the shift of 2 keeps `u` away from
//! zero, since Levenberg-Marquardt measures its steps relative to the coordinates. Slopes are central differences of what the linear
//! parameters leave.

use levenberg_marquardt::{LeastSquaresProblem, LevenbergMarquardt};
use nalgebra::storage::Owned;
use nalgebra::{DMatrix, DVector, Dyn};
use rayon::prelude::*;

use super::problem::{Evaluation, Parameter, Scale, Separable, inner, outer};
use crate::estimator::fit::{dot, normal, rms};
use epas_page::failure::Failure;

const SHIFT: f64 = 2.0;

/// A start on a bound has no slope in the outer coordinate: it is moved in by this part of the range.
const INSIDE: f64 = 0.01;

/// Within this part of the range a parameter counts as at its bound.
const AT_BOUND: f64 = 1e-3;

/// Step of the differences in the inner coordinate, over the size of a value that is not logarithmic: models with a memory round to f32.
const STEP: f64 = 1e-2;

/// The same of the one-sided differences on the way down.
const ASIDE: f64 = 1e-3;

/// Relative change of the cost that ends a descent, or a rough one; its first step, and the most evaluations of a parameter.
const TOLERANCE: f64 = 1e-6;
const ROUGH: f64 = 1e-3;
const FIRST_STEP: f64 = 0.3;
const PATIENCE: usize = 20;

/// Least singular value of the linear columns, over the largest, that counts.
const RANK: f64 = 1e-10;

#[derive(Clone, Debug, PartialEq)]
pub struct Found {
    pub nonlinear: Vec<f64>,
    pub linear: Vec<f64>,
    pub residual: Vec<f64>,
}

impl Found {
    pub fn cost(&self) -> f64 {
        self.residual.iter().map(|left| left * left).sum()
    }

    pub fn residual_rms(&self) -> f64 {
        rms(&self.residual)
    }
}

pub fn fit(problem: &dyn Separable) -> Result<Found, Failure> {
    descend(problem, TOLERANCE)
}

/// The same until another step changes little: enough to see which valley a start lies in.
pub fn fit_roughly(problem: &dyn Separable) -> Result<Found, Failure> {
    descend(problem, ROUGH)
}

fn descend(problem: &dyn Separable, tolerance: f64) -> Result<Found, Failure> {
    check(problem)?;
    let start: Vec<f64> = problem.nonlinear().iter().map(Axis::start).collect();
    let mut best = Point::at(problem, &start);
    if !best.cost.is_finite() {
        return Err(Failure::Data(
            "the model is not finite at its first guess".into(),
        ));
    }
    if !start.is_empty() {
        let descent = Descent {
            problem,
            best: best.clone(),
            point: best,
        };
        let method = LevenbergMarquardt::new()
            .with_ftol(tolerance)
            .with_xtol(1e-2 * tolerance.sqrt())
            .with_gtol(1e-2 * tolerance.sqrt())
            .with_stepbound(FIRST_STEP)
            .with_patience(PATIENCE);
        best = method.minimize(descent).0.best;
    }
    Ok(Found {
        nonlinear: values(problem, best.outer.as_slice()),
        linear: best.linear,
        residual: best.residual.as_slice().to_vec(),
    })
}

pub fn at_bound(parameter: &Parameter, value: f64) -> bool {
    if parameter.high == f64::INFINITY {
        return value <= parameter.low;
    }
    let part = Axis::of(parameter).part(value);
    !(AT_BOUND..=1.0 - AT_BOUND).contains(&part)
}

/// The model's slopes at a fit, by the inner coordinates of the nonlinear parameters, and then by the linear ones.
pub fn slopes(problem: &dyn Separable, nonlinear: &[f64], linear: &[f64]) -> Vec<Vec<f64>> {
    let model = |values: &[f64]| problem.evaluate(values).sum(linear);
    let slope = |k: usize| -> Vec<f64> {
        let ([below, above], step) = Axis::of(&problem.nonlinear()[k]).beside(nonlinear[k]);
        let [below, above] = [below, above].map(|value| {
            let mut values = nonlinear.to_vec();
            values[k] = value;
            model(&values)
        });
        let rows = above.iter().zip(&below);
        rows.map(|(above, below)| (above - below) / step).collect()
    };
    let mut all: Vec<Vec<f64>> = (0..nonlinear.len()).into_par_iter().map(slope).collect();
    all.extend(problem.evaluate(nonlinear).columns);
    all
}

fn check(problem: &dyn Separable) -> Result<(), Failure> {
    let (rows, count) = (
        problem.target().len(),
        problem.nonlinear().len() + problem.linear().len(),
    );
    if rows <= count {
        return Err(Failure::Data(format!(
            "{rows} rows are too few for {count} parameters"
        )));
    }
    let wrong = |parameter: &&Parameter| {
        let Parameter {
            start, low, high, ..
        } = **parameter;
        let positive = parameter.scale == Scale::Linear || low > 0.0;
        !(low < high && low <= start && start <= high && positive && (high - low).is_finite())
    };
    match problem.nonlinear().iter().find(wrong) {
        Some(parameter) => Err(Failure::Data(format!(
            "{} = {}: it must be {} to {}",
            parameter.name, parameter.start, parameter.low, parameter.high
        ))),
        None => Ok(()),
    }
}

struct Axis<'a> {
    parameter: &'a Parameter,
    low: f64,
    range: f64,
}

impl<'a> Axis<'a> {
    fn of(parameter: &'a Parameter) -> Self {
        let low = inner(parameter.scale, parameter.low);
        let range = inner(parameter.scale, parameter.high) - low;
        Self {
            parameter,
            low,
            range,
        }
    }

    /// Where a value lies in its range, 0 to 1.
    fn part(&self, value: f64) -> f64 {
        (inner(self.parameter.scale, value) - self.low) / self.range
    }

    fn start(parameter: &Parameter) -> f64 {
        let part = Axis::of(parameter).part(parameter.start);
        SHIFT + (2.0 * part.clamp(INSIDE, 1.0 - INSIDE) - 1.0).asin()
    }

    fn value(&self, place: f64) -> f64 {
        outer(self.parameter.scale, place)
            .max(self.parameter.low)
            .min(self.parameter.high)
    }

    fn outside(&self, u: f64) -> f64 {
        self.value(self.low + self.range * 0.5 * (1.0 + (u - SHIFT).sin()))
    }

    /// Slope of the inner coordinate by the outer one.
    fn slope(&self, u: f64) -> f64 {
        0.5 * self.range * (u - SHIFT).cos()
    }

    /// A size of the inner coordinate, of which a step is a part.
    fn size(&self, place: f64) -> f64 {
        match self.parameter.scale {
            Scale::Logarithmic => 1.0,
            Scale::Linear => place.abs().max(STEP * self.range),
        }
    }

    /// A value beside another, towards the middle of the range, and its distance in the inner coordinate.
    fn aside(&self, value: f64) -> (f64, f64) {
        let place = inner(self.parameter.scale, value);
        let step = ASIDE * self.size(place);
        let step = if self.part(value) < 0.5 { step } else { -step };
        (self.value(place + step), step)
    }

    /// Values on both sides, within the bounds, and the distance of their inner coordinates.
    fn beside(&self, value: f64) -> ([f64; 2], f64) {
        let place = inner(self.parameter.scale, value);
        let size = self.size(place);
        let above = (place + STEP * size).min(self.low + self.range);
        let below = (place - STEP * size).max(self.low);
        ([self.value(below), self.value(above)], above - below)
    }
}

fn values(problem: &dyn Separable, outer: &[f64]) -> Vec<f64> {
    let axes = problem.nonlinear().iter().zip(outer);
    axes.map(|(parameter, u)| Axis::of(parameter).outside(*u))
        .collect()
}

/// The model at some outer coordinates, with the linear parameters at their best.
#[derive(Clone)]
struct Point {
    outer: DVector<f64>,
    linear: Vec<f64>,
    residual: DVector<f64>,
    cost: f64,
}

impl Point {
    fn at(problem: &dyn Separable, outer: &[f64]) -> Self {
        let (linear, residual) = projected(problem, &values(problem, outer));
        Self {
            outer: DVector::from_column_slice(outer),
            cost: residual.norm_squared(),
            linear,
            residual,
        }
    }
}

/// Best linear parameters, and what they leave of the target.
pub(crate) fn projected(problem: &dyn Separable, nonlinear: &[f64]) -> (Vec<f64>, DVector<f64>) {
    let Evaluation { fixed, columns } = problem.evaluate(nonlinear);
    let target = problem.target().iter().zip(&fixed);
    let mut left: DVector<f64> =
        DVector::from_iterator(fixed.len(), target.map(|(target, fixed)| target - fixed));
    let values = within_bounds(&columns, &left, problem.linear());
    for (column, value) in columns.iter().zip(&values) {
        for (left, entry) in left.iter_mut().zip(column) {
            *left -= value * entry;
        }
    }
    (values, left)
}

/// Least squares within bounds: what is beyond its bound is held there, the farthest first, and the others are solved again.
fn within_bounds(
    columns: &[Vec<f64>],
    target: &DVector<f64>,
    parameters: &[Parameter],
) -> Vec<f64> {
    let count = columns.len();
    let (sizes, normal) = normal(columns);
    let right = DVector::from_fn(count, |k, _| dot(&columns[k], target.as_slice()) / sizes[k]);
    let mut held: Vec<Option<f64>> = vec![None; count];
    loop {
        let free: Vec<usize> = (0..count).filter(|k| held[*k].is_none()).collect();
        let rest = |i: usize| -> f64 {
            let held = held.iter().enumerate();
            right[i]
                - held
                    .map(|(j, x)| x.map_or(0.0, |x| normal[(i, j)] * x))
                    .sum::<f64>()
        };
        let small = DMatrix::from_fn(free.len(), free.len(), |i, j| normal[(free[i], free[j])]);
        let wanted = DVector::from_fn(free.len(), |i, _| rest(free[i]));
        // Numbers that are none have no singular values: the search for them would not end.
        let sound = small.iter().all(|x| x.is_finite());
        let solved = if free.is_empty() || !sound {
            wanted
        } else {
            let parts = small.svd(true, true);
            let least = RANK * parts.singular_values.max();
            parts.solve(&wanted, least).unwrap_or(wanted)
        };
        let all = |k: usize| {
            let place = free.iter().position(|free| *free == k);
            place.map_or(held[k].unwrap_or(0.0), |place| solved[place])
        };
        let beyond = |k: usize| {
            let Parameter { low, high, .. } = parameters[k];
            let (x, low, high) = (all(k), low * sizes[k], high * sizes[k]);
            (low - x).max(x - high)
        };
        let worst = free
            .iter()
            .copied()
            .filter(|k| beyond(*k) > 0.0)
            .max_by(|one, other| beyond(*one).total_cmp(&beyond(*other)));
        let Some(k) = worst else {
            return (0..count).map(|k| all(k) / sizes[k]).collect();
        };
        let Parameter { low, high, .. } = parameters[k];
        held[k] = Some(all(k).max(low * sizes[k]).min(high * sizes[k]));
    }
}

struct Descent<'a> {
    problem: &'a dyn Separable,
    point: Point,
    best: Point,
}

impl LeastSquaresProblem<f64, Dyn, Dyn> for Descent<'_> {
    type ResidualStorage = Owned<f64, Dyn>;
    type JacobianStorage = Owned<f64, Dyn, Dyn>;
    type ParameterStorage = Owned<f64, Dyn>;

    fn set_params(&mut self, outer: &DVector<f64>) {
        self.point = if *outer == self.best.outer {
            self.best.clone()
        } else {
            Point::at(self.problem, outer.as_slice())
        };
        if self.point.cost < self.best.cost {
            self.best = self.point.clone();
        }
    }

    fn params(&self) -> DVector<f64> {
        self.point.outer.clone()
    }

    fn residuals(&self) -> Option<DVector<f64>> {
        Some(self.point.residual.clone())
    }

    fn jacobian(&self) -> Option<DMatrix<f64>> {
        let known = values(self.problem, self.point.outer.as_slice());
        let slope = |k: usize| {
            let axis = Axis::of(&self.problem.nonlinear()[k]);
            let (value, step) = axis.aside(known[k]);
            let mut values = known.clone();
            values[k] = value;
            let aside = projected(self.problem, &values).1;
            (aside - &self.point.residual) * (axis.slope(self.point.outer[k]) / step)
        };
        let columns: Vec<DVector<f64>> = (0..known.len()).into_par_iter().map(slope).collect();
        let jacobian = DMatrix::from_columns(&columns);
        jacobian.iter().all(|x| x.is_finite()).then_some(jacobian)
    }
}
