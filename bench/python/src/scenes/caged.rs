//! A ball screw whose balls do not touch.

use epas_friction::{
    CagedBallScrew as Scene, CagedBallScrewConfiguration, Clearance, FrictionBranch, FrictionModel,
    Inputs,
};
use pyo3::prelude::*;

use super::columns::{Columns, ScrewColumns};
use crate::design::Design;
use crate::errors::{Refused, refused};
use crate::numbers::arguments;

/// A ball screw whose balls do not touch: friction of the grooves alone.
///
/// With the branch "rolling" or "sliding" friction is that of a closed-form efficiency.
///
/// Args:
///     design: its geometry and what stands beside it.
///     friction: coefficient of ball and groove; the design's where it is left out.
///     branch: "contacts", "rolling" or "sliding"; the design's where it is left out.
///     loaded_balls: balls that carry load, 1 to 1000; the design's where it is left out.
///     reversal_speed: nut speed over which friction changes its direction, rad/s; the design's where it is left out.
///
/// Raises:
///     Error: a value out of its range.
#[pyclass(module = "epas_friction")]
pub struct CagedBallScrew {
    model: FrictionModel<Scene>,
}

/// A branch by its name.
fn branch_of(py: Python<'_>, name: &str) -> PyResult<FrictionBranch> {
    match name {
        "contacts" => Ok(FrictionBranch::Contacts),
        "rolling" => Ok(FrictionBranch::Rolling),
        "sliding" => Ok(FrictionBranch::Sliding),
        _ => {
            let message = format!("branch = {name:?} is none of: contacts, rolling, sliding");
            Err(refused(py, Refused::value("branch", message)))
        }
    }
}

#[pymethods]
impl CagedBallScrew {
    #[new]
    #[pyo3(signature = (design, *, friction=None, branch=None, loaded_balls=None, reversal_speed=None))]
    fn new(
        py: Python<'_>,
        design: &Design,
        friction: Option<f32>,
        branch: Option<&str>,
        loaded_balls: Option<u16>,
        reversal_speed: Option<f32>,
    ) -> PyResult<Self> {
        let usual = design.inner.configuration;
        let configuration = CagedBallScrewConfiguration {
            friction: friction.unwrap_or(usual.friction),
            branch: branch.map_or(Ok(usual.branch), |name| branch_of(py, name))?,
            loaded_balls: loaded_balls.unwrap_or(usual.loaded_balls),
            reversal_speed: reversal_speed.unwrap_or(usual.reversal_speed),
            ..usual
        };
        let model = FrictionModel::new(&configuration).map_err(|error| refused(py, error))?;
        Ok(Self { model })
    }

    /// One tick, as in the control interrupt: never an exception, faults are flagged.
    ///
    /// Args:
    ///     nut_speed: rad/s.
    ///     axial_load: N; positive where it opposes the travel that a positive nut speed makes.
    ///
    /// Returns:
    ///     Outputs: torques in N m, efficiency, regime, faults.
    fn step<'py>(
        &mut self,
        py: Python<'py>,
        nut_speed: f32,
        axial_load: f32,
    ) -> PyResult<Bound<'py, PyAny>> {
        let outputs = self.model.step(Inputs {
            nut_speed,
            axial_load,
        });
        ScrewColumns::tick(py, &outputs)
    }

    /// A whole trace, tick after tick, from the present state on. Other threads run meanwhile.
    ///
    /// Arrays of float32 are read where they lie.
    ///
    /// Args:
    ///     nut_speed: rad/s, shape (n,) or a number.
    ///     axial_load: N, shape (n,) or a number.
    ///     allow_faults: whether NaN and infinity are let in, and flagged as in the control interrupt.
    ///
    /// Returns:
    ///     Run: arrays of shape (n,).
    ///
    /// Raises:
    ///     Error: a sample that is NaN or infinite, arrays that do not fit; the model stays as it was.
    #[pyo3(signature = (nut_speed, axial_load, *, allow_faults=false))]
    fn run<'py>(
        &mut self,
        py: Python<'py>,
        nut_speed: Bound<'py, PyAny>,
        axial_load: Bound<'py, PyAny>,
        allow_faults: bool,
    ) -> PyResult<Bound<'py, PyAny>> {
        let names = ["nut_speed", "axial_load"];
        let trace = arguments(py, names, [&nut_speed, &axial_load])?.trace(py, allow_faults)?;
        let mut columns = ScrewColumns::with_capacity(trace.len());
        let model = &mut self.model;
        trace.each(py, |[nut_speed, axial_load]| {
            columns.push(&model.step(Inputs {
                nut_speed,
                axial_load,
            }));
            Ok(())
        })?;
        columns.run(py)
    }

    /// Back to the state before the first tick.
    fn reset(&mut self) {
        self.model.reset();
    }

    /// Sets the friction coefficient of ball and groove, 1e-6 to 0.5, from the next tick on.
    ///
    /// Raises:
    ///     Error: a value out of its range; the model stays as it was.
    fn set_friction(&mut self, py: Python<'_>, friction: f32) -> PyResult<()> {
        let done = self.model.set_friction(friction);
        done.map_err(|error| refused(py, error))
    }

    /// Sets the radial gap of every contact, m: play above 0, oversize below.
    ///
    /// Raises:
    ///     Error: a value out of its range; the model stays as it was.
    fn set_clearance(&mut self, py: Python<'_>, clearance: f32) -> PyResult<()> {
        let done = Clearance::new(clearance).and_then(|gap| self.model.set_clearance(gap));
        done.map_err(|error| refused(py, error))
    }

    /// Consecutive ticks with a fault; 0 after a sound tick.
    #[getter]
    fn faulted_ticks(&self) -> u32 {
        self.model.faulted_ticks()
    }

    /// The same model in the same state.
    fn copy(&self) -> Self {
        Self { model: self.model }
    }
}
