//! The same inputs give the same bits: in debug and release builds, with and without `defmt`, on every machine.
//!
//! Inputs come from integers by one multiplication, so that nothing but the crate's own arithmetic can differ.

use crate::remembering::{
    COUNTS, CagedByAngle, LinearBySpeed, TEMPERATURE, TICK, UncagedByCounts, at, caged_by_angle,
    linear_by_speed, uncaged_by_counts,
};
use epas_friction::ball::{GrooveFit, ScrewRow};
use epas_friction::scene::{CagedBallScrew, Scene};
use epas_friction::{
    CATALOGUE, Clearance, ClosedFormScrew, ClosedFormScrewConfiguration, FrictionBranch,
    FrictionModel, LinearBearingTrain, LoadShare, LoadShares, UncagedBallScrew,
};
use epas_testkit::gears;
use epas_testkit::gears::{linear_inputs, screw_inputs};
use epas_testkit::random::Random;
use epas_testkit::random_scenes::{EDGES, Trial, row_numbers};

const TICKS: u32 = 200_000;

const EMPTY: u64 = 0xcbf2_9ce4_8422_2325;

fn taken_in(hash: u64, numbers: &[u32]) -> u64 {
    numbers.iter().fold(hash, |hash, &number| {
        (hash ^ u64::from(number)).wrapping_mul(0x0100_0000_01b3)
    })
}

fn hash<S: Trial>(configuration: &S::Configuration, full_scale: [f32; 3]) -> u64 {
    let mut model = FrictionModel::<S>::new(configuration).unwrap();
    let mut random = Random(2019);
    let mut hash = EMPTY;
    for tick in 0..TICKS {
        let mut sensors = full_scale.map(|scale| scale * (2.0 * random.unit() - 1.0));
        if tick % 64 == 63 {
            let edge = EDGES[tick as usize / 64 % EDGES.len()];
            sensors[tick as usize / 64 % 3] = edge;
        }
        let outputs = model.step(S::inputs(sensors));
        hash = taken_in(hash, &S::numbers(&outputs));
    }
    hash
}

#[test]
fn every_scene_gives_the_stored_bits() {
    let limits = gears::LIMITS;
    let screw = [limits.nut_speed, limits.axial_load, 0.0];
    let linear = [3.0, 20_000.0, 20_000.0];
    let hashes = [
        hash::<gears::CagedScrew>(&gears::caged(), screw),
        hash::<gears::UncagedScrew<{ gears::SCREW_BALLS }>>(&gears::uncaged(), screw),
        hash::<LinearBearingTrain<{ gears::LINEAR_BALLS }>>(&gears::linear(), linear),
    ];
    // A change of a formula changes them; a change of the build must not.
    assert_eq!(hashes.map(|hash| format!("{hash:#018x}")), STORED);
}

const STORED: [&str; 3] = [
    "0x9edc42f8de3f201c",
    "0x74899b688919beb9",
    "0x59ec950aa062b001",
];

/// What the sensors of a slow course go through, as parts of their full scale: speed, load, side load; from each to the next in
/// [`LEG`] ticks. Standstill under load, turning out and home, a load that fades and changes its sign at one speed, light loads,
/// loads that grow by a factor of 1.2, of 2 and of 5 in a tick or two, and the largest speed.
const COURSE: [[f32; 3]; 18] = [
    [0.0, 0.0, 0.0],
    [0.0, 0.2, 0.05],
    [0.1, 0.2, 0.05],
    [0.1, 0.3, 0.1],
    [-0.1, 0.3, 0.1],
    [-0.1, 0.01, 0.001],
    [-0.1, -0.2, -0.05],
    [0.05, -0.2, -0.05],
    [0.05, -0.0001, 0.0],
    [0.05, 0.1, 0.02],
    [0.05, 0.12, 0.02],
    [0.05, 0.6, 0.2],
    [0.3, 0.5, 0.2],
    [0.3, 0.0, 0.1],
    [0.002, 0.0, 0.3],
    [0.002, 0.5, 0.4],
    [0.0, 0.5, 0.0],
    [-1.0, 0.9, -0.6],
];

const LEG: [u32; 4] = [400, 1500, 1, 200];

/// Hash of all bits of all outputs of a slow course, in which `change` sets what it likes at each of the course's points.
fn course<S: Trial>(
    configuration: &S::Configuration,
    full_scale: [f32; 3],
    change: impl Fn(&mut FrictionModel<S>, usize),
) -> u64 {
    let mut model = FrictionModel::<S>::new(configuration).unwrap();
    let mut hash = EMPTY;
    for leg in 0..LEGS {
        for sensors in sensors(leg, full_scale) {
            let outputs = model.step(S::inputs(sensors));
            hash = taken_in(hash, &S::numbers(&outputs));
        }
        change(&mut model, leg);
    }
    hash
}

