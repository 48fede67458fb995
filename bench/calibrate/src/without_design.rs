//! Calibration of a trace without a design.
//!
//! | module | what |
//! |---|---|
//! | [`choice`] | models of friction on a trace without a design |
//! | [`slide`] | such a trace as a separable problem |
//! | [`terms`] | what stands beside the law of friction in it |
//! | [`resistance`] | the same as what opposes a motion |
//! | [`losses`] | which losses in proportion to the load it tells |
//! | [`drive`] | what firmware takes of it |
//! | [`period`] | the period of a wave over the travel |
//! | [`closed_loop`] | the motion that a controller makes of a model |
//! | [`controller`] | the controller that is seen in a trace |

pub mod choice;
pub mod closed_loop;
pub mod controller;
pub mod drive;
pub mod losses;
pub mod period;
pub mod resistance;
pub mod slide;
pub mod terms;

use std::borrow::Cow;

use crate::answer::{Calibration, ModelScore};
use crate::checks::examine;
use crate::checks::excitation::one_speed;
use crate::checks::finding::{Finding, FindingKind};
use crate::fit::problem::Separable;
use crate::fit::separable::{Fit, FitSettings, fit};
use crate::fit::uncertainty::{Uncertainty, uncertainty};
use crate::folder::answered::Answered;
use crate::laws::Law;
use crate::page::picture::Picture;
use crate::page::shown::digits;
use crate::signals::{Motion, RowSettings, Rows, SmoothingSettings};
use crate::trace::known::placed;
use crate::trace::rests::rests;
use crate::trace::{Coordinate, Trace};
use crate::without_design::choice::{
    LAWS, LOAD_PROPORTIONAL, PLAIN, Prepared, estimates, left_out, model, terms,
};
use crate::without_design::drive::Drive;

use crate::controller::Controller;
use crate::without_design::closed_loop::size;
use crate::without_design::controller::SeenController;
use crate::without_design::slide::{AT_ONE_SPEED, Slide};
use crate::without_design::terms::{LoadTerm, Terms};
use epas_page::failure::Failure;

/// How a trace is filtered.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Filters {
    /// Cut-off of the motion, Hz; `None` for the highest of [`SMOOTHING`] at which noise of the sensor is lost in the acceleration.
    pub smoothing: Option<f64>,
    /// Cut-off of the rows, Hz; `None` for [`ROWS`], or three fifths of the motion's where that is less.
    pub rows: Option<f64>,
}

/// Cut-offs of the motion that are tried, Hz.
pub const SMOOTHING: [f64; 4] = [100.0, 60.0, 40.0, 25.0];
/// Cut-off of the rows, Hz.
pub const ROWS: f64 = 60.0;
/// Largest cut-off of the rows over the motion's: what is smoothed away of the acceleration alone must not be in the rows.
const BELOW: f64 = 0.6;
/// Noise of the acceleration, over its own root mean square, that is let pass.
const NOISE: f64 = 0.05;
/// Cut-off over the sampling rate that is let pass.
const SHARE: f64 = 0.125;

/// What a trace without a design tells.
pub struct Told {
    /// The answer.
    pub answer: Calibration,
    /// What its page draws.
    pub picture: Picture,
    /// What limits it.
    pub findings: Vec<Finding>,
    /// The controller as the trace shows it.
    pub controller: Option<SeenController>,
    /// What firmware takes of it.
    pub drive: Drive,
}

/// A trace with its motion and its rows.
struct Filtered<'a> {
    trace: &'a Trace,
    motion: Motion,
    rows: Rows,
}

impl<'a> Filtered<'a> {
    fn new(trace: &'a Trace, filters: &Filters) -> Result<Self, Failure> {
        let motion = motion(trace, filters.smoothing)?;
        let highest = BELOW * motion.cutoff;
        let cutoff = filters.rows.unwrap_or_else(|| ROWS.min(highest));
        let settings = RowSettings {
            cutoff: Some(cutoff),
            ..RowSettings::default()
        };
        Ok(Self {
            trace,
            motion,
            rows: Rows::of_trace(trace, &settings)?,
        })
    }

