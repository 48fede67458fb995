//! Rows of balls that press on each other: a ball screw without cage, a linear bearing.

use std::sync::Arc;

use epas_cli::bindings::{
    self, Built, Failure, Folded, Linear, MemorySettings, Model, ScrewConfiguration, TickInputs,
    Uncaged, UncagedDesign,
};
use epas_design::uncaged::UncagedBlock;
use epas_design::uncaged_scene::{configuration_with, fold_for, folded, read};
use epas_friction::Error;
use pyo3::prelude::*;

use super::caged::words;
use super::columns::{Columns, LinearColumns, UncagedColumns};
use crate::design::{Design, LinearDesign, restored_design, restored_linear_design};
use crate::errors::{Refused, refused};
use crate::interrupt::interruptible;
use crate::numbers::{arguments, range_or, single, within};
use crate::restored::{self, Recipe, Reduced, reduced};

/// A model as it was built; `limit` is the field of the design that decides the longest tick, with its value.
fn model(py: Python<'_>, built: Built, limit: (&str, f32)) -> PyResult<Box<dyn Model>> {
    built.map_err(|error| {
        let (limit, value) = limit;
        refused(py, Refused::from(error).tick_of(limit, value))
    })
}

/// What a row of balls is made from, beside its design's own numbers.
#[derive(Clone)]
struct Made {
    recipe: Recipe,
    tick: f32,
    friction: Option<f32>,
    ball_friction: Option<f32>,
    memory_load: Option<f32>,
    /// The coefficient that was set last.
    set_friction: Option<f32>,
}

/// The same as arguments of Python.
type MadeArguments = (
    (String, Option<String>),
    f32,
    Option<f32>,
    Option<f32>,
    Option<f32>,
    Option<f32>,
);

impl Made {
    /// From arguments of Python, whose design has become a recipe.
    fn restored(recipe: Recipe, arguments: MadeArguments) -> Self {
        let (_, tick, friction, ball_friction, memory_load, set_friction) = arguments;
        Self {
            recipe,
            tick,
            friction,
            ball_friction,
            memory_load,
            set_friction,
        }
    }

    fn shown(&self, class: &str, balls: u8) -> String {
        let (design, _) = self.recipe.arguments();
        format!("<{class}: {design}, balls={balls}, tick={}>", self.tick)
    }

    fn arguments(&self) -> MadeArguments {
        (
            self.recipe.arguments(),
            self.tick,
            self.friction,
            self.ball_friction,
            self.memory_load,
            self.set_friction,
        )
    }
}

/// Puts a model back into a state, after the coefficient that was set.
fn resumed(
    py: Python<'_>,
    model: &mut dyn Model,
    friction: Option<f32>,
    state: &[u8],
) -> PyResult<()> {
    let friction = friction.map(|friction| model.set_friction(friction));
    let done: Result<(), Error> = friction.unwrap_or(Ok(()));
    done.map_err(|error| refused(py, error))?;
    let done = model.import(state);
    done.map_err(|error| refused(py, error.to_string()))
}

/// A ball screw without cage: friction of the grooves, and between balls that press on each other.
///
/// Its ball is solved when the screw is made, in some seconds, and in three times as many for a range of friction coefficients: what runs is the
/// law that firmware evaluates, for 5 to 300 N a ball, or the loads of the table [fold] of a design file. Other threads run meanwhile, and a
/// design that was solved before is there at once.
///
/// Args:
///     design: with what it says of its circuit of balls; "lin-3.6" of the built-in designs has 37.
///     tick: time between two steps, s; balls may not travel too far in one.
///     friction: coefficient of ball and groove; the design's where it is left out.
///     friction_range: least and largest coefficient that :meth:`set_friction` may set; the coefficient alone where it is left out.
///     ball_friction: coefficient of two balls; the design's where it is left out.
///     memory_load: axial load, N, at which elements that stick and slip are designed; without it friction has no memory, and
///         passes through a reversal with the speed.
///
/// Raises:
///     Error: a value out of its range, a design that says nothing of its circuit, or one whose ball cannot be folded.
#[pyclass(module = "epas_friction")]
pub struct UncagedBallScrew {
    model: Box<dyn Model>,
    balls: u8,
    made: Made,
    /// The words of its ball's block.
    words: Arc<[u32]>,
}

/// Inputs of a tick.
const fn screw_inputs([nut_speed, axial_load]: [f64; 2]) -> TickInputs {
    TickInputs::new(nut_speed as f32, axial_load as f32)
}

