//! What a trace cannot tell, in plain sentences. Such a parameter is set to its prior value, and the fit is made again without it; it
//! stays free where the residual then grows beyond chance.
//!
//! | sign | what follows |
//! |---|---|
//! | standard error above that of what is assumed without a trace ([`Hints::prior_deviation`]) | it is set |
//! | condition above 100, and a parameter of the null direction known to worse than a quarter | the one known worst is set |
//! | interval as wide as the bounds, or of a factor of ten to both sides | it is set |
//! | value at a bound | it is set, or where the trace objects to that, a sentence |
//! | what the caller's sensors cannot see ([`Hints::unseen`]) | it is set, whatever the residual says |
//! | several answers with the same residual | the one that the caller names of the parameters that differ is set ([`Hints::assumed`]) |
//! | correlation above 0.95 | a sentence |

use crate::fit::problem::{Scale, Separable};
use crate::fit::separable::checks::FitError;
use crate::fit::separable::{Fit, FitSettings, Fixed, Verdict, fit};
use crate::fit::uncertainty::{Interval, Uncertainty, uncertainty};

/// Condition of the scaled slopes from which on their null direction is looked at.
const CONDITION: f64 = 100.0;

/// A parameter belongs to the null direction with this part of its square.
const PART: f64 = 0.05;

/// Half width of an interval, relative, from which on a parameter of the null direction is not told.
const VAGUE: f64 = 0.25;

/// Half widths beyond this, relative, are alike: that of a value near zero means nothing more.
const VAGUEST: f64 = 10.0;

/// A parameter stays free when twice the loss in log-likelihood without it is beyond this.
const GROWTH: f64 = 10.0;

/// A residual counts as this many independent rows at least: a model that misses the trace leaves few, and would hide any growth.
const FEWEST: f64 = 100.0;

/// Correlation that is told.
const CORRELATION: f64 = 0.95;

/// What the caller knows of the parameters and of the trace.
pub trait Hints {
    /// What the trace lacks to tell these parameters (one, or some from each other), and what would: "the load varies by 3 % only;
    /// measure at two loads".
    fn lacking(&self, names: &[&str]) -> Option<String>;

    /// A parameter's name in plain words.
    fn words(&self, name: &str) -> Option<String> {
        let _ = name;
        None
    }

    /// Value that a parameter is set to; else a nonlinear one is set to its start, a linear one to zero or the bound next to it.
    fn prior(&self, name: &str) -> Option<f64> {
        let _ = name;
        None
    }

    /// Standard deviation of that value in the parameter's inner coordinate, where it is known. A trace that identifies the parameter less
    /// well does not estimate it.
    fn prior_deviation(&self, name: &str) -> Option<f64> {
        let _ = name;
        None
    }

    /// Why the sensors cannot have seen a parameter that came out so, where they cannot.
    fn unseen(&self, interval: &Interval) -> Option<String> {
        let _ = interval;
        None
    }

