//! What a tick computes: every ball at its position, then how they press.

use super::{UncagedConstants, UncagedState};
use crate::ball::pressed::{BallNumbers, LoadedBall, NeighbourLaw, Pressed};
use crate::scene::circuit::UNLOADED;
use crate::scene::contract::{Inputs, Regime};
use crate::scene::faults::Faults;
use crate::scene::outputs::UncagedOutputs;
use crate::scene::reversal::{ReversalState, direction};
use crate::scene::row::{TrainFriction, not_negative};
use crate::train::{Intake, Losses, RubbedBall, RubbedRow};

/// Sliding friction of a ball screw without cage, in the direction in which its balls go.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct UncagedFriction {
    /// Its parts. `load`: the axial load, preload counted, N.
    pub(in crate::scene) row: TrainFriction,
    pub(in crate::scene) faults: Faults,
}

impl UncagedFriction {
    /// The outputs under a load that is held by this torque, N m.
    #[inline(always)]
    pub(in crate::scene) fn outputs_at(
        &self,
        load_torque: f32,
        reversal: ReversalState,
    ) -> UncagedOutputs {
        let row = self.row.outputs_at(reversal);
        UncagedOutputs {
            friction_torque: row.groove + row.ball,
            groove_torque: row.groove,
            ball_torque: row.ball,
            load_torque,
            contacts: row.contacts,
            largest_contact_force: row.largest_contact_force,
            regime: Regime::under(
                reversal.standing,
                reversal.direction * load_torque,
                self.row.of(reversal.direction),
            ),
            faults: self.faults,
        }
    }
}

/// What all balls have in common in a tick.
struct Common {
    /// Mean axial load of a ball, N.
    mean: f32,
    /// Load of a ball under the mean axial load, N, and friction coefficient times it.
    load: f32,
    sliding: f32,
    /// 0 where the load opposes the motion, else 1.
    branch: usize,
    /// -1 where the nut turns backward, else 1.
    direction: f32,
    /// What a ball does alone under the mean load.
    numbers: BallNumbers,
    /// What neighbours change in it.
    neighbours: NeighbourLaw,
}

/// Friction torques of all balls that a look at them adds up, N m.
#[derive(Clone, Copy, Default)]
struct Torques {
    /// Alone, at their free speeds.
    free: f32,
    /// What they are more at the held speed, with what deviations change of the torque that rubbing adds.
    held: f32,
}

/// A look at all balls.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Pass {
    /// The first one of balls that rub.
    First,
    /// The second one.
    Second,
    /// The only one of balls that do not rub.
    Smooth,
}

impl<const N: usize, const NODES: usize> UncagedConstants<N, NODES> {
    /// Sliding friction in the direction of motion; moves the balls on by a tick.
    #[inline(always)]
    pub(super) fn friction_of_balls(
        &self,
        state: &mut UncagedState<N>,
        inputs: Inputs,
    ) -> UncagedFriction {
        let Inputs {
            nut_speed,
            axial_load,
        } = inputs;
        let common = self.common(state, inputs);
        let phase = state.circuit.phase();
        let friction = state.friction;
        let balls = state.circuit.train.intake(self.circuit.travel(nut_speed));
        let (torque, row) = if self.even {
            let alone = |_, deviations| LoadedBall {
                alone: common.numbers.at(deviations),
                sliding: common.sliding,
                deviations,
            };
            self.press(balls, phase, axial_load, &common, alone)
        } else {
            let alone = |share, deviations| {
                let load = self.law.load_of(common.mean * share);
                LoadedBall {
                    alone: self.law.at(load, common.branch, friction, deviations),
                    sliding: self.law.sliding(load, friction),
                    deviations,
                }
            };
            self.press(balls, phase, axial_load, &common, alone)
        };
        state.circuit.advance(&self.circuit, nut_speed);

        let most = self.law.load_of(self.heaviest * common.mean);
        let rubbing = self.row.ball_friction * row.largest_of_both;
        let held = self.law.holds_forces(common.load, common.branch, friction)
            && self.law.holds_load(most)
            && self.law.holds(friction.friction())
            && self.law.holds_rubbing(rubbing, common.sliding);
        let outward = common.neighbours.numbers.outward_torque * row.forces;
        UncagedFriction {
            row: TrainFriction {
                groove: not_negative(torque.free + torque.held + row.by_speed + outward),
                ball: not_negative(row.by_rubbing),
                free: not_negative(torque.free),
                ratios: [1.0; 2],
                fading: [0.0; 2],
                direction: common.direction,
                load: common.load * self.balls,
                contacts: row.contacts,
                largest_contact_force: row.largest,
            },
            faults: Faults::NONE.with(!held, Faults::BEYOND_MODEL),
        }
    }