const LEGS: usize = COURSE.len() - 1;

fn sensors(leg: usize, full_scale: [f32; 3]) -> impl Iterator<Item = [f32; 3]> {
    let ticks = LEG[leg % LEG.len()];
    (0..ticks).map(move |tick| {
        let part = tick as f32 / ticks as f32;
        std::array::from_fn(|sensor| {
            let (from, to) = (COURSE[leg][sensor], COURSE[leg + 1][sensor]);
            full_scale[sensor] * (from + part * (to - from))
        })
    })
}

/// Hash of all digits of all outputs of a slow course of a scene with memory, in whose every second tick the sensor alone is read.
/// The temperature rises by 3 K from leg to leg.
fn remembered<S: Scene<Outputs: std::fmt::Debug>>(
    mut model: FrictionModel<S>,
    full_scale: [f32; 3],
    mut tick: impl FnMut(&mut FrictionModel<S>, [f32; 3], f32, bool) -> S::Outputs,
) -> u64 {
    let mut hash = EMPTY;
    for leg in 0..LEGS {
        let temperature = TEMPERATURE + 3.0 * leg as f32;
        for (number, sensors) in sensors(leg, full_scale).enumerate() {
            let outputs = tick(&mut model, sensors, temperature, number % 2 == 1);
            let digits = format!("{outputs:?}");
            hash = digits
                .bytes()
                .fold(hash, |hash, byte| taken_in(hash, &[u32::from(byte)]));
        }
    }
    hash
}

/// Friction with memory, whose coefficient follows speed and temperature, in steps and between them.
#[test]
fn memories_give_the_stored_bits() {
    use std::f32::consts::TAU;
    let screw = [100.0, 15_000.0, 0.0];
    let inputs = |[nut_speed, axial_load, _]: [f32; 3]| screw_inputs(nut_speed, axial_load);
    let mut angle = 0.0;
    let mut turned = |speed: f32| {
        angle = (angle + speed * TICK).rem_euclid(TAU);
        angle
    };
    let caged = remembered::<CagedByAngle>(
        FrictionModel::new(&caged_by_angle()).unwrap(),
        screw,
        |model, sensors, temperature, between| {
            let angle = turned(sensors[0]);
            if between {
                model.between(angle)
            } else {
                model.step(at(inputs(sensors), angle, temperature))
            }
        },
    );
    let uncaged = remembered::<UncagedByCounts>(
        FrictionModel::new(&uncaged_by_counts()).unwrap(),
        screw,
        |model, sensors, temperature, between| {
            let count = (turned(sensors[0]) / TAU * COUNTS as f32) as u32 % COUNTS;
            if between {
                model.between(count)
            } else {
                model.step(at(inputs(sensors), count, temperature))
            }
        },
    );
    let linear = remembered::<LinearBySpeed>(
        FrictionModel::new(&linear_by_speed()).unwrap(),
        [2.0, 10_000.0, 10_000.0],
        |model, [speed, normal_load, side_load], temperature, between| {
            let inputs = linear_inputs(speed, normal_load, side_load);
            if between {
                model.between(speed)
            } else {
                model.step(at(inputs, speed, temperature))
            }
        },
    );
    let hashes = [caged, uncaged, linear].map(|hash| format!("{hash:#018x}"));
    assert_eq!(hashes, STORED_MEMORIES);
}

const STORED_MEMORIES: [&str; 3] = [
    "0x91f73d8609525e5e",
    "0x676747d849406a80",
    "0xa408e6d0a3ff5136",
];

/// The closed form of a row of balls, which no step runs: without a gap, with play and with a preload that the loads leave or lose.
#[test]
fn closed_forms_of_rows_give_the_stored_bits() {
    let design = CATALOGUE[15].design().unwrap();
    let mut random = Random(3);
    let fits = [
        GrooveFit::Zero,
        GrooveFit::Play,
        GrooveFit::Preload {
            contact_force: 30.0,
        },
    ];
    let hashes = fits.map(|fit| {
        let row = ScrewRow::new(&design, 0.09, fit).unwrap();
        let mut hash = taken_in(EMPTY, &[row.largest_deviation().to_bits()]);
        for _ in 0..4000 {
            let mut unit = || 2.0 * random.unit() - 1.0;
            let tick = row.at(50.0 * unit(), 300.0 * unit() * unit().abs());
            let ball = tick.ball(0.06 * unit(), 0.06 * unit(), &LoadShare::MEAN);
            hash = taken_in(hash, &row_numbers(&tick, &ball).map(f32::to_bits));
        }
        format!("{hash:#018x}")
    });
    assert_eq!(hashes, STORED_ROWS);
}

