//! Spoiled traces: a word each, and never a confident wrong number.

use std::io::Cursor;

use epas_rig::course::Course;
use epas_rig::parameters::Parameters;
use epas_rig::spoiled::Spoiling;
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

/// What is said to each: a part of the sentence with which it is refused, or of what is told beside the answer.
const fn word(spoiling: Spoiling) -> (bool, &'static str) {
    match spoiling {
        Spoiling::ClippedTorque => (false, "clipped"),
        Spoiling::WrongUnits => (false, "degrees"),
        Spoiling::WrongSign => (false, "turn the sign of the effort"),
        Spoiling::WrongLoadSign => (false, "turn the sign of the load"),
        Spoiling::ShiftedClock => (false, "shift the channels to one clock"),
        Spoiling::ClockGoesBack => (false, "time goes back"),
        Spoiling::NotANumber => (true, "interpolated linearly"),
        Spoiling::Gap => (false, "a gap of"),
        Spoiling::DeadAngle => (false, "never moves"),
        Spoiling::DeadLoad => (false, "nothing presses the balls"),
        Spoiling::DroppedSamples => (true, "missing samples"),
    }
}

#[test]
fn spoiled_traces_are_refused_or_told() {
    let rig = Rig::new(Parameters::default(), Sensors::default()).unwrap();
    let course = Course::vehicle().times(0.3);
    let trace = rig.run(&course, 3).unwrap();
    for spoiling in Spoiling::ALL {
        let (answered, word) = word(spoiling);
        let (is_answer, text) = match said(&trace.clone().spoiled(spoiling)) {
            Ok(answer) => {
                // Samples that are missing do not move the friction out of its interval.
                let friction = answer.parameter("friction").unwrap();
                assert!(
                    friction.low < 0.115 && 0.115 < friction.high,
                    "{friction:?}"
                );
                (true, answer.cannot_tell.join("; "))
            }
            Err(refusal) => (false, refusal),
        };
        assert_eq!(is_answer, answered, "{spoiling:?}: {text}");
        assert!(text.contains(word), "{spoiling:?}: {text}");
    }
}
