//! Models of friction on one trace without a design: each fitted as well as it can be, and scored on what was not fitted.

use crate::answer::{Estimate, ModelScore};
use crate::estimator::words::strongest_wave;
use crate::fit::part::{Part, residual};
use crate::fit::problem::Separable;
use crate::fit::separable::{Fit, FitSettings, fit};
use crate::fit::uncertainty::{Uncertainty, uncertainty};
use crate::laws::cost::cycles;
use crate::laws::{Cost, Law, Level, Passage};
use crate::without_design::closed_loop::{Course, Loop};
use crate::without_design::controller::SeenController;
use crate::without_design::slide::{Beside, Prepared, Slide, size};
use epas_page::failure::Failure;

/// Share of the rows that is fitted where no other trace scores the models.
const FITTED: f64 = 2.0 / 3.0;

const fn law(name: &'static str, level: Level, passage: Passage, cost: Cost) -> Law {
    Law {
        name,
        level,
        passage,
        cost,
    }
}

/// Laws that are compared: those of the literature, and the crate's without and with memory.
pub const LAWS: [Law; 6] = [
    law(
        "Coulomb and viscous",
        Level::Constant,
        Passage::AtOnce,
        Cost::Estimated(10),
    ),
    law(
        "Stribeck",
        Level::Stribeck,
        Passage::AtOnce,
        Cost::Counted(&["stribeck_curve"]),
    ),
    law("Dahl", Level::Constant, Passage::Dahl, Cost::Estimated(38)),
    law(
        "LuGre",
        Level::Stribeck,
        Passage::LuGre,
        Cost::Counted(&["lugre_step"]),
    ),
    law(
        "this crate, without memory",
        Level::LoadShare,
        Passage::Speed,
        Cost::Counted(&["friction_coefficient"]),
    ),
    law(
        "this crate, with memory",
        Level::LoadShare,
        Passage::Elements,
        Cost::Counted(&["friction_coefficient", "memory_8"]),
    ),
];

/// The friction of the crate's scene for a drive without a drawing: constant, in proportion to the load, passing with the speed.
pub const LOAD_PROPORTIONAL: Law = law(
    "this crate, load-proportional losses",
    Level::Constant,
    Passage::Speed,
    Cost::Counted(&["step_load_proportional"]),
);

/// A trace on which models are compared, with its controller.
pub type Compared<'a> = (&'a Prepared<'a>, Option<&'a SeenController>);

/// Models beside each other, and what is said of those that could not be fitted.
pub fn scores(
    fitted: Compared<'_>,
    unseen: Option<Compared<'_>>,
    beside: &Beside,
) -> (Vec<ModelScore>, Vec<String>) {
    let plain = Beside {
        wave: beside.wave,
        load: beside.load.clone(),
        ..Beside::default()
    };
    let shown = Beside {
        wave: beside.wave.or_else(|| wave(fitted.0, beside)),
        ..beside.clone()
    };
    let still = Beside {
        position: false,
        wave: beside.wave,
        ..beside.clone()
    };
    let mut models = vec![(LAWS[0], &plain, LAWS[0].name.to_string())];
    if !beside.load.is_empty() {
        models.push((LOAD_PROPORTIONAL, &plain, LOAD_PROPORTIONAL.name.into()));
    }
    for law in LAWS {
        let name = match law.passage {
            Passage::AtOnce if law.level == Level::Constant => {
                format!("{}, with the drive's other terms", law.name)
            }
            _ => law.name.into(),
        };
        models.push((law, &shown, name));
    }
    let ours = LAWS[LAWS.len() - 1];
    let name = format!("{}, without terms of the position", ours.name);
    models.push((ours, &still, name));
    let (mut scores, mut untold) = (Vec::new(), Vec::new());
    for (law, beside, name) in models {
        match score(fitted, unseen, law, beside, &name) {
            Ok(score) => scores.push(score),
            Err(why) => untold.push(format!(
                "{name}: cannot be fitted to this trace, and is not compared; {why}."
            )),
        }
    }
    (scores, untold)
}

/// Share of the residual of the crate's law with memory that a wave of the position takes to be in the models.
const SHARE: f64 = 0.05;

/// The wave number of a wave over the position that the crate's law with memory leaves, 1/rad or 1/m.
fn wave(prepared: &Prepared<'_>, beside: &Beside) -> Option<f64> {
    let slide = Slide::new(prepared, LAWS[LAWS.len() - 1], beside.clone());
    let left = fitted(&slide, true).ok()?.residual;
    let places = prepared.places();
    let (wave, share) = strongest_wave(&places, &left)?;
    (share > SHARE).then_some(wave)
}

/// Sets the least information criterion to zero; the name of the model that does best on what was not fitted.
pub fn rank(models: &mut [ModelScore]) -> Option<String> {
    let least = models
        .iter()
        .map(|model| model.information_criterion)
        .fold(f64::INFINITY, f64::min);
    for model in models.iter_mut() {
        model.information_criterion -= least;
    }
    let error = |model: &ModelScore| model.relative_error_unseen.unwrap_or(f64::INFINITY);
    let best = models
        .iter()
        .min_by(|one, other| error(one).total_cmp(&error(other)));
    best.map(|model| model.name.clone())
}

