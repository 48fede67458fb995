//! Blocks that are refused: broken, foreign, of other constants, with numbers that no state has; the model stays as it was.

use std::f32::consts::TAU;
use std::fmt::Debug;

use epas_friction::law::memory::{LoadExactElements, ParallelElements, SeatElement};
use epas_friction::law::motion::WrappedAngle;
use epas_friction::scene::{StoredScene, WithMemory, WithMemoryConfiguration};
use epas_friction::stored::VERSION;
use epas_friction::{Faults, FrictionModel, LinearBearingTrain, Refusal, UncagedBallScrew};

use crate::remembering::{COUNTS, CagedByAngle, UncagedByCounts, slip, with_memory, wrapped};
use epas_testkit::gears::{
    BALL_RANGE, CagedConfiguration, CagedScrew, LINEAR_BALLS, UncagedConfiguration, UncagedScrew,
    caged, changed, linear, linear_of_smaller_balls, uncaged,
};
use epas_testkit::random::Random;
use epas_testkit::random_scenes::{Trial, accepted};

use super::{
    BALLS_AT, FINGERPRINT_AT, KIND_AT, Kept, LENGTH_AT, Linear, STATE_AT, TWO_TURNS, Uncaged,
    VERSION_AT, driven, export, sealed,
};

fn refused<S: Kept>(model: &mut FrictionModel<S>, block: &[u8]) -> Refusal {
    let before = export(model);
    let faulted = model.faulted_ticks();
    let state = format!("{:?}", model.state());
    let refusal = model.import(block).expect_err("the block is wrong");
    assert_eq!(export(model), before, "{refusal}");
    assert_eq!(format!("{:?}", model.state()), state, "{refusal}");
    assert_eq!(model.faulted_ticks(), faulted);
    refusal
}

/// A block with other bytes from a place on, and the checksum of these.
fn patched(block: &[u8], at: usize, bytes: impl AsRef<[u8]>) -> Vec<u8> {
    let bytes = bytes.as_ref();
    let mut block = block.to_vec();
    block[at..at + bytes.len()].copy_from_slice(bytes);
    sealed(block)
}

#[test]
fn every_flipped_bit_is_found() {
    let (mut model, _) = driven::<CagedScrew>(1, 200);
    let mut other = CagedScrew::model();
    CagedScrew::set(&mut other);
    let block = export(&other);
    for bit in 0..8 * block.len() {
        let mut flipped = block.clone();
        flipped[bit / 8] ^= 1 << (bit % 8);
        let refusal = refused(&mut model, &flipped);
        let expected = match bit / 8 {
            0..VERSION_AT => refusal == Refusal::NotAState,
            VERSION_AT..KIND_AT => matches!(refusal, Refusal::Version { .. }),
            LENGTH_AT..FINGERPRINT_AT => matches!(refusal, Refusal::Length { .. }),
            _ => refusal == Refusal::Damaged,
        };
        assert!(expected, "bit {bit}: {refusal}");
    }
}

#[test]
fn blocks_of_another_length_are_refused() {
    let (mut model, _) = driven::<Linear>(1, 50);
    let block = export(&Linear::model());
    for length in 0..block.len() {
        assert!(
            matches!(refused(&mut model, &block[..length]), Refusal::Length { found, .. } if found == length)
        );
    }
    for more in [1, 4, 1000] {
        let mut long = block.clone();
        long.resize(block.len() + more, 0);
        assert_eq!(
            refused(&mut model, &long),
            Refusal::Length {
                found: long.len(),
                expected: block.len()
            }
        );
    }
    // Erased flash, and a cleared memory.
    for fill in [0xFF, 0x00] {
        let erased = vec![fill; block.len()];
        assert_eq!(refused(&mut model, &erased), Refusal::NotAState);
    }
    // No room, and more than is needed.
    let mut short = vec![7; block.len() - 1];
    assert_eq!(
        model.export(&mut short),
        Err(Refusal::Length {
            found: block.len() - 1,
            expected: block.len()
        })
    );
    assert!(short.iter().all(|&byte| byte == 7));
    let mut room = vec![7; block.len() + 9];
    assert_eq!(model.export(&mut room), Ok(block.len()));
    assert_eq!(room[..block.len()], export(&model));
    assert!(room[block.len()..].iter().all(|&byte| byte == 7));
}

