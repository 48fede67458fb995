//! A ball screw whose balls press on each other, by a law of one ball that was solved on a host: `epas-design` folds it, a step evaluates it for
//! every ball.

mod block;
mod closed_form;
mod configuration;
mod sliding;
mod step;
mod stored;

use core::f32::consts::TAU;

use super::circuit::{Circuit, CircuitState};
use super::contract::{
    ChangingFriction, CheckedInputs, Inputs, Limits, Reversal, Scene, SceneOutputs as _,
};
use super::outputs::UncagedOutputs;
use super::sliding::{NO_DRAG, Sliding as _};
use crate::ball::LoadShare;
use crate::ball::folded::{FrictionInterval, node_octaves};
use crate::ball::pressed::{BallLaw, BallOfRow, RowConstants};
use crate::error::{Error, attempt, in_range};
use crate::ranges;

pub use closed_form::CatalogueBall;
pub use configuration::{FoldedBall, UncagedBallScrewConfiguration};
pub use step::UncagedFriction;

/// A ball screw without cage, with up to `N` balls in one circuit: friction of the grooves and between balls, by the folded law of one ball, for
/// `NODES` friction coefficients.
///
/// Every ball is evaluated in every tick, at its position, under the load of this tick: nothing settles after a start, a reversal or a step of the
/// load. What is kept from tick to tick is where the balls are, the phase of the screw's deviations and the friction coefficient.
///
/// A step whose speed or load is NaN or infinite is flagged, outputs no torque, and leaves the state as
/// it is; the next sound tick is unflagged. Balls, and the phase of the screw's deviations, then lag by
/// the travel of the missed ticks, and friction is that of this position: sound, but that of an earlier angle.
/// [`FrictionModel::set_nut_angle`](crate::FrictionModel::set_nut_angle) brings the phase back; the balls, whose positions no sensor knows, stay behind.
///
/// The loads of the balls add up to the axial load at every angle: a ball takes up its load, and gives it up, over a run-in of one pitch between
/// load and return. The ball that carries most has the axial load over the balls that carry, each with its part.
///
/// [`Faults::BEYOND_MODEL`](crate::Faults::BEYOND_MODEL) is set in each tick in which the torque is not held: where the ball that carries most, or the
/// friction coefficient, is beyond those for which the law was folded, where a ball is rubbed more than the law holds
/// ([`BallLaw::holds_rubbing`]), or where no ball is loaded.
/// [`Faults::FORCES_NOT_HELD`](crate::Faults::FORCES_NOT_HELD) is set where balls press and the forces between them are not held: under some load from that
/// of the ball that carries least, the run-ins left out, to that of the one that carries most. The torque is held there all the same, as the block's
/// certificate says.
///
/// A step reads from `scene/uncaged/step.rs`: what a ball does on its own in `ball/pressed/numbers.rs`, what its neighbours change in `ball/pressed/row.rs`, a tick
/// of all balls in `train/tick.rs`, which balls press in `train/pool.rs`, and how hard in `train/settle.rs`; `train.rs` has the words.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct UncagedBallScrew<const N: usize, const NODES: usize = 1>;

/// What a tick changes in a ball screw without cage.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct UncagedState<const N: usize> {
    /// Where the balls are, and how they press.
    pub circuit: CircuitState<N>,
    friction: FrictionInterval,
    /// What each ball does alone in the present tick.
    balls: [BallOfRow; N],
}

/// Constants of a ball screw without cage, with up to `N` balls.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct UncagedConstants<const N: usize, const NODES: usize = 1> {
    law: &'static BallLaw<NODES>,
    /// Octaves of the nodes' friction coefficients.
    node_octaves: [f32; NODES],
    /// The configuration's friction coefficient.
    friction: FrictionInterval,
    circuit: Circuit,
    /// What the balls have in common beside their law.
    row: RowConstants,
    /// Deviations of one unit of the maps of screw and nut, over the law's largest.
    units: [f32; 2],
    /// Whether all balls carry the same load.
    even: bool,
    /// Sum of the balls' lift-off loads, in the mean, N.
    preload: f32,
    /// Time between two ticks, s, and 1 / it.
    tick: f32,
    per_tick: f32,
    /// Torque per axial load without friction, `lead / 2 pi`, m.
    reduced_lead: f32,
    reversal: Reversal,
    limits: Limits,
}

impl<const N: usize, const NODES: usize> Scene for UncagedBallScrew<N, NODES> {
    type Configuration = UncagedBallScrewConfiguration<NODES>;
    type Constants = UncagedConstants<N, NODES>;
    type State = UncagedState<N>;
    type Inputs = Inputs;
    type Outputs = UncagedOutputs;

