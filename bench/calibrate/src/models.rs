//! Models of friction beside each other on one trace: each fitted as well as it can be to two thirds of its rows and scored on the last
//! third, or fitted to all of them and scored on another trace.
//!
//! Rows run over turns and rests, so that every model has to pass them. What stands beside the friction ([`Beside`]) is the same for all.

use crate::answer::{Estimate, ModelScore};
use crate::estimator::rows::Rows;
use crate::fit::part::{Part, residual};
use crate::fit::problem::{Evaluation, LinearParameter, Parameter, Scale, Separable};
use crate::fit::search::{Found, fit};
use crate::fit::uncertainty::uncertainty;
use crate::laws::cost::cycles;
use crate::laws::{BREAKAWAY, Cost, Law, Level, Passage, Scales};
use epas_page::failure::Failure;

/// Share of the rows that is fitted where no other trace scores.
pub const FITTED: f64 = 2.0 / 3.0;

/// Name of the scene without memory.
pub const WITHOUT_MEMORY: &str = "this crate, without memory";
/// Name of the scene with memory.
pub const WITH_MEMORY: &str = "this crate, with memory";

const fn law(name: &'static str, level: Level, passage: Passage, cost: Cost) -> Law {
    Law {
        name,
        level,
        passage,
        cost,
    }
}

/// Laws of the literature.
pub const LITERATURE: [Law; 4] = {
    use Cost::{Counted, Estimated};
    use Level::{Constant, Stribeck};
    let stribeck = Counted(&["stribeck_curve"]);
    [
        law(
            "Coulomb and viscous",
            Constant,
            Passage::AtOnce,
            Estimated(10),
        ),
        law("Stribeck", Stribeck, Passage::AtOnce, stribeck),
        law("Dahl", Constant, Passage::Dahl, Estimated(38)),
        law("LuGre", Stribeck, Passage::LuGre, Counted(&["lugre_step"])),
    ]
};

/// This crate's laws of unit level, for a drive without a design.
pub const OWN: [Law; 2] = {
    let without = Cost::Counted(&["friction_coefficient"]);
    let with = Cost::Counted(&["friction_coefficient", "memory_8"]);
    [
        law(WITHOUT_MEMORY, Level::LoadShare, Passage::Speed, without),
        law(WITH_MEMORY, Level::LoadShare, Passage::Elements, with),
    ]
};

/// Friction of gross sliding without a load: what a law of unit level is multiplied by.
const LEVEL: LinearParameter = LinearParameter {
    name: "level",
    unit: "N m",
    low: 0.0,
    high: f64::INFINITY,
};

/// What stands beside the friction in every row.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Beside {
    /// What was measured.
    pub target: Vec<f64>,
    /// What is set.
    pub fixed: Vec<f64>,
    /// What is estimated.
    pub linear: Vec<LinearParameter>,
    /// What it multiplies.
    pub columns: Vec<Vec<f64>>,
}

/// A trace as a law of friction is told it.
#[derive(Clone, Copy)]
pub struct Driven<'a> {
    /// Position at every sample, rad or m.
    pub position: &'a [f64],
    /// Speed, rad/s or m/s.
    pub speed: &'a [f64],
    /// Tick, s.
    pub tick: f64,
    /// Step of the position's sensor, rad or m.
    pub resolution: f64,
    /// How a signal becomes rows.
    pub rows: &'a Rows,
    /// Sum of both flanks' loads over that without a load; nothing where none was measured.
    pub share: Option<LoadShare<'a>>,
    /// Travel to full sliding to begin with, rad or m, where it is known: from one far off, a law may do best without any friction.
    pub breakaway: Option<f64>,
}

/// Sum of both flanks' loads over that without a load: with a large preload the friction does not follow the load at all, so that a law may
/// choose.
#[derive(Clone, Copy)]
pub struct LoadShare<'a> {
    /// Load at every sample, N.
    pub load: &'a [f64],
    /// Preload of a flank to begin with, N.
    pub preload: f64,
    /// Largest load, N.
    pub largest: f64,
    /// Sum of both flanks' loads, N, under a preload and a load.
    pub sum: fn(f64, f64) -> f64,
}

