//! Designs: built in, from a file, from numbers.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use epas_cli::bindings::{self, DesignSource, LinearDesign as Linear};
use epas_friction::geometry::Groove;
use epas_friction::hertz::HertzContact;
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict, PyFloat, PyInt, PyString};
use toml::{Table, Value};

use crate::argument::Argument;
use crate::arrays::Arguments;
use crate::blocks::Real as _;
use crate::contacts::ellipse_at;
use crate::errors::{Refused, refused};
use crate::numbers::{groove, within};
use crate::restored::{Recipe, Reduced, reduced};
use crate::results::result;

/// Names of the built-in ball screws: nominal diameter x lead x ball diameter in mm, and those of the dissertation.
///
/// Returns:
///     list[str]: names that :meth:`Design.built_in` takes.
#[pyfunction]
pub fn design_names() -> Vec<&'static str> {
    bindings::built_in().map(|(name, ..)| name).collect()
}

/// A ball screw with what the model has to know beside its geometry: catalogue numbers, checked.
///
/// Keys are those of a design file, in SI units and radians: ``pitch_radius`` or ``nominal_diameter``, ``lead``,
/// ``ball_radius`` or ``ball_diameter``, ``conformity`` or ``groove_radius`` (for both grooves, or each in a dict
/// ``screw_groove``, ``nut_groove``), ``contact_angle``; and if wanted ``name``, ``youngs_modulus``, ``poisson_ratio``,
/// ``density`` (or dicts ``ball_material``, ``groove_material``; steel without), ``friction`` (0.1 without), ``hysteresis_loss``,
/// ``lubricant_drag``, ``branch`` ("contacts", or a closed form: "rolling", "sliding"), ``rolling_tangent``, ``clearance``
/// (radial gap of every contact, m; play above 0, oversize below; -1e-6 without, as of a steering gear without play) or ``preload``
/// (force of each contact without a load, N),
/// ``reversal_speed``, ``loaded_balls``, a dict ``limits`` with ``nut_speed``, ``axial_load``, ``friction_torque``; a dict
/// ``uncaged`` with ``balls``, ``turns`` and if wanted ``ball_friction``, ``return_length``, ``screw_deviation``,
/// ``nut_deviation`` (lists of ``{"order", "cosine", "sine"}``), ``load_shares``; a dict ``calibration``.
///
/// Raises:
///     Error: a key that is missing, unknown, or out of its range.
#[pyclass(frozen, module = "epas_friction")]
pub struct Design {
    /// What the program makes of it.
    pub inner: Arc<bindings::Design>,
    /// Where it comes from.
    pub recipe: Recipe,
}

#[pymethods]
impl Design {
    #[new]
    #[pyo3(signature = (**keys))]
    fn new(py: Python<'_>, keys: Option<&Bound<'_, PyDict>>) -> PyResult<Self> {
        let text = text_of(py, keys)?;
        Self::of_text(text, "design".into()).map_err(|error| said(py, error))
    }

    /// A built-in design by its name: see :func:`design_names`.
    ///
    /// Raises:
    ///     Error: a name that there is not.
    #[staticmethod]
    fn built_in(py: Python<'_>, name: &str) -> PyResult<Self> {
        let (name, parameters, loaded_balls) = bindings::built_in()
            .find(|(known, ..)| *known == name)
            .ok_or_else(|| {
                let message = format!("name = {name:?} is no built-in design: see design_names()");
                refused(py, Refused::value("name", message))
            })?;
        let source = DesignSource::BuiltIn {
            name,
            parameters,
            loaded_balls,
        };
        let design = source.load().map_err(|failure| refused(py, failure))?;
        Ok(Self {
            inner: Arc::new(design),
            recipe: Recipe::BuiltIn(name.into()),
        })
    }

