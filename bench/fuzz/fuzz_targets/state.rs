//! `state`: a block of any bytes is refused, with the model as it was, or leaves a model as sound as any.
//!
//! The first eight bytes draw a scene and its configuration, and whether the rest is a block or what a sound block's state
//! differs by, sealed again.
#![no_main]

use std::fmt::Debug;

use epas_friction::scene::{CagedBallScrew, StoredScene};
use epas_friction::stored::crc32;
use epas_friction::{ClosedFormScrew, FrictionModel, LinearBearingTrain, UncagedBallScrew};
use epas_testkit::random::Random;
use epas_testkit::random_scenes::{Trial, accepted};
use libfuzzer_sys::fuzz_target;

/// Bytes of a block before its state.
const HEADER: usize = 16;
const TICKS: u32 = 40;

fuzz_target!(|data: &[u8]| {
    let Some((seed, bytes)) = data.split_first_chunk::<8>() else {
        return;
    };
    let seed = u64::from_le_bytes(*seed);
    match seed & 7 {
        0 => run::<ClosedFormScrew>(seed, bytes),
        1 => run::<CagedBallScrew<5>>(seed, bytes),
        2 => run::<UncagedBallScrew<2>>(seed, bytes),
        3 => run::<UncagedBallScrew<7, 3>>(seed, bytes),
        4 => run::<UncagedBallScrew<37>>(seed, bytes),
        5 => run::<LinearBearingTrain<1>>(seed, bytes),
        6 => run::<LinearBearingTrain<3>>(seed, bytes),
        _ => run::<LinearBearingTrain<16>>(seed, bytes),
    }
});

fn run<S: Trial + StoredScene>(seed: u64, bytes: &[u8])
where
    S::State: Debug,
{
    let mut random = Random(seed);
    let (configuration, mut model, _) = accepted::<S>(&mut random);
    let mut block = vec![0; FrictionModel::<S>::STATE_BYTES];
    assert_eq!(model.export(&mut block), Ok(block.len()));
    if random.one_in(2) {
        block = bytes.to_vec();
    } else {
        let body = block.len() - 4;
        for (byte, change) in block[HEADER..body].iter_mut().zip(bytes) {
            *byte ^= change;
        }
        let checksum = crc32(&block[..body]);
        block[body..].copy_from_slice(&checksum.to_le_bytes());
    }
    let before = format!("{:?}", model.state());
    if model.import(&block).is_err() {
        assert_eq!(format!("{:?}", model.state()), before);
        return;
    }
    let mut sensors = [0.0; 3];
    for tick in 0..TICKS {
        sensors = S::sensors(&mut random, &configuration, sensors);
        let outputs = model.step(S::inputs(sensors));
        if let Err(error) =
            S::check(&configuration, sensors, &outputs).and_then(|()| S::check_state(&model))
        {
            panic!(
                "{}, seed {seed:#x}, tick {tick}, sensors {sensors:?}: {error}\n{configuration:?}",
                S::name()
            );
        }
    }
}
