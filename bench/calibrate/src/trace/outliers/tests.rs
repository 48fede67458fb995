//! Channels with samples that no mechanism makes.

use std::f64::consts::TAU;
use std::fmt::Write as _;
use std::io::Cursor;

use crate::fit::toys::noise;
use crate::trace::Trace;
use crate::trace::columns::from_reader;
use epas_page::failure::Failure;

const SAMPLES: usize = 6000;
const STEP: f64 = TAU / 16384.0;

/// Angle, torque and load of a drive at a time, s: 3 rad at 0.8 Hz, and ripple; reversing friction; a load of 0.3 Hz.
fn drive(time: f64) -> [f64; 3] {
    let angle = 3.0 * (TAU * 0.8 * time).sin() + 0.01 * (TAU * 9.0 * time).sin() + 5.0;
    let torque = 0.05 * (TAU * 0.8 * time).cos().signum() + 0.2;
    [angle, torque, 900.0 * (TAU * 0.3 * time).sin() + 1500.0]
}

/// The drive as sensors show it: steps of the encoder, noise of the others.
fn measured() -> Vec<[f64; 3]> {
    let rough = [noise(1, SAMPLES, 0.3), noise(2, SAMPLES, 0.3)];
    (0..SAMPLES)
        .map(|sample| {
            let [angle, torque, load] = drive(1e-3 * sample as f64);
            let angle = (angle / STEP).round() * STEP;
            [
                angle,
                torque + 2e-3 * rough[0][sample],
                load + 4.0 * rough[1][sample],
            ]
        })
        .collect()
}

fn read(rows: &[[f64; 3]], position: &str) -> Result<Trace, String> {
    let mut text = format!("time,{position},motor_torque,axial_load\n");
    for (sample, [angle, torque, load]) in rows.iter().enumerate() {
        let time = 1e-3 * sample as f64;
        writeln!(text, "{time:.3},{angle:.6},{torque:.6},{load:.3}").unwrap();
    }
    from_reader(Cursor::new(text), "trace", None).map_err(|failure| match failure {
        Failure::Data(message) => message,
        other => format!("{other:?}"),
    })
}

/// Samples of a column, by a number; apart, next to each other, and at the ends.
fn chosen(number: usize) -> Vec<usize> {
    let far = (1..60).map(|k| 97 * k + 13 * number);
    far.chain([0, 1, 3000, 3002, 3003, SAMPLES - 1]).collect()
}

#[test]
fn a_clean_trace_is_left_alone() {
    let trace = read(&measured(), "nut_position").unwrap();
    assert!(trace.repairs.left_out.is_empty());
    // A pulse of the torque, a stuck value and a kick of the load are the drive's own.
    let mut rows = measured();
    for row in &mut rows[2000..2010] {
        row[1] += 0.5;
    }
    let held = rows[4000][1];
    for row in &mut rows[4000..4020] {
        row[1] = held;
    }
    let trace = read(&rows, "nut_position").unwrap();
    assert!(trace.repairs.left_out.is_empty());
}

/// Words that fall to zero, to full scale, or to whatever a line picks up, in every channel: what is put in their place is the
/// drive to the noise of the neighbours.
#[test]
fn dropouts_and_spikes_are_left_out_and_named() {
    for (column, wrong) in [
        (0, 0.0),
        (0, 65.535),
        (1, 0.0),
        (1, 3.0),
        (2, 0.0),
        (2, -8e3),
    ] {
        let mut rows = measured();
        let inner: Vec<usize> = chosen(column)
            .into_iter()
            .filter(|sample| column == 0 || (2..SAMPLES - 2).contains(sample))
            .collect();
        let mut wanted: Vec<usize> = inner.iter().map(|sample| sample + 1).collect();
        for sample in inner {
            rows[sample][column] = wrong;
        }
        let trace = read(&rows, "nut_position").unwrap();
        let [found] = &trace.repairs.left_out[..] else {
            panic!("{:?}", trace.repairs);
        };
        wanted.sort_unstable();
        assert_eq!(found.rows, wanted, "column {column}, {wrong}");
        let channel = [&trace.position, &trace.effort, trace.load.as_ref().unwrap()][column];
        for row in wanted {
            let sample = row - 1;
            let truth = drive(1e-3 * sample as f64)[column];
            // Held at an end for two ticks at 15 rad/s; five deviations of the noise, weighted by at most two.
            let near = [0.04, 0.11, 40.0][column];
            assert!((channel[sample] - truth).abs() < near, "{column} {row}");
        }
    }
}