#[pymethods]
impl UncagedBallScrew {
    #[new]
    #[pyo3(signature = (design, *, tick=2e-4, friction=None, friction_range=None, ball_friction=None, memory_load=None))]
    fn new(
        py: Python<'_>,
        design: &Design,
        tick: f64,
        friction: Option<f64>,
        friction_range: Option<(f64, f64)>,
        ball_friction: Option<f64>,
        memory_load: Option<f64>,
    ) -> PyResult<Self> {
        let made = made(
            py,
            &design.recipe,
            tick,
            [friction, ball_friction, memory_load],
        )?;
        let mut scene = scene(py, design, made.memory_load)?;
        let gear = &mut scene.balls.gear;
        gear.friction = made.friction.unwrap_or(gear.friction);
        gear.checked().map_err(|error| refused(py, error))?;
        let own = gear.friction;
        let (least, largest) = range_or(py, "friction_range", friction_range, own)?;
        within("friction", own.into(), least.into(), largest.into())
            .map_err(|error| refused(py, error))?;
        let (design, balls) = (scene.design.clone(), scene.balls);
        let words = interruptible(py, move |_| words_of(&design, &balls, (least, largest)))?;
        let words = words.map_err(|failure| refused(py, failure))?;
        Self::of(py, scene, made, words)
    }

    /// A screw by a block of its ball that was folded before, of the command ``design``.
    ///
    /// Args:
    ///     design: with what it says of its circuit of balls; how its balls rub in the grooves stands in the block.
    ///     block: its bytes, of each word the least significant first.
    ///     tick: time between two steps, s.
    ///     ball_friction: coefficient of two balls; the design's where it is left out.
    ///
    /// Raises:
    ///     Error: bytes that are no block, a block of another version, a damaged one, or one of a design whose deviations it does not hold.
    #[staticmethod]
    #[pyo3(signature = (design, block, *, tick=2e-4, ball_friction=None))]
    fn from_block(
        py: Python<'_>,
        design: &Design,
        block: &[u8],
        tick: f64,
        ball_friction: Option<f64>,
    ) -> PyResult<Self> {
        let made = made(py, &design.recipe, tick, [None, ball_friction, None])?;
        let scene = scene(py, design, None)?;
        Self::of(py, scene, made, words(py, block)?)
    }

    /// One tick, as in the control interrupt: never an exception, faults are flagged.
    ///
    /// Args:
    ///     nut_speed: rad/s.
    ///     axial_load: N; positive where it opposes the travel that a positive nut speed makes.
    ///
    /// Returns:
    ///     UncagedOutputs: torques in N m, number of contacts, largest force between balls in N, regime, faults.
    fn step<'py>(
        &mut self,
        py: Python<'py>,
        nut_speed: f64,
        axial_load: f64,
    ) -> PyResult<Bound<'py, PyAny>> {
        let inputs = screw_inputs([nut_speed, axial_load]);
        UncagedColumns::tick(py, &self.model.step(&inputs))
    }

    /// A whole trace, tick after tick, from the present state on. Other threads run meanwhile.
    ///
    /// Arrays of float32 are read where they lie.
    ///
    /// Args:
    ///     nut_speed: rad/s, shape (n,) or a number, a value for each tick.
    ///     axial_load: N, shape (n,) or a number.
    ///     allow_faults: whether NaN and infinity are let in, and flagged as in the control interrupt.
    ///
    /// Returns:
    ///     UncagedRun: arrays of shape (n,).
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
        let columns = UncagedColumns::of(py, &trace, |values| model.step(&screw_inputs(values)))?;
        self.model = model;
        columns.run(py)
    }

    /// Back to the state before the first tick.
    fn reset(&mut self) {
        self.model.reset();
    }

    /// Sets the friction coefficient of ball and groove, within the block's range, from the next tick on.
    ///
    /// Raises:
    ///     Error: a value out of its range; the model stays as it was.
    fn set_friction(&mut self, py: Python<'_>, friction: f64) -> PyResult<()> {
        let friction = single(py, "friction", friction)?;
        let done = self.model.set_friction(friction);
        done.map_err(|error| refused(py, error))?;
        self.made.set_friction = Some(friction);
        Ok(())
    }

    /// Sets the angle of the nut against the screw, rad, from which the grooves' deviations are counted.
    ///
    /// Raises:
    ///     Error: an angle that is NaN or out of range.
    fn set_nut_angle(&mut self, py: Python<'_>, angle: f64) -> PyResult<()> {
        let angle = place(py, "angle", angle)?;
        self.model.set_place(angle);
        Ok(())
    }

    /// Balls that press on the one in front, by their numbers.
    ///
    /// Returns:
    ///     list[int]: numbers from 0.
    fn pressing(&self) -> Vec<u8> {
        bits(self.model.pressing())
    }

    /// Number of balls in the circuit.
    #[getter]
    fn balls(&self) -> u8 {
        self.balls
    }

    /// Time between two steps, s.
    #[getter]
    fn tick(&self) -> f32 {
        self.made.tick
    }

    /// Consecutive ticks with a fault; 0 after a sound tick.
    #[getter]
    fn faulted_ticks(&self) -> u32 {
        self.model.faulted_ticks()
    }

    fn __repr__(&self) -> String {
        self.made.shown("UncagedBallScrew", self.balls)
    }

    fn __copy__(&self) -> Self {
        self.copy()
    }

    fn __deepcopy__(&self, _memo: &Bound<'_, PyAny>) -> Self {
        self.copy()
    }

    /// Faulted ticks are counted anew.
    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        let block = restored::bytes(py, &self.words);
        let state = restored::state(py, self.model.export())?;
        reduced(py, "uncaged", (self.made.arguments(), block, state))
    }

    /// The same model in the same state.
    fn copy(&self) -> Self {
        Self {
            model: self.model.copied(),
            balls: self.balls,
            made: self.made.clone(),
            words: self.words.clone(),
        }
    }
}

