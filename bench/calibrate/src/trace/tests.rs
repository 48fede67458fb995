//! Traces as people have them: read, marked or refused.

use std::f64::consts::TAU;
use std::io::Cursor;

use epas_page::failure::Failure;
use epas_traces::marks::Fault;

use super::columns::{Frame, from_reader};
use super::{Coordinate, Trace};

const GEAR: Frame = Frame { lead: Some(7e-3), ratio: Some(2.5), fastest: Some(300.0), rated_torque: None };

fn read_bytes(text: &[u8], frame: &Frame) -> Result<Trace, String> {
    from_reader(Cursor::new(text), "trace", Some(frame)).map_err(|failure| match failure {
        Failure::Data(message) => message,
        other => format!("{other:?}"),
    })
}

fn read(text: &str) -> Result<Trace, String> {
    read_bytes(text.as_bytes(), &Frame::default())
}

fn refused(text: &str) -> String {
    read(text).map(|trace| trace.name).unwrap_err()
}

/// A table of lines at times, s.
fn table(header: &str, times: impl IntoIterator<Item = f64>, line: impl Fn(f64) -> String) -> String {
    let lines = times.into_iter().map(|time| line(time) + "\n");
    std::iter::once(format!("{header}\n")).chain(lines).collect()
}

fn ticks(samples: usize) -> impl Iterator<Item = f64> {
    (0..samples).map(|sample| 1e-3 * sample as f64)
}

/// An angle of two turns to and fro, rad.
fn angle(time: f64) -> f64 {
    12.0 * (TAU * time / 0.4).sin()
}

/// Sums of twelve uniform numbers: white noise of a deviation of 1.
fn noise(seed: u64, samples: usize) -> Vec<f64> {
    let mut state = seed;
    let mut uniform = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1u64 << 53) as f64
    };
    (0..samples).map(|_| (0..12).map(|_| uniform()).sum::<f64>() - 6.0).collect()
}

fn close(found: &[f64], wanted: impl Fn(f64) -> f64, tolerance: f64) {
    for (sample, found) in found.iter().enumerate() {
        let wanted = wanted(1e-3 * sample as f64);
        assert!((found - wanted).abs() <= tolerance, "sample {sample}: {found} for {wanted}");
    }
}

fn units_of(text: &str, unit: fn(u16) -> [u8; 2]) -> Vec<u8> {
    let letters = std::iter::once(0xfeff).chain(text.encode_utf16());
    letters.flat_map(unit).collect()
}

/// Exports of recorders, measuring tools with German numbers, libraries and shells hold the same trace.
#[test]
fn files_of_recorders_are_read() {
    let speed = |time: f64| (90.0 + 40.0 * (9.0 * time).sin()).to_radians();
    let torque = |time: f64| 0.25 * (9.0 * time).cos();
    // Above the numbers; separator, decimal sign; units of time, speed and torque.
    for (above, separator, decimal, units) in [
        ("Recorder 3.7\nAxis: 1, \"left\n\nTime [s];Motor speed;Motor torque\ns;deg/sec;Nm\n", ";", ",", [1.0, 1.0, 1.0]),
        ("record\t7\ntime\tmotor_speed\tmotor_torque\ns\tdeg/s\tN m\n", "\t", ".", [1.0, 1.0, 1.0]),
        ("\"timestamps\",\"motor_speed\",\"motor_torque\"\n\"s\",\"deg/sec\",\"\"\n", ",", ".", [1.0, 1.0, 1.0]),
        ("time,motor_speed_deg_s,motor_torque\n[s],-,[Nm]\n", ",", ".", [1.0, 1.0, 1.0]),
        ("time,Motor speed (deg/sec),motor_torque_mNm\n", ",", ".", [1.0, 1.0, 1e-3]),
        // A motion controller's: the time has no name, the torque is a share of 0.8 N m.
        ("Date:;2026-01-01\nScale:;0;True;20.0\n;Velocity actual value averaged;Torque actual value averaged\nms;rpm;%\n", ";", ".", [1e-3, 6.0, 8e-3]),
        ("\tTorque actual value\tVelocity actual value\nms\tNm\trpm\n", "\t", ".", [1e-3, 6.0, 1.0]),
    ] {
        let exchanged = above.contains("\tTorque");
        let line = |time: f64| {
            let mut values = [time / units[0], speed(time).to_degrees() / units[1], torque(time) / units[2]];
            if exchanged {
                values.swap(1, 2);
            }
            values.map(|value| format!("{value:.9}").replace('.', decimal)).join(separator)
        };
        let text = table(above.trim_end(), ticks(400), line);
        let mut latin = text.clone().into_bytes();
        if let Some(place) = text.find(";deg/sec;") {
            latin.splice(place + 1..place + 4, *b"\xb0");
        }
        let rated = Frame { rated_torque: Some(0.8), ..Frame::default() };
        for bytes in [text.clone().into_bytes(), latin, units_of(&text, u16::to_le_bytes), units_of(&text, u16::to_be_bytes)] {
            let trace = read_bytes(&bytes, &rated).unwrap_or_else(|message| panic!("{above}: {message}"));
            assert_eq!((trace.len(), trace.repairs.clone()), (400, super::Repairs::default()), "{above}");
            close(trace.speed.as_ref().unwrap(), speed, 1e-9);
            close(&trace.effort, torque, 1e-9);
        }
        let refused = read(&text).err();
        assert_eq!(refused.is_some(), units[2] == 8e-3);
        assert!(refused.is_none_or(|message| { message.contains("which the file does not say: calibrate --rated-torque") }));
    }
}

