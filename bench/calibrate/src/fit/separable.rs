//! Fit of a separable problem: linear parameters are eliminated, the few others are found by Levenberg-Marquardt from several starts.
//!
//! | step | how |
//! |---|---|
//! | linear parameters | bounded least squares inside the residual (variable projection) |
//! | nonlinear ones | Levenberg-Marquardt (MINPACK's, crate `levenberg-marquardt`) in coordinates that keep the bounds |
//! | slopes | central differences of the model, projected by Kaufman's formula; evaluated in parallel |
//! | outliers | weights of a soft-L1 loss at 1.5 scales, scale = 1.4826 x the median of the residual's sizes, repeated until they stand |
//! | starts | the given one and an even set within the bounds; all run coarsely, the best are finished until one is found twice |
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
mod search;
mod starts;
#[cfg(test)]
mod tests;

use nalgebra::DMatrix;

use self::checks::FitError;
use self::descent::{Effort, descend};
use self::model::{Model, Point};
use self::search::{FINE, Found, first, search};
use crate::fit::problem::Separable;

pub(crate) use self::coordinates::{inner, inner_slope, outer};
pub use self::fixed::Fixed;
pub use self::starts::{Outcome, Start, Verdict};

/// One step after the weights have changed: they change again until both stand.
const REWEIGHTED: Effort = Effort {
    tolerance: 1e-7,
    slopes: 1,
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
                "the answer depends on the start: {} came out differently with the same residual; set one of them to what is \
                 known of it, or measure what tells it",
                names.join(", ")
            )),
            Verdict::FoundOnce { given: false } => Some(format!(
                "the answer depends on the start: only 1 of {} starts found the smallest residual, so a smaller one may exist; \
                 begin nearer to the truth or narrow the bounds",
                self.starts.len()
            )),
            Verdict::FoundOnce { given: true } | Verdict::Single | Verdict::Agreed(_) => None,
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
    } = search(&model, settings.starts, settings.finished, &roots)?;
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

/// Slopes over the inner coordinates, nonlinear before linear, at the nonlinear parameters' starts; and the linear ones' best values
/// there.
///
/// # Errors
///
/// As [`fit`].
pub fn slopes_at_start(problem: &dyn Separable) -> Result<(DMatrix<f64>, Vec<f64>), FitError> {
    checks::check(problem)?;
    let settings = FitSettings::default();
    let model = Model::new(problem, settings.step);
    let roots = vec![1.0; problem.target().len()];
    let start: Vec<f64> = problem
        .nonlinear()
        .iter()
        .map(|parameter| parameter.start)
        .collect();
    let point = first(&model, &start, &roots)?;
    if !point.finite {
        return Err(FitError::NoStart);
    }
    let slopes = model
        .slopes(&point, true)
        .of_model(&point.projection.values, &roots);
    let columns = point.evaluation.columns.iter().flatten().copied();
    let columns = DMatrix::from_iterator(roots.len(), problem.linear().len(), columns);
    let whole = slopes
        .column_iter()
        .chain(columns.column_iter())
        .collect::<Vec<_>>();
    let whole = if whole.is_empty() {
        DMatrix::zeros(roots.len(), 0)
    } else {
        DMatrix::from_columns(&whole)
    };
    Ok((whole, point.projection.values.clone()))
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
