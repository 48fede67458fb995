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
/// `m = mu_b (F_behind + F_ahead)/(mu W cos(b))`, and `A`, `H`, `L` linear between the nodes [`RUBBINGS`], zero without friction and beyond the last node in
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
    /// `A` at the nodes, over `mu W`.
    pub push: [[f32; 3]; 3],
    /// `H` at the nodes, over `mu W`.
    pub impedance: [[f32; 3]; 3],
    /// `L` at the nodes, over `mu W`, m.
    pub torque: [[f32; 3]; 3],
    /// `g` over `mu`.
    pub outward: [f32; 3],
    /// `t` over `mu`, m.
    pub outward_torque: f32,
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
    /// Change of a ball's friction torque with its speed, over `mu W`, m; and over the impedance, m.
    pub slope: f32,
    /// Torque by the square of a change of speed over the impedance, m: half the speed against the nut, times the work.
    pub curvature: f32,
}

impl NeighbourNumbers {
    /// A ball in which neighbours change nothing.
    pub const NONE: Self = Self {
        push: [[0.0; 3]; 3],
        impedance: [[0.0; 3]; 3],
        torque: [[0.0; 3]; 3],
        outward: [0.0; 3],
        outward_torque: 0.0,
    };

    /// Each number by a function of it and of the same of others.
    #[inline(always)]
    fn each(&self, others: &Self, of: impl Fn(f32, f32) -> f32) -> Self {
        let mut all = *self;
        let nodes = [
            (&mut all.push, &others.push),
            (&mut all.impedance, &others.impedance),
            (&mut all.torque, &others.torque),
        ];
        for (numbers, others) in nodes {
            for (number, other) in numbers
                .as_flattened_mut()
                .iter_mut()
                .zip(others.as_flattened())
            {
                *number = of(*number, *other);
            }
        }
        for (number, other) in all.outward.iter_mut().zip(&others.outward) {
            *number = of(*number, *other);
        }
        all.outward_torque = of(all.outward_torque, others.outward_torque);
        all
    }

    /// These numbers, interpolated towards others by a fraction, 0 to 1.
    #[inline(always)]
    pub(super) fn towards(&self, others: &Self, fraction: f32) -> Self {
        self.each(others, |from, to| from + fraction * (to - from))
    }

    /// With the friction coefficient and the tangent of the chord's angle: `outward` and its torque per newton along the track.
    #[inline(always)]
    pub(super) fn on_chord(&self, outward: f32) -> Self {
        Self {
            outward: self.outward.map(|number| outward * number),
            outward_torque: outward * self.outward_torque,
            ..*self
        }
    }

    /// Refuses numbers that are not finite and of the size of a ball's.
    pub(super) const fn checked(&self) -> Result<(), Error> {
        attempt!(check("push", self.push.as_flattened()));
        attempt!(check("rubbed_impedance", self.impedance.as_flattened()));
        attempt!(check("rubbed_torque", self.torque.as_flattened()));
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
        let at = |nodes: &[f32; 3]| line(nodes, ball.deviations);
        let place = Place::of(2.0 * self.ball_friction);
        let [push, _] = place.value(&self.numbers.push, at);
        let [stiffness, _] = place.value(&self.numbers.impedance, at);
        let grip = limited_grip(ball.part * (0.5 * push + at(&self.numbers.outward)));
        self.rubbed(ball, stiffness, 0.0, grip)
    }

    /// The ball in the second pass, Newton's line through what the first one found; and what its friction torque is more at `v_h` than free, with
    /// what its deviations change of the torque that rubbing adds, N m.
    #[inline(always)]
    #[must_use]
    pub fn second(&self, ball: &BallOfRow, found: &Pressed) -> (RubbedBall, f32) {
        let at = |nodes: &[f32; 3]| line(nodes, ball.deviations);
        let numbers = &self.numbers;
        let [behind, ahead] = found.forces;
        let whole = found.parts == [1.0; 2];
        let carried = ball.part * ball.sliding;
        let forces = behind + ahead;
        // Those that rub.
        let rubbing = if whole {
            forces
        } else {
            found.parts[0] * behind + found.parts[1] * ahead
        };
        let place = Place::of(self.ball_friction * rubbing / carried);
        let [push, by_rubbing] = place.value(&numbers.push, at);
        let [stiffness, stiffening] = place.value(&numbers.impedance, at);
        let [by_deviations, _] = place.value(&numbers.torque, |nodes| at(nodes) - nodes[0]);
        let change = by_rubbing + stiffening * (found.speed - self.held_speed);
        let outward = ball.part * at(&numbers.outward);
        let mut grip = self.ball_friction * change;
        if !whole {
            grip *= if forces > 0.0 {
                rubbing / forces
            } else {
                ball.part
            };
        }
        let grip = limited_grip(grip + outward);
        // What the train cuts off stays as it is at these forces.
        let constant = push - (grip - outward) * forces / carried;
        let mut rubbed = self.rubbed(ball, stiffness, constant, grip);
        rubbed.counts = whole;
        let held = self.held(ball);
        if whole {
            return (rubbed, held + by_deviations * carried);
        }
        // The walk that adds up losses has those of balls all of whose contacts rub in full.
        let change = found.speed - self.held_speed;
        let curvature = self.curvature * ball.alone.impedance;
        let by_speed = (rubbed.torque_slope + curvature * change) * change;
        let [middle, _] = place.value(&numbers.torque, |nodes| nodes[0]);
        let outward = numbers.outward_torque * forces;
        let added = by_speed + carried * (middle + by_deviations) + outward;
        (rubbed, held + added)
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
        Losses {
            held_speed: self.held_speed,
            curvature: self.curvature * impedance,
            slope: self.slope * sliding,
            per_force: self.ball_friction / sliding,
            rubbing: self.numbers.torque.map(|[middle, ..]| sliding * middle),
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
        let [least, most] = STIFFENING.map(|factor| factor * impedance);
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