    /// The plain model.
    fn plain(&self, terms: Terms) -> Slide<'_> {
        Slide::new(self.trace, &self.motion, &self.rows, LAWS[0], terms)
    }

    /// The speed of a trace that moves at one, and the terms that it may tell, with what it may not.
    fn possible(&self) -> (Option<f64>, Terms, Vec<String>) {
        let speed = one_speed(self.trace, &self.motion, &rests(self.trace));
        let (load, untold) = losses::possible(self.trace, &self.motion);
        let terms = Terms {
            one_speed: speed.is_some(),
            load,
            ..Terms::default()
        };
        (speed, terms, untold)
    }

    /// The plain model with what the trace tells of it.
    fn plainly(&self) -> Result<Plainly, Failure> {
        let (speed, mut terms, mut untold) = self.possible();
        let mut fit = literature(&self.plain(terms))?;
        let mut sure = uncertainty(&self.plain(terms), &fit);
        let (load, too_wide) = losses::told(terms.load, &sure);
        if load != terms.load {
            terms.load = load;
            fit = literature(&self.plain(terms))?;
            sure = uncertainty(&self.plain(terms), &fit);
        }
        untold.extend(too_wide);
        untold.extend(losses::alike(terms.load, &sure));
        Ok(Plainly {
            speed,
            terms,
            fit,
            sure,
            untold,
        })
    }

    fn prepared(&self, controller: Option<Controller>) -> Prepared<'_> {
        Prepared::new(self.trace, &self.motion, &self.rows, controller)
    }
}

/// The plain model of a trace.
struct Plainly {
    /// Its speed, where it moves at one.
    speed: Option<f64>,
    terms: Terms,
    fit: Fit,
    sure: Uncertainty,
    /// What of the losses is not told.
    untold: Vec<String>,
}

impl Plainly {
    fn answer(
        self,
        filtered: &Filtered<'_>,
        findings: &[Finding],
        rest: Vec<String>,
    ) -> Calibration {
        let trace = filtered.trace;
        Calibration {
            parameters: estimates(&self.sure),
            residual_rms: self.fit.residual_rms(),
            relative_error: size(&self.fit.residual) / size(&filtered.rows.of(&trace.effort)),
            effective_rows: self.sure.effective_rows,
            cannot_tell: [
                one_number(&self.sure, self.speed, trace.coordinate),
                ended_at_bound(&self.sure),
                self.untold,
                cannot_tell(trace, &filtered.motion, findings),
                rest,
            ]
            .concat(),
            models: Vec::new(),
            winner: None,
        }
    }
}

/// Motion with the cut-off that is wanted, or with the highest that the sensor's noise allows.
fn motion(trace: &Trace, wanted: Option<f64>) -> Result<Motion, Failure> {
    let smoothed = |cutoff| {
        let settings = SmoothingSettings {
            cutoff: Some(cutoff),
            ..SmoothingSettings::default()
        };
        Motion::of(trace, &settings)
    };
    if let Some(cutoff) = wanted {
        return smoothed(cutoff);
    }
    let highest = SHARE / trace.step;
    for cutoff in SMOOTHING.into_iter().filter(|cutoff| *cutoff <= highest) {
        let motion = smoothed(cutoff)?;
        if motion.noise[1] <= NOISE * size(&motion.acceleration) {
            return Ok(motion);
        }
    }
    smoothed(SMOOTHING[SMOOTHING.len() - 1].min(highest))
}

/// A trace with what is found of its known effort.
fn with_known<'a>(trace: &'a Trace, filters: &Filters) -> Result<Cow<'a, Trace>, Failure> {
    if trace.known.is_none() {
        return Ok(Cow::Borrowed(trace));
    }
    Ok(placed(trace, &motion(trace, filters.smoothing)?))
}

/// Refuses a trace that cannot score what was fitted to the other.
fn comparable(trace: &Trace, other: &Trace) -> Result<(), Failure> {
    let (one, two) = (&trace.name, &other.name);
    if other.coordinate != trace.coordinate {
        return Err(Failure::Data(format!(
            "{one} and {two} are not of one coordinate: one is of an angle and a torque, one of a travel and a force"
        )));
    }
    let load = |trace: &Trace| (trace.load.is_some(), trace.load_is_effort);
    if load(other) != load(trace) {
        return Err(Failure::Data(format!(
            "{one} and {two} have not the same load's channel: one cannot score the other's models; an effort that only one of them has is given as known_torque or known_force"
        )));
    }
    Ok(())
}

/// Fits what a trace can tell without a design: a mass or an inertia with friction, losses in proportion to a load where one is measured,
/// and models of friction beside each other.
///
/// # Errors
/// A trace from which nothing can be told.
pub fn calibrate(
    trace: &Trace,
    unseen: Option<&Trace>,
    controller: Option<Controller>,
    filters: &Filters,
) -> Result<Told, Failure> {
    let trace = &*with_known(trace, filters)?;
    let filtered = Filtered::new(trace, filters)?;
    let findings = examine(trace, &filtered.motion)?;
    let prepared = filtered.prepared(controller);
    let other = unseen
        .map(|other| comparable(trace, other).and_then(|()| with_known(other, filters)))
        .transpose()?;
    let other = other
        .as_deref()
        .map(|other| Filtered::new(other, filters))
        .transpose()?;
    let other = other.as_ref().map(|other| other.prepared(controller));

    let plainly = filtered.plainly()?;
    let terms_of_laws = if plainly.terms.one_speed {
        plainly.terms
    } else {
        terms(&prepared, plainly.terms.load)
    };
    let (models, mut rest) = compared(&prepared, other.as_ref(), plainly.terms, terms_of_laws);
    rest.extend(prepared.controller.as_ref().and_then(SeenController::doubt));
    let picture = picture(&prepared, terms_of_laws, &plainly.sure)?;
    let drive = Drive::of(&prepared, plainly.terms, &plainly.sure);
    let controller = prepared.controller.clone();
    let mut answer = plainly.answer(&filtered, &findings, rest);
    answer.models = models;
    answer.winner = rank(&mut answer.models);
    Ok(Told {
        answer,
        picture,
        findings,
        controller,
        drive,
    })
}

