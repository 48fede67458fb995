//! Models of friction on one trace without a design: each fitted as well as it can be, and scored on what was not fitted.

use crate::answer::{Estimate, ModelScore};
use crate::controller::Controller;
use crate::fit::part::{Part, residual};
use crate::fit::problem::Separable;
use crate::fit::separable::{Fit, FitSettings, fit};
use crate::fit::uncertainty::{Uncertainty, uncertainty};
use crate::laws::cost::cycles;
use crate::laws::{Cost, Law, Level, Passage};
use crate::signals::{Motion, Rows};
use crate::trace::Trace;
use crate::without_design::closed_loop::{Course, Loop, size};
use crate::without_design::controller::SeenController;
use crate::without_design::period::period;
use crate::without_design::slide::Slide;
use crate::without_design::terms::{LoadTerm, Terms};
use epas_page::failure::Failure;

/// Share of the rows that is fitted where no other trace scores the models.
pub const FITTED: f64 = 2.0 / 3.0;

/// Name of the plain model, whose parameters a trace without a design is told by.
pub const PLAIN: &str = "Coulomb and viscous";

/// Laws that are compared: those of the literature, and the crate's without and with memory.
pub const LAWS: [Law; 6] = [
    Law {
        name: PLAIN,
        level: Level::Constant,
        passage: Passage::AtOnce,
        cost: Cost::Estimated(10),
    },
    Law {
        name: "Stribeck",
        level: Level::Stribeck,
        passage: Passage::AtOnce,
        cost: Cost::Counted(&["stribeck_curve"]),
    },
    Law {
        name: "Dahl",
        level: Level::Constant,
        passage: Passage::Dahl,
        cost: Cost::Estimated(38),
    },
    Law {
        name: "LuGre",
        level: Level::Stribeck,
        passage: Passage::LuGre,
        cost: Cost::Counted(&["lugre_step"]),
    },
    Law {
        name: "this crate, without memory",
        level: Level::LoadShare,
        passage: Passage::Speed,
        cost: Cost::Counted(&["friction_coefficient"]),
    },
    Law {
        name: "this crate, with memory",
        level: Level::LoadShare,
        passage: Passage::Elements,
        cost: Cost::Counted(&["friction_coefficient", "memory_8"]),
    },
];

/// The friction of the crate's scene for a drive without a drawing: constant, in proportion to the load, passing with the speed.
pub const LOAD_PROPORTIONAL: Law = Law {
    name: "this crate, load-proportional losses",
    level: Level::Constant,
    passage: Passage::Speed,
    cost: Cost::Counted(&["step_load_proportional"]),
};

/// A trace, ready to be fitted.
pub struct Prepared<'a> {
    /// The trace.
    pub trace: &'a Trace,
    /// Its motion.
    pub motion: &'a Motion,
    /// Its rows.
    pub rows: &'a Rows,
    /// Its controller.
    pub controller: Option<SeenController>,
}

impl<'a> Prepared<'a> {
    /// A trace with what is known of its controller.
    pub fn new(
        trace: &'a Trace,
        motion: &'a Motion,
        rows: &'a Rows,
        controller: Option<Controller>,
    ) -> Self {
        Self {
            trace,
            motion,
            rows,
            controller: controller
                .and_then(|controller| SeenController::of(controller, trace, motion)),
        }
    }

    /// The model of the trace by a law.
    pub fn slide(&self, law: Law, terms: Terms) -> Slide<'_> {
        Slide::new(self.trace, self.motion, self.rows, law, terms)
    }

    /// The loop closed with a fit.
    fn course(&self, slide: &Slide<'_>, fit: &Fit) -> Result<Option<Course>, Failure> {
        let Some(controller) = &self.controller else {
            return Ok(None);
        };
        let resistance = slide
            .resistance(&fit.nonlinear, &fit.linear)
            .map_err(|error| Failure::Data(error.to_string()))?;
        let closed = Loop {
            trace: self.trace,
            motion: self.motion,
            controller,
        };
        let inertia = fit.linear.first().copied().unwrap_or(0.0);
        if !(inertia > 0.0) {
            return Ok(None);
        }
        Ok(Some(closed.run(
            inertia,
            resistance,
            slide.delay(&fit.nonlinear),
        )))
    }
}

/// A model that was fitted.
pub struct Fitted {
    /// Its law.
    pub law: Law,
    /// What stands beside it.
    pub terms: Terms,
    /// The fit of what is fitted.
    pub fit: Fit,
    /// How sure it is.
    pub uncertainty: Uncertainty,
    /// Its score.
    pub score: ModelScore,
    /// The closed loop with it.
    pub course: Option<Course>,
}

