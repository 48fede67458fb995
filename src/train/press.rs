//! Which balls of a train press on each other, and how hard: one exact pass, without iteration.

/// Largest free speed that counts, a relative deviation; one beyond it, infinite or NaN, counts as zero.
pub const LARGEST_FREE_SPEED: f32 = 1.0;

/// Least and largest compliance that count; one outside, or NaN, counts as the largest: such a ball goes
/// along with its neighbours and presses on none.
pub const COMPLIANCE_RANGE: (f32, f32) = (1e-9, 1e9);

/// Speeds and forces of a train of `N` balls, 1 to 255, which touch or may touch.
///
/// Balls stand in a row, ball `j + 1` in front of ball `j`. Left alone, ball `j` runs at its free speed
/// `u_j`; a net push `P` makes it run at `u_j + Y_j P` with its compliance `Y_j`. The speed at which a
/// ball may run up to the one in front, the room `r_j`, is their distance over the time of a tick; no
/// ball passes through another:
///
/// ```text
/// v_j = u_j + Y_j (F_{j-1} - F_j),   F_j >= 0,   v_{j+1} - v_j + r_j >= 0,   F_j (v_{j+1} - v_j + r_j) = 0
/// ```
///
/// (Lin 2019, eqs. (3.54), (3.77), the latter as complementarity on the actual speeds: the printed rule,
/// which lets the free speeds of two neighbours decide, makes chains of balls overlap.) These are the
/// optimality conditions of the isotonic regression `min sum (v_j - u_j)²/(2 Y_j)`, with the forces for
/// multipliers, and pooling adjacent violators solves it exactly: clusters that run into the one ahead
/// are joined, in any order. On a ring the last cluster has the first one in front, and the same argument
/// holds: a join slows what is behind and speeds up what is ahead, so no force inside a cluster ever
/// falls.
///
/// Speeds are deviations from a common nominal one over its size, so that small differences keep their
/// digits; they are signed along the row, also for a train that runs backwards.
///
/// Scratch and results stand here, in the caller's memory, and not on the stack of an interrupt.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Press<const N: usize> {
    speed: [f32; N],
    force: [f32; N],
    weight: [f32; N],
    span: [f32; N],
    rear: [u8; N],
    foremost: u8,
    joins: u8,
}

/// Balls that move as one: they touch, or close their last distance within the tick.
#[derive(Clone, Copy, Default)]
struct Cluster {
    /// Sum of weight times free speed, less how much faster than the front ball each ball has to run.
    sum: f32,
    /// Sum of the weights `1/Y`.
    weight: f32,
    /// How much faster than the front ball the rear ball runs: the sum of the rooms between.
    span: f32,
    /// Index of the rear ball.
    rear: usize,
}

impl Cluster {
    /// `self` and the cluster `ahead` as one, where `self` runs into it; strict, so that equal speeds
    /// make no contact.
    #[inline(always)]
    fn joined(&self, ahead: &Self, room: f32) -> Option<Self> {
        let reach = room + ahead.span;
        let sum = self.sum - reach * self.weight;
        if sum * ahead.weight > ahead.sum * self.weight {
            Some(Self {
                sum: sum + ahead.sum,
                weight: self.weight + ahead.weight,
                span: self.span + reach,
                rear: self.rear,
            })
        } else {
            None
        }
    }
}

impl<const N: usize> Press<N> {
    const BALLS_FIT: () = assert!(N >= 1 && N <= 255, "a train has 1 to 255 balls");

    /// A train at rest, without forces.
    #[must_use]
    pub const fn new() -> Self {
        let () = Self::BALLS_FIT;
        Self {
            speed: [0.0; N],
            force: [0.0; N],
            weight: [0.0; N],
            span: [0.0; N],
            rear: [0; N],
            foremost: (N - 1) as u8,
            joins: 0,
        }
    }

    /// Actual speed of each ball, in the unit of the free speeds.
    #[must_use]
    pub const fn speeds(&self) -> &[f32; N] {
        &self.speed
    }

    /// Force between ball `j` and the ball in front of it, in the unit of free speed over compliance; zero
    /// where they do not press. The last one acts between the last ball and the first.
    #[must_use]
    pub const fn forces(&self) -> &[f32; N] {
        &self.force
    }

