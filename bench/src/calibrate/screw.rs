//! A trace of a screw whose design is known: friction coefficient, preload, breakaway angle and what else the trace can tell.
//!
//! | module | what |
//! |---|---|
//! | [`quantities`] | everything that has a value: names, units, bounds |
//! | [`friction`] | friction along the trace by the crate's caged scene with memory |
//! | [`problem`] | the whole torque as a separable problem |
//! | [`evidence`] | what the trace excites |
//! | [`choice`] | what is estimated, from where, within which bounds |

pub mod choice;
pub mod evidence;
pub mod friction;
pub mod problem;
pub mod quantities;

use self::choice::{Start, Wanted};
use self::evidence::Evidence;
use self::friction::Screw;
use self::problem::ScrewProblem;
use self::quantities::Values;
use super::answer::{Calibration, Estimate};
use super::separable::{Fit, FitSettings, fit};
use super::signals::{Motion, RowSettings, Rows, SmoothingSettings};
use super::trace::{Coordinate, Trace};
use super::uncertainty::{Uncertainty, uncertainty};
use crate::designs::Design;
use crate::failure::Failure;

/// How a trace of a screw is calibrated.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Request {
    /// What is estimated and what is set.
    pub wanted: Wanted,
    /// How the angle is smoothed.
    pub smoothing: SmoothingSettings,
    /// How signals become rows.
    pub rows: RowSettings,
    /// How the fit is made.
    pub fit: FitSettings,
}

/// What a trace tells of a screw.
#[derive(Clone, Debug)]
pub struct ScrewCalibration {
    /// The answer.
    pub answer: Calibration,
    /// The screw that was fitted.
    pub screw: Screw,
    /// Its values, estimated or not.
    pub values: Values,
    /// What the trace excites.
    pub evidence: Evidence,
    /// The fit.
    pub fit: Fit,
    /// How sure it is.
    pub uncertainty: Uncertainty,
}

/// Calibrates a trace of a screw.
///
/// # Errors
/// A trace or a request from which nothing can be told, and an answer that depends on the start.
pub fn calibrate(
    trace: &Trace,
    design: &Design,
    request: &Request,
) -> Result<ScrewCalibration, Failure> {
    if trace.coordinate != Coordinate::Rotation {
        return Err(Failure::Data(
            "a screw's trace is one of the nut's angle and the torque on it".into(),
        ));
    }
    let motion = Motion::of(trace, &request.smoothing)?;
    let rows = Rows::new(trace.step, &request.rows)?;
    let evidence = Evidence::of(trace, &motion);
    let Start {
        screw,
        values,
        choice,
    } = Start::of(design, &evidence, &request.wanted)?;
    let problem = ScrewProblem::new(screw, (trace, &motion, &rows), values, choice)?;
    let fit = fit(&problem, &request.fit)?;
    if let Some(refusal) = fit.refusal() {
        return Err(Failure::Data(refusal));
    }
    let uncertainty = uncertainty(&problem, &fit);
    let values = problem.values(&fit.nonlinear, &fit.linear);
    Ok(ScrewCalibration {
        answer: answer(&problem, &fit, &uncertainty, &values),
        screw,
        values,
        evidence,
        fit,
        uncertainty,
    })
}

fn answer(
    problem: &ScrewProblem<'_>,
    fit: &Fit,
    uncertainty: &Uncertainty,
    values: &Values,
) -> Calibration {
    use super::problem::Separable;
    let estimated = uncertainty.intervals.iter().map(|interval| Estimate {
        name: interval.name.into(),
        unit: interval.unit,
        value: interval.value,
        low: interval.low,
        high: interval.high,
        fixed: false,
    });
    let estimated: Vec<Estimate> = estimated.collect();
    let mut parameters: Vec<Estimate> = Vec::new();
    for (name, unit, value) in quantities::all(values) {
        let found = estimated.iter().find(|estimate| estimate.name == name);
        parameters.push(match found {
            Some(estimate) => estimate.clone(),
            None => Estimate::fixed(name, unit, value),
        });
    }
    let target: f64 = problem.target().iter().map(|x| x * x).sum();
    let residual: f64 = fit.residual.iter().map(|x| x * x).sum();
    Calibration {
        parameters,
        residual_rms: fit.residual_rms(),
        relative_error: (residual / target.max(f64::MIN_POSITIVE)).sqrt(),
        effective_rows: uncertainty.effective_rows,
        cannot_tell: Vec::new(),
        models: Vec::new(),
        winner: None,
    }
}