#[test]
fn foreign_and_old_blocks_are_refused() {
    let (mut model, _) = driven::<CagedScrew>(1, 50);
    let block = export(&model);
    let with = |at: usize, byte: u8| patched(&block, at, [block[at].wrapping_add(byte)]);
    assert_eq!(
        refused(&mut model, &with(VERSION_AT, 1)),
        Refusal::Version {
            found: VERSION + 1,
            expected: VERSION
        }
    );
    assert_eq!(refused(&mut model, &with(KIND_AT, 1)), Refusal::OtherScene);
    assert_eq!(
        refused(&mut model, &with(BALLS_AT, 37)),
        Refusal::OtherBalls {
            found: 37,
            expected: 0
        }
    );
    assert_eq!(
        refused(&mut model, &with(FINGERPRINT_AT, 1)),
        Refusal::OtherConstants
    );
    let uncaged = export(&Uncaged::model());
    assert_eq!(refused(&mut model, &uncaged), Refusal::OtherScene);
    let mut seven = FrictionModel::<UncagedScrew<7>>::new(&uncaged_of_seven()).unwrap();
    assert_eq!(
        seven.import(&uncaged),
        Err(Refusal::OtherBalls {
            found: 37,
            expected: 7
        })
    );
    let (mut remembers, _) = driven::<CagedByAngle>(1, 50);
    assert_eq!(refused(&mut remembers, &block), Refusal::OtherScene);
}

fn uncaged_of_seven() -> UncagedConfiguration {
    UncagedConfiguration {
        balls: 7,
        turns: 1.0,
        ..uncaged()
    }
}

fn refused_by_all<S: Kept>(block: &[u8], others: &[S::Configuration])
where
    S::Configuration: Debug,
{
    for other in others {
        let mut model = FrictionModel::<S>::new(other).unwrap();
        assert_eq!(
            model.import(block),
            Err(Refusal::OtherConstants),
            "{other:?}"
        );
    }
}

/// Constants with which a state's numbers mean something else, and those that may change from one ignition to the next.
#[test]
fn blocks_of_other_constants_are_refused() {
    let own = caged();
    let block = export(&CagedScrew::model());
    let import = |configuration: CagedConfiguration| {
        FrictionModel::<CagedScrew>::new(&configuration)
            .unwrap()
            .import(&block)
    };
    let steeper = CagedConfiguration { lead: 0.021, ..own };
    assert_eq!(import(steeper), Err(Refusal::OtherConstants));
    let mut limits = own.limits;
    limits.friction_torque = 1.0;
    for same in [
        CagedConfiguration { limits, ..own },
        CagedConfiguration {
            friction: 0.0751,
            ..own
        },
        CagedConfiguration {
            reversal_speed: 0.1,
            ..own
        },
    ] {
        assert_eq!(import(same), Ok(()), "{same:?}");
    }

    let block = export(&Uncaged::model());
    let mut others = [uncaged(); 5];
    others[0].turns = 2.45;
    others[1].screw_deviation = &TWO_TURNS;
    others[2].folded = changed(&BALL_RANGE, |folded| folded.ball_radius *= 0.9);
    others[3].folded = changed(&BALL_RANGE, |folded| folded.lead *= 1.1);
    others[4].return_length = 0.02;
    refused_by_all::<Uncaged>(&block, &others);
    let mut slower = uncaged();
    slower.tick = 2e-5;
    let mut other_law = uncaged();
    other_law.folded = changed(&BALL_RANGE, |folded| folded.law.lift_off = 20.0);
    for same in [slower, other_law] {
        let mut model = FrictionModel::<Uncaged>::new(&same).unwrap();
        assert_eq!(model.import(&block), Ok(()));
    }

    let block = export(&Linear::model());
    let mut others = [linear(), linear(), linear_of_smaller_balls()];
    others[0].wavelength = 0.05;
    others[1].loaded_length *= 2.0;
    others[1].return_length *= 2.0;
    others[1].wavelength *= 2.0;
    refused_by_all::<Linear>(&block, &others);

    let block = export(&CagedByAngle::model());
    let angle = wrapped(0.0, TAU, 0.5);
    let other = wrapped(-3.0, TAU, 0.5);
    let import = |elements, angle, play| {
        let configuration = WithMemoryConfiguration {
            play,
            ..with_memory(caged(), elements, angle)
        };
        FrictionModel::<CagedByAngle>::new(&configuration)
            .unwrap()
            .import(&block)
    };
    assert_eq!(import(slip(0.05), angle, 2e-3), Ok(()));
    for (elements, angle, play) in [
        (slip(0.06), angle, 2e-3),
        (slip(0.05), other, 2e-3),
        (slip(0.05), angle, 1e-3),
    ] {
        let refusal = import(elements, angle, play);
        assert_eq!(refusal, Err(Refusal::OtherConstants));
    }
}

