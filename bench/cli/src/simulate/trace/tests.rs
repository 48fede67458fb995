//! Tables of traces, good and refused.

use super::*;
use std::io::Cursor;

#[derive(Clone, Copy, Debug, PartialEq)]
struct Moment {
    time: f64,
    speed: f64,
    load: f64,
}

impl Sample for Moment {
    const COLUMNS: &'static [&'static str] = &["time", "nut_speed", "axial_load"];

    fn read<E>(mut column: impl FnMut(&'static str) -> Result<f64, E>) -> Result<Self, E> {
        Ok(Self {
            time: column("time")?,
            speed: column("nut_speed")?,
            load: column("axial_load")?,
        })
    }

    fn record(&self) -> Vec<String> {
        [self.time, self.speed, self.load]
            .map(|x| x.to_string())
            .to_vec()
    }

    fn time(&self) -> f64 {
        self.time
    }

    fn speed(&self) -> f64 {
        self.speed
    }

    fn load(&self) -> f64 {
        0.0
    }
}

fn parse(text: &[u8]) -> Result<Vec<Moment>, String> {
    samples(Cursor::new(text))
}

#[test]
fn columns_stand_in_any_order_among_others() {
    let text = "\u{feff}axial_load, gear ,time,nut_speed\n1e3,3,0,-2\n\n1e3,3,0.5,2\n";
    let samples = parse(text.as_bytes()).unwrap();
    assert_eq!(
        samples,
        [(0.0, -2.0), (0.5, 2.0)].map(|(time, speed)| Moment {
            time,
            speed,
            load: 1e3,
        })
    );
}

#[test]
fn headings_say_their_units() {
    let text = "Time [ms],Nut speed (1/min),axial_load_kN\n0,60,1\n500,-60,-0\n";
    let samples = parse(text.as_bytes()).unwrap();
    let turn = 60.0 * (std::f64::consts::TAU / 60.0);
    assert_eq!(
        samples,
        [(0.0, turn, 1e3), (0.5, -turn, 0.0)].map(|(time, speed, load)| Moment {
            time,
            speed,
            load
        })
    );
}

fn of(lines: &str) -> String {
    format!("time,nut_speed,axial_load\n{lines}")
}

fn long(line: impl Fn(usize) -> String) -> String {
    of(&(0..400).map(line).collect::<String>())
}

/// What concerns one line names it.
#[test]
fn every_fault_has_its_word() {
    let many = long(|row| format!("{},1,1\n", row / 2));
    let gap = long(|row| {
        format!(
            "{:.3},1,1\n",
            1e-3 * row as f64 + if row > 200 { 5.0 } else { 0.0 }
        )
    });
    for (text, word) in [
        ("", "line 1: the file is empty"),
        (
            "time,nut_speed\n0,1\n1,1\n",
            "column axial_load is missing; beside the time there are nut_speed",
        ),
        ("time,nut_speed,axial_load,time\n0,1,2,3\n", "same quantity"),
        (&of(""), "the trace is empty"),
        (&of("0,1,2\n1,fast,2\n"), "line 3: nut_speed = \"fast\""),
        (&of("0,1,2\n\n\n1,fast,2\n"), "line 5: nut_speed"),
        (
            "time,nut_speed,axial_load\r\n0,1,2\r\n1,fast,2\r\n",
            "line 3: nut_speed",
        ),
        (&of("0,1,2\n"), "single sample"),
        (
            "time|nut_speed|axial_load\n0,5|1|2\n",
            "line 1: here stands",
        ),
        (&of("0,\"1,5\",2\n"), "in place of the comma"),
        (
            "time,nut_spd,axial_load\n0,1,2\n1,1,2\n",
            "nut_speed is missing; beside the time there are axial_load, nut_spd",
        ),
        ("time,nut_speed (m/s),axial_load\n0,1,2\n", "rad/s, deg/s"),
        ("time,nut_speed_mm,axial_load\n0,1,2\n", "nut_speed_rpm"),
        (
            "time,nut_speed,axial_load,axial_load_kN\n0,1,2,3\n",
            "columns axial_load and axial_load_kN are the same quantity; leave one of them out",
        ),
        (
            &of("0,1,-inf\n"),
            "line 2: axial_load = \"-inf\" is not finite",
        ),
        (&of("0,1,1e39\n"), "float32"),
        (&of("0,1,2\n1,1\n"), "line 3: 2 columns"),
        (&of(",1,1\n"), "line 2: time has no number"),
        (
            &of("0,1,1\n1,1,\n"),
            "column axial_load: it has fewer than two numbers",
        ),
        (&of("0,1,2\n1,1,2\n0.5,1,2\n"), "line 4: time goes back"),
        (&many, "time of the one before"),
        (&gap, "a gap of 5.0010 s after 0.2 s"),
    ] {
        let message = parse(text.as_bytes()).unwrap_err();
        assert!(message.contains(word), "{word}: {message}");
    }
    assert!(
        parse(b"time,nut_speed,axial_load\n0,1,2\n1,\xff,2\n")
            .unwrap_err()
            .starts_with("line 3")
    );
}

