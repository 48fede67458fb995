//! Balls of a ball screw that press on each other.

use super::ball::ScrewBall;
use super::contacts::ScrewContacts;
use super::impedance::{ImpedanceStep, Rubbing};
use super::motion::{ScrewBallMotion, ScrewBallState};
use crate::math;
use crate::refined::pressing::{impedance_of, pressed};
use crate::train::Press;

/// `N` balls in a row and the forces between them, kept from step to step.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct ScrewChain<const N: usize> {
    /// The balls, from rear to front in the direction of positive nut speed.
    pub balls: [ScrewBallState; N],
    /// Force between every ball and the next one, N, at least zero; the last one acts between the last ball
    /// and the first.
    pub forces: [f32; N],
    speed_deviations: [f32; N],
    impedances: [f32; N],
    press: Press<N>,
    rubbing: [Rubbing; N],
    proposals: [ImpedanceStep; N],
}

impl<const N: usize> ScrewChain<N> {
    /// Balls in given states, without forces between them.
    #[must_use]
    pub const fn new(balls: [ScrewBallState; N]) -> Self {
        Self {
            balls,
            forces: [0.0; N],
            speed_deviations: [0.0; N],
            impedances: [0.0; N],
            press: Press::new(),
            rubbing: [[0.0; 4]; N],
            proposals: [ImpedanceStep::EMPTY; N],
        }
    }
}

impl ScrewBall {
    /// Forces between balls that touch, from the speeds and compliances that their states hold: the closed
    /// form `F_BB = (v_1 - v_2)/(Y_1 + Y_2)` of two balls, and the corresponding one of `N`.
    ///
    /// `room`, `direction` and what is returned as in [`ScrewBall::refine_chain`], where errors stand; the balls' motions
    /// stay as they are.
    pub fn press_chain<const N: usize>(
        &self,
        chain: &mut ScrewChain<N>,
        room: &[f32; N],
        direction: f32,
    ) -> bool {
        let direction = if direction.is_nan() { 0.0 } else { direction };
        let ScrewChain {
            balls,
            forces,
            speed_deviations,
            impedances,
            press,
            ..
        } = chain;
        let found = speed_deviations.iter_mut().zip(impedances.iter_mut());
        for (state, (free, impedance)) in balls.iter().zip(found) {
            *free = direction * state.speed_deviation;
            *impedance = impedance_of(state.compliance * self.cos_between);
        }
        pressed(press, speed_deviations, impedances, room, forces)
    }

    /// One impedance step of `N` balls in a row, with the forces between them.
    ///
    /// Every ball's equations give the speed deviation it would take on its own, and a compliance; [`Press`] turns them
    /// into the contact forces under which no ball overtakes the one in front of it, and with these the balls then take
    /// their steps. A force acts along the chord between two balls, `cos(beta_BB)` of it along the track,
    /// `sin(beta_BB) = r_b/q` (Lin 2019, eqs. (3.72), (3.75)).
    ///
    /// `room[j]` is the speed deviation, at least zero, at which ball `j` may run up to the one in front: zero where they
    /// touch, infinite where nothing is in front. The last one belongs to the last ball and the first; it is infinite
    /// unless the track is a full ring.
    ///
    /// Returns whether every ball's speed counts (see [`Press::solve`]); where not, no ball presses.
    ///
    /// Friction between the balls, with coefficient `ball_friction` (eqs. (3.73)-(3.75)), lags one step behind:
    /// it uses the forces that the chain holds on entry.
    ///
    /// Largest error of the force between two balls after no, one, two and three steps from
    /// [`ScrewBall::start`], against equilibrium of both with the same contacts and friction between them: 4e-2
    /// (rms 9e-3), 1.7e-2, 2.3e-3 and 7e-5 of `mu` times the sum of the contact forces, four contacts, angles off by up
    /// to 2 degrees. Against balls in elastic grooves, whose contacts shift with the force: 2 %, 0.5 % and 0.5 % of the
    /// force after one, two and three steps; without a step 4 % with three contacts and 18 % with four and 3 degrees.
    ///
    /// `direction` is the sign of the nut's speed, or a number between -1 and 1 that passes smoothly through
    /// standstill; NaN counts as zero.
    pub fn refine_chain<const N: usize>(
        &self,
        contacts: &[ScrewContacts; N],
        chain: &mut ScrewChain<N>,
        room: &[f32; N],
        direction: f32,
        ball_friction: f32,
    ) -> bool {
        let direction = if direction.is_nan() { 0.0 } else { direction };
        let ScrewChain {
            balls: states,
            forces,
            speed_deviations,
            impedances,
            press,
            rubbing,
            proposals,
        } = chain;
        for state in states.iter_mut() {
            state.motion = self.sound(state.motion);
        }
        self.rub(states, forces, ball_friction, rubbing);

        let given = contacts.iter().zip(states.iter()).zip(rubbing.iter());
        let found = speed_deviations
            .iter_mut()
            .zip(impedances.iter_mut())
            .zip(proposals.iter_mut());
        for (((contacts, state), rubbing), ((free, impedance), proposal)) in given.zip(found) {
            *proposal = self.propose(contacts, &state.motion, rubbing);
            let speed = state.motion.speed + proposal.free.speed;
            *free = direction * speed * self.inverse_speed;
            let compliance = proposal.column.speed * self.inverse_speed * self.cos_between;
            *impedance = impedance_of(compliance);
        }

        let sound = pressed(press, speed_deviations, impedances, room, forces);

        let along = if direction < 0.0 {
            -self.cos_between
        } else {
            self.cos_between
        };
        let mut behind = forces.last().copied().unwrap_or(0.0);
        let given = contacts.iter().zip(proposals.iter()).zip(rubbing.iter());
        for (state, (((contacts, proposal), rubbing), &ahead)) in
            states.iter_mut().zip(given.zip(forces.iter()))
        {
            let net = along * (behind - ahead);
            *state = self.advance(contacts, &state.motion, proposal, net, rubbing);
            behind = ahead;
        }
        sound
    }

