//! Fit of a separable problem: linear parameters are eliminated, the few others are found by Levenberg-Marquardt from several starts.
//!
//! | step | how |
//! |---|---|
//! | linear parameters | bounded least squares inside the residual (variable projection) |
//! | nonlinear ones | Levenberg-Marquardt (MINPACK's, crate `levenberg-marquardt`) in coordinates that keep the bounds |
//! | slopes | central differences of the model, projected by Kaufman's formula; evaluated in parallel |
//! | outliers | weights of a soft-L1 loss at 1.5 scales, scale = 1.4826 x the median of the residual's sizes, repeated until they stand |
//! | starts | the given one and an even set within the bounds; all run coarsely, the best are finished |
//!
//! Crate `varpro` is not taken: its model is a sum of columns only, where ours has a part with no linear parameter; it asks for the
//! derivative of each column; its linear parameters have no bounds. What it would do beside is the projection, a page here.

pub mod checks;
mod coordinates;
mod descent;
mod fixed;
mod model;
mod projection;
mod robust;
mod starts;
#[cfg(test)]
mod tests;

use nalgebra::DMatrix;

use self::checks::FitError;
use self::descent::{Effort, Neighbourhood, descend};
use self::model::{Model, Point};
use super::problem::Separable;

pub(in crate::calibrate) use self::coordinates::{inner, inner_slope, outer};
pub use self::fixed::Fixed;
pub use self::starts::{Outcome, Start, Verdict};

/// A coarse pass: enough to see which valley a start lies in.
const COARSE: Effort = Effort {
    tolerance: 1e-3,
    slopes: 4,
    points: 8,
    both: false,
};

/// A whole descent.
const FINE: Effort = Effort {
    tolerance: 1e-8,
    slopes: 30,
    points: 60,
    both: true,
};

/// A few steps after the weights have changed.
const REWEIGHTED: Effort = Effort {
    tolerance: 1e-7,
    slopes: 3,
    points: 6,
    both: true,
};

/// How a fit is made.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FitSettings {
    /// Whether outliers are given less weight.
    pub robust: bool,
    /// Residual, in scales, from which on its weight falls; above 0.
    pub robust_scales: f64,
    /// Starts, the given one among them; 1 or more.
    pub starts: usize,
    /// Starts that are finished, unless the best is found only once; 1 to `starts`.
    pub finished: usize,
    /// Step of the differences, relative; 1e-6 to 0.1.
    pub step: f64,
}

impl Default for FitSettings {
    fn default() -> Self {
        Self {
            robust: true,
            robust_scales: 1.5,
            starts: 6,
            finished: 2,
            step: 1e-3,
        }
    }
}

impl FitSettings {
    fn check(&self) -> Result<(), FitError> {
        let wrong = |name, value, allowed| {
            Err(FitError::Setting {
                name,
                value,
                allowed,
            })
        };
        if !(self.robust_scales > 0.0) {
            return wrong("robust_scales", self.robust_scales, "above 0");
        }
        if !(1e-6..=0.1).contains(&self.step) {
            return wrong("step", self.step, "1e-6 to 0.1");
        }
        if self.starts == 0 {
            return wrong("starts", 0.0, "1 or more");
        }
        if !(1..=self.starts).contains(&self.finished) {
            return wrong("finished", self.finished as f64, "1 to starts");
        }
        Ok(())
    }
}

/// A fit.
#[derive(Clone, Debug, PartialEq)]
pub struct Fit {
    /// Nonlinear parameters, in the problem's order.
    pub nonlinear: Vec<f64>,
    /// Linear parameters, in the problem's order.
    pub linear: Vec<f64>,
    /// Target less model at every row.
    pub residual: Vec<f64>,
    /// Weight of every row, 0 to 1.
    pub weights: Vec<f64>,
    /// Slope of the model over each parameter in its own unit, nonlinear before linear: rows x parameters.
    pub jacobian: DMatrix<f64>,
    /// Evaluations of the model.
    pub evaluations: usize,
    /// The starts and their ends, the given one first.
    pub starts: Vec<Start>,
    /// Whether the answer depends on the start.
    pub verdict: Verdict,
    /// Names of the parameters at a bound.
    pub at_bound: Vec<&'static str>,
}

impl Fit {
    /// Root of the mean square of the residual.
    pub fn residual_rms(&self) -> f64 {
        rms(&self.residual)
    }