/// Elements of every kind count: a state that others left means something else.
#[test]
fn states_of_other_elements_are_refused() {
    let angle = wrapped(0.0, TAU, 0.5);
    macro_rules! check {
        ($kind:ty, $own:expr, $others:expr) => {{
            let model = |elements: $kind| {
                let configuration = with_memory(caged(), elements, angle);
                FrictionModel::<WithMemory<CagedScrew, $kind, WrappedAngle>>::new(&configuration)
                    .unwrap()
            };
            let block = export(&model($own));
            assert_eq!(model($own).import(&block), Ok(()));
            for other in $others {
                let refusal = model(other).import(&block);
                assert_eq!(refusal, Err(Refusal::OtherConstants));
            }
        }};
    }
    let exact = |limit, breakaway| LoadExactElements::<8>::new(limit, breakaway, 4.0).unwrap();
    check!(
        LoadExactElements<8>,
        exact(0.04, 2e-3),
        [exact(0.05, 2e-3), exact(0.04, 3e-3)]
    );
    let seat = |breakaway| SeatElement::new(0.02, 1e-3, breakaway).unwrap();
    let beside = |seat, share| ParallelElements::new(exact(0.04, 2e-3), seat, share).unwrap();
    check!(
        ParallelElements<LoadExactElements<8>, SeatElement>,
        beside(seat(2e-3), 0.5),
        [beside(seat(3e-3), 0.5), beside(seat(2e-3), 0.4)]
    );
}

/// Bytes of a ball of a train in a block: its position in units of 2^-32 of the track, sixteenths of a unit, force.
const BALL_BYTES: usize = 9;
/// And where the first one begins: behind what the train carries over, and the number of the foremost ball.
const TRAIN_AT: usize = STATE_AT + 5;

