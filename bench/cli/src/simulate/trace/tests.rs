//! Tables of traces, good and refused.

use super::*;
use crate::simulate::mechanism::Commanded;
use crate::simulate::samples::ScrewSample;
use std::io::Cursor;

fn parse(text: &[u8]) -> Result<Vec<ScrewSample>, String> {
    samples(Cursor::new(text))
}

#[test]
fn columns_stand_in_any_order_among_others() {
    let text = "\u{feff}axial_load, gear ,time,nut_speed\n1e3,3,0,-2\n\n1e3,3,0.5,2\n";
    let samples = parse(text.as_bytes()).unwrap();
    assert_eq!(
        samples,
        [
            ScrewSample::new(0.0, -2.0, 1e3),
            ScrewSample::new(0.5, 2.0, 1e3)
        ]
    );
}

#[test]
fn headings_say_their_units() {
    let text = "Time [ms],Nut speed (1/min),axial_load_kN\n0,60,1\n500,-60,-0\n";
    let samples = parse(text.as_bytes()).unwrap();
    let turn = 60.0 * (std::f64::consts::TAU / 60.0);
    assert_eq!(
        samples,
        [
            ScrewSample::new(0.0, turn, 1e3),
            ScrewSample::new(0.5, -turn, 0.0)
        ]
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
    let counted = long(|row| format!("{row},1,1\n"));
    let degrees = long(|row| format!("{:.3},1,1,{}\n", 1e-3 * row as f64, 0.0573 * row as f64));
    let degrees = degrees.replace("axial_load", "axial_load,nut_position");
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
        (&counted, "tick = 1 s is too slow"),
        (&degrees, "nut_position in deg?"),
        (
            "time nut_speed axial_load\n0 1 2\n1 1 2\n",
            "separated by spaces",
        ),
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
    assert!(loads.iter().all(|moment| moment.axial_load >= 500.0));
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
        [
            ScrewSample::new(0.0, turn, 1500.0),
            ScrewSample::new(0.5, -turn, 500.0)
        ]
    );
    let text = "time,nut_speed,axial_load\n0,1,10\n1,1,\n2,1,nan\n3,1,40\n";
    let loads = parse(text.as_bytes()).unwrap();
    assert_eq!(
        loads
            .iter()
            .map(|moment| moment.axial_load)
            .collect::<Vec<_>>(),
        [10.0, 20.0, 30.0, 40.0]
    );
}

#[test]
fn a_column_that_may_be_missing_reads_zero() {
    let parse = |text: &str| {
        let samples = samples::<Commanded<false>>(Cursor::new(text.as_bytes().to_vec()));
        let numbers = |moments: Vec<Commanded<false>>| -> Vec<Vec<f64>> {
            moments.iter().map(Sample::numbers).collect()
        };
        samples.map(numbers)
    };
    let without = parse(
        "time,motor_torque,axial_load
0,1,9
1,2,9
",
    )
    .unwrap();
    assert_eq!(
        without,
        [[0.0, 1.0, 9.0, 0.0, 0.0], [1.0, 2.0, 9.0, 0.0, 0.0]]
    );
    let text = "time,Known torque [mNm],motor_torque,axial_load
0,500,1,9
1,-500,2,9
";
    let with = parse(text).unwrap();
    assert_eq!(
        with,
        [[0.0, 1.0, 9.0, 0.5, 0.0], [1.0, 2.0, 9.0, -0.5, 0.0]]
    );
    let [low, high] = [0, 1].map(|row| {
        let mut numbers = with[row].iter().copied();
        Commanded::<false>::of(|| numbers.next().unwrap())
    });
    let middle = Commanded::between(&low, &high, &|low, high| 0.5 * (low + high));
    assert_eq!(middle.numbers(), [0.5, 1.5, 9.0, 0.0, 0.0]);
    let fault = parse(
        "time,motor_torque,axial_load,known_torque
0,1,9,x
1,1,9,1
",
    )
    .unwrap_err();
    assert!(fault.contains("known_torque = \"x\""), "{fault}");
}
