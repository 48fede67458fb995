//! Kernels over columns of numbers, block by block.

use numpy::Element;

use crate::errors::Refused;

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

    /// Rounded, as `eval` does.
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

/// Runs a kernel over all values, block by block.
///
/// # Errors
/// What the kernel refuses, with its place.
pub fn compute<T: Real, const I: usize, const O: usize>(
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
