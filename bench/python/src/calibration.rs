//! Measured traces to constants.

use std::collections::BTreeMap;
use std::io::Cursor;

use epas_calibrate::answer::{Calibration, Estimate, ModelScore};
use epas_calibrate::page::picture::Picture;
use epas_calibrate::screw::choice::Wanted;
use epas_calibrate::screw::{self, Request};
use epas_calibrate::trace::Trace;
use epas_calibrate::trace::columns::{self, Frame};
use epas_calibrate::without_design;
use epas_cli::bindings::{Controller, Failure};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};

use crate::argument::Argument;
use crate::arrays::{Arguments, shaped};
use crate::design::Design;
use crate::errors::{Refused, refused};
use crate::interrupt::interruptible;
use crate::memory::room;
use crate::results::result;

type Any<'py> = Bound<'py, PyAny>;

/// Ratios of a gear.
const RATIOS: (f64, f64) = (0.01, 1000.0);

/// Columns of a trace as the text of a CSV file, which the program reads and checks.
pub fn text(py: Python<'_>, trace: &Bound<'_, PyAny>) -> PyResult<String> {
    use std::fmt::Write;

    let trace = &dict("trace", trace)?;

    let mut names = Vec::new();
    let mut columns: Vec<Vec<f64>> = Vec::new();
    for (name, values) in trace {
        let name: String = name.extract()?;
        // A name that is a field of a CSV file by itself.
        if name.contains([',', '"', '\n', '\r']) {
            let message =
                format!("column {name:?}: a name has no commas, quotes and ends of lines");
            return Err(refused(py, Refused::value(&name, message)));
        }
        let argument = Argument::new("column", &values).map_err(|_| no_numbers(py, &name))?;
        let arguments = Arguments::new(py, [argument])?;
        let mut column = room(arguments.len())?;
        arguments.each(py, |[value]: [f64; 1]| {
            if !value.is_finite() {
                return Err(Refused::no_number(&name, value));
            }
            column.push(value);
            Ok(())
        })?;
        if let Some(first) = columns.first().filter(|first| first.len() != column.len()) {
            let message = format!(
                "column {name} has {} values where {} has {}",
                column.len(),
                names[0],
                first.len()
            );
            return Err(refused(py, Refused::shape(&name, message)));
        }
        names.push(name);
        columns.push(column);
    }
    let length = columns.first().map_or(0, Vec::len);
    Ok(py.detach(|| {
        let mut text = names.join(",");
        for row in 0..length {
            for (place, column) in columns.iter().enumerate() {
                let separator = if place == 0 { '\n' } else { ',' };
                // The fewest digits that read back as the same number.
                let _ = write!(text, "{separator}{}", column[row]);
            }
        }
        text.push('\n');
        text
    }))
}

/// A mapping, or a table of columns, as a dict.
fn dict<'py>(name: &str, mapping: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyDict>> {
    let py = mapping.py();
    let made = py.get_type::<PyDict>().call1((mapping,));
    if let Some(dict) = made.ok().and_then(|dict| dict.cast_into::<PyDict>().ok()) {
        return Ok(dict);
    }
    let message = format!("{name} must be a dict, not {}", mapping.get_type().name()?);
    Err(refused(py, Refused::type_of(name, message)))
}

fn no_numbers(py: Python<'_>, name: &str) -> PyErr {
    let message = format!("column {name} must be an array of numbers");
    refused(py, Refused::type_of(name, message))
}

/// A column that an error of the program names.
pub fn told(failure: Failure) -> Refused {
    let refused = Refused::from(failure);
    match refused.said().split_once("column ") {
        Some((_, rest)) if !refused.has_field() => {
            let name = rest
                .split([' ', ':'])
                .next()
                .unwrap_or_default()
                .to_string();
            refused.of_field(&name)
        }
        _ => refused,
    }
}

