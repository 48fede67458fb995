//! Random and extreme inputs through `step` of every scene.

use crate::objects;
use crate::recorded;
use epas_friction::scene::CagedBallScrew;
use epas_friction::{ClosedFormScrew, LinearBearingTrain, UncagedBallScrew};
use epas_testkit::random::Random;
use epas_testkit::random_scenes;
use epas_testkit::random_scenes::soak;

const COMMAND: &str =
    "cargo test --release -p epas-reference --test all scenes::extreme -- --ignored --nocapture";

fn all_scenes(seed: u64, models: u64, ticks: u64) -> u64 {
    soak::<ClosedFormScrew>(seed, 2 * models, ticks)
        + soak::<CagedBallScrew<1>>(seed, 2 * models, ticks)
        + soak::<CagedBallScrew<2>>(seed, 2 * models, ticks)
        + soak::<CagedBallScrew<5>>(seed, 2 * models, ticks)
        + soak::<UncagedBallScrew<1>>(seed, models, ticks)
        + soak::<UncagedBallScrew<2>>(seed, models, ticks)
        + soak::<UncagedBallScrew<3>>(seed, models, ticks)
        + soak::<UncagedBallScrew<16>>(seed, models, ticks)
        + soak::<UncagedBallScrew<37>>(seed, models / 4, ticks)
        + soak::<UncagedBallScrew<64>>(seed, models / 4, ticks)
        + soak::<UncagedBallScrew<7, 3>>(seed, models, ticks)
        + soak::<UncagedBallScrew<37, 3>>(seed, models / 4, ticks)
        + soak::<LinearBearingTrain<1>>(seed, models, ticks)
        + soak::<LinearBearingTrain<2>>(seed, models, ticks)
        + soak::<LinearBearingTrain<5>>(seed, models, ticks)
        + soak::<LinearBearingTrain<16>>(seed, models, ticks)
        + soak::<LinearBearingTrain<64>>(seed, models / 4, ticks)
}

#[test]
fn random_inputs_give_finite_flagged_bounded_outputs() {
    let ticks = all_scenes(1, 200, 1000);
    println!("{ticks} random ticks in all scenes");
}

/// Forces of 1e5 N between balls that friction hardly holds: rounding makes some of them negative, and their sum must not drive the nut.
#[test]
fn forces_that_rounding_makes_negative_do_not_drive() {
    soak::<UncagedBallScrew<64>>(0x000a_e000_0001_27ac, 1, 100);
}

fn random_objects(seed: u64, count: u64) {
    for object in 0..count {
        let seed = seed.wrapping_add(object);
        let mut random = Random(seed);
        let numbers = (0..48)
            .map(|_| {
                if random.one_in(64) {
                    random.of(&random_scenes::EDGES)
                } else {
                    random.anything()
                }
            })
            .collect();
        if let Err(error) = objects::check(&mut objects::Numbers(numbers)) {
            panic!("seed {seed:#x}: {error}");
        }
    }
}

#[test]
fn random_numbers_are_refused_or_give_finite_objects() {
    random_objects(1, 100_000);
}

#[test]
#[ignore = "minutes: cargo test --release -p epas-reference --test all scenes::extreme -- --ignored --nocapture"]
fn a_hundred_million_random_objects() {
    const COUNT: u64 = 100_000_000;
    random_objects(1 << 32, COUNT);
    recorded::print("objects made of random numbers", COUNT, COMMAND);
}

#[test]
#[ignore = "half an hour: cargo test --release -p epas-reference --test all scenes::extreme -- --ignored --nocapture"]
fn a_thousand_million_random_inputs() {
    let mut ticks = 0;
    let mut round = 2;
    while ticks < 1_000_000_000 {
        ticks += all_scenes(round, 4000, 1000);
        round += 1;
    }
    recorded::print(
        "ticks of all scenes under random inputs, 1 to 64 balls",
        ticks,
        COMMAND,
    );
}
