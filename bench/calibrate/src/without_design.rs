//! Calibration of a trace without a design: the estimator's numbers, its words, and models of friction beside each other.

pub(crate) mod closed_loop;
pub(crate) mod controller;
pub(crate) mod drive;
pub(crate) mod models;
pub(crate) mod slide;

use std::borrow::Cow;

use crate::answer::{Calibration, Estimate};
use crate::controller::Controller;
use crate::estimator::choice::{self, Wanted, estimate};
use crate::estimator::fit::Block;
use crate::estimator::record::Record;
use crate::estimator::terms::Term;
use crate::estimator::words::diagnose;
use crate::folder::answered::Answered;
use crate::folder::population::HALF_INTERVAL;
use crate::page::picture::Picture;
use crate::page::shown::digits;
use crate::trace::KnownEffort;
use crate::trace::{Coordinate, Trace};
use crate::without_design::controller::SeenController;
use crate::without_design::drive::Drive;
use crate::without_design::slide::{Beside, Prepared};
use epas_page::failure::Failure;

/// What a trace without a design tells.
pub struct Told {
    /// The answer.
    pub answer: Calibration,
    /// What its page draws.
    pub picture: Picture,
    /// The controller as the trace shows it.
    pub controller: Option<SeenController>,
    /// What firmware takes of it.
    pub drive: Drive,
}

/// Fits what a trace can tell without a design: a mass or an inertia with friction, losses in proportion to a load where one is measured,
/// and models of friction beside each other, scored on another trace or on the last third of this one.
pub fn calibrate(
    trace: &Trace,
    unseen: Option<&Trace>,
    controller: Option<Controller>,
) -> Result<Told, Failure> {
    let trace = &*placed(trace);
    let unseen = unseen
        .map(|other| comparable(trace, other).map(|()| placed(other)))
        .transpose()?;
    let record = record(trace);
    let (found, words, wave) = told(&record, trace)?;
    let mut answer = answer(&record, trace, &found, words);
    let beside = Beside {
        rich: true,
        position: true,
        wave,
        load: loads(&found.terms),
    };
    let prepared = Prepared::new(trace, &record, found.length);
    let seen = |trace: &Trace, record: &Record| {
        controller.and_then(|controller| SeenController::of(controller, trace, record))
    };
    let own = seen(trace, &record);
    let other = unseen.as_deref().map(|other| (other, self::record(other)));
    let other_controller = other
        .as_ref()
        .and_then(|(other, record)| seen(other, record));
    let other = other
        .as_ref()
        .map(|(other, record)| Prepared::new(other, record, found.length));
    // At one speed there is nothing to be compared.
    if found.of(Term::Coulomb).is_some() {
        let unseen = other
            .as_ref()
            .map(|other| (other, other_controller.as_ref()));
        let scores = models::scores((&prepared, own.as_ref()), unseen, &beside);
        answer.compare(scores.into_iter());
    }
    answer
        .cannot_tell
        .extend(own.as_ref().and_then(SeenController::doubt));
    Ok(Told {
        picture: picture(&record, trace, &found),
        drive: drive(&prepared, &beside, &answer.parameters),
        controller: own,
        answer,
    })
}

fn drive(prepared: &Prepared<'_>, beside: &Beside, told: &[Estimate]) -> Drive {
    let slides = told.iter().any(|one| one.name == "coulomb_friction");
    let reversal = slides.then(|| models::reversal_speed(prepared, beside).ok().flatten());
    let load = prepared.trace.load.as_deref().unwrap_or_default();
    Drive {
        coordinate: prepared.trace.coordinate,
        estimates: told.to_vec(),
        reversal_speed: reversal.flatten(),
        largest: [&prepared.motion.speed, load].map(largest),
    }
}

/// Largest size.
pub fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |most, value| most.max(value.abs()))
}

