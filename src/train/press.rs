//! Which balls of a train press on each other, and how hard: one exact pass, without iteration.

/// Largest free speed that counts, a relative deviation.
pub const LARGEST_FREE_SPEED: f32 = 1.0;

/// Least and largest impedance that count.
pub const IMPEDANCE_RANGE: (f32, f32) = (1e-9, 1e9);

/// What rounding may leave of a cluster's pushes over its largest force before it is taken out.
const ROUNDING: f32 = 1e-6;

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
/// Scratch and results stand in the caller's memory, and not on the stack of an interrupt.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Press<const N: usize> {
    pub(super) balls: [Ball; N],
    foremost: u8,
    joins: u8,
}

/// One ball, the room in front of it, and a place on the stack of clusters.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(super) struct Ball {
    /// Free speed, then actual speed.
    pub(super) speed: f32,
    pub(super) impedance: f32,
    /// Speed at which the ball may run up to the one in front.
    pub(super) room: f32,
    /// Force between the ball and the one in front. Until it is known, the span of the cluster that stands
    /// at this index of the stack, beside its other sums.
    pub(super) force: f32,
    sum: f32,
    weight: f32,
    rear: u8,
}

impl Ball {
    const REST: Self = Self {
        speed: 0.0,
        impedance: 1.0,
        room: 0.0,
        force: 0.0,
        sum: 0.0,
        weight: 0.0,
        rear: 0,
    };
}

