//! What many traces say together, as sums that merge: every trace adds its own, sums of parts add up to those of the whole.
//!
//! Each trace gives its Gauss-Newton sums about a common reference: the information `A` of its parameters (the inverse of their
//! covariance, which knows that neighbouring rows err alike), its pull `A (q - q_ref)`, numbers of rows. From the merged sums follow
//!
//! - the common parameters, as if all traces had been fitted at once ([`Sums::common`]);
//! - the population ([`Sums::population`]): mean and spread of each parameter between the traces, in which every trace errs by its own
//!   variance. The spread is Paule and Mandel's (1982), which solves `sum w (q - mean)^2 = n - 1`, `w = 1 / (variance + spread^2)`, and
//!   whose first step is DerSimonian and Laird's. As this needs the variances one by one, traces are summed by half octaves of their
//!   variance, and a trace counts with the mean variance of its class.
//!
//! Errors of the model itself are the same in every trace of a screw. No mean takes them out: they widen the interval of the mean, by as
//! much as the traces say each of itself, and have no part in the weights or the spread.
//!
//! Every sum is kept in two numbers (value and rounding), so that the order and the grouping move the result by parts of 1e-30, and
//! the answer from any partition is the same to the last rounding. Classes and counts are whole numbers.

mod population;
mod reference;
mod sum;
#[cfg(test)]
mod tests;

use std::collections::BTreeMap;
use std::fmt;

use nalgebra::{DMatrix, DVector};
use serde::{Deserialize, Serialize};

pub use self::population::Population;
use self::population::{Class, population};
pub use self::reference::Reference;
use self::sum::Sum;
use crate::fit::cramer_rao::inverse;
use crate::fit::problem::{inner, outer};
use crate::fit::uncertainty::Uncertainty;

/// Why sums cannot be made or merged.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum SumsError {
    /// The two are about other parameters or values.
    OtherReference,
    /// The reference does not have a parameter, or has it on another scale.
    Unknown(String),
    /// A value, a covariance or a reference value is not finite, or not positive where it has to be.
    NotFinite(String),
}

impl fmt::Display for SumsError {
    fn fmt(&self, text: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::OtherReference => {
                write!(text, "sums about different references cannot be merged")
            }
            Self::Unknown(name) => write!(
                text,
                "{name}: the reference of the sums has no such parameter"
            ),
            Self::NotFinite(name) => {
                write!(text, "{name}: not a finite number with a positive variance")
            }
        }
    }
}

impl std::error::Error for SumsError {}

/// Sums over traces.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Sums {
    references: Vec<Reference>,
    traces: u64,
    rows: u64,
    effective_rows: Sum,
    residual_squares: Sum,
    /// Information, row by row.
    information: Vec<Sum>,
    pull: Vec<Sum>,
    /// `(q - q_ref)' A (q - q_ref)`.
    square: Sum,
    /// Traces by half octaves of their variance, for each parameter.
    classes: Vec<BTreeMap<i32, Class>>,
}

impl Sums {
    /// No trace yet.
    ///
    /// # Errors
    ///
    /// A reference value that is not finite, or not positive on a logarithmic scale.
    pub fn new(references: Vec<Reference>) -> Result<Self, SumsError> {
        let count = references.len();
        let wrong = |reference: &&Reference| !inner(reference.scale(), reference.value).is_finite();
        if let Some(reference) = references.iter().find(wrong) {
            return Err(SumsError::NotFinite(reference.name.clone()));
        }
        Ok(Self {
            references,
            traces: 0,
            rows: 0,
            effective_rows: Sum::default(),
            residual_squares: Sum::default(),
            information: vec![Sum::default(); count * count],
            pull: vec![Sum::default(); count],
            square: Sum::default(),
            classes: vec![BTreeMap::new(); count],
        })
    }

    /// Number of traces.
    pub fn traces(&self) -> u64 {
        self.traces
    }

    /// Number of rows of all traces, and how many count as independent.
    pub fn rows(&self) -> (u64, f64) {
        (self.rows, self.effective_rows.total())
    }

    /// Root of the mean square of all rows' residuals.
    pub fn residual_rms(&self) -> f64 {
        (self.residual_squares.total() / self.rows as f64).sqrt()
    }