/// Models beside each other, and what is said of those that could not be fitted.
fn compared(
    prepared: &Prepared<'_>,
    other: Option<&Prepared<'_>>,
    plain: Terms,
    all: Terms,
) -> (Vec<ModelScore>, Vec<String>) {
    let (mut models, mut untold) = (Vec::new(), Vec::new());
    let mut add =
        |law: Law, terms: Terms, name: &str| match model(prepared, other, law, terms, name) {
            Ok(fitted) => models.push(fitted.score),
            Err(Failure::Data(why)) => untold.push(left_out(name, &why)),
            Err(_) => {}
        };
    let without_losses = Terms {
        load: plain.load.without_losses(),
        ..plain
    };
    add(LAWS[0], without_losses, PLAIN);
    if plain.load.loses() && !plain.one_speed {
        add(LOAD_PROPORTIONAL, plain, LOAD_PROPORTIONAL.name);
    }
    // At one speed there is nothing to be compared.
    for law in LAWS.into_iter().filter(|_| !plain.one_speed) {
        let name = if law.name == PLAIN {
            format!("{PLAIN}, with the drive's other terms")
        } else {
            law.name.into()
        };
        add(law, all, &name);
    }
    let ours = LAWS[LAWS.len() - 1];
    if all.period.is_some() {
        let without = Terms {
            period: None,
            position: false,
            ..all
        };
        let name = format!("{}, without terms of the position", ours.name);
        add(ours, without, &name);
    }
    (models, untold)
}

/// The fit of the plain model as the literature has it: by least squares, without weights.
fn literature(slide: &Slide<'_>) -> Result<Fit, Failure> {
    let settings = FitSettings {
        robust: false,
        ..FitSettings::default()
    };
    fit(slide, &settings).map_err(|error| Failure::Data(error.to_string()))
}

/// The plain model of one trace of many, and what it adds to the others.
///
/// # Errors
/// A trace from which nothing can be told.
pub fn plain(trace: &Trace, filters: &Filters) -> Result<(Calibration, Answered), Failure> {
    let trace = &*with_known(trace, filters)?;
    let filtered = Filtered::new(trace, filters)?;
    let findings = examine(trace, &filtered.motion)?;
    let plainly = filtered.plainly()?;
    // Traces at several speeds tell together what each of them cannot. What an axial load does to a torque is left out: its gain
    // is no number of the friction.
    let load = match plainly.terms.load {
        LoadTerm::Losses { .. } => plainly.terms.load,
        LoadTerm::None | LoadTerm::Gain | LoadTerm::LossAlike => LoadTerm::None,
    };
    let slide = filtered.plain(Terms {
        load,
        ..Terms::default()
    });
    let whole = literature(&slide)?;
    let sure = uncertainty(&slide, &whole);
    let answered = Answered::of(&whole.residual, &sure, false)?;
    Ok((plainly.answer(&filtered, &findings, Vec::new()), answered))
}

/// Sets the least information criterion to zero; the name of the model that does best on what was not fitted.
fn rank(models: &mut [ModelScore]) -> Option<String> {
    let least = models
        .iter()
        .map(|model| model.information_criterion)
        .fold(f64::INFINITY, f64::min);
    for model in models.iter_mut() {
        model.information_criterion -= least;
    }
    models
        .iter()
        .min_by(|one, other| {
            let error = |model: &ModelScore| model.relative_error_unseen.unwrap_or(f64::INFINITY);
            error(one).total_cmp(&error(other))
        })
        .map(|model| model.name.clone())
}

/// The sentence of a trace that moves at one speed.
fn one_number(sure: &Uncertainty, speed: Option<f64>, coordinate: Coordinate) -> Vec<String> {
    let mut intervals = sure.intervals.iter();
    let found = intervals.find(|interval| interval.name == AT_ONE_SPEED);
    let (Some(speed), Some(found)) = (speed, found) else {
        return Vec::new();
    };
    let unit = match coordinate {
        Coordinate::Rotation => "rad/s",
        Coordinate::Translation => "m/s",
    };
    vec![format!(
        "the trace moves at one speed: Coulomb and viscous friction are one number, {} {} at {} {unit}; move at several speeds, over a factor of three or more, to tell them apart",
        digits(found.value, 3),
        found.unit,
        digits(speed, 3),
    )]
}