    #[inline(always)]
    fn common(&self, state: &UncagedState<N>, inputs: Inputs) -> Common {
        let direction = direction(inputs.nut_speed);
        let mean = inputs.axial_load * self.per_ball;
        let branch = usize::from(direction * mean < 0.0);
        let load = self.law.load_of(mean);
        let numbers = self.law.numbers(load, branch, state.friction);
        let neighbours = self
            .law
            .neighbours(load, branch, state.friction, &numbers, self.row);
        Common {
            mean,
            load,
            sliding: self.law.sliding(load, state.friction),
            branch,
            direction,
            numbers,
            neighbours,
        }
    }

    /// How balls press, in two passes where they rub; and the sums of their torques.
    #[inline(always)]
    fn press(
        &self,
        mut balls: Intake<'_, N>,
        phase: u32,
        axial_load: f32,
        common: &Common,
        alone: impl Fn(f32, [f32; 2]) -> LoadedBall,
    ) -> (Torques, RubbedRow) {
        let rub = self.row.ball_friction > 0.0;
        if rub {
            self.take_in(&mut balls, phase, axial_load, common, &alone, Pass::First);
            balls = balls.press_once();
        }
        let last = if rub { Pass::Second } else { Pass::Smooth };
        let torque = self.take_in(&mut balls, phase, axial_load, common, &alone, last);
        let losses = common
            .neighbours
            .losses(common.sliding, common.numbers.impedance[0]);
        let row = balls.press_rubbing(&Losses {
            held_speed: common.direction * losses.held_speed,
            ..losses
        });
        (torque, row)
    }

    /// Gives each ball its free speed and impedance in a pass, a loaded one by what it does `alone` with its share of the load and its deviations;
    /// returns the sums of their torques. Not inlined: what the rest of a step holds would take its registers.
    #[inline(never)]
    fn take_in(
        &self,
        balls: &mut Intake<'_, N>,
        phase: u32,
        axial_load: f32,
        common: &Common,
        alone: &impl Fn(f32, [f32; 2]) -> LoadedBall,
        pass: Pass,
    ) -> Torques {
        let &Common {
            direction,
            ref numbers,
            ref neighbours,
            ..
        } = common;
        let shares = self.shares(axial_load);
        let units = self.units.map(|unit| direction * unit);
        let idle = direction * numbers.free[0];
        let mut torques = Torques::default();
        while let Some(ball) = balls.next_ball() {
            let Some(loaded) = self.circuit.loaded_ball(ball.position(), phase, shares) else {
                ball.put_smooth(idle, UNLOADED);
                continue;
            };
            let deviations = [units[0] * loaded.passing, units[1] * loaded.recirculating];
            let alone = alone(loaded.load.share(), deviations);
            let (rubbed, held) = match pass {
                Pass::First => (neighbours.first(&alone), 0.0),
                Pass::Second => neighbours.second(
                    &alone,
                    Pressed {
                        forces: ball.forces(),
                        speed: direction * ball.speed(),
                    },
                ),
                Pass::Smooth => neighbours.smooth(&alone),
            };
            torques.free += alone.alone.torque;
            torques.held += held;
            ball.put_rubbed(&RubbedBall {
                speed: direction * rubbed.speed,
                grip: direction * rubbed.grip,
                torque_slope: direction * rubbed.torque_slope,
                ..rubbed
            });
        }
        torques
    }
}
