//! Spoiled traces: a word each, and never a confident wrong number.

use std::io::Cursor;

use epas_rig::course::Course;
use epas_rig::parameters::Parameters;
use epas_rig::{Rig, Sensors};

use super::{Request, calibrate};
use crate::answer::Calibration;
use crate::trace::columns::{Frame, from_reader};
use epas_design::files::DesignSource;

/// What a calibration says to a trace: an answer, or the word with which it refuses.
fn said(trace: &epas_rig::Trace) -> Result<Calibration, String> {
    let design = "lin-4.1".parse::<DesignSource>().unwrap().load().unwrap();
    let frame = Frame::of(&design, None);
    let mut text = Vec::new();
    trace.write_csv(&mut text).unwrap();
    let request = Request {
        without_models: true,
        ..Request::default()
    };
    from_reader(Cursor::new(text), "spoiled", Some(&frame))
        .map_err(|failure| format!("{failure:?}"))
        .and_then(|trace| {
            calibrate(&trace, &design, &request)
                .map(|found| found.answer)
                .map_err(|failure| format!("{failure:?}"))
        })
}

/// Keeps only these samples of the measured columns.
fn keep(trace: &mut epas_rig::Trace, wanted: impl Fn(usize) -> bool) {
    for column in [
        &mut trace.time,
        &mut trace.nut_position,
        &mut trace.motor_torque,
        &mut trace.axial_load,
        &mut trace.temperature,
    ] {
        let mut samples = 0..;
        column.retain(|_| wanted(samples.next().unwrap_or(0)));
    }
}

/// What is wrong with a trace, whether it is answered, and a part of the sentence with which it is refused, or of what is told beside the
/// answer.
type Spoiled = (fn(&mut epas_rig::Trace), bool, &'static str);

const SPOILED: [Spoiled; 11] = [
    (
        // The motor's channel ends at half of its largest torque.
        |trace| {
            let torques = &mut trace.motor_torque;
            let largest = torques.iter().fold(0.0_f64, |most, at| most.max(at.abs()));
            for torque in torques {
                *torque = torque.clamp(-0.5 * largest, 0.5 * largest);
            }
        },
        false,
        "clipped",
    ),
    (
        |trace| {
            trace
                .nut_position
                .iter_mut()
                .for_each(|angle| *angle = angle.to_degrees());
        },
        false,
        "degrees",
    ),
    (
        |trace| {
            trace
                .motor_torque
                .iter_mut()
                .for_each(|torque| *torque = -*torque);
        },
        false,
        "turn the sign of motor_torque",
    ),
    (
        |trace| trace.axial_load.iter_mut().for_each(|load| *load = -*load),
        false,
        "turn the sign of axial_load",
    ),
    (
        // The torque comes 25 ms late.
        |trace| trace.motor_torque.rotate_right(25),
        false,
        "shift the channels to one clock",
    ),
    (
        |trace| {
            let middle = trace.len() / 2;
            trace.time[middle..]
                .iter_mut()
                .for_each(|time| *time -= 0.5);
        },
        false,
        "time goes back",
    ),
    (
        |trace| {
            let quarter = trace.len() / 4;
            for sample in [quarter, 2 * quarter, 3 * quarter] {
                trace.motor_torque[sample] = f64::NAN;
            }
        },
        true,
        "interpolated linearly",
    ),
    (
        |trace| keep(trace, |sample| sample % 100 != 50),
        true,
        "missing samples",
    ),
    (
        |trace| {
            let gap = trace.len() / 2..trace.len() / 2 + 1000;
            keep(trace, |sample| !gap.contains(&sample));
        },
        false,
        "a gap of",
    ),
    (|trace| trace.nut_position.fill(0.0), false, "never moves"),
    (
        |trace| trace.axial_load.fill(0.0),
        false,
        "nothing presses the balls",
    ),
];

#[test]
fn spoiled_traces_are_refused_or_told() {
    let rig = Rig::new(Parameters::default(), Sensors::default()).unwrap();
    let course = Course::vehicle().times(0.3);
    let trace = rig.run(&course, 3).unwrap();
    let mut wrong = Vec::new();
    for (spoil, answered, word) in SPOILED {
        let mut spoiled = trace.clone();
        spoil(&mut spoiled);
        let (is_answer, text) = match said(&spoiled) {
            Ok(answer) => {
                // Samples that are missing do not move the friction out of its interval.
                let friction = answer.parameter("friction").unwrap();
                let held = friction.low < 0.115 && 0.115 < friction.high;
                assert!(held, "{friction:?}");
                (true, answer.cannot_tell.join("; "))
            }
            Err(refusal) => (false, refusal),
        };
        if is_answer != answered || !text.contains(word) {
            wrong.push(format!("{word}: {text}"));
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}
