//! Balls of a row in a tick: each by its own law, with the changes by friction of its neighbours.

use super::numbers::{NeighbourNumbers, RUBBINGS, RubbedNode, line};
use crate::train::{FreeBall, LARGEST_GRIP, Neighbours};

/// Least and largest impedance of a rubbed ball over that of the ball alone.
pub(super) const STIFFENING: [f32; 2] = [0.3, 5.0];

/// Largest free speed of a ball in the second pass, over the nominal speed against the nut.
const LARGEST_SPEED: f32 = 0.5;

/// Changes by neighbours in the balls of a row in a tick: [`NeighbourNumbers`] under its mean load, with what all balls have in common.
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
    /// Changes by friction of neighbours that press with `mu W`, `m = 2 mu_b`, in the mean over all deviations: in proportion to their forces,
    /// and in the impedance over `mu W`.
    first: [f32; 2],
    /// Changes by the outward force in proportion to the forces.
    smooth: [f32; 3],
}

/// A ball of a row under its own load, alone.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct BallOfRow {
    /// Free speed, less the nominal one, over the nominal speed against the nut.
    pub speed: f32,
    /// Impedance over `mu W`.
    pub impedance: f32,
    /// `mu W`, N, as much of it as the ball carries on a run-in; 0 in the return.
    pub sliding: f32,
    /// Deviations of both grooves, each over its largest.
    pub deviations: [f32; 2],
}

/// Friction torque of balls that press, more than that of the balls alone, N m.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PressedTorques {
    /// In the grooves at speeds that are not the free ones, and by the outward force of neighbours.
    pub groove: f32,
    /// By friction of neighbours.
    pub ball: f32,
    /// Largest sum of the forces of both neighbours of a ball, as far as they rub, N.
    pub largest: f32,
}

impl BallOfRow {
    /// A ball in the return.
    pub const UNLOADED: Self = Self {
        speed: 0.0,
        impedance: 0.0,
        sliding: 0.0,
        deviations: [0.0; 2],
    };
}

impl NeighbourLaw {
    #[inline(always)]
    pub(super) fn new(
        numbers: NeighbourNumbers,
        ball_friction: f32,
        held_speed: f32,
        slope: f32,
        curvature: f32,
    ) -> Self {
        let Place {
            low,
            high,
            fraction,
            ..
        } = Place::of(2.0 * ball_friction, &numbers.nodes);
        let mean = |low: &[f32; 3], high: &[f32; 3]| low[0] + fraction * (high[0] - low[0]);
        Self {
            smooth: within_grip(numbers.outward),
            first: [
                limited(
                    0.5 * mean(&low.push, &high.push) + numbers.outward[0],
                    LARGEST_GRIP,
                ),
                mean(&low.impedance, &high.impedance),
            ],
            numbers,
            ball_friction,
            held_speed,
            slope,
            curvature,
        }
    }

    /// With speeds and pushes counted in a direction, 1 or -1.
    #[inline(always)]
    #[must_use]
    pub fn along(mut self, direction: f32) -> Self {
        for node in &mut self.numbers.nodes {
            node.push = node.push.map(|number| direction * number);
        }
        self.numbers.outward = self.numbers.outward.map(|number| direction * number);
        self.first[0] *= direction;
        self.smooth = self.smooth.map(|number| direction * number);
        self.held_speed *= direction;
        self.slope *= direction;
        self
    }

    /// A ball whose neighbours do not rub, but press it outward; on a run-in a part of it.
    #[inline(always)]
    pub fn smooth(&self, ball: &BallOfRow, part: f32) -> FreeBall {
        let grip = part * line(&self.smooth, ball.deviations);
        FreeBall::rubbed(ball.speed, ball.sliding * ball.impedance, 0.0, grip)
    }

    /// A ball in the first pass: each has the mean friction of neighbours that press with `mu W`, `m = 2 mu_b`, on a run-in a part of it.
    #[inline(always)]
    pub fn first(&self, ball: &BallOfRow, part: f32) -> FreeBall {
        let [grip, stiffness] = self.first;
        self.free(ball, stiffness, 0.0, 0.0, part * grip)
    }