const STORED_ROWS: [&str; 3] = [
    "0x4cdea189092ad634",
    "0xd00207526818361a",
    "0xef6cafdcb6e8dcc8",
];

static UNEVEN: [[LoadShare; 3]; 2] = [
    [share(1.3), share(0.7), share(1.0)],
    [share(0.6), share(1.0), share(1.4)],
];

const fn share(share: f32) -> LoadShare {
    match LoadShare::new(share) {
        Ok(share) => share,
        Err(_) => panic!("a share is out of range"),
    }
}

/// Balls that press and part: what random readings, which jump in every tick, do not show.
#[test]
fn slow_courses_give_the_stored_bits() {
    let screw = [100.0, 15_000.0, 0.0];
    let full = gears::crowded();
    let uneven = LoadShares {
        positive: &UNEVEN[0],
        negative: &UNEVEN[1],
    };
    let mut hashes = Vec::new();
    let clearances = [
        Clearance::ZERO,
        Clearance::new(4e-6).unwrap(),
        gears::oversize(&CATALOGUE[15].design().unwrap(), 300.0, 41),
    ];
    for clearance in clearances {
        for branch in [FrictionBranch::Rolling, FrictionBranch::Sliding] {
            let configuration = ClosedFormScrewConfiguration {
                clearance,
                ..gears::closed_form(branch)
            };
            hashes.push(course::<ClosedFormScrew>(&configuration, screw, |_, _| ()));
        }
    }
    // Loads alike; loads of their own, without and with a preload.
    for (load_shares, lift_off) in [(LoadShares::EVEN, 0.0), (uneven, 0.0), (uneven, 60.0)] {
        let configuration = gears::UncagedConfiguration {
            folded: gears::changed(full.folded, |folded| folded.law.lift_off = lift_off),
            load_shares,
            ..full
        };
        hashes.push(course::<gears::UncagedScrew<{ gears::CROWD }>>(
            &configuration,
            screw,
            |_, _| (),
        ));
        hashes.push(course::<gears::UncagedScrew<9>>(
            &gears::UncagedConfiguration {
                balls: 9,
                ..configuration
            },
            screw,
            |model, leg| model.set_friction(0.07 + 0.003 * leg as f32).unwrap(),
        ));
    }
    let one = gears::full(gears::screw_wave(0.9), full.tick);
    hashes.push(course::<UncagedBallScrew<{ gears::SCREW_BALLS }>>(
        &one,
        screw,
        |_, _| (),
    ));
    hashes.push(course::<gears::CagedScrew>(
        &gears::caged(),
        screw,
        |model, leg| model.set_friction(0.07 + 0.003 * leg as f32).unwrap(),
    ));
    hashes.push(course::<CagedBallScrew>(&gears::worn(), screw, |_, _| ()));
    let linear = [2.0, 10_000.0, 10_000.0];
    hashes.push(course::<LinearBearingTrain<{ gears::LINEAR_BALLS }>>(
        &gears::linear(),
        linear,
        |model, leg| model.set_friction(0.07 + 0.003 * leg as f32).unwrap(),
    ));
    let hashes: Vec<String> = hashes.iter().map(|hash| format!("{hash:#018x}")).collect();
    assert_eq!(hashes, STORED_COURSES);
}

/// Without clearance, with play, with oversize: both closed forms, which know no play: theirs are those without. Then screws without cage,
/// of 48 balls and of nine whose friction coefficient changes: loads alike, loads of their own, and with a preload; one of a single
/// coefficient; a caged screw whose friction changes, and one with play; then the bearing.
#[rustfmt::skip]
const STORED_COURSES: [&str; 16] = [
    "0x995cfa968c165972", "0xc8bc1ad7c1ce3ada",
    "0x995cfa968c165972", "0xc8bc1ad7c1ce3ada",
    "0x342c263f638d143f", "0x89e582c60cfeede6",
    "0xfcd32ee5b3c0572f", "0x8ecebec0075f8dcc",
    "0x10c1cb062c83cc6b", "0xeab4848ce0367fce",
    "0xf225a56fb3ce5c10", "0xee8e5a34cbfd26b2",
    "0x1030484515d43765",
    "0xde483034f742fb38", "0x34d50ca15d0c17eb",
    "0xf62ef90f3112d76e",
];