/// Units, wraps, a design's lead and a ratio refer every column to one coordinate.
#[test]
fn columns_are_referred_to_one_coordinate() {
    let ratio = Frame { ratio: Some(2.5), ..Frame::default() };
    let mm = 1e3 * 7e-3 / TAU;
    let motor = "time,motor_position,motor_torque,load_torque";
    let nut = "time_ms,nut_position_deg,motor_torque_mNm,axial_load_kN,temperature_C,gear";
    // Header, frame, scale of position, effort and load in the file; the load's unit, what lacks a ratio.
    for (header, frame, scales, load, lacking) in [
        (motor, Frame::default(), [1.0, 1.0, 1.0], 1.0, Some(["motor_position", "load_torque"])),
        (motor, ratio, [2.5, 0.4, 1.0], 1.0, None),
        (motor, GEAR, [2.5, 0.4, 1.0], TAU / 7e-3, None),
        (nut, Frame::default(), [1f64.to_degrees(), 1e3, 1e-3], 1.0, Some(["nut_position_deg", "motor_torque_mNm"])),
        (nut, ratio, [1f64.to_degrees(), 400.0, 1e-3], 1.0, None),
        ("time,position,motor_torque", GEAR, [1.0, 0.4, 1.0], 1.0, None),
        ("time,position_mm,motor_force", GEAR, [mm, 1e3 / mm, 1.0], 1.0, None),
        ("time,position,motor_force,rack_force", Frame::default(), [1.0, 1.0, 1.0], 1.0, None),
    ] {
        for wrap in [false, header.contains("position,motor_torque")] {
            let line = |time: f64| {
                let mut position = scales[0] * (angle(time) + 0.25);
                if wrap {
                    position = position.rem_euclid(TAU);
                }
                let (effort, load) = (0.5 * time * scales[1], 3.0 * time * scales[2]);
                let more = if header == nut { ",21.5,3" } else { "" };
                let time = if header == nut { 1e3 * time } else { time };
                let columns = header.split(',').count();
                let cells: Vec<String> = [time, position, effort, load].map(|x| x.to_string()).into();
                cells[..columns.min(4)].join(",") + more
            };
            let text = table(header, ticks(400), line);
            let trace = read_bytes(text.as_bytes(), &frame).unwrap_or_else(|message| panic!("{header}: {message}"));
            let shift = ((trace.position[0] - 0.25) / (TAU / scales[0])).round() * TAU / scales[0];
            assert!(wrap || shift == 0.0);
            close(&trace.position, |time| angle(time) + 0.25 + shift, 1e-11);
            close(&trace.effort, |time| 0.5 * time, 1e-12);
            if let Some(found) = &trace.load {
                close(found, |time| 3.0 * load * time, 1e-9);
            }
            let turns = header.contains("torque") || frame.lead.is_some();
            assert_eq!(trace.coordinate == Coordinate::Rotation, turns);
            assert_eq!(trace.origins.without_ratio(), lacking);
            if header == nut {
                assert_eq!(trace.ignored, ["gear"]);
                close(trace.temperature.as_ref().unwrap(), |_| 294.65, 1e-9);
            }
        }
    }
    // A speed alone is summed up: a trapezoid's error is its step squared over 12 times the change of the slope, 31 m/s^2.
    let text = table("time,carriage_speed_mm_s,motor_force", ticks(400), |time| format!("{time},{},1", 1e3 * (TAU * time / 0.4).cos()));
    let trace = read(&text).unwrap();
    assert!(trace.position_summed);
    close(&trace.position, |time| (TAU * time / 0.4).sin() * 0.4 / TAU, 3e-6);
}

