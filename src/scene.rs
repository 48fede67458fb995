//! Scenes: what a mechanism needs and what it leaves out, decided at compile time.
//!
//! A scene is a type. [`FrictionModel`](crate::FrictionModel) is generic over it, so that firmware
//! links the code and the state of its own scene and nothing else: a caged ball screw has no
//! ball-to-ball contacts, a bearing no lead, a scene without slip output no kinematics.

mod caged;
mod deviation;
mod faults;
mod linear;
mod screw;
mod uncaged;
mod zone;

pub use caged::{
    CagedBallScrew, CagedBallScrewConfiguration, CagedConstants, CagedState, FrictionBranch,
};
pub use deviation::{DeviationMap, HIGHEST_ORDER, Harmonic, LARGEST_DEVIATION};
pub use faults::{Faults, Limits};
pub use linear::{
    LinearBearingConfiguration, LinearBearingTrain, LinearConstants, LinearInputs, LinearLimits,
    LinearState,
};
pub use screw::{UncagedBallScrew, UncagedBallScrewConfiguration, UncagedConstants, UncagedState};
pub use uncaged::TrainOutputs;

use crate::error::Error;
use faults::Flagged;

/// What the control interrupt knows at a tick.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Inputs {
    /// Angular speed of the nut relative to the screw, rad/s.
    pub nut_speed: f32,
    /// Axial force of the load, N; positive where it opposes the travel that a positive nut speed
    /// makes. `nut_speed * axial_load > 0` is driving, `< 0` back-driving.
    pub axial_load: f32,
}

/// What the mechanism does at a tick.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Regime {
    /// The nut is slower than the reversal speed: friction is between its two directions.
    Standing,
    /// The motor moves the load (or turns against friction alone).
    Driving,
    /// The load turns the nut.
    BackDriving,
    /// The efficiency of the present direction is not positive: driving, no torque moves the load;
    /// back-driving, the load alone does not sustain the motion and the motor has to push.
    Locked,
}

/// What every scene returns.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Outputs {
    /// Torque about the nut's axis that the motor has to add to overcome friction, N m. It has the
    /// sign of the nut speed; friction itself acts on the nut with the opposite sign.
    pub friction_torque: f32,
    /// Torque about the nut's axis that holds the load without friction, N m: `axial_load lead / 2
    /// pi`. The motor's torque at constant speed is the sum of the two.
    pub load_torque: f32,
    /// Efficiency of motion in the present direction under the present load, away from the reversal:
    /// work out over work in. 0 without load, negative where the direction is locked (not below -1e6),
    /// 0 in a fault.
    pub efficiency: f32,
    /// What the mechanism does.
    pub regime: Regime,
    /// What was wrong with this tick's inputs, or limited in its outputs.
    pub faults: Faults,
}

impl Flagged for Outputs {
    #[inline]
    fn safe(faults: Faults) -> Self {
        Self {
            friction_torque: 0.0,
            load_torque: 0.0,
            efficiency: 0.0,
            regime: Regime::Standing,
            faults,
        }
    }

    #[inline]
    fn faults(&self) -> Faults {
        self.faults
    }
}

/// A preload's friction beside a vanishing load would make the efficiency of back-driving infinite.
const LEAST_EFFICIENCY: f32 = -1e6;

/// Work out over work in, from the torques of load and friction with their signs; 0 without load.
#[inline(always)]
fn efficiency(driving: bool, load: f32, friction: f32) -> f32 {
    if load == 0.0 {
        0.0
    } else if driving {
        load / (load + friction)
    } else {
        let efficiency = 1.0 + friction / load;
        if efficiency > LEAST_EFFICIENCY {
            efficiency
        } else {
            LEAST_EFFICIENCY
        }
    }
}

/// A mechanism with its configuration, its constants, its state and one tick.
///
/// Constants are folded once and never change; the state is small and is all that a tick changes.
pub trait Scene {
    /// What the engineer sets.
    type Configuration;
    /// What follows from it and never changes.
    type Constants;
    /// What a tick changes.
    type State;
    /// What the control interrupt knows at a tick.
    type Inputs;
    /// What a tick returns.
    type Outputs;

    /// Checks the configuration and folds the constants.
    ///
    /// # Errors
    /// [`Error`] naming the field out of range.
    fn constants(configuration: &Self::Configuration) -> Result<Self::Constants, Error>;

    /// The state before the first tick.
    fn initial_state(constants: &Self::Constants) -> Self::State;

    /// One tick: bounded time, no panic, finite outputs whatever the inputs are.
    fn step(
        constants: &Self::Constants,
        state: &mut Self::State,
        inputs: Self::Inputs,
    ) -> Self::Outputs;
}
