//! The train of balls: the pooling pass against exhaustive search, a general complementarity solver
//! and stored chains; positions over many ticks.

use epas_friction::train::Press;

/// Deterministic numbers in 0..1 (splitmix64).
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }
    fn within(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.next()
    }
}

/// A train in float64, read from exactly what the pass was given.
#[derive(Debug)]
struct Case {
    free: Vec<f64>,
    compliance: Vec<f64>,
    /// Closing speed allowed in front of ball j; infinite where nothing stands there.
    room: Vec<f64>,
}

impl Case {
    fn of<const N: usize>(free: &[f32; N], compliance: &[f32; N], room: &[f32; N]) -> Self {
        let exact = |numbers: &[f32; N]| numbers.iter().map(|&x| f64::from(x)).collect();
        Self {
            free: exact(free),
            compliance: exact(compliance),
            room: exact(room),
        }
    }

    fn balls(&self) -> usize {
        self.free.len()
    }

    /// Speeds under given link forces: v_j = u_j + Y_j (F_{j-1} - F_j).
    fn speeds(&self, force: &[f64]) -> Vec<f64> {
        let n = self.balls();
        (0..n)
            .map(|j| self.free[j] + self.compliance[j] * (force[(j + n - 1) % n] - force[j]))
            .collect()
    }

    /// How far the distance in front of ball j stays open: v_{j+1} - v_j + room_j.
    fn slack(&self, speed: &[f64], j: usize) -> f64 {
        speed[(j + 1) % self.balls()] - speed[j] + self.room[j]
    }

    /// Every set of closed links is tried: the one whose forces are not negative and whose open links
    /// do not overlap is the solution. Each set splits the train into arcs at a common offset speed.
    fn exhaustive(&self) -> Vec<f64> {
        let n = self.balls();
        let tolerance = 1e-12 * self.free.iter().fold(1e-3, |m: f64, x| m.max(x.abs()));
        for set in 0..(1_u32 << n) - 1 {
            let closed = |j: usize| set >> j & 1 == 1;
            if (0..n).any(|j| closed(j) && self.room[j].is_infinite()) {
                continue;
            }
            let mut force = vec![0.0; n];
            for start in (0..n).filter(|&j| !closed((j + n - 1) % n)) {
                // Arc from `start` to the first ball with an open link in front, as (ball, offset to start).
                let mut arc = vec![(start, 0.0)];
                while let Some(&(ball, offset)) = arc.last().filter(|&&(ball, _)| closed(ball)) {
                    arc.push(((ball + 1) % n, offset - self.room[ball]));
                }
                let weight: f64 = arc.iter().map(|&(j, _)| 1.0 / self.compliance[j]).sum();
                let drive: f64 = arc
                    .iter()
                    .map(|&(j, offset)| (self.free[j] - offset) / self.compliance[j])
                    .sum();
                let mut push = 0.0;
                for &(j, offset) in &arc[..arc.len() - 1] {
                    push += (self.free[j] - offset - drive / weight) / self.compliance[j];
                    force[j] = push;
                }
            }
            let speed = self.speeds(&force);
            if force.iter().all(|&f| f >= 0.0)
                && (0..n).all(|j| self.slack(&speed, j) >= -tolerance)
            {
                return force;
            }
        }
        panic!("no active set fits {self:?}");
    }

    /// Projected Gauss-Seidel on the complementarity problem, over-relaxed, until it stands still.
    fn relaxation(&self) -> Vec<f64> {
        let n = self.balls();
        let mut force = vec![0.0_f64; n];
        let omega = 2.0 / (1.0 + std::f64::consts::PI / n as f64);
        for _ in 0..200_000 {
            let mut moved = 0.0_f64;
            let mut largest = 0.0_f64;
            for j in 0..n {
                let ahead = (j + 1) % n;
                if self.room[j].is_infinite() || ahead == j {
                    continue;
                }
                let behind = (j + n - 1) % n;
                let v = self.free[j] + self.compliance[j] * (force[behind] - force[j]);
                let w = self.free[ahead] + self.compliance[ahead] * (force[j] - force[ahead]);
                let step = (v - w - self.room[j]) / (self.compliance[j] + self.compliance[ahead]);
                let next = (force[j] + omega * step).max(0.0);
                moved = moved.max((next - force[j]).abs());
                largest = largest.max(next);
                force[j] = next;
            }
            if moved <= 1e-13 * largest {
                break;
            }
        }
        force
    }
}