    /// Why the answer cannot be trusted, where it cannot.
    pub fn refusal(&self) -> Option<String> {
        match &self.verdict {
            Verdict::DependsOnStart { names } => Some(format!(
                "the answer depends on the start: {} came out differently with the same residual",
                names.join(", ")
            )),
            _ => None,
        }
    }
}

fn rms(rows: &[f64]) -> f64 {
    (rows.iter().map(|x| x * x).sum::<f64>() / rows.len() as f64).sqrt()
}

/// Fits a problem.
///
/// # Errors
///
/// Wrong bounds, settings, shapes or numbers, and a model that is finite at no start.
pub fn fit(problem: &dyn Separable, settings: &FitSettings) -> Result<Fit, FitError> {
    settings.check()?;
    checks::check(problem)?;
    let model = Model::new(problem, settings.step);
    let roots = vec![1.0; problem.target().len()];
    let Found {
        best,
        starts,
        verdict,
    } = search(&model, settings, &roots)?;
    let (best, roots) = if settings.robust {
        robust::settle(&model, best, settings.robust_scales, REWEIGHTED)
    } else {
        (best, roots)
    };
    Ok(summary(&model, &best, &roots, starts, verdict))
}

/// Fits a problem from one start under given weights, for a neighbour of a fit that is known.
///
/// # Errors
///
/// As [`fit`], and weights that do not belong to the rows.
pub fn refit(
    problem: &dyn Separable,
    start: &[f64],
    weights: &[f64],
    settings: &FitSettings,
) -> Result<Fit, FitError> {
    settings.check()?;
    checks::check(problem)?;
    let expected = [problem.target().len(), problem.nonlinear().len()];
    if [weights.len(), start.len()] != expected {
        return Err(FitError::Shape {
            expected,
            found: [weights.len(), start.len()],
        });
    }
    let model = Model::new(problem, settings.step);
    let roots: Vec<f64> = weights.iter().map(|weight| weight.sqrt()).collect();
    let point = first(&model, start, &roots)?;
    let (best, _) = descend(&model, point, &roots, FINE, None);
    Ok(summary(&model, &best, &roots, vec![], Verdict::Single))
}

/// The point at a start, with the model's shape checked.
fn first(model: &Model, start: &[f64], roots: &[f64]) -> Result<Point, FitError> {
    let outer = model.coordinates.start(start);
    let values = model.coordinates.values(&outer);
    let point = model.point(outer, values, roots);
    checks::check_shape(model.problem, &point.evaluation)?;
    Ok(point)
}

struct Found {
    best: Point,
    starts: Vec<Start>,
    verdict: Verdict,
}

/// The best point from all starts under one set of weights.
fn search(model: &Model, settings: &FitSettings, roots: &[f64]) -> Result<Found, FitError> {
    let parameters = model.problem.nonlinear();
    let given: Vec<f64> = parameters.iter().map(|parameter| parameter.start).collect();
    let others = if parameters.is_empty() {
        0
    } else {
        settings.starts - 1
    };
    let mut begins = vec![given];
    begins.extend(
        starts::fractions(others, parameters.len())
            .iter()
            .map(|point| model.coordinates.at(point)),
    );
    let mut ends = Vec::with_capacity(begins.len());
    for begin in &begins {
        let point = first(model, begin, roots)?;
        // One start needs no coarse pass.
        ends.push(if begins.len() > 1 {
            descend(model, point, roots, COARSE, None).0
        } else {
            point
        });
    }
    let mut order: Vec<usize> = (0..begins.len()).filter(|k| ends[*k].finite).collect();
    order.sort_by(|a, b| ends[*a].cost.total_cmp(&ends[*b].cost));
    if order.is_empty() {
        return Err(FitError::NoStart);
    }
    let (best, outcomes) = finish(model, settings, roots, &mut ends, &order);
    let best_point = ends[order[best]].clone();
    let verdict = verdict(model, roots, &best_point, &ends, &outcomes);
    let rows = roots.len() as f64;
    let starts = begins
        .into_iter()
        .zip(&ends)
        .zip(outcomes)
        .map(|((start, end), outcome)| Start {
            start,
            end: end.values.clone(),
            residual_rms: (end.cost / rows).sqrt(),
            outcome,
        })
        .collect();
    Ok(Found {
        best: best_point,
        starts,
        verdict,
    })
}