    /// A ball that does not press on the one in front of it.
    #[must_use]
    pub const fn foremost(&self) -> usize {
        self.foremost as usize
    }

    /// Joins that the last pass needed, at most `N - 1`: all of its cost that depends on data.
    #[must_use]
    pub const fn joins(&self) -> usize {
        self.joins as usize
    }

    /// Finds speeds and forces from free speeds, compliances and rooms.
    ///
    /// `room[j]` belongs to ball `j` and the one in front of it, the last one to the last ball and the
    /// first: infinite on an open track. Zero is contact; a room below zero pushes two balls apart that
    /// overlap; NaN is no contact. Inputs out of [`LARGEST_FREE_SPEED`] and [`COMPLIANCE_RANGE`] are
    /// replaced as said there. A ring without any room moves as one at the weighted mean speed; its forces are
    /// known but for a constant, and the least one is taken as zero.
    ///
    /// Largest error of a force over the largest force, against a complementarity solver in f64: 1e-5 for
    /// compliances that differ by up to a factor 4, 37 and 64 balls. Exact otherwise: no iteration, `N` divisions,
    /// two more for each cluster of two or more balls, at most `N - 1` joins.
    pub fn solve(&mut self, free: &[f32; N], compliance: &[f32; N], room: &[f32; N]) {
        let joins = self.pool(free, compliance, room);
        self.joins = joins as u8;
    }

    #[inline(always)]
    fn pool(&mut self, free: &[f32; N], compliance: &[f32; N], room: &[f32; N]) -> usize {
        let mut clusters = 0_usize;
        // From rear to front: each ball is a cluster, joined with those behind that run into it.
        let mut last = Cluster::default();
        let mut room_behind = f32::INFINITY;
        for (ball, ((&free, &compliance), &room_ahead)) in
            free.iter().zip(compliance).zip(room).enumerate()
        {
            let weight = 1.0 / counted_compliance(compliance);
            if let Some(stored) = self.weight.get_mut(ball) {
                *stored = weight;
            }
            let mut cluster = Cluster {
                sum: counted_speed(free) * weight,
                weight,
                span: 0.0,
                rear: ball,
            };
            while clusters > 0 {
                let Some(joined) = last.joined(&cluster, room_behind) else {
                    break;
                };
                cluster = joined;
                clusters -= 1;
                last = self.cluster(clusters.wrapping_sub(1));
                room_behind = room_at_back_of(room, cluster.rear);
            }
            self.push(clusters, &cluster);
            clusters += 1;
            last = cluster;
            room_behind = room_ahead;
        }

        // On a ring the last cluster has the first one in front.
        let mut first = 0;
        let mut top = clusters - 1;
        let mut front = N - 1;
        let mut ring = last;
        let mut room_ahead = room_behind;
        while first < top {
            let ahead = self.cluster(first);
            if let Some(joined) = ring.joined(&ahead, room_ahead) {
                ring = joined;
                first += 1;
                let next = if first < top {
                    self.cluster(first).rear
                } else {
                    ring.rear
                };
                front = next.wrapping_sub(1);
                room_ahead = room_at_back_of(room, next);
                continue;
            }
            let behind = self.cluster(top - 1);
            let Some(joined) = behind.joined(&ring, room_at_back_of(room, ring.rear)) else {
                break;
            };
            ring = joined;
            top -= 1;
        }
        let whole = top + 1 - first;

        // Backwards, because the clusters' sums stand in the places of the results: cluster k at index k,
        // which is not in front of its rear ball. The one that may reach across the ends comes last.
        let mut end = ring.rear;
        for index in (first..top).rev() {
            let cluster = self.cluster(index);
            self.expand(&cluster, end - cluster.rear, free, room);
            end = cluster.rear;
        }
        let length = front + 1 + if front < ring.rear { N } else { 0 } - ring.rear;
        self.expand(&ring, length, free, room);
        self.foremost = front as u8;
        N - whole
    }