/// Largest force error relative to the largest force of the train.
fn force_error<const N: usize>(found: &Press<N>, exact: &[f64]) -> f64 {
    let largest = exact.iter().fold(0.0, |m: f64, &f| m.max(f));
    let worst = found
        .forces()
        .iter()
        .zip(exact)
        .fold(0.0, |m: f64, (&f, &e)| m.max((f64::from(f) - e).abs()));
    worst / largest.max(1e-6)
}

/// A random train; `touching` is the share of closed gaps, `ring` whether the last ball meets the first.
fn random_train<const N: usize>(
    random: &mut Random,
    touching: f64,
    ring: bool,
) -> ([f32; N], [f32; N], [f32; N]) {
    let free = std::array::from_fn(|_| random.within(-1e-2, 1e-2) as f32);
    let spread = random.within(0.0, 2.0);
    let compliance =
        std::array::from_fn(|_| (2.6e-4 * 2.0_f64.powf(spread * random.within(-1.0, 1.0))) as f32);
    let room = std::array::from_fn(|j| {
        if j + 1 == N && !ring {
            f32::INFINITY
        } else if random.next() < touching {
            0.0
        } else {
            // From contact to far out of reach.
            (1e-2 * random.next() * 10.0_f64.powf(random.within(-2.0, 4.0))) as f32
        }
    });
    (free, compliance, room)
}

fn compare_with_exhaustive_search<const N: usize>(random: &mut Random) -> (f64, usize) {
    let (mut worst, mut joins) = (0.0_f64, 0);
    for trial in 0..400 {
        let (free, compliance, room) =
            random_train::<N>(random, [0.0, 0.5, 0.9, 1.0][trial % 4], trial % 3 != 0);
        let mut found = Press::new();
        found.solve(&free, &compliance, &room);
        let case = Case::of(&free, &compliance, &room);
        let error = force_error(&found, &case.exhaustive());
        assert!(
            error <= 1e-5,
            "N = {N}: error {error} for {case:?}, found {found:?}"
        );
        assert!(found.joins() < N);
        worst = worst.max(error);
        joins = joins.max(found.joins());
    }
    (worst, joins)
}

/// Rounding: each force is a sum of at most N terms (v - u) / Y, each good to a few 2^-24 of the
/// largest speed difference; 1e-5 of the largest force leaves a factor of about ten at N = 8.
#[test]
fn forces_equal_an_exhaustive_search_over_all_sets_of_contacts() {
    let random = &mut Random(1);
    let results = [
        compare_with_exhaustive_search::<1>(random),
        compare_with_exhaustive_search::<2>(random),
        compare_with_exhaustive_search::<3>(random),
        compare_with_exhaustive_search::<5>(random),
        compare_with_exhaustive_search::<8>(random),
        compare_with_exhaustive_search::<10>(random),
    ];
    println!("largest force error over largest force, most joins: {results:?}");
    // The sweep did reach the bound of N - 1 joins.
    assert_eq!(results[4].1, 7);
}

fn compare_with_relaxation<const N: usize>(random: &mut Random, trials: usize) -> (f64, f64) {
    let (mut worst, mut sum) = (0.0_f64, 0.0);
    for trial in 0..trials {
        let (free, compliance, room) =
            random_train::<N>(random, [0.3, 0.8, 0.97, 1.0][trial % 4], trial % 2 == 0);
        let mut found = Press::new();
        found.solve(&free, &compliance, &room);
        let case = Case::of(&free, &compliance, &room);
        let exact = case.relaxation();
        // A closed ring leaves the forces open by a constant: the least is zero by definition.
        let least = if room.iter().all(|&room| room == 0.0) {
            exact.iter().fold(f64::INFINITY, |m, &f| m.min(f))
        } else {
            0.0
        };
        let exact: Vec<f64> = exact.iter().map(|f| f - least).collect();
        let error = force_error(&found, &exact);
        assert!(
            error <= 1e-5,
            "N = {N}, trial {trial}: error {error}, rooms {room:?}"
        );
        worst = worst.max(error);
        sum += error;
    }
    (worst, sum / trials as f64)
}

#[test]
fn long_trains_agree_with_a_general_complementarity_solver() {
    let random = &mut Random(2);
    println!("N = 37: {:?}", compare_with_relaxation::<37>(random, 40));
    println!("N = 64: {:?}", compare_with_relaxation::<64>(random, 40));
}
