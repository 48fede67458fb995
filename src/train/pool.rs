//! Pooling of adjacent violators: which balls of a row or a ring move as one.

use super::ball::Ball;

/// What rounding may leave of a cluster's pushes over the largest force before it is taken out.
const ROUNDING: f32 = 4e-7;

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
    const NONE: Self = Self {
        sum: 0.0,
        weight: 1.0,
        span: 0.0,
    };

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

/// What happens to a ball once its speed is known, from the foremost one backwards.
pub(super) trait Place {
    /// The foremost ball, before it moves.
    fn start(&mut self, ball: &Ball);
    /// A ball with nothing to press on.
    fn free(&mut self, ball: &mut Ball);
    /// A ball that presses on the last one.
    fn touching(&mut self, ball: &mut Ball);
}

/// Nothing more.
impl Place for () {
    #[inline(always)]
    fn start(&mut self, _: &Ball) {}
    #[inline(always)]
    fn free(&mut self, _: &mut Ball) {}
    #[inline(always)]
    fn touching(&mut self, _: &mut Ball) {}
}

/// Joins balls to clusters and leaves these in the places of their front and rear balls; gives the index of
/// a ball that presses on none.
///
/// Balls are single, with their slacks. Joins may come in any order: none of them opens another one's contact.
#[inline(always)]
pub(super) fn pool<const N: usize>(balls: &mut [Ball; N]) -> usize {
    // On a ring nothing is ahead of the last ball yet: it stands alone.
    let mut front = N - 1;
    // A single ball keeps its own speed, and so does what is behind it up to one that runs into the next.
    while let Some(rear) = balls
        .get(..front)
        .and_then(|behind| behind.iter().rposition(|ball| ball.slack < 0.0))
    {
        front = grown(balls, rear);
    }
    close(balls)
}

/// Stores the cluster that grows backwards from the ball `rear` and the single one in front of it. Gives the
/// ball where it ends, which stands alone, or 0.
#[inline(always)]
fn grown<const N: usize>(balls: &mut [Ball; N], rear: usize) -> usize {
    let mut front = rear + 1;
    let mut cluster = Cluster {
        sum: 0.0,
        weight: balls.get(front).map_or(1.0, |ball| ball.impedance),
        span: 0.0,
    };
    let mut index = rear;
    while let Some(ball) = balls.get(index) {
        let (slack, impedance) = (ball.slack, ball.impedance);
        if index != rear && !cluster.reached(slack) {
            // What the cluster runs into slows it down, and the ball may run into it after all.
            (cluster, front) = absorbed(balls, front, &cluster);
            if !cluster.reached(slack) {
                store(balls, index + 1, front, front - (index + 1), &cluster);
                return index;
            }
        }
        let reach = slack + cluster.span;
        cluster.sum -= reach * impedance;
        cluster.weight += impedance;
        cluster.span = reach;
        index = index.wrapping_sub(1);
    }
    (cluster, front) = absorbed(balls, front, &cluster);
    store(balls, 0, front, front, &cluster);
    0
}

/// A cluster with what stands in front of it as far as it runs into that, and its front ball.
#[inline(always)]
fn absorbed<const N: usize>(
    balls: &[Ball; N],
    mut front: usize,
    cluster: &Cluster,
) -> (Cluster, usize) {
    let mut cluster = *cluster;
    while front < N - 1 {
        let slack = balls.get(front).map_or(0.0, |ball| ball.slack);
        let next = front + 1 + extent(balls, front + 1);
        let Some(longer) = cluster.joined(slack, &stored(balls, next)) else {
            break;
        };
        cluster = longer;
        front = next;
    }
    (cluster, front)
}

