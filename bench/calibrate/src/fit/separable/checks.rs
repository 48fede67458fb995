//! What a separable problem must keep, and the error when it does not.

use std::fmt;

use crate::fit::problem::{Evaluation, Parameter, Scale, Separable};

/// Why a problem cannot be fitted.
#[derive(Clone, Debug, PartialEq)]
pub enum FitError {
    /// Fewer rows than parameters.
    TooFewRows {
        /// Rows of the target.
        rows: usize,
        /// Parameters of both kinds.
        parameters: usize,
    },
    /// A number that is not finite.
    NotFinite {
        /// Where it stands: `target`, or the name of a parameter.
        what: String,
        /// Its row, or 0.
        row: usize,
    },
    /// The model's number of columns or rows is not the problem's.
    Shape {
        /// Rows of the target and number of linear parameters.
        expected: [usize; 2],
        /// What the model gave.
        found: [usize; 2],
    },
    /// Bounds that hold no value, are not finite, or leave the start outside.
    Bounds {
        /// Name of the parameter.
        name: &'static str,
        /// Smallest value, start, largest value.
        values: [f64; 3],
    },
    /// A setting outside its range.
    Setting {
        /// Name of the setting.
        name: &'static str,
        /// Its value.
        value: f64,
        /// Allowed range.
        allowed: &'static str,
    },
    /// No parameter has this name.
    Unknown {
        /// The name.
        name: String,
    },
    /// The model is not finite at any start.
    NoStart,
}

impl fmt::Display for FitError {
    fn fmt(&self, text: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::TooFewRows { rows, parameters } => {
                write!(text, "{rows} rows are too few for {parameters} parameters")
            }
            Self::NotFinite { what, row } => {
                write!(text, "{what}: not a finite number (row {row})")
            }
            Self::Shape {
                expected: [rows, columns],
                found: [r, c],
            } => {
                write!(
                    text,
                    "the model has {r} rows and {c} columns; {rows} and {columns} are expected"
                )
            }
            Self::Bounds {
                name,
                values: [low, start, high],
            } => write!(
                text,
                "{name}: bounds {low} to {high} with start {start}; finite bounds in this order are needed, \
                 above zero where the scale is logarithmic"
            ),
            Self::Setting {
                name,
                value,
                allowed,
            } => write!(text, "{name} = {value}: allowed is {allowed}"),
            Self::Unknown { name } => write!(text, "no parameter is called {name}"),
            Self::NoStart => write!(text, "the model is not finite at any start"),
        }
    }
}

impl std::error::Error for FitError {}

/// Checks all of a problem that needs no evaluation.
pub(super) fn check(problem: &dyn Separable) -> Result<(), FitError> {
    let rows = problem.target().len();
    let parameters = problem.nonlinear().len() + problem.linear().len();
    if rows <= parameters {
        return Err(FitError::TooFewRows { rows, parameters });
    }
    if let Some(row) = problem.target().iter().position(|value| !value.is_finite()) {
        return Err(FitError::NotFinite {
            what: "target".into(),
            row,
        });
    }
    problem.nonlinear().iter().try_for_each(check_bounds)?;
    for parameter in problem.linear() {
        if !(parameter.low < parameter.high) {
            let values = [parameter.low, f64::NAN, parameter.high];
            return Err(FitError::Bounds {
                name: parameter.name,
                values,
            });
        }
    }
    Ok(())
}

fn check_bounds(parameter: &Parameter) -> Result<(), FitError> {
    let Parameter {
        name,
        start,
        low,
        high,
        scale,
        ..
    } = *parameter;
    let positive = scale == Scale::Linear || low > 0.0;
    if low.is_finite()
        && high.is_finite()
        && low < high
        && low <= start
        && start <= high
        && positive
    {
        Ok(())
    } else {
        Err(FitError::Bounds {
            name,
            values: [low, start, high],
        })
    }
}

/// Checks the shape of the model.
pub(super) fn check_shape(problem: &dyn Separable, found: &Evaluation) -> Result<(), FitError> {
    let expected = [problem.target().len(), problem.linear().len()];
    let wrong = found
        .columns
        .iter()
        .map(Vec::len)
        .chain([found.fixed.len()])
        .find(|rows| *rows != expected[0]);
    if wrong.is_some() || found.columns.len() != expected[1] {
        let found = [wrong.unwrap_or(expected[0]), found.columns.len()];
        return Err(FitError::Shape { expected, found });
    }
    Ok(())
}

/// Whether the model is finite at every row.
pub(super) fn is_finite(evaluation: &Evaluation) -> bool {
    evaluation
        .columns
        .iter()
        .chain([&evaluation.fixed])
        .flatten()
        .all(|value| value.is_finite())
}
