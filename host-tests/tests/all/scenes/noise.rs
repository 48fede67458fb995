//! Hands off the wheel, with a noisy angle: how often the regime changes, and how far the torque steps.

use epas_friction::law::coefficient::{CoefficientLaw, TemperatureFade};
use epas_friction::law::memory::{Hysteresis, Part, ProportionalElements, SLIP_8};
use epas_friction::law::motion::{CountSensor, CountSensorParameters, Deadband, NutAngle};
use epas_friction::scene::{Freshness, Sliding, WithMemory, WithMemoryConfiguration};
use epas_friction::{FrictionModel, Inputs, Outputs, Regime, UncagedOutputs};
use epas_reference::closed_loop::ClosedLoop;

use epas_testkit::gears::{
    CagedConfiguration, CagedScrew, SCREW_BALLS, UncagedConfiguration, UncagedScrew, caged,
    changed, uncaged,
};
use epas_testkit::random::Random;
use epas_testkit::remembering::at;

const TICK: f64 = 1e-3;
const TICKS: usize = 4900;
const TEMPERATURE: f32 = 313.15;
const BREAKAWAY: f32 = 2e-3;
const LOAD: f32 = 300.0;

/// Noise of the speed, rad/s, in standard deviations.
const SPEED_NOISE: f64 = 0.05;

/// What a rest does to the friction that is put out.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Restlessness {
    /// Changes of regime.
    changes: usize,
    /// Ticks whose torque is another than the last one's.
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

/// Regime and friction of a screw's outputs.
trait Friction {
    fn friction(&self) -> (Regime, f32);
}

impl Friction for Outputs {
    fn friction(&self) -> (Regime, f32) {
        (self.regime, self.friction_torque)
    }
}

impl Friction for UncagedOutputs {
    fn friction(&self) -> (Regime, f32) {
        (self.regime, self.friction_torque)
    }
}

/// A normal deviate, cut at six: the sum of twelve uniform ones.
fn normal(random: &mut Random) -> f64 {
    (0..12).map(|_| random.between(-0.5, 0.5)).sum()
}

/// A speed of nothing but noise.
fn speed(random: &mut Random) -> f32 {
    (SPEED_NOISE * normal(random)) as f32
}

fn counts() -> CountSensor {
    CountSensor::new(CountSensorParameters {
        period: 16384,
        turn_per_count: ClosedLoop::COUNT as f32,
        largest_turn: 0.5,
    })
    .unwrap()
}

fn slip(full: f32) -> ProportionalElements<8> {
    let part = Part {
        backbone: &SLIP_8.elements,
        share: 1.0,
        breakaway_angle: BREAKAWAY,
    };
    ProportionalElements::new(full, &[part]).unwrap()
}

/// Where the nut has come to rest.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Rest {
    /// After it slid.
    Slid,
    /// After it went back by half a breakaway angle.
    WentBack,
}

/// The restlessness of a scene with memory, whose angle has the noise that makes that of the speed.
fn with_memory<S, A>(scene: S::Configuration, friction: f32, angle: A, rest: Rest) -> Restlessness
where
    S: Sliding<Inputs = Inputs, Constants: Copy, Configuration: Copy, Outputs: Friction>,
    A: NutAngle<Reading = u32> + Copy,
{
    let mut model =
        FrictionModel::<WithMemory<S, ProportionalElements<8>, A>>::new(&WithMemoryConfiguration {
            scene,
            elements: slip(FULL),
            angle,
            reference_load: 1000.0,
            play: BREAKAWAY,
            coefficient: CoefficientLaw::constant(friction).unwrap(),
            temperature: TemperatureFade::new(TEMPERATURE, 60.0, 60.0).unwrap(),
            freshness: Freshness::DEFAULT,
        })
        .unwrap();
    let mut random = Random(11);
    let mut step = |turn: f64, random: &mut Random| {
        // The speed is a difference of two angles over a tick.
        let noise = SPEED_NOISE * TICK / 2.0_f64.sqrt() * normal(random);
        let count = ((0.3 + turn + noise) / ClosedLoop::COUNT).floor() as u32;
        let outputs = model.step(at(
            Inputs {
                nut_speed: speed(random),
                axial_load: LOAD,
            },
            count % 16384,
            TEMPERATURE,
        ));
        outputs.friction()
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

/// Friction at which the elements are designed, N m: about that of both screws here.
const FULL: f32 = 0.08;

/// The restlessness of a scene without memory, under speeds.
fn by_speed<S>(scene: &S::Configuration, mut speed: impl FnMut() -> f32) -> Restlessness
where
    S: Sliding<Inputs = Inputs, Outputs: Friction>,
{
    let mut model = FrictionModel::<S>::new(scene).unwrap();
    let outputs: Vec<_> = (0..TICKS)
        .map(|_| {
            let outputs = model.step(Inputs {
                nut_speed: speed(),
                axial_load: LOAD,
            });
            outputs.friction()
        })
        .collect();
    Restlessness::of(&outputs)
}

fn screw() -> UncagedConfiguration {
    UncagedConfiguration {
        tick: TICK as f32,
        ..uncaged()
    }
}

/// Speeds of differences of counts: of an encoder on the nut itself, with the same noise.
fn counted() -> impl FnMut() -> f32 {
    let count = ClosedLoop::COUNT * 2.5;
    let mut random = Random(11);
    let mut last = 0.0;
    move || {
        let noise = SPEED_NOISE * TICK / 2.0_f64.sqrt() * normal(&mut random);
        let now = (noise / count).floor();
        let turn = (now - last) * count;
        last = now;
        (turn / TICK) as f32
    }
}

/// Friction that follows the speed follows its noise too, in every tick: measured 408 changes of regime at a reversal speed of twice the
/// noise, 3656 with speeds that are differences of counts, and steps of the whole friction.
#[test]
fn friction_by_the_speed_chatters() {
    let mut random = Random(11);
    let scene = CagedConfiguration {
        reversal_speed: 0.1,
        ..caged()
    };
    let rest = by_speed::<CagedScrew>(&scene, || speed(&mut random));
    assert!(rest.changes > 300 && rest.steps == TICKS - 1, "{rest:?}");
    assert!(rest.largest > 0.07, "{rest:?}");
    let rest = by_speed::<CagedScrew>(&scene, counted());
    assert!(rest.changes > 3000 && rest.largest > 0.08, "{rest:?}");
    let mut random = Random(11);
    let scene = UncagedConfiguration {
        folded: changed(screw().folded, |folded| folded.reversal_speed = 0.1),
        ..screw()
    };
    let rest = by_speed::<UncagedScrew<SCREW_BALLS>>(&scene, || speed(&mut random));
    assert!(rest.changes > 300 && rest.largest > 0.04, "{rest:?}");
}

/// Both screws, hands off, behind a play of so many counts to either side.
fn rests(half_width: f32, rest: Rest) -> [Restlessness; 2] {
    let angle = Deadband::new(counts(), half_width * ClosedLoop::COUNT as f32).unwrap();
    [
        with_memory::<CagedScrew, _>(caged(), caged().friction, angle, rest),
        with_memory::<UncagedScrew<SCREW_BALLS>, _>(screw(), screw().folded.friction, angle, rest),
    ]
}

/// Torque of a count: all elements stick.
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
        // Measured: 0.9999999, one count.
        assert!(screw.largest <= 1.00001 * torque_of_a_count(), "{screw:?}");
    }
}
