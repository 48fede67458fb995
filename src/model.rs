//! The model that runs in the interrupt: constants folded at set-up, a small state, one `step`.

mod memory;
mod stored;

use core::borrow::Borrow;

use crate::error::Error;
use crate::scene::{
    ChangingFriction, Faults, LinearBearingTrain, LinearConstants, Scene, SceneOutputs,
    UncagedBallScrew, UncagedConstants,
};

/// Friction of one scene: configured once, stepped in the interrupt.
///
/// ```
/// # mod gear { // a law in proportion to the load, for a short example
/// #     use epas_friction::ball::folded::{FrictionNode, LoadCurve, LoadLaw, PARTS};
/// #     use epas_friction::{CagedBallScrewConfiguration, CagedConstants, Limits};
/// #     const fn node(friction: f32) -> FrictionNode {
/// #         let mut starts = [f32::MAX; PARTS];
/// #         starts[0] = 120.0;
/// #         let curve = LoadCurve { starts, cubics: [[2e-3, 0.0, 0.0, 0.0]; PARTS] };
/// #         FrictionNode { friction, curves: [curve; 2], shift: [0.0; 2] }
/// #     }
/// #     pub static GEAR_33X20: CagedConstants<1> = match CagedConstants::new(&CagedBallScrewConfiguration {
/// #         law: LoadLaw { nodes: [node(0.1)], ends: [120.0, 136.0], lift_off: 0.0, shifted_from: 1.0 },
/// #         friction: 0.1, lead: 0.02, loaded_balls: 36, reversal_speed: 0.5,
/// #         limits: Limits { nut_speed: 100.0, axial_load: 20_000.0, friction_torque: 20.0 },
/// #     }) {
/// #         Ok(constants) => constants,
/// #         Err(_) => panic!("a field is out of range"),
/// #     };
/// # }
/// use epas_friction::{CagedBallScrew, FrictionModel, Inputs, Regime};
/// use gear::GEAR_33X20; // a `static` that `epas-bench design` has written
///
/// let mut model = FrictionModel::<CagedBallScrew, _>::of(&GEAR_33X20);
///
/// // in the interrupt
/// let outputs = model.step(Inputs { nut_speed: 40.0, axial_load: 3_000.0 });
/// assert_eq!(outputs.regime, Regime::Driving);
/// assert!(outputs.friction_torque > 0.0 && outputs.efficiency > 0.9);
/// ```
///
/// Every other scene is set up from its design: at run time by [`FrictionModel::new`], or by the compiler. Constants that the compiler has
/// folded stay in flash, the model keeps a reference to them beside its state, nothing of what checks and folds them is linked, and a field
/// out of range is an error of the compiler (what [`FrictionModel::of`] does remains):
///
/// ```
/// use epas_friction::{
///     CATALOGUE, Clearance, ClosedFormScrew, ClosedFormScrewConfiguration, ClosedFormScrewConstants, Error,
///     FrictionBranch, FrictionModel, Limits,
/// };
///
/// static GEAR: ClosedFormScrewConstants = match gear() {
///     Ok(constants) => constants,
///     Err(_) => panic!("a field is out of range"),
/// };
///
/// const fn gear() -> Result<ClosedFormScrewConstants, Error> {
///     ClosedFormScrewConstants::new(&ClosedFormScrewConfiguration {
///         design: match CATALOGUE[15].design() { // 32 x 20 x 6.35
///             Ok(design) => design,
///             Err(error) => return Err(error),
///         },
///         friction: 0.1,
///         rolling_tangent: 0.0,
///         branch: FrictionBranch::Rolling,
///         clearance: Clearance::ZERO,
///         loaded_balls: 40,
///         reversal_speed: 0.5,
///         limits: Limits { nut_speed: 500.0, axial_load: 20_000.0, friction_torque: 5.0 },
///     })
/// }
///
/// let model = FrictionModel::<ClosedFormScrew, _>::of(&GEAR);
/// assert_eq!(model.faulted_ticks(), 0);
/// ```
///
/// With a field out of range this does not compile:
///
/// ```compile_fail,E0080
/// # use epas_friction::{
/// #     CATALOGUE, Clearance, ClosedFormScrewConfiguration, ClosedFormScrewConstants, Error, FrictionBranch, Limits,
/// # };
/// # static GEAR: ClosedFormScrewConstants = match gear() {
/// #     Ok(constants) => constants,
/// #     Err(_) => panic!("a field is out of range"),
/// # };
/// # const fn gear() -> Result<ClosedFormScrewConstants, Error> {
/// #     ClosedFormScrewConstants::new(&ClosedFormScrewConfiguration {
/// #         design: match CATALOGUE[15].design() {
/// #             Ok(design) => design,
/// #             Err(error) => return Err(error),
/// #         },
///         friction: 7.5,
/// #         rolling_tangent: 0.0,
/// #         branch: FrictionBranch::Rolling,
/// #         clearance: Clearance::ZERO,
/// #         loaded_balls: 40,
/// #         reversal_speed: 0.5,
/// #         limits: Limits { nut_speed: 500.0, axial_load: 20_000.0, friction_torque: 5.0 },
/// #     })
/// # }
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrictionModel<S: Scene, C = <S as Scene>::Constants> {
    constants: C,
    state: S::State,
    faulted_ticks: u32,
}

impl<S: Scene> FrictionModel<S> {
    /// Checks the configuration and folds the constants. Set-up only.
    ///
    /// # Errors
    /// [`Error`] naming the field out of range.
    pub fn new(configuration: &S::Configuration) -> Result<Self, Error> {
        S::constants(configuration).map(Self::of)
    }
}

