//! Tests of reading a trace.

use std::f64::consts::{PI, TAU};
use std::fmt::Write;
use std::io::Cursor;

use crate::fit::toys::noise;
use crate::trace::columns::{Frame, from_reader};
use crate::trace::{Coordinate, Repairs, Trace};
use epas_page::failure::Failure;

const FRAME: Frame = Frame {
    lead: 7e-3,
    ratio: 2.5,
    fastest: 300.0,
};

fn read(text: &str, frame: Option<&Frame>) -> Result<Trace, String> {
    from_reader(Cursor::new(text.as_bytes()), "trace", frame).map_err(|failure| match failure {
        Failure::Data(message) => message,
        other => format!("{other:?}"),
    })
}

/// A table of so many samples a millisecond apart, with a line of each.
fn table(header: &str, samples: usize, line: impl Fn(f64) -> String) -> String {
    let mut text = format!("{header}\n");
    for sample in 0..samples {
        let time = 1e-3 * sample as f64;
        writeln!(text, "{}", line(time)).unwrap();
    }
    text
}

/// An angle of two turns to and fro, rad.
fn angle(time: f64) -> f64 {
    12.0 * (TAU * time / 0.4).sin()
}

fn close(found: &[f64], wanted: impl Fn(f64) -> f64, tolerance: f64) {
    for (sample, found) in found.iter().enumerate() {
        let wanted = wanted(1e-3 * sample as f64);
        assert!(
            (found - wanted).abs() < tolerance,
            "sample {sample}: {found} for {wanted}"
        );
    }
}

/// A motion in degrees whose name says no unit is far too fast for the design; one that says it is not, nor one of another unit at the limit.
#[test]
fn an_angle_in_degrees_is_asked_for() {
    let of = |header: &str, value: fn(f64) -> f64| {
        let text = table(header, 800, |time| format!("{time},0.1,{}", value(time)));
        read(&text, Some(&FRAME))
    };
    for (header, words) in [
        (
            "time,motor_torque,nut_position",
            "is the column in degrees? Then its name is nut_position [deg]",
        ),
        (
            "time,motor_torque,position",
            "behind a gear (--ratio)? Then its name is position [deg]",
        ),
    ] {
        let message = of(header, |time| angle(time).to_degrees()).unwrap_err();
        assert!(message.contains(words), "{message}");
        assert!(
            message.contains("nut_speed in [limits] is 300"),
            "{message}"
        );
        of(header, angle).unwrap();
    }
    of("time,motor_torque,nut_position_deg", |time| {
        angle(time).to_degrees()
    })
    .unwrap();
    let message = of("time,motor_torque,nut_speed", |_| 700.0).unwrap_err();
    assert!(
        message.contains("nut_speed [rpm] or nut_speed [deg/s]"),
        "{message}"
    );
    of("time,motor_torque,nut_speed_rpm", |_| 700.0).unwrap();
}

#[test]
fn units_and_order_of_columns_do_not_matter() {
    let text = table(
        "axial_load_kN,motor_torque_mNm,gear,nut_position_deg,time_ms,temperature_C,reference_position",
        400,
        |time| {
            format!(
                "{},{},3,{},{},21.5,{}",
                2.0 * time,
                500.0 * time,
                angle(time) * 180.0 / PI,
                1e3 * time,
                angle(time) + 0.25,
            )
        },
    );
    let trace = read(&text, None).unwrap();
    assert_eq!(trace.coordinate, Coordinate::Rotation);
    assert_eq!(trace.ignored, ["gear"]);
    assert_eq!(trace.repairs, Repairs::default());
    assert!((trace.step - 1e-3).abs() < 1e-12 && trace.start.abs() < 1e-12);
    close(&trace.position, angle, 1e-12);
    close(&trace.effort, |time| 0.5 * time, 1e-12);
    close(trace.load.as_ref().unwrap(), |time| 2e3 * time, 1e-9);
    close(trace.temperature.as_ref().unwrap(), |_| 294.65, 1e-9);
    let reference = trace.reference_position.as_ref().unwrap();
    close(reference, |time| angle(time) + 0.25, 1e-12);
    assert_eq!(trace.speed, None);
}

