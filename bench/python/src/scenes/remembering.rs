//! A caged ball screw whose friction remembers.

use std::sync::Arc;

use epas_cli::bindings::{self, Failure, Model, TickInputs, coefficients, remembering, wrapped};
use epas_design::caged_scene as caged;
use pyo3::prelude::*;

use super::caged::words;
use super::columns::{Columns, ScrewColumns};
use crate::design::{Design, restored_design};
use crate::errors::{Refused, refused};
use crate::interrupt::interruptible;
use crate::numbers::{arguments, single, within};
use crate::restored::{self, Recipe, Reduced, reduced};

/// Largest load at which elements are designed, N.
const LARGEST_LOAD: f64 = 1e6;

/// Largest step of an encoder, rad.
const LARGEST_STEP: f64 = 0.1;

/// A tick at an angle of the nut, rad.
fn inputs(nut_speed: f32, axial_load: f32, nut_angle: f64) -> TickInputs {
    TickInputs {
        reading: wrapped(nut_angle),
        ..TickInputs::new(nut_speed, axial_load)
    }
}

/// A ball screw whose balls do not touch and whose friction remembers: it passes through a reversal with the nut's angle.
///
/// Eight elements that stick and slip, by the design under a load; or, where the design has a calibration, as the measured
/// trace has told them, with the friction coefficient by speed and direction. It is solved when it is made, as :class:`CagedBallScrew`.
///
/// Args:
///     design: its geometry and what stands beside it.
///     reference_load: axial load at which the elements are designed, N; 1 kN is where reversals matter in a steering gear.
///     encoder_step: step of the encoder, rad of the nut, 0 to 0.1: friction follows the angle behind a dead band of it, so that flicker at rest moves
///         nothing, and feels a reversal that much later.
///
/// Raises:
///     Error: a value out of its range.
#[pyclass(module = "epas_friction")]
pub struct CagedBallScrewWithMemory {
    model: Box<dyn Model>,
    recipe: Recipe,
    reference_load: f32,
    encoder_step: f32,
    /// The words of its block; none of a closed form.
    words: Arc<[u32]>,
}

#[pymethods]
impl CagedBallScrewWithMemory {
    #[new]
    #[pyo3(signature = (design, *, reference_load, encoder_step=0.0))]
    fn new(
        py: Python<'_>,
        design: &Design,
        reference_load: f64,
        encoder_step: f64,
    ) -> PyResult<Self> {
        within("reference_load", reference_load, 0.0, LARGEST_LOAD)
            .and_then(|()| within("encoder_step", encoder_step, 0.0, LARGEST_STEP))
            .map_err(|error| refused(py, error))?;
        let reference_load = single(py, "reference_load", reference_load)?;
        let encoder_step = single(py, "encoder_step", encoder_step)?;
        let angle = bindings::angle().map_err(|error| refused(py, error))?;
        let inner = design.inner.clone();
        let made = interruptible(py, move |_| {
            let made = remembering(&inner, reference_load, (angle, encoder_step))?;
            // Solved before: its words are at hand.
            let words = caged::words(&inner, coefficients(&inner)?)?;
            Ok::<_, Failure>((made.model, words.unwrap_or_default()))
        })?;
        let (model, words) = made.map_err(|failure| refused(py, failure))?;
        Ok(Self {
            model,
            recipe: design.recipe.clone(),
            reference_load,
            encoder_step,
            words: words.into(),
        })
    }

