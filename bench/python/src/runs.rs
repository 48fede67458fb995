//! Whole traces as the command `simulate` runs them, and the float64 reference over them; single evaluations of `eval`.

use epas_cli::bindings::{
    self, Caged, EncoderStep, Linear, LinearSample, Manoeuvre, ReferenceModel, Row, Scene,
    ScrewSample, TickOutputs, Trace, Uncaged,
};
use epas_rig::Rig;
use epas_rig::course::Course;
use epas_rig::parameters::Parameters;
use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::arrays::shaped;
use crate::design::{Design, LinearDesign};
use crate::errors::{Refused, refused};
use crate::interrupt::{Stop, interruptible};
use crate::memory::room;
use crate::numbers::arguments;
use crate::results::result;
use crate::scenes::columns::{Columns, LinearColumns, ScrewColumns, UncagedColumns};

type Any<'py> = Bound<'py, PyAny>;

/// The name of traces that have none.
const NAME: &str = "trace";

/// A trace of equal length arrays, whose times rise.
fn trace<'py, S, const I: usize>(
    py: Python<'py>,
    names: [&'static str; I],
    values: [&Any<'py>; I],
    sample: impl Fn([f64; I]) -> S + Send + Sync,
) -> PyResult<Trace<S>>
where
    S: Send,
{
    let arguments = arguments(py, names, values)?.trace(py, false)?;
    let mut samples = room(arguments.len())?;
    let mut last = f64::NEG_INFINITY;
    arguments.each(py, |values: [f64; I]| {
        if values[0] < last {
            let message = format!("time goes back from {last} s to {} s", values[0]);
            return Err(Refused::value("time", message));
        }
        if values[0] == last {
            let message = format!(
                "time = {last} stands twice: samples at the same time cannot be told apart"
            );
            return Err(Refused::value("time", message));
        }
        last = values[0];
        samples.push(sample(values));
        Ok(())
    })?;
    if samples.len() < 2 {
        return Err(refused(
            py,
            Refused::shape("time", "a trace has two samples or more"),
        ));
    }
    Ok(Trace {
        name: NAME.into(),
        samples,
    })
}

/// A trace of a ball screw.
fn screw_trace<'py>(py: Python<'py>, values: [&Any<'py>; 3]) -> PyResult<Trace<ScrewSample>> {
    let names = ["time", "nut_speed", "axial_load"];
    trace(py, names, values, |[time, nut_speed, axial_load]| {
        ScrewSample {
            time,
            nut_speed,
            axial_load,
            nut_position: 0.0,
        }
    })
}

/// What a scene makes of a trace; an interrupt ends it.
fn rows<S>(
    py: Python<'_>,
    mut scene: S,
    trace: Trace<S::Sample>,
    reference: Option<ReferenceModel>,
) -> PyResult<Vec<Row<S::Sample>>>
where
    S: Scene<Sample: Send + 'static> + Send + 'static,
{
    scene.set_encoder(EncoderStep::of(None, &trace));
    let made = interruptible(py, move |stop| {
        scene.rows(&trace, reference, &|| stop.check())
    })?;
    let (rows, _) = made.map_err(|failure| refused(py, failure))?;
    Ok(rows)
}

/// Outputs of a scene over a trace, as arrays.
fn columns<C: Columns>(
    py: Python<'_>,
    outputs: impl ExactSizeIterator<Item = TickOutputs>,
) -> PyResult<Bound<'_, PyAny>> {
    let mut columns = C::with_capacity(outputs.len())?;
    for outputs in outputs {
        columns.push(&outputs);
    }
    columns.run(py)
}

/// The circuit of balls of a design.
fn uncaged(py: Python<'_>, design: &Design, memory: bool) -> PyResult<Uncaged> {
    let inner = (*design.inner).clone();
    if let Some(balls) = inner.uncaged {
        return Ok(Uncaged {
            design: inner,
            balls,
            memory,
            encoder: EncoderStep::default(),
        });
    }
    let message = format!("{} says nothing of its circuit of balls", inner.name);
    Err(refused(py, Refused::value("uncaged", message)))
}

/// A caged ball screw over a trace, as the command ``simulate`` runs it, to the bit.
///
/// Args:
///     design: its geometry and what stands beside it.
///     time: s, shape (n,), n of two or more, rising.
///     nut_speed: rad/s, shape (n,) or a number.
///     axial_load: N, shape (n,) or a number.
///     memory: whether friction remembers; elements are designed at the trace's mean load.
///
/// Returns:
///     Run: arrays of shape (n,).
///
/// Raises:
///     Error: a sample that is NaN or infinite, a time that stands twice or goes back, a single sample, arrays that do not fit, a value
///         out of its range.
#[pyfunction]
#[pyo3(signature = (design, time, nut_speed, axial_load, *, memory=false))]
pub fn simulate_caged<'py>(
    py: Python<'py>,
    design: &Design,
    time: Any<'py>,
    nut_speed: Any<'py>,
    axial_load: Any<'py>,
    memory: bool,
) -> PyResult<Any<'py>> {
    let trace = screw_trace(py, [&time, &nut_speed, &axial_load])?;
    let scene = Caged {
        design: (*design.inner).clone(),
        memory,
        encoder: EncoderStep::default(),
        temperature: false,
    };
    let rows = rows(py, scene, trace, None)?;
    columns::<ScrewColumns>(py, rows.iter().map(|row| row.outputs))
}

