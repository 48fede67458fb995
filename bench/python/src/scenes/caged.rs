//! A ball screw whose balls do not touch.

use std::sync::Arc;

use epas_cli::bindings::{self, Design as Inner, Failure, Model, TickInputs};
use epas_design::caged_scene::{self as caged, CagedScene, fold_for};
use epas_friction::FrictionBranch;
use pyo3::prelude::*;
use pyo3::types::PyBytes;

use super::columns::{Columns, ScrewColumns};
use crate::design::Design;
use crate::errors::{Refused, refused};
use crate::interrupt::interruptible;
use crate::numbers::{arguments, range_or, single, single_or, within};
use crate::restored::{self, Reduced, reduced};
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
#[derive(Clone)]
pub struct CagedBallScrew {
    model: Box<dyn Model>,
    origin: Origin,
    /// The friction coefficient that was set last.
    friction: Option<f32>,
}

/// What a screw is made again from.
#[derive(Clone)]
enum Origin {
    /// The words of its block.
    Block(Arc<[u32]>),
    /// The text of the design of a closed form.
    ClosedForm(Arc<str>),
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
        friction: Option<f64>,
        friction_range: Option<(f64, f64)>,
        branch: Option<&str>,
        loaded_balls: Option<u16>,
        reversal_speed: Option<f64>,
    ) -> PyResult<Self> {
        let mut design: Inner = (*design.inner).clone();
        let caged = &mut design.caged;
        caged.friction = single_or(py, "friction", friction, caged.friction)?;
        caged.loaded_balls = loaded_balls.unwrap_or(caged.loaded_balls);
        let usual = caged.reversal_speed;
        caged.reversal_speed = single_or(py, "reversal_speed", reversal_speed, usual)?;
        let own = caged.friction;
        if let Some(name) = branch {
            design.branch = branch_of(py, name)?;
        }
        design.check().map_err(|error| refused(py, error))?;
        let (least, largest) = range_or(py, "friction_range", friction_range, own)?;
        within("friction", own.into(), least.into(), largest.into())
            .map_err(|error| refused(py, error))?;
        if let Some(closed) = design.closed_form() {
            let origin = Origin::ClosedForm(bindings::text::text(&design).into());
            return Self::of(py, &CagedScene::ClosedForm(closed), origin);
        }
        let words = interruptible(py, move |_| {
            let words = caged::words(&design, (least, largest));
            words.map_err(|failure| failure.of(&design.name))
        })?;
        let words = words.map_err(|failure| refused(py, failure))?;
        Self::of_words(py, words.unwrap_or_default())
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
        Self::of_words(py, words(py, block)?)
    }

    /// Goes on with another block, as firmware swaps constants: worn, warm, or of another clearance. It has as many friction
    /// coefficients as the present one, and its own one is set.
    ///
    /// Raises:
    ///     Error: bytes that are no such block; the model stays as it was.
    fn swap_block(&mut self, py: Python<'_>, block: &[u8]) -> PyResult<()> {
        let words = words(py, block)?;
        let done = self.model.swap(&words);
        done.map_err(|error| refused(py, error))?;
        self.origin = Origin::Block(words.into());
        self.friction = None;
        Ok(())
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
        let inputs = TickInputs::new(nut_speed, axial_load);
        ScrewColumns::tick(py, &self.model.step(&inputs))
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
        let mut model = self.model.copied();
        let columns = ScrewColumns::of(py, &trace, |[nut_speed, axial_load]| {
            model.step(&TickInputs::new(nut_speed, axial_load))
        })?;
        self.model = model;
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
    fn set_friction(&mut self, py: Python<'_>, friction: f64) -> PyResult<()> {
        let friction = single(py, "friction", friction)?;
        let done = self.model.set_friction(friction);
        done.map_err(|error| refused(py, error))?;
        self.friction = Some(friction);
        Ok(())
    }

    /// Consecutive ticks with a fault; 0 after a sound tick.
    #[getter]
    fn faulted_ticks(&self) -> u32 {
        self.model.faulted_ticks()
    }

    fn __repr__(&self) -> String {
        let of = match &self.origin {
            Origin::Block(words) => format!("block of {} words", words.len()),
            Origin::ClosedForm(_) => "closed form".into(),
        };
        format!("<CagedBallScrew: {of}>")
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
        let (block, text) = match &self.origin {
            Origin::Block(words) => (Some(restored::bytes(py, words)), None),
            Origin::ClosedForm(text) => (None, Some(text.to_string())),
        };
        reduced(py, "caged", (block, text, self.friction, state))
    }

    /// The same model in the same state.
    fn copy(&self) -> Self {
        self.clone()
    }
}

impl CagedBallScrew {
    fn of(py: Python<'_>, scene: &CagedScene, origin: Origin) -> PyResult<Self> {
        let model = bindings::caged(scene).map_err(|error| refused(py, error))?;
        Ok(Self {
            model,
            origin,
            friction: None,
        })
    }

    fn of_words(py: Python<'_>, words: Vec<u32>) -> PyResult<Self> {
        let scene = CagedScene::read(&words).map_err(|error| refused(py, error))?;
        Self::of(py, &scene, Origin::Block(words.into()))
    }
}

/// A screw as pickle has it: its block or the text of its design, the friction coefficient that was set, its state.
#[pyfunction]
#[pyo3(name = "_restored_caged")]
pub fn restored_caged(
    py: Python<'_>,
    block: Option<&[u8]>,
    text: Option<&str>,
    friction: Option<f32>,
    state: &[u8],
) -> PyResult<CagedBallScrew> {
    let mut screw = if let Some(block) = block {
        CagedBallScrew::from_block(py, block)?
    } else {
        let text = text.unwrap_or_default();
        let design = bindings::read_design(text, "design");
        let design = design.map_err(|error| refused(py, error))?;
        let closed = design.closed_form();
        let closed = closed.ok_or_else(|| refused(py, Refused::message("no closed form")))?;
        let origin = Origin::ClosedForm(text.into());
        CagedBallScrew::of(py, &CagedScene::ClosedForm(closed), origin)?
    };
    if let Some(friction) = friction {
        screw.set_friction(py, friction.into())?;
    }
    let done = screw.model.import(state);
    done.map_err(|error| refused(py, error.to_string()))?;
    Ok(screw)
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
///     Error: what cannot be folded, or a domain over which the torque is not accurate to 3 %, with the place.
#[pyfunction]
#[pyo3(signature = (design, *, friction_range=None, axial_load=None, seed=None))]
pub fn fold_design<'py>(
    py: Python<'py>,
    design: &Design,
    friction_range: Option<(f64, f64)>,
    axial_load: Option<(f64, f64)>,
    seed: Option<u64>,
) -> PyResult<Bound<'py, PyAny>> {
    let friction = design.inner.caged.friction;
    let coefficients = range_or(py, "friction_range", friction_range, friction)?;
    let fold = fold_for(&design.inner, coefficients);
    let mut fold = fold.map_err(|message| refused(py, message))?;
    if axial_load.is_some() {
        let (least, largest) = range_or(py, "axial_load", axial_load, 0.0)?;
        fold.axial_load = [least, largest];
    }
    fold.seed = seed.unwrap_or(fold.seed);
    let made = interruptible(py, move |stop| {
        let folded = fold.folded_with(&|_| stop.check())?;
        let bytes = folded.bytes()?;
        Ok::<_, Failure>((folded, bytes))
    })?;
    let (folded, bytes) = made.map_err(|failure| refused(py, failure))?;
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
