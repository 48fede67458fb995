//! Kernels over columns of numbers, block by block.

use numpy::Element;
use pyo3::prelude::*;

use crate::errors::Refused;
use crate::interrupt::Signals;
use crate::memory::room;

/// Values that are computed at once: their conversions stay in the processor's nearest memory.
pub const BLOCK: usize = 256;

/// A number that kernels compute in: `f32` in the loop, `f64` in the reference.
pub trait Real: Element + Copy + Send + Sync + Default + 'static {
    /// From single precision.
    fn of_single(value: f32) -> Self;
    /// From double precision.
    fn of_double(value: f64) -> Self;
    /// Whether a number in double precision becomes infinite, or 0 without being 0.
    fn loses(value: f64) -> bool;
    /// Its bits.
    fn bits(self) -> u64;
}

impl Real for f32 {
    fn of_single(value: f32) -> Self {
        value
    }

    /// Rounded, as `eval` does.
    fn of_double(value: f64) -> Self {
        value as Self
    }

    #[inline]
    fn loses(value: f64) -> bool {
        let rounded = value as Self;
        (rounded.is_infinite() && value.is_finite()) || (rounded == 0.0 && value != 0.0)
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
    fn loses(_: f64) -> bool {
        false
    }

    #[inline]
    fn bits(self) -> u64 {
        self.to_bits()
    }
}

/// Values of one argument, as many as the result has, in the order of the result.
pub enum Column<'a> {
    /// One number.
    Constant(f64),
    /// As they lie in memory.
    Single(&'a [f32]),
    /// As they lie in memory.
    Double(&'a [f64]),
    /// By the array's strides.
    Strided(Box<dyn Iterator<Item = f64> + Send + 'a>),
}

impl Column<'_> {
    /// Puts the values of a block into its buffer; where `strict`, the first number that the precision of `T` loses, with its place.
    fn fill<T: Real>(
        &mut self,
        start: usize,
        buffer: &mut [T],
        strict: bool,
    ) -> Result<(), (usize, f64)> {
        let lost = |value: &f64| strict && T::loses(*value);
        match self {
            Self::Constant(value) if start == 0 => {
                if lost(value) {
                    return Err((0, *value));
                }
                buffer.fill(T::of_double(*value));
            }
            // Put there once.
            Self::Constant(_) => {}
            Self::Single(values) => {
                for (to, from) in buffer.iter_mut().zip(&values[start..]) {
                    *to = T::of_single(*from);
                }
            }
            Self::Double(values) => {
                let values = &values[start..start + buffer.len()];
                for (to, from) in buffer.iter_mut().zip(values) {
                    *to = T::of_double(*from);
                }
                // Without a branch for each value.
                if values.iter().fold(false, |any, value| any | lost(value)) {
                    let place = values.iter().position(lost).unwrap_or(0);
                    return Err((place, values[place]));
                }
            }
            Self::Strided(values) => {
                for (place, (to, from)) in buffer.iter_mut().zip(values).enumerate() {
                    if lost(&from) {
                        return Err((place, from));
                    }
                    *to = T::of_double(from);
                }
            }
        }
        Ok(())
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
    fn one(&mut self, inputs: [T; I]) -> Result<[T; O], Refused>;

    /// All of a block at once, with the same results; false where it has to go one by one, as where something is refused.
    fn block(&mut self, block: &mut Block<'_, T, I, O>) -> bool {
        let _ = block;
        false
    }
}

/// A kernel for one set of inputs after the other.
pub struct One<F>(pub F);

impl<T, F, const I: usize, const O: usize> Kernel<T, I, O> for One<F>
where
    F: FnMut([T; I]) -> Result<[T; O], Refused>,
{
    #[inline]
    fn one(&mut self, inputs: [T; I]) -> Result<[T; O], Refused> {
        self.0(inputs)
    }
}

/// Why a kernel did not run over all values.
pub enum Ended {
    /// It refused the values at this place.
    Refused(usize, Refused),
    /// An exception: no memory, or an interrupt.
    Raised(PyErr),
}

impl From<PyErr> for Ended {
    fn from(raised: PyErr) -> Self {
        Self::Raised(raised)
    }
}

/// What a kernel runs over.
pub struct Inputs<'a, const I: usize> {
    /// Number of values.
    pub length: usize,
    /// Arguments' names.
    pub names: [&'static str; I],
    /// Arguments' values.
    pub columns: [Column<'a>; I],
    /// Whether numbers that the kernel's precision loses are refused.
    pub strict: bool,
}

/// Values between two looks at the clock where a kernel takes them one by one: some of them take ten milliseconds each.
const GLANCE: usize = 16;

/// Runs a kernel over all values, block by block.
pub fn compute<T: Real, const I: usize, const O: usize>(
    inputs: Inputs<'_, I>,
    mut kernel: impl Kernel<T, I, O>,
) -> Result<[Vec<T>; O], Ended> {
    let Inputs {
        length,
        names,
        mut columns,
        strict,
    } = inputs;
    let mut results: [Vec<T>; O] = std::array::from_fn(|_| Vec::new());
    for result in &mut results {
        *result = room(length)?;
    }
    let mut signals = Signals::new();
    let mut buffers = [[T::default(); BLOCK]; I];
    let constant = columns
        .each_ref()
        .map(|column| matches!(column, Column::Constant(_)));
    for start in (0..length).step_by(BLOCK) {
        signals.check()?;
        let size = BLOCK.min(length - start);
        for ((column, buffer), name) in columns.iter_mut().zip(&mut buffers).zip(names) {
            let filled = column.fill(start, &mut buffer[..size], strict);
            filled.map_err(|(place, value)| {
                Ended::Refused(start + place, Refused::lost(name, value))
            })?;
        }
        for result in &mut results {
            result.resize(start + size, T::default());
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
            if place % GLANCE == GLANCE - 1 {
                signals.check()?;
            }
            let inputs = block.inputs.map(|values| values[place]);
            let outputs = kernel
                .one(inputs)
                .map_err(|error| Ended::Refused(start + place, error))?;
            for (result, output) in block.outputs.iter_mut().zip(outputs) {
                result[place] = output;
            }
        }
    }
    Ok(results)
}
