//! Tests of what a trace without a design tells.

use std::f64::consts::TAU;

use super::{Filters, plain};
use crate::calibrate::fit::toys::noise;
use crate::calibrate::trace::{Coordinate, Repairs, Trace};

const TICK: f64 = 2e-3;
const SAMPLES: usize = 2000;
/// kg m^2, N m s/rad, N m.
const TRUTH: [(&str, f64); 3] = [
    ("inertia", 4e-4),
    ("viscous_friction", 2e-3),
    ("coulomb_friction", 0.12),
];

/// Four seconds of a drive whose friction turns round at once: three sines of phases by a number, and a torque with noise.
fn drive(number: u64) -> Trace {
    let phases = noise(1000 + number, 3, 0.0);
    let rough = noise(number, SAMPLES, 0.0);
    let [inertia, drag, coulomb] = TRUTH.map(|(_, value)| value);
    let mut position = Vec::with_capacity(SAMPLES);
    let mut effort = Vec::with_capacity(SAMPLES);
    for (sample, rough) in rough.iter().enumerate() {
        let time = TICK * sample as f64;
        let [mut angle, mut speed, mut acceleration] = [0.0; 3];
        for ((frequency, size), phase) in [(0.5, 6.0), (1.7, 1.5), (4.3, 0.25)]
            .into_iter()
            .zip(&phases)
        {
            let turn = TAU * frequency;
            let (sine, cosine) = (turn * time + TAU * phase).sin_cos();
            angle += size * sine;
            speed += size * turn * cosine;
            acceleration -= size * turn * turn * sine;
        }
        position.push(angle);
        effort
            .push(inertia * acceleration + drag * speed + coulomb * speed.signum() + 2e-3 * rough);
    }
    Trace {
        name: "drive".into(),
        coordinate: Coordinate::Rotation,
        start: 0.0,
        step: TICK,
        position,
        resolution: 0.0,
        position_summed: false,
        speed: None,
        effort,
        reference_position: None,
        load: None,
        temperature: None,
        repairs: Repairs::default(),
        ignored: Vec::new(),
    }
}

/// Friction that turns round half a sample late would count as 1.5 % of inertia, far beyond the intervals.
#[test]
fn coulomb_friction_does_not_count_as_inertia() {
    const DRIVES: u64 = 60;
    let mut sums = [0.0; 3];
    let mut held = [0_u32; 3];
    for number in 0..DRIVES {
        let (answer, _) = plain(&drive(number), &Filters::default()).unwrap();
        for (place, (name, truth)) in TRUTH.into_iter().enumerate() {
            let found = answer
                .parameters
                .iter()
                .find(|parameter| parameter.name == name)
                .unwrap();
            sums[place] += found.value / truth / DRIVES as f64;
            held[place] += u32::from((found.low..=found.high).contains(&truth));
        }
    }
    println!("mean over truth {sums:?}, of {DRIVES} intervals hold the truth: {held:?}");
    for (mean, held) in sums.into_iter().zip(held) {
        // Measured: inertia 3.5e-3 high, the others within 1.2e-3. A torque that jumps between two samples is known to half a sample.
        assert!((mean - 1.0).abs() < 5e-3, "{sums:?}");
        // 95 % of 60 are 57, with a standard deviation of 1.7; measured 52 for the inertia, for the same reason.
        assert!(held >= 50, "{held}");
    }
}
