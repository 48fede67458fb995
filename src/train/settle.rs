//! Speeds and forces of all balls from their clusters.

use super::ball::Ball;

/// Part of the largest force that rounding may leave of the sum of a cluster's net pushes.
const ROUNDING: f32 = 1e-6;

pub(super) struct BallState {
    pub(super) speed: f32,
    /// Force of the ball behind, and the one on the ball in front.
    pub(super) behind: f32,
    pub(super) force: f32,
    pub(super) touches: bool,
}

#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Pressing {
    pub(crate) contacts: u8,
    /// Largest force, in the unit of speed times impedance.
    pub(crate) largest: f32,
    /// Sum of the forces, in the same unit.
    pub(crate) force: f32,
    /// Largest remainder of a cluster, without sign.
    pub(super) remainder: f32,
}

/// Gives each ball its speed and its force, from the foremost ball backwards, and passes it on: each ball behind differs from its free speed by
/// its slack more than the one in front does, and the force behind it is that in front and its net push. A ball alone keeps its free speed.
#[inline(always)]
pub(super) fn settle(
    balls: &mut [Ball],
    foremost: usize,
    mut each: impl FnMut(usize, &mut Ball, &BallState),
) -> Pressing {
    let last = balls.len().wrapping_sub(1);
    let mut index = foremost;
    // Balls still to come of the cluster, its impedance, the last ball's change of speed, the force of the next one, and its bits, of zero
    // where rounding has made it a little less.
    let mut left = 0;
    let mut impedance = 0.0;
    let mut change = 0.0;
    let mut next = 0.0;
    let mut bits = 0_i32;
    let mut contacts = 0;
    let mut largest = 0;
    let mut sums = Pressing::default();
    for _ in 0..balls.len() {
        let Some(ball) = balls.get_mut(index) else {
            break;
        };
        let force = f32::from_bits(bits as u32);
        let touches = left > 0;
        if touches {
            left -= 1;
            change += ball.slack;
            sums.force += next;
            largest = if bits > largest { bits } else { largest };
            // The sign bit of the negated bits: 1 for each force above zero.
            contacts += bits.wrapping_neg() as u32 >> 31;
        } else {
            left = ball.others();
            change = 0.0;
            if left > 0 {
                impedance = ball.of_cluster;
                change = ball.force / impedance;
            }
        }
        if touches || left > 0 {
            next = ball.growth * next + change * ball.impedance;
            bits = not_negative_bits(next);
            if left == 0 {
                (ball.slack, ball.of_cluster) = (next, impedance);
                let size = next.abs();
                sums.remainder = if size > sums.remainder {
                    size
                } else {
                    sums.remainder
                };
                next = 0.0;
                bits = 0;
            }
        }
        let settled = BallState {
            speed: ball.speed + change,
            behind: f32::from_bits(bits as u32),
            force,
            touches,
        };
        each(index, ball, &settled);
        index = if index == 0 { last } else { index - 1 };
    }
    Pressing {
        contacts: contacts as u8,
        largest: f32::from_bits(largest as u32),
        // Forces that rounding makes negative may leave a sum that is.
        force: not_negative(sums.force),
        ..sums
    }
}

/// Takes the remainders of clusters out of their forces, where they are more than a part of the largest force: a stiff ball turns a small one into a
/// large force. Shared out by impedance it changes all balls' speeds alike, by less than rounding. The rear ball of each cluster keeps the remainder,
/// and a walk forwards, which ends with the foremost ball, meets it first.
#[inline(always)]
pub(super) fn balance(balls: &mut [Ball], foremost: usize, pressing: &Pressing) {
    let least = ROUNDING * pressing.largest;
    if pressing.remainder > least {
        take_out(balls, foremost, least);
    }
}

#[cold]
#[inline(never)]
fn take_out(balls: &mut [Ball], foremost: usize, least: f32) {
    let last = balls.len().wrapping_sub(1);
    let mut index = foremost;
    // Balls still to come of the cluster, the change of its balls' speeds, and that of the next ball's force.
    let mut left = 0;
    let mut change = 0.0;
    let mut correction = 0.0;
    for _ in 0..balls.len() {
        index = if index == last { 0 } else { index + 1 };
        let Some(ball) = balls.get_mut(index) else {
            return;
        };
        if left == 0 {
            left = ball.others();
            if left == 0 {
                continue;
            }
            let remainder = ball.slack;
            correction = if remainder.abs() > least {
                remainder
            } else {
                0.0
            };
            change = correction / ball.of_cluster;
        } else {
            left -= 1;
            // The front ball presses on none.
            if left == 0 {
                continue;
            }
        }
        correction -= change * ball.impedance;
        if ball.growth != 1.0 {
            correction = before(correction, ball.growth);
        }
        ball.force = not_negative(ball.force - correction);
    }
}

/// A force in front of a ball that grows it; out of line, or the compiler divides for balls that do not rub, too.
#[inline(never)]
fn before(behind: f32, growth: f32) -> f32 {
    behind / growth
}

#[inline(always)]
pub(super) fn not_negative(force: f32) -> f32 {
    f32::from_bits(not_negative_bits(force) as u32)
}

/// The bits of a force, or of zero where it is negative: integers compare without a detour over the floating-point flags.
#[inline(always)]
pub(super) fn not_negative_bits(force: f32) -> i32 {
    let bits = force.to_bits() as i32;
    bits & !(bits >> 31)
}