/// A ball screw without cage over a trace of equal steps of time, as the command ``simulate`` runs it, to the bit.
///
/// The model takes as many ticks for each sample as its balls need.
///
/// Args:
///     design: with what it says of its circuit of balls.
///     time: s, shape (n,), n of two or more, rising in equal steps.
///     nut_speed: rad/s, shape (n,) or a number.
///     axial_load: N, shape (n,) or a number.
///     memory: whether friction remembers; elements are designed at the trace's mean load.
///
/// Returns:
///     UncagedRun: arrays of shape (n,).
///
/// Raises:
///     Error: a sample that is NaN or infinite, a time that stands twice or goes back, a single sample, arrays that do not fit, a value
///         out of its range.
#[pyfunction]
#[pyo3(signature = (design, time, nut_speed, axial_load, *, memory=false))]
pub fn simulate_uncaged<'py>(
    py: Python<'py>,
    design: &Design,
    time: Any<'py>,
    nut_speed: Any<'py>,
    axial_load: Any<'py>,
    memory: bool,
) -> PyResult<Any<'py>> {
    let trace = screw_trace(py, [&time, &nut_speed, &axial_load])?;
    let scene = uncaged(py, design, memory)?;
    let rows = rows(py, scene, trace, None)?;
    columns::<UncagedColumns>(py, rows.iter().map(|row| row.outputs))
}

/// A linear bearing over a trace of equal steps of time, as the command ``simulate`` runs it, to the bit.
///
/// The model takes as many ticks for each sample as its balls need.
///
/// Args:
///     design: with its circuit of balls.
///     time: s, shape (n,), n of two or more, rising in equal steps.
///     speed: of the carriage, m/s, shape (n,) or a number.
///     normal_load: N, shape (n,) or a number.
///     side_load: N, shape (n,) or a number.
///     memory: whether friction remembers; elements are designed at the trace's mean load.
///
/// Returns:
///     LinearRun: arrays of shape (n,).
///
/// Raises:
///     Error: a sample that is NaN or infinite, a time that stands twice or goes back, a single sample, arrays that do not fit, a value
///         out of its range.
#[pyfunction]
#[pyo3(signature = (design, time, speed, normal_load, side_load, *, memory=false))]
pub fn simulate_linear<'py>(
    py: Python<'py>,
    design: &LinearDesign,
    time: Any<'py>,
    speed: Any<'py>,
    normal_load: Any<'py>,
    side_load: Any<'py>,
    memory: bool,
) -> PyResult<Any<'py>> {
    let names = ["time", "speed", "normal_load", "side_load"];
    let values = [&time, &speed, &normal_load, &side_load];
    let trace = trace(
        py,
        names,
        values,
        |[time, speed, normal_load, side_load]| LinearSample {
            time,
            speed,
            normal_load,
            side_load,
        },
    )?;
    let scene = Linear {
        design: (*design.inner).clone(),
        memory,
        encoder: EncoderStep::default(),
    };
    let rows = rows(py, scene, trace, None)?;
    columns::<LinearColumns>(py, rows.iter().map(|row| row.outputs))
}

/// What the reference says, as arrays.
fn reference_run(
    py: Python<'_>,
    rows: impl Iterator<Item = Option<bindings::Friction>>,
) -> PyResult<Bound<'_, PyAny>> {
    let (torque, efficiency): (Vec<f64>, Vec<f64>) = rows
        .map(|friction| {
            friction.map_or((f64::NAN, f64::NAN), |friction| {
                (friction.friction_torque, friction.efficiency)
            })
        })
        .unzip();
    let shape = [torque.len()];
    let fields = (shaped(py, torque, &shape)?, shaped(py, efficiency, &shape)?);
    result(py, "ReferenceRun", fields)
}

/// A caged ball screw over a trace in float64: every ball's exact balance between elastic grooves.
///
/// Args:
///     design: its geometry and what stands beside it.
///     time: s, shape (n,), n of two or more, rising.
///     nut_speed: rad/s, shape (n,) or a number.
///     axial_load: N, shape (n,) or a number.
///
/// Returns:
///     ReferenceRun: float64 arrays of shape (n,).
///
/// Raises:
///     Error: a sample that is NaN or infinite, a time that stands twice or goes back, a single sample, arrays that do not fit, a value
///         out of its range.
#[pyfunction]
#[pyo3(signature = (design, time, nut_speed, axial_load))]
pub fn reference_simulate_caged<'py>(
    py: Python<'py>,
    design: &Design,
    time: Any<'py>,
    nut_speed: Any<'py>,
    axial_load: Any<'py>,
) -> PyResult<Any<'py>> {
    let trace = screw_trace(py, [&time, &nut_speed, &axial_load])?;
    let scene = Caged {
        design: (*design.inner).clone(),
        memory: false,
        encoder: EncoderStep::default(),
        temperature: false,
    };
    let rows = rows(py, scene, trace, Some(ReferenceModel::Exact))?;
    reference_run(py, rows.iter().map(|row| row.reference))
}

