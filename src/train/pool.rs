//! Which balls of a row or a ring move as one, by pooling of adjacent violators; then speeds and forces of all balls from their clusters.

use super::press::Ball;
use super::tick::Neighbours;

/// Joins balls that are taken in to clusters and leaves these in their front and rear balls; gives the index of a ball that presses on none.
#[inline(always)]
pub(super) fn pool(balls: &mut [Ball]) -> usize {
    // Balls that belong to no cluster yet.
    let mut open = balls.len();
    while let Some(front) = balls.get_mut(..open).and_then(next_front) {
        open = grow(balls, front);
    }
    close(balls)
}

/// From the last of these balls backwards, the first one into which the one behind runs. Balls in front of it stand alone.
#[inline(always)]
fn next_front(balls: &mut [Ball]) -> Option<usize> {
    let (last, behind) = balls.split_last_mut()?;
    // On a ring nothing is ahead of the last ball yet.
    last.others = 0;
    let mut behind = behind.iter_mut();
    while let Some(ball) = behind.next_back() {
        if ball.may_run_into_next() {
            return Some(behind.len() + 1);
        }
        ball.others = 0;
    }
    None
}

/// Leaves the cluster that grows from the ball `front`, backwards and forwards in turn; gives the number of balls behind it.
#[inline(always)]
fn grow(balls: &mut [Ball], mut front: usize) -> usize {
    let mut behind = balls.get(..front).unwrap_or_default();
    let mut cluster = balls
        .get(front)
        .map_or(Cluster::single(&Ball::IDLE), Cluster::single);
    loop {
        while let [further @ .., ball] = behind {
            if !cluster.reached_by(ball.slack) {
                break;
            }
            cluster = cluster.grown(ball);
            behind = further;
        }
        // What the cluster runs into slows it down, and the ball behind may run into it after all.
        if front + 1 >= balls.len() {
            break;
        }
        let next = front + 1 + others(balls, front + 1);
        let ahead = Cluster::at(balls, next);
        let Some(longer) = cluster.joined(slack(balls, front), &ahead) else {
            break;
        };
        cluster = longer;
        front = next;
    }
    let rear = behind.len();
    cluster.leave(balls, rear, front, front - rear);
    rear
}

/// Joins across the place where the ring closes. Gives the index of a ball that presses on none.
#[inline(always)]
fn close(balls: &mut [Ball]) -> usize {
    let last = balls.len().wrapping_sub(1);
    // The cluster of the last ball, which may grow around that place.
    let mut cluster = Cluster::at(balls, last);
    let (mut rear, mut front) = (last.wrapping_sub(others(balls, last)), last);
    // Each turn but the last makes one cluster of two.
    loop {
        let ahead = if front == last { 0 } else { front + 1 };
        if ahead == rear {
            break;
        }
        let next = ahead + others(balls, ahead);
        if let Some(joined) = cluster.joined(slack(balls, front), &Cluster::at(balls, next)) {
            (cluster, front) = (joined, next);
            continue;
        }
        // Before this one has grown ahead, the cluster behind does not run into it.
        if front == last {
            break;
        }
        let behind = rear.wrapping_sub(1);
        let Some(ball) = balls.get(behind) else {
            break;
        };
        let Some(joined) = Cluster::at(balls, behind).joined(ball.slack, &cluster) else {
            break;
        };
        (cluster, rear) = (joined, behind.wrapping_sub(ball.others()));
    }
    if front != last {
        let behind = last.wrapping_sub(rear);
        cluster.leave(balls, rear, front, behind + 1 + front);
    }
    front
}

#[inline(always)]
fn others(balls: &[Ball], end: usize) -> usize {
    balls.get(end).map_or(0, Ball::others)
}

#[inline(always)]
fn slack(balls: &[Ball], ball: usize) -> f32 {
    balls.get(ball).map_or(0.0, |ball| ball.slack)
}

/// Balls that move as one. With the free speed `u`, impedance `Z'` and slack `s` of each ball and the front ball `f`, contact of all makes
/// the speed of ball `i`
///
/// ```text
/// v_i = u_i + (v_f - u_f) + S_i        S_i = s_i + ... + s_(f-1)
/// ```
///
/// and as no force acts on the cluster from outside, `sum w_i Z'_i (v_i - u_i) = 0` with the product `w_i` of the growths of all balls behind ball `i`
/// ([`FreeBall`](super::FreeBall)), so that
///
/// ```text
/// v_f - u_f = push / impedance         push = -sum w_i Z'_i S_i        impedance = sum w_i Z'_i
/// ```
#[derive(Clone, Copy)]
pub(super) struct Cluster {
    /// Force of the balls behind on a front ball that keeps its free speed.
    pub(super) push: f32,
    /// Sum of the impedances: the force that changes the cluster's speed by one.
    pub(super) impedance: f32,
    /// Sum of the slacks between the balls, from the rear ball to the front ball: `S` of the rear ball.
    pub(super) inner_slack: f32,
    /// Product of the growths of all its balls: the weight of a ball ahead. 1 where none rubs.
    pub(super) growth: f32,
}

