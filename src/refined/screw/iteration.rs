//! The impedance iteration: contact impedances at the motion found, a fixed number of times.

use super::given::{STICK_SPIN, ScrewBall, ScrewBallMotion, ScrewBallState, ScrewContacts};
use crate::refined::symmetric::{System, Vector};

/// Impedance steps from [`ScrewBall::start`] that [`ScrewBall::solve`] takes.
pub const DEFAULT_IMPEDANCE_STEPS: u8 = 4;

/// Longest step, as the sum of its parts: contact spins are about three.
const STEP_LIMIT: f32 = 3.0;

/// Longest change of a contact's slip in one step, over the slip it has and that at which its velocity
/// centre reaches the rim of the ellipse: friction saturates there, and a longer step relies on an
/// impedance that is not there.
const REACH_ALONG: f32 = 0.6;
const REACH_ACROSS: f32 = 1.0;

/// Largest force along the track that counts, N.
const LARGEST_FORCE: f32 = 1e7;

/// Impedance that keeps a rotation as it is, N.
const HELD: f32 = 1e12;

/// Least impedance of a contact that slides, over force over slip.
const LEAST_STIFFNESS: f32 = 0.05;

/// What friction between balls does to one of them, N: force along the track, rubbing over the ball radius
/// about x, y and z.
pub(super) type Rubbing = [f32; 4];

/// One step before the neighbours' force is known.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(super) struct Proposal {
    /// Power loss at the motion before the step, over the ball radius.
    power: f32,
    /// Step without a force along the track.
    pub(super) free: Step,
    /// Step per unit force along the track.
    pub(super) column: Step,
    /// `(outer forces - gradient)` times the free step.
    decrement: f32,
    /// Longest changes of the contacts' slips.
    reach: [Reach; 4],
}

/// Longest change of one contact's slip.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
struct Reach {
    along: f32,
    across: f32,
    /// Part of the semi-major axis times the change of the spin that adds to `across`.
    narrow: f32,
}

impl Reach {
    /// That of a lost contact.
    const ANY: Self = Self {
        along: 1e9,
        across: 1e9,
        narrow: 0.0,
    };
}

/// Change of `(speed, Omega_x, Omega_y, Omega_z)`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(super) struct Step {
    pub(super) speed: f32,
    x: f32,
    y: f32,
    z: f32,
}

impl Step {
    const ZERO: Self = Self {
        speed: 0.0,
        x: 0.0,
        y: 0.0,
        z: 0.0,
    };
}

