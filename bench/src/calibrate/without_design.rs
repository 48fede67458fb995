//! Calibration of a trace without a design.
//!
//! | module | what |
//! |---|---|
//! | [`choice`] | models of friction on a trace without a design |
//! | [`slide`] | such a trace as a separable problem |
//! | [`period`] | the period of a wave over the travel |
//! | [`closed_loop`] | the motion that a controller makes of a model |
//! | [`controller`] | the controller that is seen in a trace |

pub mod choice;
pub mod closed_loop;
pub mod controller;
pub mod period;
pub mod slide;

use crate::calibrate::answer::{Calibration, ModelScore};
use crate::calibrate::checks::examine;
use crate::calibrate::checks::excitation::one_speed;
use crate::calibrate::checks::finding::{Finding, FindingKind};
use crate::calibrate::fit::problem::Separable;
use crate::calibrate::fit::separable::{Fit, FitSettings, fit};
use crate::calibrate::fit::uncertainty::{Uncertainty, uncertainty};
use crate::calibrate::laws::Law;
use crate::calibrate::page::picture::{Correlations, Picture};
use crate::calibrate::page::shown::digits;
use crate::calibrate::signals::{Motion, RowSettings, Rows, SmoothingSettings};
use crate::calibrate::sums::{Reference, Sums, SumsError};
use crate::calibrate::trace::rests::rests;
use crate::calibrate::trace::{Coordinate, Trace};
use crate::calibrate::without_design::choice::{
    LAWS, PLAIN, Prepared, estimates, left_out, model, terms,
};

use crate::calibrate::without_design::closed_loop::size;
use crate::calibrate::without_design::controller::SeenController;
use crate::calibrate::without_design::slide::{AT_ONE_SPEED, Slide, Terms};
use crate::controller::Controller;
use crate::failure::Failure;

/// How a trace is filtered.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Filters {
    /// Cut-off of the motion, Hz; `None` for the highest of [`SMOOTHING`] at which noise of the sensor is lost in the acceleration.
    pub smoothing: Option<f64>,
    /// Cut-off of the rows, Hz; `None` for [`ROWS`], or an eighth of the sampling rate where that is less.
    pub rows: Option<f64>,
}

/// Cut-offs of the motion that are tried, Hz.
pub const SMOOTHING: [f64; 4] = [100.0, 60.0, 40.0, 25.0];
/// Cut-off of the rows, Hz.
pub const ROWS: f64 = 60.0;
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
}

/// A trace with its motion and its rows.
struct Filtered<'a> {
    trace: &'a Trace,
    motion: Motion,
    rows: Rows,
}

impl<'a> Filtered<'a> {
    fn new(trace: &'a Trace, filters: &Filters) -> Result<Self, Failure> {
        let cutoff = filters.rows.unwrap_or_else(|| ROWS.min(SHARE / trace.step));
        let settings = RowSettings {
            cutoff: Some(cutoff),
            ..RowSettings::default()
        };
        Ok(Self {
            trace,
            motion: motion(trace, filters.smoothing)?,
            rows: Rows::of_trace(trace, &settings)?,
        })
    }

    /// The plain model.
    fn plain(&self, terms: Terms) -> Slide<'_> {
        Slide::new(self.trace, &self.motion, &self.rows, LAWS[0], terms)
    }

    /// The speed of a trace that moves at one, and the terms that it can tell.
    fn one_speed(&self) -> (Option<f64>, Terms) {
        let speed = one_speed(self.trace, &self.motion, &rests(self.trace));
        let terms = Terms {
            one_speed: speed.is_some(),
            ..Terms::default()
        };
        (speed, terms)
    }

    fn prepared(&self, controller: Option<Controller>) -> Prepared<'_> {
        Prepared::new(self.trace, &self.motion, &self.rows, controller)
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

