//! Models of friction beside each other on one trace: each fitted as well as it can be to two thirds of its rows and scored on the last
//! third, or fitted to all of them and scored on another trace.
//!
//! Rows run over turns and rests, so that every model has to pass them. What stands beside the friction is the same for all.

use crate::answer::{Calibration, Estimate, ModelScore};
use crate::estimator::fit::rms;
use crate::fit::problem::{Separable, part, residual};
use crate::fit::search::{Found, fit};
use crate::fit::uncertainty::uncertainty;
use crate::laws::cost::cycles;
use crate::laws::{Cost, Law, Level, Passage};
use epas_page::failure::Failure;

/// Share of the rows that is fitted where no other trace scores.
pub const FITTED: f64 = 2.0 / 3.0;

pub const WITHOUT_MEMORY: &str = "this crate, without memory";
pub const WITH_MEMORY: &str = "this crate, with memory";

const fn law(name: &'static str, level: Level, passage: Passage, cost: Cost) -> Law {
    Law {
        name,
        level,
        passage,
        cost,
    }
}

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

/// A model fitted to a problem and scored on another one, or fitted to the first part of it and scored on the rest.
pub fn score(
    (name, cost): (&str, Cost),
    whole: &dyn Separable,
    unseen: Option<&dyn Separable>,
) -> Result<(ModelScore, Found), Failure> {
    let count = whole.target().len();
    let border = (FITTED * count as f64) as usize;
    let parts = [0..border, border..count].map(|rows| part(whole, rows));
    let (fitted, unseen): (&dyn Separable, &dyn Separable) = match unseen {
        Some(unseen) => (whole, unseen),
        None => (&parts[0], &parts[1]),
    };
    let found = fit(fitted)?;
    let rest = residual(unseen, &found.nonlinear, &found.linear);
    let relative = |rows: &[f64], target: &[f64]| rms(rows) / rms(target).max(f64::MIN_POSITIVE);
    let seen_error = relative(&found.residual, fitted.target());
    let unseen_error = relative(&rest, unseen.target());
    let parameters = found.nonlinear.len() + found.linear.len();
    let sure = uncertainty(fitted, &found);
    let rows = sure.effective_rows;
    let score = ModelScore {
        name: name.into(),
        relative_error: seen_error,
        relative_error_unseen: Some(unseen_error),
        relative_error_inverse: seen_error,
        relative_error_inverse_unseen: Some(unseen_error),
        position_error: None,
        residual_unseen: Some(rms(&rest)),
        information_criterion: rows * 2.0 * rms(&found.residual).ln()
            + parameters as f64 * rows.ln(),
        parameters,
        cycles: cycles(cost),
        cycles_estimated: matches!(cost, Cost::Estimated(_)),
        values: sure.intervals.iter().map(Estimate::from).collect(),
    };
    Ok((score, found))
}

impl Calibration {
    /// Puts models beside each other, each with its name: the least information criterion is set to zero, the winner does best on what was
    /// not fitted, and of those that could not be fitted it is said.
    pub fn compare(&mut self, scored: impl Iterator<Item = (String, Result<ModelScore, Failure>)>) {
        for (name, scored) in scored {
            match scored {
                Ok(score) => self.models.push(score),
                Err(why) => self.cannot_tell.push(format!(
                    "{name}: cannot be fitted to this trace, and is not compared; {}.",
                    why.message()
                )),
            }
        }
        let criteria = self.models.iter().map(|model| model.information_criterion);
        let least = criteria.fold(f64::INFINITY, f64::min);
        for model in &mut self.models {
            model.information_criterion -= least;
        }
        let error = |model: &ModelScore| model.relative_error_unseen.unwrap_or(f64::INFINITY);
        let models = self.models.iter();
        let best = models.min_by(|one, other| error(one).total_cmp(&error(other)));
        self.winner = best.map(|model| model.name.clone());
    }
}
