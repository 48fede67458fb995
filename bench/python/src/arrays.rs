//! Arrays in and out: numpy's broadcasting, no copy of arrays that fit, work without the interpreter's lock.

use numpy::ndarray::IxDyn;
use numpy::{
    Element, PyArray, PyArray1, PyArrayDyn, PyArrayMethods, PyReadonlyArrayDyn,
    PyUntypedArrayMethods,
};
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyFloat, PyInt, PyString};

use crate::errors::{Refused, refused};

/// Values that are computed at once: their conversions stay in the processor's nearest memory.
pub const BLOCK: usize = 256;

/// A number that kernels compute in: `f32` in the loop, `f64` in the reference.
pub trait Real: Element + Copy + Send + Sync + Default + 'static {
    /// From single precision.
    fn of_single(value: f32) -> Self;
    /// From double precision.
    fn of_double(value: f64) -> Self;
    /// Its bits.
    fn bits(self) -> u64;
}

impl Real for f32 {
    fn of_single(value: f32) -> Self {
        value
    }

    #[expect(clippy::cast_possible_truncation, reason = "rounded, as eval does")]
    fn of_double(value: f64) -> Self {
        value as Self
    }

    #[inline]
    fn bits(self) -> u64 {
        self.to_bits().into()
    }
}

impl Real for f64 {
    fn of_single(value: f32) -> Self {
        value.into()
    }

    fn of_double(value: f64) -> Self {
        value
    }

    #[inline]
    fn bits(self) -> u64 {
        self.to_bits()
    }
}

/// An argument that holds numbers.
pub struct Argument<'py> {
    name: &'static str,
    source: Source<'py>,
}