/// The last ball of a train and its foremost one may overlap the next by roundings; the others may not, and no more than that.
#[test]
fn balls_overlap_by_roundings_alone() {
    let mut model = Linear::model();
    let block = export(&model);
    let configuration = linear();
    let length = f64::from(configuration.loaded_length + configuration.return_length);
    let pitch = 2.0 * f64::from(configuration.bearing.ball_radius()) / length;
    // To 64 units, what f32 holds of it.
    let pitch = (pitch * 2_f64.powi(32)) as u32;
    let mut import = |foremost: usize, ball: usize, overlap: u32| {
        let mut block = block.clone();
        block[TRAIN_AT - 1] = foremost as u8;
        let at = |ball: usize| TRAIN_AT + BALL_BYTES * (ball % LINEAR_BALLS);
        let ahead = at(ball + 1);
        let ahead = u32::from_le_bytes(block[ahead..ahead + 4].try_into().unwrap());
        let place = ahead.wrapping_sub(pitch).wrapping_add(overlap);
        block[at(ball)..at(ball) + 4].copy_from_slice(&place.to_le_bytes());
        model.import(&sealed(block))
    };
    let refused = |field| Err(Refusal::OutOfRange { field });
    let last = LINEAR_BALLS - 1;
    for (ball, foremost) in [(last, last), (last, 3), (3, 3), (0, 0)] {
        assert_eq!(import(foremost, ball, 500), Ok(()));
        assert_eq!(import(foremost, ball, 1200), refused("position"));
    }
    for (ball, foremost) in [(3, last), (0, 1), (4, 3)] {
        assert_eq!(import(foremost, ball, 500), refused("position"));
    }
    assert_eq!(import(LINEAR_BALLS, last, 500), refused("foremost"));
}

/// A friction coefficient over that of the set-up is the ratio of any two from 1e-6 to 1, and a factor of two beyond.
#[test]
fn a_ratio_of_two_coefficients_is_in_range() {
    let mut model = Linear::model();
    let block = export(&model);
    let at = block.len() - 8;
    let mut import = |ratio: f32| model.import(&patched(&block, at, ratio.to_le_bytes()));
    let refused = Err(Refusal::OutOfRange { field: "friction" });
    let largest = 1e6_f32;
    for (ratio, expected) in [
        (0.49 / largest, refused),
        (0.51 / largest, Ok(())),
        (1.99 * largest, Ok(())),
        (2.01 * largest, refused),
    ] {
        assert_eq!(import(ratio), expected, "{ratio}");
    }
}

#[test]
fn a_coefficient_of_other_balls_is_refused() {
    let mut model = Uncaged::model();
    let block = export(&model);
    let (least, largest) = BALL_RANGE.law.friction_range();
    let at = block.len() - 8;
    let with = |friction: f32| patched(&block, at, friction.to_le_bytes());
    for taken in [least, 0.5 * (least + largest), largest] {
        assert_eq!(model.import(&with(taken)), Ok(()), "{taken}");
    }
    for other in [0.9 * least, 1.1 * largest, 0.0, f32::NAN] {
        assert_eq!(
            refused(&mut model, &with(other)),
            Refusal::OutOfRange { field: "friction" },
            "{other}"
        );
    }
}

#[test]
fn numbers_out_of_range_are_refused() {
    let field = |refusal| match refusal {
        Refusal::OutOfRange { field } => field,
        other => panic!("{other}"),
    };
    let (mut model, _) = driven::<Linear>(1, 50);
    let block = export(&model);
    let behind = patched(
        &block,
        TRAIN_AT + BALL_BYTES,
        &block[TRAIN_AT..TRAIN_AT + 4],
    );
    assert_eq!(field(refused(&mut model, &behind)), "position");

    // A friction coefficient that is none, or that the block does not hold.
    let (mut model, _) = driven::<CagedScrew>(1, 50);
    let block = export(&model);
    for number in [
        f32::NAN,
        f32::INFINITY,
        f32::NEG_INFINITY,
        1e30,
        -0.1,
        0.049,
        0.151,
    ] {
        let refusal = refused(&mut model, &patched(&block, STATE_AT, number.to_le_bytes()));
        assert_eq!(field(refusal), "friction", "{number}");
    }

    // A count beyond the sensor's, and a play beyond its width, as the last state of a sensor with memory.
    let (mut model, _) = driven::<UncagedByCounts>(1, 50);
    let block = export(&model);
    let scene = FrictionModel::<Uncaged>::STATE_BYTES - 4;
    let reading = scene + 4 * 5 + 1;
    for (at, bytes, name) in [
        (reading, COUNTS.to_le_bytes(), "reading"),
        // The sensor's own play, and that of the balls.
        (reading + 4, 3e-3_f32.to_le_bytes(), "reading"),
        (reading + 12, 3e-3_f32.to_le_bytes(), "play"),
        (reading + 20, 501.0_f32.to_le_bytes(), "inputs"),
    ] {
        assert_eq!(
            field(refused(&mut model, &patched(&block, at, bytes))),
            name
        );
    }
}

