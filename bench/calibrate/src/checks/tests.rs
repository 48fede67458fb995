//! Tests of what is refused and what is found.

use std::f64::consts::TAU;

use rand::SeedableRng;
use rand_distr::{Distribution, Normal};

use crate::checks::finding::{Finding, FindingKind};
use crate::checks::{examine, load_gain};
use crate::signals::{Motion, SmoothingSettings};
use crate::trace::{Coordinate, Repairs, Trace};
use epas_page::failure::Failure;

const STEP: f64 = 1e-3;
const SAMPLES: usize = 10_000;
const TRAVEL: f64 = 1.1e-3;

/// Travel, speed and acceleration that a test gives by time.
type Path = fn(f64) -> [f64; 3];

/// To and fro at several speeds: two sines.
fn weave(time: f64) -> [f64; 3] {
    [(3.0, TAU * 0.4), (0.3, TAU * 1.7)]
        .into_iter()
        .map(|(size, rate)| {
            let (sine, cosine) = (rate * time).sin_cos();
            [
                size * sine,
                size * rate * cosine,
                -size * rate * rate * sine,
            ]
        })
        .fold([0.0; 3], |sum, add| [0, 1, 2].map(|k| sum[k] + add[k]))
}

/// So fast that inertia shows.
fn brisk(time: f64) -> [f64; 3] {
    let [position, speed, acceleration] = weave(5.0 * time);
    [position, 5.0 * speed, 25.0 * acceleration]
}

/// One speed, both directions: 2 s each.
fn triangle(time: f64) -> [f64; 3] {
    let phase = time.rem_euclid(4.0);
    let (position, speed) = if phase < 2.0 {
        (5.0 * phase, 5.0)
    } else {
        (5.0 * (4.0 - phase), -5.0)
    };
    [position, speed, 0.0]
}

/// One speed, one direction.
fn onwards(time: f64) -> [f64; 3] {
    [5.0 * time, 5.0, 0.0]
}

/// Slower and faster, one direction.
fn pulsing(time: f64) -> [f64; 3] {
    let rate = TAU * 0.5;
    let (sine, cosine) = (rate * time).sin_cos();
    [6.0 * time + sine, 6.0 + rate * cosine, -rate * rate * sine]
}

/// Load by time, N.
fn load(time: f64) -> f64 {
    1500.0 * (TAU * 0.15 * time).sin() + 300.0 * (TAU * 0.9 * time).cos()
}

/// A nut with inertia, drag and Coulomb friction, under a load, its sensors 14 bit and 5 mN m.
fn trace(path: Path) -> Trace {
    let mut random = rand_pcg::Pcg64::seed_from_u64(3);
    let noise = Normal::new(0.0, 5e-3).unwrap();
    let resolution = TAU / 16384.0;
    let time = |sample: usize| STEP * sample as f64;
    let effort = (0..SAMPLES)
        .map(|sample| {
            let [_, speed, acceleration] = path(time(sample));
            let friction = 0.03 * 1.0_f64.copysign(speed) + 3e-4 * speed;
            4e-4 * acceleration
                + friction
                + TRAVEL * load(time(sample))
                + 6e-3
                + noise.sample(&mut random)
        })
        .collect();
    Trace {
        name: "toy".into(),
        coordinate: Coordinate::Rotation,
        start: 0.0,
        step: STEP,
        position: (0..SAMPLES)
            .map(|sample| (path(time(sample))[0] / resolution).round() * resolution)
            .collect(),
        resolution,
        position_summed: false,
        speed: None,
        effort,
        reference_position: None,
        load: Some((0..SAMPLES).map(|sample| load(time(sample))).collect()),
        load_is_effort: false,
        known: None,
        temperature: Some((0..SAMPLES).map(|sample| 293.0 + time(sample)).collect()),
        left_out: Vec::new(),
        origins: crate::trace::Origins::default(),
        repairs: Repairs::default(),
        ignored: Vec::new(),
    }
}

/// The same without its load.
fn unloaded(path: Path) -> Trace {
    let mut trace = trace(path);
    for (effort, load) in trace.effort.iter_mut().zip(trace.load.take().unwrap()) {
        *effort -= TRAVEL * load;
    }
    trace
}

fn word(failure: Failure) -> String {
    match failure {
        Failure::Data(message) => message,
        other => format!("{other:?}"),
    }
}

fn look(trace: &Trace) -> Result<Vec<Finding>, String> {
    let motion = Motion::of(trace, &SmoothingSettings::default()).map_err(word)?;
    examine(trace, &motion).map_err(word)
}

fn kinds(trace: &Trace) -> Vec<FindingKind> {
    look(trace)
        .unwrap()
        .iter()
        .map(|found| found.kind)
        .collect()
}

#[test]
fn a_good_trace_has_no_finding() {
    assert_eq!(kinds(&trace(brisk)), []);
    let good = trace(brisk);
    let motion = Motion::of(&good, &SmoothingSettings::default()).unwrap();
    load_gain(&good, &motion, TRAVEL, true).unwrap();
}

