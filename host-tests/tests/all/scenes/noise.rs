//! Hands off the wheel, with a noisy angle: how often the regime changes, and how far the torque steps.

use epas_friction::law::memory::Hysteresis;
use epas_friction::law::motion::{CountSensor, Deadband, NutAngle};
use epas_friction::scene::{Sliding, WithMemory, WithMemoryConfiguration};
use epas_friction::{FrictionModel, Inputs, Regime};
use epas_reference::closed_loop::ClosedLoop;
use epas_testkit::gears::screw_inputs;

use super::memory::{Figures, by_friction};
use crate::remembering::{Slip, TEMPERATURE, at, counter, slip};
use epas_testkit::gears::{
    CagedScrew, SCREW_BALLS, UncagedConfiguration, UncagedScrew, caged, uncaged,
};
use epas_testkit::random::Random;

const TICK: f64 = 1e-3;
const TICKS: usize = 4900;
const BREAKAWAY: f32 = 2e-3;
const LOAD: f32 = 300.0;

/// Noise of the speed, rad/s, in standard deviations.
const SPEED_NOISE: f64 = 0.05;

#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Restlessness {
    changes: usize,
    steps: usize,
    /// Largest difference between two ticks, N m.
    largest: f32,
}

impl Restlessness {
    fn of(outputs: &[(Regime, f32)]) -> Self {
        let pairs = outputs.iter().zip(&outputs[1..]);
        pairs.fold(Self::default(), |so_far, (before, after)| {
            let step = (after.1 - before.1).abs();
            Self {
                changes: so_far.changes + usize::from(before.0 != after.0),
                steps: so_far.steps + usize::from(step > 0.0),
                largest: if step > so_far.largest {
                    step
                } else {
                    so_far.largest
                },
            }
        })
    }
}

/// A normal deviate, cut at six: the sum of twelve uniform ones.
fn normal(random: &mut Random) -> f64 {
    (0..12).map(|_| random.between(-0.5, 0.5)).sum()
}

fn speed(random: &mut Random) -> f32 {
    (SPEED_NOISE * normal(random)) as f32
}

