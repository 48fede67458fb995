//! The same as `settle` for balls that rub on each other: what a ball passes on differs from ball to ball, and so does what it loses.

use super::balance::{ROUNDING, balance, not_negative, not_negative_bits};
use super::ball::Ball;
use super::losses::{Losses, RubbedRow};
use super::ring::Rows;
use super::track::Motion;

/// Gives each ball its speed and its force, from the foremost ball backwards; the last pass moves it and adds up what it loses.
#[inline(never)]
pub(super) fn settle_rubbing(
    balls: &mut [Ball],
    foremost: usize,
    motion: Motion,
    losses: &Losses,
    last: bool,
) -> RubbedRow {
    let mut settling = Settling {
        last,
        motion,
        losses: *losses,
        // Nothing is near in front of the foremost one.
        limit: balls.get(foremost).map_or(0, |ball| motion.far_ahead(ball)),
        behind: 0,
        change: 0.0,
        force: 0.0,
        impedance: 0.0,
        largest: 0,
        contacts: 0,
        remainder: 0.0,
        sums: RubbedRow::default(),
    };
    for row in Rows::backwards(balls, foremost) {
        settling.row(row);
    }
    let largest = f32::from_bits(settling.largest as u32);
    // What rounding leaves of the sum of a cluster's pushes is small, but a stiff ball turns it into a
    // large force. It hardly changes what the forces add up to.
    let least = ROUNDING * largest;
    if settling.remainder > least {
        balance::<true>(balls, foremost, least);
    }
    RubbedRow {
        contacts: settling.contacts as u8,
        largest,
        // Forces that rounding makes negative may leave a sum that is.
        forces: not_negative(settling.sums.forces),
        ..settling.sums
    }
}

/// A walk backwards over the balls.
struct Settling {
    /// Whether balls move, and lose.
    last: bool,
    motion: Motion,
    losses: Losses,
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
    /// Bits of the largest force.
    largest: i32,
    contacts: u32,
    /// Largest remainder of a cluster, without sign.
    remainder: f32,
    sums: RubbedRow,
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
        if self.last && ball.counts() {
            let (speed, slope) = (ball.speed(), ball.torque_slope());
            self.losses.add_alone(&mut self.sums, speed, slope);
        }
        self.advance(ball);
    }

    /// The front ball of a cluster has the common speed, and presses on none.
    #[inline(always)]
    fn front(&mut self, ball: &mut Ball) {
        self.behind = ball.others();
        self.change = ball.push() / ball.cluster_impedance();
        self.force = self.change * ball.impedance();
        self.impedance = ball.cluster_impedance();
        ball.settle(ball.free_speed() + self.change, 0.0);
        self.rub(ball, self.force, 0.0);
        self.advance(ball);
    }

    /// A ball behind the front one: its speed differs from its free speed by its slack more than that of the ball in
    /// front does, and its force on that one is the net push that the balls from there to the front take.
    #[inline(always)]
    fn pushing(&mut self, ball: &mut Ball) {
        self.change += ball.slack();
        let speed = ball.free_speed() + self.change;
        if self.last {
            ball.set_position(self.limit);
            self.limit = self.motion.touching(self.limit);
        }
        let force = self.add(self.force);
        ball.settle(speed, force);
        let push = self.change * ball.impedance();
        self.rub(ball, push, self.force);
        self.behind -= 1;
        if self.behind == 0 {
            // Nothing pushes the rear ball.
            ball.leave_remainder(self.force);
            ball.leave_remainder_impedance(self.impedance);
            let size = self.force.abs();
            self.remainder = if size > self.remainder {
                size
            } else {
                self.remainder
            };
        }
    }

    /// What a ball that rubs passes on: the force behind it, from its push and its force on the ball in front.
    #[inline(always)]
    fn rub(&mut self, ball: &Ball, push: f32, force: f32) {
        let per_passed = 1.0 / ball.transmitted();
        self.force = (force + push) * per_passed;
        self.impedance *= per_passed;
        self.lose(ball, force + self.force);
    }

    /// Adds what a ball loses with the forces of both neighbours.
    #[inline(always)]
    fn lose(&mut self, ball: &Ball, forces: f32) {
        if self.last && ball.counts() {
            let (speed, slope) = (ball.speed(), ball.torque_slope());
            self.losses.add(&mut self.sums, speed, slope, forces);
        }
    }

    #[inline(always)]
    fn advance(&mut self, ball: &mut Ball) {
        if self.last {
            self.limit = self.motion.advance(ball, self.limit);
        }
    }

    /// Counts a contact; gives its force, zero where rounding has made it a little less.
    #[inline(always)]
    fn add(&mut self, force: f32) -> f32 {
        let bits = not_negative_bits(force);
        self.largest = if bits > self.largest {
            bits
        } else {
            self.largest
        };
        // The sign bit of the negated bits: 1 for each force above zero.
        self.contacts += bits.wrapping_neg() as u32 >> 31;
        f32::from_bits(bits as u32)
    }
}