#[test]
fn a_design_refers_motor_and_carriage_to_the_nut() {
    let motor = table("time,motor_position,motor_torque", 400, |time| {
        format!("{time},{},{}", 2.5 * angle(time), 0.2 * time)
    });
    let carriage = table("time,position,motor_force", 400, |time| {
        format!(
            "{time},{},{}",
            angle(time) * 7e-3 / TAU,
            0.5 * time * TAU / 7e-3
        )
    });
    for text in [motor, carriage] {
        let trace = read(&text, Some(&FRAME)).unwrap();
        assert_eq!(trace.coordinate, Coordinate::Rotation);
        close(&trace.position, angle, 1e-12);
        close(&trace.effort, |time| 0.5 * time, 1e-12);
    }
}

#[test]
fn a_motors_angle_that_wraps_is_joined() {
    let text = table("time,motor_position,motor_torque", 400, |time| {
        format!("{time},{},1", (2.5 * angle(time)).rem_euclid(TAU))
    });
    let trace = read(&text, Some(&FRAME)).unwrap();
    close(&trace.position, angle, 1e-12);
}

#[test]
fn only_a_speed_is_summed_up() {
    let text = table("time,carriage_speed_mm_s,motor_force", 400, |time| {
        format!("{time},{},1", 1e3 * (TAU * time / 0.4).cos())
    });
    let trace = read(&text, None).unwrap();
    assert_eq!(trace.coordinate, Coordinate::Translation);
    assert!(trace.position_summed);
    // A trapezoid's error: its step squared over 12 times the change of the slope, 31 m/s^2.
    close(
        &trace.position,
        |time| (TAU * time / 0.4).sin() * 0.4 / TAU,
        3e-6,
    );
    close(
        trace.speed.as_ref().unwrap(),
        |time| (TAU * time / 0.4).cos(),
        1e-12,
    );
}

/// A table with lines left out, put in twice or moved in time.
fn disturbed(change: impl Fn(usize, f64) -> Vec<f64>) -> String {
    let mut text = String::from("time,position,motor_force\n");
    for sample in 0..1000 {
        for time in change(sample, 1e-3 * sample as f64) {
            writeln!(text, "{time},{},1", angle(time)).unwrap();
        }
    }
    text
}

#[test]
fn gaps_jitter_and_repeats_are_repaired_and_counted() {
    let gap = |sample: usize, time: f64| {
        if (500..504).contains(&sample) {
            vec![]
        } else {
            vec![time]
        }
    };
    let trace = read(&disturbed(gap), None).unwrap();
    assert_eq!(trace.repairs.missing, 4);
    assert_eq!(trace.len(), 1000);
    // A cubic through times at 0, 1, 6 and 7 ms: the fourth derivative, 12 (TAU/0.4)^4 = 7.3e5 rad/s^4, over 24 times
    // (2.5 ms 3.5 ms)^2.
    close(&trace.position, angle, 7.4e5 / 24.0 * 7.7e-11);

    let jitter =
        |sample: usize, time: f64| vec![time + if sample % 100 == 50 { 3e-4 } else { 0.0 }];
    let trace = read(&disturbed(jitter), None).unwrap();
    // The tick before the sample is interpolated; the sample itself stands nowhere else.
    assert_eq!(trace.repairs.jittered, 10);
    assert_eq!(trace.repairs.missing, 0);
    close(&trace.position, angle, 7.4e5 / 24.0 * 4e-12);

    // Jitter of 0.23 ticks (root mean square) of every sample: some neighbours stand closer than half a tick.
    let rough = |sample: usize, time: f64| vec![time + 4e-4 * (sample as f64 * 2.1).sin()];
    let trace = read(&disturbed(rough), None).unwrap();
    assert!((trace.repairs.jittered + trace.repairs.missing).abs_diff(850) < 100);
    assert!((trace.step * 1e3 - 1.0).abs() < 1e-3 && trace.len().abs_diff(1000) <= 1);
    let exact = |time: f64| angle(time * trace.step * 1e3 + trace.start);
    // A line over at most 1.8 ms, where samples stand too close for a cubic: 12 (TAU/0.4)^2 = 2960 rad/s^2 over 8 times that
    // squared.
    close(&trace.position, exact, 2960.0 / 8.0 * 3.3e-6);

    let repeat = |sample: usize, time: f64| vec![time; if sample % 100 == 50 { 2 } else { 1 }];
    let trace = read(&disturbed(repeat), None).unwrap();
    assert_eq!(trace.repairs.repeated, 10);
    close(&trace.position, angle, 1e-12);

    // A rate that the digits of the time do not hold: 1.5 kHz with four digits.
    let mut text = String::from("time,position,motor_force\n");
    for sample in 0..3000 {
        let time = f64::from(sample) / 1500.0;
        writeln!(text, "{time:.4},{},1", angle(time)).unwrap();
    }
    let trace = read(&text, None).unwrap();
    assert_eq!(
        (trace.repairs.clone(), trace.len()),
        (Repairs::default(), 3000)
    );
    assert!((trace.step * 1500.0 - 1.0).abs() < 1e-4);
}

