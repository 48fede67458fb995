//! Studies of many designs and of many traces, in parts that any engine may run anywhere.

use epas_calibrate::folder::answered::{Answered, merged};
use epas_calibrate::folder::population::populations;
use epas_calibrate::screw::{self, Request};
use epas_calibrate::trace::columns::Frame;
use epas_calibrate::without_design;
use epas_cli::design_study::{Design as StudiedDesign, Duty, figures};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};

use crate::calibration::{geared, options, read, text, told};
use crate::design::Design;
use crate::errors::{Refused, refused};
use crate::interrupt::interruptible;
use crate::numbers::{arguments, single_or};
use crate::results::result;

type Any<'py> = Bound<'py, PyAny>;

/// Figures of ball screws of steel, by the exact balls that firmware's constants are folded from.
///
/// Arrays broadcast against each other. A design's figures follow from its own numbers alone, so that any part of a study gives
/// the same bits. Rolling resistance, about 1 % of the friction, is left out.
///
/// One core looks at some 1500 designs a second without a deviation, and at 75 with the force between balls: thousands are looked at
/// with ``deviation=0``, and the best of them with the force.
///
/// Args:
///     pitch_radius: radius of the cylinder on which the ball centres run, m.
///     lead: axial travel in one turn, m.
///     ball_radius: m.
///     conformity: groove radius over ball diameter, above 0.5.
///     contact_angle: rad, 0.05 to 1.5.
///     preload: load of each contact of an oversized ball without a load, N; 0, or from 1e-3 on.
///     axial_load: N, 1e-3 to 1e7; it opposes the travel.
///     turns: turns of the track that are filled with balls side by side.
///     friction: coefficient of ball and groove, 1e-3 to 0.5.
///     ball_friction: coefficient of ball and ball, 0 to 0.5.
///     deviation: by which the contact angle at one of two neighbouring balls is off, rad, 0 to 0.2; one degree where it is left out. At 0
///         no ball presses, and a design takes a twentieth of the time.
///     strict: whether a design out of range is an error; else its figures are NaN.
///
/// Returns:
///     DesignFigures: loaded_balls, friction_torque (N m), efficiency, max_pressure (Pa), contact_force (between two balls, N;
///     NaN where a ball has no balance), float32, of the broadcast shape.
///
/// Raises:
///     Error: a value out of its range, with its place in the arrays.
#[pyfunction]
#[pyo3(signature = (pitch_radius, lead, ball_radius, conformity=None, contact_angle=None, preload=None, *, axial_load=None, turns=None, friction=None, ball_friction=None, deviation=None, strict=true))]
pub fn design_figures<'py>(
    py: Python<'py>,
    pitch_radius: Any<'py>,
    lead: Any<'py>,
    ball_radius: Any<'py>,
    conformity: Option<Any<'py>>,
    contact_angle: Option<Any<'py>>,
    preload: Option<Any<'py>>,
    axial_load: Option<f64>,
    turns: Option<f64>,
    friction: Option<f64>,
    ball_friction: Option<f64>,
    deviation: Option<f64>,
    strict: bool,
) -> PyResult<Any<'py>> {
    let or = |given: Option<Any<'py>>, usual: f64| -> PyResult<Any<'py>> {
        given.map_or_else(|| Ok(usual.into_pyobject(py)?.into_any()), Ok)
    };
    let conformity = or(conformity, 0.54)?;
    let contact_angle = or(contact_angle, std::f64::consts::FRAC_PI_4)?;
    let preload = or(preload, 0.0)?;
    let usual = Duty::DEFAULT;
    let duty = Duty {
        axial_load: single_or(py, "axial_load", axial_load, usual.axial_load)?,
        turns: single_or(py, "turns", turns, usual.turns)?,
        friction: single_or(py, "friction", friction, usual.friction)?,
        ball_friction: single_or(py, "ball_friction", ball_friction, usual.ball_friction)?,
        deviation: single_or(py, "deviation", deviation, usual.deviation)?,
    };
    let names = [
        "pitch_radius",
        "lead",
        "ball_radius",
        "conformity",
        "contact_angle",
        "preload",
    ];
    let values = [
        &pitch_radius,
        &lead,
        &ball_radius,
        &conformity,
        &contact_angle,
        &preload,
    ];
    let found = arguments(py, names, values)?.map(py, move |numbers: [f32; 6]| {
        let [
            pitch_radius,
            lead,
            ball_radius,
            conformity,
            contact_angle,
            preload,
        ] = numbers;
        let design = StudiedDesign {
            pitch_radius,
            lead,
            ball_radius,
            conformity,
            contact_angle,
            preload,
        };
        match figures(&design, &duty) {
            Ok(found) => Ok([
                f32::from(found.loaded_balls),
                found.friction_torque,
                found.efficiency,
                found.max_pressure,
                found.contact_force,
            ]),
            Err(error) if strict => Err(Refused::from(error).renamed("contact_force", "preload")),
            Err(_) => Ok([f32::NAN; 5]),
        }
    })?;
    let [
        loaded_balls,
        friction_torque,
        efficiency,
        max_pressure,
        contact_force,
    ] = found.arrays(py)?;
    result(
        py,
        "DesignFigures",
        (
            loaded_balls,
            friction_torque,
            efficiency,
            max_pressure,
            contact_force,
        ),
    )
}

