//! Takes the remainder of rounding out of the forces of a cluster.

use super::ball::Ball;
use super::ring::Rows;

/// Part of the largest force that rounding may leave of the sum of a cluster's net pushes before it is taken out:
/// some units in the last place of an `f32`.
pub(super) const ROUNDING: f32 = 1e-6;

/// Takes what is left of the net pushes on a cluster out of its forces, where it is more than `least`.
///
/// The remainder, passed on to the ball with the least impedance, could exceed all that presses on it; shared out by
/// impedance it changes all balls' speeds alike, by less than rounding. The rear ball of each cluster keeps the
/// cluster's remainder, and a walk forwards meets it first.
#[cold]
#[inline(never)]
pub(super) fn balance<const RUBBED: bool>(balls: &mut [Ball], foremost: usize, least: f32) {
    let mut balancing = Balancing::<RUBBED> {
        least,
        ahead: 0,
        rate: 0.0,
        correction: 0.0,
    };
    for row in Rows::forwards(balls, foremost) {
        balancing.row(row);
    }
}

/// A walk forwards over the balls.
struct Balancing<const RUBBED: bool> {
    least: f32,
    /// Balls still to come of the cluster to which the last ball belongs.
    ahead: usize,
    /// Correction over impedance: what the speeds of the cluster's balls have to change by.
    rate: f32,
    /// What the balls still to come have to take.
    correction: f32,
}

impl<const RUBBED: bool> Balancing<RUBBED> {
    /// Balances a row. The walk through it may begin within a cluster whose rear ball stood in the row before.
    #[inline(always)]
    fn row(&mut self, row: &mut [Ball]) {
        let mut row = row.iter_mut();
        loop {
            while self.ahead > 0 {
                let Some(ball) = row.next() else {
                    return;
                };
                self.ahead -= 1;
                // The front ball presses on none.
                if self.ahead > 0 {
                    self.relieve(ball);
                }
            }
            let Some(ball) = row.next() else {
                return;
            };
            if ball.others() > 0 {
                self.rear(ball);
            }
        }
    }

    /// The rear ball of a cluster, which keeps the cluster's remainder.
    #[inline(always)]
    fn rear(&mut self, ball: &mut Ball) {
        self.ahead = ball.others();
        let remainder = ball.remainder();
        self.correction = if remainder.abs() > self.least {
            remainder
        } else {
            0.0
        };
        self.rate = self.correction / ball.remainder_impedance();
        self.relieve(ball);
    }

    /// Takes a ball's part out of the correction and what then is left of it out of the ball's force.
    #[inline(always)]
    fn relieve(&mut self, ball: &mut Ball) {
        let passed = if RUBBED {
            self.correction * ball.transmitted()
        } else {
            self.correction
        };
        self.correction = passed - self.rate * ball.impedance();
        ball.set_force(not_negative(ball.force() - self.correction));
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
