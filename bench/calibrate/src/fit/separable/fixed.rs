//! A problem some of whose parameters have a given value.

use crate::fit::problem::{Evaluation, LinearParameter, Parameter, Separable};

use super::checks::FitError;

/// A problem in which parameters of either kind, chosen by name, are no longer free.
pub struct Fixed<'a> {
    problem: &'a dyn Separable,
    nonlinear: Vec<Parameter>,
    linear: Vec<LinearParameter>,
    /// Value of each nonlinear parameter of the whole problem that is fixed.
    nonlinear_values: Vec<Option<f64>>,
    /// The same of the linear ones.
    linear_values: Vec<Option<f64>>,
}

impl<'a> Fixed<'a> {
    /// Fixes the named parameters.
    ///
    /// # Errors
    ///
    /// A name that the problem does not know, or a value that is not finite.
    pub fn new(problem: &'a dyn Separable, values: &[(&str, f64)]) -> Result<Self, FitError> {
        for (name, value) in values {
            let known = problem
                .nonlinear()
                .iter()
                .any(|parameter| parameter.name == *name)
                || problem
                    .linear()
                    .iter()
                    .any(|parameter| parameter.name == *name);
            if !known {
                return Err(FitError::Unknown {
                    name: (*name).into(),
                });
            }
            if !value.is_finite() {
                return Err(FitError::NotFinite {
                    what: (*name).into(),
                    row: 0,
                });
            }
        }
        let given = |wanted: &str| {
            values
                .iter()
                .find(|(name, _)| *name == wanted)
                .map(|(_, value)| *value)
        };
        let free = |name: &str| given(name).is_none();
        Ok(Self {
            problem,
            nonlinear: problem
                .nonlinear()
                .iter()
                .filter(|parameter| free(parameter.name))
                .cloned()
                .collect(),
            linear: problem
                .linear()
                .iter()
                .filter(|parameter| free(parameter.name))
                .cloned()
                .collect(),
            nonlinear_values: problem
                .nonlinear()
                .iter()
                .map(|parameter| given(parameter.name))
                .collect(),
            linear_values: problem
                .linear()
                .iter()
                .map(|parameter| given(parameter.name))
                .collect(),
        })
    }

    /// Moves the starts of the free nonlinear parameters; names that are not among them are passed over.
    pub fn start_at(&mut self, values: &[(&str, f64)]) {
        for (name, value) in values {
            for parameter in self
                .nonlinear
                .iter_mut()
                .filter(|parameter| parameter.name == *name)
            {
                parameter.start = value.clamp(parameter.low, parameter.high);
            }
        }
    }
}

impl Separable for Fixed<'_> {
    fn nonlinear(&self) -> &[Parameter] {
        &self.nonlinear
    }

    fn linear(&self) -> &[LinearParameter] {
        &self.linear
    }

    fn target(&self) -> &[f64] {
        self.problem.target()
    }

    fn row_step(&self) -> f64 {
        self.problem.row_step()
    }

    fn evaluate(&self, nonlinear: &[f64]) -> Evaluation {
        let mut free = nonlinear.iter().copied();
        let whole: Vec<f64> = self
            .nonlinear_values
            .iter()
            .map(|value| value.or_else(|| free.next()).unwrap_or(f64::NAN))
            .collect();
        let Evaluation { mut fixed, columns } = self.problem.evaluate(&whole);
        let mut left = Vec::with_capacity(self.linear.len());
        for (column, value) in columns.into_iter().zip(&self.linear_values) {
            match value {
                None => left.push(column),
                Some(value) => fixed
                    .iter_mut()
                    .zip(&column)
                    .for_each(|(sum, x)| *sum += value * x),
            }
        }
        Evaluation {
            fixed,
            columns: left,
        }
    }
}
