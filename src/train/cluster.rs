//! The algebra of clusters: what a cluster is known by, when it runs into the next, what the two are as one.

use super::ball::Ball;

/// Balls that move as one: they touch, or close their last distance within the tick.
///
/// With the free speed `u`, impedance `Z` and slack `s` of each ball and the front ball `f`, contact of all makes
/// the speed of ball `i`
///
/// ```text
/// v_i = u_i + (v_f - u_f) + S_i        S_i = s_i + ... + s_(f-1)
/// ```
///
/// and as no force acts on the cluster from outside, `sum Z_i (v_i - u_i) = 0`, so that
///
/// ```text
/// v_f - u_f = push / impedance         push = -sum Z_i S_i        impedance = sum Z_i
/// ```
///
/// All speeds count from a ball's own free speed: sums hold what drives the balls together, and not the size of the
/// speeds, whose rounding would exceed it.
///
/// Where balls rub, each impedance in these sums is weighed by the product of what the balls ahead of it in the cluster pass on ([`Grip`](super::grip::Grip)).
#[derive(Clone, Copy)]
pub(super) struct Cluster {
    /// Force with which the balls behind would push a front ball that kept its free speed.
    pub(super) push: f32,
    /// Sum of the impedances: the force that changes the cluster's speed by one.
    pub(super) impedance: f32,
    /// Sum of the slacks between the balls, from the rear ball to the front ball: `S` of the rear ball.
    pub(super) inner_slack: f32,
    /// Product of what its balls pass on: the weight of the ball behind. 1 where none rubs.
    pub(super) tail: f32,
}

impl Cluster {
    /// A ball alone.
    #[inline(always)]
    pub(super) fn single<const RUBBED: bool>(ball: &Ball) -> Self {
        Self {
            push: 0.0,
            impedance: ball.impedance(),
            inner_slack: 0.0,
            tail: transmitted::<RUBBED>(ball),
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
    pub(super) fn grown<const RUBBED: bool>(&self, behind: &Ball) -> Self {
        let slack = behind.slack() + self.inner_slack;
        let impedance = self.weighed::<RUBBED>(behind.impedance());
        Self {
            push: self.push - slack * impedance,
            impedance: self.impedance + impedance,
            inner_slack: slack,
            tail: self.weighed::<RUBBED>(transmitted::<RUBBED>(behind)),
        }
    }

    /// A number of what is behind, as the front ball weighs it.
    #[inline(always)]
    fn weighed<const RUBBED: bool>(&self, number: f32) -> f32 {
        if RUBBED { self.tail * number } else { number }
    }

    /// This cluster and the one ahead as one, where this one, with the slack of its front ball, runs into that;
    /// strict for the reason of [`Cluster::reached_by`].
    ///
    /// Seen from the front ball ahead, each ball of this cluster has a slack larger by that between the two and the
    /// inner one ahead. What pushes then is compared by `push / impedance` of the two, crosswise multiplied.
    #[inline(always)]
    pub(super) fn joined<const RUBBED: bool>(&self, slack: f32, ahead: &Self) -> Option<Self> {
        let slack = slack + ahead.inner_slack;
        let push = self.push - slack * self.impedance;
        if push * ahead.impedance > ahead.push * self.impedance {
            Some(Self {
                push: ahead.weighed::<RUBBED>(push) + ahead.push,
                impedance: ahead.weighed::<RUBBED>(self.impedance) + ahead.impedance,
                inner_slack: self.inner_slack + slack,
                tail: ahead.weighed::<RUBBED>(self.tail),
            })
        } else {
            None
        }
    }

    /// The cluster with this front ball.
    #[inline(always)]
    pub(super) fn at<const RUBBED: bool>(balls: &[Ball], front: usize) -> Self {
        let Some(front_ball) = balls.get(front) else {
            return Self::single::<RUBBED>(&Ball::IDLE);
        };
        let others = front_ball.others();
        match balls.get(front.wrapping_sub(others)) {
            Some(rear_ball) if others > 0 => Self {
                push: front_ball.push(),
                impedance: front_ball.cluster_impedance(),
                inner_slack: rear_ball.inner_slack(),
                tail: if RUBBED { rear_ball.tail() } else { 1.0 },
            },
            _ => Self::single::<RUBBED>(front_ball),
        }
    }

    /// Leaves the cluster of `others` and one more balls in its two end balls. Of a single ball both ends are one.
    #[inline(always)]
    pub(super) fn leave<const RUBBED: bool>(
        &self,
        balls: &mut [Ball],
        rear: usize,
        front: usize,
        others: usize,
    ) {
        if let Some(ball) = balls.get_mut(rear) {
            let of_cluster = if RUBBED { self.tail } else { self.impedance };
            ball.set_rear(others, of_cluster, self.inner_slack);
        }
        if let Some(ball) = balls.get_mut(front) {
            ball.set_front(others, self.impedance, self.push);
        }
    }
}

/// Part of the force behind a ball that the ball in front feels.
#[inline(always)]
fn transmitted<const RUBBED: bool>(ball: &Ball) -> f32 {
    if RUBBED { ball.transmitted() } else { 1.0 }
}
