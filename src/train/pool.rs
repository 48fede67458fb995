//! Pooling of adjacent violators: which balls of a row or a ring move as one.

use super::ball::Ball;

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
    let mut closing = Closing::new(balls, last);
    // Each turn but the last makes one cluster of two.
    while !closing.is_ring() && (closing.joins_ahead(balls) || closing.joins_behind(balls)) {}
    if closing.front != last {
        closing
            .cluster
            .leave(balls, closing.rear, closing.front, closing.others);
    }
    closing.front
}

/// The cluster of the last ball, which may grow around the place where the ring closes.
struct Closing {
    cluster: Cluster,
    last: usize,
    rear: usize,
    front: usize,
    /// Balls besides one.
    others: usize,
}

impl Closing {
    #[inline(always)]
    fn new(balls: &[Ball], last: usize) -> Self {
        let others = others(balls, last);
        Self {
            cluster: Cluster::at(balls, last),
            last,
            rear: last.wrapping_sub(others),
            front: last,
            others,
        }
    }

    #[inline(always)]
    fn ahead(&self) -> usize {
        if self.front == self.last {
            0
        } else {
            self.front + 1
        }
    }

    #[inline(always)]
    fn is_ring(&self) -> bool {
        self.ahead() == self.rear
    }

    #[inline(always)]
    fn joins_ahead(&mut self, balls: &[Ball]) -> bool {
        let slack = slack(balls, self.front);
        let ahead = self.ahead();
        let beyond = others(balls, ahead);
        let cluster_ahead = Cluster::at(balls, ahead + beyond);
        let Some(joined) = self.cluster.joined(slack, &cluster_ahead) else {
            return false;
        };
        self.cluster = joined;
        self.front = ahead + beyond;
        self.others += 1 + beyond;
        true
    }

    /// Joins the cluster behind where that runs into this one; before this one has grown ahead it does not.
    #[inline(always)]
    fn joins_behind(&mut self, balls: &[Ball]) -> bool {
        if self.front == self.last {
            return false;
        }
        let front = self.rear.wrapping_sub(1);
        let Some(ball) = balls.get(front) else {
            return false;
        };
        let behind = Cluster::at(balls, front);
        let Some(joined) = behind.joined(ball.slack, &self.cluster) else {
            return false;
        };
        let beyond = 1 + ball.others();
        self.cluster = joined;
        self.rear = self.rear.wrapping_sub(beyond);
        self.others += beyond;
        true
    }
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
