//! Pooling of adjacent violators: which balls of a row or a ring move as one.

use super::ball::Ball;
use super::cluster::Cluster;

/// Joins balls to clusters and leaves these in their front and rear balls; gives the index of a ball that presses
/// on none.
///
/// Balls are taken in, with their slacks. Joins may come in any order: none of them opens another one's contact.
#[inline(always)]
pub(super) fn pool(balls: &mut [Ball]) -> usize {
    // Balls that belong to no cluster yet.
    let mut open = balls.len();
    while let Some(front) = balls.get_mut(..open).and_then(next_front) {
        open = grow(balls, front);
    }
    close(balls)
}

/// From the last of these balls backwards, the first one into which the one behind runs. Balls in front of it stand
/// alone: a single ball keeps its own speed, and so does all behind it up to a negative slack.
#[inline(always)]
fn next_front(balls: &mut [Ball]) -> Option<usize> {
    let (last, behind) = balls.split_last_mut()?;
    // On a ring nothing is ahead of the last ball yet.
    last.stand_alone();
    let mut behind = behind.iter_mut();
    while let Some(ball) = behind.next_back() {
        if ball.may_run_into_next() {
            return Some(behind.len() + 1);
        }
        ball.stand_alone();
    }
    None
}

/// Leaves the cluster that grows from the ball `front`, backwards and forwards in turn; gives the number of balls
/// behind it.
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

/// Joins across the place where the ring closes: the last cluster has the first one in front. Gives the index of a
/// ball that presses on none.
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
    /// Index of the last ball.
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

    /// Index of the ball ahead; the cluster's own rear ball where it is the whole ring.
    #[inline(always)]
    fn ahead(&self) -> usize {
        if self.front == self.last {
            0
        } else {
            self.front + 1
        }
    }

    /// Whether the cluster is the whole ring.
    #[inline(always)]
    fn is_ring(&self) -> bool {
        self.ahead() == self.rear
    }

    /// Joins the cluster ahead where this one runs into it.
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

    /// Joins the cluster behind where that runs into this one. As long as this one has not grown ahead, pooling has
    /// found already that it does not.
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

/// Balls of a cluster besides the one at its rear or front.
#[inline(always)]
fn others(balls: &[Ball], end: usize) -> usize {
    balls.get(end).map_or(0, Ball::others)
}

/// Slack between a ball and the one in front.
#[inline(always)]
fn slack(balls: &[Ball], ball: usize) -> f32 {
    balls.get(ball).map_or(0.0, |ball| ball.slack)
}