/// Gaps, jitter, samples that stand twice, free clocks, slow ticks and empty cells: counted, and the values between right.
#[test]
fn clocks_are_put_on_even_ticks() {
    let rough = noise(3, 1000);
    let free: Vec<f64> = rough
        .iter()
        .scan(0.0, |time, rough| {
            *time += 1e-3 * (1.0 + 0.05 * rough);
            Some(*time)
        })
        .collect();
    let but = |skip: std::ops::Range<usize>| ticks(1000).enumerate().filter(move |(sample, _)| !skip.contains(sample));
    let twice = ticks(1000).flat_map(|time| vec![time; if (time * 1e3) as usize % 100 == 50 { 2 } else { 1 }]);
    let beside = |by: fn(usize) -> f64| ticks(1000).enumerate().map(move |(sample, time)| time + 1e-3 * by(sample)).collect();
    // Fourth derivative of the angle, rad/s^4, over 24 times the squares of the distances to the two nearest samples on either side.
    let cubic = |near: f64, far: f64| 12.0 * (TAU / 0.4f64).powi(4) / 24.0 * (near * far).powi(2);
    // Times; missing, jittered, repeated, free running; marked; tolerance.
    let cases: [(Vec<f64>, [usize; 4], usize, f64); 6] = [
        (but(500..504).map(|(_, time)| time).collect(), [4, 0, 0, 0], 4, cubic(2.5e-3, 3.5e-3)),
        (beside(|sample| if sample % 100 == 50 { 0.3 } else { 0.0 }), [0, 10, 0, 0], 0, cubic(0.65e-3, 1.65e-3)),
        (twice.collect(), [0, 0, 10, 0], 0, 1e-12),
        (ticks(1000).map(|time| 200.0 * time).collect(), [0; 4], 0, 1e-9),
        (ticks(1000).map(|time| (time / 1.5 * 1e4).round() / 1e4).collect(), [0; 4], 0, 190.0 * 7e-5),
        (free, [0, 0, 0, 1000], 0, 190.0 * 1e-6),
    ];
    for (times, repairs, marked, tolerance) in cases {
        let text = table("time,position,motor_force", times, |time| format!("{time},{},1", angle(time)));
        let trace = read(&text).unwrap();
        let found = &trace.repairs;
        let counted = [found.missing, found.jittered, found.repeated];
        assert_eq!(counted, repairs[..3]);
        assert!(found.free_running.abs_diff(repairs[3]) <= 3);
        assert_eq!(trace.told().concat().contains("a logger that runs free"), repairs[3] > 0);
        assert_eq!(trace.left_out.iter().map(ExactSizeIterator::len).sum::<usize>(), marked);
        for (tick, found) in trace.position.iter().enumerate() {
            let wanted = angle(trace.start + trace.step * tick as f64);
            assert!((found - wanted).abs() <= tolerance, "{repairs:?} {tick}: {found} for {wanted}");
        }
    }
    // A torque of every fourth row, of which three in a row are lost; a row without a position.
    let text = table("time,position_deg,motor_torque", ticks(400), |time| {
        let row = (1e3 * time).round() as usize;
        let torque = if row.is_multiple_of(4) && !(200..212).contains(&row) { time.to_string() } else { String::new() };
        let position = if row == 50 { "NaN".into() } else { angle(time).to_string() };
        format!("{time},{position},{torque}")
    });
    let trace = read(&text).unwrap();
    close(&trace.effort[..397], |time| time, 1e-12);
    assert_eq!(trace.left_out, [50..51, 197..212]);
    assert_eq!(trace.repairs.left_out[0].rows, [(198, 212)]);
}

const SAMPLES: usize = 6000;

/// A weave of 3 rad seen by 14 bits, its torque and load with their noise.
fn drive() -> Vec<[f64; 3]> {
    let (step, rough) = (TAU / 16384.0, [noise(1, SAMPLES), noise(2, SAMPLES)]);
    let row = |(sample, time): (usize, f64)| {
        let angle = 3.0 * (TAU * 0.8 * time).sin() + 0.01 * (TAU * 9.0 * time).sin() + 5.0;
        let torque = 0.05 * (TAU * 0.8 * time).cos().signum() + 0.2;
        let load = 900.0 * (TAU * 0.3 * time).sin() + 1500.0;
        [(angle / step).round() * step, torque + 2e-3 * rough[0][sample], load + 4.0 * rough[1][sample]]
    };
    ticks(SAMPLES).enumerate().map(row).collect()
}

