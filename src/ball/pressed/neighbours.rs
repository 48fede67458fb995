//! What its neighbours change in a ball that they press and rub on.

use super::numbers::{FreeMotion, line};
use crate::error::{Error, attempt, in_range};
use crate::train::{Losses, Place, RubbedBall, limited_grip};

/// Knots of a branch for what neighbours change.
pub const NEIGHBOUR_KNOTS: usize = 16;

/// Largest size of a number at a node.
const LARGEST_NUMBER: f32 = 1e3;

/// Least and largest impedance of a rubbed ball over that of the ball alone.
const STIFFENING: [f32; 2] = [0.3, 5.0];

/// Largest speed at which a pass lets a rubbed ball run free, over the nominal speed against the nut.
const LARGEST_SPEED: f32 = 0.5;

/// What neighbours change in a ball under one load: each a line `1, s, n` over the deviations of both grooves.
///
/// A ball that its neighbours rub on needs and loses more than alone at the same speed `v`; with the friction of both,
/// `m = mu_b (F_behind + F_ahead)/(mu W cos(b))`, and `A`, `H`, `L` linear between the nodes [`RUBBINGS`](crate::train::RUBBINGS), zero without friction and beyond the last node in
/// proportion to it (`H` as there):
///
/// ```text
/// net push         P = P_alone + A(m) + H(m) (v - v_h) + g O
/// friction torque  T = T_alone + L(m) + t O,                      O = tan(b) (F_behind + F_ahead),   sin(b) = R_B/R_path
/// ```
///
/// with the mean free speed `v_h` over all deviations and the outward force `O` of neighbours on a curved track. `L` holds the ball's half of what is
/// lost between balls, too. Source: Lin 2019, eqs. (3.70) to (3.77); least squares over exact balls, without a printed formula.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct NeighbourNumbers {
    /// At the nodes.
    pub nodes: [RubbedNode; 3],
    /// `g` over `mu`.
    pub outward: [f32; 3],
    /// `t` over `mu`, m.
    pub outward_torque: f32,
}

/// What friction of the neighbours changes in a ball at a node, over `mu W`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct RubbedNode {
    /// `A`.
    pub push: [f32; 3],
    /// `H`.
    pub impedance: [f32; 3],
    /// `L`, m.
    pub torque: [f32; 3],
}

impl RubbedNode {
    const NONE: Self = Self {
        push: [0.0; 3],
        impedance: [0.0; 3],
        torque: [0.0; 3],
    };

    #[inline(always)]
    fn towards(&self, other: &Self, fraction: f32) -> Self {
        Self {
            push: blended(&self.push, &other.push, fraction),
            impedance: blended(&self.impedance, &other.impedance, fraction),
            torque: blended(&self.torque, &other.torque, fraction),
        }
    }
}

/// What one pass knows of a ball for the next one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pressed {
    /// Forces of the ball behind and of the one ahead, N.
    pub forces: [f32; 2],
    /// Part of their friction that these have: the lesser part of their load that both balls of a contact carry.
    pub parts: [f32; 2],
    /// Speed of the ball, as free speeds are counted.
    pub speed: f32,
}

/// What neighbours change in the balls of a row in a step: [`NeighbourNumbers`] under its mean load, with what all balls have in common.
#[derive(Clone, Copy, Debug)]
pub struct NeighbourLaw {
    /// Over `mu W`, but `outward` and its torque, which are per newton along the track.
    pub numbers: NeighbourNumbers,
    /// Friction of two balls that press over the force along the track.
    pub ball_friction: f32,
    /// `v_h`.
    pub held_speed: f32,
    /// Change of a ball's friction torque with its speed at its free speed, over `mu W`, m.
    pub slope: f32,
    /// Torque by the square of a change of speed over the impedance, m: half the speed against the nut, times the work.
    pub curvature: f32,
    /// What friction of neighbours that press with `mu W`, `m = 2 mu_b`, changes in proportion to their forces, and in the impedance.
    pub(super) first: [[f32; 3]; 2],
}