/// A word that is lost for a third of the samples of a quarter of a second is no noise of the channel.
#[test]
fn lost_words_may_stand_close_together() {
    for column in 0..3 {
        let mut rows = measured();
        let lost: Vec<usize> = (0..250)
            .map(|k| 2900 + k)
            .filter(|sample| sample * sample % 7 == 1)
            .collect();
        for sample in &lost {
            rows[*sample][column] = 0.0;
        }
        let trace = read(&rows, "nut_position").unwrap();
        let [found] = &trace.repairs.left_out[..] else {
            panic!("{:?}", trace.repairs);
        };
        let wanted: Vec<usize> = lost.iter().map(|sample| sample + 1).collect();
        assert_eq!(found.rows, wanted, "column {column}");
    }
}

/// A quarter of the samples of 0.4 s that read anything: what stands off by more than noise, change and travel is left out, though
/// its neighbours are spoiled too.
#[test]
fn random_numbers_may_stand_close_together() {
    for (column, low, high, near) in [
        (0, 0.0, 10.0, 0.03),
        (1, -3.0, 3.0, 0.06),
        (2, -8e3, 8e3, 90.0),
    ] {
        let mut rows = measured();
        let rough = noise(31 + column as u64, 2 * 400, 0.0);
        let mut wrong = 0;
        for (place, row) in rows[2900..3300].iter_mut().enumerate() {
            // Uniform numbers of normal ones.
            let uniform = |value: f64| (1e3 * value).rem_euclid(1.0);
            if uniform(rough[2 * place]) < 0.25 {
                row[column] = low + (high - low) * uniform(rough[2 * place + 1]);
                wrong += 1;
            }
        }
        let trace = read(&rows, "nut_position").unwrap();
        let channel = [&trace.position, &trace.effort, trace.load.as_ref().unwrap()][column];
        let off = (0..SAMPLES).filter(|sample| {
            (channel[*sample] - drive(1e-3 * *sample as f64)[column]).abs() > near
        });
        let left = off.count();
        assert!(
            wrong > 80 && left <= wrong / 8,
            "column {column}: {left} of {wrong}"
        );
    }
}

/// A word that is lost for some ms, of an angle that starts again after a turn.
#[test]
fn a_run_of_an_angle_that_wraps_is_left_out() {
    let mut rows = measured();
    for row in &mut rows {
        row[0] = row[0].rem_euclid(TAU);
    }
    for start in [500, 2600, 4100] {
        for row in &mut rows[start..start + 8] {
            row[0] = 0.0;
        }
    }
    let trace = read(&rows, "nut_position").unwrap();
    assert_eq!(trace.repairs.left_out[0].rows.len(), 24);
    let shift = trace.position[0] - drive(0.0)[0];
    for (sample, found) in trace.position.iter().enumerate() {
        let truth = drive(1e-3 * sample as f64)[0] + shift;
        // A cubic over 9 ms: the fourth derivative of the ripple, 0.01 (2 pi 9)^4, over 24 times 4.5^4 ms^4, and a step.
        assert!(
            (found - truth).abs() < 2e-3,
            "{sample}: {found} for {truth}"
        );
    }
}

#[test]
fn what_is_too_much_or_does_not_come_back_is_refused() {
    let mut rows = measured();
    for row in rows.iter_mut().skip(5).step_by(40) {
        row[0] = 0.0;
    }
    let message = read(&rows, "nut_position").unwrap_err();
    assert!(
        message.starts_with("column nut_position: 1") && message.contains("at most 2 %"),
        "{message}"
    );
    let mut rows = measured();
    for row in &mut rows[3000..] {
        row[0] += 1.5;
    }
    let message = read(&rows, "nut_position").unwrap_err();
    assert!(
        message.contains("it jumps by 1.4") && message.contains("before row 3001"),
        "{message}"
    );
}

/// A torque that peaks for one slow sample as the speed starts is real; one that does not move anything is none.
#[test]
fn a_peak_that_the_motion_answers_to_stays() {
    let rough = noise(9, 2000, 0.0);
    let mut text = String::from("time,motor_speed_rpm,motor_torque_mNm\n");
    for (sample, noise) in rough.iter().enumerate() {
        let speed = f64::from(u8::from(sample % 100 >= 50)) * 50.0;
        let torque = match sample % 100 {
            50 => 9.0,
            51.. => 3.0 + 0.1 * noise,
            _ => 0.1 * noise,
        };
        let torque = if sample % 500 == 80 { 9.0 } else { torque };
        let time = 0.04 * sample as f64;
        writeln!(text, "{time},{speed},{torque}").unwrap();
    }
    let trace = from_reader(Cursor::new(text), "trace", None).unwrap();
    assert_eq!(trace.repairs.left_out.len(), 1);
    assert_eq!(trace.repairs.left_out[0].rows, [81, 581, 1081, 1581]);
}