/// One trace of many, and what it adds to the others: numbers of the drive itself, without the gain of a load's channel and the friction at
/// one speed.
pub fn plain(trace: &Trace) -> Result<(Calibration, Answered), Failure> {
    let trace = &*placed(trace);
    let record = record(trace);
    let (found, words, _) = told(&record, trace)?;
    let answer = answer(&record, trace, &found, words);
    let own = |term: &Term| {
        matches!(
            term,
            Term::Inertia
                | Term::Viscous
                | Term::Offset
                | Term::Coulomb
                | Term::Driving
                | Term::BackDriving
        )
    };
    let places: Vec<usize> = (0..found.terms.len())
        .filter(|k| own(&found.terms[*k]))
        .collect();
    if places.is_empty() {
        return Err(Failure::Data(format!(
            "{}: it moves at one speed in one direction, and adds no number to other traces; give a folder of three such runs or more",
            trace.name
        )));
    }
    // What other kernels say otherwise stretches each deviation of the jackknife to the interval's.
    let deviation = |k: usize| found.half_widths[k] / HALF_INTERVAL;
    let covariance = &found.fit.covariance;
    let entry = |i: usize, j: usize| {
        let both = (covariance[(i, i)] * covariance[(j, j)]).sqrt();
        covariance[(i, j)] / both * deviation(i) * deviation(j)
    };
    let answered = Answered {
        with_design: false,
        names: places
            .iter()
            .map(|k| found.terms[*k].name(trace.coordinate).into())
            .collect(),
        logarithmic: vec![false; places.len()],
        values: places.iter().map(|k| found.values[*k]).collect(),
        covariance: places
            .iter()
            .flat_map(|i| places.iter().map(|j| entry(*i, *j)))
            .collect(),
        model_errors: vec![0.0; places.len()],
    };
    Ok((answer, answered.checked().map_err(Failure::Data)?))
}

/// A trace as the estimator takes it.
pub fn record(trace: &Trace) -> Record {
    Record::of(trace, &[])
}

/// The trace with what is found of its known effort: whether the motor's effort holds it already. Some recorders add it, because it is made
/// at the controller's output; others do not: whichever explains the motion better.
pub fn placed(trace: &Trace) -> Cow<'_, Trace> {
    let Some(known) = &trace.known else {
        return Cow::Borrowed(trace);
    };
    let with = |in_effort: bool| {
        let mut other = trace.clone();
        other.known = Some(KnownEffort {
            in_effort,
            ..known.clone()
        });
        let record = record(&other);
        let left = estimate(&[record], &Wanted::default());
        let left = left.map_or(f64::INFINITY, |found| found.fit.residual_rms);
        (other, left)
    };
    let ((mut beside, left_beside), (mut within, left_within)) = (with(false), with(true));
    let (found, word) = if left_within < left_beside {
        (
            &mut within,
            "the known effort stands in the motor's effort already: with it added once more, the motion is explained worse",
        )
    } else {
        (
            &mut beside,
            "the known effort acts beside the motor's effort",
        )
    };
    found.repairs.notes.push(word.into());
    Cow::Owned(found.clone())
}

/// Refuses a trace that cannot score what was fitted to the other.
pub fn comparable(trace: &Trace, other: &Trace) -> Result<(), Failure> {
    let (one, two) = (&trace.name, &other.name);
    if other.coordinate != trace.coordinate {
        return Err(Failure::Data(format!(
            "{one} and {two} are not of one coordinate: one is of an angle and a torque, one of a travel and a force"
        )));
    }
    let load = |trace: &Trace| (trace.load.is_some(), trace.load_is_effort);
    if load(other) != load(trace) {
        return Err(Failure::Data(format!(
            "{one} and {two} have not the same load's channel (axial_load or load_torque): one cannot score the other's models; an effort that only one of them has is given as known_torque or known_force"
        )));
    }
    Ok(())
}

fn told(
    record: &Record,
    trace: &Trace,
) -> Result<(choice::Estimate, Vec<String>, Option<f64>), Failure> {
    let found = diagnose(record, trace).map_err(Failure::Data)?;
    Ok((found.estimate, found.words, found.wave))
}

fn loads(terms: &[Term]) -> Vec<Term> {
    let load = [Term::Driving, Term::BackDriving, Term::Gain, Term::Loss];
    load.into_iter()
        .filter(|term| terms.contains(term))
        .collect()
}

