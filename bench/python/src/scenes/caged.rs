//! A ball screw whose balls do not touch.

use epas_bench::bindings::{Design as Inner, Failure};
use epas_bench::caged::{CagedModel, CagedScene, fold_for};
use epas_friction::{FrictionBranch, Inputs};
use pyo3::prelude::*;
use pyo3::types::PyBytes;

use super::columns::{Columns, ScrewColumns};
use crate::design::Design;
use crate::errors::{Refused, refused};
use crate::numbers::arguments;
use crate::results::result;

/// A ball screw whose balls do not touch: friction of the grooves alone.
///
/// It is solved when it is made, within half a second, and within two for a range of friction coefficients: what runs is the block of
/// constants that firmware evaluates. Other threads run meanwhile, and a design that was solved before is there at once.
/// With the branch "rolling" or "sliding" friction is that of a closed-form efficiency, and nothing is solved.
///
/// Args:
///     design: its geometry and what stands beside it.
///     friction: coefficient of ball and groove; the design's where it is left out.
///     friction_range: least and largest coefficient that :meth:`set_friction` may set; the coefficient alone where it is left out.
///     branch: "contacts", "rolling" or "sliding"; the design's where it is left out.
///     loaded_balls: balls that carry load, 1 to 1000; the design's where it is left out.
///     reversal_speed: nut speed over which friction changes its direction, rad/s; the design's where it is left out.
///
/// Raises:
///     Error: a value out of its range, or a range that one block does not hold.
#[pyclass(module = "epas_friction")]
pub struct CagedBallScrew {
    model: CagedModel,
}

/// A branch by its name; none for the contacts.
fn branch_of(py: Python<'_>, name: &str) -> PyResult<Option<FrictionBranch>> {
    match name {
        "contacts" => Ok(None),
        "rolling" => Ok(Some(FrictionBranch::Rolling)),
        "sliding" => Ok(Some(FrictionBranch::Sliding)),
        _ => {
            let message = format!("branch = {name:?} is none of: contacts, rolling, sliding");
            Err(refused(py, Refused::value("branch", message)))
        }
    }
}

/// The words of a block's bytes, least significant first.
pub fn words(py: Python<'_>, block: &[u8]) -> PyResult<Vec<u32>> {
    let (words, rest) = block.as_chunks::<4>();
    if rest.is_empty() {
        return Ok(words
            .iter()
            .map(|bytes| u32::from_le_bytes(*bytes))
            .collect());
    }
    let message = format!(
        "block has {} bytes, which are no whole words of 4",
        block.len()
    );
    Err(refused(py, Refused::value("block", message)))
}

#[pymethods]
impl CagedBallScrew {
    #[new]
    #[pyo3(signature = (design, *, friction=None, friction_range=None, branch=None, loaded_balls=None, reversal_speed=None))]
    fn new(
        py: Python<'_>,
        design: &Design,
        friction: Option<f32>,
        friction_range: Option<(f32, f32)>,
        branch: Option<&str>,
        loaded_balls: Option<u16>,
        reversal_speed: Option<f32>,
    ) -> PyResult<Self> {
        let mut design: Inner = (*design.inner).clone();
        let caged = &mut design.caged;
        caged.friction = friction.unwrap_or(caged.friction);
        caged.loaded_balls = loaded_balls.unwrap_or(caged.loaded_balls);
        caged.reversal_speed = reversal_speed.unwrap_or(caged.reversal_speed);
        let own = caged.friction;
        if let Some(name) = branch {
            design.branch = branch_of(py, name)?;
        }
        design.check().map_err(|error| refused(py, error))?;
        let (least, largest) = friction_range.unwrap_or((own, own));
        if !(least <= own && own <= largest) {
            let error = Refused::range("friction", own.into(), least.into(), largest.into());
            return Err(refused(py, error));
        }
        let scene = py.detach(|| CagedScene::with_coefficients(&design, (least, largest)));
        let scene = scene.map_err(|failure| refused(py, failure))?;
        Self::of(py, &scene)
    }

    /// A screw by a block that was folded before, of :func:`fold_design` or the command ``design``.
    ///
    /// Args:
    ///     block: its bytes, of each word the least significant first.
    ///
    /// Raises:
    ///     Error: bytes that are no block, a block of another version, or a damaged one.
    #[staticmethod]
    fn from_block(py: Python<'_>, block: &[u8]) -> PyResult<Self> {
        let scene = CagedScene::read(&words(py, block)?);
        Self::of(py, &scene.map_err(|error| refused(py, error))?)
    }

    /// Goes on with another block, as firmware swaps constants: worn, warm, or of another clearance. It has as many friction
    /// coefficients as the present one, and its own one is set.
    ///
    /// Raises:
    ///     Error: bytes that are no such block; the model stays as it was.
    fn swap_block(&mut self, py: Python<'_>, block: &[u8]) -> PyResult<()> {
        let words = words(py, block)?;
        self.model.swap(&words).map_err(|error| refused(py, error))
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

    /// Sets the friction coefficient of ball and groove, within the block's range, from the next tick on; of a closed form any.
    ///
    /// Raises:
    ///     Error: a value out of its range; the model stays as it was.
    fn set_friction(&mut self, py: Python<'_>, friction: f32) -> PyResult<()> {
        let done = self.model.set_friction(friction);
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

impl CagedBallScrew {
    fn of(py: Python<'_>, scene: &CagedScene) -> PyResult<Self> {
        let model = scene.model().map_err(|error| refused(py, error))?;
        Ok(Self { model })
    }
}

/// Solves a ball screw and folds what follows from its design into a block of constants, with a certificate: the errors of its friction
/// torque against the exact solver at 2048 states that were not fitted. Other threads run meanwhile: some two seconds for one
/// friction coefficient, ten for a range.
///
/// Args:
///     design: the screw.
///     friction_range: least and largest friction coefficient for which the block holds; the design's alone where it is left out.
///     axial_load: least and largest axial load of a ball, N; 5 and 300 where it is left out.
///     seed: of the certificate's states.
///
/// Returns:
///     FoldedDesign: the block's bytes, and its certificate.
///
/// Raises:
///     Error: what cannot be folded, or a domain over which the torque is not held to 3 %, with the place.
#[pyfunction]
#[pyo3(signature = (design, *, friction_range=None, axial_load=None, seed=None))]
pub fn fold_design<'py>(
    py: Python<'py>,
    design: &Design,
    friction_range: Option<(f32, f32)>,
    axial_load: Option<(f32, f32)>,
    seed: Option<u64>,
) -> PyResult<Bound<'py, PyAny>> {
    let friction = design.inner.caged.friction;
    let coefficients = friction_range.unwrap_or((friction, friction));
    let fold = fold_for(&design.inner, coefficients);
    let mut fold = fold.map_err(|message| refused(py, message))?;
    if let Some((least, largest)) = axial_load {
        fold.axial_load = [least, largest];
    }
    fold.seed = seed.unwrap_or(fold.seed);
    let (folded, bytes) = py
        .detach(|| {
            let folded = fold.folded()?;
            let bytes = folded.bytes()?;
            Ok::<_, Failure>((folded, bytes))
        })
        .map_err(|failure| refused(py, failure))?;
    let (least, largest) = folded.block.friction_range();
    let [from, to] = folded.fold.axial_load;
    let [torque] = &folded.certificate.figures;
    result(
        py,
        "FoldedDesign",
        (
            PyBytes::new(py, &bytes),
            format!("{:016x}", folded.digest),
            (least, largest),
            (from, to),
            torque.largest,
            torque.rms,
            torque.mean,
            torque.states,
            torque.flagged,
        ),
    )
}