#[test]
fn random_blocks_are_refused_or_harmless() {
    fn check<S: Trial + StoredScene>(models: u64) -> (u32, u32)
    where
        S::State: Debug,
    {
        let (mut taken, mut refused, mut lost) = (0, 0, 0);
        for seed in 0..models {
            let mut random = Random(seed);
            let (configuration, mut model, _) = accepted::<S>(&mut random);
            let mut sensors = [0.0; 3];
            for tick in 0..60 {
                sensors = S::sensors(&mut random, &configuration, sensors);
                model.step(S::inputs(sensors));
                if tick % 20 != 19 {
                    continue;
                }
                let mut block = vec![0; FrictionModel::<S>::STATE_BYTES];
                if let Err(refusal) = model.export(&mut block) {
                    // Under some hundred kN on a ball its place is NaN or infinite until the load falls.
                    let state = format!("{:?}", model.state());
                    assert!(state.contains("NaN"), "{refusal}: {state}");
                    lost += 1;
                    continue;
                }
                let copy = &mut FrictionModel::<S>::new(&configuration).unwrap();
                assert_eq!(copy.import(&block), Ok(()), "{}, seed {seed}", S::name());
                for trial in 0..30 {
                    let mut wrong = block.clone();
                    for _ in 0..=random.below(4) {
                        let at = STATE_AT + random.below(block.len() - STATE_AT - 8);
                        let number = random.signal(1e6, 1.0).to_le_bytes();
                        let width = 1 + random.below(4);
                        wrong[at..at + width].copy_from_slice(&number[4 - width..]);
                    }
                    let before = format!("{:?}", copy.state());
                    if copy.import(&sealed(wrong)).is_err() {
                        refused += 1;
                        assert_eq!(format!("{:?}", copy.state()), before);
                        continue;
                    }
                    taken += 1;
                    let mut sensors = sensors;
                    for _ in 0..40 {
                        sensors = S::sensors(&mut random, &configuration, sensors);
                        let outputs = copy.step(S::inputs(sensors));
                        let sound = S::check(&configuration, sensors, &outputs)
                            .and_then(|()| S::check_state(copy));
                        if let Err(error) = sound {
                            panic!(
                                "{}, seed {seed}, tick {tick}, trial {trial}, {sensors:?}: {error}",
                                S::name()
                            );
                        }
                    }
                }
            }
        }
        assert!(
            lost < models,
            "{lost} of {} states without a block",
            3 * models
        );
        (taken, refused)
    }
    for (taken, refused) in [
        check::<CagedScrew>(8),
        check::<UncagedBallScrew<2>>(30),
        check::<UncagedBallScrew<7, 3>>(30),
        check::<UncagedBallScrew<37>>(30),
        check::<LinearBearingTrain<1>>(30),
        check::<LinearBearingTrain<16>>(60),
    ] {
        assert!(
            taken > 20 && refused > 20,
            "{taken} taken, {refused} refused"
        );
    }
}

/// The faults of the last step are the last thing in a block with memory; a flag that is none is refused.
#[test]
fn unknown_flags_are_refused() {
    let (mut model, _) = driven::<CagedByAngle>(1, 50);
    let block = export(&model);
    let at = block.len() - 6;
    let mut import = |flags: u16| model.import(&patched(&block, at, flags.to_le_bytes()));
    let next = Faults::TEMPERATURE_STALE.bits() << 1;
    assert_eq!(import(next - 1), Ok(()));
    let refused = Err(Refusal::OutOfRange { field: "faults" });
    assert_eq!(import(next), refused);
    assert_eq!(import(u16::MAX), refused);
}