impl NeighbourNumbers {
    /// A ball in which neighbours change nothing.
    pub const NONE: Self = Self {
        nodes: [RubbedNode::NONE; 3],
        outward: [0.0; 3],
        outward_torque: 0.0,
    };

    /// These numbers, interpolated towards others by a fraction, 0 to 1.
    #[inline(always)]
    pub(super) fn towards(&self, others: &Self, fraction: f32) -> Self {
        let [first, second, third] = &self.nodes;
        let [other_first, other_second, other_third] = &others.nodes;
        Self {
            nodes: [
                first.towards(other_first, fraction),
                second.towards(other_second, fraction),
                third.towards(other_third, fraction),
            ],
            outward: blended(&self.outward, &others.outward, fraction),
            outward_torque: self.outward_torque
                + fraction * (others.outward_torque - self.outward_torque),
        }
    }

    /// What friction of neighbours that press with `mu W` changes, with their outward force, in proportion to their forces, and in the impedance over
    /// `mu W`.
    #[inline(always)]
    pub(super) fn first(&self, ball_friction: f32, outward: f32) -> [[f32; 3]; 2] {
        let place = Place::of(2.0 * ball_friction);
        let (low, high) = place.ends(&self.nodes, &RubbedNode::NONE);
        let [push, screw, nut] = blended(&low.push, &high.push, place.fraction);
        let [middle, by_screw, by_nut] = self.outward;
        [
            [
                0.5 * push + outward * middle,
                0.5 * screw + outward * by_screw,
                0.5 * nut + outward * by_nut,
            ],
            blended(&low.impedance, &high.impedance, place.fraction),
        ]
    }

    /// Refuses numbers that are not finite and of the size of a ball's.
    pub(super) const fn checked(&self) -> Result<(), Error> {
        let mut node = 0;
        while node < 3 {
            attempt!(check("push", &self.nodes[node].push));
            attempt!(check("rubbed_impedance", &self.nodes[node].impedance));
            attempt!(check("rubbed_torque", &self.nodes[node].torque));
            node += 1;
        }
        attempt!(check("outward", &self.outward));
        attempt!(check("outward_torque", &[self.outward_torque]));
        Ok(())
    }
}

/// A ball of a row under its own load.
#[derive(Clone, Copy, Debug)]
pub struct BallOfRow {
    /// What it does alone, with what it carries on a run-in.
    pub alone: FreeMotion,
    /// `mu W`, N, beyond the run-in.
    pub sliding: f32,
    /// 1 / it, 1/N.
    pub per_sliding: f32,
    /// Part of its load that it carries on a run-in, above 0; else 1. What neighbours change in it sets in with it.
    pub part: f32,
    /// Deviations of both grooves, each over its largest.
    pub deviations: [f32; 2],
}

impl NeighbourLaw {
    /// A ball in the first pass: each has the friction of neighbours that press with `mu W`, `m = 2 mu_b`.
    #[inline(always)]
    #[must_use]
    pub fn first(&self, ball: &BallOfRow) -> RubbedBall {
        let [grip, stiffness] = &self.first;
        let FreeMotion {
            speed, impedance, ..
        } = ball.alone;
        let carried = ball.part * ball.sliding;
        let stiff = impedance + carried * line(stiffness, ball.deviations);
        let least = STIFFENING[0] * impedance;
        let stiff = if stiff > least { stiff } else { least };
        RubbedBall {
            // Between the free speed and the held one.
            speed: self.held_speed + (speed - self.held_speed) * (impedance / stiff),
            impedance: stiff,
            grip: ball.part * line(grip, ball.deviations),
            torque_slope: 0.0,
            counts: false,
        }
    }

