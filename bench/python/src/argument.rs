//! One argument: a number, or an array that is not copied where it fits.

use numpy::{Element, PyArrayDyn, PyArrayMethods, PyReadonlyArrayDyn, PyUntypedArrayMethods};
use pyo3::exceptions::PyMemoryError;
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyFloat, PyInt, PyString};

use crate::blocks::Column;
use crate::errors::{Refused, refused};

/// An argument that holds numbers.
pub struct Argument<'py> {
    /// Its name.
    pub name: &'static str,
    source: Source<'py>,
}

enum Source<'py> {
    Number(f64),
    Single(PyReadonlyArrayDyn<'py, f32>),
    Double(PyReadonlyArrayDyn<'py, f64>),
}

impl<'py> Argument<'py> {
    /// A number, or an array of numbers. Arrays of float32 and float64 are taken as they are, others become float64.
    pub fn new(name: &'static str, value: &Bound<'py, PyAny>) -> PyResult<Self> {
        let source = match number(value) {
            Some(number) => Source::Number(number),
            None => array(name, value)?,
        };
        Ok(Self { name, source })
    }

    /// Its shape; empty for a number.
    pub fn shape(&self) -> &[usize] {
        match &self.source {
            Source::Number(_) => &[],
            Source::Single(array) => array.shape(),
            Source::Double(array) => array.shape(),
        }
    }

    /// Repeats an array along a shape, without a copy; one of a single value stays as it is.
    pub fn broadcast(&mut self, py: Python<'py>, shape: &[usize]) -> PyResult<()> {
        let array = match &self.source {
            Source::Single(array) if array.len() != 1 && array.shape() != shape => {
                array.as_any().clone()
            }
            Source::Double(array) if array.len() != 1 && array.shape() != shape => {
                array.as_any().clone()
            }
            _ => return Ok(()),
        };
        let repeated = py
            .import("numpy")?
            .call_method1("broadcast_to", (array, shape.to_vec()))?;
        if let Some(source) = taken(&repeated) {
            self.source = source;
        }
        Ok(())
    }

    /// Its values.
    pub fn column(&self) -> Column<'_> {
        match &self.source {
            Source::Number(number) => Column::Constant(*number),
            Source::Single(array) => column(array, Column::Single),
            Source::Double(array) => column(array, Column::Double),
        }
    }
}

/// Values of an array: as they lie in memory where that is their order, else by strides.
fn column<'a, S: Element + Copy + Sync + Into<f64>>(
    array: &'a PyReadonlyArrayDyn<'_, S>,
    plain: fn(&'a [S]) -> Column<'a>,
) -> Column<'a> {
    // A slice is there for arrays in the order of Fortran too, whose values lie in another order.
    match array.as_slice() {
        Ok([value]) => Column::Constant((*value).into()),
        Ok(values) if array.is_c_contiguous() => plain(values),
        _ => {
            let values = array.as_array().into_iter();
            Column::Strided(Box::new(values.map(|value| (*value).into())))
        }
    }
}

/// A plain Python number; `True` is none.
fn number(value: &Bound<'_, PyAny>) -> Option<f64> {
    let plain = value.is_instance_of::<PyFloat>()
        || value.is_instance_of::<PyInt>() && !value.is_instance_of::<PyBool>();
    if plain { value.extract().ok() } else { None }
}

/// An array of numbers; what is an array already, and lies in memory as numbers do, is not copied.
fn array<'py>(name: &'static str, value: &Bound<'py, PyAny>) -> PyResult<Source<'py>> {
    let py = value.py();
    let no_number = |what: &str| {
        let message = format!("{name} must be a number or an array of numbers, not {what}");
        refused(py, Refused::type_of(name, message))
    };
    if value.is_none() || value.is_instance_of::<PyString>() {
        return Err(no_number(&value.get_type().name()?.to_string()));
    }
    let numpy = py.import("numpy")?;
    if value.is_instance(&numpy.getattr("ma")?.getattr("MaskedArray")?)? {
        return Err(no_number("a masked array: fill the gaps first"));
    }
    let array = numpy.call_method1("asarray", (value,)).map_err(|error| {
        if error.is_instance_of::<PyMemoryError>(py) {
            return error;
        }
        no_number(&format!("{}", error.value(py)))
    })?;
    if let Some(source) = taken(&array) {
        return Ok(source);
    }
    let dtype = array.getattr("dtype")?;
    if !"iuf".contains(&dtype.getattr("kind")?.extract::<String>()?) {
        return Err(no_number(&format!("an array of dtype {dtype}")));
    }
    let array = array.call_method1("astype", ("float64",))?;
    taken(&array).ok_or_else(|| no_number("this array"))
}

/// An array of float32 or float64 without a copy.
fn taken<'py>(array: &Bound<'py, PyAny>) -> Option<Source<'py>> {
    fn aligned<T: Element>(array: &Bound<'_, PyArrayDyn<T>>) -> bool {
        let size = size_of::<T>();
        array.data().addr().is_multiple_of(align_of::<T>())
            && array
                .strides()
                .iter()
                .all(|stride| stride.unsigned_abs().is_multiple_of(size))
    }
    if let Ok(array) = array.cast::<PyArrayDyn<f32>>() {
        return aligned(array)
            .then(|| array.try_readonly().ok().map(Source::Single))
            .flatten();
    }
    let array = array.cast::<PyArrayDyn<f64>>().ok()?;
    aligned(array)
        .then(|| array.try_readonly().ok().map(Source::Double))
        .flatten()
}
