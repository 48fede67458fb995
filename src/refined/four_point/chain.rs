//! Balls that press on each other: one Newton step of all of them.

use super::ball::FourPointBall;
use super::contacts::FourPointContacts;
use super::motion::{BallMotion, BallState};
use super::newton::NewtonStep;
use crate::math;
use crate::refined::pressing::{impedance_of, pressed};
use crate::train::Press;

/// `N` balls in a row and the forces between them, kept from step to step.
///
/// Most of its memory are the equations between the two halves of a step and the scratch of the pressing: they stand
/// here, in the caller's memory, and not on the stack of an interrupt.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct BallChain<const N: usize> {
    /// The balls, from rear to front in the direction of positive track speed.
    pub balls: [BallState; N],
    /// Force between every ball and the next one, N, at least zero; the last one acts between the last
    /// ball and the first.
    pub forces: [f32; N],
    speed_deviations: [f32; N],
    impedances: [f32; N],
    press: Press<N>,
    moments: [(f32, f32); N],
    proposals: [NewtonStep; N],
}

impl<const N: usize> BallChain<N> {
    /// Balls in nominal rolling, without forces between them.
    #[must_use]
    pub const fn new() -> Self {
        Self {
            balls: [BallState::NOMINAL; N],
            forces: [0.0; N],
            speed_deviations: [0.0; N],
            impedances: [0.0; N],
            press: Press::new(),
            moments: [(0.0, 0.0); N],
            proposals: [NewtonStep::EMPTY; N],
        }
    }
}

impl<const N: usize> Default for BallChain<N> {
    fn default() -> Self {
        Self::new()
    }
}

impl FourPointBall {
    /// One damped Newton step of `N` balls in a row, with the forces between them.
    ///
    /// Every ball's equations give the speed deviation it would take on its own, and a compliance;
    /// [`Press`] turns them into the contact forces under which no ball overtakes the one in front of it, and with
    /// these the balls then take their steps. `room[j]` is the speed deviation, at least zero, at which ball `j` may
    /// run up to the one in front: zero where they touch, infinite where nothing is in front. The last one belongs to
    /// the last ball and the first; it is infinite unless the track is a full ring.
    ///
    /// Returns whether every ball's speed counts (see [`Press::solve`]); where not, no ball presses.
    ///
    /// Friction between the balls, with coefficient `ball_friction` (Lin 2019, eqs. (3.26)-(3.29), (3.31)), lags
    /// one step behind: it uses the forces that the chain holds on entry.
    ///
    /// Largest error of the force between two balls after one, two and three steps from
    /// [`FourPointBall::start`], side-force ratios up to 0.8 in opposite directions, contact angle
    /// deviations up to 3 degrees, forces up to 10 N: 0.16, 0.017 and 0.0013 N without, 0.45, 0.026 and
    /// 0.003 N with friction between the balls (0.6 N for the published formula). Up to a ratio of 0.9,
    /// next to two-point rolling: 0.4, 0.04, 0.1 N, and 0.8, 0.25, 0.19 N with friction between the
    /// balls, which does not settle there, because it lags behind. Cost of two balls with their
    /// [`FourPointBall::contacts`]: 2080 modelled cycles a ball and step.
    ///
    /// `direction` is the sign of the track speed, or a number between -1 and 1 that passes smoothly
    /// through standstill, such as `v/sqrt(v² + v_s²)`: the forces vary with its size, and vanish with
    /// it, because at rest Coulomb friction leaves them undefined. Below zero the rear ball presses where
    /// it is the slower one in `(1 + epsilon) v/2`. NaN counts as zero.
    pub fn refine_chain<const N: usize>(
        &self,
        contacts: &[FourPointContacts; N],
        chain: &mut BallChain<N>,
        room: &[f32; N],
        direction: f32,
        ball_friction: f32,
    ) -> bool {
        let direction = if direction.is_nan() { 0.0 } else { direction };
        let BallChain {
            balls: states,
            forces,
            speed_deviations,
            impedances,
            press,
            moments,
            proposals,
        } = chain;
        self.ball_friction_moments(states, forces, ball_friction, moments);

        let given = contacts.iter().zip(states.iter()).zip(moments.iter());
        let found = speed_deviations
            .iter_mut()
            .zip(impedances.iter_mut())
            .zip(proposals.iter_mut());
        for (((contacts, state), moments), ((free, impedance), proposal)) in given.zip(found) {
            *proposal = self.propose(contacts, state.motion, Some(*moments));
            *free = direction * self.speed_deviation(state.motion.speed + proposal.free.speed);
            *impedance = impedance_of(self.speed_deviation(proposal.column.speed));
        }

        let sound = pressed(press, speed_deviations, impedances, room, forces);

        let sign = if direction < 0.0 { -1.0 } else { 1.0 };
        let mut behind = forces.last().copied().unwrap_or(0.0);
        let given = contacts.iter().zip(proposals.iter()).zip(moments.iter());
        for (state, (((contacts, proposal), moments), &ahead)) in
            states.iter_mut().zip(given.zip(forces.iter()))
        {
            let net = sign * (behind - ahead);
            *state = self.advance(contacts, state.motion, proposal, net, Some(*moments));
            behind = ahead;
        }
        sound
    }

