//! A ball screw whose balls do not touch, by a law that was solved on a host: `epas-design` folds it, a step evaluates it.

mod block;
mod built_in;

use super::contract::Faults;
use super::contract::{
    ChangingFriction, CheckedInputs, Inputs, Limits, Reversal, ReversalState, Scene,
    SceneOutputs as _,
};
use super::outputs::Outputs;
use super::sliding::{CagedFriction, Sliding, SlidingFriction};
use super::stored::StoredScene;
use crate::ball::folded::{FrictionInterval, LoadLaw};
use crate::error::{Error, Range, attempt, in_range};
use crate::law::coefficient::DirectionalCoefficient;
use crate::ranges;
use crate::stored::{Fingerprint, Port, Refusal, Stored};
pub use built_in::{BUILT_IN_NODES, built_in};

/// A ball screw whose balls do not touch (caged, or with spacer balls), by the folded law of one ball, for `NODES` friction coefficients.
///
/// Its constants are a block that `epas-design` writes on a host, with a certificate of its errors: as Rust, C, TOML or bytes. Clearance
/// changes by another block ([`FrictionModel::swap_constants`](crate::FrictionModel::swap_constants)), the friction coefficient within the
/// block's nodes ([`FrictionModel::set_friction`](crate::FrictionModel::set_friction)). A load above the block's largest, or a coefficient
/// beyond its nodes, is computed with the law's end and flagged [`Faults::BEYOND_MODEL`].
///
/// The arithmetic of a step: [`Scene::step`] below, and `LoadLaw::torque_over_load` in `ball/folded.rs`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct CagedBallScrew<const NODES: usize = 1>;

/// Constants of a caged screw: a block that has been checked.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct CagedConstants<const NODES: usize = 1> {
    law: LoadLaw<NODES>,
    /// Logarithms of the nodes' friction coefficients.
    node_octaves: [f32; NODES],
    friction: FrictionInterval,
    /// 1 over the number of loaded balls; lift-off load of all balls, N.
    per_ball: f32,
    lift_off: f32,
    /// Torque per axial load without friction, `lead / 2 pi`, m.
    reduced_lead: f32,
    reversal: Reversal,
    limits: Limits,
}

/// State of a caged screw: its friction coefficient.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct CagedState {
    friction: FrictionInterval,
}

/// Configuration of a caged screw; unchecked.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct CagedBallScrewConfiguration<const NODES: usize = 1> {
    /// Law of one ball.
    pub law: LoadLaw<NODES>,
    /// Friction coefficient of ball and groove at set-up, within the law's nodes.
    pub friction: f32,
    /// Advance of the nut per turn, m, 0 to 0.2.
    pub lead: f32,
    /// Number of balls that carry load, 1 to 1000.
    pub loaded_balls: u16,
    /// Nut speed over which friction changes its direction, rad/s, 1e-6 to 1e3: at this speed it has 71 % of its full value.
    pub reversal_speed: f32,
    /// Limits of inputs and outputs.
    pub limits: Limits,
}

impl<const NODES: usize> CagedBallScrewConfiguration<NODES> {
    /// The same for the one node whose friction coefficient is nearest: a fifth of the constants, and as exact as a fold for that coefficient
    /// alone. Of NaN, the least node.
    pub const fn nearest(&self, friction: f32) -> CagedBallScrewConfiguration {
        const { assert!(NODES > 0) };
        let mut nearest = self.law.nodes[0];
        let mut number = 1;
        while number < NODES {
            let node = self.law.nodes[number];
            if (node.friction - friction).abs() < (nearest.friction - friction).abs() {
                nearest = node;
            }
            number += 1;
        }
        nearest.shift = [0.0; 2];
        CagedBallScrewConfiguration {
            law: LoadLaw {
                nodes: [nearest],
                ends: self.law.ends,
                lift_off: self.law.lift_off,
                shifted_from: self.law.shifted_from,
            },
            friction: nearest.friction,
            lead: self.lead,
            loaded_balls: self.loaded_balls,
            reversal_speed: self.reversal_speed,
            limits: self.limits,
        }
    }
}

impl<const NODES: usize> CagedConstants<NODES> {
    /// Checks a configuration and folds its constants.
    pub const fn new(configuration: &CagedBallScrewConfiguration<NODES>) -> Result<Self, Error> {
        let CagedBallScrewConfiguration {
            law,
            friction,
            lead,
            loaded_balls,
            reversal_speed,
            limits,
        } = *configuration;
        let law = attempt!(law.checked());
        let (least, largest) = law.friction_range();
        attempt!(in_range("friction", friction, least, largest));
        attempt!(in_range("lead", lead, 0.0, 0.2));
        let balls = attempt!(in_range("loaded_balls", loaded_balls as f32, 1.0, 1e3));
        let node_octaves = law.node_octaves();
        Ok(Self {
            friction: law.interval(friction, &node_octaves),
            node_octaves,
            per_ball: 1.0 / balls,
            lift_off: balls * law.lift_off,
            law,
            reduced_lead: lead / core::f32::consts::TAU,
            reversal: attempt!(Reversal::new(reversal_speed, 1e-6, 1e3)),
            limits: attempt!(limits.checked()),
        })
    }

    /// These constants with other limits, of a calibration page.
    pub const fn with_limits(&self, limits: Limits) -> Result<Self, Error> {
        Ok(Self {
            limits: attempt!(limits.checked()),
            ..*self
        })
    }

