//! Tables as measuring tools write them.

use std::io::Cursor;

use epas_page::failure::Failure;

use super::from_reader;
use crate::trace::Trace;

fn read(text: &[u8]) -> Result<Trace, String> {
    from_reader(Cursor::new(text), "trace", None).map_err(|failure| match failure {
        Failure::Data(message) => message,
        other => format!("{other:?}"),
    })
}

/// The numbers of a table: time, s; speed, deg/s; torque, N m.
fn lines(separator: &str, line: impl Fn(usize) -> [String; 3]) -> String {
    let lines: Vec<String> = (0..400).map(|row| line(row).join(separator)).collect();
    lines.join("\n")
}

fn numbers(row: usize) -> [f64; 3] {
    let time = 1e-3 * row as f64;
    [
        time,
        90.0 + 40.0 * (9.0 * time).sin(),
        0.25 * (9.0 * time).cos() + 1e-3 * (row % 7) as f64,
    ]
}

fn whole(separator: &str, decimal: &str) -> String {
    lines(separator, |row| {
        numbers(row).map(|value| format!("{value:.6}").replace('.', decimal))
    })
}

fn holds(trace: &Trace) {
    assert_eq!(trace.len(), 400);
    for row in 0..400 {
        let [_, speed, torque] = numbers(row);
        let found = trace.speed.as_ref().unwrap()[row].to_degrees();
        assert!((found - speed).abs() < 1e-5 && (trace.effort[row] - torque).abs() < 2e-6);
    }
}

#[test]
fn lines_above_units_below_and_other_separators() {
    for (above, separator, decimal) in [
        // Exports of a recorder, a measuring tool with German numbers, and a library.
        (
            "Recorder 3.7\nAxis: 1, \"left\n\nTime [s];Motor speed;Motor torque\ns;deg/sec;Nm\n",
            ";",
            ",",
        ),
        (
            "ETAS\nrecord\t7\ntime\tmotor_speed\tmotor_torque\ns\tdeg/s\tN m\n",
            "\t",
            ".",
        ),
        (
            "\"timestamps\",\"motor_speed\",\"motor_torque\"\n\"s\",\"deg/sec\",\"\"\n",
            ",",
            ".",
        ),
        (
            "time,motor_speed_deg_s,motor_torque\n[s],-,[Nm]\n",
            ",",
            ".",
        ),
        ("time,Motor speed (deg/sec),motor_torque\n", ",", "."),
    ] {
        let text = format!("{above}{}", whole(separator, decimal));
        holds(&read(text.as_bytes()).unwrap_or_else(|message| panic!("{above}: {message}")));
    }
    // Degrees as a tool without UTF-8 writes them.
    let mut text = b"time;motor_speed;motor_torque\ns;\xb0/s;Nm\n".to_vec();
    text.extend(whole(";", ",").into_bytes());
    holds(&read(&text).unwrap());
}

#[test]
fn what_is_wrong_names_its_line() {
    let above = "made by hand\n\ntime;motor_speed;motor_torque\n";
    for (rows, word) in [
        (
            "s;knots;Nm\n0;1;1\n",
            "line 4: column motor_speed: its unit \"knots\" in the row below",
        ),
        (
            "s;rpm;Nm\n0;1;1\n0,001;x;1\n",
            "line 6: motor_speed = \"x\" is no number",
        ),
        ("0;1\n", "line 4: 2 columns"),
        ("0;1;1\n;1;1\n", "line 5: time has no number"),
    ] {
        let message = read(format!("{above}{rows}").as_bytes()).unwrap_err();
        assert!(message.starts_with(word), "{message}");
    }
    let twice = format!(
        "time,motor_speed_rpm,motor_torque\ns,deg/s,Nm\n{}",
        whole(",", ".")
    );
    assert!(
        read(twice.as_bytes())
            .unwrap_err()
            .contains("its name says rpm")
    );
}

/// A torque every fourth row, and a sample here and there that is missing.
#[test]
fn empty_cells_are_interpolated() {
    let text = lines(",", |row| {
        let [time, speed, torque] = numbers(row).map(|value| format!("{value:.6}"));
        let torque = if row.is_multiple_of(4) {
            torque
        } else {
            String::new()
        };
        let speed = if row % 100 == 50 { "NaN".into() } else { speed };
        [time, speed, torque]
    });
    let trace = read(format!("time,motor_speed_deg_s,motor_torque\n{text}").as_bytes()).unwrap();
    assert_eq!((trace.len(), trace.repairs.missing), (400, 4));
    assert!(
        trace.repairs.notes[0].contains("interpolated linearly"),
        "{:?}",
        trace.repairs.notes
    );
    for row in (0..396).step_by(4) {
        let [from, to] = [row, row + 4].map(|row| numbers(row)[2]);
        let middle = trace.effort[row + 2];
        assert!(
            (trace.effort[row] - from).abs() < 1e-6 && (middle - 0.5 * (from + to)).abs() < 1e-6
        );
    }
    let empty = lines(",", |row| {
        [numbers(row)[0].to_string(), "1".into(), String::new()]
    });
    let message = read(format!("time,motor_speed,motor_torque\n{empty}").as_bytes()).unwrap_err();
    assert!(
        message.contains("column motor_torque: it has fewer than two numbers"),
        "{message}"
    );
}