/// Fits what a trace can tell without a design: a mass or an inertia with friction that knows no load, and models of friction beside each
/// other.
///
/// # Errors
/// A trace from which nothing can be told.
pub fn calibrate(
    trace: &Trace,
    unseen: Option<&Trace>,
    controller: Option<Controller>,
    filters: &Filters,
) -> Result<Told, Failure> {
    let filtered = Filtered::new(trace, filters)?;
    let findings = examine(trace, &filtered.motion)?;
    let prepared = filtered.prepared(controller);
    if let Some(other) = unseen.filter(|other| other.coordinate != trace.coordinate) {
        return Err(Failure::Data(format!(
            "{} and {} are not of one coordinate: one is of an angle and a torque, one of a travel and a force",
            trace.name, other.name
        )));
    }
    let other = unseen
        .map(|other| Filtered::new(other, filters))
        .transpose()?;
    let other = other.as_ref().map(|other| other.prepared(controller));

    let (speed, plain) = filtered.one_speed();
    let slide = filtered.plain(plain);
    let whole = literature(&slide)?;
    let sure = uncertainty(&slide, &whole);

    let all = if plain.one_speed {
        plain
    } else {
        terms(&prepared)
    };
    let (mut models, mut untold) = (Vec::new(), Vec::new());
    let mut add = |law: Law, terms: Terms, name: &str| match model(
        &prepared,
        other.as_ref(),
        law,
        terms,
        name,
    ) {
        Ok(fitted) => models.push(fitted.score),
        Err(Failure::Data(why)) => untold.push(left_out(name, &why)),
        Err(_) => {}
    };
    add(LAWS[0], plain, PLAIN);
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
    let winner = rank(&mut models);
    untold.extend(prepared.controller.as_ref().and_then(SeenController::doubt));
    let answer = Calibration {
        parameters: estimates(&sure),
        residual_rms: whole.residual_rms(),
        relative_error: size(&whole.residual) / size(slide.target()),
        effective_rows: sure.effective_rows,
        cannot_tell: [
            one_number(&sure, speed, trace.coordinate),
            ended_at_bound(&sure),
            cannot_tell(trace, &filtered.motion, &findings),
            untold,
        ]
        .concat(),
        models,
        winner,
    };
    let picture = picture(&prepared, all, &sure)?;
    let controller = prepared.controller.clone();
    Ok(Told {
        answer,
        picture,
        findings,
        controller,
    })
}

/// The fit of the plain model as the literature has it: by least squares, without weights.
fn literature(slide: &Slide<'_>) -> Result<Fit, Failure> {
    let settings = FitSettings {
        robust: false,
        ..FitSettings::default()
    };
    fit(slide, &settings).map_err(|error| Failure::Data(error.to_string()))
}

/// The plain model of one trace of many, and its sums.
///
/// # Errors
/// A trace from which nothing can be told.
pub fn plain(trace: &Trace, filters: &Filters) -> Result<(Calibration, Sums), Failure> {
    let filtered = Filtered::new(trace, filters)?;
    let findings = examine(trace, &filtered.motion)?;
    // Traces at several speeds tell together what each of them cannot.
    let slide = filtered.plain(Terms::default());
    let whole = literature(&slide)?;
    let sure = uncertainty(&slide, &whole);
    let references = slide.linear().iter().map(|parameter| Reference {
        name: parameter.name.into(),
        logarithmic: false,
        value: 0.0,
    });
    let refused = |error: SumsError| Failure::Data(error.to_string());
    let mut sums = Sums::new(references.collect()).map_err(refused)?;
    sums.add(&whole, &sure).map_err(refused)?;
    let (speed, terms) = filtered.one_speed();
    let slide = filtered.plain(terms);
    let whole = literature(&slide)?;
    let sure = uncertainty(&slide, &whole);
    let answer = Calibration {
        parameters: estimates(&sure),
        residual_rms: whole.residual_rms(),
        relative_error: size(&whole.residual) / size(slide.target()),
        effective_rows: sure.effective_rows,
        cannot_tell: [
            one_number(&sure, speed, trace.coordinate),
            ended_at_bound(&sure),
            cannot_tell(trace, &filtered.motion, &findings),
        ]
        .concat(),
        models: Vec::new(),
        winner: None,
    };
    Ok((answer, sums))
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
            "{}: ended at its bound of {}, and is not told",
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
            "friction coefficient, preload and rolling resistance: no load is measured; measure the axial load, at two loads or more, and give the screw's design".into(),
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
    /// How many of them turn back within a hundredth of the whole way.
    loops: usize,
}

/// Reversals with more way between them than the noise has; a minor loop is a pair of them that is close together.
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
    let way = high - low;
    // What is below a hundred-thousandth of the way is taken for noise.
    let dead = 1e-5 * way;
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
            .filter(|pair| (pair[1] - pair[0]).abs() < 0.01 * way)
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
    let trace = prepared.trace;
    let samples: Vec<usize> = prepared.rows.samples(trace.len()).collect();
    let at =
        |signal: &[f64]| -> Vec<f64> { samples.iter().map(|sample| signal[*sample]).collect() };
    let measured = slide.target().to_vec();
    let model = measured
        .iter()
        .zip(&fit.residual)
        .map(|(measured, residual)| measured - residual)
        .collect();
    let names = sure
        .intervals
        .iter()
        .map(|interval| interval.name.to_string());
    let rows = sure.correlation.row_iter();
    Ok(Picture {
        name: trace.name.clone(),
        coordinate: trace.coordinate,
        time: samples
            .iter()
            .map(|sample| trace.start + trace.step * *sample as f64)
            .collect(),
        measured,
        model,
        position: at(&prepared.motion.position),
        speed: at(&prepared.motion.speed),
        load: trace.load.as_deref().map(&at),
        temperature: trace.temperature.as_deref().map(&at),
        profiles: Vec::new(),
        correlations: Correlations {
            names: names.collect(),
            rows: rows.map(|row| row.iter().copied().collect()).collect(),
        },
    })
}

#[cfg(test)]
mod tests;