    /// Adds a trace's fit. Parameters of the reference that the fit does not have were not told by the trace, and get nothing.
    ///
    /// # Errors
    ///
    /// A parameter that the reference does not have, or numbers that are not finite; the sums stay as they were.
    pub fn add(&mut self, residual: &[f64], sure: &Uncertainty) -> Result<(), SumsError> {
        let mut places = vec![];
        let mut deviations = vec![];
        for (k, interval) in sure.intervals.iter().enumerate() {
            let place = self
                .references
                .iter()
                .position(|reference| reference.name == interval.name);
            let place = place.filter(|place| self.references[*place].scale() == interval.scale);
            let place = place.ok_or_else(|| SumsError::Unknown(interval.name.into()))?;
            let reference = &self.references[place];
            let deviation =
                inner(interval.scale, interval.value) - inner(interval.scale, reference.value);
            let variance = sure.covariance[(k, k)];
            let told = deviation.is_finite() && variance.is_finite() && variance > 0.0;
            if !(told && interval.model_error.is_finite()) {
                return Err(SumsError::NotFinite(interval.name.into()));
            }
            places.push(place);
            deviations.push(deviation);
        }
        let information =
            inverse(&sure.covariance).ok_or_else(|| SumsError::NotFinite("covariance".into()))?;
        let deviation = DVector::from_vec(deviations);
        let pull = &information * &deviation;
        let count = self.references.len();
        for (i, into) in places.iter().enumerate() {
            for (j, column) in places.iter().enumerate() {
                self.information[into * count + column].add(information[(i, j)]);
            }
            self.pull[*into].add(pull[i]);
            let variance = sure.covariance[(i, i)];
            let class = self.classes[*into]
                .entry((2.0 * variance.log2()).floor() as i32)
                .or_default();
            class.traces += 1;
            class.variance.add(variance);
            class.model_error.add(sure.intervals[i].model_error);
            class.deviation.add(deviation[i]);
            class.squares.add(deviation[i] * deviation[i]);
        }
        self.square.add(pull.dot(&deviation));
        self.traces += 1;
        self.rows += residual.len() as u64;
        self.effective_rows.add(sure.effective_rows);
        self.residual_squares
            .add(residual.iter().map(|r| r * r).sum());
        Ok(())
    }

    /// Adds other sums.
    ///
    /// # Errors
    ///
    /// Sums about another reference.
    pub fn merge(&mut self, other: &Self) -> Result<(), SumsError> {
        if self.references != other.references {
            return Err(SumsError::OtherReference);
        }
        self.traces += other.traces;
        self.rows += other.rows;
        self.effective_rows.merge(other.effective_rows);
        self.residual_squares.merge(other.residual_squares);
        self.square.merge(other.square);
        let sums = self.information.iter_mut().chain(&mut self.pull);
        sums.zip(other.information.iter().chain(&other.pull))
            .for_each(|(into, sum)| into.merge(*sum));
        for (into, classes) in self.classes.iter_mut().zip(&other.classes) {
            for (key, class) in classes {
                let into = into.entry(*key).or_default();
                into.traces += class.traces;
                into.variance.merge(class.variance);
                into.model_error.merge(class.model_error);
                into.deviation.merge(class.deviation);
                into.squares.merge(class.squares);
            }
        }
        Ok(())
    }

    /// Parameters with one value for all traces, as if fitted at once: names, values, standard errors of the inner coordinates, and
    /// chi-squared per degree of freedom, which is 1 where the traces differ by their errors only. `None` where the traces together do
    /// not tell all parameters that any of them tells.
    pub fn common(&self) -> Option<Common> {
        let count = self.references.len();
        let told: Vec<usize> = (0..count)
            .filter(|k| !self.classes[*k].is_empty())
            .collect();
        let entry = |i: usize, j: usize| self.information[told[i] * count + told[j]].total();
        let information = DMatrix::from_fn(told.len(), told.len(), entry);
        let pull = DVector::from_iterator(told.len(), told.iter().map(|k| self.pull[*k].total()));
        let covariance = inverse(&information)?;
        let deviation = &covariance * &pull;
        let values: u64 = told
            .iter()
            .flat_map(|k| self.classes[*k].values())
            .map(|class| class.traces)
            .sum();
        let freedom = values as f64 - told.len() as f64;
        let left = self.square.total() - pull.dot(&deviation);
        let parameter = |(i, k): (usize, &usize)| {
            let reference = &self.references[*k];
            let place = inner(reference.scale(), reference.value) + deviation[i];
            let classes = self.classes[*k].values();
            let shared: f64 = classes.map(|class| class.model_error.total()).sum();
            let traces: u64 = self.classes[*k].values().map(|class| class.traces).sum();
            (
                reference.name.clone(),
                outer(reference.scale(), place),
                covariance[(i, i)].sqrt().hypot(shared / traces as f64),
            )
        };
        Some(Common {
            parameters: told.iter().enumerate().map(parameter).collect(),
            chi_squared: (freedom > 0.0).then(|| left / freedom),
        })
    }

    /// Mean and spread of every parameter that a trace tells.
    pub fn population(&self) -> Vec<Population> {
        let told = self
            .references
            .iter()
            .zip(&self.classes)
            .filter(|(_, classes)| !classes.is_empty());
        told.map(|(reference, classes)| population(reference, classes))
            .collect()
    }
}

/// Parameters with one value for all traces.
#[derive(Clone, Debug, PartialEq)]
pub struct Common {
    /// Name, value, and standard error of the inner coordinate.
    pub parameters: Vec<(String, f64, f64)>,
    /// Chi-squared per degree of freedom; `None` without any.
    pub chi_squared: Option<f64>,
}