    /// One tick, as in the control interrupt: never an exception, faults are flagged.
    ///
    /// Args:
    ///     nut_speed: rad/s.
    ///     axial_load: N; positive where it opposes the travel that a positive nut speed makes.
    ///     nut_angle: rad; whole turns do not matter.
    ///
    /// Returns:
    ///     Outputs: torques in N m, efficiency, regime, faults.
    fn step<'py>(
        &mut self,
        py: Python<'py>,
        nut_speed: f32,
        axial_load: f32,
        nut_angle: f64,
    ) -> PyResult<Bound<'py, PyAny>> {
        let inputs = inputs(nut_speed, axial_load, nut_angle);
        ScrewColumns::tick(py, &self.model.step(&inputs))
    }

    /// Friction at an angle between two steps, under the limits of the last one: for a current loop that runs faster.
    ///
    /// Args:
    ///     nut_angle: rad; whole turns do not matter.
    ///
    /// Returns:
    ///     Outputs: torques in N m, efficiency, regime, faults.
    fn between<'py>(&mut self, py: Python<'py>, nut_angle: f64) -> PyResult<Bound<'py, PyAny>> {
        let outputs = self.model.between(wrapped(nut_angle));
        let outputs = outputs.ok_or_else(|| refused(py, Refused::message("no memory")))?;
        ScrewColumns::tick(py, &outputs)
    }

    /// A whole trace, tick after tick, from the present state on. Other threads run meanwhile.
    ///
    /// Arrays of float32 and float64 are read where they lie.
    ///
    /// Args:
    ///     nut_speed: rad/s, shape (n,) or a number.
    ///     axial_load: N, shape (n,) or a number.
    ///     nut_angle: rad, shape (n,); whole turns do not matter.
    ///     allow_faults: whether NaN and infinity are let in, and flagged as in the control interrupt.
    ///
    /// Returns:
    ///     Run: arrays of shape (n,).
    ///
    /// Raises:
    ///     Error: a sample that is NaN or infinite, arrays that do not fit; the model stays as it was.
    #[pyo3(signature = (nut_speed, axial_load, nut_angle, *, allow_faults=false))]
    fn run<'py>(
        &mut self,
        py: Python<'py>,
        nut_speed: Bound<'py, PyAny>,
        axial_load: Bound<'py, PyAny>,
        nut_angle: Bound<'py, PyAny>,
        allow_faults: bool,
    ) -> PyResult<Bound<'py, PyAny>> {
        let names = ["nut_speed", "axial_load", "nut_angle"];
        let trace =
            arguments(py, names, [&nut_speed, &axial_load, &nut_angle])?.trace(py, allow_faults)?;
        let mut model = self.model.copied();
        let columns = ScrewColumns::of(py, &trace, |[speed, load, angle]: [f64; 3]| {
            model.step(&inputs(speed as f32, load as f32, angle))
        })?;
        self.model = model;
        columns.run(py)
    }

    /// Back to the state before the first tick.
    fn reset(&mut self) {
        self.model.reset();
    }

    /// Consecutive ticks with a fault; 0 after a sound tick.
    #[getter]
    fn faulted_ticks(&self) -> u32 {
        self.model.faulted_ticks()
    }

    fn __repr__(&self) -> String {
        let (design, _) = self.recipe.arguments();
        let load = self.reference_load;
        format!("<CagedBallScrewWithMemory: {design}, reference_load={load}>")
    }

    fn __copy__(&self) -> Self {
        self.copy()
    }

    fn __deepcopy__(&self, _memo: &Bound<'_, PyAny>) -> Self {
        self.copy()
    }

    /// Faulted ticks are counted anew.
    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        let state = restored::state(py, self.model.export())?;
        let (name, text) = self.recipe.arguments();
        let block = restored::bytes(py, &self.words);
        let made = (self.reference_load, self.encoder_step);
        let arguments = (name, text, made, block, state);
        reduced(py, "remembering", arguments)
    }

    /// The same model in the same state.
    fn copy(&self) -> Self {
        Self {
            model: self.model.copied(),
            recipe: self.recipe.clone(),
            reference_load: self.reference_load,
            encoder_step: self.encoder_step,
            words: self.words.clone(),
        }
    }
}

/// A screw as pickle has it: its design, load and encoder's step, block, state.
#[pyfunction]
#[pyo3(name = "_restored_remembering")]
pub fn restored_remembering(
    py: Python<'_>,
    name: String,
    text: Option<String>,
    made: (f64, f64),
    block: &[u8],
    state: &[u8],
) -> PyResult<CagedBallScrewWithMemory> {
    let (reference_load, encoder_step) = made;
    let design = restored_design(py, name, text)?;
    if !block.is_empty() {
        caged::keep_words(&words(py, block)?).map_err(|error| refused(py, error))?;
    }
    let mut screw = CagedBallScrewWithMemory::new(py, &design, reference_load, encoder_step)?;
    let done = screw.model.import(state);
    done.map_err(|error| refused(py, error.to_string()))?;
    Ok(screw)
}
