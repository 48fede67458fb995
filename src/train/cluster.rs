//! The algebra of clusters: what a cluster is known by, when it runs into the next, what the two are as one.

use super::ball::Ball;

/// Balls that move as one: they touch, or close their last distance within the tick.
///
/// With the free speed `u`, impedance `Z'` and slack `s` of each ball and the front ball `f`, contact of all makes
/// the speed of ball `i`
///
/// ```text
/// v_i = u_i + (v_f - u_f) + S_i        S_i = s_i + ... + s_(f-1)
/// ```
///
/// and as no force acts on the cluster from outside, `sum w_i Z'_i (v_i - u_i) = 0` with the product `w_i` of the growths of all balls behind ball `i`
/// ([`FreeBall`](super::grip::FreeBall)), so that
///
/// ```text
/// v_f - u_f = push / impedance         push = -sum w_i Z'_i S_i        impedance = sum w_i Z'_i
/// ```
///
/// All speeds count from a ball's own free speed: sums hold what drives the balls together, and not the size of the
/// speeds, whose rounding would exceed it.
#[derive(Clone, Copy)]
pub(super) struct Cluster {
    /// Force with which the balls behind would push a front ball that kept its free speed.
    pub(super) push: f32,
    /// Sum of the impedances: the force that changes the cluster's speed by one.
    pub(super) impedance: f32,
    /// Sum of the slacks between the balls, from the rear ball to the front ball: `S` of the rear ball.
    pub(super) inner_slack: f32,
    /// Product of the growths of all its balls: the weight of a ball ahead. 1 where none rubs.
    pub(super) growth: f32,
}

impl Cluster {
    /// A ball alone.
    #[inline(always)]
    pub(super) fn single(ball: &Ball) -> Self {
        Self {
            push: 0.0,
            impedance: ball.impedance,
            inner_slack: 0.0,
            growth: ball.growth,
        }
    }

    /// Whether a single ball behind, with its slack to the rear ball, runs into the cluster:
    /// `-(slack + inner slack) > push / impedance`, without the division.
    ///
    /// Strict: a ball exactly as fast as the cluster would join it with zero force, that is with a force of the size
    /// of rounding, and count as a contact. Balls at equal speeds make no contact. NaN joins nothing.
    #[inline(always)]
    pub(super) fn reached_by(&self, slack: f32) -> bool {
        -(slack + self.inner_slack) * self.impedance > self.push
    }

    /// With the ball behind, which has run into it.
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

    /// This cluster and the one ahead as one, where this one, with the slack of its front ball, runs into that;
    /// strict for the reason of [`Cluster::reached_by`].
    ///
    /// Seen from the front ball ahead, each ball of this cluster has a slack larger by that between the two and the
    /// inner one ahead. What pushes then is compared by `push / impedance` of the two, crosswise multiplied.
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

    /// The cluster with this front ball.
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

    /// Leaves the cluster of `others` and one more balls in its two end balls. Of a single ball both ends are one.
    #[inline(always)]
    pub(super) fn leave(&self, balls: &mut [Ball], rear: usize, front: usize, others: usize) {
        if let Some(ball) = balls.get_mut(rear) {
            ball.set_rear(others, self.growth, self.inner_slack);
        }
        if let Some(ball) = balls.get_mut(front) {
            ball.set_front(others, self.impedance, self.push);
        }
    }
}