    /// Torque on the nut that friction between the balls takes, N m.
    #[must_use]
    pub fn ball_torque<const N: usize>(&self, chain: &ScrewChain<N>, ball_friction: f32) -> f32 {
        let fronts = chain.balls.iter().cycle().skip(1);
        let mut sum = 0.0;
        for ((rear, front), &force) in chain.balls.iter().zip(fronts).zip(&chain.forces) {
            if force > 0.0 {
                sum += force * self.rubbing_speed(&rear.motion, &front.motion);
            }
        }
        ball_friction * sum
    }

    /// Speed with which two touching balls rub, m per unit of nut speed (Lin 2019, eq. (3.73)), with the
    /// balls' angular velocities relative to the orbit.
    #[must_use]
    pub fn rubbing_speed(&self, rear: &ScrewBallMotion, front: &ScrewBallMotion) -> f32 {
        let (x, z) = self.rubbing(rear, front);
        self.radius() * math::sqrt(x * x + z * z)
    }

    #[inline]
    fn rubbing(&self, rear: &ScrewBallMotion, front: &ScrewBallMotion) -> (f32, f32) {
        let [rear_x, rear_y, rear_z] = rear.turn;
        let [front_x, front_y, front_z] = front.turn;
        let orbits = self.orbital_speed(rear) + self.orbital_speed(front);
        (
            (rear_x + front_x) * self.cos_between + (rear_y - front_y) * self.sin_between,
            rear_z + front_z - orbits * self.cos_lead,
        )
    }

    /// Force and moments of the neighbours' friction on each ball: the derivatives of its power loss by the ball's
    /// motion.
    #[inline]
    fn rub<const N: usize>(
        &self,
        states: &[ScrewBallState; N],
        forces: &[f32; N],
        ball_friction: f32,
        rubbing: &mut [Rubbing; N],
    ) {
        let drag = self.cos_lead * self.sin_between;
        let (mut behind_x, mut behind_z) = (0.0, 0.0);
        let fronts = states.iter().cycle().skip(1);
        for (((rubbing, rear), front), &force) in
            rubbing.iter_mut().zip(states).zip(fronts).zip(forces)
        {
            let friction = ball_friction * force;
            let (x, z) = if friction > 0.0 {
                let (x, z) = self.rubbing(&rear.motion, &front.motion);
                let size = friction / math::sqrt(x * x + z * z + 1e-12);
                (-size * x, -size * z)
            } else {
                (0.0, 0.0)
            };
            *rubbing = self.of_neighbours((behind_x, behind_z), (x, z), drag);
            (behind_x, behind_z) = (x, z);
        }
        // On a ring the first ball is ahead of the last one.
        if let Some(first) = rubbing.first_mut() {
            let last = self.of_neighbours((behind_x, behind_z), (0.0, 0.0), drag);
            for (of_first, of_last) in first.iter_mut().zip(last) {
                *of_first += of_last;
            }
        }
    }

    #[inline]
    fn of_neighbours(&self, behind: (f32, f32), ahead: (f32, f32), drag: f32) -> Rubbing {
        let (x, z) = (behind.0 + ahead.0, behind.1 + ahead.1);
        [
            -z * drag,
            x * self.cos_between,
            (ahead.0 - behind.0) * self.sin_between,
            z,
        ]
    }
}