impl Proposal {
    pub(super) const EMPTY: Self = Self {
        power: 0.0,
        free: Step::ZERO,
        column: Step::ZERO,
        decrement: 0.0,
        reach: [Reach::ANY; 4],
    };
}

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
        let force = if force.abs() <= LARGEST_FORCE {
            force
        } else {
            0.0
        };
        let motion = self.sound(state.motion);
        let proposal = self.propose(contacts, &motion, &[0.0; 4]);
        self.advance(contacts, &motion, &proposal, force, &[0.0; 4])
    }

    /// Motion and compliance where all contacts have the impedances of rolling.
    pub(super) fn linear(
        &self,
        contacts: &ScrewContacts,
        motion: &ScrewBallMotion,
    ) -> ScrewBallState {
        let proposal = self.linearised(contacts, motion, &[0.0; 4], true);
        let unbounded = Proposal {
            reach: [Reach::ANY; 4],
            ..proposal
        };
        self.advance(contacts, motion, &unbounded, 0.0, &[0.0; 4])
    }

    /// Compliance of the speed along the track at a motion.
    pub(super) fn compliance(&self, contacts: &ScrewContacts, motion: &ScrewBallMotion) -> f32 {
        self.propose(contacts, motion, &[0.0; 4]).column.speed
    }

    #[inline]
    pub(super) fn propose(
        &self,
        contacts: &ScrewContacts,
        motion: &ScrewBallMotion,
        rubbing: &Rubbing,
    ) -> Proposal {
        self.linearised(contacts, motion, rubbing, false)
    }

    /// The equations at a motion, with impedances that belong to it or, when `rolling`, to a ball that does not
    /// slip along the track.
    #[inline]
    fn linearised(
        &self,
        contacts: &ScrewContacts,
        motion: &ScrewBallMotion,
        rubbing: &Rubbing,
        rolling: bool,
    ) -> Proposal {
        let mut power = 0.0;
        let mut reach = [Reach::ANY; 4];
        let mut system = System::EMPTY;
        // Row of Omega_y in the system, and its right side.
        let mut cross = Vector::ZERO;
        // The closed form holds it: the two races share the slip across the track.
        let mut own = if rolling { HELD } else { 1e-9 };
        let [along_track, x, y, z] = *rubbing;
        let mut right = y;
        let grooves = contacts.contact.iter().zip(self.races());
        for ((contact, race), reach) in grooves.zip(&mut reach) {
            if contact.friction > 0.0 {
                let (nx, nz) = contact.arm;
                let slip = contact.at(motion);
                let at = race.map.dissipation(
                    slip.across,
                    if rolling { 0.0 } else { slip.along },
                    slip.spin,
                    contact.semi_major,
                    STICK_SPIN,
                );
                let weight = contact.friction;
                power += weight * at.power;
                let size = slip.along.abs();
                let narrow = REACH_ACROSS * race.map.axis_ratio();
                *reach = Reach {
                    along: REACH_ALONG * (at.rim + size),
                    across: narrow * at.rim + REACH_ACROSS * slip.across.abs(),
                    narrow,
                };

                let force = if rolling {
                    at.stiffness_along * slip.along
                } else {
                    at.along
                };
                let (force, moment) = (weight * force, weight * at.moment);
                system.right.roll += force * nz - moment * nx;
                system.right.yaw -= force * nx + moment * nz;
                system.right.speed -= force;
                right -= weight * at.across;

                let floor = LEAST_STIFFNESS * at.along.abs();
                let along = if at.stiffness_along * size >= floor {
                    at.stiffness_along
                } else {
                    floor / size
                };
                let floor = LEAST_STIFFNESS * at.across.abs();
                let across_size = slip.across.abs();
                let across = if at.stiffness_across * across_size >= floor {
                    at.stiffness_across
                } else {
                    floor / across_size
                };
                // s11 r1² + 2 s12 r1 r2 + s22 r2² with r1 = dy - t1 d, r2 = slip - t2 d, d the spin's row, as the
                // square of r2 + s12/s22 r1 and the rest.
                let mixed = at.stiffness_mixed / along;
                let tilt = at.tilt_along + mixed * at.tilt_across;
                let (roll, yaw) = (-nz - tilt * nx, nx - tilt * nz);
                let stiffness = weight * along;
                system.add_slip(stiffness, roll, yaw);
                let rest = weight * (across - mixed * at.stiffness_mixed);
                let spun = rest * at.tilt_across;
                system.add_spin(spun * at.tilt_across + weight * at.stick, nx, nz);
                let coupling = stiffness * mixed;
                own += rest + coupling * mixed;
                cross.roll += coupling * roll - spun * nx;
                cross.yaw += coupling * yaw - spun * nz;
                cross.speed += coupling;
            }
        }
        system.right.speed += along_track;
        system.right.roll += x;
        system.right.yaw += z;
        let inverse = 1.0 / own;
        let mut reduced = system.right;
        reduced.roll -= cross.roll * right * inverse;
        reduced.yaw -= cross.yaw * right * inverse;
        reduced.speed -= cross.speed * right * inverse;
        let whole = system.right;
        system.subtract(cross, inverse);
        let factors = system.factors();
        let complete = |found: Vector, right: f32| Step {
            speed: found.speed,
            x: found.roll,
            y: (right - cross.dot(found)) * inverse,
            z: found.yaw,
        };
        let found = factors.solve(reduced);
        let free = complete(found, right);
        Proposal {
            power,
            free,
            column: complete(factors.speed_column(), 0.0),
            decrement: whole.dot(found) + right * free.y,
            reach,
        }
    }

    #[inline]
    pub(super) fn advance(
        &self,
        contacts: &ScrewContacts,
        motion: &ScrewBallMotion,
        proposal: &Proposal,
        force: f32,
        rubbing: &Rubbing,
    ) -> ScrewBallState {
        let Proposal {
            power,
            free,
            column,
            decrement,
            reach,
        } = proposal;
        let speed = free.speed + force * column.speed;
        let x = free.x + force * column.x;
        let y = free.y + force * column.y;
        let z = free.z + force * column.z;
        let length = speed.abs() + x.abs() + y.abs() + z.abs();
        let (mut allowed, mut wanted) = if length > STEP_LIMIT {
            (STEP_LIMIT, length)
        } else {
            (1.0, 1.0)
        };
        for (contact, reach) in contacts.contact.iter().zip(reach) {
            let (nx, nz) = contact.arm;
            let change = (speed + nx * z - nz * x).abs();
            // A contact that starts to spin takes more slip before it saturates.
            let spun = contact.semi_major * (nx * x + nz * z).abs();
            let along = reach.along + REACH_ALONG * spun;
            if allowed * change > wanted * along {
                (allowed, wanted) = (along, change);
            }
            let across = reach.across + reach.narrow * spun;
            if allowed * y.abs() > wanted * across {
                (allowed, wanted) = (across, y.abs());
            }
        }
        let scale = allowed / wanted;
        let [turn_x, turn_y, turn_z] = motion.turn;
        let motion = ScrewBallMotion {
            speed: motion.speed + scale * speed,
            turn: [turn_x + scale * x, turn_y + scale * y, turn_z + scale * z],
        };
        // Loss after the step: with outer forces L and H dy = L - g it changes by scale g dy +
        // scale²/2 (L - g) dy.
        let pull = decrement + force * (2.0 * free.speed + force * column.speed);
        let [along, about_x, about_y, about_z] = *rubbing;
        let work = (force + along) * speed + about_x * x + about_y * y + about_z * z;
        let torque = power + scale * (work - (1.0 - 0.5 * scale) * pull);
        self.state(
            motion,
            column.speed,
            if torque > 0.0 { torque } else { 0.0 },
        )
    }
}
