//! A ball screw whose balls press on each other, by a law of one ball that was solved on a host.

mod block;
mod closed_form;
mod configuration;

use core::f32::consts::TAU;

use super::circuit::{Circuit, CircuitState, Sharing, UNLOADED};
use super::contract::{
    ChangingFriction, CheckedInputs, Faults, Inputs, Limits, Reversal, ReversalState, Scene,
    SceneOutputs as _, bounded, direction,
};
use super::outputs::{TrainFriction, UncagedOutputs, not_negative};
use super::sliding::{NO_DRAG, Sliding, SlidingFriction};
use super::stored::StoredScene;
use crate::ball::LoadShare;
use crate::ball::folded::FrictionInterval;
use crate::ball::pressed::{
    BallLaw, BallNumbers, BallOfRow, NeighbourLaw, PowerSums, PressedTorques, RowConstants,
};
use crate::error::{Error, Range, in_range};
use crate::law::coefficient::DirectionalCoefficient;
use crate::ranges;
use crate::stored::{Fingerprint, Port, Refusal, Stored};
use crate::train::{FreeBall, Neighbours};

pub use closed_form::CatalogueBall;
pub use configuration::{FoldedBall, UncagedBallScrewConfiguration};

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
/// A step reads from `scene/uncaged.rs`: what a ball does on its own in `ball/pressed/numbers.rs`, what its neighbours change in
/// `ball/pressed/row.rs`, a tick of all balls in `train/tick.rs`, which balls press and how hard in `train/pool.rs`; `train.rs` has the words.
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
        let sliding = constants.friction_of_balls(state, inputs, [1.0; 2]);
        let reversal = constants.reversal.at(inputs.nut_speed);
        Self::outputs_at(constants, inputs, &sliding, reversal, NO_DRAG, faults)
    }
}

/// Sliding friction of a ball screw without cage, in the direction in which its balls go.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct UncagedFriction {
    /// Its parts. `load`: the axial load, preload counted, N.
    row: TrainFriction,
    faults: Faults,
}

/// Numbers of a tick that are the same for all balls. Speeds and pushes are counted along the track.
struct Common {
    shares: &'static [LoadShare],
    /// Axial load of a ball whose weight is 1, N.
    mean: f32,
    /// Friction coefficient times the load of such a ball, N.
    sliding: f32,
    /// Friction of neighbours over `sliding`, by their force, 1/N.
    rubbing: f32,
    /// 0 where the load opposes the motion, else 1.
    branch: usize,
    /// -1 where the nut turns backward, else 1.
    direction: f32,
    /// What such a ball does alone, over `sliding`.
    numbers: BallNumbers,
    neighbours: NeighbourLaw,
}

impl Common {
    /// Friction of both neighbours of a ball over its friction coefficient times load; none in the return.
    #[inline(always)]
    fn rubbing(&self, ball: &BallOfRow, found: &Neighbours) -> Option<f32> {
        if ball.sliding.to_bits() == self.sliding.to_bits() {
            Some(found.rubbing * self.rubbing)
        } else if ball.sliding > 0.0 {
            Some(self.neighbours.rubbing(ball, found))
        } else {
            None
        }
    }
}

impl<const N: usize, const NODES: usize> UncagedConstants<N, NODES> {
    #[inline(always)]
    fn interval(&self, friction: f32) -> FrictionInterval {
        FrictionInterval::among(&self.law.frictions(), &self.node_octaves, friction)
    }

    pub(crate) fn set_nut_angle(&self, state: &mut UncagedState<N>, angle: f32) {
        state.circuit.set_turns(&self.circuit, angle / TAU);
    }

    /// Sliding friction in the direction of motion; moves the balls on by a tick. `ratios`: groove friction forward and backward, each over that in
    /// this direction.
    #[inline(always)]
    fn friction_of_balls(
        &self,
        state: &mut UncagedState<N>,
        inputs: Inputs,
        ratios: [f32; 2],
    ) -> UncagedFriction {
        let shares = self.circuit.zone.shares(inputs.axial_load < 0.0);
        let zone = &self.circuit.zone;
        let sharing = zone.sharing(state.circuit.train.positions(), shares);
        let common = self.common(state, inputs, &sharing, shares);
        let travel = self.circuit.travel(inputs.nut_speed);
        let alone = not_negative(self.take_in(state, &common, travel));
        if !zone.is_closed() {
            let train = &mut state.circuit.train;
            train.rub_in_part(|position| zone.part(position));
        }
        if self.row.ball_friction > 0.0 {
            refine(state, &common, travel);
        }
        let mut pressed = PressedTorques::default();
        let UncagedState { circuit, balls, .. } = state;
        let pressing = circuit.train.press(travel, true, |index, found| {
            if found.forces > 0.0
                && let Some(ball) = balls.get(index)
                && let Some(rubbing) = common.rubbing(ball, found)
            {
                common.neighbours.lose(ball, found, rubbing, &mut pressed);
            }
        });
        state.circuit.advance(&self.circuit, inputs.nut_speed);

        let extremes = sharing
            .extremes
            .map(|weight| self.law.load_of(common.mean * weight));
        let rubbing = self.row.ball_friction * pressed.largest;
        let held = sharing.weights > 0.0
            && self.law.holds_load(extremes[0])
            && self.law.holds(state.friction.friction())
            && self.law.holds_rubbing(rubbing, common.sliding);
        let forces_held = pressing.contacts == 0
            || self
                .law
                .holds_forces_within(extremes, common.branch, state.friction);
        UncagedFriction {
            row: TrainFriction {
                groove: not_negative(alone + pressed.groove),
                ball: not_negative(pressed.ball),
                free: alone,
                ratios,
                fading: [0.0; 2],
                direction: common.direction,
                load: inputs.axial_load.abs() + self.preload,
                contacts: pressing.contacts,
                largest_contact_force: self.row.normal * pressing.largest,
            },
            faults: Faults::NONE
                .with(!held, Faults::BEYOND_MODEL)
                .with(!forces_held, Faults::FORCES_NOT_HELD),
        }
    }

