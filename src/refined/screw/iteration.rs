//! The impedance iteration: contact impedances at the motion found, a fixed number of times.

use super::ball::ScrewBall;
use super::contacts::ScrewContacts;
use super::motion::ScrewBallState;
use crate::ranges;

/// Impedance steps from [`ScrewBall::start`] that [`ScrewBall::solve`] takes.
pub const DEFAULT_IMPEDANCE_STEPS: u8 = 4;

impl ScrewBall {
    /// Motion after [`ScrewBall::start`] and [`DEFAULT_IMPEDANCE_STEPS`] impedance steps, with no force from
    /// neighbours: what to set a ball to before the first tick.
    #[must_use]
    pub fn solve(&self, contacts: &ScrewContacts) -> ScrewBallState {
        self.refine(
            contacts,
            &self.start(contacts),
            0.0,
            DEFAULT_IMPEDANCE_STEPS,
        )
    }

    /// Motion after `steps` impedance steps from a known state; see [`ScrewBall::step`]. No more than ten are
    /// taken.
    #[must_use]
    pub fn refine(
        &self,
        contacts: &ScrewContacts,
        state: &ScrewBallState,
        force: f32,
        steps: u8,
    ) -> ScrewBallState {
        let mut state = *state;
        for _ in 0..steps.min(10) {
            state = self.step(contacts, &state, force);
        }
        state
    }

    /// Motion after one impedance step from a known state: what to do once a tick, from the last tick's state.
    ///
    /// Force along the track and moments about all three axes are linear in the motion near the one that is
    /// known: with gradient `g` and Hessian `H` of the power loss, whose entries are the contacts' impedances
    /// against slip along and across the track and against spin, the step solves
    /// `(H + 1e-6 tr H) dy = force - g`. Taken at the slips that are there, impedances lead to Coulomb friction
    /// in two to four steps. The step is shortened so that no contact's slip along the track changes by more
    /// than 0.6 of what it has and of what saturates its friction.
    ///
    /// Largest errors against equilibrium of Coulomb friction after one, two, three and five steps from
    /// [`ScrewBall::start`], on the domain of [`ScrewBall::closed_form`] (rms in brackets). Orbital speed over the
    /// nut's, third contact pinned: 9e-5 (1.3e-5), 4.5e-5, 4.8e-5, 5e-6; four contacts: 6e-4 (1.2e-4), 7e-5, 2e-5, 5e-6;
    /// third contact slides: 1e-3 (2e-4), 9e-4, 9e-4, 8e-4: there one of the loaded contacts all but sticks, and
    /// steps away from that are short. Two contacts: 1e-4; the treatment of stick adds 0.5 % to the loss while it
    /// sets in. Groove torque, pinned: 2.6 %, 2.5 %, 1.1 %, 0.03 %; four: 4 %, 4 %, 0.13 %, 0.04 %. Third contacts of
    /// less than a hundredth of the loaded pair next to the change to two contacts: up to 4e-3 for some steps.
    ///
    /// The state's compliance belongs to the start of the step, its torque to the end, to second order in the step.
    /// A motion that is no number, or larger than 1e6, starts again from nominal rolling. Cost: four
    /// [`SlipMap`](crate::contact::SlipMap) with second derivatives, a system of four equations; it does not depend on the
    /// data but for the contacts that are lost.
    ///
    /// `force`, N, is the net force of the neighbours along the track in the direction of positive nut speed; a
    /// number that is not finite, or above 1e7, counts as zero.
    #[must_use]
    pub fn step(
        &self,
        contacts: &ScrewContacts,
        state: &ScrewBallState,
        force: f32,
    ) -> ScrewBallState {
        let force = if force.abs() <= ranges::LOAD.maximum {
            force
        } else {
            0.0
        };
        let motion = self.sound(state.motion);
        let proposal = self.propose(contacts, &motion, &[0.0; 4]);
        self.advance(contacts, &motion, &proposal, force, &[0.0; 4])
    }
}