    /// A design from a TOML file.
    ///
    /// Args:
    ///     path: str or os.PathLike.
    ///
    /// Raises:
    ///     Error: a file that cannot be read, or a key that is missing, unknown, or out of its range.
    #[staticmethod]
    fn read(py: Python<'_>, path: PathBuf) -> PyResult<Self> {
        let (text, name) = (contents(py, &path)?, stem(&path));
        let design = DesignSource::File(path).load_from(Some(&text));
        Ok(Self {
            inner: Arc::new(design.map_err(|failure| refused(py, failure))?),
            recipe: Recipe::Text { text, name },
        })
    }

    /// Name, for headings.
    #[getter]
    fn name(&self) -> &str {
        &self.inner.name
    }

    /// Radius of the cylinder on which the ball centres run, m.
    #[getter]
    fn pitch_radius(&self) -> f32 {
        self.inner.screw().pitch_radius()
    }

    /// Axial travel of the nut in one turn, m.
    #[getter]
    fn lead(&self) -> f32 {
        self.inner.screw().lead()
    }

    /// Lead angle at the pitch radius, rad.
    #[getter]
    fn lead_angle(&self) -> f32 {
        self.inner.screw().tan_lead_angle().atan()
    }

    /// Ball radius, m.
    #[getter]
    fn ball_radius(&self) -> f32 {
        self.inner.screw().ball_radius()
    }

    /// Nominal contact angle, rad.
    #[getter]
    fn contact_angle(&self) -> f32 {
        self.inner.screw().parameters().contact_angle
    }

    /// Coulomb friction coefficient of ball and groove.
    #[getter]
    fn friction(&self) -> f32 {
        self.inner.caged.friction
    }

    /// Radial gap of every contact at the centred ball, m; play above 0, oversize below.
    #[getter]
    fn clearance(&self) -> f32 {
        self.inner.caged.clearance.gap()
    }

    /// Number of balls that share the load; a usual one where the design does not say it.
    #[getter]
    fn loaded_balls(&self) -> u16 {
        self.inner.caged.loaded_balls
    }

    /// Number of balls in the circuit, where the design says it.
    #[getter]
    fn circuit_balls(&self) -> Option<u8> {
        self.inner.uncaged.as_ref().map(|uncaged| uncaged.balls)
    }

    /// The caged ball screw as the text of a design file.
    fn toml(&self) -> String {
        bindings::text::text(&self.inner)
    }

    /// Contact ellipse of a ball in one of its grooves under a load.
    ///
    /// Args:
    ///     groove: "screw" or "nut".
    ///     load: normal to the contact, N, 1e-12 to 1e9.
    ///
    /// Returns:
    ///     Ellipse: float32 arrays of the load's shape.
    ///
    /// Raises:
    ///     Error: a load out of its range, with its place in the array.
    fn ellipse<'py>(
        &self,
        py: Python<'py>,
        groove: &str,
        load: Bound<'py, PyAny>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let groove: Groove = self::groove(py, groove)?;
        let contact = HertzContact::of(self.inner.screw(), groove);
        let arguments = Arguments::new(py, [Argument::new("load", &load)?])?;
        let results = arguments.map(py, move |[load]: [f32; 1]| {
            within("load", load.into(), 1e-12, 1e9)?;
            Ok::<_, Refused>(ellipse_at(&contact, load))
        })?;
        let [ratio, major, minor, deflection, pressure] = results.arrays(py)?;
        result(py, "Ellipse", (ratio, major, minor, deflection, pressure))
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        reduced(py, "design", self.recipe.arguments())
    }

    /// A design does not change: its copy is the design.
    const fn __copy__(slf: Py<Self>) -> Py<Self> {
        slf
    }

    /// As [`Self::__copy__`].
    fn __deepcopy__(slf: Py<Self>, _memo: &Bound<'_, PyAny>) -> Py<Self> {
        slf
    }

    fn __repr__(&self) -> String {
        format!(
            "Design(name={:?}, pitch_radius={}, lead={}, ball_radius={})",
            self.inner.name,
            self.pitch_radius(),
            self.lead(),
            self.ball_radius()
        )
    }
}

