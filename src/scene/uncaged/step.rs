//! A step of a ball screw without cage: every ball at its position, then how they press.

use super::{UncagedConstants, UncagedState};
use crate::ball::LoadShare;
use crate::ball::pressed::{BallNumbers, BallOfRow, NeighbourLaw, PowerSums, PressedTorques};
use crate::scene::circuit::{Sharing, UNLOADED};
use crate::scene::contract::{Inputs, direction};
use crate::scene::faults::Faults;
use crate::scene::sliding::{TrainFriction, not_negative};
use crate::train::{FreeBall, Neighbours};

/// Sliding friction of a ball screw without cage, in the direction in which its balls go.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct UncagedFriction {
    /// Its parts. `load`: the axial load, preload counted, N.
    pub(in crate::scene) row: TrainFriction,
    pub(in crate::scene) faults: Faults,
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
    /// Sliding friction in the direction of motion; moves the balls on by a tick.
    #[inline(always)]
    pub(super) fn friction_of_balls(
        &self,
        state: &mut UncagedState<N>,
        inputs: Inputs,
    ) -> UncagedFriction {
        let shares = self.shares(inputs.axial_load);
        let sharing = self.circuit.sharing(&state.circuit, shares);
        let common = self.common(state, inputs, &sharing, shares);
        let travel = self.circuit.travel(inputs.nut_speed);
        let alone = not_negative(self.take_in(state, &common, travel));
        if !self.circuit.zone.is_closed() {
            let train = &mut state.circuit.train;
            train.rub_in_part(|position| self.circuit.part(position));
        }
        if self.row.ball_friction > 0.0 {
            refine(state, &common, travel);
        }
        let mut pressed = PressedTorques::default();
        let UncagedState { circuit, balls, .. } = state;
        let pressing = circuit.train.press(travel, |index, found| {
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
                ratios: [1.0; 2],
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

    #[inline(always)]
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
                BallOfRow {
                    speed: numbers.speed(deviations),
                    impedance: numbers.impedance(deviations),
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
