//! A trace of a screw whose design is known: friction coefficient, preload, breakaway angle and what else the trace can tell.
//!
//! | module | what |
//! |---|---|
//! | [`quantities`] | everything that has a value: names, units, bounds |
//! | [`friction`] | friction along the trace: the exact ball behind the memory of the crate |
//! | [`exact`] | the exact ball on a grid of coefficients and preloads, solved where a fit comes near |
//! | [`recent`] | what was made last |
//! | [`problem`] | the whole torque as a separable problem |
//! | [`systematic`] | errors of the sensors and of the model in the intervals |
//! | [`hints`] | what a trace lacks, in sentences |
//! | [`evidence`] | what the trace excites |
//! | [`rivals`] | other models of friction |
//! | [`blocks`] | rows that are fitted and rows that score |
//! | [`waves`] | waves of the torque over the turn |
//! | [`scores`] | scores of all models |
//! | [`choice`] | what is estimated, from where, within which bounds |

pub mod blocks;
pub mod choice;
pub mod evidence;
pub mod exact;
#[cfg(test)]
mod faults_tests;
pub mod friction;
pub mod hints;
#[cfg(test)]
mod hostile_tests;
pub mod problem;
pub mod quantities;
pub mod recent;
pub mod rivals;
pub mod scores;
pub mod systematic;
#[cfg(test)]
mod tests;
pub mod waves;

use std::ops::Range;

use self::choice::{Start, Wanted};
use self::evidence::Evidence;
use self::exact::Spacing;
use self::friction::Screw;
use self::hints::{FILM, ScrewHints};
use self::problem::{Choice, ScrewProblem};
use self::quantities::Values;
use self::systematic::widened;
use crate::answer::{Calibration, Estimate};
use crate::checks::finding::{Finding, FindingKind};
use crate::checks::{examine, load_gain};
use crate::fit::problem::Separable;
use crate::fit::separable::{self, Fit, FitSettings, Fixed};
use crate::fit::telling::{Reason, Told, at_bounds, tell};
use crate::fit::uncertainty::{Interval, Uncertainty, uncertainty};
use crate::laws::turns::{directions, near_turns};
use crate::signals::filter::ZeroPhase;
use crate::signals::{Motion, RowSettings, Rows, SmoothingSettings};
use crate::trace::known::placed;
use crate::trace::rests::rests;
use crate::trace::{Coordinate, Trace};
use epas_design::files::Design;
use epas_page::failure::Failure;

/// How a trace of a screw is calibrated.
#[derive(Clone, Debug, PartialEq)]
pub struct Request {
    /// What is estimated and what is set.
    pub wanted: Wanted,
    /// How the angle is smoothed.
    pub smoothing: SmoothingSettings,
    /// How signals become rows.
    pub rows: RowSettings,
    /// How the fit is made.
    pub fit: FitSettings,
    /// How closely the exact ball is solved for the search; the answer is then found with [`Spacing::FINE`].
    pub search: Spacing,
    /// Whether other models of friction are not fitted.
    pub without_models: bool,
    /// Whether the ratio of the motor's gear was left at 1 without a word.
    pub ratio_unsaid: bool,
    /// Trace that is not fitted and scores the models; without it every third block of the fitted one.
    pub unseen: Option<Trace>,
}

impl Default for Request {
    /// Everything that the trace can tell. Differences of the fit take steps of a hundredth: the memory rounds to f32.
    fn default() -> Self {
        Self {
            wanted: Wanted::default(),
            smoothing: SmoothingSettings::default(),
            rows: RowSettings::default(),
            fit: FitSettings {
                step: 1e-2,
                starts: 4,
                ..FitSettings::default()
            },
            search: Spacing::COARSE,
            without_models: false,
            ratio_unsaid: false,
            unseen: None,
        }
    }
}

impl Request {
    /// Fails where a name is unknown or stands where it cannot, before anything is fitted.
    ///
    /// # Errors
    /// The name.
    pub fn check(&self) -> Result<(), Failure> {
        choice::check_names(&self.wanted)
    }
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
    /// The last fit.
    pub fit: Fit,
    /// How sure it is.
    pub uncertainty: Uncertainty,
    /// Evaluations of the model in all fits.
    pub evaluations: usize,
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
    let found = attempt(trace, design, request, None)?;
    let Some(constant) = with_constant_coefficient(request, &found) else {
        return Ok(found);
    };
    let alone = Request {
        without_models: true,
        ..constant.clone()
    };
    let [law, one] = [&found.answer, &attempt(trace, design, &alone, None)?.answer]
        .map(|answer| answer.relative_error);
    if one >= CONSTANT * law {
        return Ok(found);
    }
    let mut constant = attempt(trace, design, &constant, None)?;
    constant.answer.cannot_tell.push(format!(
        "full film ratio: set to 1, a coefficient that does not change with the speed: it leaves {:.2} % of the torque, the default law {:.2} %.",
        100.0 * one,
        100.0 * law
    ));
    Ok(constant)
}