impl Design {
    fn of_text(text: String, name: String) -> Result<Self, String> {
        Ok(Self {
            inner: Arc::new(bindings::read_design(&text, &name)?),
            recipe: Recipe::Text { text, name },
        })
    }
}

/// A design as pickle has it: see [`Recipe::arguments`].
#[pyfunction]
#[pyo3(name = "_restored_design")]
pub fn restored_design(py: Python<'_>, name: String, text: Option<String>) -> PyResult<Design> {
    match text {
        None => Design::built_in(py, &name),
        Some(text) => Design::of_text(text, name).map_err(|error| said(py, error)),
    }
}

/// The text of a design file; that of standard input can be read once.
fn contents(py: Python<'_>, path: &Path) -> PyResult<String> {
    let source = DesignSource::File(path.into());
    let text = py.detach(|| source.text());
    Ok(text
        .map_err(|failure| refused(py, failure))?
        .unwrap_or_default())
}

/// The name that a design has by its file.
fn stem(path: &Path) -> String {
    path.file_stem()
        .unwrap_or_default()
        .to_string_lossy()
        .into_owned()
}

/// A linear bearing with its circuit of balls.
///
/// Keys are those of a design file, in SI units and radians: ``ball_radius`` or ``ball_diameter``, ``conformity`` or
/// ``groove_radius``, ``contact_angle``, ``balls`` (1 to 64), ``loaded_length``, and if wanted ``name``, ``return_length``,
/// ``wavelength``, ``rail_deviation``, ``carriage_deviation`` (lists of ``{"order", "cosine", "sine"}``), ``load_shares``,
/// ``friction``, ``ball_friction``, materials as of :class:`Design`, ``reversal_speed``, a dict ``limits`` with ``speed``,
/// ``load``, ``friction_force``.
///
/// Raises:
///     Error: a key that is missing, unknown, or out of its range.
#[pyclass(frozen, module = "epas_friction")]
pub struct LinearDesign {
    /// What the program makes of it.
    pub inner: Arc<Linear>,
    /// Where it comes from.
    pub recipe: Recipe,
}

#[pymethods]
impl LinearDesign {
    #[new]
    #[pyo3(signature = (**keys))]
    fn new(py: Python<'_>, keys: Option<&Bound<'_, PyDict>>) -> PyResult<Self> {
        let text = text_of(py, keys)?;
        Self::of_text(text, "design".into()).map_err(|error| said(py, error))
    }

    /// The bearing of Lin 2019, Table 3.3.
    #[staticmethod]
    fn built_in(py: Python<'_>) -> PyResult<Self> {
        let design = Linear::built_in().map_err(|failure| refused(py, failure))?;
        let recipe = Recipe::BuiltIn(design.name.clone());
        Ok(Self {
            inner: Arc::new(design),
            recipe,
        })
    }

    /// A design from a TOML file.
    ///
    /// Args:
    ///     path: str or os.PathLike.
    ///
    /// Raises:
    ///     Error: a file that cannot be read, or a key that is missing, unknown, or out of its range.
    #[staticmethod]
    fn read(py: Python<'_>, path: PathBuf) -> PyResult<Self> {
        let (text, name) = (contents(py, &path)?, stem(&path));
        let design = DesignSource::File(path).load_bearing_from(Some(&text));
        Ok(Self {
            inner: Arc::new(design.map_err(|failure| refused(py, failure))?),
            recipe: Recipe::Text { text, name },
        })
    }

    /// Name, for headings.
    #[getter]
    fn name(&self) -> &str {
        &self.inner.name
    }

    /// Number of balls in the circuit.
    #[getter]
    fn balls(&self) -> u8 {
        self.inner.balls
    }

    /// Ball radius, m.
    #[getter]
    fn ball_radius(&self) -> f32 {
        self.inner.configuration.bearing.ball_radius()
    }

    /// Coulomb friction coefficient of ball and groove.
    #[getter]
    fn friction(&self) -> f32 {
        self.inner.configuration.friction
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        reduced(py, "linear_design", self.recipe.arguments())
    }

