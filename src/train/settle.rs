//! Speeds and forces of all balls from their clusters.

use super::balance::{not_negative, not_negative_bits};
use super::ball::Ball;

/// What a ball does in a tick.
pub(super) struct Settled {
    /// Actual speed.
    pub(super) speed: f32,
    /// Force of the ball behind, and the one on the ball in front.
    pub(super) behind: f32,
    pub(super) force: f32,
    /// Whether it touches the ball in front.
    pub(super) touches: bool,
}

/// What the contacts between balls add up to in a tick.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Pressing {
    /// Pairs that press on each other.
    pub(crate) contacts: u8,
    /// Largest force, in the unit of speed times impedance.
    pub(crate) largest: f32,
    /// Sum of the forces, in the same unit.
    pub(crate) force: f32,
    /// Largest remainder of a cluster, without sign.
    pub(super) remainder: f32,
}

/// Gives each ball its speed and its force, from the foremost ball backwards, and passes it on.
///
/// The front ball of a cluster presses on none. Each ball behind differs from its free speed by its slack more than the one in
/// front does; the force behind a ball is that in front of it and the net push that it needs. Nothing pushes the rear ball, but for roundings. A ball
/// alone keeps its free speed.
#[inline(always)]
pub(super) fn settle(
    balls: &mut [Ball],
    foremost: usize,
    mut each: impl FnMut(usize, &mut Ball, &Settled),
) -> Pressing {
    let last = balls.len().wrapping_sub(1);
    let mut index = foremost;
    // Balls still to come of the cluster, its impedance, the last ball's change of speed, the force with which the next one presses, and its bits, of zero
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
                ball.leave_remainder(next, impedance);
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
        let settled = Settled {
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