/// A number within its range.
fn within(py: Python<'_>, field: &str, value: Option<f64>, range: (f64, f64)) -> PyResult<()> {
    match value {
        Some(value) if !(range.0..=range.1).contains(&value) => {
            Err(refused(py, Refused::range(field, value, range.0, range.1)))
        }
        _ => Ok(()),
    }
}

/// Fits a model of friction to a measured trace, and says how sure it is and what the trace cannot tell.
///
/// Columns are named as in a file of the command ``calibrate``: ``time``; ``position`` or ``speed`` (of ``nut_``, ``motor_``,
/// ``carriage_`` or plain); ``motor_torque`` or ``motor_force``; and where there are any ``reference_position``,
/// ``axial_load``, ``temperature``. Units are SI; others stand in the name: ``nut_position_deg``, ``temperature_C``.
///
/// With a design the model is the exact ball of what firmware runs. Without one a mass or an inertia with load-free friction is
/// fitted, and models of friction are compared on what was not fitted.
///
/// Args:
///     trace: dict of column names to arrays of shape (n,), or a table whose columns are such.
///     design: of the screw, where it is known.
///     ratio: turns of the motor in a turn of the nut, 0.01 to 1000; with a design.
///     estimate: names of parameters to estimate; what the trace can tell without it; with a design.
///     fix: parameters to set, by name; with a design.
///     models: whether other models of friction are fitted beside it; with a design.
///     validate: another trace, which is not fitted, by which models are scored; without a design.
///     controller: gains (P, V) of force = V (P (reference_position - position) - speed); without a design.
///
/// Returns:
///     Calibration: parameters with 95 % intervals, models, what cannot be told, and the fit over time.
///
/// Raises:
///     Error: a trace or a request from which nothing can be told.
#[pyfunction]
#[pyo3(signature = (trace, design=None, *, ratio=None, estimate=None, fix=None, models=true, validate=None, controller=None))]
pub fn calibrate<'py>(
    py: Python<'py>,
    trace: Any<'py>,
    design: Option<&Design>,
    ratio: Option<f64>,
    estimate: Option<Vec<String>>,
    fix: Option<Any<'py>>,
    models: bool,
    validate: Option<Any<'py>>,
    controller: Option<(f64, f64)>,
) -> PyResult<Any<'py>> {
    geared(py, ratio)?;
    let of_a_design = [
        ("ratio", ratio.is_some()),
        ("estimate", estimate.is_some()),
        ("fix", fix.is_some()),
    ];
    let of_none = [
        ("validate", validate.is_some()),
        ("controller", controller.is_some()),
    ];
    options(py, design.is_some(), &of_a_design, &of_none)?;
    let text = text(py, &trace)?;
    let frame = design.map(|design| Frame::of(&design.inner, ratio));
    let found = if let Some(design) = design {
        let fix = match &fix {
            Some(fix) => dict("fix", fix)?.extract::<BTreeMap<String, f64>>()?,
            None => BTreeMap::new(),
        };
        let request = request(estimate, fix, models);
        let design = design.inner.clone();
        interruptible(py, move |_| {
            let trace = read(text, frame.as_ref())?;
            let told = screw::calibrate(&trace, &design, &request)?;
            Ok((told.answer, told.picture))
        })?
    } else {
        let unseen = validate.map(|trace| self::text(py, &trace)).transpose()?;
        let controller = controller
            .map(|gains| self::controller(py, gains))
            .transpose()?;
        interruptible(py, move |_| {
            let trace = read(text, None)?;
            let unseen = unseen.map(|text| read(text, None)).transpose()?;
            let told = without_design::calibrate(&trace, unseen.as_ref(), controller)?;
            Ok((told.answer, told.picture))
        })?
    };
    let (answer, picture) = found.map_err(|failure| refused(py, self::told(failure)))?;
    answered(py, &answer, picture)
}

/// A gear's ratio within its range.
pub fn geared(py: Python<'_>, ratio: Option<f64>) -> PyResult<()> {
    within(py, "ratio", ratio, RATIOS)
}