    fn constants(
        configuration: &UncagedBallScrewConfiguration<NODES>,
    ) -> Result<UncagedConstants<N, NODES>, Error> {
        UncagedConstants::new(configuration)
    }

    #[inline(always)]
    fn initial_state(constants: &UncagedConstants<N, NODES>) -> UncagedState<N> {
        UncagedState {
            circuit: CircuitState::new(&constants.circuit),
            friction: constants.friction,
            balls: [BallOfRow::UNLOADED; N],
        }
    }

    /// Balls stay where they are; the friction coefficient is that of the new constants.
    fn take_over(
        constants: &UncagedConstants<N, NODES>,
        state: &mut UncagedState<N>,
    ) -> Result<(), Error> {
        state.circuit.is_on(&constants.circuit)?;
        state.friction = constants.friction;
        Ok(())
    }

    #[inline(always)]
    fn step(
        constants: &UncagedConstants<N, NODES>,
        state: &mut UncagedState<N>,
        inputs: Inputs,
    ) -> UncagedOutputs {
        let CheckedInputs { inputs, faults } = constants.limits.check_inputs(inputs);
        let Some(inputs) = inputs else {
            return UncagedOutputs::safe(faults);
        };
        let sliding = constants.friction_of_balls(state, inputs);
        let reversal = constants.reversal.at(inputs.nut_speed);
        Self::outputs_at(constants, inputs, &sliding, reversal, NO_DRAG, faults)
    }
}

impl<const N: usize, const NODES: usize> UncagedConstants<N, NODES> {
    /// Checks a configuration and folds its constants: at set-up, or in a constant when firmware is compiled (see
    /// [`FrictionModel`](crate::FrictionModel)).
    ///
    /// # Errors
    /// [`Error`] naming the field out of range.
    pub const fn new(configuration: &UncagedBallScrewConfiguration<NODES>) -> Result<Self, Error> {
        let UncagedBallScrewConfiguration {
            folded,
            ball_friction,
            screw_deviation,
            nut_deviation,
            load_shares,
            tick,
            ..
        } = *configuration;
        let FoldedBall {
            ref law,
            friction,
            lead,
            reversal_speed,
            limits,
            ..
        } = *folded;
        attempt!(law.checked());
        attempt!(check_friction(law, friction, ball_friction));
        attempt!(in_range("lead", lead, 0.0, 0.2));
        let limits = attempt!(limits.checked());
        let circuit = attempt!(configuration.circuit(&limits, N));
        let [screw, nut] = law.deviations;
        attempt!(screw_deviation.checked("screw_deviation", screw));
        attempt!(nut_deviation.checked("nut_deviation", nut));
        let units = circuit.deviation_units();
        Ok(Self {
            law,
            friction: law.interval(friction),
            node_octaves: node_octaves(&law.frictions()),
            circuit,
            row: folded.row(ball_friction),
            units: [units.0 / screw, units.1 / nut],
            even: load_shares.are_even(),
            preload: law.lift_off / circuit.per_loaded_ball(),
            tick,
            per_tick: 1.0 / tick,
            reduced_lead: lead / TAU,
            reversal: attempt!(Reversal::new(reversal_speed, 1e-6, 1e3)),
            limits,
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
    fn interval(&self, friction: f32) -> FrictionInterval {
        FrictionInterval::among(&self.law.frictions(), &self.node_octaves, friction)
    }

    /// Shares of the balls under a load of this sign.
    #[inline(always)]
    const fn shares(&self, axial_load: f32) -> &'static [LoadShare] {
        self.circuit.shares(axial_load < 0.0)
    }

    /// See [`FrictionModel::set_nut_angle`](crate::FrictionModel::set_nut_angle).
    pub(crate) fn set_nut_angle(&self, state: &mut UncagedState<N>, angle: f32) {
        state.circuit.set_turns(&self.circuit, angle / TAU);
    }
}

/// Refuses friction coefficients, of ball and groove and of ball and ball, that a law does not hold.
const fn check_friction<const NODES: usize>(
    law: &BallLaw<NODES>,
    friction: f32,
    ball_friction: f32,
) -> Result<(), Error> {
    let (least, largest) = law.friction_range();
    attempt!(in_range("friction", friction, least, largest));
    attempt!(ranges::FRICTION_OR_NONE.checked("ball_friction", ball_friction));
    Ok(())
}

impl<const N: usize, const NODES: usize> ChangingFriction for UncagedBallScrew<N, NODES> {
    fn set_friction(
        constants: &UncagedConstants<N, NODES>,
        state: &mut UncagedState<N>,
        friction: f32,
    ) -> Result<(), Error> {
        let (least, largest) = constants.law.friction_range();
        let friction = in_range("friction", friction, least, largest)?;
        state.friction = constants.interval(friction);
        Ok(())
    }
}
