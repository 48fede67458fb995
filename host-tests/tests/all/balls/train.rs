//! The train of balls: the pooling pass against exhaustive search; positions.

use crate::refusals::assert_refused;
use epas_friction::train::{Press, Train};
use epas_testkit::measured;
use epas_testkit::random::Random;

#[derive(Debug)]
struct Case {
    free: Vec<f64>,
    compliance: Vec<f64>,
    /// Closing speed allowed in front of ball j; infinite where nothing stands there.
    room: Vec<f64>,
}

impl Case {
    fn of<const N: usize>(free: &[f32; N], impedance: &[f32; N], room: &[f32; N]) -> Self {
        let exact = |numbers: &[f32; N]| numbers.iter().map(|&x| f64::from(x)).collect();
        Self {
            free: exact(free),
            compliance: impedance.iter().map(|&x| 1.0 / f64::from(x)).collect(),
            room: exact(room),
        }
    }

    fn balls(&self) -> usize {
        self.free.len()
    }

    /// Speeds under given link forces: `v_j = u_j + Y_j (F_{j-1} - F_j)`.
    fn speeds(&self, force: &[f64]) -> Vec<f64> {
        let n = self.balls();
        (0..n)
            .map(|j| self.free[j] + self.compliance[j] * (force[(j + n - 1) % n] - force[j]))
            .collect()
    }

    /// How far the distance in front of ball j stays open: `v_{j+1} - v_j + room_j`.
    fn slack(&self, speed: &[f64], j: usize) -> f64 {
        speed[(j + 1) % self.balls()] - speed[j] + self.room[j]
    }

