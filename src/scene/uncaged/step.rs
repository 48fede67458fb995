//! What a tick computes: every ball at its position, then how they press.

use super::{UncagedConstants, UncagedState};
use crate::ball::LoadShare;
use crate::ball::pressed::{BallNumbers, BallOfRow, NeighbourLaw, Pressed};
use crate::scene::circuit::{LoadedBall, Sharing, UNLOADED};
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
    /// Axial load of a ball whose weight is 1, N.
    mean: f32,
    /// Friction coefficient times the load of such a ball, N.
    sliding: f32,
    /// 0 where the load opposes the motion, else 1.
    branch: usize,
    /// -1 where the nut turns backward, else 1.
    direction: f32,
    /// What such a ball does alone.
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

/// All balls before a step.
struct Row<'state, const N: usize> {
    balls: Intake<'state, N>,
    /// Phase of the screw's deviations.
    phase: u32,
    shares: &'static [LoadShare],
    /// Part of its load that the first ball carries, which is ahead of the last one.
    part_ahead: f32,
}

impl<const N: usize, const NODES: usize> UncagedConstants<N, NODES> {
    /// Sliding friction in the direction of motion; moves the balls on by a tick.
    #[inline(always)]
    pub(super) fn friction_of_balls(
        &self,
        state: &mut UncagedState<N>,
        inputs: Inputs,
    ) -> UncagedFriction {
        let nut_speed = inputs.nut_speed;
        let shares = self.shares(inputs.axial_load);
        let sharing = self.circuit.sharing(&state.circuit, shares);
        let common = self.common(state, inputs, &sharing);
        let friction = state.friction;
        let first = state.circuit.train.first_position();
        let row = Row {
            part_ahead: self.circuit.part(first),
            phase: state.circuit.phase(),
            balls: state.circuit.train.intake(self.circuit.travel(nut_speed)),
            shares,
        };
        let own = |ball: &LoadedBall, deviations| {
            let load = self.law.load_of(common.mean * ball.share);
            let (part, branch) = (ball.run_in, common.branch);
            BallOfRow {
                alone: match part {
                    1.0 => self.law.at(load, branch, friction, deviations),
                    _ => self.law.on_run_in(part, load, branch, friction, deviations),
                },
                sliding: self.law.sliding(load, friction),
                part,
                deviations,
            }
        };
        let (torques, row) = if self.even {
            // Between the run-ins all balls are alike; the few on them have loads of their own.
            let alike = |ball: &LoadedBall, deviations| match ball.run_in {
                1.0 => BallOfRow {
                    alone: common.numbers.at(deviations),
                    sliding: common.sliding,
                    part: 1.0,
                    deviations,
                },
                _ => own(ball, deviations),
            };
            self.press(row, &common, alike)
        } else {
            self.press(row, &common, own)
        };
        state.circuit.advance(&self.circuit, nut_speed);

        let extremes = sharing
            .extremes
            .map(|weight| self.law.load_of(common.mean * weight));
        let rubbing = self.row.ball_friction * row.largest_of_both;
        let held = sharing.weights > 0.0
            && self.law.holds_load(extremes[0])
            && self.law.holds(friction.friction())
            && self.law.holds_rubbing(rubbing, common.sliding);
        let forces_held = row.contacts == 0
            || self
                .law
                .holds_forces_within(extremes, common.branch, friction);
        let pressed = common.neighbours.numbers.outward_torque * row.forces + row.by_speed;
        let free = not_negative(torques.free);
        UncagedFriction {
            row: TrainFriction {
                groove: if row.contacts == 0 {
                    free
                } else {
                    not_negative(torques.free + torques.held + pressed)
                },
                ball: not_negative(row.by_rubbing),
                free,
                ratios: [1.0; 2],
                fading: [0.0; 2],
                direction: common.direction,
                load: inputs.axial_load.abs() + self.preload,
                contacts: row.contacts,
                largest_contact_force: self.row.normal * row.largest,
            },
            faults: Faults::NONE
                .with(!held, Faults::BEYOND_MODEL)
                .with(!forces_held, Faults::FORCES_NOT_HELD),
        }
    }

    #[inline(always)]
    fn common(&self, state: &UncagedState<N>, inputs: Inputs, sharing: &Sharing) -> Common {
        let direction = direction(inputs.nut_speed);
        let mean = inputs.axial_load * sharing.per_weight;
        let branch = usize::from(direction * mean < 0.0);
        // Where all loaded balls are on a run-in, none carries as much.
        let [heaviest, _] = sharing.extremes;
        let weight = if heaviest < 1.0 { heaviest } else { 1.0 };
        let load = self.law.load_of(weight * mean);
        let numbers = self.law.numbers(load, branch, state.friction);
        let neighbours = self
            .law
            .neighbours(load, branch, state.friction, &numbers, self.row);
        Common {
            mean,
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
        mut row: Row<'_, N>,
        common: &Common,
        of: impl Fn(&LoadedBall, [f32; 2]) -> BallOfRow,
    ) -> (Torques, RubbedRow) {
        let rub = self.row.ball_friction > 0.0;
        if rub {
            self.take_in(&mut row, common, &of, Pass::First);
            row.balls = row.balls.press_once();
        }
        let last = if rub { Pass::Second } else { Pass::Smooth };
        let torques = self.take_in(&mut row, common, &of, last);
        let losses = common
            .neighbours
            .losses(common.sliding, common.numbers.impedance[0]);
        let sums = row.balls.press_rubbing(&Losses {
            held_speed: common.direction * losses.held_speed,
            slope: common.direction * losses.slope,
            ..losses
        });
        (torques, sums)
    }

    /// Gives each ball its free speed and impedance in a pass, a loaded one by what it is under its part of the load with its deviations; returns the
    /// sums of their torques. Not inlined: what the rest of a step holds would take its registers.
    #[inline(never)]
    fn take_in(
        &self,
        row: &mut Row<'_, N>,
        common: &Common,
        of: &impl Fn(&LoadedBall, [f32; 2]) -> BallOfRow,
        pass: Pass,
    ) -> Torques {
        let &Common {
            direction,
            ref numbers,
            ref neighbours,
            ..
        } = common;
        let units = self.units.map(|unit| direction * unit);
        let idle = direction * numbers.free[0];
        let mut torques = Torques::default();
        let mut ahead = row.part_ahead;
        while let Some(ball) = row.balls.next_ball() {
            let loaded = self
                .circuit
                .loaded_ball(ball.position(), row.phase, row.shares);
            let Some(loaded) = loaded else {
                ball.put_smooth(idle, UNLOADED);
                ahead = 0.0;
                continue;
            };
            let deviations = [units[0] * loaded.passing, units[1] * loaded.recirculating];
            let own = of(&loaded, deviations);
            let (rubbed, held) = match pass {
                Pass::First => (neighbours.first(&own), 0.0),
                Pass::Second => {
                    let behind = self.circuit.part(ball.position_behind());
                    let parts = [behind, ahead].map(|part| lesser(part, own.part));
                    neighbours.second(
                        &own,
                        &Pressed {
                            forces: ball.forces(),
                            parts,
                            speed: direction * ball.speed(),
                        },
                    )
                }
                Pass::Smooth => neighbours.smooth(&own),
            };
            ahead = own.part;
            torques.free += own.alone.torque;
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

/// The lesser of two numbers.
#[inline(always)]
fn lesser(one: f32, other: f32) -> f32 {
    if one < other { one } else { other }
}
