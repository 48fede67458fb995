//! A ball screw whose balls do not touch, by a law that was solved on a host: `epas-design` folds it, a step evaluates it.

mod block;
mod built_in;
mod configuration;
mod stored;

use super::caged_friction::CagedFriction;
use super::contract::{ChangingFriction, CheckedInputs, Inputs, Limits, Regime, Scene};
use super::faults::Faults;
use super::outputs::Outputs;
use super::reversal::{Reversal, ReversalState};
use super::sliding::{Sliding, SlidingFriction};
use crate::ball::folded::{FrictionInterval, LoadLaw, octaves};
use crate::error::{Error, Range, attempt, in_range};
use crate::law::coefficient::DirectionalCoefficient;
use crate::ranges;
pub use built_in::{BUILT_IN_NODES, built_in};
pub use configuration::CagedBallScrewConfiguration;

/// A ball screw whose balls do not touch (caged, or with spacer balls), by the folded law of one ball, for `NODES` friction coefficients.
///
/// It starts at once, a step takes the same cycles whatever was set, and nothing settles. Its constants are a block that `epas-design`
/// writes on a host, with a certificate of its errors: as Rust, C, TOML or bytes. Clearance changes by another block
/// ([`FrictionModel::swap_constants`](crate::FrictionModel::swap_constants)), the friction coefficient within the block's nodes
/// ([`FrictionModel::set_friction`](crate::FrictionModel::set_friction)).
///
/// A load above the block's largest is computed with the law's end and flagged [`Faults::BEYOND_MODEL`], as is a friction coefficient
/// beyond its nodes.
///
/// The arithmetic of a step: `ball/folded.rs` (`LoadLaw::torque_over_load`) and `ball/folded/curve.rs`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct CagedBallScrew<const NODES: usize = 1>;

/// Constants of a caged screw: a block that has been checked.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct CagedConstants<const NODES: usize = 1> {
    law: LoadLaw<NODES>,
    /// Octaves of the nodes' friction coefficients.
    node_octaves: [f32; NODES],
    /// The configuration's friction coefficient.
    friction: FrictionInterval,
    /// 1 over the number of loaded balls; lift-off load of all balls, N.
    per_ball: f32,
    lift_off: f32,
    /// Torque per axial load without friction, `lead / 2 pi`, m.
    reduced_lead: f32,
    reversal: Reversal,
    limits: Limits,
}

/// What of a caged screw can be set while it runs.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct CagedState {
    friction: FrictionInterval,
}

/// A load in the law.
#[derive(Clone, Copy)]
struct Loaded {
    /// Octaves of a ball's load, lift-off counted, within the law's ends.
    octaves: f32,
    /// Load of all balls, lift-off counted, N.
    whole: f32,
    beyond: bool,
}

impl<const NODES: usize> CagedConstants<NODES> {
    /// Checks a configuration and folds its constants: at set-up, or in a constant when firmware is compiled.
    ///
    /// # Errors
    /// [`Error`] naming the field out of range.
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

    /// These constants with other limits: a block from flash, limits from a calibration page.
    ///
    /// # Errors
    /// As [`Limits::checked`].
    pub const fn with_limits(&self, limits: Limits) -> Result<Self, Error> {
        Ok(Self {
            limits: attempt!(limits.checked()),
            ..*self
        })
    }

    /// Where a friction coefficient lies.
    #[inline(always)]
    const fn interval(&self, friction: f32) -> FrictionInterval {
        self.law.interval(friction, &self.node_octaves)
    }

    /// Where a load lies.
    #[inline(always)]
    fn loaded(&self, axial_load: f32) -> Loaded {
        let [least, most] = self.law.ends;
        let whole = axial_load.abs() + self.lift_off;
        let octaves = octaves(whole * self.per_ball);
        let beyond = octaves > most;
        let octaves = if beyond { most } else { octaves };
        Loaded {
            octaves: if octaves > least { octaves } else { least },
            whole,
            beyond,
        }
    }

    /// Friction torque of all balls, N m, not negative; where `opposing` is below 0 the load assists the motion, else it opposes it.
    #[inline(always)]
    fn torque(&self, loaded: &Loaded, opposing: f32, interval: FrictionInterval) -> f32 {
        let branch = usize::from(opposing < 0.0);
        let per_load = self.law.torque_over_load(loaded.octaves, branch, interval);
        loaded.whole * per_load
    }

