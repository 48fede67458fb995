//! Arguments of functions: names, values, ranges.

use epas_friction::geometry::Groove;
use pyo3::prelude::*;

use crate::argument::Argument;
use crate::arrays::Arguments;
use crate::blocks::Real as _;
use crate::errors::{Refused, refused};

/// A groove by its name.
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
pub fn within(field: &str, value: f64, minimum: f64, maximum: f64) -> Result<(), Refused> {
    if (minimum..=maximum).contains(&value) {
        Ok(())
    } else {
        Err(Refused::range(field, value, minimum, maximum))
    }
}

/// A number in single precision.
pub fn single(py: Python<'_>, field: &str, value: f64) -> PyResult<f32> {
    if f32::loses(value) {
        return Err(refused(py, Refused::lost(field, value)));
    }
    Ok(value as f32)
}

/// The same of a number that may be left out.
pub fn single_or(py: Python<'_>, field: &str, value: Option<f64>, usual: f32) -> PyResult<f32> {
    value.map_or(Ok(usual), |value| single(py, field, value))
}

/// Both ends of a range in single precision, or the same number twice where it is left out.
pub fn range_or(
    py: Python<'_>,
    field: &str,
    range: Option<(f64, f64)>,
    usual: f32,
) -> PyResult<(f32, f32)> {
    let Some((least, largest)) = range else {
        return Ok((usual, usual));
    };
    Ok((single(py, field, least)?, single(py, field, largest)?))
}

/// Names and values of arguments, in order.
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
