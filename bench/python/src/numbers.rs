//! Arguments of functions: names, values, ranges.

use epas_friction::geometry::Groove;
use pyo3::prelude::*;

use crate::argument::Argument;
use crate::arrays::Arguments;
use crate::errors::{Refused, refused};

/// A groove by its name.
///
/// # Errors
/// Any other name.
pub fn groove(py: Python<'_>, name: &str) -> PyResult<Groove> {
    match name {
        "screw" => Ok(Groove::Screw),
        "nut" => Ok(Groove::Nut),
        _ => {
            let message = format!("groove = {name:?} is none of: screw, nut");
            Err(refused(py, Refused::value("groove", message)))
        }
    }
}

/// A value within a range that `eval` sets, not the crate.
///
/// # Errors
/// A value outside.
pub fn within(field: &str, value: f64, minimum: f64, maximum: f64) -> Result<(), Refused> {
    if (minimum..=maximum).contains(&value) {
        Ok(())
    } else {
        Err(Refused::range(field, value, minimum, maximum))
    }
}

/// Names and values of arguments, in order.
///
/// # Errors
/// What is no number.
pub fn arguments<'py, const I: usize>(
    py: Python<'py>,
    names: [&'static str; I],
    values: [&Bound<'py, PyAny>; I],
) -> PyResult<Arguments<'py, I>> {
    let mut arguments = Vec::with_capacity(I);
    for (name, value) in names.into_iter().zip(values) {
        arguments.push(Argument::new(name, value)?);
    }
    let arguments = arguments
        .try_into()
        .map_err(|_| pyo3::exceptions::PyRuntimeError::new_err("arguments"))?;
    Arguments::new(py, arguments)
}

/// The number zero.
pub fn zero(py: Python<'_>) -> Bound<'_, PyAny> {
    pyo3::types::PyFloat::new(py, 0.0).into_any()
}
