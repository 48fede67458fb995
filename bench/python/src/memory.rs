//! Room for results, or Python's `MemoryError`.

use pyo3::exceptions::PyMemoryError;
use pyo3::prelude::*;

/// An empty list with room for so many values.
pub fn room<T>(length: usize) -> PyResult<Vec<T>> {
    let mut list = Vec::new();
    match list.try_reserve_exact(length) {
        Ok(()) => Ok(list),
        Err(_) => Err(no_room::<T>(length)),
    }
}

/// The exception for results that do not fit into memory.
fn no_room<T>(length: usize) -> PyErr {
    let bytes = length as f64 * size_of::<T>() as f64;
    PyMemoryError::new_err(format!(
        "unable to allocate {:.3} GiB for {length} values",
        bytes / f64::from(1 << 30)
    ))
}

/// Number of values of a shape.
pub fn length(shape: &[usize]) -> PyResult<usize> {
    const LARGEST: usize = isize::MAX as usize / size_of::<f64>();
    if shape.contains(&0) {
        return Ok(0);
    }
    shape
        .iter()
        .try_fold(1_usize, |length, size| length.checked_mul(*size))
        .filter(|length| *length <= LARGEST)
        .ok_or_else(|| {
            PyMemoryError::new_err(format!("unable to allocate an array of shape {shape:?}"))
        })
}