    /// The ball in the second pass, Newton's line through what the first one found; and what its friction torque is more at `v_h` than free, with
    /// what its deviations change of the torque that rubbing adds, N m.
    #[inline(always)]
    #[must_use]
    pub fn second(&self, ball: &BallOfRow, found: &Pressed) -> (RubbedBall, f32) {
        let [behind, ahead] = found.forces;
        let whole = found.parts == [1.0; 2];
        if !whole {
            return self.second_in_part(ball, found);
        }
        let forces = behind + ahead;
        let place = Place::of(self.ball_friction * forces * ball.per_sliding);
        let rubbed = self.at(&place, ball.deviations);
        let outward = line(&self.numbers.outward, ball.deviations);
        let change = found.speed - self.held_speed;
        let slope = rubbed.push_slope + rubbed.stiffness_slope * change;
        let grip = limited_grip(self.ball_friction * slope + outward);
        // What the train cuts off stays as it is at these forces.
        let constant = rubbed.push - (grip - outward) * forces * ball.per_sliding;
        let held = self.held(ball) + rubbed.by_deviations * ball.sliding;
        (self.rubbed(ball, rubbed.stiffness, constant, grip), held)
    }

    /// The same where a ball or a neighbour is on a run-in: friction in part, and all of the ball's torque, because the walk that adds up losses has
    /// those of balls all of whose contacts rub in full.
    #[cold]
    #[inline(never)]
    fn second_in_part(&self, ball: &BallOfRow, found: &Pressed) -> (RubbedBall, f32) {
        let [behind, ahead] = found.forces;
        let carried = ball.part * ball.sliding;
        let forces = behind + ahead;
        let rubbing = found.parts[0] * behind + found.parts[1] * ahead;
        let place = Place::of(self.ball_friction * rubbing / carried);
        let rubbed = self.at(&place, ball.deviations);
        let outward = ball.part * line(&self.numbers.outward, ball.deviations);
        let change = found.speed - self.held_speed;
        let slope = rubbed.push_slope + rubbed.stiffness_slope * change;
        let share = if forces > 0.0 {
            rubbing / forces
        } else {
            ball.part
        };
        let grip = limited_grip(share * (self.ball_friction * slope) + outward);
        let constant = rubbed.push - (grip - outward) * forces / carried;
        let next = RubbedBall {
            counts: false,
            ..self.rubbed(ball, rubbed.stiffness, constant, grip)
        };
        let curvature = self.curvature * ball.alone.impedance;
        let by_speed = (next.torque_slope + curvature * change) * change;
        let (low, high) = place.ends(&self.numbers.nodes, &RubbedNode::NONE);
        let [middle, ..] = blended(&low.torque, &high.torque, place.fraction);
        let outward = self.numbers.outward_torque * forces;
        let added = by_speed + carried * (middle + rubbed.by_deviations) + outward;
        (next, self.held(ball) + added)
    }

    /// What friction of neighbours changes in a ball with these deviations, over `mu W`.
    #[inline(always)]
    fn at(&self, place: &Place, deviations: [f32; 2]) -> Rubbed {
        let (low, high) = place.ends(&self.numbers.nodes, &RubbedNode::NONE);
        let push = line(&low.push, deviations);
        let push_rise = line(&high.push, deviations) - push;
        let stiffness = line(&low.impedance, deviations);
        let stiffness_rise = line(&high.impedance, deviations) - stiffness;
        let slopes = |node: &RubbedNode| {
            let [_, screw, nut] = node.torque;
            deviations[0] * screw + deviations[1] * nut
        };
        let torque = slopes(low);
        Rubbed {
            push: push + place.fraction * push_rise,
            push_slope: place.per_width * push_rise,
            stiffness: stiffness + place.fraction * stiffness_rise,
            stiffness_slope: place.per_width * stiffness_rise,
            by_deviations: torque + place.fraction * (slopes(high) - torque),
        }
    }