impl UncagedBallScrew {
    fn of(py: Python<'_>, mut scene: Uncaged, made: Made, words: Vec<u32>) -> PyResult<Self> {
        let balls = &mut scene.balls;
        balls.gear.friction = made.friction.unwrap_or(balls.gear.friction);
        balls.ball_friction = made.ball_friction.unwrap_or(balls.ball_friction);
        let folded = read(&words).map_err(|error| refused(py, error))?;
        let configuration: ScrewConfiguration = configuration_with(&scene.balls, folded);
        let remembered = made
            .memory_load
            .map(|load| scene.remembered_at(load))
            .transpose()
            .map_err(|error| refused(py, error))?;
        let built = scene.model(&configuration, made.tick, remembered.as_ref());
        let limit = ("limits.nut_speed", scene.balls.gear.limits.nut_speed);
        Ok(Self {
            model: model(py, built, limit)?,
            balls: scene.balls.balls,
            made,
            words: words.into(),
        })
    }
}

/// A screw as pickle has it: what it was made from, its ball's block, its state.
#[pyfunction]
#[pyo3(name = "_restored_uncaged")]
pub fn restored_uncaged(
    py: Python<'_>,
    made: MadeArguments,
    block: &[u8],
    state: &[u8],
) -> PyResult<UncagedBallScrew> {
    let (name, text) = made.0.clone();
    let design = restored_design(py, name, text)?;
    let made = Made::restored(design.recipe.clone(), made);
    let scene = scene(py, &design, made.memory_load)?;
    let set_friction = made.set_friction;
    let mut screw = UncagedBallScrew::of(py, scene, made, words(py, block)?)?;
    resumed(py, &mut *screw.model, set_friction, state)?;
    Ok(screw)
}

/// Numbers of a row of balls in single precision: friction, friction between balls, load of the memory.
fn made(
    py: Python<'_>,
    recipe: &Recipe,
    tick: f64,
    [friction, ball_friction, memory_load]: [Option<f64>; 3],
) -> PyResult<Made> {
    let given =
        |field: &str, value: Option<f64>| value.map(|value| single(py, field, value)).transpose();
    Ok(Made {
        recipe: recipe.clone(),
        tick: single(py, "tick", tick)?,
        friction: given("friction", friction)?,
        ball_friction: given("ball_friction", ball_friction)?,
        memory_load: given("memory_load", memory_load)?,
        set_friction: None,
    })
}

/// A place in single precision; what is below it is 0.
fn place(py: Python<'_>, field: &str, value: f64) -> PyResult<f32> {
    if !value.is_finite() {
        return Err(refused(py, Refused::no_number(field, value)));
    }
    if value.abs() < f64::from(f32::MIN_POSITIVE) {
        return Ok(0.0);
    }
    single(py, field, value)
}

