//! What a tick computes: every ball at its position, then how they press.

use super::{UncagedConstants, UncagedState};
use crate::ball::LoadShare;
use crate::ball::folded::FrictionInterval;
use crate::ball::pressed::{BallNumbers, BallOfRow, NeighbourLaw, Pressed};
use crate::scene::circuit::{LoadedBall, Sharing, UNLOADED};
use crate::scene::contract::{Inputs, direction};
use crate::scene::faults::Faults;
use crate::scene::sliding::{TrainFriction, not_negative};
use crate::train::{Intake, Losses, RubbedBall, RubbedRow};

/// Sliding friction of a ball screw without cage, in the direction in which its balls go.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct UncagedFriction {
    /// Its parts. `load`: the axial load, preload counted, N.
    pub(in crate::scene) row: TrainFriction,
    pub(in crate::scene) faults: Faults,
}

/// What all balls have in common in a tick.
struct Common {
    /// Axial load of a ball whose weight is 1, N.
    mean: f32,
    /// Friction coefficient times the load of such a ball, N, and 1 / it.
    sliding: f32,
    per_sliding: f32,
    /// 0 where the load opposes the motion, else 1.
    branch: usize,
    /// -1 where the nut turns backward, else 1.
    direction: f32,
    /// Friction coefficient of ball and groove.
    friction: FrictionInterval,
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

/// A look at all balls: the first one of balls that rub, the second one, and the only one of balls that do not.
const FIRST: u8 = 0;
const SECOND: u8 = 1;
const SMOOTH: u8 = 2;

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
        let (torques, row) = self.press(row, &common);
        state.circuit.advance(&self.circuit, nut_speed);

        let [most, least] = sharing.extremes;
        let extremes = [
            self.law.load_of(common.mean * most),
            self.law.load_of(common.mean * least),
        ];
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

    /// A ball under a load of its own, or with a part of its load on a run-in.
    #[inline(never)]
    fn ball_of_own(&self, common: &Common, ball: &LoadedBall, deviations: [f32; 2]) -> BallOfRow {
        let &Common {
            branch, friction, ..
        } = common;
        let load = self.law.load_of(common.mean * ball.share);
        let sliding = self.law.sliding(load, friction);
        let part = ball.run_in;
        BallOfRow {
            alone: match part {
                1.0 => self.law.at(load, branch, friction, deviations),
                _ => self.law.on_run_in(part, load, branch, friction, deviations),
            },
            sliding,
            per_sliding: 1.0 / sliding,
            part,
            deviations,
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
        let sliding = self.law.sliding(load, state.friction);
        Common {
            mean,
            sliding,
            per_sliding: 1.0 / sliding,
            branch,
            direction,
            friction: state.friction,
            numbers,
            neighbours,
        }
    }

    /// How balls press, in two passes where they rub; and the sums of their torques.
    #[inline(always)]
    fn press(&self, mut row: Row<'_, N>, common: &Common) -> (Torques, RubbedRow) {
        let torques = if self.row.ball_friction > 0.0 {
            self.take_in::<FIRST>(&mut row, common);
            row.balls = row.balls.press_once();
            self.take_in::<SECOND>(&mut row, common)
        } else {
            self.take_in::<SMOOTH>(&mut row, common)
        };
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
    fn take_in<const PASS: u8>(&self, row: &mut Row<'_, N>, common: &Common) -> Torques {
        let &Common {
            direction,
            ref numbers,
            ref neighbours,
            ..
        } = common;
        let units = [direction * self.units[0], direction * self.units[1]];
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
            // Between the run-ins all balls of even loads are alike.
            let own = if self.even && loaded.run_in == 1.0 {
                BallOfRow {
                    alone: numbers.at(deviations),
                    sliding: common.sliding,
                    per_sliding: common.per_sliding,
                    part: 1.0,
                    deviations,
                }
            } else {
                self.ball_of_own(common, &loaded, deviations)
            };
            let (rubbed, held) = match PASS {
                FIRST => (neighbours.first(&own), 0.0),
                SECOND => {
                    let behind = self.circuit.part(ball.position_behind());
                    let parts = [lesser(behind, own.part), lesser(ahead, own.part)];
                    neighbours.second(
                        &own,
                        &Pressed {
                            forces: ball.forces(),
                            parts,
                            speed: direction * ball.speed(),
                        },
                    )
                }
                _ => neighbours.smooth(&own),
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
