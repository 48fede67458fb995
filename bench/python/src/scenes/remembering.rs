//! A caged ball screw whose friction remembers.

use epas_bench::bindings::{self, Remembers, Use, remembering, wrapped};
use epas_friction::{Inputs, Outputs};
use pyo3::prelude::*;

use super::columns::{Columns, ScrewColumns};
use crate::design::Design;
use crate::errors::{Refused, refused};
use crate::numbers::arguments;

/// A screw that remembers, whatever its elements and its friction coefficient are.
trait Memory: Send + Sync {
    fn step(&mut self, inputs: Inputs, angle: f32) -> Outputs;
    fn between(&mut self, angle: f32) -> Outputs;
    fn reset(&mut self);
    fn faulted_ticks(&self) -> u32;
    fn copied(&self) -> Box<dyn Memory>;
}

impl<R: Remembers + 'static> Memory for R {
    fn step(&mut self, inputs: Inputs, angle: f32) -> Outputs {
        Remembers::step(self, inputs, angle)
    }

    fn between(&mut self, angle: f32) -> Outputs {
        Remembers::between(self, angle)
    }

    fn reset(&mut self) {
        Remembers::reset(self);
    }

    fn faulted_ticks(&self) -> u32 {
        Remembers::faulted_ticks(self)
    }

    fn copied(&self) -> Box<dyn Memory> {
        Box::new(self.clone())
    }
}

/// Boxes it.
struct Boxed;

impl Use for Boxed {
    type Made = Box<dyn Memory>;

    fn with(self, screw: impl Remembers + 'static) -> Self::Made {
        Box::new(screw)
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
///
/// Raises:
///     Error: a value out of its range.
#[pyclass(module = "epas_friction")]
pub struct CagedBallScrewWithMemory {
    model: Box<dyn Memory>,
}

#[pymethods]
impl CagedBallScrewWithMemory {
    #[new]
    #[pyo3(signature = (design, *, reference_load))]
    fn new(py: Python<'_>, design: &Design, reference_load: f32) -> PyResult<Self> {
        if !(reference_load.is_finite() && reference_load >= 0.0) {
            let error = Refused::range("reference_load", reference_load.into(), 0.0, 1e6);
            return Err(refused(py, error));
        }
        let angle = bindings::angle().map_err(|error| refused(py, error))?;
        let (model, _) = py
            .detach(|| remembering(&design.inner, reference_load, angle, Boxed))
            .map_err(|failure| refused(py, failure))?;
        Ok(Self { model })
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
        let inputs = Inputs {
            nut_speed,
            axial_load,
        };
        ScrewColumns::tick(py, &self.model.step(inputs, wrapped(nut_angle)))
    }

    /// Friction at an angle between two steps, under the limits of the last one: for a current loop that runs faster.
    ///
    /// Args:
    ///     nut_angle: rad; whole turns do not matter.
    ///
    /// Returns:
    ///     Outputs: torques in N m, efficiency, regime, faults.
    fn between<'py>(&mut self, py: Python<'py>, nut_angle: f64) -> PyResult<Bound<'py, PyAny>> {
        ScrewColumns::tick(py, &self.model.between(wrapped(nut_angle)))
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
        let mut columns = ScrewColumns::with_capacity(trace.len());
        let model = &mut self.model;
        trace.each(py, |[nut_speed, axial_load, angle]: [f64; 3]| {
            let inputs = Inputs {
                nut_speed: nut_speed as f32,
                axial_load: axial_load as f32,
            };
            columns.push(&model.step(inputs, wrapped(angle)));
            Ok(())
        })?;
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

    /// The same model in the same state.
    fn copy(&self) -> Self {
        Self {
            model: self.model.copied(),
        }
    }
}