impl Cluster {
    #[inline(always)]
    pub(super) fn single(ball: &Ball) -> Self {
        Self {
            push: 0.0,
            impedance: ball.impedance,
            inner_slack: 0.0,
            growth: ball.growth,
        }
    }

    /// Whether a single ball behind, with its slack to the rear ball, runs into the cluster: `-(slack + inner slack) > push / impedance`,
    /// strictly. NaN joins nothing.
    #[inline(always)]
    pub(super) fn reached_by(&self, slack: f32) -> bool {
        -(slack + self.inner_slack) * self.impedance > self.push
    }

    #[inline(always)]
    pub(super) fn grown(&self, behind: &Ball) -> Self {
        let slack = behind.slack + self.inner_slack;
        Self {
            push: behind.growth * self.push - slack * behind.impedance,
            impedance: behind.growth * self.impedance + behind.impedance,
            inner_slack: slack,
            growth: behind.growth * self.growth,
        }
    }

    /// This cluster and the one ahead as one, where this one, with the slack of its front ball, runs into that: `push / impedance` of the two,
    /// seen from the front ball ahead, are compared crosswise multiplied.
    #[inline(always)]
    pub(super) fn joined(&self, slack: f32, ahead: &Self) -> Option<Self> {
        let slack = slack + ahead.inner_slack;
        let push = self.push - slack * self.impedance;
        if push * ahead.impedance > ahead.push * self.impedance {
            Some(Self {
                push: push + self.growth * ahead.push,
                impedance: self.impedance + self.growth * ahead.impedance,
                inner_slack: self.inner_slack + slack,
                growth: self.growth * ahead.growth,
            })
        } else {
            None
        }
    }

    #[inline(always)]
    pub(super) fn at(balls: &[Ball], front: usize) -> Self {
        let Some(front_ball) = balls.get(front) else {
            return Self::single(&Ball::IDLE);
        };
        let others = front_ball.others();
        match balls.get(front.wrapping_sub(others)) {
            Some(rear_ball) if others > 0 => Self {
                push: front_ball.force,
                impedance: front_ball.of_cluster,
                inner_slack: rear_ball.force,
                growth: rear_ball.of_cluster,
            },
            _ => Self::single(front_ball),
        }
    }

    /// Leaves the cluster of `others` and one more balls in its two end balls.
    #[inline(always)]
    pub(super) fn leave(&self, balls: &mut [Ball], rear: usize, front: usize, others: usize) {
        if let Some(ball) = balls.get_mut(rear) {
            ball.force = self.inner_slack;
            ball.of_cluster = self.growth;
            ball.others = others as u8;
        }
        if let Some(ball) = balls.get_mut(front) {
            ball.force = self.push;
            ball.of_cluster = self.impedance;
            ball.others = others as u8;
        }
    }
}

/// Part of the largest force that rounding may leave of the sum of a cluster's net pushes.
pub(super) const ROUNDING: f32 = 1e-6;

/// A ball with its actual speed, and the force on the ball in front.
pub(super) struct BallState {
    pub(super) neighbours: Neighbours,
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
    let (mut left, mut impedance, mut change, mut next) = (0, 0.0, 0.0, 0.0);
    let mut bits = 0_i32;
    // Part of the force in front that rubs.
    let mut rubs_ahead = 0.0;
    let (mut contacts, mut largest) = (0, 0);
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
                sums.remainder = larger(size, sums.remainder);
                (next, bits) = (0.0, 0);
            }
        }
        let behind = f32::from_bits(bits as u32);
        let rubs_behind = ball.rubs() * behind;
        let settled = BallState {
            neighbours: Neighbours {
                speed: ball.speed + change,
                forces: force + behind,
                rubbing: rubs_ahead + rubs_behind,
            },
            force,
            touches,
        };
        rubs_ahead = rubs_behind;
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

/// Takes the remainders of clusters above `least` out of their forces: a stiff ball turns a small one into a large force. Shared out by impedance it
/// changes all balls' speeds alike, by less than rounding. The rear ball of each cluster keeps the remainder, and a walk forwards, which ends
/// with the foremost ball, meets it first.
#[cold]
#[inline(never)]
pub(super) fn take_out(balls: &mut [Ball], foremost: usize, least: f32) {
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
fn larger(one: f32, other: f32) -> f32 {
    if one > other { one } else { other }
}

#[inline(always)]
fn not_negative(force: f32) -> f32 {
    f32::from_bits(not_negative_bits(force) as u32)
}

/// The bits of a force, or of zero where it is negative: integers compare without a detour over the floating-point flags.
#[inline(always)]
fn not_negative_bits(force: f32) -> i32 {
    let bits = force.to_bits() as i32;
    bits & !(bits >> 31)
}