/// What a coefficient that does not change with the speed leaves of the torque, over what the default law leaves, from which on it is taken.
const CONSTANT: f64 = 0.9;

/// A request with a constant coefficient, where a trace has not told how it changes with the speed, and nobody has said so.
fn with_constant_coefficient(request: &Request, found: &ScrewCalibration) -> Option<Request> {
    let fixed = |name: &str| request.wanted.fix.iter().any(|(fixed, _)| fixed == name);
    let told = |name: &str| {
        let parameter = found.answer.parameter(name);
        parameter.is_some_and(|parameter| !parameter.fixed)
    };
    if request.wanted.estimate.is_some() || FILM.iter().any(|name| fixed(name) || told(name)) {
        return None;
    }
    let mut request = request.clone();
    request.wanted.fix.push((FILM[0].into(), 1.0));
    Some(request)
}

/// What the position's sensor is too coarse for: the breakaway, and so what happens before sliding.
#[derive(Clone, Debug)]
struct TooCoarse {
    /// What is said of the breakaway angle.
    sentence: String,
}

/// Steps of the position behind a turn within which a motion may not slide yet, where the sensor is too coarse for its breakaway: the angle
/// is below two of them.
const BEFORE_SLIDING: f64 = 4.0;
/// Least share of the samples that slide.
const SLIDES: f64 = 0.2;

/// The rows of a trace; where the sensor is too coarse for the breakaway, those that slide: friction before that would count as less
/// friction, drag or a turn that is late. `None` where hardly anything slides.
fn sliding_rows(rows: Rows, trace: &Trace, motion: &Motion) -> Option<Rows> {
    let steps = trace.resolution;
    let ways = directions(&motion.position, &motion.speed, 2.0 * steps);
    let near = near_turns(&ways, &motion.position, BEFORE_SLIDING * steps);
    let left_out = [near, rests(trace)].concat();
    let slides = trace.len()
        - left_out
            .iter()
            .map(Range::len)
            .sum::<usize>()
            .min(trace.len());
    (slides as f64 > SLIDES * trace.len() as f64).then(|| rows.without(&left_out, trace.len()))
}

/// A request with the breakaway angle set, because the position's sensor is too coarse for it.
fn without_breakaway(request: &Request, told: &Told) -> Option<(Request, TooCoarse)> {
    let mut untold = told.untold.iter();
    let unseen = untold.find(|untold| {
        untold.reason == Reason::Unseen && untold.names.contains(&BREAKAWAY_ANGLE)
    })?;
    let (_, value) = unseen.fixed?;
    let mut request = request.clone();
    let wanted = &mut request.wanted;
    if let Some(estimate) = &mut wanted.estimate {
        estimate.retain(|name| name != BREAKAWAY_ANGLE);
    }
    wanted.fix.push((BREAKAWAY_ANGLE.into(), value));
    let sentence = format!(
        "{} What moved by less than {BEFORE_SLIDING} steps since it turned round may not slide yet, and is left out.",
        unseen.sentence
    );
    Some((request, TooCoarse { sentence }))
}

