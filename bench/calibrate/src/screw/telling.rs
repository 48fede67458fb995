//! What a trace of a screw cannot tell, and what would: sentences, and the parameter that is set for each.

use super::choice::needs;
use super::evidence::Evidence;
use super::quantities::{Quantity, Values, assumed_deviation};
use super::stages::Sliding;
use crate::fit::problem::Scale;
use crate::fit::uncertainty::Interval;

/// Condition of the scaled slopes from which on the direction that they see least is looked at; a quantity belongs to it with this part of
/// its square, and is not told where its half-width is beyond this share of it.
const CONDITION: f64 = 100.0;
const PART: f64 = 0.05;
const VAGUE: f64 = 0.25;

const FILM: [&str; 2] = ["full_film_ratio", "half_share_speed"];

const ROLLING: [&str; 2] = ["hysteresis_loss", "lubricant_drag"];

pub struct Untold {
    pub name: &'static str,
    pub sentence: String,
}

/// The parameter that the rows tell least, where they do not tell it: known worse than what is assumed without a trace; part of a direction
/// that the rows hardly see; with an interval as wide as its bounds or a factor of ten to both sides; at a bound. Nothing of `kept`.
pub fn untold(
    sliding: &Sliding,
    design: &Values,
    evidence: &Evidence,
    kept: &[&str],
) -> Option<Untold> {
    let intervals: Vec<(usize, &Interval)> = sliding
        .intervals
        .iter()
        .enumerate()
        .filter(|(_, of)| of.name != "friction" && !kept.contains(&of.name))
        .collect();
    let prior = intervals.iter().find(|(_, of)| {
        assumed_deviation(of.name).is_some_and(|assumed| of.standard_error > assumed)
    });
    let (condition, direction) = &sliding.condition;
    let part = |k: usize| direction.get(k).map_or(0.0, |part| part * part);
    let hidden = intervals
        .iter()
        .filter(|(k, of)| *condition > CONDITION && part(*k) > PART && vagueness(of) > VAGUE)
        .max_by(|one, other| vagueness(one.1).total_cmp(&vagueness(other.1)));
    let wide = intervals
        .iter()
        .filter(|(_, of)| of.half_width >= half_range(of))
        .max_by(|one, other| {
            let width = |of: &Interval| of.half_width / half_range(of);
            width(one.1).total_cmp(&width(other.1))
        });
    let bound = intervals.iter().find(|(_, of)| of.at_bound);
    let (names, chosen, because) = if let Some((_, of)) = prior {
        (vec![of.name], of, None)
    } else if let Some((_, of)) = hidden {
        let members = sliding.intervals.iter().enumerate();
        let members = members.filter(|(k, _)| part(*k) > PART);
        let names = members.map(|(_, of)| of.name).collect();
        (names, of, Some("the trace sees only their combination"))
    } else if let Some((_, of)) = wide {
        (vec![of.name], of, None)
    } else {
        let (_, of) = bound?;
        let because = "it ended at its bound, which no trace tells";
        (vec![of.name], of, Some(because))
    };
    let because = lacking(&names, evidence)
        .filter(|_| !chosen.at_bound)
        .or(because.map(String::from))
        .unwrap_or_else(|| "the trace does not show it".into());
    // A design's number, with the digits of single precision.
    let value = value_of(chosen.name, design) as f32;
    let unit = chosen.unit;
    Some(Untold {
        name: chosen.name,
        sentence: format!(
            "{}: {because}; {} is set to {}",
            words(&names),
            words(&[chosen.name]),
            format!("{value} {unit}").trim_end()
        ),
    })
}

fn vagueness(of: &Interval) -> f64 {
    match of.scale {
        Scale::Logarithmic => of.half_width,
        Scale::Linear => of.half_width / of.value.abs().max(f64::MIN_POSITIVE),
    }
}

/// Half of the range of the bounds in the inner coordinate, or a factor of ten where that is less.
fn half_range(of: &Interval) -> f64 {
    let [low, high] = of.bounds;
    match of.scale {
        Scale::Linear => 0.5 * (high - low),
        Scale::Logarithmic => (0.5 * (high / low).ln()).min(std::f64::consts::LN_10),
    }
}

pub fn value_of(name: &str, values: &Values) -> f64 {
    Quantity::named(name).map_or(0.0, |of| of.value(values))
}

pub fn with(name: &str, value: f64, values: &Values) -> Values {
    Quantity::named(name).map_or(*values, |of| of.with(value, values))
}

fn words(names: &[&str]) -> String {
    let plain = |name: &&str| name.replace('_', " ");
    match names {
        [] => String::new(),
        [one] => plain(one),
        [first @ .., last] => {
            let first: Vec<String> = first.iter().map(plain).collect();
            format!("{} and {}", first.join(", "), plain(last))
        }
    }
}

fn lacking(names: &[&str], evidence: &Evidence) -> Option<String> {
    let has = |name: &str| names.contains(&name);
    let load = 100.0 * evidence.load_variation();
    let [slow, fast] = evidence.speeds;
    if ROLLING.iter().any(|name| has(name)) && has("friction") {
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
    let range = evidence.temperature_range();
    if has("viscosity_pole") && range < needs::TEMPERATURE {
        return Some(format!(
            "the temperature varies by {range:.0} K only; measure over {} K; intervals of what depends on it allow for other lubricants",
            needs::TEMPERATURE
        ));
    }
    if has("breakaway_angle") || has("backlash") {
        return Some(format!(
            "{} reversals; turn back at rest by 0.3 to 4 breakaway angles",
            evidence.reversals
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
    (has("preload") || has("gain"))
        .then(|| format!("the load's size varies by {load:.0} % only; measure at two loads"))
}

pub fn left_out(fixed: &[&str], evidence: &Evidence) -> Vec<String> {
    let wanted = [
        "preload",
        "full_film_ratio",
        "viscosity_pole",
        "breakaway_angle",
        "cosine_1",
        "gain",
    ];
    let missing = wanted.iter().filter(|name| fixed.contains(name));
    missing
        .filter_map(|name| {
            let reason = lacking(&[name], evidence)?;
            Some(format!("{}: not estimated; {reason}.", words(&[name])))
        })
        .collect()
}

pub fn outliers(count: usize) -> Option<String> {
    (count > 0).then(|| format!("{count} rows were left out: what the model leaves of them is beyond 6 deviations of the others."))
}

pub fn too_coarse(name: &str, step: f64, value: f64) -> String {
    let value = value as f32;
    format!(
        "{}: not estimated; a step of the position is {step:.2e} rad of the nut, too coarse for it; {} is set to {value} rad.",
        words(&[name]),
        words(&[name])
    )
}

pub fn beyond_bound(name: &str, value: f64) -> String {
    let (name, value) = (words(&[name]), value as f32);
    format!("{name}: it ended at its bound, which no trace tells; {name} is set to {value} rad.")
}

pub fn at_bound(of: &Interval, evidence: &Evidence) -> String {
    let because = lacking(&[of.name], evidence).map_or(String::new(), |text| format!("; {text}"));
    format!(
        "{}: ended at its bound of {:.4}, so the trace asks for a value beyond it, and what is estimated beside it can be off by more than its interval{because}",
        words(&[of.name]),
        of.value
    )
}