/// What every model but the plain one has beside its law, with this of the load: with a deviation along the way where the trace shows one.
pub fn terms(prepared: &Prepared<'_>, load: LoadTerm) -> Terms {
    let without = Terms {
        drag_of_each_direction: true,
        position: true,
        period: None,
        load,
        delay: true,
        one_speed: false,
    };
    let slide = prepared.slide(LAWS[LAWS.len() - 1], without);
    let Ok(fit) = fitted(&slide, false) else {
        return without;
    };
    let position: Vec<f64> = prepared
        .rows
        .samples(prepared.trace.len())
        .filter_map(|sample| prepared.motion.position.get(sample).copied())
        .collect();
    let Some(first) = period(&position, &fit.residual, prepared.trace.resolution) else {
        return without;
    };
    // A line of the spectrum is as wide as one period of the whole way: the best place within it is found by the residual itself.
    let low = position.iter().copied().fold(f64::INFINITY, f64::min);
    let high = position.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let width = first / (high - low).max(first);
    let best = (-4..=4)
        .map(|place| first * (1.0 + 0.25 * f64::from(place) * width))
        .filter_map(|period| {
            let terms = Terms {
                period: Some(period),
                ..without
            };
            let slide = prepared.slide(LAWS[LAWS.len() - 1], terms);
            let fit = crate::fit::separable::refit(
                &slide,
                &fit.nonlinear,
                &fit.weights,
                &FitSettings::default(),
            )
            .ok()?;
            Some((fit.residual_rms(), terms))
        })
        .min_by(|one, other| one.0.total_cmp(&other.0))
        .map(|(_, terms)| terms);
    best.unwrap_or(without)
}

/// A fit, from several starts or from one.
fn fitted(problem: &dyn Separable, plain: bool) -> Result<Fit, Failure> {
    let settings = FitSettings {
        robust: !plain,
        ..FitSettings::default()
    };
    fit(problem, &settings).map_err(|error| Failure::Data(error.to_string()))
}

/// Fits a model to a trace, and scores it on another trace, or on the last third of this one.
pub fn model(
    prepared: &Prepared<'_>,
    unseen: Option<&Prepared<'_>>,
    law: Law,
    terms: Terms,
    name: &str,
) -> Result<Fitted, Failure> {
    let slide = prepared.slide(law, terms);
    let plain = terms
        == Terms {
            one_speed: terms.one_speed,
            load: terms.load,
            ..Terms::default()
        };
    let share = if unseen.is_some() { 1.0 } else { FITTED };
    let seen = Part::before(&slide, share);
    let fit = fitted(&seen, plain)?;
    let uncertainty = uncertainty(&seen, &fit);
    let course = prepared.course(&slide, &fit)?;
    let relative = |rows: &[f64], target: &[f64]| size(rows) / size(target);
    let seen_error = relative(&fit.residual, seen.target());
    let (unseen_rows, unseen_error, closed_unseen) = if let Some(other) = unseen {
        let slide = other.slide(law, terms);
        let rows = residual(&slide, &fit.nonlinear, &fit.linear);
        let error = relative(&rows, slide.target());
        let course = other.course(&slide, &fit)?;
        (rows, error, course.map(|course| course.relative_error))
    } else {
        let rest = Part::after(&slide, share);
        let rows = residual(&rest, &fit.nonlinear, &fit.linear);
        let error = relative(&rows, rest.target());
        let closed = course
            .as_ref()
            .map(|course| course.error_after(prepared.trace, share));
        (rows, error, closed)
    };
    let parameters = fit.nonlinear.len() + fit.linear.len();
    let rows = uncertainty.effective_rows;
    let closed = course.as_ref().map(|course| course.relative_error);
    let score = ModelScore {
        name: name.into(),
        relative_error: closed.unwrap_or(seen_error),
        relative_error_unseen: Some(closed_unseen.unwrap_or(unseen_error)),
        relative_error_inverse: seen_error,
        relative_error_inverse_unseen: Some(unseen_error),
        position_error: course.as_ref().map(|course| course.position_error),
        residual_unseen: Some(size(&unseen_rows)),
        information_criterion: rows * 2.0 * size(&fit.residual).ln()
            + parameters as f64 * rows.ln(),
        parameters,
        cycles: cycles(law.cost),
        cycles_estimated: matches!(law.cost, Cost::Estimated(_)),
        values: estimates(&uncertainty),
    };
    Ok(Fitted {
        law,
        terms,
        fit,
        uncertainty,
        score,
        course,
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