    #[inline(never)]
    fn common(
        &self,
        state: &UncagedState<N>,
        inputs: Inputs,
        sharing: &Sharing,
        shares: &'static [LoadShare],
    ) -> Common {
        let direction = direction(inputs.nut_speed);
        let mean = inputs.axial_load * sharing.per_weight;
        let branch = usize::from(direction * mean < 0.0);
        // Where all loaded balls are on a run-in, none carries as much.
        let [heaviest, _] = sharing.extremes;
        let weight = if heaviest < 1.0 { heaviest } else { 1.0 };
        let load = self.law.load_of(weight * mean);
        let mut numbers = self.law.per_sliding(load, branch, state.friction);
        let neighbours = self
            .law
            .neighbours(load, branch, state.friction, &numbers, self.row)
            .along(direction);
        numbers.free = numbers.free.map(|number| direction * number);
        let sliding = self.law.sliding(load, state.friction);
        Common {
            shares,
            mean,
            sliding,
            rubbing: self.row.ball_friction / sliding,
            branch,
            direction,
            numbers,
            neighbours,
        }
    }

    /// Takes in each ball, and keeps what it does alone under its part of the load with its deviations; returns the sum of the friction
    /// torques, N m.
    #[inline(never)]
    fn take_in(&self, state: &mut UncagedState<N>, common: &Common, travel: f32) -> f32 {
        let Common {
            numbers,
            neighbours,
            direction,
            ..
        } = common;
        let units = self.units.map(|unit| direction * unit);
        let rubs = self.row.ball_friction > 0.0;
        let phase = state.circuit.phase();
        let (mut alike, mut torque) = (PowerSums::default(), 0.0);
        let UncagedState {
            circuit,
            balls,
            friction,
        } = state;
        circuit.train.take_in(travel, |index, position| {
            let idle = FreeBall::smooth(numbers.free[0], UNLOADED);
            let Some(place) = balls.get_mut(index) else {
                return idle;
            };
            let Some(loaded) = self.circuit.zone.at(position, phase) else {
                *place = BallOfRow::UNLOADED;
                return idle;
            };
            let deviations = [units[0] * loaded.passing, units[1] * loaded.recirculating];
            let part = loaded.run_in;
            // Between the run-ins all balls of even loads are alike.
            let ball = if self.even && part == 1.0 {
                alike.add(deviations);
                let motion = numbers.at(deviations);
                BallOfRow {
                    speed: motion.speed,
                    impedance: motion.impedance,
                    sliding: common.sliding,
                    deviations,
                }
            } else {
                let share = self.circuit.zone.share(position, common.shares);
                let load = self.law.load_of(common.mean * share);
                let (ball, alone) = self
                    .law
                    .ball(load, common.branch, *friction, deviations, part);
                torque += alone;
                BallOfRow {
                    speed: direction * ball.speed,
                    ..ball
                }
            };
            *place = ball;
            if rubs {
                neighbours.first(&ball, part)
            } else {
                neighbours.smooth(&ball, part)
            }
        });
        torque + common.sliding * numbers.torque_of(&alike)
    }
}

/// The first pass of balls that rub: each is taken in anew by what it found.
#[inline(never)]
fn refine<const N: usize>(state: &mut UncagedState<N>, common: &Common, travel: f32) {
    let UncagedState { circuit, balls, .. } = state;
    circuit.train.refine(travel, |index, found| {
        let ball = balls.get(index)?;
        let rubbing = common.rubbing(ball, found)?;
        Some(common.neighbours.second(ball, found, rubbing))
    });
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
        constants.friction_of_balls(state, inputs, friction.over_own(inputs.nut_speed))
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
