//! Objects that pickle takes apart and makes again.
//!
//! An object is what it was made from, with its state as the crate exports it. What was solved goes along as words of its block: a
//! process that gets the object does not solve it again.

use epas_friction::Refusal;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyTuple};

use crate::errors::refused;

/// Where a design comes from.
#[derive(Clone, Debug)]
pub enum Recipe {
    /// A built-in one.
    BuiltIn(String),
    /// The text of a design file, and the name that it has without one of its own.
    Text {
        /// The text.
        text: String,
        /// The name.
        name: String,
    },
}

impl Recipe {
    /// Arguments of the function that makes the design again.
    pub fn arguments(&self) -> (String, Option<String>) {
        match self {
            Self::BuiltIn(name) => (name.clone(), None),
            Self::Text { text, name } => (name.clone(), Some(text.clone())),
        }
    }
}

/// What `__reduce__` returns: a function of `epas_friction._restored`, and its arguments.
pub type Reduced<'py> = (Bound<'py, PyAny>, Bound<'py, PyTuple>);

/// The same.
pub fn reduced<'py, A>(py: Python<'py>, function: &str, arguments: A) -> PyResult<Reduced<'py>>
where
    A: IntoPyObject<'py, Target = PyTuple, Output = Bound<'py, PyTuple>>,
    PyErr: From<A::Error>,
{
    let function = py.import("epas_friction._restored")?.getattr(function)?;
    Ok((function, arguments.into_pyobject(py)?))
}

/// An exported state as bytes.
pub fn state(py: Python<'_>, exported: Result<Vec<u8>, Refusal>) -> PyResult<Bound<'_, PyBytes>> {
    let state = exported.map_err(|error| refused(py, error.to_string()))?;
    Ok(PyBytes::new(py, &state))
}

/// The words of a block as bytes, least significant first.
pub fn bytes<'py>(py: Python<'py>, words: &[u32]) -> Bound<'py, PyBytes> {
    let bytes: Vec<u8> = words.iter().flat_map(|word| word.to_le_bytes()).collect();
    PyBytes::new(py, &bytes)
}
