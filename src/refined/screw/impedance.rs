//! The linear equations of a ball at a motion, and the step that they lead to.

use super::ball::{STICK_SPIN, ScrewBall};
use super::contacts::ScrewContacts;
use super::equations::{Equations, MotionChange, Solution};
use super::motion::{ScrewBallMotion, ScrewBallState, ScrewContactMotion};
use crate::contact::SlipFriction;

/// Longest step, as the sum of its parts: contact spins are about three.
///
/// A bound for motions that no step led to. From [`ScrewBall::start`] steps are shorter: limits of 1 to 10 and none at all
/// give the same errors but for one ball of 1050; 0.3 is short of what a pinned ball needs (1.2e-2 of the nut's speed in
/// place of 1.4e-4 after one step).
const STEP_LIMIT: f32 = 3.0;

/// Longest change of a contact's slip in one step, over the slip it has and that at which its velocity
/// centre reaches the end of the ellipse: friction saturates there, and a longer step relies on an
/// impedance that is not there.
///
/// Along the track 0.6 to 1.5 give the same errors after three steps; below, four contacts are slower (0.3: 4.5e-3 in place
/// of 1.4e-3 after one step). Across it speeds are alike from 0.5 to 1.5; the power loss at the motion is not: after one
/// step it is up to 13 % above the least one at 1, 5 % at 0.7 and 3 % at 0.5 (four contacts), 50 % at 1.5, and at 2 steps
/// do not settle. After five steps 0.5 to 1 are alike but where a third contact slides (1.7 % at 0.7, at 1 up to 25 % in
/// one ball of 118).
const REACH_ALONG: f32 = 0.6;
const REACH_ACROSS: f32 = 1.0;

/// Least impedance of a contact that slides, over force over slip.
///
/// From 0 to 0.1 speeds are alike. Without it a pinned ball's power loss is five times as far off after five steps (2.4e-3
/// in place of 4.3e-4); with 0.2 it is three times as far.
const LEAST_STIFFNESS: f32 = 0.05;

/// Friction of the neighbours on one ball, N: force along the track, moments about x, y and z over the ball radius.
pub(super) type Rubbing = [f32; 4];

/// One step before the neighbours' force is known.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(super) struct ImpedanceStep {
    /// Power loss at the motion before the step, over the ball radius.
    power: f32,
    /// Step without a force along the track.
    pub(super) free: MotionChange,
    /// Step per unit force along the track.
    pub(super) column: MotionChange,
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

    #[inline(always)]
    fn new(friction: &SlipFriction, slip: &ScrewContactMotion, axis_ratio: f32) -> Self {
        let narrow = REACH_ACROSS * axis_ratio;
        Self {
            along: REACH_ALONG * (friction.end_speed + slip.along.abs()),
            across: narrow * friction.end_speed + REACH_ACROSS * slip.across.abs(),
            narrow,
        }
    }
}

impl ImpedanceStep {
    pub(super) const EMPTY: Self = Self {
        power: 0.0,
        free: MotionChange::ZERO,
        column: MotionChange::ZERO,
        decrement: 0.0,
        reach: [Reach::ANY; 4],
    };
}

impl ScrewBall {
    /// Motion and compliance where all contacts have the impedances of rolling.
    pub(super) fn linear(
        &self,
        contacts: &ScrewContacts,
        motion: &ScrewBallMotion,
    ) -> ScrewBallState {
        let proposal = self.linearised(contacts, motion, &[0.0; 4], true);
        let unbounded = ImpedanceStep {
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
    ) -> ImpedanceStep {
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
    ) -> ImpedanceStep {
        let mut power = 0.0;
        let mut reach = [Reach::ANY; 4];
        let [along_track, x, y, z] = *rubbing;
        // The closed form holds Omega_y: screw and nut share the slip across the track.
        let mut equations = Equations::new(y, rolling);
        let grooves = contacts.contact.iter().zip(self.grooves());
        for ((contact, groove), reach) in grooves.zip(&mut reach) {
            if contact.friction > 0.0 {
                let slip = contact.motion(motion);
                let friction = groove.map.dissipation(
                    slip.across,
                    if rolling { 0.0 } else { slip.along },
                    slip.spin,
                    contact.semi_major,
                    STICK_SPIN,
                );
                power += contact.friction * friction.power;
                *reach = Reach::new(&friction, &slip, groove.map.axis_ratio());
                let force = if rolling {
                    friction.stiffness_along * slip.along
                } else {
                    friction.along
                };
                let stiffness = (
                    at_least_sliding(friction.stiffness_along, friction.along, slip.along),
                    at_least_sliding(friction.stiffness_across, friction.across, slip.across),
                );
                equations.add(contact, &friction, force, stiffness);
            }
        }
        let Solution {
            free,
            column,
            decrement,
        } = equations.solve(along_track, x, z);
        ImpedanceStep {
            power,
            free,
            column,
            decrement,
            reach,
        }
    }

    #[inline]
    pub(super) fn advance(
        &self,
        contacts: &ScrewContacts,
        motion: &ScrewBallMotion,
        proposal: &ImpedanceStep,
        force: f32,
        rubbing: &Rubbing,
    ) -> ScrewBallState {
        let ImpedanceStep {
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
        // Loss after the step: with outer forces Q and H dy = Q - g it changes by scale g dy +
        // scale²/2 (Q - g) dy.
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

/// A contact's stiffness, or the least one that it has while it slides.
#[inline(always)]
fn at_least_sliding(stiffness: f32, force: f32, slip: f32) -> f32 {
    let size = slip.abs();
    let floor = LEAST_STIFFNESS * force.abs();
    if stiffness * size >= floor {
        stiffness
    } else {
        floor / size
    }
}