/// Finishes starts in the order of their coarse costs until the best is found twice, or all are done. Gives the place of the best in
/// the order, and the outcome of every start.
fn finish(
    model: &Model,
    settings: &FitSettings,
    roots: &[f64],
    ends: &mut [Point],
    order: &[usize],
) -> (usize, Vec<Outcome>) {
    let mut outcomes = vec![Outcome::Coarse; ends.len()];
    let mut best: Option<(usize, Neighbourhood)> = None;
    for (place, k) in order.iter().enumerate() {
        let known = best.as_ref().map(|(_, neighbourhood)| neighbourhood);
        let (end, reached) = descend(model, ends[*k].clone(), roots, FINE, known);
        ends[*k] = end;
        outcomes[*k] = Outcome::Best;
        let better = !reached && known.is_none_or(|known| ends[*k].cost < known.cost);
        if better {
            best = Some((place, starts::neighbourhood(model, &ends[*k], roots)));
            // What was finished before is judged by the new best.
            if let Some((_, known)) = &best {
                for earlier in &order[..place] {
                    outcomes[*earlier] = starts::outcome(model, known, &ends[*earlier]);
                }
            }
        } else if let (Some(known), false) = (known, reached) {
            outcomes[*k] = starts::outcome(model, known, &ends[*k]);
        }
        let twice = outcomes
            .iter()
            .filter(|outcome| **outcome == Outcome::Best)
            .count()
            > 1;
        if place + 1 >= settings.finished && (twice || outcomes.contains(&Outcome::Rival)) {
            break;
        }
    }
    (best.map_or(0, |(place, _)| place), outcomes)
}

fn verdict(
    model: &Model,
    roots: &[f64],
    best: &Point,
    ends: &[Point],
    outcomes: &[Outcome],
) -> Verdict {
    let rivals: Vec<&Point> = ends
        .iter()
        .zip(outcomes)
        .filter(|(_, outcome)| **outcome == Outcome::Rival)
        .map(|(end, _)| end)
        .collect();
    let agreed = outcomes
        .iter()
        .filter(|outcome| **outcome == Outcome::Best)
        .count();
    if let Some(rival) = rivals.first() {
        let known = starts::neighbourhood(model, best, roots);
        let inner = model.coordinates.inner(&rival.values);
        Verdict::DependsOnStart {
            names: starts::differing(model.problem, &known, &inner),
        }
    } else if outcomes.len() == 1 {
        Verdict::Single
    } else if agreed > 1 {
        Verdict::Agreed(agreed)
    } else {
        Verdict::FoundOnce
    }
}

/// The fit at its best point.
fn summary(
    model: &Model,
    best: &Point,
    roots: &[f64],
    starts: Vec<Start>,
    verdict: Verdict,
) -> Fit {
    let problem = model.problem;
    let ones = vec![1.0; roots.len()];
    let linear = best.projection.values.clone();
    let slopes = model.slopes(best, true).of_model(&linear, &ones);
    let rows = roots.len();
    let mut jacobian = DMatrix::zeros(rows, problem.nonlinear().len() + linear.len());
    for (k, (parameter, value)) in problem.nonlinear().iter().zip(&best.values).enumerate() {
        jacobian.set_column(
            k,
            &(slopes.column(k) * inner_slope(parameter.scale, *value)),
        );
    }
    for (k, column) in best.evaluation.columns.iter().enumerate() {
        jacobian
            .column_mut(problem.nonlinear().len() + k)
            .copy_from_slice(column);
    }
    let sides = model.coordinates.at_bound(&best.values);
    let nonlinear_bound = problem
        .nonlinear()
        .iter()
        .zip(sides)
        .filter(|(_, side)| *side != 0)
        .map(|(p, _)| p.name);
    let held = problem
        .linear()
        .iter()
        .zip(&linear)
        .filter(|(p, value)| **value <= p.low || **value >= p.high);
    let at_bound = nonlinear_bound.chain(held.map(|(p, _)| p.name)).collect();
    let unweighted = model.residual(best);
    Fit {
        nonlinear: best.values.clone(),
        linear,
        residual: unweighted,
        weights: roots.iter().map(|root| root * root).collect(),
        jacobian,
        evaluations: model.evaluations(),
        starts,
        verdict,
        at_bound,
    }
}
