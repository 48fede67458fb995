//! A ball screw whose balls press on each other, by a law of one ball that was solved on a host.

mod block;
mod closed_form;
mod configuration;
mod step;

use core::f32::consts::TAU;

use super::circuit::{Circuit, CircuitState};
use super::contract::{
    ChangingFriction, CheckedInputs, Inputs, Limits, Reversal, ReversalState, Scene,
    SceneOutputs as _,
};
use super::faults::{Faults, bounded};
use super::outputs::UncagedOutputs;
use super::sliding::{NO_DRAG, Sliding, SlidingFriction, TrainFriction};
use super::stored::StoredScene;
use crate::ball::LoadShare;
use crate::ball::folded::{FrictionInterval, node_octaves};
use crate::ball::pressed::{BallLaw, BallOfRow, RowConstants};
use crate::error::{Error, Range, attempt, in_range};
use crate::law::coefficient::DirectionalCoefficient;
use crate::ranges;
use crate::stored::{Fingerprint, Port, Refusal, Stored};

pub use closed_form::CatalogueBall;
pub use configuration::{FoldedBall, UncagedBallScrewConfiguration};
pub use step::UncagedFriction;

/// A ball screw without cage, with up to `N` balls in one circuit: friction of the grooves and between balls, by the folded law of one ball, for
/// `NODES` friction coefficients.
///
/// Every ball is evaluated in every tick, at its position, under the load of this tick: nothing settles. The loads of the balls add up to the axial
/// load at every angle: a ball takes up its load, and gives it up, over a run-in of one pitch between load and return.
///
/// After a step whose speed or load is NaN or infinite, balls and the phase of the screw's deviations lag by its travel:
/// [`FrictionModel::set_nut_angle`](crate::FrictionModel::set_nut_angle) brings the phase back; the balls stay behind.
///
/// [`Faults::BEYOND_MODEL`] is set in each tick in which the torque is less accurate than the block's certificate says: where the ball that
/// carries most, or the friction coefficient, is beyond those for which the law was folded, where a ball is rubbed more than the law holds
/// ([`BallLaw::holds_rubbing`]), or where no ball is loaded. [`Faults::FORCES_NOT_HELD`] is set where balls press and the forces between them,
/// not the torque, are less accurate: under some load from that of the ball that carries least, the run-ins left out, to that of the one that
/// carries most.
///
/// A step reads from `scene/uncaged/step.rs`: what a ball does on its own in `ball/pressed/numbers.rs`, what its neighbours change in `ball/pressed/row.rs`, a tick
/// of all balls in `train/tick.rs`, which balls press in `train/pool.rs`, and how hard in `train/settle.rs`; `train.rs` has the words.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct UncagedBallScrew<const N: usize, const NODES: usize = 1>;

/// State of a ball screw without cage.
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

    fn constants(configuration: &Self::Configuration) -> Result<Self::Constants, Error> {
        UncagedConstants::new(configuration)
    }

    #[inline(always)]
    fn initial_state(constants: &Self::Constants) -> Self::State {
        UncagedState {
            circuit: CircuitState::new(&constants.circuit),
            friction: constants.friction,
            balls: [BallOfRow::UNLOADED; N],
        }
    }

    fn take_over(constants: &Self::Constants, state: &mut Self::State) -> Result<(), Error> {
        state.circuit.is_on(&constants.circuit)?;
        state.friction = constants.friction;
        Ok(())
    }

    #[inline(always)]
    fn step(
        constants: &Self::Constants,
        state: &mut Self::State,
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
    /// Checks a configuration and folds its constants.
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
        let (least, largest) = law.friction_range();
        attempt!(in_range("friction", friction, least, largest));
        attempt!(ranges::FRICTION_OR_NONE.checked("ball_friction", ball_friction));
        attempt!(in_range("lead", lead, 0.0, 0.2));
        let limits = attempt!(limits.checked());
        let circuit = attempt!(configuration.circuit(&limits, N));
        let [screw, nut] = law.deviations;
        attempt!(screw_deviation.checked("screw_deviation", screw));
        attempt!(nut_deviation.checked("nut_deviation", nut));
        let units = circuit.zone.units();
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

    /// These constants with other limits, of a calibration page.
    pub const fn with_limits(&self, limits: Limits) -> Result<Self, Error> {
        Ok(Self {
            limits: attempt!(limits.checked()),
            ..*self
        })
    }

    #[inline(always)]
    fn interval(&self, friction: f32) -> FrictionInterval {
        FrictionInterval::among(&self.law.frictions(), &self.node_octaves, friction)
    }

    #[inline(always)]
    const fn shares(&self, axial_load: f32) -> &'static [LoadShare] {
        self.circuit.zone.shares(axial_load < 0.0)
    }

    pub(crate) fn set_nut_angle(&self, state: &mut UncagedState<N>, angle: f32) {
        state.circuit.set_turns(&self.circuit, angle / TAU);
    }
}

