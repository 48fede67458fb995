//! Pooling of adjacent violators: which balls of a row or a ring move as one.

use super::ball::Ball;

/// What rounding may leave of a cluster's pushes over the largest force before it is taken out.
const ROUNDING: f32 = 1e-6;

/// Balls that move as one: they touch, or close their last distance within the tick.
///
/// Speeds count from each ball's free speed, so that only what drives the balls together comes in, and
/// not the size of the speeds.
#[derive(Clone, Copy)]
struct Cluster {
    /// Sum of the impedances times how much slower than the front ball each ball has to grow.
    sum: f32,
    /// Sum of the impedances.
    weight: f32,
    /// Sum of the slacks between its balls.
    span: f32,
}

impl Cluster {
    /// Whether a single ball behind runs into the cluster; strict, so that equal speeds make no contact.
    #[inline(always)]
    fn reached(&self, slack: f32) -> bool {
        -(slack + self.span) * self.weight > self.sum
    }

    /// `self` and the cluster `ahead` as one, where `self` runs into it; as strict.
    #[inline(always)]
    fn joined(&self, slack: f32, ahead: &Self) -> Option<Self> {
        let reach = slack + ahead.span;
        let sum = self.sum - reach * self.weight;
        if sum * ahead.weight > ahead.sum * self.weight {
            Some(Self {
                sum: sum + ahead.sum,
                weight: self.weight + ahead.weight,
                span: self.span + reach,
            })
        } else {
            None
        }
    }
}

/// What the contacts between balls add up to in a tick.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Pressing {
    /// Pairs that press on each other.
    pub(crate) contacts: u8,
    /// Largest force.
    pub(crate) largest: f32,
    /// Sum of the forces.
    pub(crate) force: f32,
    /// Sum of the forces times the speeds of the balls behind.
    pub(crate) power: f32,
}

/// How far balls get in a tick.
#[derive(Clone, Copy)]
pub(super) struct Moves {
    /// Units that the nominal speed moves every ball.
    pub(super) whole: u32,
    /// Sixteenths of a unit by which a ball beyond that moves, over its speed.
    pub(super) scale: f32,
    /// Distance of two balls in contact, in units.
    pub(super) pitch: u32,
}

impl Moves {
    pub(super) const NONE: Self = Self {
        whole: 0,
        scale: 0.0,
        pitch: 0,
    };
}

/// A position keeps sixteenths of a unit: slow balls move by less than a unit in a tick.
pub(super) const FRACTIONS: f32 = 16.0;
const FRACTION_BITS: u32 = 4;

/// Distances this far below zero, in units, are contact: what rounding of two positions leaves.
pub(super) const OVERLAP: u32 = 1 << 10;

/// Joins balls to clusters and leaves these in the places of their front and rear balls; gives the index of
/// a ball that presses on none.
///
/// Balls are single, with their slacks. Joins may come in any order: none of them opens another one's contact.
#[inline(never)]
pub(super) fn pool(balls: &mut [Ball]) -> usize {
    // On a ring nothing is ahead of the last ball yet: it stands alone.
    let mut count = balls.len();
    'clusters: while let Some((alone, behind)) =
        balls.get_mut(..count).and_then(<[Ball]>::split_last_mut)
    {
        alone.extent = 0;
        // A single ball keeps its own speed, and so does what is behind it up to one that runs into the next, which
        // only a negative slack can.
        let mut behind = behind.iter_mut();
        let front = loop {
            let Some(ball) = behind.next_back() else {
                break 'clusters;
            };
            if (ball.slack.to_bits() as i32) < 0 {
                break behind.len() + 1;
            }
            ball.extent = 0;
        };
        count = grown(balls, front);
    }
    close(balls)
}

/// Stores the cluster that grows backwards from the ball `front`, into which the one behind it runs. Gives the
/// number of balls behind it.
#[inline(always)]
fn grown(balls: &mut [Ball], mut front: usize) -> usize {
    let mut behind = balls.get(..front).unwrap_or_default();
    let mut cluster = single(balls.get(front));
    loop {
        while let [rest @ .., ball] = behind {
            if !cluster.reached(ball.slack) {
                break;
            }
            let reach = ball.slack + cluster.span;
            cluster.sum -= reach * ball.impedance;
            cluster.weight += ball.impedance;
            cluster.span = reach;
            behind = rest;
        }
        // What the cluster runs into slows it down, and the ball behind may run into it after all.
        if front + 1 >= balls.len() {
            break;
        }
        let slack = balls.get(front).map_or(0.0, |ball| ball.slack);
        let next = front + 1 + extent(balls, front + 1);
        let Some(longer) = cluster.joined(slack, &stored(balls, next)) else {
            break;
        };
        cluster = longer;
        front = next;
    }
    let rear = behind.len();
    store(balls, rear, front, front - rear, &cluster);
    rear
}