    /// Every set of closed links is tried: the one whose forces are not negative and whose open links
    /// do not overlap is the solution. Each set splits the train into arcs at a common offset speed.
    fn exhaustive(&self) -> Vec<f64> {
        let n = self.balls();
        let tolerance = 1e-10 * self.free.iter().fold(1e-3, |m: f64, x| m.max(x.abs()));
        for set in 0..(1_u32 << n) - 1 {
            let closed = |j: usize| set >> j & 1 == 1;
            if (0..n).any(|j| closed(j) && self.room[j].is_infinite()) {
                continue;
            }
            let mut force = vec![0.0; n];
            for start in (0..n).filter(|&j| !closed((j + n - 1) % n)) {
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
}

fn force_error<const N: usize>(case: &Case, found: &Press<N>, exact: &[f64]) -> f64 {
    let largest = exact.iter().fold(0.0, |m: f64, &f| m.max(f));
    let worst = found
        .forces()
        .zip(exact)
        .fold(0.0, |m: f64, (f, &e)| m.max((f64::from(f) - e).abs()));
    let driving = case
        .free
        .iter()
        .zip(&case.compliance)
        .fold(0.0, |m: f64, (u, y)| m.max(u.abs() / y));
    worst / largest.max(1e-2 * driving)
}

/// Speeds within rounding of 2^-24 of the largest one, a few times.
fn check_speeds(case: &Case, found: &[f32], exact: &[f64]) {
    let exact = case.speeds(exact);
    for (ball, (&found, exact)) in found.iter().zip(exact).enumerate() {
        // Free speeds reach 1e-2, and 2^-24 of that is 6e-10: room for the seventeen roundings of a sum over many balls.
        assert!(
            (f64::from(found) - exact).abs() < 1e-8,
            "ball {ball}: speed {found} instead of {exact}: {case:?}"
        );
    }
}

/// A random train; `touching` is the share of closed gaps, `ring` whether the last ball meets the first,
/// `spread` how far impedances are from their mean.
fn random_train<const N: usize>(
    random: &mut Random,
    touching: f64,
    ring: bool,
    spread: f64,
) -> ([f32; N], [f32; N], [f32; N]) {
    let free = std::array::from_fn(|_| random.between(-1e-2, 1e-2) as f32);
    let impedance = std::array::from_fn(|_| (4e3 * spread.powf(random.between(-1.0, 1.0))) as f32);
    let room = std::array::from_fn(|j| {
        if j + 1 == N && !ring {
            f32::INFINITY
        } else if random.between(0.0, 1.0) < touching {
            0.0
        } else {
            // From contact to far out of reach.
            (1e-2 * random.between(0.0, 1.0) * 10.0_f64.powf(random.between(-2.0, 4.0))) as f32
        }
    });
    (free, impedance, room)
}

fn compare_with_exhaustive_search<const N: usize>(
    random: &mut Random,
    spread: f64,
) -> (f64, usize) {
    let (mut worst, mut joins) = (0.0_f64, 0);
    for trial in 0..400 {
        let (free, impedance, room) = random_train::<N>(
            random,
            [0.0, 0.5, 0.9, 1.0][trial % 4],
            trial % 3 != 0,
            spread,
        );
        let mut found = Press::<N>::new();
        assert!(found.solve(&free, &impedance, &room));
        let speed: Vec<_> = found.speeds().collect();
        let case = Case::of(&free, &impedance, &room);
        let exact = case.exhaustive();
        check_speeds(&case, &speed, &exact);
        let error = force_error(&case, &found, &exact);
        measured::assert_at(
            "press, exhaustive search",
            error,
            format_args!("N = {N}: error {error} for {case:?}, found {found:?}"),
        );
        assert!(found.joins() < N);
        worst = worst.max(error);
        joins = joins.max(found.joins());
    }
    (worst, joins)
}

/// Rounding: each force is a sum of at most N terms (v - u) / Y, each good to a few 2^-24 of the largest speed difference.
#[test]
fn forces_equal_an_exhaustive_search_over_all_sets_of_contacts() {
    let random = &mut Random(1);
    let results = [
        compare_with_exhaustive_search::<1>(random, 2.0),
        compare_with_exhaustive_search::<2>(random, 2.0),
        compare_with_exhaustive_search::<3>(random, 2.0),
        compare_with_exhaustive_search::<5>(random, 2.0),
        compare_with_exhaustive_search::<8>(random, 2.0),
        compare_with_exhaustive_search::<10>(random, 2.0),
    ];
    assert_eq!(results[4].1, 7);
}

/// Light balls between heavy ones, impedances that differ by up to a factor 1e6. What rounding of the common speed leaves would be 0.06 of
/// the light balls' forces; taken out, 2^-24 of it remains beside the rounding of the sums.
#[test]
fn stiff_trains_keep_their_forces() {
    let random = &mut Random(4);
    let results = [
        compare_with_exhaustive_search::<2>(random, 1e3),
        compare_with_exhaustive_search::<4>(random, 1e3),
        compare_with_exhaustive_search::<9>(random, 1e3),
    ];
    println!("largest force error over largest force, most joins: {results:?}");
}

#[test]
fn numbering_does_not_matter() {
    const N: usize = 8;
    let unit = 2_f32.powi(-10);
    let (length, pitch) = (128.0 * unit, 8.0 * unit);
    let gaps = [0.0, unit, 0.0, 0.0, 2.0 * unit, 0.0, 0.0, 0.0];
    let last = length - 8.0 * pitch - 3.0 * unit;
    let speed = |j: usize, tick: usize| 0.01 * (((j * 5 + tick / 25 * 3) % 8) as f32 - 3.5);
    let mut one = Train::<N>::new(length, pitch, &gaps).unwrap();
    let mut turned = gaps;
    turned[7] = last;
    turned.rotate_left(3);
    let mut other = Train::<N>::new(length, pitch, &turned).unwrap();
    let mut pressing = std::collections::BTreeSet::new();
    for tick in 0..2000 {
        one.step(
            &std::array::from_fn::<_, N, _>(|j| speed(j, tick)),
            &[500.0; N],
            5e-5,
        );
        other.step(
            &std::array::from_fn::<_, N, _>(|j| speed((j + 3) % N, tick)),
            &[500.0; N],
            5e-5,
        );
        for j in 0..N {
            let force = |train: &Train<N>, j| train.forces().nth(j).unwrap();
            let (a, b) = (force(&one, (j + 3) % N), force(&other, j));
            // Clusters join in the same order, wherever the numbers begin.
            assert_eq!(a, b, "tick {tick}, ball {j}");
        }
        pressing.insert(one.forces().map(|force| force > 0.0).collect::<Vec<_>>());
    }
    let sets = pressing.len();
    assert!(sets > 5, "{sets} sets of contacts");
}

#[test]
fn a_single_ball_and_a_full_track() {
    let mut single = Train::<1>::evenly_spaced(0.1, 0.01, 1).unwrap();
    let start = single.positions().next().unwrap();
    for _ in 0..1000 {
        single.step(&[0.1], &[1e3], 1e-3);
    }
    assert_eq!(
        (single.forces().next(), single.speeds().next()),
        (Some(0.0), Some(0.1))
    );
    // 1000 steps of 1.1 mm on 0.1 m: eleven times around; rounding of a travel of 4.3e7 units in f32.
    let end = single.positions().next().unwrap();
    // Half an ulp of that is 2 units: three roundings a step, of speed, travel and product.
    assert!((end.wrapping_sub(start) as i32).abs() < 6_000);

    let mut full = Train::<10>::evenly_spaced(0.1, 0.01, 10).unwrap();
    let free = [0.03, -0.02, 0.01, 0.0, 0.0, 0.05, -0.05, 0.02, 0.01, 0.05];
    for _ in 0..1000 {
        full.step(&free, &[1e3; 10], 1e-4);
        for (j, speed) in full.speeds().enumerate() {
            // Ten rounded pitches leave 6.0e-9 m of the track, 6e-5 of the travel of 1e-4 m, which balls take in the first tick.
            // Measured: 2.7e-5 in that one.
            assert!((speed - 0.01).abs() < 5e-5, "ball {j}: {speed}");
        }
        assert_eq!(full.forces().fold(1.0, f32::min), 0.0);
    }
}

#[test]
fn equal_speeds_gaps_and_standstill() {
    let mut train = Train::<4>::new(1.0, 0.01, &[0.0; 4]).unwrap();
    train.step(&[0.01; 4], &[1e3; 4], 1e-3);
    assert!(train.forces().eq([0.0; 4]));
    train.step(&[-0.02, -0.01, 0.0, 0.01], &[1e3; 4], 1e-3);
    assert!(train.forces().eq([0.0; 4]));
    train.step(&[0.004, 0.002, 0.0, 0.0], &[1e3; 4], 1e-3);
    assert!(train.forces().eq([0.0; 4]));
    for _ in 0..20 {
        train.step(&[0.004, 0.002, 0.0, 0.0], &[1e3; 4], 1e-3);
    }
    let pressed: Vec<_> = train.forces().collect();
    assert!(pressed[0] > 0.9 && pressed[1] > 0.9 && pressed[3] == 0.0);
    let places: Vec<_> = train.positions().collect();
    for _ in 0..10 {
        train.step(&[0.004, 0.002, 0.0, 0.0], &[1e3; 4], 0.0);
    }
    assert_eq!(places, train.positions().collect::<Vec<_>>());
    assert_eq!(pressed, train.forces().collect::<Vec<_>>());
    train.step(&[-0.004, -0.002, 0.0, 0.0], &[1e3; 4], -1e-3);
    assert!(train.forces().eq([0.0; 4]));
}

/// Joins and forces of touching balls with impedance 1024 and these free speeds, in 64ths; the last ball has room for
/// any speed in a row, none on a ring.
fn joins_and_forces<const N: usize>(free: [f32; N], ring: bool) -> (usize, [f32; N]) {
    let mut room = [0.0; N];
    room[N - 1] = if ring { 0.0 } else { f32::INFINITY };
    let mut press = Press::<N>::new();
    assert!(press.solve(&free.map(|speed| speed / 64.0), &[1024.0; N], &room));
    let mut forces = press.forces();
    (
        press.joins(),
        std::array::from_fn(|_| forces.next().unwrap()),
    )
}

/// Balls and clusters that are exactly as fast as the cluster ahead do not join it: the rule is strict, or contacts
/// would be counted that carry no force. All numbers here are exact in binary: half a 64th times 1024 is 8.
#[test]
fn equal_speeds_join_nothing() {
    for ring in [false, true] {
        assert_eq!(joins_and_forces([1.0; 6], ring), (0, [0.0; 6]));
        let pair = [0.5, 0.5, 1.0, 0.0];
        assert_eq!(joins_and_forces(pair, ring), (1, [0.0, 0.0, 8.0, 0.0]));
        let pairs = [1.0, 0.0, 1.0, 0.0];
        assert_eq!(joins_and_forces(pairs, ring), (2, [8.0, 0.0, 8.0, 0.0]));
    }
    assert_eq!(
        joins_and_forces([0.0, 0.5, 1.0], true),
        (1, [0.0, 0.0, 8.0])
    );
}

#[test]
fn the_least_excess_of_speed_joins() {
    let (joins, forces) = joins_and_forces([1.0 + f32::EPSILON, 1.0], false);
    assert_eq!(joins, 1);
    // Half of 2^-23 / 64 on an impedance of 1024.
    assert_eq!(forces, [f32::EPSILON * 8.0, 0.0]);
}

/// A travel beyond 3 % of the track counts as that, either way, and NaN as none.
#[test]
fn a_travel_without_bound_is_three_per_cent_of_the_track() {
    for (travel, counts) in [
        (0.9, 0.03),
        (f32::INFINITY, 0.03),
        (-0.031, -0.03),
        (f32::NEG_INFINITY, -0.03),
        (-0.029, -0.029),
        (f32::NAN, 0.0),
    ] {
        let mut train = Train::<3>::evenly_spaced(1.0, 0.01, 3).unwrap();
        let before: Vec<u32> = train.positions().collect();
        train.step(&[0.0; 3], &[1e3; 3], travel);
        for (before, after) in before.into_iter().zip(train.positions()) {
            let moved = f64::from(after.wrapping_sub(before) as i32) / 2_f64.powi(32);
            // Rounding of a travel in f32: 6e-8 of it.
            assert!((moved - counts).abs() < 1e-8, "{travel}: {moved}");
        }
    }
}

#[test]
fn what_is_not_valid_joins_nothing() {
    let mut press = Press::<5>::new();
    let behind_a_gap = [0.0, f32::INFINITY, 0.0, 0.0, 0.0];
    let around_the_end = [0.1, 0.0, 0.3, 0.25, 0.2];
    assert!(press.solve(&around_the_end, &[1e3; 5], &behind_a_gap));
    assert_eq!(press.foremost(), 1);
    assert!(!press.solve(&[f32::NAN; 5], &[1e3; 5], &behind_a_gap));
    assert_eq!(press.foremost(), 4);
    assert!(press.forces().chain(press.speeds()).eq([0.0; 10]));
}

#[test]
fn bad_tracks_are_refused() {
    assert_refused(
        &(1.0, 0.1, [0.0; 5]),
        |(length, pitch, gaps)| Train::<5>::new(*length, *pitch, gaps),
        &[
            ("length", |p, v| p.0 = v, &[0.0, -1.0, 1e5]),
            ("pitch", |p, v| p.1 = v, &[0.0, -1.0, 1e5, 0.21]),
            ("gaps", |p, v| p.2[1] = v, &[-1e-3, 0.6]),
            ("gaps", |p, _| p.2 = [0.2, 0.2, 0.2, 0.0, 0.0], &[]),
        ],
    );
}