    /// The ball in the second pass: Newton's line through the speed and the forces that the first one found; `rubbing`: [`Self::rubbing`].
    #[inline(always)]
    pub fn second(&self, ball: &BallOfRow, found: &Neighbours, rubbing: f32) -> FreeBall {
        let Place {
            low,
            high,
            fraction,
            per_width,
        } = Place::of(rubbing, &self.numbers.nodes);
        let push = line(&low.push, ball.deviations);
        let push_rise = line(&high.push, ball.deviations) - push;
        let stiffness = line(&low.impedance, ball.deviations);
        let stiffness_rise = line(&high.impedance, ball.deviations) - stiffness;
        let rise = push_rise + stiffness_rise * (found.speed - self.held_speed);
        let outward = line(&self.numbers.outward, ball.deviations);
        let grip = limited(
            outward + self.ball_friction * (per_width * rise),
            LARGEST_GRIP,
        );
        let free = self.free(
            ball,
            stiffness + fraction * stiffness_rise,
            push + fraction * push_rise,
            // What the limit cuts off stays as it is at these forces.
            outward * found.rubbing - grip * found.forces,
            grip,
        );
        FreeBall {
            speed: limited(free.speed, LARGEST_SPEED),
            ..free
        }
    }

    /// Friction of both neighbours of a ball over its `mu W`.
    #[inline(always)]
    pub fn rubbing(&self, ball: &BallOfRow, found: &Neighbours) -> f32 {
        self.ball_friction * found.rubbing / ball.sliding
    }

    /// A ball with an impedance and a push more than alone, over `mu W`, a further push, N, and a grip.
    #[inline(always)]
    fn free(
        &self,
        ball: &BallOfRow,
        stiffness: f32,
        push: f32,
        constant: f32,
        grip: f32,
    ) -> FreeBall {
        let [least, most] = STIFFENING.map(|part| part * ball.impedance);
        let stiff = ball.impedance + stiffness;
        let stiff = if stiff > most {
            most
        } else if stiff > least {
            stiff
        } else {
            least
        };
        let push = push + ball.impedance * (self.held_speed - ball.speed);
        FreeBall::rubbed(
            self.held_speed,
            ball.sliding * stiff,
            ball.sliding * push + constant,
            grip,
        )
    }

    /// Adds what a ball loses more than alone; `rubbing`: [`Self::rubbing`].
    #[inline(always)]
    pub fn lose(
        &self,
        ball: &BallOfRow,
        found: &Neighbours,
        rubbing: f32,
        torques: &mut PressedTorques,
    ) {
        let change = found.speed - ball.speed;
        let by_speed = (self.slope + self.curvature * ball.impedance * change) * change;
        torques.groove += ball.sliding * by_speed + self.numbers.outward_torque * found.rubbing;
        let place = Place::of(rubbing, &self.numbers.nodes);
        let low = line(&place.low.torque, ball.deviations);
        let high = line(&place.high.torque, ball.deviations);
        torques.ball += ball.sliding * (low + place.fraction * (high - low));
        if found.rubbing > torques.largest {
            torques.largest = found.rubbing;
        }
    }
}

/// A number within this size, or the limit in its direction. Integers compare sizes without a detour over the floating-point flags.
#[inline(always)]
fn limited(number: f32, size: f32) -> f32 {
    if number.abs().to_bits() > size.to_bits() {
        size.copysign(number)
    } else {
        number
    }
}

#[inline(always)]
fn within_grip(line: [f32; 3]) -> [f32; 3] {
    let most: f32 = line.iter().map(|number| number.abs()).sum();
    if most > LARGEST_GRIP {
        line.map(|number| number * (LARGEST_GRIP / most))
    } else {
        line
    }
}

/// The nodes among [`RUBBINGS`] on both sides of a friction over `mu W`.
struct Place<'nodes> {
    low: &'nodes RubbedNode,
    high: &'nodes RubbedNode,
    /// Fraction of the distance between them; above 1 beyond the last node.
    fraction: f32,
    /// 1 / that distance.
    per_width: f32,
}

impl<'nodes> Place<'nodes> {
    #[inline(always)]
    fn of(rubbing: f32, nodes: &'nodes [RubbedNode; 3]) -> Self {
        const FIRST: f32 = RUBBINGS[0];
        const SECOND: f32 = RUBBINGS[1];
        const THIRD: f32 = RUBBINGS[2];
        // Friction is not negative: integers compare its bits.
        let below = |node: f32| rubbing.to_bits().cast_signed() < node.to_bits().cast_signed();
        // Nodes below and above; 0 is none.
        let (ends, from, per_width) = if below(FIRST) {
            ([0_usize, 1], 0.0, 1.0 / FIRST)
        } else if below(SECOND) {
            ([1, 2], FIRST, 1.0 / (SECOND - FIRST))
        } else if below(THIRD) {
            ([2, 3], SECOND, 1.0 / (THIRD - SECOND))
        } else {
            ([0, 3], 0.0, 1.0 / THIRD)
        };
        let [low, high] =
            ends.map(|end| nodes.get(end.wrapping_sub(1)).unwrap_or(&RubbedNode::NONE));
        Self {
            low,
            high,
            fraction: (rubbing - from) * per_width,
            per_width,
        }
    }
}
