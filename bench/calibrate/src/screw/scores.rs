//! Models of friction on one trace of a screw, each fitted as well as it can be to two thirds of it and scored on the other third, or
//! fitted to all of it and scored on another trace.

use super::blocks::Blocks;
use super::friction::{ElementsKind, Screw};
use super::problem::ScrewProblem;
use super::quantities::Values;
use super::rivals::{Rival, WithoutMemory};
use crate::answer::ModelScore;
use crate::fit::part::residual;
use crate::fit::problem::Separable;
use crate::fit::separable::checks::FitError;
use crate::fit::separable::{FitSettings, fit};
use crate::fit::uncertainty::uncertainty;
use crate::laws::cost::cycles;
use crate::laws::{Cost, Passage};
use crate::signals::autocorrelation::effective_rows;
use crate::signals::{Motion, Rows};
use crate::trace::Trace;
use crate::without_design::models::{LAWS, estimates, left_out};

/// Starts of the laws of the literature and of the scene without memory, of which so many are finished.
const RIVALS: (usize, usize) = (2, 1);

/// Name of the scene without memory.
pub const WITHOUT_MEMORY: &str = "this crate, without memory";
/// Name of the scene with memory.
pub const WITH_MEMORY: &str = "this crate, with memory";

/// A screw on a trace, with what was measured.
type Measured<'a> = (&'a ScrewProblem<'a>, (&'a Trace, &'a Motion, &'a Rows));

/// Models of friction beside each other.
#[derive(Default)]
pub struct Scores {
    /// Those that could be fitted.
    pub models: Vec<ModelScore>,
    /// Name of the one with the least error on what was not fitted.
    pub winner: Option<String>,
    /// Sentences on those that could not.
    pub left_out: Vec<String>,
}

impl Scores {
    /// Adds a model, or why it is not there.
    fn add(&mut self, name: &str, score: Result<ModelScore, FitError>) {
        match score {
            Ok(score) => self.models.push(score),
            Err(error) => self.left_out.push(left_out(name, &error.to_string())),
        }
    }
}

/// Scores of all models on another trace, or on a third of the fitted one. One that cannot be fitted is left out.
pub fn scores(
    fitted: Measured<'_>,
    unseen: Option<Measured<'_>>,
    values: &Values,
    settings: &FitSettings,
) -> Scores {
    let (problem, (_, _, rows)) = fitted;
    let screw = problem.screw();
    let beside = problem.beside(values);
    let other = unseen.map(|(problem, traced)| (problem, traced, problem.beside(values)));
    let rivals = FitSettings {
        starts: RIVALS.0.min(settings.starts),
        finished: RIVALS.1,
        ..*settings
    };
    let laws = LAWS
        .iter()
        .filter(|law| !matches!(law.passage, Passage::Speed | Passage::Elements));
    let mut scores = Scores::default();
    for law in laws {
        let preload = screw.axial_preload(values);
        let rival = Rival::new(*law, fitted.1, &beside, preload, screw.largest_load);
        let unseen = other.as_ref().map(|(_, traced, beside)| {
            Rival::new(*law, *traced, beside, preload, screw.largest_load)
        });
        let unseen = unseen.as_ref().map(|rival| rival as &dyn Separable);
        scores.add(
            law.name,
            score(law.name, (&rival, unseen), &rivals, law.cost),
        );
    }
    let estimated = problem.nonlinear();
    let course = (problem.course(), rows, &beside);
    let estimated = (estimated, problem.search_grid());
    let without = WithoutMemory::new(*screw, *values, estimated, course);
    let unseen = other.as_ref().map(|(problem, (_, _, rows), beside)| {
        let course = (problem.course(), *rows, beside);
        WithoutMemory::new(*screw, *values, estimated, course)
    });
    let unseen = unseen.as_ref().map(|scene| scene as &dyn Separable);
    let cost = Cost::Counted(&["step_caged"]);
    scores.add(
        WITHOUT_MEMORY,
        score(WITHOUT_MEMORY, (&without, unseen), &rivals, cost),
    );
    let single = FitSettings {
        starts: 1,
        finished: 1,
        ..*settings
    };
    let unseen = other
        .as_ref()
        .map(|(problem, ..)| *problem as &dyn Separable);
    let cost = cost_with_memory(screw);
    scores.add(
        WITH_MEMORY,
        score(WITH_MEMORY, (problem, unseen), &single, cost),
    );
    let least = scores
        .models
        .iter()
        .map(|score| score.information_criterion)
        .fold(f64::INFINITY, f64::min);
    for score in &mut scores.models {
        score.information_criterion -= least;
    }
    let winner = scores.models.iter().min_by(|one, other| {
        let error = |score: &ModelScore| score.relative_error_unseen.unwrap_or(f64::INFINITY);
        error(one).total_cmp(&error(other))
    });
    scores.winner = winner.map(|score| score.name.clone());
    scores
}

/// Cost of a step with memory: counted for elements in constant shares; load-exact ones cost what they cost beyond these.
fn cost_with_memory(screw: &Screw) -> Cost {
    match screw.elements {
        ElementsKind::Proportional => Cost::Counted(&["step_caged_law"]),
        // 371 in place of 190 cycles, and 30 for the load of both flanks.
        ElementsKind::LoadExact | ElementsKind::Preloaded => Cost::Estimated(1400),
    }
}

fn score(
    name: &str,
    (problem, unseen): (&dyn Separable, Option<&dyn Separable>),
    settings: &FitSettings,
    cost: Cost,
) -> Result<ModelScore, FitError> {
    let blocks = [Blocks::fitted(problem), Blocks::unseen(problem)];
    let (fitted, unseen): (&dyn Separable, &dyn Separable) = match unseen {
        Some(unseen) => (problem, unseen),
        None => (&blocks[0], &blocks[1]),
    };
    let found = fit(fitted, settings)?;
    let rest = residual(unseen, &found.nonlinear, &found.linear);
    let size = |rows: &[f64]| {
        let sum: f64 = rows.iter().map(|x| x * x).sum();
        (sum / rows.len().max(1) as f64).sqrt()
    };
    let relative = |rows: &[f64], target: &[f64]| size(rows) / size(target).max(f64::MIN_POSITIVE);
    let seen_error = relative(&found.residual, fitted.target());
    let unseen_error = relative(&rest, unseen.target());
    let parameters = found.nonlinear.len() + found.linear.len();
    let rows = effective_rows(&found.residual);
    Ok(ModelScore {
        name: name.into(),
        relative_error: seen_error,
        relative_error_unseen: Some(unseen_error),
        relative_error_inverse: seen_error,
        relative_error_inverse_unseen: Some(unseen_error),
        position_error: None,
        residual_unseen: Some(size(&rest)),
        information_criterion: rows * 2.0 * size(&found.residual).ln()
            + parameters as f64 * rows.ln(),
        parameters,
        cycles: cycles(cost),
        cycles_estimated: matches!(cost, Cost::Estimated(_)),
        values: estimates(&uncertainty(fitted, &found)),
    })
}