/// Refuses options that belong to the other kind of trace.
pub fn options(
    py: Python<'_>,
    design: bool,
    of_a_design: &[(&str, bool)],
    of_none: &[(&str, bool)],
) -> PyResult<()> {
    let needless = of_none.iter().filter(|(_, given)| *given && design);
    let missing = of_a_design.iter().filter(|(_, given)| *given && !design);
    let needless = needless.map(|(name, _)| (name, "is for traces without a design"));
    match missing
        .map(|(name, _)| (name, "needs a design"))
        .chain(needless)
        .next()
    {
        Some((name, why)) => Err(refused(py, Refused::value(name, format!("{name} {why}")))),
        None => Ok(()),
    }
}

/// What is asked of a trace whose design is known.
fn request(estimate: Option<Vec<String>>, fix: BTreeMap<String, f64>, models: bool) -> Request {
    Request {
        wanted: Wanted {
            estimate,
            fix: fix.into_iter().collect(),
            ..Wanted::default()
        },
        without_models: !models,
        ..Request::default()
    }
}

/// Gains of a controller.
fn controller(py: Python<'_>, (gain_position, gain_speed): (f64, f64)) -> PyResult<Controller> {
    for (field, gain) in [("gain_position", gain_position), ("gain_speed", gain_speed)] {
        if !gain.is_finite() {
            return Err(refused(py, Refused::no_number(field, gain)));
        }
        if gain <= 0.0 {
            return Err(refused(py, Refused::not_above_zero(field, gain)));
        }
    }
    Ok(Controller {
        gain_position,
        gain_speed,
    })
}

/// A trace of a file's text.
pub fn read(text: String, frame: Option<&Frame>) -> Result<Trace, Failure> {
    columns::from_reader(Cursor::new(text), "trace", frame)
}

fn answered<'py>(py: Python<'py>, answer: &Calibration, picture: Picture) -> PyResult<Any<'py>> {
    let models = answer.models.iter().map(|score| model(py, score));
    let of = |values: Vec<f64>| {
        let shape = [values.len()];
        shaped(py, values, &shape)
    };
    let fields = (
        estimates(py, &answer.parameters)?,
        answer.residual_rms,
        answer.relative_error,
        answer.effective_rows,
        &answer.cannot_tell,
        models.collect::<PyResult<Vec<_>>>()?,
        &answer.winner,
        of(picture.time)?,
        of(picture.measured)?,
        of(picture.model)?,
    );
    result(py, "Calibration", fields)
}

fn estimates<'py>(py: Python<'py>, estimates: &[Estimate]) -> PyResult<Bound<'py, PyDict>> {
    let dict = PyDict::new(py);
    for estimate in estimates {
        let fields = (
            &estimate.name,
            estimate.unit,
            estimate.value,
            estimate.low,
            estimate.high,
            estimate.fixed,
        );
        dict.set_item(&estimate.name, result(py, "Estimate", fields)?)?;
    }
    Ok(dict)
}

fn model<'py>(py: Python<'py>, score: &ModelScore) -> PyResult<Any<'py>> {
    let fields = [
        (&score.name).into_pyobject(py)?.into_any(),
        score.relative_error.into_pyobject(py)?.into_any(),
        score.relative_error_unseen.into_pyobject(py)?.into_any(),
        score.relative_error_inverse.into_pyobject(py)?.into_any(),
        score
            .relative_error_inverse_unseen
            .into_pyobject(py)?
            .into_any(),
        score.position_error.into_pyobject(py)?.into_any(),
        score.residual_unseen.into_pyobject(py)?.into_any(),
        score.information_criterion.into_pyobject(py)?.into_any(),
        score.parameters.into_pyobject(py)?.into_any(),
        score.cycles.into_pyobject(py)?.into_any(),
        pyo3::types::PyBool::new(py, score.cycles_estimated)
            .to_owned()
            .into_any(),
        estimates(py, &score.values)?.into_any(),
    ];
    result(py, "ModelScore", PyTuple::new(py, fields)?)
}