/// The words of the block of a design's ball, for friction coefficients between two.
fn words_of(
    design: &bindings::Design,
    row: &UncagedDesign,
    coefficients: (f32, f32),
) -> Result<Vec<u32>, Failure> {
    let fold = fold_for(design, row, coefficients, 0.0).map_err(Failure::Data);
    let words = fold.and_then(|fold| {
        let block = match folded(&fold)? {
            Folded::One(block) => UncagedBlock::One(*block),
            Folded::Range(block) => UncagedBlock::Range(*block),
        };
        Ok(block.words(fold.digest())?)
    });
    words.map_err(|failure| failure.of(&design.name))
}

/// The scene of a design.
fn scene(py: Python<'_>, design: &Design, memory_load: Option<f32>) -> PyResult<Uncaged> {
    let Some(balls) = design.inner.uncaged else {
        let message = format!("{} says nothing of its circuit of balls", design.inner.name);
        return Err(refused(py, Refused::value("uncaged", message)));
    };
    Ok(Uncaged {
        design: (*design.inner).clone(),
        balls,
        memory: memory_load.map(|_| MemorySettings::default()),
    })
}

/// Places of the bits that are set.
fn bits(set: u64) -> Vec<u8> {
    (0..64).filter(|place| set >> place & 1 == 1).collect()
}

/// A linear bearing in four-point contact, whose balls press on each other.
///
/// Args:
///     design: with its circuit of balls.
///     tick: time between two steps, s; balls may not travel too far in one.
///     friction: coefficient of ball and groove; the design's where it is left out.
///     ball_friction: coefficient of two balls; the design's where it is left out.
///     memory_load: normal load, N, at which elements that stick and slip are designed; without it friction has no memory, and
///         passes through a reversal with the speed.
///
/// Raises:
///     Error: a value out of its range.
#[pyclass(module = "epas_friction")]
pub struct LinearBearingTrain {
    model: Box<dyn Model>,
    balls: u8,
    made: Made,
}

/// Inputs of a tick.
const fn linear_inputs([speed, normal_load, side_load]: [f64; 3]) -> TickInputs {
    TickInputs {
        side_load: side_load as f32,
        ..TickInputs::new(speed as f32, normal_load as f32)
    }
}

#[pymethods]
impl LinearBearingTrain {
    #[new]
    #[pyo3(signature = (design, *, tick=2e-4, friction=None, ball_friction=None, memory_load=None))]
    fn new(
        py: Python<'_>,
        design: &LinearDesign,
        tick: f64,
        friction: Option<f64>,
        ball_friction: Option<f64>,
        memory_load: Option<f64>,
    ) -> PyResult<Self> {
        let made = made(
            py,
            &design.recipe,
            tick,
            [friction, ball_friction, memory_load],
        )?;
        Self::of(py, design, made)
    }

