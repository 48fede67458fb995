//! The same inputs give the same bits: in debug and release builds, with and without `defmt`, on every
//! machine.
//!
//! Inputs come from integers by one multiplication, so that nothing but the crate's own arithmetic can
//! differ.

mod kit;

use crate::kit::absurd::{EDGES, Trial};
use crate::kit::gears;
use crate::kit::random::Random;
use epas_friction::{CagedBallScrew, FrictionModel, LinearBearingTrain, UncagedBallScrew};

const TICKS: u32 = 200_000;

/// Hash (FNV-1a) of all bits of all outputs of a run.
fn hash<S: Trial>(configuration: &S::Configuration, full_scale: [f32; 3]) -> u64 {
    let mut model = FrictionModel::<S>::new(configuration).unwrap();
    let mut random = Random(2019);
    let mut hash = 0xcbf2_9ce4_8422_2325_u64;
    for tick in 0..TICKS {
        let mut sensors = full_scale.map(|scale| scale * (2.0 * random.unit() - 1.0));
        if tick % 64 == 63 {
            // A fault of one sensor.
            let edge = EDGES[tick as usize / 64 % EDGES.len()];
            sensors[tick as usize / 64 % 3] = edge;
        }
        let outputs = model.step(S::inputs(sensors));
        for number in S::numbers(&outputs) {
            hash = (hash ^ u64::from(number)).wrapping_mul(0x0100_0000_01b3);
        }
    }
    println!("{}: {hash:#018x}", S::name());
    hash
}

#[test]
fn every_scene_gives_the_stored_bits() {
    let limits = gears::LIMITS;
    let screw = [limits.nut_speed, limits.axial_load, 0.0];
    let linear = [3.0, 20_000.0, 20_000.0];
    let hashes = [
        hash::<CagedBallScrew>(&gears::caged(), screw),
        hash::<UncagedBallScrew<{ gears::SCREW_BALLS }>>(&gears::uncaged(), screw),
        hash::<LinearBearingTrain<{ gears::LINEAR_BALLS }>>(&gears::linear(), linear),
    ];
    // A change of a formula changes them; a change of the build must not.
    assert_eq!(hashes.map(|hash| format!("{hash:#018x}")), STORED);
}

const STORED: [&str; 3] = [
    "0x7505e5c0eb76a987",
    "0xf2353742845e3057",
    "0x15583a1a75440623",
];
