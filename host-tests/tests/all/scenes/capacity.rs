//! The number of balls is set at run time: a model compiled for 64 serves any number up to that.

use epas_friction::law::coefficient::OneCoefficient;
use epas_friction::scene::StoredScene;
use epas_friction::train::{FreeBall, Press, Train};
use epas_friction::{
    Error, FrictionModel, LinearBearingConfiguration, LinearBearingTrain, Refusal, UncagedBallScrew,
};

use super::step_promises::{remembering, sound};
use epas_testkit::gears::{self, UncagedConfiguration, UncagedScrew};
use epas_testkit::random::Random;
use epas_testkit::random_scenes::{Trial, accepted};

const MOST: usize = 64;

/// Random models of a scene whose capacity is its number of balls, beside those of the same scene with more: the same bits, flags and
/// blocks.
fn same_bits<S, Wide>(models: u64)
where
    S: Trial + StoredScene,
    Wide: Trial<Configuration = S::Configuration, Inputs = S::Inputs, Outputs = S::Outputs>
        + StoredScene,
{
    let mut random = Random(46);
    for _ in 0..models {
        let (configuration, mut own, _) = accepted::<S>(&mut random);
        let mut wide = FrictionModel::<Wide>::new(&configuration).unwrap();
        let mut sensors = [0.0; 3];
        for tick in 0..500 {
            sensors = S::sensors(&mut random, &configuration, sensors);
            let found = wide.step(S::inputs(sensors));
            let expected = own.step(S::inputs(sensors));
            assert_eq!(
                S::numbers(&found),
                S::numbers(&expected),
                "{}, tick {tick}: {configuration:?}",
                S::name()
            );
        }
        let mut expected = vec![0; FrictionModel::<S>::STATE_BYTES];
        let mut found = vec![0; FrictionModel::<Wide>::STATE_BYTES];
        let written = own.export(&mut expected);
        assert_eq!(wide.export(&mut found), written, "{}", S::name());
        let Ok(length) = written else {
            continue;
        };
        assert_eq!(expected.len(), length);
        assert_eq!(found[..length], expected);
        assert_eq!(wide.import(&expected), own.import(&expected));
    }
}

macro_rules! all_counts {
    ($scene:ident, $($count:literal)*) => {
        $(same_bits::<$scene<$count>, $scene<MOST>>(40);)*
    };
}

#[test]
fn one_capacity_gives_the_bits_of_each_count() {
    all_counts!(UncagedBallScrew, 1 2 3 16 37 64);
    all_counts!(LinearBearingTrain, 1 2 3 16 37 64);
}

#[test]
fn one_capacity_gives_the_bits_of_each_count_with_a_memory() {
    type Own = LinearBearingTrain<{ gears::LINEAR_BALLS }>;
    let configuration = gears::linear();
    let one = OneCoefficient::new(configuration.friction).unwrap();
    let scale = (1e-6, configuration.tick);
    let mut own = remembering::<Own, _>(configuration, one, scale);
    let mut wide = remembering::<LinearBearingTrain<MOST>, _>(configuration, one, scale);
    let mut random = Random(46);
    let mut sensors = [0.0; 3];
    for _ in 0..5_000 {
        sensors = Own::sensors(&mut random, &configuration, sensors);
        let inputs = sound(Own::inputs(sensors), sensors[0]);
        let (found, expected) = (wide.step(inputs), own.step(inputs));
        assert_eq!(Own::numbers(&found), Own::numbers(&expected));
    }
}

fn screw_of(balls: u16) -> UncagedConfiguration {
    UncagedConfiguration {
        balls,
        turns: 5.0,
        ..gears::uncaged()
    }
}

#[test]
fn a_count_beyond_the_capacity_is_refused() {
    let screw = |balls| FrictionModel::<UncagedScrew<MOST>>::new(&screw_of(balls)).map(drop);
    let bearing = |balls| {
        FrictionModel::<LinearBearingTrain<MOST>>::new(&LinearBearingConfiguration {
            balls,
            loaded_length: 1.0,
            ..gears::linear()
        })
        .map(drop)
    };
    assert_eq!(screw(1).and(screw(64)), Ok(()));
    assert_eq!(bearing(1).and(bearing(64)), Ok(()));
    let refused = |balls: u16| {
        let count = usize::from(balls);
        [
            screw(balls),
            bearing(balls),
            Press::<MOST>::with_balls(count).map(drop),
            Train::<MOST>::evenly_spaced(1.0, 1e-3, count).map(drop),
            Train::<MOST>::new(1.0, 1e-3, &vec![0.0; count]).map(drop),
        ]
        .map(|result: Result<(), Error>| result.unwrap_err().to_string())
    };
    for balls in [0, 65, u16::MAX] {
        let expected = format!("balls = {balls} is out of range; allowed: 1 to 64");
        for error in refused(balls) {
            assert_eq!(error, expected);
        }
    }
}

#[test]
fn another_count_does_not_fit() {
    let mut model = FrictionModel::<UncagedScrew<MOST>>::new(&screw_of(37)).unwrap();
    let other = FrictionModel::<UncagedScrew<MOST>>::new(&screw_of(36)).unwrap();
    let mut block = vec![0; FrictionModel::<UncagedScrew<MOST>>::STATE_BYTES];
    let length = other.export(&mut block).unwrap();
    assert_eq!(
        model.import(&block[..length]),
        Err(Refusal::OtherBalls {
            found: 36,
            expected: 37
        })
    );
    let error = model.swap_constants(*other.constants()).unwrap_err();
    assert_eq!(
        error.to_string(),
        "balls = 36 is out of range; allowed: 37 to 37"
    );
}

#[test]
fn a_list_of_another_length_does_not_count() {
    let mut press = Press::<MOST>::with_balls(3).unwrap();
    let [free, impedance, room] = [[0.2, 0.1, 0.0], [1e3; 3], [0.0, 0.0, f32::INFINITY]];
    assert!(press.solve(&free, &impedance, &room));
    assert!(press.forces().any(|force| force > 0.0));
    for length in [0, 2] {
        assert!(!press.solve(&free[..length], &impedance, &room));
        assert!(!press.solve(&free, &impedance[..length], &room));
        assert!(!press.solve(&free, &impedance, &room[..length]));
        let balls = [FreeBall::rubbed(0.0, 1e3, 0.0, 0.0); 3];
        assert!(!press.solve_rubbing(&balls[..length], &room));
        assert!(!press.solve_rubbing(&balls, &room[..length]));
        assert!(press.forces().eq([0.0; 3]));
    }
    let mut train = Train::<MOST>::new(1.0, 0.01, &[0.0; 3]).unwrap();
    assert!(train.step(&free, &impedance, 1e-4));
    assert!(!train.step(&free, &impedance[..2], 1e-4));
    assert!(train.forces().eq([0.0; 3]));
}
