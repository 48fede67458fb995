//! What one trace adds to what many tell together.

use std::io;

use nalgebra::DMatrix;
use serde::{Deserialize, Serialize};

use crate::fit::problem::Scale;
use crate::fit::uncertainty::Uncertainty;
use epas_page::failure::Failure;

/// Estimates of a trace with their covariance, as plain data: some kilobytes that are kept, sent and put beside others.
///
/// The lists have one entry a parameter. The inner coordinate is the logarithm of a value, or the value.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Answered {
    /// Whether the design of the screw is known: numbers of the two kinds of fit have one name and another meaning.
    pub with_design: bool,
    /// Names.
    pub names: Vec<String>,
    /// Whether the inner coordinate is the logarithm.
    pub logarithmic: Vec<bool>,
    /// Values.
    pub values: Vec<f64>,
    /// Covariance of the inner coordinates, row by row.
    pub covariance: Vec<f64>,
    /// Standard deviations of the inner coordinates by the model's own errors, which are the same in every trace.
    pub model_errors: Vec<f64>,
}

impl Answered {
    /// What a fit told.
    pub fn of(sure: &Uncertainty, with_design: bool) -> Result<Self, Failure> {
        let intervals = || sure.intervals.iter();
        let answered = Self {
            with_design,
            names: intervals().map(|own| own.name.to_owned()).collect(),
            logarithmic: intervals()
                .map(|own| own.scale == Scale::Logarithmic)
                .collect(),
            values: intervals().map(|own| own.value).collect(),
            covariance: sure.covariance.transpose().iter().copied().collect(),
            model_errors: intervals().map(|own| own.model_error).collect(),
        };
        answered.checked().map_err(Failure::Data)
    }

    /// Itself, where its lists belong together and its numbers are finite, with positive variances.
    pub fn checked(self) -> Result<Self, String> {
        let count = self.names.len();
        let lengths = [
            self.logarithmic.len(),
            self.values.len(),
            self.model_errors.len(),
        ];
        if lengths != [count; 3] || self.covariance.len() != count * count {
            return Err("lists of a trace's answer that do not belong together".into());
        }
        let finite = |k: usize| {
            let variance = self.covariance[k * (count + 1)];
            let all = [self.inner(k), self.model_errors[k], variance];
            all.iter().all(|number| number.is_finite()) && variance > 0.0
        };
        match (0..count).find(|k| !finite(*k)) {
            Some(k) => Err(format!(
                "{}: not a finite number with a positive variance",
                self.names[k]
            )),
            None if DMatrix::from_row_slice(count, count, &self.covariance)
                .cholesky()
                .is_none() =>
            {
                Err("no covariance of its parameters".into())
            }
            None => Ok(self),
        }
    }

    /// A value's inner coordinate.
    pub(super) fn inner(&self, k: usize) -> f64 {
        let value = self.values[k];
        if self.logarithmic[k] {
            value.ln()
        } else {
            value
        }
    }

    /// Variance of an inner coordinate.
    pub(super) fn variance(&self, k: usize) -> f64 {
        self.covariance[k * (self.names.len() + 1)]
    }
}

/// Answers of parts as those of the whole: sorted by what they say, so that no order or grouping is left in them.
pub fn merged<'a>(parts: impl IntoIterator<Item = &'a str>) -> Result<Vec<Answered>, String> {
    let mut all = Vec::new();
    for part in parts {
        let list: Vec<Answered> =
            serde_json::from_str(part).map_err(|error| format!("no answers of traces: {error}"))?;
        for answered in list {
            let answered = answered.checked()?;
            let text = serde_json::to_string(&answered).map_err(io::Error::from);
            all.push((text.map_err(|error| error.to_string())?, answered));
        }
    }
    all.sort_by(|one, other| one.0.cmp(&other.0));
    let all: Vec<Answered> = all.into_iter().map(|(_, answered)| answered).collect();
    alike(&all.iter().collect::<Vec<_>>())?;
    Ok(all)
}

/// Whether answers may stand in one population.
pub(super) fn alike(all: &[&Answered]) -> Result<(), String> {
    if all
        .windows(2)
        .any(|pair| pair[0].with_design != pair[1].with_design)
    {
        return Err("traces with a design and without one have no numbers in common".into());
    }
    let mut scales = std::collections::BTreeMap::new();
    for answered in all {
        for (name, logarithmic) in answered.names.iter().zip(&answered.logarithmic) {
            if scales.entry(name).or_insert(logarithmic) != &logarithmic {
                return Err(format!("{name} is told on two scales"));
            }
        }
    }
    Ok(())
}