#[test]
fn what_a_trace_does_not_excite_is_found() {
    assert_eq!(
        kinds(&unloaded(brisk)),
        [FindingKind::NoLoad],
        "no load column"
    );
    assert_eq!(
        kinds(&unloaded(weave)),
        [FindingKind::ClockUnchecked, FindingKind::NoLoad],
        "so slow that inertia hardly shows"
    );
    let mut zero = unloaded(brisk);
    zero.load = Some(vec![0.0; SAMPLES]);
    assert_eq!(kinds(&zero), [FindingKind::NoLoad], "a load of zeros");
    let mut dead = unloaded(brisk);
    dead.load = Some(vec![800.0; SAMPLES]);
    assert_eq!(kinds(&dead), [FindingKind::DeadChannel], "one load");
    let mut cold = trace(brisk);
    cold.temperature = None;
    assert_eq!(kinds(&cold), [FindingKind::ConstantTemperature]);
    let found = kinds(&trace(triangle));
    assert!(found.contains(&FindingKind::ConstantSpeed), "{found:?}");
    assert!(found.contains(&FindingKind::FewReversals), "{found:?}");
    let found = kinds(&trace(pulsing));
    assert_eq!(found, [FindingKind::OneDirection]);
    let mut coarse = trace(brisk);
    coarse.resolution = TAU / 1000.0;
    for position in &mut coarse.position {
        *position = (*position / coarse.resolution).round() * coarse.resolution;
    }
    assert!(kinds(&coarse).contains(&FindingKind::CoarsePosition));
    let mut repaired = trace(brisk);
    repaired.repairs.missing = 3;
    repaired.ignored = vec!["gear".into()];
    assert_eq!(
        kinds(&repaired),
        [FindingKind::Repaired, FindingKind::IgnoredColumns]
    );
}

#[test]
fn a_load_that_hardly_varies_is_found() {
    let mut steady = unloaded(brisk);
    let load: Vec<f64> = (0..SAMPLES)
        .map(|sample| 1000.0 + 30.0 * (TAU * 0.15 * STEP * sample as f64).sin())
        .collect();
    for (effort, load) in steady.effort.iter_mut().zip(&load) {
        *effort += TRAVEL * load;
    }
    steady.load = Some(load);
    let found = look(&steady).unwrap();
    assert_eq!(found.len(), 1, "{found:?}");
    assert_eq!(found[0].kind, FindingKind::ConstantLoad);
    // 30 / sqrt(2) N of 1030 N.
    assert!((found[0].figure - 21.2 / 1030.0).abs() < 1e-3);
}

#[test]
fn a_load_that_is_not_in_the_trace_is_found() {
    let mut hidden = trace(brisk);
    hidden.load = None;
    let message = look(&hidden).unwrap_err();
    assert!(message.contains("add a column axial_load"), "{message}");
    // A fifth of the load leaves more of the rest.
    let mut little = unloaded(brisk);
    for (sample, effort) in little.effort.iter_mut().enumerate() {
        *effort += 0.2 * TRAVEL * load(STEP * sample as f64);
    }
    let found = kinds(&little);
    assert!(found.contains(&FindingKind::Unexplained), "{found:?}");
}

#[test]
fn one_speed_one_way_tells_nothing() {
    let message = look(&unloaded(onwards)).unwrap_err();
    assert!(message.contains("one number"), "{message}");
}

#[test]
fn wrong_signs_are_refused() {
    for path in [brisk as Path, triangle] {
        for loaded in [true, false] {
            let good = if loaded { trace(path) } else { unloaded(path) };
            let mut turned = good.clone();
            for effort in &mut turned.effort {
                *effort = -*effort;
            }
            let message = look(&turned).unwrap_err();
            assert!(message.contains("turn the sign of the effort"), "{message}");
            let mut turned = good;
            for position in &mut turned.position {
                *position = -*position;
            }
            let message = look(&turned).unwrap_err();
            assert!(message.contains("or of the position"), "{message}");
        }
    }
    let mut turned = trace(brisk);
    for load in turned.load.as_mut().unwrap() {
        *load = -*load;
    }
    let message = look(&turned).unwrap_err();
    assert!(message.contains("sign of the load"), "{message}");
}

/// Friction of a small motion is a spring's for a part of it, and no wrong sign, no shifted clock; of the smallest nothing is checked.
#[test]
fn small_motions_are_taken() {
    let noise = Normal::new(0.0, 5e-3).unwrap();
    let mut random = rand_pcg::Pcg64::seed_from_u64(5);
    for (size, breakaway, checked) in [
        (4e-3, 2e-3, false),
        (20e-3, 2e-3, true),
        (50e-3, 2e-3, true),
        (50e-3, 5e-3, true),
        (200e-3, 5e-3, true),
    ] {
        let mut small = unloaded(weave);
        let angle = |sample: usize| size * (TAU * 0.8 * STEP * sample as f64).sin();
        let (mut held, mut before) = (0.0_f64, 0.0);
        for (sample, effort) in small.effort.iter_mut().enumerate() {
            let pull = (angle(sample) - before) / breakaway;
            before = angle(sample);
            held = (held + pull) / (1.0 + pull.abs());
            *effort = 0.3 * held + noise.sample(&mut random);
            small.position[sample] = (before / small.resolution).round() * small.resolution;
        }
        let found = kinds(&small);
        let unchecked = found.contains(&FindingKind::SignUnchecked);
        assert_eq!(unchecked, !checked, "{size}: {found:?}");
    }
}

