//! `step`: whatever the sensors say, outputs are finite, flagged, bounded, and never drive.
//!
//! The first eight bytes draw a scene and its configuration; from then on every four bytes are one number
//! from a sensor, as its bits.
#![no_main]

use epas_friction::scene::CagedBallScrew;
use epas_friction::{ClosedFormScrew, LinearBearingTrain, UncagedBallScrew};
use epas_testkit::random::Random;
use epas_testkit::random_scenes::{Trial, accepted};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|data: &[u8]| {
    let Some((seed, signals)) = data.split_first_chunk::<8>() else {
        return;
    };
    let seed = u64::from_le_bytes(*seed);
    match seed & 7 {
        0 => run::<ClosedFormScrew>(seed, signals),
        1 => run::<CagedBallScrew<5>>(seed, signals),
        2 => run::<UncagedBallScrew<2>>(seed, signals),
        3 => run::<UncagedBallScrew<7, 3>>(seed, signals),
        4 => run::<UncagedBallScrew<37>>(seed, signals),
        5 => run::<LinearBearingTrain<1>>(seed, signals),
        6 => run::<LinearBearingTrain<3>>(seed, signals),
        _ => run::<LinearBearingTrain<16>>(seed, signals),
    }
});

fn run<S: Trial>(seed: u64, signals: &[u8]) {
    let (configuration, mut model, _) = accepted::<S>(&mut Random(seed));
    let (numbers, _) = signals.as_chunks::<4>();
    let mut numbers = numbers.iter().map(|bits| f32::from_le_bytes(*bits));
    while let (Some(speed), Some(load)) = (numbers.next(), numbers.next()) {
        let sensors = [speed, load, numbers.next().unwrap_or(load)];
        let outputs = model.step(S::inputs(sensors));
        if let Err(error) =
            S::check(&configuration, sensors, &outputs).and_then(|()| S::check_state(&model))
        {
            panic!(
                "{}, seed {seed:#x}, sensors {sensors:?}: {error}\n{configuration:?}",
                S::name()
            );
        }
    }
}