fn read_drive(rows: &[[f64; 3]]) -> Result<Trace, String> {
    let text = table("time,nut_position,motor_torque,axial_load", ticks(rows.len()), |time| {
        let [angle, torque, load] = rows[(1e3 * time).round() as usize];
        format!("{time:.3},{angle:.6},{torque:.6},{load:.3}")
    });
    read(&text)
}

/// What a spoiled drive is: the column, its samples, what they read beside what they should; the fault.
type Spoiled = (usize, Vec<usize>, fn(f64) -> f64, Fault);

/// Dropouts, spikes and lost stretches in every channel are marked, and nothing else; what is put there is the drive to its noise.
#[test]
fn what_no_mechanism_makes_is_marked() {
    let clean = drive();
    let untouched = read_drive(&clean).unwrap();
    assert!(untouched.left_out.is_empty());
    let single: Vec<usize> = (1..60).map(|k| 97 * k).chain([2, 3000, 3002, 3003, SAMPLES - 3]).collect();
    let dense: Vec<usize> = (2900..3150).filter(|k| k * k % 7 == 1).collect();
    let runs: Vec<usize> = [500, 2600, 4100].into_iter().flat_map(|start| start..start + 9).collect();
    let mut cases: Vec<Spoiled> = Vec::new();
    for column in 0..3 {
        let spike: fn(f64) -> f64 = [|_| 65.535, |_| 3.0, |_| -8e3][column];
        let zero: fn(f64) -> f64 = |_| 0.0;
        for samples in [&single, &dense] {
            cases.extend([zero, spike].map(|wrong| (column, samples.clone(), wrong, Fault::Wrong)));
        }
        cases.push((column, runs.clone(), zero, Fault::Wrong));
    }
    cases.push((0, vec![0, 1, SAMPLES - 1], |_| 0.0, Fault::Wrong));
    cases.push((1, (2000..2050).collect(), |_| 0.2, Fault::Lost));
    cases.push((2, (2000..2050).collect(), |_| 0.0, Fault::Lost));
    cases.push((1, (3100..3160).filter(|k| k % 20 < 12).collect(), |_| 0.26, Fault::Clipped));
    for (column, mut samples, wrong, fault) in cases {
        let mut rows = clean.clone();
        samples.sort_unstable();
        for sample in &samples {
            rows[*sample][column] = wrong(rows[*sample][column]);
        }
        let trace = read_drive(&rows).unwrap_or_else(|message| panic!("{column} {fault:?}: {message}"));
        let [found] = &trace.repairs.left_out[..] else {
            panic!("{column} {fault:?}: {:?}", trace.repairs);
        };
        let marked: Vec<usize> = trace.left_out.iter().cloned().flatten().collect();
        assert_eq!((marked, found.fault), (samples, fault), "column {column}: {}", found.told());
        // Five deviations of the noise, weighted by at most two; a cubic over nine ticks; held at an end for two ticks at 15 rad/s.
        let near = [0.04, 0.13, 60.0][column];
        let channels = [&trace.position, &trace.effort, trace.load.as_ref().unwrap()];
        for (sample, found) in channels[column].iter().enumerate() {
            assert!((found - clean[sample][column]).abs() < near, "{column} {sample}: {found}");
        }
    }
}

/// Pulses, kicks, a drive that is off until it stops, and peaks that the motion answers to are the drive's own.
#[test]
fn what_a_drive_does_is_not_marked() {
    let mut rows = drive();
    for row in &mut rows[2000..2010] {
        row[1] += 0.5;
    }
    for row in &mut rows[4000..4020] {
        row[2] += 300.0;
    }
    let at = rows[5600][0];
    for row in &mut rows[5500..] {
        row[1] = 0.0;
    }
    for row in &mut rows[5600..] {
        row[0] = at;
    }
    let trace = read_drive(&rows).unwrap();
    assert!(trace.left_out.is_empty(), "{:?}", trace.repairs);
    // Of a slow recorder: a torque peaks for one sample as the speed starts; another one moves nothing.
    let rough = noise(9, 2000);
    let text = table("time,motor_speed_rpm,motor_torque_mNm", ticks(2000).map(|time| 40.0 * time), |time| {
        let sample = (25.0 * time).round() as usize;
        let torque = match (sample % 100, sample % 500) {
            (50, _) | (_, 80) => 9.0,
            (51.., _) => 3.0 + 0.1 * rough[sample],
            _ => 0.1 * rough[sample],
        };
        format!("{time},{},{torque}", if sample % 100 >= 50 { 50 } else { 0 })
    });
    assert_eq!(read(&text).unwrap().left_out, [80..81, 580..581, 1080..1081, 1580..1581]);
}

