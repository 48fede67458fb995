//! Arrays in and out: numpy's broadcasting, work without the interpreter's lock.

use numpy::ndarray::IxDyn;
use numpy::{Element, PyArray, PyArray1, PyArrayMethods};
use pyo3::prelude::*;

use crate::argument::Argument;
use crate::blocks::{Ended, Inputs, Kernel, One, Real, compute};
use crate::errors::{Refused, refused};
use crate::memory;

/// Largest number of a trace: that of single precision.
const LARGEST: f64 = f32::MAX as f64;

/// Arguments with the shape that numpy broadcasts them to.
pub struct Arguments<'py, const I: usize> {
    arguments: [Argument<'py>; I],
    shape: Vec<usize>,
}

impl<'py, const I: usize> Arguments<'py, I> {
    /// Broadcasts arguments against each other.
    pub fn new(py: Python<'py>, arguments: [Argument<'py>; I]) -> PyResult<Self> {
        let mut shape: Vec<usize> = Vec::new();
        for argument in &arguments {
            if !widen(&mut shape, argument.shape()) {
                let shapes: Vec<String> = arguments
                    .iter()
                    .filter(|argument| !argument.shape().is_empty())
                    .map(|argument| format!("{} {:?}", argument.name, argument.shape()))
                    .collect();
                let message = format!("shapes do not broadcast: {}", shapes.join(", "));
                return Err(refused(py, Refused::shape(argument.name, message)));
            }
        }
        memory::length(&shape)?;
        let mut this = Self { arguments, shape };
        for argument in &mut this.arguments {
            argument.broadcast(py, &this.shape)?;
        }
        Ok(this)
    }

    /// One list of results for each that the kernel gives, without the interpreter's lock.
    pub fn map<T, F, const O: usize>(self, py: Python<'py>, kernel: F) -> PyResult<Results<T, O>>
    where
        T: Real,
        F: FnMut([T; I]) -> Result<[T; O], Refused> + Send,
    {
        self.map_blocks(py, One(kernel))
    }

    /// The same by a kernel that may take a whole block at once.
    pub fn map_blocks<T, K, const O: usize>(
        self,
        py: Python<'py>,
        kernel: K,
    ) -> PyResult<Results<T, O>>
    where
        T: Real,
        K: Kernel<T, I, O> + Send,
    {
        let inputs = self.inputs(true);
        match py.detach(move || compute(inputs, kernel)) {
            Ok(values) => Ok(Results {
                values,
                shape: self.shape,
            }),
            Err(ended) => Err(self.exception(py, ended)),
        }
    }

    /// Names and values for a kernel; where `strict`, it refuses numbers that its precision loses.
    fn inputs(&self, strict: bool) -> Inputs<'_, I> {
        Inputs {
            length: self.len(),
            names: self.arguments.each_ref().map(|argument| argument.name),
            columns: self.arguments.each_ref().map(Argument::column),
            strict,
        }
    }

    fn exception(&self, py: Python<'py>, ended: Ended) -> PyErr {
        match ended {
            Ended::Refused(place, error) => refused(py, error.at(&self.shape, place)),
            Ended::Raised(raised) => raised,
        }
    }

    /// The same, where it is one number or more along a trace. What is below single precision is at rest or without a load: 0.
    pub fn trace(mut self, py: Python<'py>, allow_faults: bool) -> PyResult<Self> {
        if self.shape.len() > 1 {
            let message = format!("a trace has one dimension; the shape is {:?}", self.shape);
            let name = self.arguments[0].name;
            return Err(refused(py, Refused::shape(name, message)));
        }
        if self.shape.is_empty() {
            self.shape.push(1);
        }
        // A trace whose results have no room is refused before its samples are read.
        drop(memory::room::<f64>(self.len())?);
        if !allow_faults {
            let names = self.arguments.each_ref().map(|argument| argument.name);
            self.each(py, |values: [f64; I]| {
                // False for NaN.
                match values.iter().position(|value| !(value.abs() <= LARGEST)) {
                    None => Ok(()),
                    Some(bad) if values[bad].is_finite() => {
                        Err(Refused::lost(names[bad], values[bad]))
                    }
                    Some(bad) => Err(Refused::no_number(names[bad], values[bad])),
                }
            })?;
        }
        Ok(self)
    }

    /// The shape that they broadcast to.
    pub fn shape(&self) -> &[usize] {
        &self.shape
    }

    /// Number of values.
    pub fn len(&self) -> usize {
        self.shape.iter().product()
    }

    /// Calls a function with the values in order, without the interpreter's lock.
    pub fn each<T, F>(&self, py: Python<'py>, mut function: F) -> PyResult<()>
    where
        T: Real,
        F: FnMut([T; I]) -> Result<(), Refused> + Send,
    {
        let inputs = self.inputs(false);
        let done = py.detach(move || compute(inputs, One(|values| function(values).map(|()| []))));
        match done {
            Ok([]) => Ok(()),
            Err(ended) => Err(self.exception(py, ended)),
        }
    }
}

/// Widens a shape by another one as numpy does; false where they do not fit.
fn widen(shape: &mut Vec<usize>, other: &[usize]) -> bool {
    while shape.len() < other.len() {
        shape.insert(0, 1);
    }
    let skip = shape.len() - other.len();
    shape[skip..].iter_mut().zip(other).all(|(size, other)| {
        if *size == 1 {
            *size = *other;
        }
        *size == *other || *other == 1
    })
}

/// Lists of results with their shape.
pub struct Results<T, const O: usize> {
    values: [Vec<T>; O],
    shape: Vec<usize>,
}

impl<T: Real, const O: usize> Results<T, O> {
    /// As arrays.
    pub fn arrays(self, py: Python<'_>) -> PyResult<[Bound<'_, PyAny>; O]> {
        let mut arrays = Vec::with_capacity(O);
        for values in self.values {
            arrays.push(shaped(py, values, &self.shape)?);
        }
        arrays
            .try_into()
            .map_err(|_| pyo3::exceptions::PyRuntimeError::new_err("results"))
    }
}

/// An array of a list, without a copy.
pub fn shaped<'py, T: Element>(
    py: Python<'py>,
    values: Vec<T>,
    shape: &[usize],
) -> PyResult<Bound<'py, PyAny>> {
    let array: Bound<'py, PyArray1<T>> = PyArray::from_vec(py, values);
    Ok(array.reshape(IxDyn(shape))?.into_any())
}