enum Source<'py> {
    Number(f64),
    Single(PyReadonlyArrayDyn<'py, f32>),
    Double(PyReadonlyArrayDyn<'py, f64>),
}

impl<'py> Argument<'py> {
    /// A number, or an array of numbers. Arrays of float32 and float64 are taken as they are, others become float64.
    ///
    /// # Errors
    /// What is no number.
    pub fn new(name: &'static str, value: &Bound<'py, PyAny>) -> PyResult<Self> {
        let source = match number(value) {
            Some(number) => Source::Number(number),
            None => array(name, value)?,
        };
        Ok(Self { name, source })
    }

    /// Its shape; empty for a number.
    fn shape(&self) -> &[usize] {
        match &self.source {
            Source::Number(_) => &[],
            Source::Single(array) => array.shape(),
            Source::Double(array) => array.shape(),
        }
    }

    /// Repeats an array along a shape, without a copy; one of a single value stays as it is.
    fn broadcast(&mut self, py: Python<'py>, shape: &[usize]) -> PyResult<()> {
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
    fn column<T: Real>(&self) -> Column<'_, T> {
        match &self.source {
            Source::Number(number) => Column::Constant([T::of_double(*number); BLOCK]),
            Source::Single(array) => column(array, T::of_single, Column::Single),
            Source::Double(array) => column(array, T::of_double, Column::Double),
        }
    }
}

/// Values of an array: as they lie in memory where that is their order, else by strides.
fn column<'a, S: Element + Copy + Sync, T: Real>(
    array: &'a PyReadonlyArrayDyn<'_, S>,
    convert: fn(S) -> T,
    plain: fn(&'a [S]) -> Column<'a, T>,
) -> Column<'a, T> {
    // A slice is there for arrays in the order of Fortran too, whose values lie in another order.
    match array.as_slice() {
        Ok([value]) => Column::Constant([convert(*value); BLOCK]),
        Ok(values) if array.is_c_contiguous() => plain(values),
        _ => {
            let values = array.as_array().into_iter();
            Column::Strided(Box::new(values.map(move |value| convert(*value))))
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
    let array = numpy
        .call_method1("asarray", (value,))
        .map_err(|error| no_number(&format!("{}", error.value(py))))?;
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

/// Values of one argument, as many as the result has, in the order of the result.
pub enum Column<'a, T> {
    /// One number.
    Constant([T; BLOCK]),
    /// As they lie in memory.
    Single(&'a [f32]),
    /// As they lie in memory.
    Double(&'a [f64]),
    /// By the array's strides.
    Strided(Box<dyn Iterator<Item = T> + Send + 'a>),
}

impl<T: Real> Column<'_, T> {
    /// Puts the values of a block into its buffer.
    fn fill(&mut self, start: usize, buffer: &mut [T]) {
        match self {
            // Put there once.
            Self::Constant(_) => {}
            Self::Single(values) => {
                for (to, from) in buffer.iter_mut().zip(&values[start..]) {
                    *to = T::of_single(*from);
                }
            }
            Self::Double(values) => {
                for (to, from) in buffer.iter_mut().zip(&values[start..]) {
                    *to = T::of_double(*from);
                }
            }
            Self::Strided(values) => {
                for (to, from) in buffer.iter_mut().zip(values) {
                    *to = from;
                }
            }
        }
    }
}

/// Arguments with the shape that numpy broadcasts them to.
pub struct Arguments<'py, const I: usize> {
    arguments: [Argument<'py>; I],
    shape: Vec<usize>,
}

impl<'py, const I: usize> Arguments<'py, I> {
    /// Broadcasts arguments against each other.
    ///
    /// # Errors
    /// Shapes that do not fit, named.
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
        let mut this = Self { arguments, shape };
        for argument in &mut this.arguments {
            argument.broadcast(py, &this.shape)?;
        }
        Ok(this)
    }

    /// One list of results for each that the kernel gives, without the interpreter's lock.
    ///
    /// # Errors
    /// What the kernel refuses, with its place.
    pub fn map<T, F, const O: usize>(self, py: Python<'py>, kernel: F) -> PyResult<Results<T, O>>
    where
        T: Real,
        F: FnMut([T; I]) -> Result<[T; O], Refused> + Send,
    {
        self.map_blocks(py, One(kernel))
    }

    /// The same by a kernel that may take a whole block at once.
    ///
    /// # Errors
    /// What the kernel refuses, with its place.
    pub fn map_blocks<T, K, const O: usize>(
        self,
        py: Python<'py>,
        kernel: K,
    ) -> PyResult<Results<T, O>>
    where
        T: Real,
        K: Kernel<T, I, O> + Send,
    {
        let length = self.shape.iter().product();
        let columns = self.arguments.each_ref().map(Argument::column);
        let values = py.detach(move || compute(length, columns, kernel));
        match values {
            Ok(values) => Ok(Results {
                values,
                shape: self.shape,
            }),
            Err((place, error)) => Err(refused(py, error.at(&self.shape, place))),
        }
    }
}

/// Inputs that lie one after the other, and the places of their results; all lists are equally long.
pub struct Block<'a, T, const I: usize, const O: usize> {
    /// Values of each argument.
    pub inputs: [&'a [T]; I],
    /// Whether an argument is one number all along.
    pub constant: [bool; I],
    /// Where the results go.
    pub outputs: [&'a mut [T]; O],
}

/// What is computed for each set of inputs.
pub trait Kernel<T, const I: usize, const O: usize> {
    /// One set of inputs.
    ///
    /// # Errors
    /// What is out of its range.
    fn one(&mut self, inputs: [T; I]) -> Result<[T; O], Refused>;

    /// All of a block at once, with the same results; false where it has to go one by one, as where something is refused.
    fn block(&mut self, block: &mut Block<'_, T, I, O>) -> bool {
        let _ = block;
        false
    }
}

/// A kernel for one set of inputs after the other.
struct One<F>(F);

impl<T, F, const I: usize, const O: usize> Kernel<T, I, O> for One<F>
where
    F: FnMut([T; I]) -> Result<[T; O], Refused>,
{
    #[inline]
    fn one(&mut self, inputs: [T; I]) -> Result<[T; O], Refused> {
        self.0(inputs)
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

/// Runs a kernel over all values, block by block.
fn compute<T: Real, const I: usize, const O: usize>(
    length: usize,
    mut columns: [Column<'_, T>; I],
    mut kernel: impl Kernel<T, I, O>,
) -> Result<[Vec<T>; O], (usize, Refused)> {
    let mut results: [Vec<T>; O] = std::array::from_fn(|_| vec![T::default(); length]);
    let mut buffers = [[T::default(); BLOCK]; I];
    let constant = columns
        .each_ref()
        .map(|column| matches!(column, Column::Constant(_)));
    for (column, buffer) in columns.iter_mut().zip(&mut buffers) {
        if let Column::Constant(values) = column {
            *buffer = *values;
        }
    }
    for start in (0..length).step_by(BLOCK) {
        let size = BLOCK.min(length - start);
        for (column, buffer) in columns.iter_mut().zip(&mut buffers) {
            column.fill(start, &mut buffer[..size]);
        }
        let mut block = Block {
            inputs: buffers.each_ref().map(|buffer| &buffer[..size]),
            constant,
            outputs: results
                .each_mut()
                .map(|result| &mut result[start..start + size]),
        };
        if kernel.block(&mut block) {
            continue;
        }
        for place in 0..size {
            let inputs = block.inputs.map(|values| values[place]);
            let outputs = kernel.one(inputs).map_err(|error| (start + place, error))?;
            for (result, output) in block.outputs.iter_mut().zip(outputs) {
                result[place] = output;
            }
        }
    }
    Ok(results)
}

/// Lists of results with their shape.
pub struct Results<T, const O: usize> {
    values: [Vec<T>; O],
    shape: Vec<usize>,
}

impl<T: Real, const O: usize> Results<T, O> {
    /// As arrays.
    ///
    /// # Errors
    /// None that is known.
    pub fn arrays<'py>(self, py: Python<'py>) -> PyResult<[Bound<'py, PyAny>; O]> {
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
///
/// # Errors
/// None that is known.
pub fn shaped<'py, T: Element>(
    py: Python<'py>,
    values: Vec<T>,
    shape: &[usize],
) -> PyResult<Bound<'py, PyAny>> {
    let array: Bound<'py, PyArray1<T>> = PyArray::from_vec(py, values);
    Ok(array.reshape(IxDyn(shape))?.into_any())
}

impl<'py, const I: usize> Arguments<'py, I> {
    /// The same, where it is one number or more along a trace.
    ///
    /// # Errors
    /// Arrays of more than one dimension; numbers that are not finite, where they are not allowed.
    pub fn trace(mut self, py: Python<'py>, allow_faults: bool) -> PyResult<Self> {
        if self.shape.len() > 1 {
            let message = format!("a trace has one dimension; the shape is {:?}", self.shape);
            let name = self.arguments[0].name;
            return Err(refused(py, Refused::shape(name, message)));
        }
        if self.shape.is_empty() {
            self.shape.push(1);
        }
        if !allow_faults {
            let names = self.arguments.each_ref().map(|argument| argument.name);
            self.each(py, |values: [f64; I]| {
                match values.iter().position(|value| !value.is_finite()) {
                    None => Ok(()),
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
    ///
    /// # Errors
    /// What the function refuses, with its place.
    pub fn each<T, F>(&self, py: Python<'py>, mut function: F) -> PyResult<()>
    where
        T: Real,
        F: FnMut([T; I]) -> Result<(), Refused> + Send,
    {
        let length = self.len();
        let columns = self.arguments.each_ref().map(Argument::column);
        let done = py
            .detach(move || compute(length, columns, One(|values| function(values).map(|()| []))));
        match done {
            Ok([]) => Ok(()),
            Err((place, error)) => Err(refused(py, error.at(&self.shape, place))),
        }
    }
}
