//! What a tick computes: every ball at its position, then how they press.

use super::{UncagedConstants, UncagedState};
use crate::ball::LoadShare;
use crate::ball::folded::FrictionInterval;
use crate::ball::pressed::{BallNumbers, FreeMotion};
use crate::scene::circuit::{LoadedBall, Sharing, UNLOADED};
use crate::scene::contract::{Inputs, Regime};
use crate::scene::faults::Faults;
use crate::scene::outputs::UncagedOutputs;
use crate::scene::reversal::{ReversalState, direction};
use crate::scene::row::TrainFriction;
use crate::train::{Grip, Intake, limited_grip};

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
        let (groove_torque, ball_torque) = self.row.outputs_at(reversal);
        UncagedOutputs {
            friction_torque: groove_torque + ball_torque,
            groove_torque,
            ball_torque,
            load_torque,
            contacts: self.row.contacts,
            largest_contact_force: self.row.largest_contact_force,
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
    /// 0 where the load opposes the motion, else 1.
    branch: usize,
    /// -1 where the nut turns backward, else 1.
    direction: f32,
    /// What a ball does under the mean load, its grip with the friction between balls; both its free speed and its grip with the sign of
    /// the direction.
    numbers: BallNumbers,
}

/// What the balls are that were taken in.
struct Intaken {
    /// Sum of their torques, N m.
    torque: f32,
    /// Whether a train took less grip of some ball than friction between balls makes of it.
    cut: bool,
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
        let phase = state.circuit.phase();
        let travel = self.circuit.travel(nut_speed);
        let mut balls = state.circuit.train.intake(travel);
        let friction = state.friction;
        let of_own =
            |ball: &LoadedBall, deviations| self.motion(&common, friction, ball, deviations);
        let Intaken { torque, cut } = if self.even {
            let numbers = common.numbers;
            // Between the run-ins all balls are alike; the few on them have loads of their own.
            let motion = |ball: &LoadedBall, deviations| match ball.run_in {
                1.0 => numbers.at(deviations),
                _ => of_own(ball, deviations),
            };
            self.take_in(&mut balls, phase, shares, &common, motion)
        } else {
            self.take_in(&mut balls, phase, shares, &common, of_own)
        };
        let pressing = balls.press_rubbing();
        state.circuit.advance(&self.circuit, nut_speed);

        let numbers = &common.numbers;
        let change = numbers.slope * common.direction * pressing.change;
        let work = self.half_speed * numbers.work * pressing.work;
        let force = self.circuit.rubbing(&state.circuit, pressing.force);
        let rubbing_force = self.ball_friction * force;
        let ball_torque = numbers.rubbing * rubbing_force;
        let load = inputs.axial_load.abs() + self.preload;
        let extremes = sharing
            .extremes
            .map(|weight| self.law.load_of(common.mean * weight));
        let held = sharing.weights > 0.0
            && self.law.holds_load(extremes[0])
            && self.law.holds(friction.friction())
            && self.law.holds_rubbing(load, friction, rubbing_force);
        let forces_held = pressing.contacts == 0
            || (!cut
                && self
                    .law
                    .holds_forces_within(extremes, common.branch, friction));
        UncagedFriction {
            row: TrainFriction {
                groove: not_negative(torque + change + work),
                ball: ball_torque,
                ratios: [1.0; 2],
                load,
                contacts: pressing.contacts,
                largest_contact_force: pressing.largest,
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
        let mut numbers = self.law.numbers(load, branch, state.friction);
        let ball_friction = direction * self.ball_friction;
        numbers.grip = numbers.grip.map(|grip| ball_friction * grip);
        numbers.free = numbers.free.map(|free| direction * free);
        Common {
            mean,
            branch,
            direction,
            numbers,
        }
    }

    /// What a ball does under its own load, its free speed and its grip with the sign of the direction.
    #[inline(always)]
    fn motion(
        &self,
        common: &Common,
        friction: FrictionInterval,
        ball: &LoadedBall,
        deviations: [f32; 2],
    ) -> FreeMotion {
        let load = self.law.load_of(common.mean * ball.share);
        let (part, branch) = (ball.run_in, common.branch);
        let law = self.law;
        let motion = match part {
            1.0 => law.at(load, branch, friction, deviations),
            _ => law.on_run_in(part, load, branch, friction, deviations),
        };
        FreeMotion {
            speed: common.direction * motion.speed,
            // As friction between balls does that of the grooves, it sets in with the load.
            grip: common.direction * self.ball_friction * (part * motion.grip),
            ..motion
        }
    }

    /// Gives each ball its free speed and impedance, a loaded one by `motion` from its part of the load and its deviations. Not inlined: what
    /// the rest of a step holds would take its registers.
    #[inline(never)]
    fn take_in(
        &self,
        balls: &mut Intake<'_, N>,
        phase: u32,
        shares: &'static [LoadShare],
        common: &Common,
        motion: impl Fn(&LoadedBall, [f32; 2]) -> FreeMotion,
    ) -> Intaken {
        let Common {
            direction, numbers, ..
        } = common;
        let units = self.units.map(|unit| direction * unit);
        let idle = numbers.free[0];
        let mut intaken = Intaken {
            torque: 0.0,
            cut: false,
        };
        while let Some(ball) = balls.next_ball() {
            let Some(loaded) = self.circuit.loaded_ball(ball.position(), phase, shares) else {
                ball.put_smooth(idle, UNLOADED);
                continue;
            };
            let deviations = [units[0] * loaded.passing, units[1] * loaded.recirculating];
            let motion = motion(&loaded, deviations);
            intaken.torque += motion.torque;
            let grip = limited_grip(motion.grip);
            intaken.cut |= grip != motion.grip;
            ball.put_rubbed(motion.speed, motion.impedance, Grip::within(grip));
        }
        intaken
    }
}

/// A torque, or none where it is below zero.
#[inline(always)]
fn not_negative(torque: f32) -> f32 {
    if torque > 0.0 { torque } else { 0.0 }
}