impl<S: Scene, C: Borrow<S::Constants>> FrictionModel<S, C> {
    /// A model of constants that are folded already, or of a reference to them. Set-up only: it makes the first state, at once.
    #[inline(always)]
    pub fn of(constants: C) -> Self {
        let state = S::initial_state(constants.borrow());
        Self {
            constants,
            state,
            faulted_ticks: 0,
        }
    }

    /// One tick: bounded time, no panic, finite outputs whatever the inputs are.
    ///
    /// The one place where faults are handled, for every scene: inputs are checked against their limits
    /// ([`Scene::check_inputs`]), the mechanism is computed from them ([`Scene::outputs`]), its friction is limited, and steps
    /// with a fault are counted ([`Self::faulted_ticks`]). Where an input is NaN or infinite, nothing is computed: the output is the safe one and
    /// the state stays as it is. Not so [`WithMemory`](crate::scene::WithMemory): it goes on with the last sound inputs of its
    /// scene, its memory follows every sound reading of the angle, and the output is that friction, flagged.
    #[inline]
    pub fn step(&mut self, inputs: S::Inputs) -> S::Outputs {
        let constants = self.constants.borrow();
        let checked = S::check_inputs(constants, inputs);
        let outputs = match checked.inputs {
            Some(known) => S::outputs(constants, &mut self.state, known),
            None => S::Outputs::SAFE,
        };
        let outputs = Self::limited(constants, outputs, checked.faults);
        self.faulted_ticks = if outputs.faults().faulty() {
            self.faulted_ticks.saturating_add(1)
        } else {
            0
        };
        outputs
    }

    /// What a step puts out, and a reading between two steps: friction within its limit, with what was wrong.
    #[inline(always)]
    fn limited(constants: &S::Constants, outputs: S::Outputs, faults: Faults) -> S::Outputs {
        outputs.limited(S::largest_friction(constants), faults)
    }

    /// Back to the state before the first tick.
    pub fn reset(&mut self) {
        self.state = S::initial_state(self.constants.borrow());
        self.faulted_ticks = 0;
    }

    /// Puts other constants in the place of the present ones, as a controller does that switches its calibration page, and
    /// gives the present ones back. Balls and memory stay; the circuit of balls, where there is one, has to be the same.
    ///
    /// Not in the middle of a step: an interrupt that steps the model has to wait. With constants in flash (`C` a reference)
    /// it is a pointer that changes. A caged ball screw has the friction of its new block from the next step on: this is how its clearance
    /// changes; a friction coefficient that was set is that of the new block again. Where the maps of a screw's or a
    /// rail's deviations have another period, set the angle or the place anew, from which they are counted.
    ///
    /// # Errors
    /// [`Error`] naming what does not fit to the state; the model goes on as it was.
    pub fn swap_constants(&mut self, constants: C) -> Result<C, Error> {
        S::take_over(constants.borrow(), &mut self.state)?;
        Ok(core::mem::replace(&mut self.constants, constants))
    }

    /// Consecutive calls of [`Self::step`] with a fault ([`Faults::faulty`](crate::Faults::faulty)), up to `u32::MAX`; 0 after
    /// a sound one. A step whose only flags are [`Faults::BEYOND_MODEL`](crate::Faults::BEYOND_MODEL) and
    /// [`Faults::FORCES_NOT_HELD`](crate::Faults::FORCES_NOT_HELD) is sound. What is put out
    /// between two steps ([`FrictionModel::between`]) does not change this counter: its faults are reported in its outputs.
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
    /// Sets the friction coefficient of ball and groove, 1e-6 to 0.5 (to 1 of a linear bearing): where temperature or wear change it
    /// while the model runs. [`FrictionModel::reset`] brings the configuration's back.
    ///
    /// In a caged ball screw it lies within the nodes of the block, and counts from the next step on.
    ///
    /// In a ball screw without cage balls take it over as their turn comes; where it jumps they settle, flagged the same.
    ///
    /// In a linear bearing friction and all forces between balls follow it in proportion, from the next tick on.
    ///
    /// # Errors
    /// [`Error`] naming `friction`; the model goes on as it was.
    pub fn set_friction(&mut self, friction: f32) -> Result<(), Error> {
        S::set_friction(self.constants.borrow(), &mut self.state, friction)
    }
}

impl<const N: usize, const NODES: usize, C: Borrow<UncagedConstants<N, NODES>>>
    FrictionModel<UncagedBallScrew<N, NODES>, C>
{
    /// Sets the angle of the nut against the screw, rad, from which the screw's deviations are counted:
    /// once after start-up, and again whenever an absolute sensor has it; between, the model integrates
    /// the speed. Ticks without a valid speed are missing in that sum, one beyond its limit counts with the
    /// limit. An angle that is NaN, or beyond 8e6 periods of the map, counts as 0.
    pub fn set_nut_angle(&mut self, angle: f32) {
        self.constants
            .borrow()
            .set_nut_angle(&mut self.state, angle);
    }
}

impl<const N: usize, C: Borrow<LinearConstants<N>>> FrictionModel<LinearBearingTrain<N>, C> {
    /// Sets the carriage's place along the rail, m, from which the rail's deviations are counted: once after start-up,
    /// and again whenever an absolute sensor has it; between, the model integrates the speed. Ticks without a valid
    /// speed are missing in that sum, one beyond its limit counts with the limit. A place that is NaN, or beyond
    /// 8e6 periods of the map, counts as 0.
    pub fn set_carriage_position(&mut self, position: f32) {
        self.constants
            .borrow()
            .set_carriage_position(&mut self.state, position);
    }
}
