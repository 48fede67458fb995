//! Takes the remainder of rounding out of the forces of a cluster.

use super::ball::Ball;
use super::settle::Pressing;

/// Part of the largest force that rounding may leave of the sum of a cluster's net pushes before it is taken out:
/// some units in the last place of an `f32`.
const ROUNDING: f32 = 1e-6;

/// Takes what is left of the net pushes on clusters out of their forces, where it is more than a part of the largest force: small, but a stiff ball
/// turns it into a large force.
///
/// Shared out by impedance it changes all balls' speeds alike, by less than rounding. The rear ball of each cluster keeps the
/// cluster's remainder, and a walk forwards, which ends with the foremost ball, meets it first.
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
    // Balls still to come of the cluster, what its balls' speeds have to change by, and what the force of the next ball has to.
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
        correction = (correction - change * ball.impedance) / ball.growth;
        ball.force = not_negative(ball.force - correction);
    }
}

/// A force, or zero where it is negative.
#[inline(always)]
pub(super) fn not_negative(force: f32) -> f32 {
    f32::from_bits(not_negative_bits(force) as u32)
}

/// The bits of a force, or of zero where it is negative. Of forces that are not negative the larger one has the
/// larger bits, and those of zero are zero: integers compare without a detour over the floating-point flags.
#[inline(always)]
pub(super) fn not_negative_bits(force: f32) -> i32 {
    let bits = force.to_bits() as i32;
    bits & !(bits >> 31)
}
