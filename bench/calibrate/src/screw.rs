//! Calibration of a trace of a screw whose design is known. In the estimator's rows, with its kernel, its way after a turn and its intervals,
//! gross sliding of the exact ball takes the place of Coulomb friction and losses. What reversals tell (breakaway angle, backlash) is fitted to
//! rows about the turns, after it and from its numbers.

pub mod choice;
mod compared;
pub(crate) mod evidence;
pub(crate) mod exact;
pub(crate) mod friction;
pub(crate) mod problem;
pub(crate) mod quantities;
pub(crate) mod stages;
pub(crate) mod telling;
#[cfg(test)]
mod tests;

use std::sync::Arc;

use self::choice::{Start, Wanted};
use self::evidence::Evidence;
use self::exact::{Grid, Spacing};
use self::friction::Screw;
use self::problem::{Choice, Known};
use self::quantities::{QUANTITIES, Values};
use self::stages::{Prepared, Sliding, Window, few};
use crate::answer::{Calibration, Estimate};
use crate::estimator::fit::rms;
use crate::estimator::record::{Record, Smoothed};
use crate::estimator::words::{NOTHING, Screened, screened};
use crate::fit::problem::Separable as _;
use crate::fit::uncertainty::{Interval, Uncertainty, effective_rows};
use crate::folder::answered::Answered;
use crate::page::picture::Picture;
use crate::trace::{Coordinate, Trace};
use crate::without_design::{comparable, placed};
use epas_design::files::Design;
use epas_design::files::plausible::{FASTEST_BALLS, LONGEST};
use epas_page::failure::Failure;

/// How a trace of a screw is calibrated.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Request {
    /// What is estimated and what is set.
    pub wanted: Wanted,
    /// Whether other models of friction are not fitted.
    pub without_models: bool,
    /// Whether the ratio of the motor's gear was left at 1 without a word.
    pub ratio_unsaid: bool,
    /// Trace that is not fitted and scores the models; without it the last third of the fitted one.
    pub unseen: Option<Trace>,
}

impl Request {
    /// Fails where a name is unknown or stands where it cannot, before anything is fitted.
    pub fn check(&self) -> Result<(), Failure> {
        choice::check_names(&self.wanted)
    }
}

/// What a trace tells of a screw.
#[derive(Clone, Debug)]
pub struct ScrewCalibration {
    /// The answer.
    pub answer: Calibration,
    /// What its page draws: the rows over the whole motion.
    pub picture: Picture,
    /// The screw that was fitted.
    pub screw: Screw,
    /// Its values, estimated or not.
    pub values: Values,
    /// How sure they are.
    pub uncertainty: Uncertainty,
}

struct Told {
    values: Values,
    choice: Choice,
    intervals: Vec<Interval>,
    sliding: Sliding,
    window: Window,
    sentences: Vec<String>,
    grid: Arc<Grid>,
}

/// Calibrates a trace of a screw.
pub fn calibrate(
    trace: &Trace,
    design: &Design,
    request: &Request,
) -> Result<ScrewCalibration, Failure> {
    request.check()?;
    of_screw(trace, request.unseen.as_ref())?;
    let trace = &*placed(trace);
    let evidence = Evidence::of(trace, &Smoothed::of(trace));
    plausible(design, &evidence)?;
    let Screened { kernel, late } = looked_at(trace, reduced_lead(design))?;
    let mut start = Start::of(design, &evidence, &request.wanted)?;
    let unseen = request.unseen.iter();
    let loads = unseen.flat_map(|unseen| &unseen.load).flatten();
    let screw = &mut start.screw;
    screw.largest_load = loads.fold(screw.largest_load, |most, load| most.max(load.abs()));
    let (prepared, told) = told(trace, &start, &evidence, (request, kernel))?;
    let rows = prepared.rows_over_turns(told.window, true);
    let whole = prepared.remembered(rows, told.known());
    let measured = whole.target();
    let model = whole.model(&told.values);
    let residual: Vec<f64> = measured.iter().zip(model).map(|(a, b)| a - b).collect();
    let uncertainty = uncertainty(&told, &residual);
    let mut answer = answer(&told, measured, &residual, &uncertainty);
    explained(trace, &answer)?;
    let said = |name: &str| {
        let words = name.replace('_', " ");
        told.sentences.iter().any(|said| said.starts_with(&words))
    };
    let wanted = &request.wanted;
    let set = |name: &str| wanted.fix.iter().any(|(set, _)| set == name);
    let fixed = answer.parameters.iter().filter(|of| of.fixed);
    let fixed = fixed.map(|of| of.name.as_str());
    let fixed = fixed.filter(|name| wanted.estimate.is_none() && !set(name) && !said(name));
    let left_out = telling::left_out(&fixed.collect::<Vec<_>>(), &evidence);
    let sentences = told.sentences.iter().cloned();
    answer.cannot_tell = sentences
        .chain(left_out)
        .chain(late)
        .chain(trace.told())
        .collect();
    if !request.without_models {
        let scores = compared::models(&prepared, &told, request.unseen.as_ref());
        answer.compare(scores.into_iter());
    }
    let names = uncertainty.intervals.iter().map(|of| of.name.into());
    let errors = (names.collect(), &uncertainty.covariance);
    let fitted = (measured.to_vec(), &*residual);
    Ok(ScrewCalibration {
        answer,
        picture: Picture::of(trace, &whole.rows().centres, fitted, errors),
        screw: start.screw,
        values: told.values,
        uncertainty,
    })
}

