//! Traces that stand still for a while.

use std::f64::consts::TAU;

use super::*;
use crate::fit::toys::noise;
use crate::trace::{Coordinate, Repairs};

const STEP: f64 = 1e-3;

fn trace(position: Vec<f64>, resolution: f64, speed: Option<Vec<f64>>, step: f64) -> Trace {
    Trace {
        name: "drive".into(),
        coordinate: Coordinate::Rotation,
        start: 0.0,
        step,
        effort: vec![0.0; position.len()],
        position,
        resolution,
        position_summed: speed.is_some(),
        speed,
        reference_position: None,
        load: None,
        load_is_effort: false,
        known: None,
        temperature: None,
        repairs: Repairs::default(),
        ignored: Vec::new(),
    }
}

/// Runs of a second at a speed, rests of a second between them; rad.
fn runs(speed: f64) -> Vec<f64> {
    let mut angle = 0.0;
    (0..8000)
        .map(|sample| {
            if sample / 1000 % 2 == 1 {
                angle += speed * STEP;
            }
            angle
        })
        .collect()
}

/// A rest is found to the travel of a step of the sensor at the ends, whether the sensor has steps or noise.
#[test]
fn rests_between_runs_are_found() {
    let step = TAU / 4096.0;
    let exact = runs(2.0);
    let rounded = exact.iter().map(|x| (x / step).round() * step).collect();
    let rough = noise(3, exact.len(), 0.0);
    let noisy = exact.iter().zip(rough).map(|(x, n)| x + 1e-4 * n).collect();
    // A step of 1.5 mrad, and 8 deviations of 0.1 mrad, are passed within a ms at 2 rad/s.
    for (position, resolution) in [(rounded, step), (noisy, 0.0)] {
        let found = rests(&trace(position, resolution, None, STEP));
        assert_eq!(found.len(), 4, "{found:?}");
        for (rest, start) in found.iter().zip([0, 2000, 4000, 6000]) {
            assert!(rest.start.abs_diff(start) <= 2 && rest.end.abs_diff(start + 1000) <= 2);
        }
    }
}

/// A speed that flickers by its step at rest, one sample in 40 ms, and runs a tenth as long as the rests.
#[test]
fn rests_of_a_measured_speed_are_found() {
    let rpm = TAU / 60.0;
    let rough = noise(5, 2000, 0.0);
    let speed: Vec<f64> = rough
        .iter()
        .enumerate()
        .map(|(sample, noise)| match sample % 200 {
            0..100 => 0.0,
            _ => (50.0 + 1.5 * noise).round() * rpm,
        })
        .collect();
    let found = rests(&trace(vec![0.0; 2000], 0.0, Some(speed), 0.04));
    assert_eq!(found.len(), 10);
    assert!(found.iter().all(|rest| rest.len() == 100), "{found:?}");
}

/// Stops of 60 to 250 ms between ramps of 0.1 s, whatever measures the motion; turns of the same ramps are none.
#[test]
fn a_short_rest_between_a_stop_and_a_start_is_found() {
    let step = TAU / 16384.0;
    for stop in [0, 60, 120, 250] {
        let ramp = (0..100).map(|k| f64::from(k) / 100.0);
        let run = ramp.clone().chain(vec![1.0; 500]);
        let run = run.chain(ramp.rev()).chain(vec![0.0; stop]);
        let speed: Vec<f64> = [2.0, -2.0, 5.0, -5.0]
            .iter()
            .flat_map(|top| run.clone().map(move |share| top * share))
            .collect();
        let mut angle = 0.0;
        let position = speed.iter().map(|speed| {
            angle += speed * STEP;
            (angle / step).round() * step
        });
        let position = rests(&trace(position.collect(), step, None, STEP));
        let rounded = speed.iter().map(|x| (x / 0.02).round() * 0.02).collect();
        let speed = rests(&trace(vec![0.0; speed.len()], 0.0, Some(rounded), STEP));
        for found in [position, speed] {
            // At the end of the trace no start is to be seen.
            let wanted = if stop == 0 { 0 } else { 3 };
            assert_eq!(found.len(), wanted, "{stop}: {found:?}");
            for (place, rest) in found.iter().enumerate() {
                let start = 700 + place * (700 + stop);
                // A ramp of 20 rad/s^2 passes a step within 7 ms of its end.
                assert!(rest.start.abs_diff(start) <= 10 && rest.end.abs_diff(start + stop) <= 10);
            }
        }
    }
}

/// Turning points and slow motions are none.
#[test]
fn a_motion_never_rests() {
    let step = TAU / 16384.0 / 2.5;
    let weave: Vec<f64> = (0..20_000)
        .map(|k| 0.6 * (TAU * 0.2 * STEP * f64::from(k)).sin())
        .map(|x| (x / step).round() * step)
        .collect();
    assert!(rests(&trace(weave, step, None, STEP)).is_empty());
    // Ten steps a second.
    let creeping: Vec<f64> = (0..20_000)
        .map(|k| (f64::from(k) / 100.0).floor() * step)
        .collect();
    assert!(rests(&trace(creeping, step, None, STEP)).is_empty());
}

/// A drive that holds a load which changes stays in; one that is off while the load changes does not.
#[test]
fn a_stop_under_a_load_that_the_drive_holds_is_none() {
    let load: Vec<f64> = (0..8000)
        .map(|k| 300.0 * (TAU * 0.4 * STEP * f64::from(k)).sin())
        .collect();
    let mut held = trace(runs(2.0), 1e-3, None, STEP);
    held.effort = load.iter().map(|load| 1e-3 * load + 0.01).collect();
    held.load = Some(load);
    assert!(rests(&held).is_empty());
    held.effort = noise(4, 8000, 0.0);
    assert_eq!(rests(&held).len(), 4);
}
