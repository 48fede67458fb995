//! Random and extreme inputs through `step` of every scene.

mod absurd;

use absurd::soak;
use epas_friction::{CagedBallScrew, LinearBearingTrain, UncagedBallScrew};

/// Every scene, from one ball to 64.
fn all_scenes(seed: u64, models: u64, ticks: u64) -> u64 {
    soak::<CagedBallScrew>(seed, 4 * models, ticks)
        + soak::<UncagedBallScrew<1>>(seed, models, ticks)
        + soak::<UncagedBallScrew<2>>(seed, models, ticks)
        + soak::<UncagedBallScrew<3>>(seed, models, ticks)
        + soak::<UncagedBallScrew<16>>(seed, models, ticks)
        + soak::<UncagedBallScrew<37>>(seed, models / 4, ticks)
        + soak::<UncagedBallScrew<64>>(seed, models / 4, ticks)
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

/// The recorded full run.
#[test]
#[ignore = "half an hour: cargo test --release -p epas-reference --test extreme -- --ignored --nocapture"]
fn a_thousand_million_random_inputs() {
    let mut ticks = 0;
    let mut round = 2;
    while ticks < 1_000_000_000 {
        ticks += all_scenes(round, 4000, 1000);
        round += 1;
    }
    println!("{ticks} random ticks in all scenes");
}
