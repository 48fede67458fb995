//! Rows of balls that press on each other: a ball screw without cage, a linear bearing.

use epas_bench::bindings::{Balls, Built, Linear, MOST_BALLS, ScrewConfiguration, Uncaged};
use epas_bench::uncaged::{configuration, configuration_with, read};
use epas_friction::{Inputs, LinearInputs, LinearOutputs, UncagedOutputs};
use pyo3::prelude::*;

use super::caged::words;
use super::columns::{Columns, LinearColumns, UncagedColumns};
use crate::design::{Design, LinearDesign};
use crate::errors::{Refused, refused};
use crate::numbers::arguments;

/// A model as it was built.
fn model<I, O>(py: Python<'_>, built: Built<I, O>) -> PyResult<Box<dyn Balls<I, O>>> {
    match built {
        Ok(Some(model)) => Ok(model),
        Ok(None) => {
            let message = format!("balls is out of range; allowed: 1 to {MOST_BALLS}");
            Err(refused(py, Refused::value("balls", message)))
        }
        Err(error) => Err(refused(py, error)),
    }
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
    model: Box<dyn Balls<Inputs, UncagedOutputs>>,
    balls: u8,
    tick: f32,
}

/// Inputs of a tick.
const fn screw_inputs([nut_speed, axial_load]: [f64; 2]) -> Inputs {
    Inputs {
        nut_speed: nut_speed as f32,
        axial_load: axial_load as f32,
    }
}

#[pymethods]
impl UncagedBallScrew {
    #[new]
    #[pyo3(signature = (design, *, tick=2e-4, friction=None, friction_range=None, ball_friction=None, memory_load=None))]
    fn new(
        py: Python<'_>,
        design: &Design,
        tick: f32,
        friction: Option<f32>,
        friction_range: Option<(f32, f32)>,
        ball_friction: Option<f32>,
        memory_load: Option<f32>,
    ) -> PyResult<Self> {
        let mut scene = scene(py, design, memory_load)?;
        let gear = &mut scene.balls.gear;
        gear.friction = friction.unwrap_or(gear.friction);
        gear.checked().map_err(|error| refused(py, error))?;
        let own = gear.friction;
        let (least, largest) = friction_range.unwrap_or((own, own));
        if !(least <= own && own <= largest) {
            let error = Refused::range("friction", own.into(), least.into(), largest.into());
            return Err(refused(py, error));
        }
        let own = scene.balls.ball_friction;
        scene.balls.ball_friction = ball_friction.unwrap_or(own);
        let made = py.detach(|| configuration(&scene.design, &scene.balls, (least, largest), 0.0));
        let made = made.map_err(|failure| refused(py, failure))?;
        Self::of(py, &scene, &made, tick, memory_load)
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
        tick: f32,
        ball_friction: Option<f32>,
    ) -> PyResult<Self> {
        let mut scene = scene(py, design, None)?;
        let own = scene.balls.ball_friction;
        scene.balls.ball_friction = ball_friction.unwrap_or(own);
        let folded = read(&words(py, block)?).map_err(|error| refused(py, error))?;
        let made = configuration_with(&scene.balls, folded);
        Self::of(py, &scene, &made, tick, None)
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
        UncagedColumns::tick(py, &self.model.step(inputs))
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
        let mut columns = UncagedColumns::with_capacity(trace.len());
        let model = &mut self.model;
        trace.each(py, |values| {
            columns.push(&model.step(screw_inputs(values)));
            Ok(())
        })?;
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
    fn set_friction(&mut self, py: Python<'_>, friction: f32) -> PyResult<()> {
        let done = self.model.set_friction(friction);
        done.map_err(|error| refused(py, error))
    }

    /// Sets the angle of the nut against the screw, rad, from which the grooves' deviations are counted.
    fn set_nut_angle(&mut self, angle: f32) {
        self.model.set_place(angle);
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
        self.tick
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
            balls: self.balls,
            tick: self.tick,
        }
    }
}

impl UncagedBallScrew {
    fn of(
        py: Python<'_>,
        scene: &Uncaged,
        configuration: &ScrewConfiguration,
        tick: f32,
        memory_load: Option<f32>,
    ) -> PyResult<Self> {
        let remembered = memory_load
            .map(|load| scene.remembered_at(load))
            .transpose()
            .map_err(|error| refused(py, error))?;
        Ok(Self {
            model: model(py, scene.model(configuration, tick, remembered.as_ref()))?,
            balls: scene.balls.balls,
            tick,
        })
    }
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
        memory: memory_load.is_some(),
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
    model: Box<dyn Balls<LinearInputs, LinearOutputs>>,
    balls: u8,
    tick: f32,
}

/// Inputs of a tick.
const fn linear_inputs([speed, normal_load, side_load]: [f64; 3]) -> LinearInputs {
    LinearInputs {
        speed: speed as f32,
        normal_load: normal_load as f32,
        side_load: side_load as f32,
    }
}

#[pymethods]
impl LinearBearingTrain {
    #[new]
    #[pyo3(signature = (design, *, tick=2e-4, friction=None, ball_friction=None, memory_load=None))]
    fn new(
        py: Python<'_>,
        design: &LinearDesign,
        tick: f32,
        friction: Option<f32>,
        ball_friction: Option<f32>,
        memory_load: Option<f32>,
    ) -> PyResult<Self> {
        let mut linear = (*design.inner).clone();
        let configuration = &mut linear.configuration;
        configuration.friction = friction.unwrap_or(configuration.friction);
        configuration.ball_friction = ball_friction.unwrap_or(configuration.ball_friction);
        let balls = linear.balls;
        let scene = Linear {
            design: linear,
            memory: memory_load.is_some(),
        };
        let remembered = memory_load
            .map(|load| scene.remembered_at(load))
            .transpose()
            .map_err(|error| refused(py, error))?;
        Ok(Self {
            model: model(py, scene.model(tick, remembered.as_ref()))?,
            balls,
            tick,
        })
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
        LinearColumns::tick(py, &self.model.step(inputs))
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
        let mut columns = LinearColumns::with_capacity(trace.len());
        let model = &mut self.model;
        trace.each(py, |values| {
            columns.push(&model.step(linear_inputs(values)));
            Ok(())
        })?;
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
    fn set_friction(&mut self, py: Python<'_>, friction: f32) -> PyResult<()> {
        let done = self.model.set_friction(friction);
        done.map_err(|error| refused(py, error))
    }

    /// Sets the carriage's place along the rail, m, from which the rail's deviations are counted.
    ///
    /// Raises:
    ///     Error: with memory, where the place is that of the first tick.
    fn set_carriage_position(&mut self, py: Python<'_>, position: f32) -> PyResult<()> {
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
        self.tick
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
            balls: self.balls,
            tick: self.tick,
        }
    }
}
