//! The rig's trace with what real traces have: each parameter within its interval, or a word instead of it.

use std::f64::consts::TAU;
use std::fmt::Write as _;
use std::io::Cursor;

use epas_friction::law::coefficient::DirectionalCoefficient;
use epas_rig::course::Course;
use epas_rig::parameters::Parameters;
use epas_rig::{Rig, Sensors};

use super::exact::{Grid, Spacing};
use super::{Request, calibrate};
use crate::answer::{Calibration, Estimate};
use crate::fit::toys::noise;
use crate::trace::columns::{Frame, from_reader};
use epas_design::files::{DesignSource, read};

/// What the rig was made with, of what does not need a minute to be told.
const TRUTH: [(&str, f64); 5] = [
    ("friction", 0.115),
    ("breakaway_angle", 2e-3),
    ("inertia", 4e-4),
    ("offset", 6e-3),
    ("gain", 1.012),
];

fn measured() -> epas_rig::Trace {
    let rig = Rig::new(Parameters::default(), Sensors::default()).unwrap();
    rig.run(&Course::vehicle().times(0.2), 3).unwrap()
}

/// The answer to a trace, or the word with which it is refused.
fn said(trace: &epas_rig::Trace) -> Result<Calibration, String> {
    let mut text = String::from("time,nut_position,motor_torque,axial_load,temperature\n");
    for row in 0..trace.time.len() {
        writeln!(
            text,
            "{:.7},{:.9},{:.7},{:.3},{:.3}",
            trace.time[row],
            trace.nut_position[row],
            trace.motor_torque[row],
            trace.axial_load[row],
            trace.temperature[row]
        )
        .unwrap();
    }
    let design = "lin-4.1".parse::<DesignSource>().unwrap().load().unwrap();
    let frame = Frame::of(&design, None);
    let mut request = Request {
        without_models: true,
        ratio_unsaid: true,
        ..Request::default()
    };
    let estimated = TRUTH.map(|(name, _)| name.to_owned());
    request.wanted.estimate = Some(estimated.into());
    request.wanted.fix = [
        ("full_film_ratio", 0.06 / 0.115),
        ("half_share_speed", 6.0),
        ("viscosity_pole", 273.15 - 64.0),
        ("preload", 13.984),
        ("drag", 3e-4),
        ("reference_temperature", 303.15),
    ]
    .map(|(name, value)| (name.into(), value))
    .into();
    let answer = from_reader(Cursor::new(text), "trace", Some(&frame))
        .and_then(|trace| calibrate(&trace, &design, &request));
    answer
        .map(|found| found.answer)
        .map_err(|failure| format!("{failure:?}"))
}

/// Of an interval of 95 % twice the half width is 1 in 10000.
fn holds(answer: &Calibration, but: &[&str]) {
    for (name, truth) in TRUTH.iter().filter(|(name, _)| !but.contains(name)) {
        let found = answer.parameter(name).unwrap();
        let off = (found.value - truth).abs();
        assert!(!found.fixed && off < 2.0 * found.half_width(), "{found:?}");
    }
}

fn word(answer: &Calibration, word: &str) {
    let told = answer.cannot_tell.join("; ");
    assert!(told.contains(word), "{told}");
}

/// One sample in a thousand of position, torque and load that is lost, or that a line picks up.
#[test]
fn dropouts_and_spikes_change_nothing() {
    let mut trace = measured();
    for sample in (400..trace.time.len() - 10).step_by(1009) {
        trace.nut_position[sample] = 0.0;
        trace.motor_torque[sample + 3] = 0.0;
        trace.axial_load[sample + 6] = 9999.0;
    }
    let answer = said(&trace).unwrap();
    holds(&answer, &[]);
    word(&answer, "column nut_position");
    word(&answer, "column motor_torque");
    word(&answer, "column axial_load");
}

/// The drive is off and the wheel held before the run: its offset is not that of the run.
#[test]
fn a_rest_with_the_drive_off_pulls_nothing() {
    let mut trace = measured();
    let samples = 4000;
    let rough = noise(5, samples, 0.0);
    let first = [
        trace.nut_position[0],
        trace.axial_load[0],
        trace.temperature[0],
    ];
    for time in &mut trace.time {
        *time += 1e-3 * samples as f64;
    }
    let times = (0..samples).map(|sample| 1e-3 * sample as f64);
    trace.time.splice(0..0, times);
    trace.nut_position.splice(0..0, vec![first[0]; samples]);
    let off = rough.iter().map(|noise| 1e-3 * noise);
    trace.motor_torque.splice(0..0, off);
    trace.axial_load.splice(0..0, vec![first[1]; samples]);
    trace.temperature.splice(0..0, vec![first[2]; samples]);
    let answer = said(&trace).unwrap();
    holds(&answer, &[]);
}

/// Steps of 0.2 to 6 breakaway angles: an interval that holds it, or none, and the others hold.
#[test]
fn a_coarse_encoder_tells_no_breakaway_below_its_step() {
    for step in [4e-4, 1.7e-3, 6e-3, 12e-3] {
        let mut trace = measured();
        for angle in &mut trace.nut_position {
            *angle = (*angle / step).round() * step;
        }
        let answer = said(&trace).unwrap();
        let breakaway = answer.parameter("breakaway_angle").unwrap();
        if step > 1e-3 {
            assert!(breakaway.fixed, "{breakaway:?}");
            holds(&answer, &["breakaway_angle"]);
            word(&answer, "too coarse for it");
        } else {
            holds(&answer, &["friction", "inertia", "offset", "gain"]);
        }
    }
}

