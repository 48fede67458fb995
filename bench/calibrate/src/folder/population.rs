//! What traces tell together: the population of each parameter, and the traces that stand out of it.

use serde::Serialize;
use serde_json::{Value, json};

use super::store::{Ended, Stored, Told};
use crate::sums::{Population, Sums};
use epas_page::failure::Failure;

/// Standard deviations beyond which a trace stands out: of a normal population one in 1.7 million does by chance.
const OUT: f64 = 5.0;

/// Median of the distances from the median, of a normal population, over its standard deviation.
const MEDIAN_DISTANCE: f64 = 0.6745;

/// Half of a 95 % interval over its standard deviation.
const HALF_INTERVAL: f64 = 1.96;

/// Traces of which a median says something.
const ENOUGH: usize = 5;

/// A parameter of a trace that is far from the others'.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Outlier {
    /// Name of the trace's file.
    pub trace: String,
    /// Name of the parameter.
    pub parameter: String,
    /// Its value there.
    pub value: f64,
    /// Median of all traces.
    pub median: f64,
    /// Distance from the median in standard deviations: of the population and of the trace's own error together.
    pub deviations: f64,
}

/// Answers of all traces, and what follows from them together.
pub struct Together {
    /// One for each trace, in the order of their names.
    pub traces: Vec<Stored>,
    /// Parameters of which at least one trace tells.
    pub population: Vec<Population>,
    /// The same without the traces that stand out; empty where none does.
    pub without_outliers: Vec<Population>,
    /// What stands out.
    pub outliers: Vec<Outlier>,
}

impl Together {
    /// Puts traces in the order of their names, and adds up their sums.
    ///
    /// # Errors
    /// Sums that do not belong together.
    pub fn of(mut traces: Vec<Stored>) -> Result<Self, Failure> {
        traces.sort_by(|one, other| one.trace.cmp(&other.trace));
        let outliers = outliers(&traces);
        let far = |stored: &&Stored| outliers.iter().any(|out| out.trace == stored.trace);
        let population = population(traces.iter())?;
        let without_outliers = if outliers.is_empty() {
            Vec::new()
        } else {
            self::population(traces.iter().filter(|stored| !far(stored)))?
        };
        Ok(Self {
            traces,
            population,
            without_outliers,
            outliers,
        })
    }

    /// Traces that told something.
    pub fn told(&self) -> impl Iterator<Item = (&str, &Told)> {
        self.traces.iter().filter_map(|stored| match &stored.ended {
            Ended::Told(told) => Some((stored.trace.as_str(), &**told)),
            Ended::Refused(_) => None,
        })
    }

    /// Traces that were refused, with the reason.
    pub fn refused(&self) -> impl Iterator<Item = (&str, &str)> {
        self.traces.iter().filter_map(|stored| match &stored.ended {
            Ended::Told(_) => None,
            Ended::Refused(word) => Some((stored.trace.as_str(), word.as_str())),
        })
    }

    /// The failure where no trace told anything.
    pub fn nothing_told(&self) -> Option<Failure> {
        if self.told().next().is_some() {
            return None;
        }
        let word = self.refused().next().map_or_else(
            || "there is none".into(),
            |(trace, word)| format!("{trace}: {word}"),
        );
        Some(Failure::Data(format!("no trace tells anything; {word}")))
    }

    /// One JSON object.
    pub fn json(&self) -> Value {
        let traces: serde_json::Map<String, Value> = self
            .traces
            .iter()
            .map(|stored| {
                let answer = match &stored.ended {
                    Ended::Told(told) => {
                        let parameters: serde_json::Map<String, Value> = told
                            .parameters
                            .iter()
                            .map(|parameter| {
                                let entry = json!({
                                    "value": parameter.value,
                                    "low": parameter.low,
                                    "high": parameter.high,
                                    "fixed": parameter.fixed,
                                    "unit": parameter.unit,
                                });
                                (parameter.name.clone(), entry)
                            })
                            .collect();
                        json!({
                            "parameters": parameters,
                            "residual_rms": told.residual_rms,
                            "relative_error": told.relative_error,
                            "cannot_tell": told.cannot_tell,
                        })
                    }
                    Ended::Refused(word) => json!({ "error": word }),
                };
                (stored.trace.clone(), answer)
            })
            .collect();
        json!({
            "traces": traces,
            "population": self.population,
            "population_without_outliers": self.without_outliers,
            "outliers": self.outliers,
        })
    }
}

/// Mean and spread of every parameter from the merged sums.
fn population<'a>(traces: impl Iterator<Item = &'a Stored>) -> Result<Vec<Population>, Failure> {
    let mut whole: Option<Sums> = None;
    for stored in traces {
        let Ended::Told(told) = &stored.ended else {
            continue;
        };
        match &mut whole {
            None => whole = Some(told.sums.clone()),
            Some(whole) => whole
                .merge(&told.sums)
                .map_err(|error| Failure::Data(format!("{}: {error}", stored.trace)))?,
        }
    }
    Ok(whole.map(|sums| sums.population()).unwrap_or_default())
}

/// Parameters far from the median. The median and the median distance hardly move with what stands out, as mean and spread do.
fn outliers(traces: &[Stored]) -> Vec<Outlier> {
    let mut names: Vec<&str> = Vec::new();
    let mut all: Vec<(&str, &str, f64, f64)> = Vec::new();
    for stored in traces {
        let Ended::Told(told) = &stored.ended else {
            continue;
        };
        for parameter in told.parameters.iter().filter(|parameter| !parameter.fixed) {
            let (Some(value), Some(low), Some(high)) =
                (parameter.value, parameter.low, parameter.high)
            else {
                continue;
            };
            let error = 0.5 * (high - low) / HALF_INTERVAL;
            if !names.contains(&parameter.name.as_str()) {
                names.push(&parameter.name);
            }
            all.push((&parameter.name, &stored.trace, value, error));
        }
    }
    let mut outliers = Vec::new();
    for name in names {
        let own: Vec<_> = all.iter().filter(|entry| entry.0 == name).collect();
        if own.len() < ENOUGH {
            continue;
        }
        let median = middle(own.iter().map(|entry| entry.2).collect());
        let distances = own.iter().map(|entry| (entry.2 - median).abs()).collect();
        let spread = middle(distances) / MEDIAN_DISTANCE;
        for (_, trace, value, error) in own {
            let deviations = (value - median) / spread.hypot(*error).max(f64::MIN_POSITIVE);
            if deviations.abs() > OUT {
                outliers.push(Outlier {
                    trace: (*trace).into(),
                    parameter: name.into(),
                    value: *value,
                    median,
                    deviations,
                });
            }
        }
    }
    outliers
}

/// Median; the mean of both middle ones where there are two.
fn middle(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    let half = values.len() / 2;
    match (values.len() % 2, values.get(half), half.checked_sub(1)) {
        (1, Some(middle), _) => *middle,
        (0, Some(upper), Some(lower)) => 0.5 * (upper + values[lower]),
        _ => f64::NAN,
    }
}