    /// A ball whose neighbours do not rub, but press it outward; and what its friction torque is more at `v_h` than free, N m.
    #[inline(always)]
    #[must_use]
    pub fn smooth(&self, ball: &BallOfRow) -> (RubbedBall, f32) {
        let rubbed = RubbedBall {
            speed: ball.alone.speed,
            impedance: ball.alone.impedance,
            grip: limited_grip(ball.part * line(&self.numbers.outward, ball.deviations)),
            torque_slope: self.torque_slope(ball),
            counts: ball.part == 1.0,
        };
        (rubbed, self.held(ball))
    }

    /// How the torque of a row of balls follows from their speeds and forces, for balls of the mean `mu W`, N, and impedance, N.
    #[inline(always)]
    #[must_use]
    pub fn losses(&self, sliding: f32, impedance: f32) -> Losses {
        let [first, second, third] = &self.numbers.nodes;
        Losses {
            held_speed: self.held_speed,
            curvature: self.curvature * impedance,
            slope: self.slope * sliding,
            per_force: self.ball_friction / sliding,
            rubbing: [
                sliding * first.torque[0],
                sliding * second.torque[0],
                sliding * third.torque[0],
            ],
        }
    }

    /// What a ball alone loses more at `v_h` than at its free speed, N m.
    #[inline(always)]
    fn held(&self, ball: &BallOfRow) -> f32 {
        let change = self.held_speed - ball.alone.speed;
        let slope = self.slope * (ball.part * ball.sliding);
        (slope + self.curvature * ball.alone.impedance * change) * change
    }

    /// Change of that with the speed there, N m.
    #[inline(always)]
    fn torque_slope(&self, ball: &BallOfRow) -> f32 {
        let change = self.held_speed - ball.alone.speed;
        self.slope * (ball.part * ball.sliding)
            + 2.0 * self.curvature * ball.alone.impedance * change
    }

    /// With an impedance and a push more than the ball alone has, over `mu W`.
    #[inline(always)]
    fn rubbed(&self, ball: &BallOfRow, stiffness: f32, push: f32, grip: f32) -> RubbedBall {
        let FreeMotion {
            speed, impedance, ..
        } = ball.alone;
        let (least, most) = (STIFFENING[0] * impedance, STIFFENING[1] * impedance);
        let sliding = ball.part * ball.sliding;
        let stiff = bounded(impedance + sliding * stiffness, least, most);
        let held = self.held_speed - speed;
        let free = speed + ((stiff - impedance) * held - sliding * push) / stiff;
        RubbedBall {
            speed: bounded(free, -LARGEST_SPEED, LARGEST_SPEED),
            impedance: stiff,
            grip,
            torque_slope: self.torque_slope(ball),
            counts: ball.part == 1.0,
        }
    }
}

/// What friction of neighbours changes in a ball, over `mu W`.
struct Rubbed {
    /// Net push, and its change with the friction over `mu W`.
    push: f32,
    push_slope: f32,
    /// Impedance, and the same.
    stiffness: f32,
    stiffness_slope: f32,
    /// What the deviations change of the torque, m.
    by_deviations: f32,
}

/// Three numbers, interpolated towards others by a fraction.
#[inline(always)]
fn blended([a, b, c]: &[f32; 3], [d, e, f]: &[f32; 3], fraction: f32) -> [f32; 3] {
    [
        a + fraction * (d - a),
        b + fraction * (e - b),
        c + fraction * (f - c),
    ]
}

/// Refuses numbers beyond a size.
const fn check(field: &'static str, numbers: &[f32]) -> Result<(), Error> {
    let mut number = 0;
    while number < numbers.len() {
        attempt!(in_range(
            field,
            numbers[number],
            -LARGEST_NUMBER,
            LARGEST_NUMBER
        ));
        number += 1;
    }
    Ok(())
}

/// A number between two others. Not `clamp`, which keeps a panic for bounds that are not ordered.
#[inline(always)]
fn bounded(number: f32, least: f32, most: f32) -> f32 {
    if number > most {
        most
    } else if number > least {
        number
    } else {
        least
    }
}