/// A load that is noise about nothing is none; about a weight it is the weight; one that changes stays.
#[test]
fn a_load_of_noise_alone_is_no_load() {
    let rough = noise(7, 20_000);
    for (load, wanted) in [
        ((|_| 0.3) as fn(f64) -> f64, None),
        (|_| 500.0, Some(true)),
        (|time| 12.0 * (TAU * 0.1 * time).sin(), Some(false)),
        (
            |time| {
                if (3.0..3.02).contains(&time) { 90.0 } else { 0.0 }
            },
            Some(false),
        ),
    ] {
        let text = table("time,nut_position,motor_torque,axial_load", ticks(20_000), |time| {
            let load = load(time) + 4.0 * rough[(1e3 * time).round() as usize];
            format!("{time},{},{},{load}", (TAU * 0.7 * time).sin(), (TAU * 0.7 * time).cos().signum())
        });
        let trace = read(&text).unwrap();
        let constant = trace.load.map(|load| load.iter().all(|value| *value == load[0]));
        assert_eq!(constant, wanted);
        assert_eq!(trace.repairs.notes.len(), usize::from(wanted != Some(false)));
    }
}

#[test]
fn the_step_of_a_sensor_is_found() {
    let motion = |time: f64| 9.0 * time.sin() + 0.7 * (13.0 * time).sin();
    let step = TAU / 16384.0 / 2.5;
    // Decimals, step that rounds, step found.
    for (digits, rounds, found) in [(12, step, step), (6, step, step), (3, 0.25, 0.25), (12, 0.0, 0.0)] {
        let text = table("time,position,motor_force", ticks(20_000), |time| {
            let exact = motion(time);
            let seen = if rounds > 0.0 { (exact / rounds).round() * rounds } else { exact };
            format!("{time},{seen:.digits$},1")
        });
        let trace = read(&text).unwrap();
        // Printed with six digits behind the point, a hundredth of a step.
        assert!((trace.resolution - found).abs() <= 1e-2 * found, "{digits} {}", trace.resolution);
    }
}