    #[inline(always)]
    const fn interval(&self, friction: f32) -> FrictionInterval {
        self.law.interval(friction, &self.node_octaves)
    }
}

impl<const NODES: usize> Scene for CagedBallScrew<NODES> {
    type Configuration = CagedBallScrewConfiguration<NODES>;
    type Constants = CagedConstants<NODES>;
    type State = CagedState;
    type Inputs = Inputs;
    type Outputs = Outputs;

    fn constants(configuration: &Self::Configuration) -> Result<Self::Constants, Error> {
        CagedConstants::new(configuration)
    }

    fn initial_state(constants: &Self::Constants) -> Self::State {
        CagedState {
            friction: constants.friction,
        }
    }

    fn take_over(constants: &Self::Constants, state: &mut Self::State) -> Result<(), Error> {
        state.friction = constants.friction;
        Ok(())
    }

    #[inline(always)]
    fn step(constants: &Self::Constants, state: &mut Self::State, inputs: Inputs) -> Outputs {
        let CheckedInputs { inputs, faults } = constants.limits.check_inputs(inputs);
        let Some(Inputs {
            nut_speed,
            axial_load,
        }) = inputs
        else {
            return Outputs::safe(faults);
        };
        let reversal = constants.reversal.at(nut_speed);
        let total_load = axial_load.abs() + constants.lift_off;
        let (torque_over_load, beyond) = constants.law.torque_over_load(
            total_load * constants.per_ball,
            reversal.direction * axial_load < 0.0,
            state.friction,
        );
        let sliding = total_load * torque_over_load;
        Outputs::new(
            reversal.factor * sliding,
            sliding,
            axial_load * constants.reduced_lead,
            &reversal,
            faults.with(beyond, Faults::BEYOND_MODEL),
            constants.limits.friction_torque,
        )
    }
}

impl<const NODES: usize> Sliding for CagedBallScrew<NODES> {
    const FRICTION: Range = ranges::FRICTION_OF_A_ROW;

    const COUNTS_PRELOAD: bool = true;

    type Friction = CagedFriction;

    #[inline(always)]
    fn check_inputs(constants: &Self::Constants, inputs: Inputs) -> CheckedInputs<Inputs> {
        constants.limits.check_inputs(inputs)
    }

    #[inline(always)]
    fn sliding_friction(
        constants: &Self::Constants,
        _: &mut Self::State,
        inputs: Inputs,
        friction: DirectionalCoefficient,
    ) -> CagedFriction {
        let DirectionalCoefficient { forward, backward } = friction;
        let law = &constants.law;
        let load = inputs.axial_load.abs() + constants.lift_off;
        let per_ball = load * constants.per_ball;
        let (mut interval, mut holds) = (constants.interval(forward), law.holds(forward));
        let (over_load, beyond) = law.torque_over_load(per_ball, inputs.axial_load < 0.0, interval);
        if backward != forward {
            holds &= law.holds(backward);
            interval = constants.interval(backward);
        }
        let (over_load_backward, _) =
            law.torque_over_load(per_ball, inputs.axial_load > 0.0, interval);
        let beyond = beyond || !holds;
        CagedFriction {
            sliding: SlidingFriction {
                forward: load * over_load,
                backward: load * over_load_backward,
                load,
            },
            faults: Faults::NONE.with(beyond, Faults::BEYOND_MODEL),
        }
    }

    #[inline(always)]
    fn by_direction(sliding: &CagedFriction) -> SlidingFriction {
        sliding.sliding
    }

    #[inline(always)]
    fn outputs_at(
        constants: &Self::Constants,
        inputs: Inputs,
        friction: &CagedFriction,
        reversal: ReversalState,
        drag: f32,
        faults: Faults,
    ) -> Outputs {
        Outputs::new(
            reversal.factor * friction.of(reversal.factor) + drag,
            friction.of(reversal.direction),
            inputs.axial_load * constants.reduced_lead,
            &reversal,
            friction.faults | faults,
            constants.limits.friction_torque,
        )
    }
}

impl<const NODES: usize> ChangingFriction for CagedBallScrew<NODES> {
    fn set_friction(
        constants: &Self::Constants,
        state: &mut Self::State,
        friction: f32,
    ) -> Result<(), Error> {
        let (least, largest) = constants.law.friction_range();
        let friction = in_range("friction", friction, least, largest)?;
        state.friction = constants.interval(friction);
        Ok(())
    }
}

impl<const NODES: usize> StoredScene for CagedBallScrew<NODES> {
    const KIND: u16 = 4;

    /// Not the friction coefficient: only its range has to fit, which [`Self::complete`] checks.
    fn fingerprint(constants: &Self::Constants, fingerprint: &mut Fingerprint) {
        fingerprint.number(constants.reduced_lead);
    }

    fn complete(constants: &Self::Constants, state: &mut Self::State) -> Result<(), Refusal> {
        let friction = state.friction.friction();
        if constants.law.holds(friction) {
            state.friction = constants.interval(friction);
            Ok(())
        } else {
            Err(Refusal::OutOfRange { field: "friction" })
        }
    }
}

impl Stored for CagedState {
    const BYTES: usize = FrictionInterval::BYTES;

    fn exchange<P: Port>(&mut self, port: &mut P) -> Result<(), Refusal> {
        self.friction.exchange(port)
    }
}