/// On a ring the last cluster has the first one in front. Gives the index of a ball that presses on none.
#[inline(always)]
fn close(balls: &mut [Ball]) -> usize {
    let last = balls.len().wrapping_sub(1);
    let mut front = last;
    let mut ring = stored(balls, front);
    let mut count = extent(balls, front);
    let mut rear = front.wrapping_sub(count);
    // At most one cluster more or less with each turn.
    loop {
        let slack = balls.get(front).map_or(0.0, |ball| ball.slack);
        let next = if front == last { 0 } else { front + 1 };
        if next == rear {
            break;
        }
        let beyond = extent(balls, next);
        if let Some(joined) = ring.joined(slack, &stored(balls, next + beyond)) {
            ring = joined;
            front = next + beyond;
            count += 1 + beyond;
            continue;
        }
        if front == last {
            break;
        }
        let Some(behind) = balls.get(rear.wrapping_sub(1)) else {
            break;
        };
        let Some(joined) = stored(balls, rear.wrapping_sub(1)).joined(behind.slack, &ring) else {
            break;
        };
        let beyond = 1 + usize::from(behind.extent);
        ring = joined;
        rear = rear.wrapping_sub(beyond);
        count += beyond;
    }
    if front != last {
        store(balls, rear, front, count, &ring);
    }
    front
}

/// Balls of a cluster besides the one at its rear or front.
#[inline(always)]
fn extent(balls: &[Ball], end: usize) -> usize {
    balls.get(end).map_or(0, |ball| usize::from(ball.extent))
}

/// The cluster with this front ball.
#[inline(always)]
fn stored(balls: &[Ball], front: usize) -> Cluster {
    let front_ball = balls.get(front);
    let behind = front_ball.map_or(0, |ball| usize::from(ball.extent));
    let rear = balls.get(front.wrapping_sub(behind));
    match (front_ball, rear) {
        (Some(front), Some(rear)) if behind > 0 => Cluster {
            sum: front.sum,
            weight: front.force,
            span: rear.force,
        },
        _ => single(front_ball),
    }
}

/// A ball alone.
#[inline(always)]
fn single(ball: Option<&Ball>) -> Cluster {
    Cluster {
        sum: 0.0,
        weight: ball.map_or(1.0, |ball| ball.impedance),
        span: 0.0,
    }
}

/// Leaves a cluster in the places of its two ends, where forces will stand.
#[inline(always)]
fn store(balls: &mut [Ball], rear: usize, front: usize, extent: usize, cluster: &Cluster) {
    if let Some(ball) = balls.get_mut(rear) {
        ball.force = cluster.span;
        ball.sum = cluster.weight;
        ball.extent = extent as u8;
    }
    if let Some(ball) = balls.get_mut(front) {
        ball.force = cluster.weight;
        ball.sum = cluster.sum;
        ball.extent = extent as u8;
    }
}