/// Preload of a flank in a law's load share over the largest load: least and most.
const PRELOADS: [f64; 2] = [1e-3, 10.0];

/// Friction in every row at some parameters; no numbers where they are refused.
type Friction<'a> = Box<dyn Fn(&[f64]) -> Vec<f64> + Sync + 'a>;

/// A model of friction on a trace.
pub struct Model<'a> {
    nonlinear: Vec<Parameter>,
    linear: Vec<LinearParameter>,
    beside: &'a Beside,
    /// Whether the friction is of unit level: the last linear parameter multiplies it.
    of_unit_level: bool,
    friction: Friction<'a>,
    tick: f64,
}

impl<'a> Model<'a> {
    /// One whose friction has its own level.
    pub fn new(
        nonlinear: Vec<Parameter>,
        beside: &'a Beside,
        tick: f64,
        friction: Friction<'a>,
    ) -> Self {
        Self {
            nonlinear,
            linear: beside.linear.clone(),
            beside,
            of_unit_level: false,
            friction,
            tick,
        }
    }

    /// A law of unit level; rad or m, and their speeds, as `units` says.
    pub fn of_law(
        law: Law,
        driven: Driven<'a>,
        beside: &'a Beside,
        units: [&'static str; 2],
    ) -> Self {
        let ends = |list: &[f64]| {
            let ends = (f64::INFINITY, f64::NEG_INFINITY);
            list.iter()
                .fold(ends, |(low, high), x| (low.min(*x), high.max(*x)))
        };
        let ((low, high), (slow, fast)) = (ends(driven.position), ends(driven.speed));
        let scales = Scales {
            speed: fast.max(-slow).max(f64::MIN_POSITIVE),
            travel: (high - low).max(f64::MIN_POSITIVE),
            resolution: driven.resolution,
            tick: driven.tick,
        };
        let mut nonlinear = law.parameters(&scales, units);
        for parameter in nonlinear.iter_mut().filter(|of| of.name == BREAKAWAY) {
            let known = driven.breakaway.unwrap_or(parameter.start);
            parameter.start = known.max(parameter.low).min(parameter.high);
        }
        if let Some(share) = &driven.share {
            let [low, high] = PRELOADS.map(|part| part * share.largest);
            nonlinear.push(Parameter {
                name: "axial_preload",
                unit: "N",
                start: share.preload.max(low).min(high),
                low,
                high,
                scale: Scale::Logarithmic,
            });
        }
        let mut linear = beside.linear.clone();
        linear.push(LEVEL);
        let friction = move |values: &[f64]| {
            let Ok(friction) = law.friction(&scales, values) else {
                return vec![f64::NAN; driven.rows.len()];
            };
            let mut friction = friction.along(driven.position, driven.speed, driven.tick);
            if let (Some(LoadShare { load, sum, .. }), Some(preload)) =
                (driven.share, values.last())
            {
                for (friction, load) in friction.iter_mut().zip(load) {
                    *friction *= sum(*preload, *load) / (2.0 * preload);
                }
            }
            driven.rows.sums(0, &friction)
        };
        Self {
            nonlinear,
            linear,
            beside,
            of_unit_level: true,
            friction: Box::new(friction),
            tick: driven.tick,
        }
    }
}

impl Separable for Model<'_> {
    fn nonlinear(&self) -> &[Parameter] {
        &self.nonlinear
    }

    fn linear(&self) -> &[LinearParameter] {
        &self.linear
    }

    fn target(&self) -> &[f64] {
        &self.beside.target
    }

    fn row_step(&self) -> f64 {
        self.tick
    }