pub fn counts() -> CountSensor {
    counter(16384, ClosedLoop::COUNT as f32, 0.5)
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Rest {
    Slid,
    /// After it went back by half a breakaway angle.
    WentBack,
}

/// The restlessness of a scene with memory, whose angle has the noise that makes that of the speed.
fn with_memory<S, A>(scene: S::Configuration, friction: f32, angle: A, rest: Rest) -> Restlessness
where
    S: Sliding<Inputs = Inputs, Constants: Copy, Configuration: Copy, Outputs: Into<Figures>>,
    A: NutAngle<Reading = u32> + Copy,
{
    let configuration = by_friction(scene, friction, slip(FULL), angle);
    let mut model = FrictionModel::<WithMemory<S, Slip, A>>::new(&configuration).unwrap();
    let mut random = Random(11);
    let mut step = |turn: f64, random: &mut Random| {
        // The speed is a difference of two angles over a tick.
        let noise = SPEED_NOISE * TICK / 2.0_f64.sqrt() * normal(random);
        let count = ((0.3 + turn + noise) / ClosedLoop::COUNT).floor() as u32;
        let outputs = model.step(at(
            screw_inputs(speed(random), LOAD),
            count % 16384,
            TEMPERATURE,
        ));
        let figures: Figures = outputs.into();
        (figures.regime, figures.friction)
    };
    for tick in 0..200 {
        step(1e-4 * f64::from(tick), &mut random);
    }
    let back = match rest {
        Rest::Slid => 0,
        Rest::WentBack => 10,
    };
    for tick in 0..back {
        step(0.02 - 1e-4 * f64::from(tick), &mut random);
    }
    let place = 0.02 - 1e-4 * f64::from(back);
    // The play has its noise behind it.
    for _ in 0..100 {
        step(place, &mut random);
    }
    let outputs: Vec<_> = (0..TICKS).map(|_| step(place, &mut random)).collect();
    Restlessness::of(&outputs)
}

const FULL: f32 = 0.08;

fn screw() -> UncagedConfiguration {
    UncagedConfiguration {
        tick: TICK as f32,
        ..uncaged()
    }
}

fn rests(half_width: f32, rest: Rest) -> [Restlessness; 2] {
    let angle = Deadband::new(counts(), half_width * ClosedLoop::COUNT as f32).unwrap();
    [
        with_memory::<CagedScrew, _>(caged(), caged().friction, angle, rest),
        with_memory::<UncagedScrew<SCREW_BALLS>, _>(screw(), screw().folded.friction, angle, rest),
    ]
}

fn torque_of_a_count() -> f32 {
    slip(FULL).initial_stiffness() * ClosedLoop::COUNT as f32
}

/// Behind a play no regime changes, and the torque stays as it is but where the noise goes further than ever before: measured
/// in at most 4 ticks of 4900, by less than a count's torque.
#[test]
fn behind_a_play_friction_stands() {
    for half_width in [1.0, 1.5, 2.0] {
        for screw in rests(half_width, Rest::Slid) {
            assert_eq!(screw, Restlessness::default(), "{half_width}");
        }
        for screw in rests(half_width, Rest::WentBack) {
            assert_eq!(screw.changes, 0, "{half_width}: {screw:?}");
            assert!(screw.steps <= 6, "{half_width}: {screw:?}");
            // Derived: the turn of a count at most, and two torques of 0.08 N m, each rounded by 4e-9, 4e-7 of a count's torque.
            // Measured: 0.947.
            assert!(screw.largest <= 1.00001 * torque_of_a_count(), "{screw:?}");
        }
    }
}

/// Without a play the torque follows the counts, here of up to two at once; and where the nut has slid to its rest, the regime does:
/// going on by a count brings back the full friction that going back by one took.
#[test]
fn without_a_play_friction_follows_the_counts() {
    for screw in rests(0.0, Rest::WentBack) {
        assert_eq!(screw.changes, 0, "{screw:?}");
        // Derived: the turn of two counts, and roundings as above. Measured: 2.0000002.
        assert!(screw.largest <= 2.00001 * torque_of_a_count(), "{screw:?}");
    }
    for screw in rests(0.0, Rest::Slid) {
        assert!(screw.changes > 1000, "{screw:?}");
        assert!(screw.largest <= 1.00001 * torque_of_a_count(), "{screw:?}");
    }
}

fn full_at_5_kn() -> f32 {
    let mut model = FrictionModel::<CagedScrew>::new(&caged()).unwrap();
    let outputs = model.step(screw_inputs(100.0, 5e3));
    outputs.friction_torque
}

/// Friction of the caged screw under 5 kN at such counts, one a tick, behind a dead band of `half_width` counts to either side.
fn under_5_kn(half_width: f32, counts_of_ticks: impl IntoIterator<Item = i32>) -> Vec<f32> {
    type Model = FrictionModel<WithMemory<CagedScrew, Slip, Deadband<CountSensor>>>;
    let angle = Deadband::new(counts(), half_width * ClosedLoop::COUNT as f32).unwrap();
    let mut model = Model::new(&WithMemoryConfiguration {
        reference_load: 5e3,
        ..by_friction(caged(), caged().friction, slip(full_at_5_kn()), angle)
    })
    .unwrap();
    let friction = |count: i32| {
        let inputs = screw_inputs(0.0, 5e3);
        let reading = (8000 + count).rem_euclid(16_384) as u32;
        model.step(at(inputs, reading, TEMPERATURE)).friction_torque
    };
    counts_of_ticks.into_iter().map(friction).collect()
}

/// Counts until every element slides forward.
const SLID: i32 = 2 * (BREAKAWAY as f64 / ClosedLoop::COUNT) as i32;

/// Flicker of one count at rest: the dead band is as wide as a count. The nut stops with the play at its forward edge, `p = h`; a count back makes
/// `p = h - 2h = -h`, exactly, because 2h is the count in f32; a count on makes `p = h` again. Neither is beyond the play: no turn, the same
/// bits. Without the dead band a count back takes at least `F count / breakaway` off full sliding F: friction after a reversal falls by
/// `2 T(turn / 2)` with a concave T that reaches F at the breakaway angle.
#[test]
fn a_flicker_of_one_count_moves_no_friction_behind_a_dead_band_of_it() {
    let mut random = Random(3);
    let flicker: Vec<i32> = (0..TICKS)
        .map(|_| SLID - i32::from(random.between(0.0, 1.0) < 0.5))
        .collect();
    let run = |half_width| under_5_kn(half_width, (0..=SLID).chain(flicker.iter().copied()));
    let rest = |torque: Vec<f32>| torque[SLID as usize..].to_vec();
    let behind = rest(run(0.5));
    assert!(
        behind.iter().all(|torque| *torque == behind[0]),
        "{behind:?}"
    );
    let without = rest(run(0.0));
    let least = without
        .iter()
        .fold(f32::MAX, |least, &torque| least.min(torque));
    let fall = without[0] - least;
    let derived = without[0] * (ClosedLoop::COUNT / f64::from(BREAKAWAY)) as f32;
    assert!(
        without[0] == behind[0] && fall > derived,
        "{fall} {derived}"
    );
}

/// The price of the dead band: the model is half a count behind the encoder in either direction, so that a reversal takes a count before friction
/// falls. From there on it is the friction that it would be a count earlier, but for roundings: each turn is a difference of f32 near a count
/// (2^-24 of 1.5 counts), which `SLID` turns add up, at the initial stiffness.
#[test]
fn a_dead_band_of_a_count_delays_a_reversal_by_a_count() {
    let reversal = || (0..=SLID).chain((0..SLID).rev());
    let (behind, without) = (under_5_kn(0.5, reversal()), under_5_kn(0.0, reversal()));
    let back = SLID as usize + 1;
    assert_eq!(behind[back], behind[back - 1], "a count back is not felt");
    let count_torque = slip(full_at_5_kn()).initial_stiffness() * ClosedLoop::COUNT as f32;
    let bound = count_torque * 1.5 * SLID as f32 * 0.5 * f32::EPSILON;
    for tick in back + 1..behind.len() {
        let off = (behind[tick] - without[tick - 1]).abs();
        assert!(off <= bound, "{tick}: {off} {bound}");
    }
    let late = (back..behind.len()).map(|tick| (behind[tick] - without[tick]).abs());
    let most = late.fold(0.0, f32::max);
    let count = without[back - 1] - without[back];
    assert!(most <= count + bound, "{most} {count}");
}