/// On a ring the last cluster has the first one in front. Gives the index of a ball that presses on none.
#[inline(always)]
fn close<const N: usize>(balls: &mut [Ball; N]) -> usize {
    let mut front = N - 1;
    let mut ring = stored(balls, front);
    let mut count = extent(balls, front);
    let mut rear = front.wrapping_sub(count);
    // At most one cluster more or less with each turn.
    loop {
        let slack = balls.get(front).map_or(0.0, |ball| ball.slack);
        let next = if front == N - 1 { 0 } else { front + 1 };
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
        if front == N - 1 {
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
    if front != N - 1 {
        store(balls, rear, front, count, &ring);
    }
    front
}

/// Balls of a cluster besides the one at its rear or front.
#[inline(always)]
fn extent<const N: usize>(balls: &[Ball; N], end: usize) -> usize {
    balls.get(end).map_or(0, |ball| usize::from(ball.extent))
}

/// The cluster with this front ball.
#[inline(always)]
fn stored<const N: usize>(balls: &[Ball; N], front: usize) -> Cluster {
    let Some(ball) = balls.get(front) else {
        return Cluster::NONE;
    };
    if ball.extent == 0 {
        return Cluster {
            sum: 0.0,
            weight: ball.impedance,
            span: 0.0,
        };
    }
    let rear = front.wrapping_sub(usize::from(ball.extent));
    Cluster {
        sum: ball.sum,
        weight: ball.force,
        span: balls.get(rear).map_or(0.0, |ball| ball.force),
    }
}

/// Leaves a cluster in the places of its two ends, where forces will stand.
#[inline(always)]
fn store<const N: usize>(
    balls: &mut [Ball; N],
    rear: usize,
    front: usize,
    extent: usize,
    cluster: &Cluster,
) {
    if let Some(ball) = balls.get_mut(rear) {
        ball.force = cluster.span;
        ball.extent = extent as u8;
    }
    if let Some(ball) = balls.get_mut(front) {
        ball.force = cluster.weight;
        ball.sum = cluster.sum;
        ball.extent = extent as u8;
    }
}

/// Speeds and forces of all balls, from the foremost one backwards.
///
/// From the front of a cluster, which presses on none, each ball is slower than its own free speed by a slack less
/// than the one in front of it, and passes on what it is pushed by beyond what it takes.
#[inline(always)]
pub(super) fn settle<const N: usize>(
    balls: &mut [Ball; N],
    foremost: usize,
    place: &mut impl Place,
) -> Pressing {
    if let Some(ball) = balls.get(foremost) {
        place.start(ball);
    }
    let Some((low, high)) = balls.split_at_mut_checked(foremost + 1) else {
        return Pressing::default();
    };
    let mut pressing = Pressing::default();
    // Of forces that are not negative, the larger one has the larger bits.
    let mut largest = 0_i32;
    let mut unbalanced = 0.0;
    let (mut left, mut change, mut force) = (0_u8, 0.0, 0.0);
    for segment in [low, high] {
        for ball in segment.iter_mut().rev() {
            if left == 0 {
                ball_in_front(ball, &mut left, &mut change, &mut force);
                place.free(ball);
            } else {
                left -= 1;
                change += ball.slack;
                let speed = ball.speed + change;
                // Rounding may leave a little less than nothing.
                let bits = force_bits(force);
                ball.speed = speed;
                ball.force = f32::from_bits(bits as u32);
                largest = if bits > largest { bits } else { largest };
                pressing.contacts += (bits.wrapping_neg() as u32 >> 31) as u8;
                pressing.force += force;
                pressing.power += force * speed;
                force += change * ball.impedance;
                place.touching(ball);
                if left == 0 {
                    // Nothing pushes the last one.
                    ball.sum = force;
                    let rest = force.abs();
                    unbalanced = if rest > unbalanced { rest } else { unbalanced };
                }
            }
        }
    }
    pressing.largest = f32::from_bits(largest as u32);
    // What rounding leaves of the sum of a cluster's pushes is small, but a stiff ball turns it into a
    // large force. It hardly changes what the forces add up to.
    let least = ROUNDING * pressing.largest;
    if unbalanced > least {
        balance(balls, foremost, least);
    }
    pressing
}

#[inline(always)]
fn ball_in_front(ball: &mut Ball, left: &mut u8, change: &mut f32, force: &mut f32) {
    if ball.extent > 0 {
        *left = ball.extent;
        *change = ball.sum / ball.force;
        // Kept for [`balance`].
        ball.sum = ball.force;
        *force = *change * ball.impedance;
        ball.speed += *change;
    }
    ball.force = 0.0;
}

/// The bits of a force, or of zero where it is negative.
#[inline(always)]
fn force_bits(force: f32) -> i32 {
    let bits = force.to_bits() as i32;
    bits & !(bits >> 31)
}

/// Takes what is left of the pushes of a cluster out of its forces, where it is more than `least`.
#[cold]
#[inline(never)]
fn balance<const N: usize>(balls: &mut [Ball; N], foremost: usize, least: f32) {
    // Balls up to the foremost one, then those beyond it, less what a cluster across the ring's end has of them.
    let (mut low, mut high) = (0, foremost + 1);
    for _ in 0..2 {
        let mut next = N;
        while let Some(front) = balls
            .get(low..high)
            .and_then(|part| part.iter().rposition(|ball| ball.extent > 0))
        {
            let front = front + low;
            let rear = front.wrapping_sub(extent(balls, front));
            let closes = rear >= N;
            let rear = if closes { rear.wrapping_add(N) } else { rear };
            let rest = balls.get(rear).map_or(0.0, |ball| ball.sum);
            if rest.abs() > least {
                let mut relief = Relief::new(balls.get(front), rest);
                if closes {
                    relief.apply(balls.get_mut(..front));
                    relief.apply(balls.get_mut(rear..));
                } else {
                    relief.apply(balls.get_mut(rear..front));
                }
            }
            if closes {
                next = rear;
                break;
            }
            high = rear;
        }
        (low, high) = (foremost + 1, next);
    }
}

/// What is taken out of the forces of a cluster, each ball's part by its impedance.
struct Relief {
    rate: f32,
    correction: f32,
}

impl Relief {
    #[inline(always)]
    fn new(front: Option<&Ball>, rest: f32) -> Self {
        front.map_or(
            Self {
                rate: 0.0,
                correction: 0.0,
            },
            |ball| {
                let rate = rest / ball.sum;
                Self {
                    rate,
                    correction: rate * ball.impedance,
                }
            },
        )
    }

    #[inline(always)]
    fn apply(&mut self, balls: Option<&mut [Ball]>) {
        for ball in balls.unwrap_or_default().iter_mut().rev() {
            ball.force = f32::from_bits(force_bits(ball.force - self.correction) as u32);
            self.correction += self.rate * ball.impedance;
        }
    }
}