/// The rig's motion on a motor behind a gear of 1.8.
#[test]
fn a_forgotten_ratio_has_a_word() {
    let mut trace = measured();
    for (angle, torque) in trace.nut_position.iter_mut().zip(&mut trace.motor_torque) {
        *angle *= 1.8;
        *torque /= 1.8;
    }
    let message = said(&trace).unwrap_err();
    assert!(
        message.contains("--ratio (here 1.7") || message.contains("--ratio (here 1.8"),
        "{message}"
    );
}

/// A logger at 2.3 ms, by 4 % more or less each time.
#[test]
fn a_clock_that_runs_free_is_interpolated() {
    let trace = measured();
    let rough = noise(11, trace.time.len(), 0.0);
    let (mut time, mut times) = (0.0, Vec::new());
    for noise in rough {
        if time > trace.time[trace.time.len() - 1] {
            break;
        }
        times.push(time);
        time += 2.3e-3 * (1.0 + 0.04 * noise);
    }
    let at = |values: &[f64]| -> Vec<f64> {
        let place = |time: &f64| {
            let place = time / 1e-3;
            let before = (place as usize).min(values.len() - 2);
            let share = place - before as f64;
            values[before] + share * (values[before + 1] - values[before])
        };
        times.iter().map(place).collect()
    };
    let slow = epas_rig::Trace {
        nut_position: at(&trace.nut_position),
        motor_torque: at(&trace.motor_torque),
        axial_load: at(&trace.axial_load),
        temperature: at(&trace.temperature),
        time: times.clone(),
        ..trace.clone()
    };
    let answer = said(&slow).unwrap();
    holds(&answer, &[]);
    word(&answer, "a logger that runs free");
}

/// A drag run of preloaded screws whose load cell reads noise of 4 N: the gain stays 1 and friction the same in both directions, with a word, and
/// nothing that ended at a bound is an estimate. Preloads lift off at 40 to 2600 N a ball.
#[test]
fn a_drag_run_with_a_load_cell_of_noise() {
    const SAMPLES: usize = 15_000;
    const INERTIA: f64 = 4e-4;
    let [rough, rough_load] = [21, 22].map(|seed| noise(seed, SAMPLES, 0.0));
    for preload in [20, 300, 1300] {
        let text = format!(
            "pitch_radius = 0.0145\nlead = 0.007\nball_radius = 0.002\nconformity = 0.52\n\
             contact_angle = 0.7853981633974483\nfriction = 0.1\npreload = {preload}\nloaded_balls = 71\n"
        );
        let design = read(&text, "preloaded").unwrap();
        let grid = Grid::of(&design.caged, 0.0, Spacing::FINE).unwrap();
        let law = grid.law(&design.caged, (0.1, 0.1)).unwrap();
        let both = DirectionalCoefficient {
            forward: 0.1,
            backward: 0.1,
        };
        let drag = f64::from(law.friction(0.0, both).forward);
        let mut csv = String::from("time,nut_position,motor_torque,axial_load\n");
        for (sample, (noise, load)) in rough.iter().zip(&rough_load).enumerate() {
            let time = 1e-3 * sample as f64;
            let [mut angle, mut speed, mut acceleration] = [0.0; 3];
            for (frequency, size) in [(0.23, 8.0), (0.71, 1.1), (1.9, 0.17)] {
                let turn = TAU * frequency;
                let (sine, cosine) = (turn * time).sin_cos();
                angle += size * sine;
                speed += size * turn * cosine;
                acceleration -= size * turn * turn * sine;
            }
            let angle = (angle / 1.5e-4).round() * 1.5e-4;
            let torque = drag * speed.signum() + INERTIA * acceleration + 0.01 * drag * noise;
            writeln!(csv, "{time:.4},{angle:.9},{torque:.7},{:.3}", 4.0 * load).unwrap();
        }
        let frame = Frame {
            lead: Some(0.007),
            ratio: Some(1.0),
            fastest: Some(2e3),
            rated_torque: None,
        };
        let trace = from_reader(Cursor::new(csv), "trace", Some(&frame)).unwrap();
        let mut request = Request {
            without_models: true,
            ..Request::default()
        };
        request.wanted.fix = [("full_film_ratio", 1.0), ("half_share_speed", 6.0)]
            .map(|(name, value)| (name.into(), value))
            .into();
        let answer = calibrate(&trace, &design, &request).unwrap().answer;
        for (name, value) in [("gain", 1.0), ("direction_asymmetry", 0.0)] {
            let found = answer.parameter(name).unwrap();
            assert!(found.fixed && found.value == value, "{preload}: {found:?}");
        }
        for (name, truth) in [("friction", 0.1), ("inertia", INERTIA)] {
            let found = answer.parameter(name).unwrap();
            let off = (found.value - truth).abs();
            // The grid's own error is some parts in a thousand of the friction.
            let allowed = 2.0 * found.half_width() + 5e-3 * truth;
            assert!(!found.fixed && off < allowed, "{preload}: {found:?}");
        }
        let at_bound = |found: &&Estimate| found.at_bound && !found.fixed;
        assert_eq!(answer.parameters.iter().find(at_bound), None);
        word(&answer, "it never leaves its own noise");
    }
}