/// Calibrates a trace; anew where its sensor turns out too coarse for the breakaway.
fn attempt(
    trace: &Trace,
    design: &Design,
    request: &Request,
    too_coarse: Option<TooCoarse>,
) -> Result<ScrewCalibration, Failure> {
    request.check()?;
    for trace in std::iter::once(trace).chain(&request.unseen) {
        if trace.coordinate != Coordinate::Rotation {
            return Err(Failure::Data(
                "a screw's trace is one of the nut's angle and the torque on it".into(),
            ));
        }
    }
    let unseen_trace = request
        .unseen
        .as_ref()
        .map(|unseen| {
            let motion = Motion::of(unseen, &request.smoothing)?;
            Ok::<_, Failure>(placed(unseen, &motion))
        })
        .transpose()?;
    let unseen = unseen_trace
        .as_deref()
        .map(|unseen| Unseen::new(unseen, trace, request))
        .transpose()?;
    let motion = Motion::of(trace, &request.smoothing)?;
    let trace = &*placed(trace, &motion);
    let findings = examine(trace, &motion)?;
    load_gain(trace, &motion, reduced_lead(design), request.ratio_unsaid)?;
    let mut rows = Rows::of_trace(trace, &request.rows)?;
    if too_coarse.is_some() {
        rows = sliding_rows(rows.clone(), trace, &motion).unwrap_or(rows);
    }
    let smoothing = request.smoothing.filter(trace.step)?;
    let evidence = Evidence::of(trace, &motion);
    plausible(design, &evidence)?;
    let Start {
        screw,
        values,
        choice,
    } = Start::of(design, &evidence, &request.wanted)?;
    let measured = (trace, &motion, &rows);
    let other = unseen
        .as_ref()
        .map(|unseen| unseen.problem(screw, values, choice.clone(), request.search))
        .transpose()?;
    let problem = ScrewProblem::new(screw, measured, &smoothing, values, choice, request.search)?;
    let hints = ScrewHints {
        evidence,
        values,
        step: trace.resolution,
        coarse: too_coarse.is_some(),
    };
    let told = tell(&problem, &request.fit, &hints)?;
    if too_coarse.is_none()
        && let Some((request, too_coarse)) = without_breakaway(request, &told)
    {
        return attempt(trace, design, &request, Some(too_coarse));
    }
    if let Some(refusal) = told.fit.refusal() {
        return Err(Failure::Data(refusal));
    }
    let values = values_of(&problem, &told.fixed, &told.uncertainty.intervals);
    let problem = problem.refined(&values)?;
    let part = Fixed::new(&problem, &told.fixed)?;
    let fit = separable::fit(&part, &once(&request.fit))?;
    let evaluations = told.evaluations + fit.evaluations;
    let by_residual = uncertainty(&part, &fit);
    let values = values_of(&problem, &told.fixed, &by_residual.intervals);
    let smoothing = &request.smoothing;
    let uncertainty = widened(
        &problem,
        &fit,
        &values,
        smoothing,
        &request.wanted.fix,
        hints.coarse,
        by_residual.clone(),
    )?;
    let values = values_of(&problem, &told.fixed, &uncertainty.intervals);
    let mut answer = answer(&problem, &fit, &uncertainty, &values);
    let fixed: Vec<&str> = answer
        .parameters
        .iter()
        .filter(|parameter| parameter.fixed)
        .filter(|parameter| told.fixed.iter().all(|(name, _)| *name != parameter.name))
        .map(|parameter| parameter.name.as_str())
        .collect();
    let left_out = hints.left_out(&fixed);
    // On the fine grid another one may end at its bound than in the search.
    let mut untold = told.untold;
    untold.retain(|untold| untold.reason != Reason::AtBound || untold.fixed.is_some());
    untold.extend(at_bounds(&uncertainty, &hints));
    let untold = untold.into_iter().map(|untold| untold.sentence);
    let too_coarse = too_coarse.into_iter().map(|coarse| coarse.sentence);
    answer.cannot_tell = too_coarse
        .chain(untold)
        .chain(left_out)
        .chain(spoiled(findings))
        .collect();
    if !request.without_models {
        let other = other.map(|other| other.refined(&values)).transpose()?;
        let other = unseen
            .as_ref()
            .zip(other.as_ref())
            .map(|(unseen, problem)| (problem, unseen.measured()));
        let fitted = (&problem, measured);
        let scores = scores::scores(fitted, other, &values, &request.fit);
        (answer.models, answer.winner) = (scores.models, scores.winner);
        answer.cannot_tell.extend(scores.left_out);
    }
    Ok(ScrewCalibration {
        answer,
        screw,
        values,
        evidence,
        fit,
        uncertainty,
        evaluations,
    })
}

/// A trace that is not fitted, filtered as the fitted one is.
struct Unseen<'a> {
    trace: &'a Trace,
    motion: Motion,
    rows: Rows,
    smoothing: ZeroPhase,
}

impl<'a> Unseen<'a> {
    fn new(trace: &'a Trace, fitted: &Trace, request: &Request) -> Result<Self, Failure> {
        if trace.load.is_some() != fitted.load.is_some() {
            return Err(Failure::Data(format!(
                "one of {} and {} has an axial load and the other none: one cannot score the other's models",
                fitted.name, trace.name
            )));
        }
        Ok(Self {
            trace,
            motion: Motion::of(trace, &request.smoothing)?,
            rows: Rows::of_trace(trace, &request.rows)?,
            smoothing: request.smoothing.filter(trace.step)?,
        })
    }

    const fn measured(&self) -> (&Trace, &Motion, &Rows) {
        (self.trace, &self.motion, &self.rows)
    }