#[test]
fn wrong_units_are_refused() {
    let speed: Vec<f64> = (0..SAMPLES)
        .map(|sample| brisk(STEP * sample as f64)[1])
        .collect();
    let with_speed = |factor: f64, late: usize| {
        let mut trace = trace(brisk);
        trace.speed = Some(
            (0..SAMPLES)
                .map(|sample| factor * speed[sample.saturating_sub(late)])
                .collect(),
        );
        trace
    };
    assert_eq!(kinds(&with_speed(1.0, 0)), []);
    assert_eq!(kinds(&with_speed(1.0, 6)), [FindingKind::ShiftedSpeed]);
    for (factor, shown) in [(60.0 / TAU, "9.5"), (-1.0, "-1.00"), (57.3, "57.")] {
        let message = look(&with_speed(factor, 0)).unwrap_err();
        assert!(message.contains(shown), "{message}");
    }
    let mut other = trace(brisk);
    other.speed = Some(
        (0..SAMPLES)
            .map(|sample| (STEP * sample as f64).sin())
            .collect(),
    );
    assert!(look(&other).unwrap_err().contains("not the derivative"));
    let mut millidegrees = trace(brisk);
    for position in &mut millidegrees.position {
        *position *= 57_295.8;
    }
    millidegrees.resolution *= 57_295.8;
    assert!(look(&millidegrees).unwrap_err().contains("SI units"));
    let mut kilonewtons = trace(brisk);
    for load in kilonewtons.load.as_mut().unwrap() {
        *load *= 1e-3;
    }
    let motion = Motion::of(&kilonewtons, &SmoothingSettings::default()).unwrap();
    for unsaid in [false, true] {
        let message = word(load_gain(&kilonewtons, &motion, TRAVEL, unsaid).unwrap_err());
        assert!(message.contains("wrong unit"), "{message}");
        assert!(message.contains("axial_load [kN]"), "{message}");
        assert!(!message.contains("--ratio"), "{message}");
    }
    let mut exchanged = trace(brisk);
    let torque = std::mem::replace(&mut exchanged.effort, exchanged.load.take().unwrap());
    exchanged.load = Some(torque);
    let message = look(&exchanged).unwrap_err();
    assert!(
        message.contains("motor_torque and axial_load are exchanged"),
        "{message}"
    );
}

#[test]
fn shifted_clocks_are_refused() {
    for late in [6isize, -6] {
        let moved = |channel: &[f64]| -> Vec<f64> {
            (0..SAMPLES as isize)
                .map(|sample| channel[(sample - late).clamp(0, SAMPLES as isize - 1) as usize])
                .collect()
        };
        let mut load = trace(brisk);
        load.load = Some(moved(load.load.as_ref().unwrap()));
        let message = look(&load).unwrap_err();
        let way = if late > 0 { "earlier" } else { "later" };
        assert!(
            message.contains(&format!("6 ticks (6.0 ms) {way} than the load")),
            "{message}"
        );
        let mut effort = unloaded(brisk);
        effort.effort = moved(&effort.effort);
        let message = look(&effort).unwrap_err();
        let way = if late > 0 { "later" } else { "earlier" };
        assert!(
            message.contains(&format!("6 ticks (6.0 ms) {way} than the motion")),
            "{message}"
        );
    }
}

#[test]
fn clipped_and_dead_efforts_are_refused() {
    let clip = |limit: f64| {
        let mut trace = trace(brisk);
        for effort in &mut trace.effort {
            *effort = effort.clamp(-limit, limit);
        }
        trace
    };
    let message = look(&clip(1.0)).unwrap_err();
    assert!(message.contains("clipped"), "{message}");
    let found = look(&clip(2.1)).unwrap();
    assert_eq!(found.len(), 1, "{found:?}");
    assert_eq!(found[0].kind, FindingKind::ClippedEffort);
    let mut dead = trace(brisk);
    dead.effort = vec![0.7; SAMPLES];
    assert!(look(&dead).unwrap_err().contains("dead channel"));
    let mut still = trace(brisk);
    still.position = vec![1.0; SAMPLES];
    assert!(look(&still).unwrap_err().contains("never moves"));
}

#[test]
fn numbers_that_are_none_are_refused() {
    for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let mut broken = trace(brisk);
        broken.effort[777] = value;
        let message = look(&broken).unwrap_err();
        assert!(message.contains("0.7770 s (sample 777)"), "{message}");
        let mut broken = trace(brisk);
        broken.position[777] = value;
        assert!(
            look(&broken)
                .unwrap_err()
                .contains("position is not finite")
        );
    }
    let mut short = trace(brisk);
    short.load.as_mut().unwrap().pop();
    assert!(look(&short).unwrap_err().contains("9999 samples"));
}