    #[inline(always)]
    fn cluster(&self, index: usize) -> Cluster {
        match (
            self.speed.get(index),
            self.force.get(index),
            self.span.get(index),
            self.rear.get(index),
        ) {
            (Some(&sum), Some(&weight), Some(&span), Some(&rear)) => Cluster {
                sum,
                weight,
                span,
                rear: usize::from(rear),
            },
            _ => Cluster::default(),
        }
    }

    #[inline(always)]
    fn push(&mut self, index: usize, cluster: &Cluster) {
        if let (Some(sum), Some(weight), Some(span), Some(rear)) = (
            self.speed.get_mut(index),
            self.force.get_mut(index),
            self.span.get_mut(index),
            self.rear.get_mut(index),
        ) {
            *sum = cluster.sum;
            *weight = cluster.weight;
            *span = cluster.span;
            *rear = cluster.rear as u8;
        }
    }

    /// Speeds and forces of the `length` balls of a cluster, from its rear ball, which nothing pushes from
    /// behind, to its front ball.
    #[inline(always)]
    fn expand(&mut self, cluster: &Cluster, length: usize, free: &[f32; N], room: &[f32; N]) {
        if length == 1 {
            if let (Some(speed), Some(force), Some(&free)) = (
                self.speed.get_mut(cluster.rear),
                self.force.get_mut(cluster.rear),
                free.get(cluster.rear),
            ) {
                *speed = counted_speed(free);
                *force = 0.0;
            }
            return;
        }
        let mean = cluster.sum / cluster.weight;
        // The pushes of a cluster sum to zero. What rounding of the mean leaves instead is small, but a
        // stiff ball turns it into a large force.
        let mut residual = 0.0;
        let mut faster = cluster.span;
        let mut ball = cluster.rear;
        for _ in 0..length {
            if let (Some(&free), Some(&weight), Some(&room)) =
                (free.get(ball), self.weight.get(ball), room.get(ball))
            {
                residual += ((counted_speed(free) - faster) - mean) * weight;
                faster -= room;
            }
            ball += 1;
            if ball == N {
                ball = 0;
            }
        }
        let correction = residual / cluster.weight;
        let mut push = 0.0;
        let mut faster = cluster.span;
        let mut ball = cluster.rear;
        for _ in 0..length {
            if let (Some(&free), Some(&weight), Some(&room), Some(speed), Some(force)) = (
                free.get(ball),
                self.weight.get(ball),
                room.get(ball),
                self.speed.get_mut(ball),
                self.force.get_mut(ball),
            ) {
                push += (((counted_speed(free) - faster) - mean) - correction) * weight;
                *speed = (mean + faster) + correction;
                // Rounding may leave a little less than nothing.
                *force = if push > 0.0 { push } else { 0.0 };
                faster -= room;
            }
            ball += 1;
            if ball == N {
                ball = 0;
            }
        }
        // Nothing stands in front within reach.
        let front = if ball == 0 { N - 1 } else { ball - 1 };
        if let Some(force) = self.force.get_mut(front) {
            *force = 0.0;
        }
    }
}

impl<const N: usize> Default for Press<N> {
    fn default() -> Self {
        Self::new()
    }
}

/// Room between `ball` and the ball behind it; none is behind the first.
#[inline(always)]
fn room_at_back_of<const N: usize>(room: &[f32; N], ball: usize) -> f32 {
    room.get(ball.wrapping_sub(1))
        .copied()
        .unwrap_or(f32::INFINITY)
}

/// `speed` where it counts, else zero: by its bits, so that NaN needs no test of its own.
#[inline(always)]
fn counted_speed(speed: f32) -> f32 {
    const LIMIT: u32 = LARGEST_FREE_SPEED.to_bits();
    if speed.to_bits() & 0x7fff_ffff <= LIMIT {
        speed
    } else {
        0.0
    }
}

/// `compliance` where it counts, else the largest.
#[inline(always)]
fn counted_compliance(compliance: f32) -> f32 {
    const LEAST: u32 = COMPLIANCE_RANGE.0.to_bits();
    const SPAN: u32 = COMPLIANCE_RANGE.1.to_bits() - LEAST;
    // The bits of positive numbers are ordered as the numbers; all else lies above after the shift.
    if compliance.to_bits().wrapping_sub(LEAST) <= SPAN {
        compliance
    } else {
        COMPLIANCE_RANGE.1
    }
}
