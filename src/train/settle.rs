//! Speeds and forces of all balls from their clusters, and where the balls go.

use super::balance::{ROUNDING, balance, not_negative, not_negative_bits};
use super::ball::Ball;
use super::ring::Rows;
use super::track::Motion;

/// What the contacts between balls add up to in a tick.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Pressing {
    /// Pairs that press on each other.
    pub(crate) contacts: u8,
    /// Largest force, in the unit of speed times impedance.
    pub(crate) largest: f32,
    /// Sum of the forces, in the same unit.
    pub(crate) force: f32,
}

/// Gives each ball its speed and its force, and moves it, from the foremost ball backwards.
#[inline(never)]
pub(super) fn settle(balls: &mut [Ball], foremost: usize, motion: Motion) -> Pressing {
    let mut settling = Settling {
        motion,
        // Nothing is near in front of the foremost one.
        limit: balls.get(foremost).map_or(0, |ball| motion.far_ahead(ball)),
        behind: 0,
        change: 0.0,
        force: 0.0,
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
        balance::<false>(balls, foremost, least);
    }
    Pressing {
        contacts: sums.contacts as u8,
        largest,
        // Forces that rounding makes negative may leave a sum that is.
        force: not_negative(sums.force),
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
    /// Net push that the balls of the cluster take so far, from its front ball on: the force of the next ball.
    force: f32,
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
        ball.settle(speed, self.sums.add(self.force));
        self.force += self.change * ball.impedance();
        self.behind -= 1;
        if self.behind == 0 {
            // Nothing pushes the rear ball.
            ball.leave_remainder(self.force);
            self.sums.keep_remainder(self.force);
        }
    }
}

/// Sums over the contacts.
#[derive(Default)]
struct Sums {
    contacts: u32,
    /// Bits of the largest force.
    largest: i32,
    force: f32,
    /// Largest remainder of a cluster, without sign.
    remainder: f32,
}

impl Sums {
    /// Adds a contact; gives its force, zero where rounding has made it a little less.
    #[inline(always)]
    fn add(&mut self, force: f32) -> f32 {
        let bits = not_negative_bits(force);
        self.force += force;
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
