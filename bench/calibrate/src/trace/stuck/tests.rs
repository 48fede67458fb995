//! Channels that stay at one number for a while.

use std::f64::consts::TAU;

use super::*;
use crate::fit::toys::noise;
use epas_traces::units::Part;

const SAMPLES: usize = 6000;

/// A weave of 3 rad, its friction, and a load, with the noise of sensors; a stretch of one of them is another one.
fn table(changed: usize, stretch: Range<usize>, other: impl Fn(f64) -> f64) -> Table {
    let rough = noise(3, 3 * SAMPLES, 0.0);
    let times: Vec<f64> = (0..SAMPLES).map(|sample| 1e-3 * sample as f64).collect();
    let of = |place: usize, value: &dyn Fn(f64) -> f64, noise: f64| -> Vec<f64> {
        let own = &rough[place * SAMPLES..];
        let exact = times.iter().zip(own);
        let mut values: Vec<f64> = exact
            .map(|(time, rough)| value(*time) + noise * rough)
            .collect();
        if place == changed {
            let first = values[stretch.start];
            values[stretch.clone()].fill(other(first));
        }
        values
    };
    let angle = of(0, &|time| 3.0 * (TAU * 0.8 * time).sin(), 1e-4);
    let torque = of(
        1,
        &|time| 0.05 * (TAU * 0.8 * time).cos().signum() + 0.2,
        2e-3,
    );
    let load = of(2, &|time| 900.0 * (TAU * 0.3 * time).sin() + 1500.0, 4.0);
    let columns = vec![
        Column::si("nut_position", Quantity::Position(Part::Nut), angle),
        Column::si("motor_torque", Quantity::MotorTorque, torque),
        Column::si("axial_load", Quantity::Load, load),
    ];
    Table::of(times, columns).unwrap()
}

#[test]
fn a_channel_that_is_lost_while_the_mechanism_moves_is_left_out() {
    for (place, name) in [(1, "motor_torque"), (2, "axial_load")] {
        for other in [|_| 0.0, |last: f64| last] {
            let mut lost = table(place, 2000..2050, other);
            assert_eq!(clean(&mut lost).unwrap().first(), Some(&(2000..2050)));
            let [note] = &lost.notes[..] else {
                panic!("{:?}", lost.notes);
            };
            assert!(
                note.starts_with(&format!("column {name}: it stays at "))
                    && note.contains("from row 2001 to 2050"),
                "{note}"
            );
            let values = &lost.columns[place].values;
            let middle = 0.5 * (values[1999] + values[2050]);
            assert!(
                (values[2024] - middle).abs() < 0.02 * (values[1999] - values[2050]).abs() + 1e-9
            );
            // More than a fiftieth of the trace.
            let message = clean(&mut table(place, 2000..2200, other)).unwrap_err();
            assert!(
                message.contains("from row 2001 to 2200") && message.contains("more than 2 %"),
                "{message}"
            );
        }
    }
    assert!(clean(&mut table(0, 0..0, |last| last)).unwrap().is_empty());
}

/// A torque at its limit, one of a drive that is off until the nut stops, and one that repeats by itself are measurements.
#[test]
fn an_effort_that_stays_for_a_reason_is_none() {
    let kept = |table: &mut Table| assert!(clean(table).unwrap().is_empty());
    let mut clipped = table(1, 0..0, |last| last);
    for value in &mut clipped.columns[1].values {
        *value = value.min(0.246);
    }
    kept(&mut clipped);
    kept(&mut table(1, 5000..SAMPLES, |_| 0.0));
    let mut coarse = table(1, 0..0, |last| last);
    for value in &mut coarse.columns[1].values {
        *value = (*value / 0.05).round() * 0.05;
    }
    kept(&mut coarse);
}

/// A speed in steps of a revolution a minute, of ramps of 0.1 s: at zero for 20 ms it is lost, at a constant speed
/// it is not, nor where it goes to and fro by a step.
#[test]
fn a_speed_that_is_lost_is_left_out() {
    let ramp = (0..100).map(|k| 0.5 * f64::from(k));
    let run = ramp.clone().chain(vec![50.0; 500]).chain(ramp.rev());
    let mut speed: Vec<f64> = run.clone().chain(run.map(|speed| -speed)).collect();
    for value in &mut speed {
        *value = value.round() * TAU / 60.0;
    }
    let table = |speed: &[f64]| {
        let times = (0..speed.len()).map(|sample| 1e-3 * sample as f64);
        let column = Column::si("motor_speed", Quantity::Speed(Part::Motor), speed.to_vec());
        Table::of(times.collect(), vec![column]).unwrap()
    };
    assert!(clean(&mut table(&speed)).unwrap().is_empty());
    let exact = speed.clone();
    speed[300..320].fill(0.0);
    let mut lost = table(&speed);
    assert_eq!(clean(&mut lost).unwrap().first(), Some(&(300..320)));
    assert_eq!(lost.columns[0].values, exact);
    // Held at what it was, while it falls.
    let mut held = exact.clone();
    let at = held[620];
    held[621..640].fill(at);
    let mut lost = table(&held);
    assert_eq!(clean(&mut lost).unwrap().first(), Some(&(619..640)));
    let off = lost.columns[0].values.iter().zip(&exact);
    // A step of the sensor.
    assert!(off.into_iter().all(|(a, b)| (a - b).abs() < 0.11));
    let slow = (0..6000).map(|sample| (5.0 * (3e-3 * f64::from(sample)).sin()).round());
    let slow: Vec<f64> = slow.collect();
    assert!(clean(&mut table(&slow)).unwrap().is_empty());
}