/// Balls that move as one: they touch, or close their last distance within the tick.
#[derive(Clone, Copy, Default)]
struct Cluster {
    /// Sum of impedance times free speed, less how much faster than the front ball each ball has to run.
    sum: f32,
    /// Sum of the impedances.
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
            balls: [Ball::REST; N],
            foremost: (N - 1) as u8,
            joins: 0,
        }
    }

    /// Force between ball `j` and the ball in front of it, in the unit of speed times impedance; zero
    /// where they do not press. The last one acts between the last ball and the first.
    pub fn forces(&self) -> impl DoubleEndedIterator<Item = f32> + ExactSizeIterator + '_ {
        self.balls.iter().map(|ball| ball.force)
    }

    /// Actual speed of each ball.
    pub fn speeds(&self) -> impl DoubleEndedIterator<Item = f32> + ExactSizeIterator + '_ {
        self.balls.iter().map(|ball| ball.speed)
    }

    /// A ball that does not press on the one in front of it.
    #[must_use]
    pub const fn foremost(&self) -> usize {
        self.foremost as usize
    }

    /// Joins that the last pass needed, at most `N - 1`: what of its cost depends on data.
    #[must_use]
    pub const fn joins(&self) -> usize {
        self.joins as usize
    }

    /// Finds actual speeds and forces from free speeds, impedances `1/Y` and rooms.
    ///
    /// `room[j]` belongs to ball `j` and the one in front of it, the last one to the last ball and the
    /// first: infinite on an open track. Zero or less is contact, NaN none. A ring without any room
    /// moves as one at the weighted mean speed; its forces are known but for a constant, and the least one
    /// is taken as zero. A ball that nothing drives has a small impedance: it goes along with its
    /// neighbours and presses on none.
    ///
    /// Returns whether all speeds lie within [`LARGEST_FREE_SPEED`] and all impedances within
    /// [`IMPEDANCE_RANGE`]; where not, all speeds and forces are zero.
    ///
    /// Largest error of a force over the largest force, against a complementarity solver in f64, 37 and
    /// 64 balls: 6e-7 for impedances that differ by up to a factor 4, 1.0e-6 (rms 1.4e-7) for factors from
    /// 100 to 1e12. Exact otherwise: no iteration, at most `N - 1` joins, one division for each cluster of two or more balls.
    pub fn solve(&mut self, free: &[f32; N], impedance: &[f32; N], room: &[f32; N]) -> bool {
        let sound = self.set(free, impedance);
        for (ball, &room) in self.balls.iter_mut().zip(room) {
            ball.room = if room < 0.0 { 0.0 } else { room };
        }
        self.pool();
        for ball in &mut self.balls {
            ball.force = if ball.force > 0.0 { ball.force } else { 0.0 };
        }
        sound
    }

    /// Takes over free speeds and impedances where all of them count, and says so; else balls at rest.
    pub(super) fn set(&mut self, free: &[f32; N], impedance: &[f32; N]) -> bool {
        let (least, most) = IMPEDANCE_RANGE;
        let counted = |(speed, impedance): (&f32, &f32)| {
            (-LARGEST_FREE_SPEED..=LARGEST_FREE_SPEED).contains(speed)
                && (least..=most).contains(impedance)
        };
        let sound = free.iter().zip(impedance).all(counted);
        for (ball, (&speed, &impedance)) in self.balls.iter_mut().zip(free.iter().zip(impedance)) {
            (ball.speed, ball.impedance) = if sound {
                (speed, impedance)
            } else {
                (0.0, 1.0)
            };
        }
        sound
    }

    /// Speeds and forces from what stands in the balls; rounding may leave a force a little below zero
    /// where it should be zero.
    pub(super) fn pool(&mut self) {
        // From rear to front: each ball is a cluster, joined with those behind that run into it. A joined
        // cluster stands in the place of the rear one of the two, where its rear ball is already known.
        let mut clusters = 0_usize;
        let mut last = Cluster::default();
        let mut room_behind = f32::INFINITY;
        for index in 0..N {
            let Some(&ball) = self.balls.get(index) else {
                break;
            };
            let mut cluster = Cluster {
                sum: ball.speed * ball.impedance,
                weight: ball.impedance,
                span: 0.0,
                rear: index,
            };
            while clusters > 0 {
                let Some(joined) = last.joined(&cluster, room_behind) else {
                    break;
                };
                cluster = joined;
                clusters -= 1;
                last = self.cluster(clusters.wrapping_sub(1));
                room_behind = self.room_at_back_of(cluster.rear);
            }
            self.push(clusters, &cluster);
            clusters += 1;
            last = cluster;
            room_behind = ball.room;
        }

        // On a ring the last cluster has the first one in front.
        let mut first = 0;
        let mut top = clusters.wrapping_sub(1);
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
                room_ahead = self.room_at_back_of(next);
                continue;
            }
            let behind = self.cluster(top - 1);
            let Some(joined) = behind.joined(&ring, self.room_at_back_of(ring.rear)) else {
                break;
            };
            ring = joined;
            top -= 1;
        }
        self.foremost = front as u8;
        self.joins = (N - 1 + first - top) as u8;

        // Backwards, because the clusters' spans stand in the places of the forces: cluster k at index k,
        // which is not in front of its rear ball. The one that may reach across the ends comes last.
        let mut end = ring.rear;
        for index in (first..top).rev() {
            let cluster = self.cluster(index);
            self.expand(&cluster, end.wrapping_sub(1));
            end = cluster.rear;
        }
        self.expand(&ring, front);
    }

    /// Room between a ball and the one behind it; none is behind the first.
    #[inline(always)]
    fn room_at_back_of(&self, ball: usize) -> f32 {
        self.balls
            .get(ball.wrapping_sub(1))
            .map_or(f32::INFINITY, |behind| behind.room)
    }

    #[inline(always)]
    fn cluster(&self, index: usize) -> Cluster {
        self.balls
            .get(index)
            .map_or(Cluster::default(), |place| Cluster {
                sum: place.sum,
                weight: place.weight,
                span: place.force,
                rear: usize::from(place.rear),
            })
    }

    #[inline(always)]
    fn push(&mut self, index: usize, cluster: &Cluster) {
        if let Some(place) = self.balls.get_mut(index) {
            place.sum = cluster.sum;
            place.weight = cluster.weight;
            place.force = cluster.span;
            place.rear = cluster.rear as u8;
        }
    }

    /// Speeds and forces of the balls of a cluster, from its rear ball, which nothing pushes from behind,
    /// to its front ball, which pushes nothing.
    #[inline]
    fn expand(&mut self, cluster: &Cluster, front: usize) {
        if cluster.rear == front {
            if let Some(ball) = self.balls.get_mut(front) {
                ball.force = 0.0;
            }
            return;
        }
        let inverse = 1.0 / cluster.weight;
        let mean = cluster.sum * inverse;
        let (mut push, mut largest) = (0.0, 0.0);
        let mut faster = cluster.span;
        let mut index = cluster.rear;
        while let Some(ball) = self.balls.get_mut(index) {
            let common = mean + faster;
            push += (ball.speed - common) * ball.impedance;
            ball.speed = common;
            faster -= ball.room;
            if index == front {
                ball.force = 0.0;
                break;
            }
            ball.force = push;
            largest = if push > largest { push } else { largest };
            index = next::<N>(index);
        }
        // The pushes of a cluster sum to zero. What rounding of the mean leaves instead is small, but a
        // stiff ball turns it into a large force.
        if push > ROUNDING * largest || push < -ROUNDING * largest {
            self.correct(cluster.rear, front, push * inverse);
        }
    }

    /// Takes a `rest` of speed out of the forces of a cluster.
    #[inline(never)]
    #[cold]
    fn correct(&mut self, rear: usize, front: usize, rest: f32) {
        let mut correction = 0.0;
        let mut index = rear;
        while index != front
            && let Some(ball) = self.balls.get_mut(index)
        {
            correction += rest * ball.impedance;
            ball.force -= correction;
            index = next::<N>(index);
        }
    }
}

impl<const N: usize> Default for Press<N> {
    fn default() -> Self {
        Self::new()
    }
}

/// The ball in front.
#[inline(always)]
const fn next<const N: usize>(index: usize) -> usize {
    if index == N - 1 { 0 } else { index + 1 }
}