/// Sentences of what ended at its bound.
fn ended_at_bound(sure: &Uncertainty) -> Vec<String> {
    let ended = sure.intervals.iter().filter(|interval| interval.at_bound);
    let sentences = ended.map(|interval| {
        format!(
            "{}: ended at its bound of {}, and is not told; what is estimated beside it can be off by more than its interval",
            interval.name.replace('_', " "),
            digits(interval.value, 3)
        )
    });
    sentences.collect()
}

/// What a trace without a design cannot tell.
fn cannot_tell(trace: &Trace, motion: &Motion, findings: &[Finding]) -> Vec<String> {
    // Load, temperature, reversals and one speed are told elsewhere, with what would help.
    let told = |kind: FindingKind| match kind {
        FindingKind::NoLoad => trace.load.is_none(),
        FindingKind::ConstantTemperature => trace.temperature.is_none(),
        FindingKind::FewReversals | FindingKind::ConstantSpeed => true,
        _ => false,
    };
    let mut sentences: Vec<String> = findings
        .iter()
        .filter(|finding| !told(finding.kind))
        .map(|finding| finding.message.clone())
        .collect();
    if trace.load.is_none() {
        sentences.push(
            "friction coefficient, preload and rolling resistance: no load is measured; measure the axial load, at two loads or more, and give the screw's design; without a design its torque (load_torque) or force tells the losses in proportion to it".into(),
        );
    }
    if trace.temperature.is_none() {
        sentences.push(
            "how friction follows the temperature: no temperature is measured; measure it over 30 K or more".into(),
        );
    }
    let Reversals { count, loops } = reversals(motion);
    if loops == 0 {
        sentences.push(format!(
            "which law of friction in a reversal holds: {count} reversals and no minor loop; measure small turns to and fro around standstill, of a tenth to four breakaways"
        ));
    }
    sentences.push(
        "a Coulomb friction that differs between the directions: it is one number with the offset; turn the drive round, or measure the offset alone"
            .into(),
    );
    sentences
}

/// Reversals of a motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Reversals {
    /// How many.
    count: usize,
    /// How many of them turn back within a hundredth of the whole travel.
    loops: usize,
}

/// Reversals with more travel between them than the noise has; a minor loop is a pair of them that is close together.
fn reversals(motion: &Motion) -> Reversals {
    let low = motion
        .position
        .iter()
        .copied()
        .fold(f64::INFINITY, f64::min);
    let high = motion
        .position
        .iter()
        .copied()
        .fold(f64::NEG_INFINITY, f64::max);
    let travel = high - low;
    // What is below a hundred-thousandth of the travel is taken for noise.
    let dead = 1e-5 * travel;
    let mut places: Vec<f64> = Vec::new();
    let (mut extreme, mut direction) = (motion.position.first().copied().unwrap_or(0.0), 0.0);
    for position in &motion.position {
        let moved = position - extreme;
        if direction == 0.0 {
            if moved.abs() > dead {
                (direction, extreme) = (moved.signum(), *position);
            }
        } else if moved * direction > 0.0 {
            extreme = *position;
        } else if moved.abs() > dead {
            places.push(extreme);
            (direction, extreme) = (-direction, *position);
        }
    }
    Reversals {
        count: places.len(),
        loops: places
            .windows(2)
            .filter(|pair| (pair[1] - pair[0]).abs() < 0.01 * travel)
            .count(),
    }
}

/// What the page draws: the crate's model with memory over the whole trace, or the plain one where that cannot be fitted.
fn picture(prepared: &Prepared<'_>, terms: Terms, sure: &Uncertainty) -> Result<Picture, Failure> {
    let of = |law: Law, terms: Terms| {
        let slide = Slide::new(prepared.trace, prepared.motion, prepared.rows, law, terms);
        fit(&slide, &FitSettings::default()).map(|fit| (slide, fit))
    };
    let (slide, fit) = if terms.one_speed {
        of(LAWS[0], terms)?
    } else {
        of(LAWS[LAWS.len() - 1], terms).or_else(|_| of(LAWS[0], Terms::default()))?
    };
    let measured = (slide.target().to_vec(), &*fit.residual);
    let (trace, motion) = (prepared.trace, prepared.motion);
    let samples: Vec<usize> = prepared.rows.samples(trace.len()).collect();
    Ok(Picture::of(trace, motion, &samples, measured, sure))
}

#[cfg(test)]
mod tests;