/// Distances of 5 % more or less, each by itself, and three samples that are missing.
#[test]
fn a_clock_that_runs_free_is_interpolated_at_its_own_times() {
    let rough = noise(3, 3000, 0.0);
    let (mut time, mut text) = (0.0, String::from("time,position,motor_force\n"));
    for (sample, rough) in rough.iter().enumerate() {
        if !(800..803).contains(&sample) {
            writeln!(text, "{time},{},1", angle(time)).unwrap();
        }
        time += 1e-3 * (1.0 + 0.05 * rough);
    }
    let trace = read(&text, None).unwrap();
    assert_eq!(trace.repairs.free_running, trace.len());
    assert_eq!(trace.repairs.missing, 3);
    assert!((trace.step * 1e3 - 1.0).abs() < 0.01, "{}", trace.step);
    let exact = |time: f64| angle(time * trace.step * 1e3);
    // At 190 rad/s, a thousandth of a tick beside a sample counts as on it.
    close(&trace.position, exact, 190.0 * 1e-6);
}

#[test]
fn a_clock_that_is_none_is_refused() {
    let long = |sample: usize, time: f64| vec![time + if sample >= 500 { 0.1 } else { 0.0 }];
    let many = |sample: usize, time: f64| {
        if sample > 0 && sample.is_multiple_of(20) {
            vec![]
        } else {
            vec![time]
        }
    };
    let twice =
        |sample: usize, time: f64| vec![time; if sample.is_multiple_of(10) { 2 } else { 1 }];
    let wild = |sample: usize, time: f64| vec![time + [4.5e-4, -4.5e-4][sample % 2]];
    for (text, word) in [
        (disturbed(long), "a gap of 0.1010 s"),
        (disturbed(many), "are missing"),
        (disturbed(twice), "time of the one before"),
        (disturbed(wild), "no even tick"),
    ] {
        let message = read(&text, None).map(|trace| trace.repairs).unwrap_err();
        assert!(message.contains(word), "{message}");
    }
}