    /// Outputs from two sliding frictions: that in the direction of motion, which decides the regime, and that in the direction in which
    /// friction acts, times the factor that a reversal leaves of it.
    #[inline(always)]
    fn put_out(
        &self,
        axial_load: f32,
        [sliding, reversing]: [f32; 2],
        reversal: ReversalState,
        faults: Faults,
    ) -> Outputs {
        let load_torque = axial_load * self.reduced_lead;
        let opposing = reversal.direction * load_torque;
        Outputs {
            friction_torque: reversal.factor * reversing,
            load_torque,
            // Filled in where friction is limited.
            efficiency: 0.0,
            regime: Regime::under(reversal.standing, opposing, sliding),
            faults,
        }
    }
}

impl<const NODES: usize> Scene for CagedBallScrew<NODES> {
    type Configuration = CagedBallScrewConfiguration<NODES>;
    type Constants = CagedConstants<NODES>;
    type State = CagedState;
    type Inputs = Inputs;
    type ValidInputs = Inputs;
    type Outputs = Outputs;

    fn constants(
        configuration: &CagedBallScrewConfiguration<NODES>,
    ) -> Result<CagedConstants<NODES>, Error> {
        CagedConstants::new(configuration)
    }

    fn initial_state(constants: &CagedConstants<NODES>) -> CagedState {
        CagedState {
            friction: constants.friction,
        }
    }

    /// The friction coefficient is that of the new constants.
    fn take_over(constants: &CagedConstants<NODES>, state: &mut CagedState) -> Result<(), Error> {
        state.friction = constants.friction;
        Ok(())
    }

    #[inline(always)]
    fn check_inputs(constants: &CagedConstants<NODES>, inputs: Inputs) -> CheckedInputs<Inputs> {
        constants.limits.check_inputs(inputs)
    }

    #[inline(always)]
    fn outputs(
        constants: &CagedConstants<NODES>,
        state: &mut CagedState,
        inputs: Inputs,
    ) -> Outputs {
        let reversal = constants.reversal.at(inputs.nut_speed);
        let loaded = constants.loaded(inputs.axial_load);
        let opposing = reversal.direction * inputs.axial_load;
        let sliding = constants.torque(&loaded, opposing, state.friction);
        let faults = Faults::NONE.with(loaded.beyond, Faults::BEYOND_MODEL);
        constants.put_out(inputs.axial_load, [sliding, sliding], reversal, faults)
    }

    #[inline(always)]
    fn largest_friction(constants: &CagedConstants<NODES>) -> f32 {
        constants.limits.friction_torque
    }
}

impl<const NODES: usize> Sliding for CagedBallScrew<NODES> {
    const FRICTION: Range = ranges::FRICTION_OF_A_ROW;

    const COUNTS_PRELOAD: bool = true;

    type Friction = CagedFriction;

    #[inline(always)]
    fn sliding_friction(
        constants: &CagedConstants<NODES>,
        _: &mut CagedState,
        inputs: Inputs,
        friction: DirectionalCoefficient,
    ) -> CagedFriction {
        let DirectionalCoefficient { forward, backward } = friction;
        let law = &constants.law;
        let loaded = constants.loaded(inputs.axial_load);
        let beyond = loaded.beyond || !law.holds(forward) || !law.holds(backward);
        let load = inputs.axial_load;
        CagedFriction {
            forward: constants.torque(&loaded, load, constants.interval(forward)),
            backward: constants.torque(&loaded, -load, constants.interval(backward)),
            load: loaded.whole,
            faults: Faults::NONE.with(beyond, Faults::BEYOND_MODEL),
        }
    }

    #[inline(always)]
    fn by_direction(sliding: &CagedFriction) -> SlidingFriction {
        sliding.by_direction()
    }

    #[inline(always)]
    fn outputs_at(
        constants: &CagedConstants<NODES>,
        inputs: Inputs,
        sliding: &CagedFriction,
        reversal: ReversalState,
    ) -> Outputs {
        let torques = [sliding.of(reversal.direction), sliding.of(reversal.factor)];
        constants.put_out(inputs.axial_load, torques, reversal, sliding.faults)
    }

    #[inline(always)]
    fn limited_travel(_: &CagedConstants<NODES>, turn: f32, measured: f32) -> (f32, f32) {
        (turn, measured)
    }
}

impl<const NODES: usize> ChangingFriction for CagedBallScrew<NODES> {
    fn set_friction(
        constants: &CagedConstants<NODES>,
        state: &mut CagedState,
        friction: f32,
    ) -> Result<(), Error> {
        let (least, largest) = constants.law.friction_range();
        let friction = in_range("friction", friction, least, largest)?;
        state.friction = constants.interval(friction);
        Ok(())
    }
}