/// Speeds and forces of all balls, and where they go, from the foremost one backwards.
///
/// From the front of a cluster, which presses on none, each ball is slower than its own free speed by a slack less
/// than the one in front of it, and passes on what it is pushed by beyond what it takes.
#[inline(never)]
pub(super) fn settle(balls: &mut [Ball], foremost: usize, moves: Moves) -> Pressing {
    // Balls of the present cluster that are still to come, the change of the last one's speed, and the force with
    // which the cluster so far asks to be pushed.
    let (mut left, mut change, mut force) = (0_u32, 0.0, 0.0);
    // Where the next ball touches the one in front; nothing is near in front of the foremost one.
    let mut limit = balls.get(foremost).map_or(0, |ball| {
        ball.position
            .wrapping_add(moves.whole.wrapping_add(1 << 30))
    });
    // Of forces that are not negative, the larger one has the larger bits.
    let (mut contacts, mut largest) = (0_u32, 0_i32);
    let (mut total, mut power, mut unbalanced) = (0.0, 0.0, 0.0);
    let (low, mut high) = balls.split_at_mut_checked(foremost + 1).unwrap_or_default();
    let mut part = low.iter_mut();
    loop {
        'part: loop {
            while left > 0 {
                let Some(ball) = part.next_back() else {
                    break 'part;
                };
                change += ball.slack;
                let speed = ball.speed + change;
                // Rounding may leave a little less than nothing.
                let bits = force_bits(force);
                ball.position = limit;
                limit = limit.wrapping_sub(moves.pitch);
                total += force;
                ball.speed = speed;
                power += force * speed;
                ball.force = f32::from_bits(bits as u32);
                largest = if bits > largest { bits } else { largest };
                contacts += bits.wrapping_neg() as u32 >> 31;
                force += change * ball.impedance;
                left -= 1;
                if left == 0 {
                    // Nothing pushes the last one. Kept for [`balance`].
                    ball.slack = ball.sum;
                    ball.sum = force;
                    let rest = force.abs();
                    unbalanced = if rest > unbalanced { rest } else { unbalanced };
                }
            }
            let front = loop {
                let Some(ball) = part.next_back() else {
                    break 'part;
                };
                if ball.extent > 0 {
                    break ball;
                }
                limit = ball.moved(limit, moves);
            };
            left = u32::from(front.extent);
            change = front.sum / front.force;
            force = change * front.impedance;
            front.speed += change;
            limit = front.moved(limit, moves);
        }
        if high.is_empty() {
            break;
        }
        part = core::mem::take(&mut high).iter_mut();
    }
    let largest = f32::from_bits(largest as u32);
    // What rounding leaves of the sum of a cluster's pushes is small, but a stiff ball turns it into a
    // large force. It hardly changes what the forces add up to.
    let least = ROUNDING * largest;
    if unbalanced > least {
        balance(balls, foremost, least);
    }
    Pressing {
        contacts: contacts as u8,
        largest,
        force: total,
        power,
    }
}

impl Ball {
    /// Moves a ball that presses on none, at most to `limit`; gives the limit of the one behind.
    #[inline(always)]
    fn moved(&mut self, limit: u32, moves: Moves) -> u32 {
        self.force = 0.0;
        let fractions = (self.speed * moves.scale) as i32;
        let fractions = fractions.wrapping_add(i32::from(self.fraction));
        let place = self.position.wrapping_add(moves.whole);
        let place = place.wrapping_add_signed(fractions >> FRACTION_BITS);
        // Clusters do not run into each other, but rounding may leave that much.
        let place = if limit.wrapping_sub(place) > u32::MAX - OVERLAP {
            limit
        } else {
            place
        };
        self.position = place;
        self.fraction = (fractions & 15) as u8;
        place.wrapping_sub(moves.pitch)
    }
}

/// The bits of a force, or of zero where it is negative.
#[inline(always)]
fn force_bits(force: f32) -> i32 {
    let bits = force.to_bits() as i32;
    bits & !(bits >> 31)
}

/// Takes what is left of the pushes of a cluster out of its forces, each ball's part by its impedance, where it is more
/// than `least`: from the ball in front of the foremost one on around the ring, so that a cluster begins with its rear
/// ball, which has what is left.
#[cold]
#[inline(never)]
fn balance(balls: &mut [Ball], foremost: usize, least: f32) {
    let (mut low, high) = balls.split_at_mut_checked(foremost + 1).unwrap_or_default();
    let mut part = high.iter_mut();
    // Balls of the present cluster that are still to come, and what of its rest they have to take.
    let (mut left, mut rate, mut correction) = (0_u32, 0.0, 0.0);
    loop {
        'part: loop {
            while left > 1 {
                let Some(ball) = part.next() else {
                    break 'part;
                };
                correction = ball.relieved(rate, correction);
                left -= 1;
            }
            // The front ball presses on none.
            if left == 1 && part.next().is_none() {
                break 'part;
            }
            left = 0;
            let rear = loop {
                let Some(ball) = part.next() else {
                    break 'part;
                };
                if ball.extent > 0 {
                    break ball;
                }
            };
            left = u32::from(rear.extent);
            correction = if rear.sum.abs() > least {
                rear.sum
            } else {
                0.0
            };
            rate = correction / rear.slack;
            correction = rear.relieved(rate, correction);
        }
        if low.is_empty() {
            break;
        }
        part = core::mem::take(&mut low).iter_mut();
    }
}

impl Ball {
    /// Takes a ball's part off a correction, and the rest of this off its force.
    #[inline(always)]
    fn relieved(&mut self, rate: f32, correction: f32) -> f32 {
        let correction = correction - rate * self.impedance;
        self.force = f32::from_bits(force_bits(self.force - correction) as u32);
        correction
    }
}