    /// The same screw on this trace, with elements up to its own loads.
    fn problem(
        &self,
        mut screw: Screw,
        values: Values,
        choice: Choice,
        spacing: Spacing,
    ) -> Result<ScrewProblem<'_>, Failure> {
        let evidence = Evidence::of(self.trace, &self.motion);
        screw.largest_load = screw.largest_load.max(evidence.largest_load());
        ScrewProblem::new(
            screw,
            self.measured(),
            &self.smoothing,
            values,
            choice,
            spacing,
        )
    }
}

/// Name of the angle before sliding.
const BREAKAWAY_ANGLE: &str = "breakaway_angle";

/// Fastest balls about the screw's axis, m/s: twice what catalogues allow (150,000 mm/min of pitch diameter times revolutions).
const FASTEST: f64 = 16.0;
/// Longest travel, m.
const LONGEST: f64 = 3.0;

/// Whether a screw of this design can move so, and whether anything presses its balls.
fn plausible(design: &Design, evidence: &Evidence) -> Result<(), Failure> {
    let speed = f64::from(design.screw().pitch_radius()) * evidence.speeds[1];
    let travel = reduced_lead(design) * evidence.range;
    if speed > FASTEST || travel > LONGEST {
        return Err(Failure::Data(format!(
            "a travel of {travel:.3} m with balls at {speed:.1} m/s does not fit this screw: is the angle in degrees (nut_position_deg), or the motor's with a ratio (--ratio)?"
        )));
    }
    let pressed = design.caged.clearance.gap() < 0.0;
    if !pressed && evidence.load.is_some() && evidence.largest_load() == 0.0 {
        return Err(Failure::Data(
            "the load is 0 N throughout, and the design has no preload: nothing presses the balls; is the load's sensor dead?".into(),
        ));
    }
    Ok(())
}

/// Travel of the screw over the nut's angle, m/rad.
fn reduced_lead(design: &Design) -> f64 {
    f64::from(design.screw().lead()) / std::f64::consts::TAU
}

/// What was wrong with the trace itself. What it does not excite is told by the parameters.
fn spoiled(findings: Vec<Finding>) -> impl Iterator<Item = String> {
    let itself = |kind: FindingKind| {
        matches!(
            kind,
            FindingKind::ClippedEffort
                | FindingKind::ShiftedEffort
                | FindingKind::ShiftedSpeed
                | FindingKind::SignUnchecked
                | FindingKind::DeadChannel
                | FindingKind::LeftOut
                | FindingKind::Rests
                | FindingKind::Repaired
                | FindingKind::IgnoredColumns
        )
    };
    findings
        .into_iter()
        .filter(move |finding| itself(finding.kind))
        .map(|finding| finding.message)
}

/// The same settings with one start.
fn once(settings: &FitSettings) -> FitSettings {
    FitSettings {
        starts: 1,
        finished: 1,
        ..*settings
    }
}

/// Values of a problem with what was set and what was found.
fn values_of(
    problem: &ScrewProblem<'_>,
    fixed: &[(&'static str, f64)],
    intervals: &[Interval],
) -> Values {
    let found = |name: &str, start: f64| {
        let set = fixed.iter().find(|(known, _)| *known == name);
        let interval = intervals.iter().find(|interval| interval.name == name);
        set.map(|(_, value)| *value)
            .or(interval.map(|interval| interval.value))
            .unwrap_or(start)
    };
    let nonlinear: Vec<f64> = problem
        .nonlinear()
        .iter()
        .map(|parameter| found(parameter.name, parameter.start))
        .collect();
    let linear: Vec<f64> = problem
        .linear()
        .iter()
        .map(|parameter| found(parameter.name, 0.0))
        .collect();
    problem.values(&nonlinear, &linear)
}

fn answer(
    problem: &ScrewProblem<'_>,
    fit: &Fit,
    uncertainty: &Uncertainty,
    values: &Values,
) -> Calibration {
    let parameters = quantities::all(values).map(|(name, unit, value)| {
        let mut intervals = uncertainty.intervals.iter();
        match intervals.find(|interval| interval.name == name) {
            Some(interval) => Estimate {
                name: name.into(),
                unit,
                value: interval.value,
                low: interval.low,
                high: interval.high,
                fixed: false,
                at_bound: interval.at_bound,
            },
            None => Estimate::fixed(name, unit, value),
        }
    });
    let target: f64 = problem.target().iter().map(|x| x * x).sum();
    let residual: f64 = fit.residual.iter().map(|x| x * x).sum();
    Calibration {
        parameters: parameters.collect(),
        residual_rms: fit.residual_rms(),
        relative_error: (residual / target.max(f64::MIN_POSITIVE)).sqrt(),
        effective_rows: uncertainty.effective_rows,
        cannot_tell: Vec::new(),
        models: Vec::new(),
        winner: None,
    }
}