/// One trace of many, and what it adds to the others.
pub fn plain(
    trace: &Trace,
    design: &Design,
    request: &Request,
) -> Result<(Calibration, Answered), Failure> {
    let request = Request {
        without_models: true,
        ..request.clone()
    };
    let found = calibrate(trace, design, &request)?;
    let answered = Answered::of(&found.uncertainty, true)?;
    Ok((found.answer, answered))
}

/// Whether a trace is one of a screw, and another one may score its models.
fn of_screw(trace: &Trace, unseen: Option<&Trace>) -> Result<(), Failure> {
    if trace.coordinate != Coordinate::Rotation {
        return Err(Failure::Data(
            "a screw's trace is one of the nut's angle and the torque on it".into(),
        ));
    }
    unseen.map_or(Ok(()), |unseen| comparable(trace, unseen))
}

/// Rows of one direction, then rows about the turns.
fn told<'a>(
    trace: &'a Trace,
    start: &Start,
    evidence: &Evidence,
    (request, kernel): (&Request, (f64, f64)),
) -> Result<(Prepared<'a>, Told), Failure> {
    let [first, at_turns] = start.choice.clone().at_turns();
    let mut left_out = Record::of(trace, &[]).rests();
    let whole = Prepared::new(trace, &left_out, start.screw);
    let coarse = start.screw.grid(&start.values, Spacing::COARSE)?;
    let known = Known::of(&start.values, &first, &coarse);
    let (window, values, outliers) = whole.settled(kernel, known, &at_turns)?;
    let said = telling::outliers(outliers.len());
    left_out.extend(outliers);
    let prepared = Prepared::new(trace, &left_out, start.screw);
    let mut told = slid(
        &prepared,
        (window, known.with(&values)),
        (start, evidence),
        &request.wanted.fix,
    )?;
    if !at_turns.nonlinear.is_empty() {
        told.turn(&prepared, &at_turns, &start.values)?;
    }
    told.sentences.splice(0..0, said);
    Ok((prepared, told))
}

/// What rows of one direction tell: what they do not is set, one parameter after the other.
fn slid(
    prepared: &Prepared<'_>,
    (window, known): (Window, Known<'_>),
    (start, evidence): (&Start, &Evidence),
    set: &[(String, f64)],
) -> Result<Told, Failure> {
    let mut choice = known.choice.clone();
    let (mut kept, mut sentences) = (Vec::new(), Vec::new());
    let mut sliding = prepared.slid(window, known, set)?;
    while let Some(untold) = telling::untold(&sliding, &start.values, evidence, &kept) {
        let less = choice.without(untold.name);
        let value = telling::value_of(untold.name, &start.values);
        let without = telling::with(untold.name, value, &sliding.values);
        let next = prepared.slid(window, Known::of(&without, &less, known.grid), set)?;
        if next.residual_rms > GROWTH * sliding.residual_rms {
            // The trace does object to that value.
            kept.push(untold.name);
        } else {
            sentences.push(untold.sentence);
            (choice, sliding) = (less, next);
        }
    }
    let mut nodes = sliding.values;
    if choice.nonlinear.iter().any(|(of, _)| of.name == "preload") {
        nodes.preload = Spacing::FINE.beside(nodes.preload);
    }
    let grid = start.screw.grid(&nodes, Spacing::FINE)?;
    let sliding = prepared.slid(window, Known::of(&sliding.values, &choice, &grid), set)?;
    let bounds = sliding.intervals.iter().filter(|of| of.at_bound);
    sentences.extend(bounds.map(|of| telling::at_bound(of, evidence)));
    Ok(Told {
        values: sliding.values,
        choice,
        intervals: Vec::new(),
        sliding,
        window,
        sentences,
        grid,
    })
}

impl Told {
    fn known(&self) -> Known<'_> {
        Known::of(&self.values, &self.choice, &self.grid)
    }

    /// Adds what the rows over turns tell; what they do not is set to the design's.
    fn turn(
        &mut self,
        prepared: &Prepared<'_>,
        at_turns: &Choice,
        design: &Values,
    ) -> Result<(), Failure> {
        let turned = prepared.turned(self.window, &self.sliding, at_turns, self.known())?;
        let step = prepared.trace.resolution;
        for of in turned.into_iter().flatten() {
            let design = telling::value_of(of.name, design);
            if of.value > 0.0 && of.value < STEPS * step {
                let sentence = telling::too_coarse(of.name, step, design);
                self.sentences.insert(0, sentence);
            } else if of.at_bound {
                self.sentences.push(telling::beyond_bound(of.name, design));
            } else {
                self.values = telling::with(of.name, of.value, &self.values);
                self.intervals.push(of);
            }
        }
        let told = |name: &str| self.intervals.iter().any(|of| of.name == name);
        let told = at_turns.nonlinear.iter().filter(|(of, _)| told(of.name));
        self.choice.nonlinear.extend(told.cloned());
        Ok(())
    }
}