    /// A design does not change: its copy is the design.
    const fn __copy__(slf: Py<Self>) -> Py<Self> {
        slf
    }

    /// As [`Self::__copy__`].
    fn __deepcopy__(slf: Py<Self>, _memo: &Bound<'_, PyAny>) -> Py<Self> {
        slf
    }

    fn __repr__(&self) -> String {
        format!(
            "LinearDesign(name={:?}, balls={})",
            self.inner.name, self.inner.balls
        )
    }
}

impl LinearDesign {
    fn of_text(text: String, name: String) -> Result<Self, String> {
        Ok(Self {
            inner: Arc::new(Linear::parse(&text, &name)?),
            recipe: Recipe::Text { text, name },
        })
    }
}

/// A linear bearing as pickle has it: see [`Recipe::arguments`].
#[pyfunction]
#[pyo3(name = "_restored_linear_design")]
pub fn restored_linear_design(
    py: Python<'_>,
    name: String,
    text: Option<String>,
) -> PyResult<LinearDesign> {
    match text {
        None => LinearDesign::built_in(py),
        Some(text) => LinearDesign::of_text(text, name).map_err(|error| said(py, error)),
    }
}

/// What is wrong with keys, without the place in a text that the user has not seen.
fn said(py: Python<'_>, message: String) -> PyErr {
    let line = message.trim_end().lines().last().unwrap_or(&message);
    let field = ["missing field `", "unknown field `"]
        .iter()
        .find_map(|start| line.split_once(start)?.1.split('`').next());
    match field {
        Some(field) => refused(py, Refused::value(field, line)),
        None => refused(py, Refused::message(line)),
    }
}

/// Keys as the text of a design file.
fn text_of(py: Python<'_>, keys: Option<&Bound<'_, PyDict>>) -> PyResult<String> {
    let table = match keys {
        Some(keys) => table(keys)?,
        None => Table::new(),
    };
    toml::to_string(&table).map_err(|error| refused(py, error.to_string()))
}

/// A dict as a table; a value of `None` counts as not there.
fn table(keys: &Bound<'_, PyDict>) -> PyResult<Table> {
    let mut table = Table::new();
    for (key, value) in keys {
        let key: String = key.extract()?;
        if !value.is_none() {
            let value = value_of(&key, &value)?;
            table.insert(key, value);
        }
    }
    Ok(table)
}

/// A number, a text, a list or a dict.
fn value_of(key: &str, value: &Bound<'_, PyAny>) -> PyResult<Value> {
    if value.is_instance_of::<PyBool>() {
        return Ok(Value::Boolean(value.extract()?));
    }
    if value.is_instance_of::<PyInt>()
        && let Ok(integer) = value.extract()
    {
        return Ok(Value::Integer(integer));
    }
    if value.is_instance_of::<PyInt>() || value.is_instance_of::<PyFloat>() {
        let number = value.extract().unwrap_or(f64::MAX);
        if f32::loses(number) {
            return Err(refused(value.py(), Refused::lost(key, number)));
        }
        return Ok(Value::Float(number));
    }
    if value.is_instance_of::<PyString>() {
        return Ok(Value::String(value.extract()?));
    }
    if let Ok(dict) = value.cast::<PyDict>() {
        return Ok(Value::Table(table(dict)?));
    }
    // Numbers of numpy: an array of none, or a list.
    if let Ok(item) = value.call_method0("tolist") {
        return value_of(key, &item);
    }
    if let Ok(items) = value.try_iter() {
        let items = items.map(|item| value_of(key, &item?));
        return Ok(Value::Array(items.collect::<PyResult<_>>()?));
    }
    let kind = value.get_type().name()?;
    let message = format!("{key} must be a number, a text, a list or a dict, not {kind}");
    Err(match key {
        "" => PyTypeError::new_err(message),
        _ => refused(value.py(), Refused::type_of(key, message)),
    })
}