#[test]
fn every_fault_has_a_word() {
    let sample = |header: &str, line: &str| {
        let text = table(header, 200, |time| line.replace('t', &time.to_string()));
        read(&text, None).unwrap_err()
    };
    for (header, line, word) in [
        ("time,position", "t,1", "motor_torque or motor_force"),
        ("time,motor_force", "t,1", "position or speed"),
        ("position,motor_force", "1,1", "time is missing"),
        ("time|position|motor_force", "t|1|1", "separated by bars"),
        (
            "time,position,position,motor_force",
            "t,1,1,1",
            "same quantity",
        ),
        (
            "time,axial_load,rack_force,position,motor_force",
            "t,1,1,1,1",
            "same quantity",
        ),
        (
            "time,position,motor_force,motor_torque",
            "t,1,1,1",
            "give the effort once",
        ),
        ("time,nut_position_counts,motor_torque", "t,1,1", "counts"),
        ("time,position_inch,motor_force", "t,1,1", "position_mm"),
        ("time,nut_position,motor_force", "t,1,1", "need a design"),
        (
            "time,carriage_position,motor_torque",
            "t,1,1",
            "need a design",
        ),
        ("time,position_mm,motor_torque", "t,1,1", "need a design"),
        (
            "time,position,motor_force,temperature",
            "t,1,1,20",
            "temperature_C",
        ),
        (
            "time,position,motor_force",
            "t,NaN,1",
            "column position: it has fewer than two numbers",
        ),
        ("time,position,motor_force", "t,-inf,1", "is not finite"),
        ("time,position,motor_force", "t,-,1", "is no number"),
        ("time,position,motor_force", "t,1e39,1", "float32"),
        ("time,position,motor_force", "t,1", "line 2: 2 columns"),
        (
            "time,position,motor_force",
            "-t,1,1",
            "line 3: time goes back",
        ),
        ("time_ns,position,motor_force", "t,1,1", "is too short"),
    ] {
        let message = sample(header, line);
        assert!(message.contains(word), "{header}: {message}");
    }
    let slow = table("time,position,motor_force", 200, |time| {
        format!("{},0,1", 1e3 * time)
    });
    assert!(read(&slow, None).unwrap_err().contains("time_ms"));
    assert!(read("", None).unwrap_err().contains("empty"));
    assert!(
        read("time,position,motor_force\n", None)
            .unwrap_err()
            .contains("too few")
    );
    let late = "time,position,motor_force\n0,1,1\n\n\n1,1,x\n";
    assert!(
        read(late, None)
            .unwrap_err()
            .starts_with("line 5: motor_force")
    );
}

/// Seeds of the fuzz target, and what was said of each.
const SEEDS: [&str; 4] = [
    include_str!("../../../../fuzz/corpus/calibration/nut"),
    include_str!("../../../../fuzz/corpus/calibration/carriage"),
    include_str!("../../../../fuzz/corpus/calibration/wraps"),
    include_str!("../../../../fuzz/corpus/calibration/jitter"),
];

#[test]
fn seeds_are_read_and_their_ruins_do_no_harm() {
    for seed in SEEDS {
        assert!(read(seed, Some(&FRAME)).is_ok());
    }
    let mut random = 1u32;
    let mut next = |below: usize| {
        random = random.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (random >> 8) as usize % below
    };
    for round in 0..400 {
        let mut text = SEEDS[round % 4].as_bytes().to_vec();
        for _ in 0..=next(4) {
            let place = next(text.len());
            match next(3) {
                0 => text[place] = b"0123456789.,-e\n\"x_"[next(18)],
                1 => text.truncate(place + 1),
                _ => {
                    let end = (place + next(40)).min(text.len());
                    text.drain(place..end);
                }
            }
            if text.is_empty() {
                text.push(b't');
            }
        }
        // Read or refused, and no panic.
        let _ = crate::accepts(&text);
    }
}

/// An encoder of 14 bits whose angle is in degrees without a word, and the same in radians.
#[test]
fn steps_of_a_degree_are_no_radians() {
    let file = |name: &str, turn: f64| {
        let step = turn / 16384.0;
        let mut text = format!("time,{name},motor_torque\n");
        for sample in 0..2000 {
            let time = 1e-3 * f64::from(sample);
            let angle = 0.4 * turn * (4.0 * time).sin();
            let angle = (angle / step).round() * step;
            writeln!(text, "{time:.3},{angle:.6},{:.4}", (7.0 * time).sin()).unwrap();
        }
        from_reader(Cursor::new(text), "trace", None)
    };
    let Err(Failure::Data(message)) = file("nut_position", 360.0) else {
        panic!("degrees are taken for radians");
    };
    assert!(
        message.contains("steps of 360/2^14") && message.contains("nut_position_deg"),
        "{message}"
    );
    file("nut_position_rad", 360.0).unwrap();
    file("nut_position_deg", 360.0).unwrap();
    file("nut_position", TAU).unwrap();
}
