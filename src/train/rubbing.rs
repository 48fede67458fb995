//! The same as `settle` for balls that rub on each other: what a ball passes on differs from ball to ball, and so do the sums.

use super::balance::{ROUNDING, balance, not_negative, not_negative_bits};
use super::ball::Ball;
use super::ring::Rows;
use super::settle::Pressing;
use super::track::Motion;

/// Gives each ball its speed and its force, and moves it, from the foremost ball backwards.
#[inline(never)]
pub(super) fn settle_rubbing(balls: &mut [Ball], foremost: usize, motion: Motion) -> Pressing {
    let mut settling = Settling {
        motion,
        // Nothing is near in front of the foremost one.
        limit: balls.get(foremost).map_or(0, |ball| motion.far_ahead(ball)),
        behind: 0,
        change: 0.0,
        force: 0.0,
        impedance: 0.0,
        ahead_rubs: false,
        sums: Sums::default(),
    };
    for row in Rows::backwards(balls, foremost) {
        settling.row(row);
    }
    let sums = settling.sums;
    let largest = f32::from_bits(sums.largest as u32);
    // What rounding leaves of the sum of a cluster's pushes is small, but a stiff ball turns it into a
    // large force. It hardly changes what the forces add up to.
    let least = ROUNDING * largest;
    if sums.remainder > least {
        balance::<true>(balls, foremost, least);
    }
    Pressing {
        contacts: sums.contacts as u8,
        largest,
        // Forces that rounding makes negative may leave a sum that is.
        force: not_negative(sums.force),
        work: sums.work,
        change: sums.change,
    }
}

/// A walk backwards over the balls.
struct Settling {
    motion: Motion,
    /// Where the next ball touches the one in front.
    limit: u32,
    /// Balls still to come of the cluster to which the last ball belongs.
    behind: usize,
    /// Actual speed of the last ball less its free speed, in a cluster.
    change: f32,
    /// Force with which the next ball presses.
    force: f32,
    /// Impedance of the cluster, as the last ball weighs it.
    impedance: f32,
    /// Whether the last ball rubs.
    ahead_rubs: bool,
    sums: Sums,
}

impl Settling {
    /// Settles a row. The walk through it may begin within a cluster whose front ball stood in the row before.
    #[inline(always)]
    fn row(&mut self, row: &mut [Ball]) {
        let mut row = row.iter_mut();
        loop {
            while self.behind > 0 {
                let Some(ball) = row.next_back() else {
                    return;
                };
                self.pushing(ball);
            }
            let Some(ball) = row.next_back() else {
                return;
            };
            if ball.others() > 0 {
                self.front(ball);
            } else {
                self.alone(ball);
            }
        }
    }

    /// A ball alone keeps its free speed and presses on none.
    #[inline(always)]
    fn alone(&mut self, ball: &mut Ball) {
        ball.settle_alone();
        self.limit = self.motion.advance(ball, self.limit);
    }

    /// The front ball of a cluster has the common speed, and presses on none.
    #[inline(always)]
    fn front(&mut self, ball: &mut Ball) {
        self.behind = ball.others();
        self.change = ball.push() / ball.cluster_impedance();
        self.force = self.change * ball.impedance();
        self.impedance = ball.cluster_impedance();
        self.rub(ball, self.force, 0.0);
        ball.settle(ball.free_speed() + self.change, 0.0);
        self.limit = self.motion.advance(ball, self.limit);
    }

    /// A ball behind the front one: its speed differs from its free speed by its slack more than that of the ball in
    /// front does, and its force on that one is the net push that the balls from there to the front take.
    #[inline(always)]
    fn pushing(&mut self, ball: &mut Ball) {
        self.change += ball.slack();
        let speed = ball.free_speed() + self.change;
        ball.set_position(self.limit);
        self.limit = self.motion.touching(self.limit);
        let counted = self.ahead_rubs && ball.rubs();
        ball.settle(speed, self.sums.add(self.force, counted));
        let push = self.change * ball.impedance();
        self.rub(ball, push, self.force);
        self.behind -= 1;
        if self.behind == 0 {
            // Nothing pushes the rear ball.
            ball.leave_remainder(self.force);
            ball.leave_remainder_impedance(self.impedance);
            self.sums.keep_remainder(self.force);
        }
    }

    /// What a ball that rubs passes on: the force behind it, from its push and its force on the ball in front, and its part of the sums.
    #[inline(always)]
    fn rub(&mut self, ball: &Ball, push: f32, force: f32) {
        let transmitted = ball.transmitted();
        let more = 1.0 + transmitted;
        // One division for both: 1/k, and 1 + r = 2/(1 + k).
        let both = 1.0 / (transmitted * more);
        let per_passed = more * both;
        let growth = 2.0 * transmitted * both;
        self.sums.work += self.change * push * growth;
        self.ahead_rubs = ball.rubs();
        self.sums.change += if self.ahead_rubs { self.change } else { 0.0 };
        self.force = (force + push) * per_passed;
        self.impedance *= per_passed;
    }
}

/// Sums over the contacts.
#[derive(Default)]
struct Sums {
    contacts: u32,
    /// Bits of the largest force.
    largest: i32,
    force: f32,
    work: f32,
    change: f32,
    /// Largest remainder of a cluster, without sign.
    remainder: f32,
}

impl Sums {
    /// Adds a contact, whose force may count in their sum; gives the force, zero where rounding has made it a little less.
    #[inline(always)]
    fn add(&mut self, force: f32, counted: bool) -> f32 {
        let bits = not_negative_bits(force);
        self.force += if counted { force } else { 0.0 };
        self.largest = if bits > self.largest {
            bits
        } else {
            self.largest
        };
        // The sign bit of the negated bits: 1 for each force above zero.
        self.contacts += bits.wrapping_neg() as u32 >> 31;
        f32::from_bits(bits as u32)
    }

    #[inline(always)]
    fn keep_remainder(&mut self, remainder: f32) {
        let size = remainder.abs();
        self.remainder = if size > self.remainder {
            size
        } else {
            self.remainder
        };
    }
}
