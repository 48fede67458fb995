//! What a calibration writes is what a simulation runs and what firmware evaluates.

use std::f64::consts::{PI, TAU};
use std::fmt::Write as _;
use std::fs;

use epas_friction::law::coefficient::CoefficientLaw;
use epas_friction::law::memory::ProportionalElements;
use epas_friction::law::motion::{Deadband, WrappedAngle, WrappedAngleParameters};
use epas_friction::scene::{
    CagedBallScrew, CagedConstants, WithMemory, WithMemoryConstants, WithMemoryInputs,
};
use epas_friction::{FrictionModel, Inputs};
use tempfile::tempdir;

use super::{simulated_design, texts};

#[rustfmt::skip]
#[expect(dead_code, reason = "firmware takes what it needs")]
#[path = "calibrated_constants.rs"]
mod constants;

/// The design file from which the constants were written.
const DESIGN: &str = "\
name = \"rack\"
nominal_diameter = 0.032
lead = 0.02
ball_diameter = 6.35e-3
conformity = 0.528
contact_angle = 0.7853982
friction = 0.115
preload = 17
loaded_balls = 40

[calibration]
full_film_ratio = 0.522
half_share_speed = 6.0
reference_temperature = 303.15
viscosity_pole = 210.0
direction_asymmetry = 0.02
breakaway_angle = 2e-3
";

type Sensor = Deadband<WrappedAngle>;

const ANGLE: WrappedAngle = {
    let angle = WrappedAngle::new(WrappedAngleParameters {
        lowest: -std::f32::consts::PI,
        period: std::f32::consts::TAU,
        largest_turn: std::f32::consts::PI,
    });
    match angle {
        Ok(angle) => angle,
        Err(_) => panic!(),
    }
};

/// Of an encoder of 12 bits.
const STEP: f32 = std::f32::consts::TAU / 4096.0;

/// A simulation's angle is rounded to single precision: its dead band is wider by what two such angles may be off.
const ROUNDED: f32 = 2.0 * f32::EPSILON;

/// Friction coefficients of the block.
const NODES: usize = 5;

static GEAR: WithMemoryConstants<
    CagedConstants<NODES>,
    ProportionalElements<8>,
    Sensor,
    CoefficientLaw,
> = constants::with_memory(ANGLE, STEP + ROUNDED);

/// Both are the same arithmetic on the same numbers.
#[test]
fn a_simulation_runs_what_firmware_evaluates() {
    let folder = tempdir().unwrap();
    let samples: Vec<[f64; 3]> = (0..2000)
        .map(|tick| {
            let time = 1e-3 * f64::from(tick);
            let speed = 3.0 * (7.0 * time).sin() * (0.9 * time).cos();
            [time, speed, 1200.0 * (2.0 * time).sin()]
        })
        .collect();
    let mut trace = String::from("time,nut_speed,axial_load,temperature\n");
    let temperature = |time: f64| 293.15 + 20.0 * time;
    for [time, speed, load] in &samples {
        writeln!(trace, "{time},{speed},{load},{}", temperature(*time)).unwrap();
    }
    fs::write(folder.path().join("trace.csv"), trace).unwrap();
    fs::write(folder.path().join("design.toml"), DESIGN).unwrap();
    let said = simulated_design(folder.path(), "").stdout;
    assert!(
        said.contains("without --memory left out: breakaway_angle")
            && said.contains("293.1 to 333.1 K, followed"),
        "{said}"
    );
    let memory = format!("--memory --encoder-step {STEP}");
    let said = simulated_design(folder.path(), &memory).stdout;
    assert!(
        said.contains("as calibrated")
            && said.contains("dead band of 1.5340 mrad")
            && said.contains("293.1 to 333.1 K"),
        "{said}"
    );

    type Gear = WithMemory<CagedBallScrew<NODES>, ProportionalElements<8>, Sensor, CoefficientLaw>;
    let mut model = FrictionModel::<Gear, &WithMemoryConstants<_, _, _, _>>::of(&GEAR);
    let told = texts(&folder.path().join("out.csv"), "friction_torque");
    let (mut angle, mut last) = (0.0, samples[0]);
    for (sample, told) in samples.iter().zip(told) {
        angle += 0.5 * (last[1] + sample[1]) * (sample[0] - last[0]);
        last = *sample;
        let outputs = model.step(WithMemoryInputs {
            scene: Inputs {
                nut_speed: sample[1] as f32,
                axial_load: sample[2] as f32,
            },
            reading: ((angle + PI).rem_euclid(TAU) - PI) as f32,
            load_age: 0.0,
            temperature: temperature(sample[0]) as f32,
            temperature_age: 0.0,
        });
        assert_eq!(told.parse(), Ok(outputs.friction_torque), "{sample:?}");
    }
}