impl<const N: usize, const NODES: usize> Sliding for UncagedBallScrew<N, NODES> {
    const FRICTION: Range = ranges::FRICTION_OF_A_ROW;

    const COUNTS_PRELOAD: bool = true;

    type Friction = UncagedFriction;

    #[inline(always)]
    fn check_inputs(constants: &Self::Constants, inputs: Inputs) -> CheckedInputs<Inputs> {
        constants.limits.check_inputs(inputs)
    }

    #[inline(always)]
    fn sliding_friction(
        constants: &Self::Constants,
        state: &mut Self::State,
        inputs: Inputs,
        friction: DirectionalCoefficient,
    ) -> UncagedFriction {
        state.friction = constants.interval(friction.of(inputs.nut_speed).0);
        let mut sliding = constants.friction_of_balls(state, inputs);
        sliding.row.ratios = friction.over_own(inputs.nut_speed);
        sliding
    }

    #[inline(always)]
    fn by_direction(sliding: &UncagedFriction) -> SlidingFriction {
        sliding.row.friction()
    }

    #[inline(always)]
    fn continue_from(sliding: &mut UncagedFriction, last: &UncagedFriction, travelled: f32) {
        sliding.row.continue_from(&last.row, travelled);
    }

    #[inline(always)]
    fn outputs_at(
        constants: &Self::Constants,
        inputs: Inputs,
        sliding: &UncagedFriction,
        reversal: ReversalState,
        drag: f32,
        faults: Faults,
    ) -> UncagedOutputs {
        let row = sliding.row.outputs_at(
            reversal,
            inputs.axial_load * constants.reduced_lead,
            drag,
            sliding.faults | faults,
            constants.limits.friction_torque,
        );
        UncagedOutputs {
            friction_torque: row.whole.friction_torque,
            groove_torque: row.groove,
            ball_torque: row.ball,
            load_torque: row.whole.load_torque,
            contacts: row.contacts,
            largest_contact_force: row.largest_contact_force,
            regime: row.whole.regime,
            faults: row.whole.faults,
        }
    }

    #[inline(always)]
    fn limited_travel(constants: &Self::Constants, turn: f32, _: f32) -> (f32, f32) {
        let turn = bounded(turn, constants.limits.nut_speed * constants.tick);
        (turn, turn * constants.per_tick)
    }
}

impl<const N: usize, const NODES: usize> ChangingFriction for UncagedBallScrew<N, NODES> {
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

impl<const N: usize, const NODES: usize> StoredScene for UncagedBallScrew<N, NODES> {
    const KIND: u16 = 6;
    const BALLS: u16 = N as u16;

    fn balls(state: &Self::State) -> u16 {
        state.circuit.train.balls() as u16
    }

    /// Not the friction coefficient: only its range has to fit, which [`Self::complete`] checks.
    fn fingerprint(constants: &Self::Constants, fingerprint: &mut Fingerprint) {
        constants.circuit.fingerprint(fingerprint);
        let per_ball = constants.circuit.per_loaded_ball();
        fingerprint.numbers(&[constants.reduced_lead, per_ball]);
    }

    fn complete(constants: &Self::Constants, state: &mut Self::State) -> Result<(), Refusal> {
        state.circuit.train.in_order()?;
        let friction = state.friction.friction();
        if constants.law.holds(friction) {
            state.friction = constants.interval(friction);
            Ok(())
        } else {
            Err(Refusal::OutOfRange { field: "friction" })
        }
    }
}

impl<const N: usize> Stored for UncagedState<N> {
    const BYTES: usize = CircuitState::<N>::BYTES + FrictionInterval::BYTES;

    fn exchange<P: Port>(&mut self, port: &mut P) -> Result<(), Refusal> {
        self.circuit.exchange(port)?;
        self.friction.exchange(port)?;
        self.balls = [BallOfRow::UNLOADED; N];
        Ok(())
    }
}

impl Stored for UncagedFriction {
    const BYTES: usize = TrainFriction::BYTES + Faults::BYTES;

    fn exchange<P: Port>(&mut self, port: &mut P) -> Result<(), Refusal> {
        self.row.exchange(port)?;
        self.faults.exchange(port)
    }
}