/// A fit of a law to a trace.
///
/// # Errors
/// Why there is none.
pub fn fitted(problem: &dyn Separable, robust: bool) -> Result<Fit, String> {
    let settings = FitSettings {
        robust,
        starts: 2,
        finished: 1,
        ..FitSettings::default()
    };
    fit(problem, &settings).map_err(|error| error.to_string())
}

/// The loop closed with a fit.
fn course(
    (prepared, controller): Compared<'_>,
    slide: &Slide<'_>,
    fit: &Fit,
) -> Result<Option<Course>, String> {
    let Some(controller) = controller else {
        return Ok(None);
    };
    let resistance = slide
        .resistance(&fit.nonlinear, &fit.linear)
        .map_err(|error| error.to_string())?;
    let inertia = fit.linear.first().copied().unwrap_or(0.0);
    let closed = Loop {
        trace: prepared.trace,
        speed: prepared.motion.speed.first().copied().unwrap_or(0.0),
        controller,
    };
    Ok((inertia > 0.0).then(|| closed.run(inertia, resistance, slide.delay(&fit.nonlinear))))
}

/// Fits a model to a trace, and scores it on another trace, or on the last third of this one.
fn score(
    fitted_on: Compared<'_>,
    unseen: Option<Compared<'_>>,
    law: Law,
    beside: &Beside,
    name: &str,
) -> Result<ModelScore, String> {
    let (prepared, _) = fitted_on;
    let slide = Slide::new(prepared, law, beside.clone());
    let share = if unseen.is_some() { 1.0 } else { FITTED };
    let seen = Part::before(&slide, share);
    let fit = fitted(&seen, beside.rich)?;
    let uncertainty = uncertainty(&seen, &fit);
    let closed = course(fitted_on, &slide, &fit)?;
    let relative = |rows: &[f64], target: &[f64]| size(rows) / size(target);
    let seen_error = relative(&fit.residual, seen.target());
    let (unseen_rows, unseen_error, closed_unseen) = if let Some(other) = unseen {
        let slide = Slide::new(other.0, law, beside.clone());
        let rows = residual(&slide, &fit.nonlinear, &fit.linear);
        let error = relative(&rows, slide.target());
        let course = course(other, &slide, &fit)?;
        (rows, error, course.map(|course| course.relative_error))
    } else {
        let rest = Part::after(&slide, share);
        let rows = residual(&rest, &fit.nonlinear, &fit.linear);
        let error = relative(&rows, rest.target());
        let after = closed
            .as_ref()
            .map(|course| course.error_after(prepared.trace, share));
        (rows, error, after)
    };
    let parameters = fit.nonlinear.len() + fit.linear.len();
    let rows = uncertainty.effective_rows;
    let closed_error = closed.as_ref().map(|course| course.relative_error);
    Ok(ModelScore {
        name: name.into(),
        relative_error: closed_error.unwrap_or(seen_error),
        relative_error_unseen: Some(closed_unseen.unwrap_or(unseen_error)),
        relative_error_inverse: seen_error,
        relative_error_inverse_unseen: Some(unseen_error),
        position_error: closed.as_ref().map(|course| course.position_error),
        residual_unseen: Some(size(&unseen_rows)),
        information_criterion: rows * 2.0 * size(&fit.residual).ln()
            + parameters as f64 * rows.ln(),
        parameters,
        cycles: cycles(law.cost),
        cycles_estimated: matches!(law.cost, Cost::Estimated(_)),
        values: estimates(&uncertainty),
    })
}

/// What is said of a model that could not be fitted.
pub fn left_out(name: &str, why: &str) -> String {
    format!("{name}: cannot be fitted to this trace, and is not compared; {why}.")
}

/// Values with their intervals.
pub fn estimates(uncertainty: &Uncertainty) -> Vec<Estimate> {
    let intervals = uncertainty.intervals.iter();
    intervals
        .map(|interval| Estimate {
            name: interval.name.into(),
            unit: interval.unit,
            value: interval.value,
            low: interval.low,
            high: interval.high,
            fixed: false,
            at_bound: interval.at_bound,
        })
        .collect()
}

/// The speed over which friction reverses, rad/s or m/s, by the whole trace; `None` where it is sharper than the trace shows.
pub fn reversal_speed(prepared: &Prepared<'_>, beside: &Beside) -> Result<Option<f64>, Failure> {
    let plain = Beside {
        wave: beside.wave,
        load: beside.load.clone(),
        ..Beside::default()
    };
    let slide = Slide::new(prepared, LOAD_PROPORTIONAL, plain);
    let found = fitted(&slide, false).map_err(Failure::Data)?;
    let speed = found.nonlinear.first().copied();
    Ok(speed.filter(|_| found.at_bound.is_empty()))
}