/// A parameter stays free where the residual is larger by this without it.
const GROWTH: f64 = 1.02;

/// Fewest steps of the position from the turn of a motion to full sliding: of a travel that the sensor sees in fewer of them, the place of
/// the turn, known to a step, decides.
const STEPS: f64 = 2.0;

/// Whether a screw of this design can move so, and whether anything presses its balls.
fn plausible(design: &Design, evidence: &Evidence) -> Result<(), Failure> {
    let speed = f64::from(design.screw().pitch_radius()) * evidence.speeds[1];
    let travel = reduced_lead(design) * evidence.range;
    if speed > FASTEST_BALLS || travel > LONGEST {
        return Err(Failure::Data(format!(
            "a travel of {travel:.3} m with balls at {speed:.1} m/s does not fit this screw: is the angle in degrees (nut_position_deg), or the motor's with a ratio (--ratio)?"
        )));
    }
    if evidence.range == 0.0 {
        return Err(Failure::Data(
            "the position never moves: no friction shows".into(),
        ));
    }
    let pressed = design.caged.clearance.gap() < 0.0;
    if !pressed && evidence.load.is_some() && evidence.largest_load() == 0.0 {
        return Err(Failure::Data(
            "the load is 0 N throughout, and the design has no preload: nothing presses the balls; is the load's sensor dead?".into(),
        ));
    }
    Ok(())
}

/// Refuses a fit that leaves nearly all of the torque.
fn explained(trace: &Trace, answer: &Calibration) -> Result<(), Failure> {
    if answer.relative_error < NOTHING {
        return Ok(());
    }
    let why = if trace.load.is_none() {
        "a load acts that the trace does not hold: add a column axial_load"
    } else {
        "is the right column the torque, and do load and torque belong to what moves?"
    };
    Err(Failure::Data(format!(
        "nothing in the trace explains its torque: {:.0} % of it are left; {why}",
        100.0 * answer.relative_error
    )))
}

fn reduced_lead(design: &Design) -> f64 {
    f64::from(design.screw().lead()) / std::f64::consts::TAU
}

/// Whether signs, units and columns fit, by the estimator's words on the trace as a drive with the load's torque, friction whatever it is: the
/// kernel and the way after a turn of its rows, and how late a channel is.
fn looked_at(trace: &Trace, reduced_lead: f64) -> Result<Screened, Failure> {
    let mut drive = trace.clone();
    for load in drive.load.iter_mut().flatten() {
        *load *= reduced_lead;
    }
    drive.load_is_effort = true;
    let found = screened(&Record::of(&drive, &[]), &drive).map_err(Failure::Data)?;
    found.ok_or_else(few)
}

/// How sure everything is: both stages' parameters, in the order in which quantities are told; the stages' errors count as independent.
fn uncertainty(told: &Told, residual: &[f64]) -> Uncertainty {
    let sliding = &told.sliding;
    let all: Vec<&Interval> = sliding.intervals.iter().chain(&told.intervals).collect();
    let mut order: Vec<usize> = (0..all.len()).collect();
    let place = |k: &usize| quantities::names().position(|name| name == all[*k].name);
    order.sort_by_key(place);
    let first = sliding.intervals.len();
    let entry = |i: usize, j: usize| {
        let (i, j) = (order[i], order[j]);
        if i < first && j < first {
            sliding.covariance[(i, j)]
        } else if i == j {
            let of = all[i];
            of.standard_error.powi(2) - of.model_error.powi(2)
        } else {
            0.0
        }
    };
    let covariance = nalgebra::DMatrix::from_fn(all.len(), all.len(), entry);
    Uncertainty {
        intervals: order.iter().map(|k| all[*k].clone()).collect(),
        covariance,
        effective_rows: effective_rows(residual),
    }
}

fn answer(
    told: &Told,
    measured: &[f64],
    residual: &[f64],
    uncertainty: &Uncertainty,
) -> Calibration {
    let parameters = QUANTITIES.iter().map(|of| {
        let mut intervals = uncertainty.intervals.iter();
        let interval = intervals.find(|interval| interval.name == of.name);
        interval.map_or_else(
            || Estimate::fixed(of.name, of.unit, of.value(&told.values)),
            Estimate::from,
        )
    });
    Calibration {
        parameters: parameters.collect(),
        residual_rms: rms(residual),
        relative_error: rms(residual) / rms(measured).max(f64::MIN_POSITIVE),
        effective_rows: uncertainty.effective_rows,
        ..Calibration::default()
    }
}
