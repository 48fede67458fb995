//! What a trace of a screw lacks, in plain sentences.

use super::choice::needs;
use super::evidence::Evidence;
use super::quantities::{Linear, Nonlinear, Values, assumed_deviation};
use crate::fit::telling::{Hints, is_wide};
use crate::fit::uncertainty::Interval;

/// What the trace excites, and the values that stay where it tells nothing.
pub struct ScrewHints {
    /// What the trace excites.
    pub evidence: Evidence,
    /// Values of the design.
    pub values: Values,
    /// Step of the position's sensor, rad of the nut.
    pub step: f64,
    /// Whether that step is too coarse for the breakaway angle.
    pub coarse: bool,
}

/// Fewest steps of the position from the turn of a motion to full sliding: of a travel that the sensor sees in fewer of them, the place
/// of the turn, known to a step, decides.
const STEPS: f64 = 2.0;

/// Parameters by what tells them.
const ROLLING: [&str; 2] = ["hysteresis_loss", "lubricant_drag"];
/// Parameters of the film of lubricant.
pub const FILM: [&str; 2] = ["full_film_ratio", "half_share_speed"];

impl Hints for ScrewHints {
    fn lacking(&self, names: &[&str]) -> Option<String> {
        let has = |name: &str| names.contains(&name);
        let rolling = ROLLING.iter().any(|name| has(name));
        let load = 100.0 * self.evidence.load_variation();
        let [slow, fast] = self.evidence.speeds;
        if rolling && has("friction") {
            return Some(
                "sliding shows the sum of friction and rolling resistance only; calibrate the load's channel to a thousandth and fix the gain, or measure with loads of both signs"
                    .into(),
            );
        }
        if has("friction") && has("preload") {
            return Some(format!(
                "the load's size varies by {load:.0} % only; measure without a load and at three times the preload"
            ));
        }
        if has("full_film_ratio") && has("drag") {
            return Some(
                "both rise with the speed; fix the drag from a spin-down without a load, or measure at several loads"
                    .into(),
            );
        }
        if FILM.iter().any(|name| has(name)) {
            return Some(format!(
                "speeds are {slow:.3} to {fast:.3} rad/s; measure from a fifth to ten times the half-share speed, with loads of both signs"
            ));
        }
        let range = self.evidence.temperature_range();
        if has("viscosity_pole") && range < needs::TEMPERATURE {
            return Some(format!(
                "the temperature varies by {range:.0} K only; measure over {} K; intervals of what depends on it allow for other lubricants",
                needs::TEMPERATURE
            ));
        }
        if has("breakaway_angle") || has("backlash") {
            return Some(format!(
                "{} reversals; turn back at rest by 0.3 to 4 breakaway angles",
                self.evidence.reversals
            ));
        }
        if has("direction_asymmetry") && has("offset") {
            return Some("both shift the torque; measure at several loads".into());
        }
        if names
            .iter()
            .any(|name| name.starts_with("cosine") || name.starts_with("sine"))
        {
            return Some("the nut has to make whole turns at a load that hardly changes".into());
        }
        if has("preload") || has("gain") {
            return Some(format!(
                "the load's size varies by {load:.0} % only; measure at two loads"
            ));
        }
        None
    }

    fn words(&self, name: &str) -> Option<String> {
        Some(name.replace('_', " "))
    }

    fn prior(&self, name: &str) -> Option<f64> {
        let nonlinear = Nonlinear::named(name).map(|of| of.value(&self.values));
        nonlinear.or_else(|| Linear::named(name).map(|of| of.value(&self.values)))
    }

    fn prior_deviation(&self, name: &str) -> Option<f64> {
        assumed_deviation(name)
    }

    fn assumed(&self, names: &[&'static str]) -> Option<&'static str> {
        let of_film = |film: &&&str| names.contains(*film);
        FILM.iter().rev().find(of_film).copied()
    }

    fn unseen(&self, interval: &Interval) -> Option<String> {
        let Interval { name, value, .. } = *interval;
        let way = matches!(name, "breakaway_angle" | "backlash");
        let way = way && value > 0.0 && value < STEPS * self.step;
        // What the steps make of a slow motion asks for any law of the speed.
        let film = self.coarse && FILM.contains(&name) && (interval.at_bound || is_wide(interval));
        (way || film).then(|| {
            format!(
                "not estimated; a step of the position is {:.2e} rad of the nut, too coarse for it",
                self.step
            )
        })
    }

    fn needed(&self, name: &str) -> bool {
        name == "friction"
    }
}

impl ScrewHints {
    /// Sentences on what was not estimated because the trace does not excite it.
    pub fn left_out(&self, fixed: &[&str]) -> Vec<String> {
        let wanted = [
            "preload",
            "full_film_ratio",
            "viscosity_pole",
            "breakaway_angle",
            "cosine_1",
            "gain",
        ];
        wanted
            .iter()
            .filter(|name| fixed.contains(name))
            .filter_map(|name| {
                let words = self.words(name)?;
                let reason = self.lacking(&[name])?;
                Some(format!("{words}: not estimated; {reason}."))
            })
            .collect()
    }
}
