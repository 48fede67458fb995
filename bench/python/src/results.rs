//! Results as the package's own classes: see `results.py`.

use pyo3::prelude::*;
use pyo3::types::PyTuple;

/// A class of `results.py` made from its fields in order.
pub fn result<'py, A>(py: Python<'py>, class: &str, fields: A) -> PyResult<Bound<'py, PyAny>>
where
    A: IntoPyObject<'py, Target = PyTuple, Output = Bound<'py, PyTuple>>,
    PyErr: From<A::Error>,
{
    let fields = fields.into_pyobject(py)?;
    py.import("epas_friction.results")?
        .getattr(class)?
        .call1(fields)
}
