//! The model that runs in the interrupt: constants folded at set-up, a small state, one `step`.

mod memory;
mod stored;

use core::borrow::Borrow;

use crate::error::Error;
use crate::scene::{
    ChangingFriction, LinearBearingTrain, LinearConstants, Scene, SceneOutputs as _,
    UncagedBallScrew, UncagedConstants,
};

/// Friction of one scene: configured once, stepped in the interrupt.
///
/// ```
/// use epas_friction::scene::{CagedBallScrew, CagedBallScrewConfiguration, CagedConstants, built_in};
/// use epas_friction::{FrictionModel, Inputs, Regime};
///
/// // `epas design` writes such a `static` for a screw of one's own.
/// static GEAR: CagedConstants = match CagedConstants::new(&CagedBallScrewConfiguration {
///     loaded_balls: 60,
///     ..built_in("25x5x3.175").unwrap().nearest(0.1)
/// }) {
///     Ok(constants) => constants,
///     Err(_) => panic!("a field is out of range"),
/// };
///
/// let mut model = FrictionModel::<CagedBallScrew, _>::of(&GEAR);
///
/// // in the interrupt
/// let outputs = model.step(Inputs { nut_speed: 40.0, axial_load: 3_000.0 });
/// assert_eq!(outputs.regime, Regime::Driving);
/// assert!(outputs.friction_torque > 0.0 && outputs.efficiency > 0.8);
/// assert_eq!(model.faulted_ticks(), 0);
/// ```
///
/// [`FrictionModel::new`] sets up at run time; as here, the compiler does: the constants stay in flash, the model keeps a reference to them,
/// and nothing that checks them is linked. A field out of range does not compile:
/// ```compile_fail,E0080
/// # use epas_friction::scene::{CagedBallScrewConfiguration, CagedConstants, built_in};
/// static GEAR: CagedConstants = match CagedConstants::new(&CagedBallScrewConfiguration {
///     friction: 7.5,
///     ..built_in("25x5x3.175").unwrap().nearest(0.1)
/// }) {
///     Ok(constants) => constants,
///     Err(_) => panic!("a field is out of range"),
/// };
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrictionModel<S: Scene, C = <S as Scene>::Constants> {
    constants: C,
    state: S::State,
    faulted_ticks: u32,
}

impl<S: Scene> FrictionModel<S> {
    /// Checks the configuration and folds the constants. Set-up only.
    pub fn new(configuration: &S::Configuration) -> Result<Self, Error> {
        S::constants(configuration).map(Self::of)
    }
}

impl<S: Scene, C: Borrow<S::Constants>> FrictionModel<S, C> {
    /// A model of folded constants, or of a reference to them. Set-up only.
    #[inline]
    pub fn of(constants: C) -> Self {
        let state = S::initial_state(constants.borrow());
        Self {
            constants,
            state,
            faulted_ticks: 0,
        }
    }

    /// One step: bounded time, no panic, finite outputs whatever the inputs are ([`Scene::step`]).
    ///
    /// Where an input is NaN or infinite, the output is the safe one and the state stays as it is; [`WithMemory`](crate::scene::WithMemory)
    /// goes on with the last sound inputs of its scene, and its memory follows every sound reading of the angle.
    #[inline]
    pub fn step(&mut self, inputs: S::Inputs) -> S::Outputs {
        let outputs = S::step(self.constants.borrow(), &mut self.state, inputs);
        self.faulted_ticks = if outputs.faults().faulty() {
            self.faulted_ticks.saturating_add(1)
        } else {
            0
        };
        outputs
    }

    /// Back to the state before the first tick.
    pub fn reset(&mut self) {
        self.state = S::initial_state(self.constants.borrow());
        self.faulted_ticks = 0;
    }

    /// Replaces the constants, as a controller does that switches its calibration page or the clearance of a caged screw, and returns the old
    /// ones. Not in the middle of a step. Balls and memory stay; the circuit of balls has to be the same. The friction coefficient is that of the
    /// new block; where deviation maps have another period, set the angle (or the carriage's position) anew.
    pub fn swap_constants(&mut self, constants: C) -> Result<C, Error> {
        S::take_over(constants.borrow(), &mut self.state)?;
        Ok(core::mem::replace(&mut self.constants, constants))
    }

    /// Consecutive calls of [`Self::step`] with a fault ([`Faults::faulty`](crate::Faults::faulty)), up to `u32::MAX`; 0 after
    /// a sound one. [`FrictionModel::between`] does not change it.
    pub const fn faulted_ticks(&self) -> u32 {
        self.faulted_ticks
    }

    /// The folded constants.
    pub fn constants(&self) -> &S::Constants {
        self.constants.borrow()
    }

    /// The state, for diagnosis.
    pub const fn state(&self) -> &S::State {
        &self.state
    }
}

impl<S: ChangingFriction, C: Borrow<S::Constants>> FrictionModel<S, C> {
    /// Sets the friction coefficient of ball and groove, from the next step on: where temperature or wear change it while the model runs.
    /// In a ball screw within the nodes of the block; in a linear bearing 1e-6 to 1, and all forces follow it in proportion.
    /// [`FrictionModel::reset`] brings the configuration's back.
    pub fn set_friction(&mut self, friction: f32) -> Result<(), Error> {
        S::set_friction(self.constants.borrow(), &mut self.state, friction)
    }
}

impl<const N: usize, const NODES: usize, C: Borrow<UncagedConstants<N, NODES>>>
    FrictionModel<UncagedBallScrew<N, NODES>, C>
{
    /// Sets the angle of the nut against the screw, rad, from which the screw's deviations are counted: once after start-up, and again whenever
    /// an absolute sensor has it; between, the model integrates the speed of ticks with a valid one, up to its limit. NaN, or an
    /// angle beyond 8e6 periods of the map, counts as 0.
    pub fn set_nut_angle(&mut self, angle: f32) {
        self.constants
            .borrow()
            .set_nut_angle(&mut self.state, angle);
    }
}

impl<const N: usize, C: Borrow<LinearConstants<N>>> FrictionModel<LinearBearingTrain<N>, C> {
    /// Sets the carriage's place along the rail, m, from which the rail's deviations are counted: as the nut's angle of an
    /// [`UncagedBallScrew`].
    pub fn set_carriage_position(&mut self, position: f32) {
        self.constants
            .borrow()
            .set_carriage_position(&mut self.state, position);
    }
}