#[test]
fn what_cannot_be_read_is_refused_with_its_cause() {
    let of = |header: &str, line: &str| table(header, ticks(200), |time| line.replace('t', &time.to_string()));
    let clocked = |by: fn(usize) -> f64| {
        let times = ticks(1000).enumerate().map(|(sample, time)| time + by(sample));
        table("time,position,motor_force", times, |time| format!("{time},{},1", angle(time)))
    };
    let spoiled = |samples: std::ops::Range<usize>, every: usize, of: fn(&mut [f64; 3])| {
        let mut rows = drive();
        rows[samples].iter_mut().step_by(every).for_each(of);
        read_drive(&rows).map(|trace| trace.name).unwrap_err()
    };
    let degrees = table("time,nut_position,motor_torque", ticks(2000), |time| {
        let step = 360.0 / 16384.0;
        format!("{time},{:.6},1", (144.0 * (4.0 * time).sin() / step).round() * step)
    });
    let fast = table("time,motor_torque,nut_speed", ticks(200), |time| format!("{time},1,700"));
    let plain = "time,position,motor_force";
    let twice = ticks(1000).flat_map(|time| vec![time; if ((1e3 * time) as usize).is_multiple_of(10) { 2 } else { 1 }]);
    let twice = table(plain, twice, |time| format!("{time},1,1"));
    for (message, word) in [
        (refused(""), "empty"),
        (refused("time,position,motor_force\n"), "too few"),
        (refused(&of("time,position", "t,1")), "motor_torque or motor_force"),
        (refused(&of("time,motor_force", "t,1")), "position or speed"),
        (refused(&of("position,motor_force", "1,1")), "time is missing"),
        (refused(&of(",position,motor_force", "t,1,1")), "name it time"),
        (refused(&of("time|position|motor_force", "t|1|1")), "separated by bars"),
        (refused(&of("time,axial_load,rack_force,position,motor_force", "t,1,1,1,1")), "same quantity"),
        (refused(&of("time,position,motor_force,motor_torque", "t,1,1,1")), "give the effort once"),
        (refused(&of("time,nut_position_counts,motor_torque", "t,1,1")), "counts"),
        (refused(&of("time,position_inch,motor_force", "t,1,1")), "position_mm"),
        (refused(&of("time,nut_position,motor_force", "t,1,1")), "need a design"),
        (refused(&of("time,position_mm,motor_torque", "t,1,1")), "need a design"),
        (refused(&of("time,position,motor_force,temperature", "t,1,1,20")), "temperature_C"),
        (refused(&of(plain, "t,NaN,1")), "column position: it has fewer than two numbers"),
        (refused(&of(plain, "t,-inf,1")), "is not finite"),
        (refused(&of(plain, "t,-,1")), "is not a number"),
        (refused(&of(plain, "t,1e39,1")), "float32"),
        (refused(&of(plain, "t,1")), "line 2: 2 columns"),
        (refused(&of(plain, "-t,1,1")), "line 3: time goes back"),
        (refused("by hand\n\ntime,position,motor_force\n0,1,1\n\n\n1,1,x\n"), "line 7: motor_force = \"x\""),
        (refused("time;position;motor_force\ns;knots;N\n0;1;1\n"), "line 2: column position: its unit \"knots\""),
        (refused("time,position_mm,motor_force\ns,deg,N\n"), "its name says mm"),
        (refused(&of("time_ns,position,motor_force", "t,1,1")), "is too short"),
        (refused(&clocked(|sample| 0.5 * sample as f64)), "time_ms"),
        (refused(&clocked(|sample| if sample < 500 { 0.0 } else { 2.0 })), "a gap of 2.0010 s after 0.499 s"),
        (refused(&clocked(|sample| 1e-3 * (sample / 20) as f64)), "are missing"),
        (refused(&twice), "time of the one before"),
        (refused(&clocked(|sample| [4.5e-4, -4.5e-4][sample % 2])), "no even tick"),
        (spoiled(3000..SAMPLES, 1, |row| row[0] += 1.5), "it jumps by 1.4"),
        (spoiled(5..SAMPLES, 15, |row| row[0] = 0.0), "column nut_position"),
        (spoiled(2000..2400, 1, |row| row[1] = 0.2), "in rows 2001 to 2400"),
        (read_bytes(of(plain, "t,1,1").as_bytes(), &Frame { lead: None, ..GEAR }).map(|trace| trace.name).unwrap_err(), "needs --design"),
        (refused(&degrees), "steps of 360/2^14"),
        (
            read_bytes(fast.as_bytes(), &GEAR).map(|trace| trace.name).unwrap_err(),
            "nut_speed in [limits] is 300; is the column in degrees? Then its name is nut_speed [rpm] or nut_speed [deg/s]",
        ),
    ] {
        assert!(message.contains(word), "{word}: {message}");
    }
}

const SEEDS: [&str; 4] = [
    include_str!("../../../fuzz/corpus/calibration/nut"),
    include_str!("../../../fuzz/corpus/calibration/carriage"),
    include_str!("../../../fuzz/corpus/calibration/wraps"),
    include_str!("../../../fuzz/corpus/calibration/jitter"),
];

#[test]
fn seeds_are_read_and_their_ruins_are_read_or_refused() {
    let mut random = 1u32;
    let mut next = |below: usize| {
        random = random.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (random >> 8) as usize % below
    };
    for round in 0..800 {
        let mut text = SEEDS[round % 4].as_bytes().to_vec();
        assert!(round >= 4 || read_bytes(&text, &GEAR).is_ok());
        for _ in 0..=next(4) {
            let place = next(text.len());
            match next(4) {
                0 => text[place] = b"0123456789.,-e\n\"x_"[next(18)],
                1 => text.truncate(place + 1),
                2 => text.splice(0..0, [0xff, 0xfe]).for_each(drop),
                _ => text.drain(place..(place + next(40)).min(text.len().max(place))).for_each(drop),
            }
            if text.is_empty() {
                text.push(b't');
            }
        }
        let found = [Frame::default(), GEAR].map(|frame| read_bytes(&text, &frame));
        for trace in found.into_iter().flatten() {
            assert!(trace.position.iter().chain(&trace.effort).all(|value| value.is_finite()));
            assert!(trace.left_out.iter().all(|run| run.end <= trace.len()));
        }
    }
}