/// A sample that stands twice is dropped; times of a solver may stand anywhere, and so may few samples.
#[test]
fn samples_stay_at_their_times() {
    let times = |text: &str| -> Vec<f64> {
        let samples = parse(text.as_bytes()).unwrap();
        samples.iter().map(|moment| moment.time).collect()
    };
    assert_eq!(times(&of("0,1,2\n0,3,2\n1,1,2\n9,1,2\n")), [0.0, 1.0, 9.0]);
    let solver = long(|row| format!("{},1,1\n", (row * row / 7 * 7) as f64 + row as f64));
    assert_eq!(times(&solver).len(), 400);
    // A word of the load that is lost is bridged.
    let noisy = long(|row| {
        let load = if row == 200 { 0 } else { 500 + row * row % 7 };
        format!("{:.3},1,{load}\n", 1e-3 * row as f64)
    });
    let loads = parse(noisy.as_bytes()).unwrap();
    assert!(loads.iter().all(|moment| moment.load >= 500.0));
}

#[test]
fn lines_above_units_below_and_empty_cells() {
    let text =
        "Recorder 3\n\nTime;Nut speed;Axial load\nms;1/min;kN\n0;60;1,5\n250;;\n500;-60;0,5\n";
    let samples = parse(text.as_bytes()).unwrap();
    let turn = 60.0 * (std::f64::consts::TAU / 60.0);
    // The row without a speed is left out.
    assert_eq!(
        samples,
        [(0.0, turn, 1500.0), (0.5, -turn, 500.0)].map(|(time, speed, load)| Moment {
            time,
            speed,
            load
        })
    );
    let text = "time,nut_speed,axial_load\n0,1,10\n1,1,\n2,1,nan\n3,1,40\n";
    let loads = parse(text.as_bytes()).unwrap();
    assert_eq!(
        loads.iter().map(|moment| moment.load).collect::<Vec<_>>(),
        [10.0, 20.0, 30.0, 40.0]
    );
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Pushed([f64; 3]);

impl Sample for Pushed {
    const COLUMNS: &'static [&'static str] = &["time", "motor_torque"];

    const OPTIONAL: &'static [&'static str] = &["known_torque"];

    fn read<E>(mut column: impl FnMut(&'static str) -> Result<f64, E>) -> Result<Self, E> {
        Ok(Self([
            column("time")?,
            column("motor_torque")?,
            column("known_torque")?,
        ]))
    }

    fn record(&self) -> Vec<String> {
        self.0.map(|x| x.to_string()).to_vec()
    }

    fn time(&self) -> f64 {
        self.0[0]
    }

    fn speed(&self) -> f64 {
        0.0
    }

    fn load(&self) -> f64 {
        0.0
    }
}

#[test]
fn a_column_that_may_be_missing_reads_zero() {
    let parse = |text: &str| samples::<Pushed>(Cursor::new(text.as_bytes().to_vec()));
    let without = parse("time,motor_torque\n0,1\n1,2\n").unwrap();
    assert_eq!(without, [Pushed([0.0, 1.0, 0.0]), Pushed([1.0, 2.0, 0.0])]);
    let with = parse("time,Known torque [mNm],motor_torque\n0,500,1\n1,-500,2\n").unwrap();
    assert_eq!(with, [Pushed([0.0, 1.0, 0.5]), Pushed([1.0, 2.0, -0.5])]);
    let middle = Pushed::between(&with[0], &with[1], &|low, high| 0.5 * (low + high));
    assert_eq!(middle, Pushed([0.5, 1.5, 0.0]));
    let fault = parse("time,motor_torque,known_torque\n0,1,x\n1,1,1\n").unwrap_err();
    assert!(fault.contains("known_torque = \"x\""), "{fault}");
}