    /// Which of some parameters is set where several answers that differ in them have the same residual.
    fn assumed(&self, names: &[&'static str]) -> Option<&'static str> {
        let _ = names;
        None
    }

    /// Whether a parameter is never set.
    fn needed(&self, name: &str) -> bool {
        let _ = name;
        false
    }
}

/// No hints.
pub struct NoHints;

impl Hints for NoHints {
    fn lacking(&self, _: &[&str]) -> Option<String> {
        None
    }
}

/// Why something is not told.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Reason {
    /// The rows see only a combination of the parameters; the condition.
    NullDirection(f64),
    /// The interval is as wide as the bounds, or of a factor of ten to both sides.
    Wide,
    /// The standard error is above the standard deviation of what is assumed without a trace.
    Prior,
    /// The value is at a bound.
    AtBound,
    /// The sensors cannot have seen it.
    Unseen,
    /// Several answers have the same residual.
    Rivals,
    /// Correlation of two parameters.
    Correlation(f64),
}

/// Something that the trace cannot tell.
#[derive(Clone, Debug, PartialEq)]
pub struct Untold {
    /// The parameters.
    pub names: Vec<&'static str>,
    /// Why.
    pub reason: Reason,
    /// The parameter that was set for it, and its value.
    pub fixed: Option<(&'static str, f64)>,
    /// All of it as a sentence.
    pub sentence: String,
}

/// A fit of what the trace can tell.
#[derive(Clone, Debug, PartialEq)]
pub struct Told {
    /// The fit of the free parameters, in the order of `Fixed::new(problem, &told.fixed)`.
    pub fit: Fit,
    /// Its uncertainty.
    pub uncertainty: Uncertainty,
    /// Parameters that were set, and their values.
    pub fixed: Vec<(&'static str, f64)>,
    /// What cannot be told.
    pub untold: Vec<Untold>,
    /// Evaluations of the model in all fits.
    pub evaluations: usize,
}

/// Fits a problem, and again without what it cannot tell until all that is left can be told.
///
/// # Errors
///
/// As the fit itself.
pub fn tell(
    problem: &dyn Separable,
    settings: &FitSettings,
    hints: &dyn Hints,
) -> Result<Told, FitError> {
    let mut fixed: Vec<(&'static str, f64)> = vec![];
    let mut kept: Vec<&'static str> = vec![];
    let mut untold: Vec<Untold> = vec![];
    let mut found = fit(problem, settings)?;
    let mut evaluations = found.evaluations;
    loop {
        let part = Fixed::new(problem, &fixed)?;
        let sure = uncertainty(&part, &found);
        let next = worst(&part, &sure, hints, &kept);
        let next = next.or_else(|| rivals(&part, &found, &sure, hints, &kept));
        let Some((next, value)) = next else {
            untold.extend(at_bounds(&sure, hints));
            untold.extend(correlated(&sure, hints));
            return Ok(Told {
                fit: found,
                uncertainty: sure,
                fixed,
                untold,
                evaluations,
            });
        };
        fixed.push(value);
        let without = again(problem, &fixed, &part, &found, settings)?;
        evaluations += without.evaluations;
        if next.reason != Reason::Unseen && grows(&found, &without, sure.effective_rows) {
            // The trace does object to that value.
            fixed.pop();
            kept.push(value.0);
        } else {
            found = without;
            untold.push(next);
        }
    }
}

/// Whether the residual without a parameter is larger beyond chance.
fn grows(with: &Fit, without: &Fit, effective_rows: f64) -> bool {
    2.0 * (without.residual_rms() / with.residual_rms()).ln() > GROWTH / effective_rows.max(FEWEST)
}

/// The fit without one more parameter: from the earlier answer, or from all starts where that depended on them.
fn again(
    problem: &dyn Separable,
    fixed: &[(&'static str, f64)],
    before: &Fixed,
    found: &Fit,
    settings: &FitSettings,
) -> Result<Fit, FitError> {
    let mut part = Fixed::new(problem, fixed)?;
    if matches!(found.verdict, Verdict::DependsOnStart { .. }) {
        return fit(&part, settings);
    }
    let known: Vec<(&str, f64)> = before
        .nonlinear()
        .iter()
        .map(|parameter| parameter.name)
        .zip(found.nonlinear.iter().copied())
        .collect();
    part.start_at(&known);
    let next = fit(
        &part,
        &FitSettings {
            starts: 1,
            finished: 1,
            ..*settings
        },
    )?;
    Ok(Fit {
        verdict: found.verdict.clone(),
        starts: found.starts.clone(),
        ..next
    })
}

/// Half width of an interval relative to its value.
fn vagueness(interval: &Interval) -> f64 {
    match interval.scale {
        Scale::Logarithmic => interval.half_width,
        Scale::Linear => interval.half_width / interval.value.abs().max(f64::MIN_POSITIVE),
    }
}

/// Half of the range of the bounds in the inner coordinate, or a factor of ten where that is less.
fn half_range(interval: &Interval) -> f64 {
    let [low, high] = interval.bounds;
    match interval.scale {
        Scale::Linear => 0.5 * (high - low),
        Scale::Logarithmic => (0.5 * (high / low).ln()).min(std::f64::consts::LN_10),
    }
}

/// Whether an interval is as wide as its bounds, or of a factor of ten to both sides.
pub fn is_wide(interval: &Interval) -> bool {
    interval.half_width >= half_range(interval)
}

/// What is to be set next, and to what value.
fn worst(
    problem: &dyn Separable,
    sure: &Uncertainty,
    hints: &dyn Hints,
    kept: &[&str],
) -> Option<(Untold, (&'static str, f64))> {
    let open = |k: &usize| {
        let name = sure.intervals[*k].name;
        !hints.needed(name) && !kept.contains(&name)
    };
    let vaguest = |from: &[usize], size: &dyn Fn(usize) -> f64| {
        let open = from.iter().copied().filter(open);
        open.max_by(|a, b| size(*a).total_cmp(&size(*b)))
    };
    if let Some(unseen) = unseen(problem, sure, hints) {
        return Some(unseen);
    }
    // Before the null direction: the parameters that it names may be known well once this one is set.
    if let Some(vaguer) = vaguer_than_prior(problem, sure, hints, kept) {
        return Some(vaguer);
    }
    let all: Vec<usize> = (0..sure.intervals.len()).collect();
    let part = |k: usize| sure.null_direction[k].powi(2);
    let members: Vec<usize> = all.iter().copied().filter(|k| part(*k) > PART).collect();
    let vague = |k: usize| vagueness(&sure.intervals[k]);
    let chosen = vaguest(&members, &|k| part(k) * vague(k).min(VAGUEST));
    let (names, chosen, reason) = match chosen {
        Some(k) if sure.condition > CONDITION && vague(k) > VAGUE => {
            (members, k, Reason::NullDirection(sure.condition))
        }
        _ => {
            let is = |k: &usize| is_wide(&sure.intervals[*k]);
            let wide: Vec<usize> = all.iter().copied().filter(is).collect();
            let width = |k: usize| sure.intervals[k].half_width / half_range(&sure.intervals[k]);
            if let Some(k) = vaguest(&wide, &width) {
                (vec![k], k, Reason::Wide)
            } else {
                let mut bounds = all.into_iter().filter(|k| sure.intervals[*k].at_bound);
                let k = bounds.find(open)?;
                (vec![k], k, Reason::AtBound)
            }
        }
    };
    let names: Vec<&'static str> = names.into_iter().map(|k| sure.intervals[k].name).collect();
    let name = sure.intervals[chosen].name;
    let value = prior(problem, name, hints);
    let what = match reason {
        Reason::NullDirection(_) if names.len() > 1 => "the trace sees only their combination",
        Reason::AtBound => "it ended at its bound, which no trace tells",
        _ => "the trace does not show it",
    };
    let lacking = hints.lacking(&names).filter(|_| reason != Reason::AtBound);
    let because = lacking.unwrap_or_else(|| what.into());
    Some(setting(
        &sure.intervals[chosen],
        value,
        (names, reason),
        (because, hints),
    ))
}

/// The first parameter that the sensors cannot have seen, and the value that it is set to.
fn unseen(
    problem: &dyn Separable,
    sure: &Uncertainty,
    hints: &dyn Hints,
) -> Option<(Untold, (&'static str, f64))> {
    sure.intervals.iter().find_map(|interval| {
        let because = hints.unseen(interval)?;
        let value = prior(problem, interval.name, hints);
        let of = (vec![interval.name], Reason::Unseen);
        Some(setting(interval, value, of, (because, hints)))
    })
}

/// The first parameter that the trace identifies less well than what is assumed without it, and the value that it is set to.
fn vaguer_than_prior(
    problem: &dyn Separable,
    sure: &Uncertainty,
    hints: &dyn Hints,
    kept: &[&str],
) -> Option<(Untold, (&'static str, f64))> {
    let vaguer = |interval: &&Interval| {
        let deviation = hints.prior_deviation(interval.name);
        deviation.is_some_and(|deviation| interval.standard_error > deviation)
            && !kept.contains(&interval.name)
    };
    let interval = sure.intervals.iter().find(vaguer)?;
    let names = vec![interval.name];
    let value = prior(problem, interval.name, hints);
    let because = hints.lacking(&names);
    let because = because.unwrap_or_else(|| "the trace does not show it".into());
    let of = (names, Reason::Prior);
    Some(setting(interval, value, of, (because, hints)))
}

/// Of the parameters in which answers with the same residual differ, the one that is set, and its value.
fn rivals(
    problem: &dyn Separable,
    found: &Fit,
    sure: &Uncertainty,
    hints: &dyn Hints,
    kept: &[&str],
) -> Option<(Untold, (&'static str, f64))> {
    let Verdict::DependsOnStart { names } = &found.verdict else {
        return None;
    };
    let name = hints
        .assumed(names)
        .filter(|name| !kept.contains(name) && !hints.needed(name))?;
    let interval = sure
        .intervals
        .iter()
        .find(|interval| interval.name == name)?;
    let value = prior(problem, name, hints);
    let lacking = hints.lacking(&[name]);
    let because = format!(
        "answers that differ in them have the same residual{}",
        lacking.map_or_else(String::new, |text| format!("; {text}"))
    );
    let of = (names.clone(), Reason::Rivals);
    Some(setting(interval, value, of, (because, hints)))
}

/// A parameter that is set, with a sentence.
fn setting(
    chosen: &Interval,
    value: f64,
    (names, reason): (Vec<&'static str>, Reason),
    (because, hints): (String, &dyn Hints),
) -> (Untold, (&'static str, f64)) {
    let name = chosen.name;
    let unit = if chosen.unit == "1" { "" } else { chosen.unit };
    let set = format!(
        "{} is set to {value}{}{unit}",
        words(&[name], hints),
        if unit.is_empty() { "" } else { " " }
    );
    let sentence = format!("{}: {because}; {set}", words(&names, hints));
    let untold = Untold {
        names,
        reason,
        fixed: Some((name, value)),
        sentence,
    };
    (untold, (name, value))
}

fn prior(problem: &dyn Separable, name: &str, hints: &dyn Hints) -> f64 {
    hints.prior(name).unwrap_or_else(|| {
        let nonlinear = problem
            .nonlinear()
            .iter()
            .find(|parameter| parameter.name == name)
            .map(|p| p.start);
        let linear = problem
            .linear()
            .iter()
            .find(|parameter| parameter.name == name);
        nonlinear
            .or(linear.map(|parameter| 0.0f64.clamp(parameter.low, parameter.high)))
            .unwrap_or(0.0)
    })
}

/// "a", "a and b", "a, b and c", in plain words.
fn words(names: &[&str], hints: &dyn Hints) -> String {
    let plain = |name: &&str| hints.words(name).unwrap_or_else(|| name.replace('_', " "));
    match names {
        [] => String::new(),
        [one] => plain(one),
        [first @ .., last] => {
            format!(
                "{} and {}",
                first.iter().map(plain).collect::<Vec<_>>().join(", "),
                plain(last)
            )
        }
    }
}

/// What ended at a bound all the same.
pub fn at_bounds(sure: &Uncertainty, hints: &dyn Hints) -> Vec<Untold> {
    let untold = |interval: &Interval| {
        let names = vec![interval.name];
        let because = hints
            .lacking(&names)
            .map_or(String::new(), |text| format!("; {text}"));
        let sentence = format!(
            "{}: ended at its bound of {:.4}, so the trace asks for a value beyond it, and what is estimated beside it can be off by more than its \
             interval{because}",
            words(&names, hints),
            interval.value
        );
        Untold {
            names,
            reason: Reason::AtBound,
            fixed: None,
            sentence,
        }
    };
    sure.intervals
        .iter()
        .filter(|interval| interval.at_bound)
        .map(untold)
        .collect()
}

fn correlated(sure: &Uncertainty, hints: &dyn Hints) -> Vec<Untold> {
    let count = sure.intervals.len();
    let pairs = (0..count).flat_map(|a| (a + 1..count).map(move |b| (a, b)));
    let strong = pairs.filter(|pair| sure.correlation[*pair].abs() > CORRELATION);
    let untold = |(a, b): (usize, usize)| {
        let correlation = sure.correlation[(a, b)];
        let names = vec![sure.intervals[a].name, sure.intervals[b].name];
        let because = hints
            .lacking(&names)
            .unwrap_or_else(|| "their combination is told better than either of them".into());
        let sentence = format!(
            "{}: correlation {correlation:.3}; {because}",
            words(&names, hints)
        );
        Untold {
            names,
            reason: Reason::Correlation(correlation),
            fixed: None,
            sentence,
        }
    };
    strong.map(untold).collect()
}

#[cfg(test)]
mod tests;
