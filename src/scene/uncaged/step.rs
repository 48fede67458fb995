//! What a tick computes: every ball at its position, then how they press.

use super::{UncagedConstants, UncagedState};
use crate::ball::pressed::{BallNumbers, FreeMotion};
use crate::scene::circuit::UNLOADED;
use crate::scene::contract::{Inputs, Regime};
use crate::scene::faults::Faults;
use crate::scene::outputs::UncagedOutputs;
use crate::scene::reversal::{ReversalState, direction};
use crate::scene::row::{TrainFriction, not_negative};
use crate::train::{Grip, Intake, LARGEST_GRIP, limited_grip};

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
    /// Load of a ball under the mean axial load, N.
    load: f32,
    /// 0 where the load opposes the motion, else 1.
    branch: usize,
    /// -1 where the nut turns backward, else 1.
    direction: f32,
    /// What a ball does under the mean load, its grip with the friction between balls; both its free speed and its grip with the sign of
    /// the direction.
    numbers: BallNumbers,
    /// Whether a train takes all of this grip, within the largest deviations.
    holds_grip: bool,
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
        let travel = self.circuit.travel(nut_speed);
        let mut balls = state.circuit.train.intake(travel);
        let torque = if self.even {
            let numbers = common.numbers;
            let motion = move |_, deviations| numbers.at(deviations);
            self.take_in(&mut balls, phase, axial_load, &common, motion)
        } else {
            let friction = state.friction;
            let motion = |share, deviations| {
                let load = self.law.load_of(common.mean * share);
                let motion = self.law.at(load, common.branch, friction, deviations);
                let grip = common.direction * self.ball_friction * motion.grip;
                FreeMotion {
                    speed: common.direction * motion.speed,
                    grip: limited_grip(grip),
                    ..motion
                }
            };
            self.take_in(&mut balls, phase, axial_load, &common, motion)
        };
        let pressing = balls.press_rubbing();
        state.circuit.advance(&self.circuit, nut_speed);

        let numbers = &common.numbers;
        let work = self.half_speed * numbers.work * pressing.work;
        let rubbing_force = self.ball_friction * pressing.force;
        let ball_torque = numbers.rubbing * rubbing_force;
        let most = self.law.load_of(self.heaviest * common.mean);
        let friction = state.friction;
        let load = common.load * self.balls;
        let held = self.law.holds_forces(common.load, common.branch, friction)
            && self.law.holds_load(most)
            && self.law.holds(friction.friction())
            && self.law.holds_rubbing(load, friction, rubbing_force)
            && common.holds_grip;
        UncagedFriction {
            row: TrainFriction {
                groove: not_negative(
                    torque + numbers.slope * common.direction * pressing.change + work,
                ),
                ball: ball_torque,
                free: not_negative(torque),
                ratios: [1.0; 2],
                fading: [0.0; 2],
                direction: common.direction,
                load,
                contacts: pressing.contacts,
                largest_contact_force: pressing.largest,
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
        let mut numbers = self.law.numbers(load, branch, state.friction);
        let [grip, screw, nut] = numbers.grip.map(f32::abs);
        let size = self.ball_friction * (grip + screw + nut);
        let holds_grip = size <= LARGEST_GRIP;
        let limited = if holds_grip { 1.0 } else { LARGEST_GRIP / size };
        let ball_friction = direction * self.ball_friction * limited;
        numbers.grip = numbers.grip.map(|grip| ball_friction * grip);
        numbers.free = numbers.free.map(|free| direction * free);
        Common {
            mean,
            load,
            branch,
            direction,
            numbers,
            holds_grip,
        }
    }

    /// Gives each ball its free speed and impedance, a loaded one by `motion` from its share of the load and its deviations; returns the sum of their
    /// torques, N m. Not inlined: what the rest of a step holds would take its registers.
    #[inline(never)]
    fn take_in(
        &self,
        balls: &mut Intake<'_, N>,
        phase: u32,
        axial_load: f32,
        common: &Common,
        motion: impl Fn(f32, [f32; 2]) -> FreeMotion,
    ) -> f32 {
        let Common {
            direction, numbers, ..
        } = common;
        let shares = self.shares(axial_load);
        let units = self.units.map(|unit| direction * unit);
        let idle = numbers.free[0];
        let mut torque = 0.0;
        while let Some(ball) = balls.next_ball() {
            let Some(loaded) = self.circuit.loaded_ball(ball.position(), phase, shares) else {
                ball.put_smooth(idle, UNLOADED);
                continue;
            };
            let deviations = [units[0] * loaded.passing, units[1] * loaded.recirculating];
            let motion = motion(loaded.load.share(), deviations);
            torque += motion.torque;
            let grip = Grip::within(motion.grip);
            ball.put_rubbed(motion.speed, motion.impedance, grip);
        }
        torque
    }
}