/// A ball screw without cage over a trace in float64: every ball in elastic grooves with exact contact integrals, and the
/// forces between them. At most 10,000 states of 37 balls are solved, linear in between; some ten milliseconds each.
///
/// Args:
///     design: with what it says of its circuit of balls.
///     time: s, shape (n,), n of two or more, rising in equal steps.
///     nut_speed: rad/s, shape (n,) or a number.
///     axial_load: N, shape (n,) or a number.
///
/// Returns:
///     ReferenceRun: float64 arrays of shape (n,).
///
/// Raises:
///     Error: a sample that is NaN or infinite, a time that stands twice or goes back, a single sample, arrays that do not fit, a value
///         out of its range.
#[pyfunction]
#[pyo3(signature = (design, time, nut_speed, axial_load))]
pub fn reference_simulate_uncaged<'py>(
    py: Python<'py>,
    design: &Design,
    time: Any<'py>,
    nut_speed: Any<'py>,
    axial_load: Any<'py>,
) -> PyResult<Any<'py>> {
    let trace = screw_trace(py, [&time, &nut_speed, &axial_load])?;
    let scene = uncaged(py, design, false)?;
    let rows = rows(py, scene, trace, Some(ReferenceModel::Exact))?;
    reference_run(py, rows.iter().map(|row| row.reference))
}

/// A built-in manoeuvre of a steering gear: rack force and rack travel, turned to the nut by the design's lead.
///
/// Args:
///     name: "parking", "weave", "kerb" or "turns".
///     design: whose lead it is.
///
/// Returns:
///     tuple[ndarray, ndarray, ndarray]: time in s, nut speed in rad/s and axial load in N; float64, shape (n,).
///
/// Raises:
///     Error: a name that there is not.
#[pyfunction]
pub fn manoeuvre<'py>(
    py: Python<'py>,
    name: &str,
    design: &Design,
) -> PyResult<[Bound<'py, PyArray1<f64>>; 3]> {
    let manoeuvre = match name {
        "parking" => Manoeuvre::Parking,
        "weave" => Manoeuvre::Weave,
        "kerb" => Manoeuvre::Kerb,
        "turns" => Manoeuvre::Turns,
        _ => {
            let message = format!("name = {name:?} is none of: parking, weave, kerb, turns");
            return Err(refused(py, Refused::value("name", message)));
        }
    };
    let trace =
        bindings::trace(manoeuvre, design.inner.screw()).map_err(|failure| refused(py, failure))?;
    let of = |value: fn(&ScrewSample) -> f64| {
        PyArray1::from_vec(py, trace.samples.iter().map(value).collect())
    };
    Ok([
        of(|sample| sample.time),
        of(|sample| sample.nut_speed),
        of(|sample| sample.axial_load),
    ])
}

/// A synthetic trace of a steering gear's screw, "lin-4.1", by physics of its own in float64, with noise of sensors:
/// something to try :func:`epas_friction.calibrate` on.
///
/// Args:
///     course: "vehicle" (what a steering gear sees), "rig" (what a test rig adds), or "whole".
///     seed: of the noise.
///
/// Returns:
///     dict[str, ndarray]: time (s), nut_position (rad), motor_torque (N m, on the nut), axial_load (N), temperature (K);
///         float64, shape (n,).
///
/// Raises:
///     Error: a course that there is not.
#[pyfunction]
#[pyo3(signature = (course="vehicle", *, seed=0))]
pub fn reference_measured_trace<'py>(
    py: Python<'py>,
    course: &str,
    seed: u64,
) -> PyResult<Bound<'py, PyDict>> {
    let course = match course {
        "vehicle" => Course::vehicle(),
        "rig" => Course::rig(),
        "whole" => Course::whole(),
        _ => {
            let message = format!("course = {course:?} is none of: vehicle, rig, whole");
            return Err(refused(py, Refused::value("course", message)));
        }
    };
    let run = move |_: &Stop| Rig::new(Parameters::default())?.run(&course, seed);
    let trace = interruptible(py, run)?.map_err(|error| refused(py, error))?;
    let dict = PyDict::new(py);
    for (name, values) in [
        ("time", trace.time),
        ("nut_position", trace.nut_position),
        ("motor_torque", trace.motor_torque),
        ("axial_load", trace.axial_load),
        ("temperature", trace.temperature),
    ] {
        dict.set_item(name, PyArray1::from_vec(py, values))?;
    }
    Ok(dict)
}

/// The answer of the command ``eval`` to a request, both as JSON text; :func:`epas_friction.eval` takes and gives dicts.
///
/// Args:
///     request: one JSON object.
///
/// Returns:
///     str: one JSON object.
#[pyfunction]
pub fn eval_json(py: Python<'_>, request: String) -> PyResult<String> {
    interruptible(py, move |_| bindings::eval(&request))
}