    /// One tick, as in the control interrupt: never an exception, faults are flagged.
    ///
    /// Args:
    ///     speed: of the carriage, m/s.
    ///     normal_load: presses the carriage on the rail, N.
    ///     side_load: across the rail, N.
    ///
    /// Returns:
    ///     LinearOutputs: forces in N, number of contacts, regime, faults.
    #[pyo3(signature = (speed, normal_load, side_load=0.0))]
    fn step<'py>(
        &mut self,
        py: Python<'py>,
        speed: f64,
        normal_load: f64,
        side_load: f64,
    ) -> PyResult<Bound<'py, PyAny>> {
        let inputs = linear_inputs([speed, normal_load, side_load]);
        LinearColumns::tick(py, &self.model.step(&inputs))
    }

    /// A whole trace, tick after tick, from the present state on. Other threads run meanwhile.
    ///
    /// Arrays of float32 are read where they lie.
    ///
    /// Args:
    ///     speed: of the carriage, m/s, shape (n,) or a number, a value for each tick.
    ///     normal_load: presses the carriage on the rail, N, shape (n,) or a number.
    ///     side_load: across the rail, N, shape (n,) or a number.
    ///     allow_faults: whether NaN and infinity are let in, and flagged as in the control interrupt.
    ///
    /// Returns:
    ///     LinearRun: arrays of shape (n,).
    ///
    /// Raises:
    ///     Error: a sample that is NaN or infinite, arrays that do not fit; the model stays as it was.
    #[pyo3(signature = (speed, normal_load, side_load=None, *, allow_faults=false))]
    fn run<'py>(
        &mut self,
        py: Python<'py>,
        speed: Bound<'py, PyAny>,
        normal_load: Bound<'py, PyAny>,
        side_load: Option<Bound<'py, PyAny>>,
        allow_faults: bool,
    ) -> PyResult<Bound<'py, PyAny>> {
        let names = ["speed", "normal_load", "side_load"];
        let side_load = side_load.unwrap_or_else(|| crate::numbers::zero(py));
        let trace =
            arguments(py, names, [&speed, &normal_load, &side_load])?.trace(py, allow_faults)?;
        let mut model = self.model.copied();
        let columns = LinearColumns::of(py, &trace, |values| model.step(&linear_inputs(values)))?;
        self.model = model;
        columns.run(py)
    }

    /// Back to the state before the first tick.
    fn reset(&mut self) {
        self.model.reset();
    }

    /// Sets the friction coefficient of ball and groove, 1e-6 to 1, from the next tick on.
    ///
    /// Raises:
    ///     Error: a value out of its range; the model stays as it was.
    fn set_friction(&mut self, py: Python<'_>, friction: f64) -> PyResult<()> {
        let friction = single(py, "friction", friction)?;
        let done = self.model.set_friction(friction);
        done.map_err(|error| refused(py, error))?;
        self.made.set_friction = Some(friction);
        Ok(())
    }

    /// Sets the carriage's place along the rail, m, from which the rail's deviations are counted.
    ///
    /// Raises:
    ///     Error: with memory, where the place is that of the first tick.
    fn set_carriage_position(&mut self, py: Python<'_>, position: f64) -> PyResult<()> {
        let position = place(py, "position", position)?;
        if self.model.set_place(position) {
            return Ok(());
        }
        let message = "a bearing with memory counts the rail's deviations from its first tick";
        Err(refused(py, Refused::value("position", message)))
    }

    /// Balls that press on the one in front, by their numbers.
    ///
    /// Returns:
    ///     list[int]: numbers from 0.
    fn pressing(&self) -> Vec<u8> {
        bits(self.model.pressing())
    }

    /// Number of balls in the circuit.
    #[getter]
    fn balls(&self) -> u8 {
        self.balls
    }

    /// Time between two steps, s.
    #[getter]
    fn tick(&self) -> f32 {
        self.made.tick
    }

    /// Consecutive ticks with a fault; 0 after a sound tick.
    #[getter]
    fn faulted_ticks(&self) -> u32 {
        self.model.faulted_ticks()
    }

    fn __repr__(&self) -> String {
        self.made.shown("LinearBearingTrain", self.balls)
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
        reduced(py, "bearing", (self.made.arguments(), state))
    }

    /// The same model in the same state.
    fn copy(&self) -> Self {
        Self {
            model: self.model.copied(),
            balls: self.balls,
            made: self.made.clone(),
        }
    }
}

impl LinearBearingTrain {
    fn of(py: Python<'_>, design: &LinearDesign, made: Made) -> PyResult<Self> {
        let mut linear = (*design.inner).clone();
        let configuration = &mut linear.configuration;
        configuration.friction = made.friction.unwrap_or(configuration.friction);
        configuration.ball_friction = made.ball_friction.unwrap_or(configuration.ball_friction);
        let (balls, limits) = (linear.balls, configuration.limits);
        let scene = Linear {
            design: linear,
            memory: made.memory_load.map(|_| MemorySettings::default()),
        };
        let remembered = made
            .memory_load
            .map(|load| scene.remembered_at(load))
            .transpose()
            .map_err(|error| refused(py, error))?;
        let built = scene.model(made.tick, remembered.as_ref());
        Ok(Self {
            model: model(py, built, ("limits.speed", limits.speed))?,
            balls,
            made,
        })
    }
}

/// A bearing as pickle has it: what it was made from, its state.
#[pyfunction]
#[pyo3(name = "_restored_bearing")]
pub fn restored_bearing(
    py: Python<'_>,
    made: MadeArguments,
    state: &[u8],
) -> PyResult<LinearBearingTrain> {
    let (name, text) = made.0.clone();
    let design = restored_linear_design(py, name, text)?;
    let made = Made::restored(design.recipe.clone(), made);
    let set_friction = made.set_friction;
    let mut bearing = LinearBearingTrain::of(py, &design, made)?;
    resumed(py, &mut *bearing.model, set_friction, state)?;
    Ok(bearing)
}