    fn evaluate(&self, nonlinear: &[f64]) -> Evaluation {
        let friction = (self.friction)(nonlinear);
        let mut columns = self.beside.columns.clone();
        let mut fixed = self.beside.fixed.clone();
        if self.of_unit_level {
            columns.push(friction);
        } else {
            for (fixed, friction) in fixed.iter_mut().zip(friction) {
                *fixed += friction;
            }
        }
        Evaluation { fixed, columns }
    }
}

/// A model on the trace that is fitted, and on another that is not.
pub struct Entry<'a> {
    /// Name.
    pub name: &'a str,
    /// What it costs.
    pub cost: Cost,
    /// On the fitted trace.
    pub fitted: &'a dyn Separable,
    /// On another one.
    pub unseen: Option<&'a dyn Separable>,
}

/// Models beside each other.
#[derive(Clone, Debug, Default)]
pub struct Table {
    /// Those that could be fitted.
    pub models: Vec<ModelScore>,
    /// Name of the one with the least error on what was not fitted.
    pub winner: Option<String>,
    /// Sentences on those that could not.
    pub left_out: Vec<String>,
}

/// Fits and scores models.
pub fn compared(entries: &[Entry<'_>]) -> Table {
    let mut table = Table::default();
    for entry in entries {
        match score(entry) {
            Ok((score, _)) => table.models.push(score),
            Err(failure) => table.left_out.push(left_out(entry.name, &failure)),
        }
    }
    table.winner = rank(&mut table.models);
    table
}

/// What is said of a model that could not be fitted.
pub fn left_out(name: &str, why: &Failure) -> String {
    format!(
        "{name}: cannot be fitted to this trace, and is not compared; {}.",
        why.message()
    )
}

/// Sets the least information criterion to zero; the name of the model that does best on what was not fitted.
pub fn rank(models: &mut [ModelScore]) -> Option<String> {
    let criteria = models.iter().map(|model| model.information_criterion);
    let least = criteria.fold(f64::INFINITY, f64::min);
    for model in models.iter_mut() {
        model.information_criterion -= least;
    }
    let error = |model: &ModelScore| model.relative_error_unseen.unwrap_or(f64::INFINITY);
    let best = models
        .iter()
        .min_by(|one, other| error(one).total_cmp(&error(other)));
    best.map(|model| model.name.clone())
}

/// Fits a model, and scores it on what was not fitted.
///
/// # Errors
/// Why there is no fit.
pub fn score(entry: &Entry<'_>) -> Result<(ModelScore, Found), Failure> {
    let parts = [
        Part::before(entry.fitted, FITTED),
        Part::after(entry.fitted, FITTED),
    ];
    let (fitted, unseen): (&dyn Separable, &dyn Separable) = match entry.unseen {
        Some(unseen) => (entry.fitted, unseen),
        None => (&parts[0], &parts[1]),
    };
    let found = fit(fitted)?;
    let rest = residual(unseen, &found.nonlinear, &found.linear);
    let size = |rows: &[f64]| {
        let sum: f64 = rows.iter().map(|x| x * x).sum();
        (sum / rows.len().max(1) as f64).sqrt()
    };
    let relative = |rows: &[f64], target: &[f64]| size(rows) / size(target).max(f64::MIN_POSITIVE);
    let seen_error = relative(&found.residual, fitted.target());
    let unseen_error = relative(&rest, unseen.target());
    let parameters = found.nonlinear.len() + found.linear.len();
    let sure = uncertainty(fitted, &found);
    let rows = sure.effective_rows;
    let score = ModelScore {
        name: entry.name.into(),
        relative_error: seen_error,
        relative_error_unseen: Some(unseen_error),
        relative_error_inverse: seen_error,
        relative_error_inverse_unseen: Some(unseen_error),
        position_error: None,
        residual_unseen: Some(size(&rest)),
        information_criterion: rows * 2.0 * size(&found.residual).ln()
            + parameters as f64 * rows.ln(),
        parameters,
        cycles: cycles(entry.cost),
        cycles_estimated: matches!(entry.cost, Cost::Estimated(_)),
        values: sure.intervals.iter().map(Estimate::from).collect(),
    };
    Ok((score, found))
}
