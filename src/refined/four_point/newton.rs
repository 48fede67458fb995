//! Damped Newton steps on the dissipation.

use super::ball::FourPointBall;
use super::contacts::FourPointContacts;
use super::motion::{BallMotion, BallState, ContactMotion};
use crate::ranges;
use crate::refined::symmetric::{System, Vector};

/// Newton steps from the four-force start that [`FourPointBall::solve`] takes: three are enough for
/// loads under which contact angle deviations move the contacts by less than their own size.
pub const DEFAULT_NEWTON_STEPS: u8 = 5;

/// Longest Newton step, in units of the track speed, as the sum of its parts: contact spins are about
/// one half.
///
/// A bound for motions that no step led to: from [`FourPointBall::start`] no step is as long, and limits of 0.1 to 1e6 give
/// the same digits. Scans here and below: 300 random balls each of Lin 2019, Table 3.3, with side-force ratios up to 0.8,
/// from there to 1, and with a fiftieth of the load, against the least exact dissipation
/// (`host-tests/tests/balls/linear_ball.rs`), one constant at a time. That the chosen ones settle is shown by
/// `host-tests/tests/generators/refined_balls.rs` for 100 000 balls.
const STEP_LIMIT: f32 = 0.5;

/// Longest change of a contact's slip in one Newton step, over the slip it has and the slip at which its
/// velocity centre reaches the end of the ellipse. Friction saturates there: a step that reaches far beyond it,
/// or far through zero from beyond it, relies on a stiffness that is not there.
///
/// From 0.4 to 0.7 three steps leave 1.3e-5 of `v/2`; 0.2 leaves 7e-4, 0.8 1.2e-4, and from 1 on some balls never settle.
const REACH: f32 = 0.6;

/// Longest change of slip of a lost contact, which bounds no step.
const UNBOUNDED: f32 = 1e9;

/// Largest deviation from nominal rolling, in units of the track speed, as the sum of its parts; nominal
/// rolling itself is 7 at the steepest contact angle. A ball comes back from it in some 30 steps.
const LARGEST_MOTION: f32 = 16.0;

/// One Newton step before the neighbours' force is known.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(super) struct NewtonStep {
    /// Power loss at the motion before the step.
    power: f32,
    /// `(moments - g)` times the free step: twice what it takes from the dissipation.
    decrement: f32,
    /// Step without a force along the track.
    pub(super) free: Vector,
    /// Step per unit force along the track.
    pub(super) column: Vector,
    /// Longest changes of the contacts' slips.
    reach: [f32; 4],
}

impl NewtonStep {
    pub(super) const EMPTY: Self = Self {
        power: 0.0,
        decrement: 0.0,
        free: Vector::ZERO,
        column: Vector::ZERO,
        reach: [UNBOUNDED; 4],
    };
}

impl FourPointBall {
    /// Motion after the four-force start and [`DEFAULT_NEWTON_STEPS`] Newton steps, with no force from
    /// neighbours: what to set a ball to before the first tick.
    ///
    /// Near two-point rolling the exact speed jumps (see [`AnalyticLinearBall`](crate::ball::AnalyticLinearBall)).
    /// Angle deviations of the bottom groove up to 3 degrees: within 5e-6 of `v/2` up to 0.01 of the
    /// side-force ratio before the jump, within 8e-4 from 0.01 after it on, and in between off by up to the
    /// jump itself, 8e-3 per degree.
    ///
    /// Cost: 7300 modelled cycles, 10000 with a
    /// weak diagonal.
    #[must_use]
    pub fn solve(&self, contacts: &FourPointContacts) -> BallState {
        self.refine(contacts, &self.start(contacts), 0.0, DEFAULT_NEWTON_STEPS)
    }

    /// Motion after `steps` damped Newton steps from a known state; see [`FourPointBall::step`]. No more
    /// than ten are taken.
    #[must_use]
    pub fn refine(
        &self,
        contacts: &FourPointContacts,
        state: &BallState,
        axial_force: f32,
        steps: u8,
    ) -> BallState {
        let mut state = *state;
        for _ in 0..steps.min(10) {
            state = self.step(contacts, &state, axial_force);
        }
        state
    }

    /// Motion after one damped Newton step from a known state: what to do once a tick, from the last
    /// tick's state.
    ///
    /// The step solves the damped equations `(H + 1e-6 tr H) dy = axial_force - g` for gradient `g` and
    /// Hessian `H` of the dissipation, and is shortened so that no contact's slip changes by more than
    /// 0.6 of the slip it has and of the slip at which its friction saturates. That takes the place of a
    /// line search: the dissipation is not evaluated again, and the cost does not depend on the data.
    /// `axial_force`, N, is the net force of the neighbours in the direction of the track speed; NaN, or
    /// more than 1e7 N, counts as zero. A ball that no contact holds, or whose state was spoilt, starts
    /// again from nominal rolling as soon as its motion exceeds 16 track speeds.
    ///
    /// The state's compliance belongs to the start of the step, its drag to the end, to second order in
    /// the step. Cost with [`FourPointBall::contacts`]: 1450 modelled cycles, 26 more for every contact
    /// whose velocity centre lies outside its ellipse.
    #[inline]
    #[must_use]
    pub fn step(
        &self,
        contacts: &FourPointContacts,
        state: &BallState,
        axial_force: f32,
    ) -> BallState {
        let axial_force = counted(axial_force);
        let proposal = self.propose(contacts, state.motion, None);
        self.advance(contacts, state.motion, &proposal, axial_force, None)
    }

