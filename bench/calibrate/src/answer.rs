//! What a calibration answers, whatever it fitted; as JSON it is the object of `calibrate --json`.

use serde::ser::{SerializeMap, Serializer};

use crate::fit::uncertainty::Interval;

/// A parameter's value with its interval.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Estimate {
    /// Name, as in a design file; in JSON the key.
    #[serde(skip)]
    pub name: String,
    /// Value.
    pub value: f64,
    /// Low end of the 95 % interval; the value where it is fixed, not finite where nothing bounds it.
    pub low: f64,
    /// High end.
    pub high: f64,
    /// Whether it was set instead of estimated.
    pub fixed: bool,
    /// Whether it ended at a bound of what is allowed: then it is no estimate, and is written nowhere.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub at_bound: bool,
    /// Unit; empty for a pure number.
    pub unit: &'static str,
}

impl Estimate {
    /// A parameter that was set.
    pub fn fixed(name: impl Into<String>, unit: &'static str, value: f64) -> Self {
        Self {
            name: name.into(),
            unit,
            value,
            low: value,
            high: value,
            fixed: true,
            at_bound: false,
        }
    }

    /// A parameter that was estimated.
    pub fn told(name: impl Into<String>, unit: &'static str, value: f64, half: f64) -> Self {
        Self {
            low: value - half,
            high: value + half,
            fixed: false,
            ..Self::fixed(name, unit, value)
        }
    }

    /// Half of the interval.
    pub fn half_width(&self) -> f64 {
        0.5 * (self.high - self.low)
    }
}

impl From<&Interval> for Estimate {
    fn from(interval: &Interval) -> Self {
        Self {
            low: interval.low,
            high: interval.high,
            at_bound: interval.at_bound,
            ..Self::told(interval.name, interval.unit, interval.value, 0.0)
        }
    }
}

/// How a model of friction does on the trace.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct ModelScore {
    /// Name of the model.
    pub name: String,
    /// Error of the effort over the effort, both as root mean squares: of the closed loop on the whole trace where the controller is
    /// known, else of the rows that were fitted.
    pub relative_error: f64,
    /// The same on the part, or the trace, that was not fitted; `None` where there is none.
    pub relative_error_unseen: Option<f64>,
    /// Residual of the fitted rows over effort.
    pub relative_error_inverse: f64,
    /// The same on rows that were not fitted.
    pub relative_error_inverse_unseen: Option<f64>,
    /// Error of the position in the closed loop, rms, rad or m.
    pub position_error: Option<f64>,
    /// Residual on that part, rms, N m or N.
    pub residual_unseen: Option<f64>,
    /// Bayes's information criterion, less the least one of the models: `n log(rss/n) + k log n` with the effective number `n` of
    /// rows.
    pub information_criterion: f64,
    /// Number of parameters that were fitted.
    pub parameters: usize,
    /// Modelled cycles of one tick on the reference core; `None` where nobody has counted.
    pub cycles: Option<u32>,
    /// Whether the cycles are estimated instead of counted.
    pub cycles_estimated: bool,
    /// Its parameters.
    #[serde(serialize_with = "by_name")]
    pub values: Vec<Estimate>,
}

/// What a trace says.
#[derive(Clone, Debug, Default, PartialEq, serde::Serialize)]
pub struct Calibration {
    /// Parameters, in the order in which they are told.
    #[serde(serialize_with = "by_name")]
    pub parameters: Vec<Estimate>,
    /// Residual, rms, N m or N, after the filter of both sides.
    pub residual_rms: f64,
    /// Residual over effort, both as root mean squares.
    pub relative_error: f64,
    /// Number of rows that count, with the correlation of the residual.
    pub effective_rows: f64,
    /// What the trace cannot tell, and what would: a sentence each.
    pub cannot_tell: Vec<String>,
    /// Models of friction on the same trace.
    pub models: Vec<ModelScore>,
    /// Name of the model that does best on what was not fitted.
    pub winner: Option<String>,
}

impl Calibration {
    /// A parameter by its name.
    pub fn parameter(&self, name: &str) -> Option<&Estimate> {
        self.parameters
            .iter()
            .find(|estimate| estimate.name == name)
    }

    /// Its value.
    pub fn value(&self, name: &str) -> Option<f64> {
        self.parameter(name).map(|estimate| estimate.value)
    }
}

/// A map from names, in order. A number that is not finite becomes `null`.
fn by_name<S: Serializer>(estimates: &[Estimate], serializer: S) -> Result<S::Ok, S::Error> {
    let mut map = serializer.serialize_map(Some(estimates.len()))?;
    for estimate in estimates {
        map.serialize_entry(&estimate.name, estimate)?;
    }
    map.end()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parameters_stand_by_name_in_their_order() {
        let calibration = Calibration {
            parameters: vec![
                Estimate {
                    high: f64::INFINITY,
                    ..Estimate::told("mass", "kg", 95.0, 1.0)
                },
                Estimate::fixed("friction", "", 0.1),
            ],
            residual_rms: 1.5,
            relative_error: 0.04,
            effective_rows: 100.0,
            cannot_tell: vec!["No load.".into()],
            ..Calibration::default()
        };
        let text = serde_json::to_string(&calibration).unwrap();
        let start = r#"{"parameters":{"mass":{"value":95.0,"low":94.0,"high":null,"fixed":false,"unit":"kg"},"friction":{"value":0.1,"low":0.1,"high":0.1,"fixed":true,"unit":""}},"residual_rms":1.5,"#;
        assert!(text.starts_with(start), "{text}");
        assert_eq!(calibration.value("friction"), Some(0.1));
    }
}