fn estimates(found: &choice::Estimate, coordinate: Coordinate) -> Vec<Estimate> {
    let told = found.terms.iter().zip(&found.values);
    told.zip(&found.half_widths)
        .map(|((term, value), half)| {
            Estimate::told(term.name(coordinate), term.unit(coordinate), *value, *half)
        })
        .collect()
}

fn answer(
    record: &Record,
    trace: &Trace,
    found: &choice::Estimate,
    words: Vec<String>,
) -> Calibration {
    let mut cannot_tell = words;
    cannot_tell.extend(trace.told());
    cannot_tell.extend(untold(record, trace, found));
    of_estimate(found, trace.coordinate, cannot_tell)
}

/// The numbers of an estimate as an answer.
pub fn of_estimate(
    found: &choice::Estimate,
    coordinate: Coordinate,
    cannot_tell: Vec<String>,
) -> Calibration {
    Calibration {
        parameters: estimates(found, coordinate),
        residual_rms: found.fit.residual_rms,
        relative_error: found.fit.relative,
        effective_rows: largest(&found.fit.pieces),
        cannot_tell,
        ..Calibration::default()
    }
}

pub(crate) const OF_ONE_SIZE: &str = "losses in proportion to the load: it keeps its size; the friction and the offset hold what is lost at this load, and are right at it alone; change the load";

/// What the trace does not tell, and what would.
fn untold(record: &Record, trace: &Trace, found: &choice::Estimate) -> Vec<String> {
    let has = |term: Term| found.of(term).is_some();
    let mut sentences = Vec::new();
    if let Some((friction, _)) = found.of(Term::OneSpeed) {
        let speed = record.speed_of_motion();
        let [effort, per] = match trace.coordinate {
            Coordinate::Rotation => ["N m", "rad/s"],
            Coordinate::Translation => ["N", "m/s"],
        };
        sentences.push(format!(
            "the trace moves at one speed: Coulomb and viscous friction are one number, {} {effort} at {} {per}; move at several speeds, over a factor of three or more, or give a folder of runs, to tell them apart",
            digits(friction, 3),
            digits(speed, 3),
        ));
    }
    if !has(Term::Inertia) {
        sentences.push(
            "inertia: what accelerates is below the sensor's noise; accelerate harder".into(),
        );
    }
    if has(Term::Offset) {
        let zero = if trace.load.is_some() {
            " and a zero error of the load's channel: they are"
        } else {
            ": it is"
        };
        sentences.push(format!("a Coulomb friction that differs between the directions{zero} one number with the offset; turn the drive round, or measure the offset alone"));
    } else {
        sentences.push("offset: the motion goes one way, and it is one number with the friction; move both ways".into());
    }
    let losses = [Term::Driving, Term::BackDriving].map(has);
    match (&trace.load, trace.load_is_effort) {
        (None, _) => sentences.push("losses in proportion to a load: none is measured; measure its torque (load_torque) or force".into()),
        (Some(_), true) if losses == [false; 2] => sentences.push(OF_ONE_SIZE.into()),
        (Some(_), true) if losses != [true; 2] => {
            let (name, side) = if losses[0] {
                ("back_driving_loss", "assists")
            } else {
                ("driving_loss", "opposes")
            };
            sentences.push(format!("{name}: no load that changes {side} the motion"));
        }
        (Some(_), false) if !has(Term::Loss) => sentences.push(OF_ONE_SIZE.into()),
        _ => {}
    }
    sentences
}

fn picture(record: &Record, trace: &Trace, found: &choice::Estimate) -> Picture {
    let rows = found.rows.first().and_then(Option::as_ref);
    let centres = rows.map_or(&[][..], |rows| &rows.centres);
    let target = |rows| Block::of(record, rows, &found.terms).target;
    let measured = rows.map_or_else(Vec::new, target);
    let names = found
        .terms
        .iter()
        .map(|term| term.name(trace.coordinate).into());
    let errors = (names.collect(), &found.fit.covariance);
    Picture::of(trace, centres, (measured, &found.fit.residual), errors)
}