    /// The Newton step at a motion, with moments `(roll, yaw)` of the neighbours' friction over the ball
    /// radius, N.
    #[inline(always)]
    pub(super) fn propose(
        &self,
        contacts: &FourPointContacts,
        motion: BallMotion,
        moments: Option<(f32, f32)>,
    ) -> NewtonStep {
        let mut power = 0.0;
        let mut reach = [UNBOUNDED; 4];
        let mut system = System::EMPTY;
        let grooves = contacts.contact.iter().zip(self.grooves());
        for ((contact, groove), reach) in grooves.zip(&mut reach) {
            // A lost contact has no ellipse.
            if contact.friction > 0.0 {
                let ContactMotion { slip, spin } = contact.motion(motion);
                let (arm_roll, arm_yaw) = contact.arm;
                let weight = contact.friction;
                let at = groove
                    .map
                    .dissipation(slip, spin, contact.semi_major, self.stick_spin);
                power += weight * at.power;
                *reach = REACH * (at.end_speed + slip.abs());

                let (force, moment) = (weight * at.force, weight * at.moment);
                system.right.roll -= force * arm_roll + moment * arm_yaw;
                system.right.yaw -= force * arm_yaw - moment * arm_roll;
                system.right.speed -= force;
                system.add_slip(
                    weight * at.stiffness,
                    arm_roll - at.tilt * arm_yaw,
                    arm_yaw + at.tilt * arm_roll,
                );
                system.add_spin(weight * at.stick, arm_yaw, -arm_roll);
            }
        }
        if let Some((roll, yaw)) = moments {
            system.right.roll += roll;
            system.right.yaw += yaw;
        }
        let factors = system.factors();
        let free = factors.solve(system.right);
        NewtonStep {
            power,
            decrement: system.right.dot(free),
            free,
            column: factors.speed_column(),
            reach,
        }
    }

    /// Takes a Newton step under the net force of the neighbours.
    #[inline(always)]
    pub(super) fn advance(
        &self,
        contacts: &FourPointContacts,
        motion: BallMotion,
        proposal: &NewtonStep,
        axial_force: f32,
        moments: Option<(f32, f32)>,
    ) -> BallState {
        let NewtonStep {
            power,
            decrement,
            free,
            column,
            reach,
        } = proposal;
        let roll = free.roll + axial_force * column.roll;
        let yaw = free.yaw + axial_force * column.yaw;
        let speed = free.speed + axial_force * column.speed;

        let scale = scale(contacts, reach, &BallMotion { speed, roll, yaw });
        let motion = BallMotion {
            speed: motion.speed + scale * speed,
            roll: motion.roll + scale * roll,
            yaw: motion.yaw + scale * yaw,
        };

        // A motion that no ball can have is not carried into the next tick.
        let size = motion.speed.abs() + motion.roll.abs() + motion.yaw.abs();
        // True for NaN, too.
        if !(size <= LARGEST_MOTION) {
            return BallState::NOMINAL;
        }

        // With the whole step dy and all outer forces Q: H dy = Q - g, so that the loss changes by
        // scale g dy + scale²/2 (Q - g) dy.
        let pull = decrement + axial_force * (2.0 * free.speed + axial_force * column.speed);
        let work = axial_force * speed;
        let work = moments.map_or(work, |(along_roll, along_yaw)| {
            work + (along_roll * roll + along_yaw * yaw)
        });
        let friction_force = power + scale * (work - (1.0 - 0.5 * scale) * pull);
        BallState {
            motion,
            speed_deviation: self.speed_deviation(motion.speed),
            compliance: self.speed_deviation(column.speed),
            friction_force: larger(friction_force, 0.0),
        }
    }
}

/// Part of a step that is taken: the least of 1 and of all ratios allowed/wanted; compared by cross-multiplication, divided once at
/// the end.
#[inline(always)]
fn scale<'a>(
    contacts: &FourPointContacts,
    reaches: impl IntoIterator<Item = &'a f32>,
    step: &BallMotion,
) -> f32 {
    let &BallMotion { speed, roll, yaw } = step;
    let length = roll.abs() + yaw.abs() + speed.abs();
    let (mut allowed, mut wanted) = if length > STEP_LIMIT {
        (STEP_LIMIT, length)
    } else {
        (1.0, 1.0)
    };
    for (contact, &reach) in contacts.contact.iter().zip(reaches) {
        let (arm_roll, arm_yaw) = contact.arm;
        let change = (speed + arm_roll * roll + arm_yaw * yaw).abs();
        if allowed * change > wanted * reach {
            (allowed, wanted) = (reach, change);
        }
    }
    allowed / wanted
}

#[inline]
fn larger(first: f32, second: f32) -> f32 {
    if first > second { first } else { second }
}

/// A force up to that of [`ranges::LOAD`] in size; beyond it, or NaN, 0.
#[inline]
fn counted(force: f32) -> f32 {
    if force.abs() <= ranges::LOAD.maximum {
        force
    } else {
        0.0
    }
}