    /// Power loss between the balls over the track speed, N (Lin 2019, eq. (3.28)).
    #[must_use]
    pub fn ball_friction_force<const N: usize>(
        &self,
        chain: &BallChain<N>,
        ball_friction: f32,
    ) -> f32 {
        let BallChain {
            balls: states,
            forces,
            ..
        } = chain;
        let mut sum = 0.0;
        for ((rear, front), &force) in states.iter().zip(states.iter().cycle().skip(1)).zip(forces)
        {
            if force > 0.0 {
                sum += force * self.rubbing_speed(&rear.motion, &front.motion);
            }
        }
        ball_friction * sum
    }

    /// Speed with which two touching balls rub, in units of the track speed (Lin 2019, eq. (3.26)).
    ///
    /// Balls that roll alike rub with `1/cos(contact angle)`, eq. (3.52).
    #[must_use]
    pub fn rubbing_speed(&self, rear: &BallMotion, front: &BallMotion) -> f32 {
        let (roll, yaw) = self.rubbing(rear, front);
        math::sqrt(roll * roll + yaw * yaw)
    }

    /// Sum of two balls' rotations times the ball radius: the velocity of their touching surfaces against each other.
    #[inline]
    fn rubbing(&self, rear: &BallMotion, front: &BallMotion) -> (f32, f32) {
        (
            2.0 * self.nominal_roll() + rear.roll + front.roll,
            rear.yaw + front.yaw,
        )
    }

    /// Moments over ball radius by which neighbours brake each ball's rotation, N.
    #[inline]
    fn ball_friction_moments<const N: usize>(
        &self,
        states: &[BallState; N],
        forces: &[f32; N],
        ball_friction: f32,
        moments: &mut [(f32, f32); N],
    ) {
        let mut behind = (0.0, 0.0);
        let fronts = states.iter().cycle().skip(1);
        for (((moment, rear), front), &force) in
            moments.iter_mut().zip(states).zip(fronts).zip(forces)
        {
            // The moment on both balls is the same: from one to the other both the force and its arm change sign.
            let ahead = self.rubbing_moment(&rear.motion, &front.motion, ball_friction * force);
            *moment = (behind.0 + ahead.0, behind.1 + ahead.1);
            behind = ahead;
        }
        if let Some(moment) = moments.first_mut() {
            *moment = (moment.0 + behind.0, moment.1 + behind.1);
        }
    }

    #[inline]
    fn rubbing_moment(&self, rear: &BallMotion, front: &BallMotion, friction: f32) -> (f32, f32) {
        if friction > 0.0 {
            let (roll, yaw) = self.rubbing(rear, front);
            // Balls that roll rub with more than the track speed. The small number keeps the root from zero for
            // motions that a caller has set.
            let size = friction / math::sqrt(roll * roll + yaw * yaw + 1e-12);
            (-size * roll, -size * yaw)
        } else {
            (0.0, 0.0)
        }
    }
}