/// Fits one trace of many; what it says, as a list that merges (JSON).
///
/// Args:
///     trace: dict of column names to arrays of shape (n,), as of :func:`calibrate`.
///     design: of the screw, where it is known; else a mass or an inertia with load-free friction is fitted.
///     ratio: turns of the motor in a turn of the nut, 0.01 to 1000; 1 without; with a design.
///
/// Returns:
///     str: values with their covariance, for :func:`merge_sums` and :func:`population`.
///
/// Raises:
///     Error: a trace from which nothing can be told, a ratio out of its range or without a design.
#[pyfunction]
#[pyo3(signature = (trace, design=None, *, ratio=None))]
pub fn trace_sums(
    py: Python<'_>,
    trace: &Any<'_>,
    design: Option<&Design>,
    ratio: Option<f64>,
) -> PyResult<String> {
    geared(py, ratio)?;
    options(py, design.is_some(), &[("ratio", ratio.is_some())], &[])?;
    let text = text(py, trace)?;
    let design = design.map(|design| design.inner.clone());
    let summed = interruptible(py, move |_| match design {
        None => without_design::plain(&read(text, None)?),
        Some(design) => {
            let frame = Frame::of(&design, ratio);
            let request = Request::default();
            screw::plain(&read(text, Some(&frame))?, &design, &request)
        }
    })?;
    let (_, answered) = summed.map_err(|failure| refused(py, told(failure)))?;
    written(py, &[answered])
}

/// What parts say as what the whole says: in any order and grouping the same text.
///
/// Args:
///     parts: list of what :func:`trace_sums` or this function returned; one or more.
///
/// Returns:
///     str: all of them together.
///
/// Raises:
///     Error: text that holds nothing of the kind, or fits with a design beside such without one.
#[pyfunction]
pub fn merge_sums(py: Python<'_>, parts: Vec<String>) -> PyResult<String> {
    if parts.is_empty() {
        let none = Refused::value("parts", "there is nothing to merge");
        return Err(refused(py, none));
    }
    written(py, &parsed(py, "parts", &parts)?)
}

/// Mean and spread of each parameter over all traces.
///
/// Args:
///     sums: of :func:`trace_sums` or :func:`merge_sums`.
///
/// Returns:
///     list of dict: name, traces, mean, mean_interval (95 %), spread (None where one trace tells it), next (where the next
///     trace's value will be, 95 %).
///
/// Raises:
///     Error: text that neither of them returned.
#[pyfunction]
pub fn population<'py>(py: Python<'py>, sums: &str) -> PyResult<Bound<'py, PyList>> {
    let list = PyList::empty(py);
    let all = parsed(py, "sums", &[sums.to_owned()])?;
    for one in populations(&all.iter().collect::<Vec<_>>()) {
        let entry = PyDict::new(py);
        entry.set_item("name", one.name)?;
        entry.set_item("traces", one.traces)?;
        entry.set_item("mean", one.mean)?;
        entry.set_item("mean_interval", one.mean_interval)?;
        entry.set_item("spread", one.spread)?;
        entry.set_item("next", one.next)?;
        list.append(entry)?;
    }
    Ok(list)
}

fn parsed(py: Python<'_>, field: &str, texts: &[String]) -> PyResult<Vec<Answered>> {
    merged(texts.iter().map(String::as_str))
        .map_err(|error| refused(py, Refused::value(field, error)))
}

fn written(py: Python<'_>, all: &[Answered]) -> PyResult<String> {
    serde_json::to_string(all)
        .map_err(|error| refused(py, Refused::value("sums", error.to_string())))
}
