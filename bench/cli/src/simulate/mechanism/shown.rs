//! What a mechanism did: its table, its summary, its picture.

use std::f64::consts::{PI, TAU};

use super::Row;
use crate::simulate::beyond::Beyond;
use crate::simulate::picture::Form;
use crate::simulate::summary::{Flags, Lines};
use epas_page::failure::Failure;
use epas_page::plot::{Axis, Chart, Mark, Panel, Series};
use epas_traces::flags;

const COLUMNS: [&str; 9] = [
    "time",
    "motor_torque",
    "axial_load",
    "nut_position",
    "nut_speed",
    "friction_torque",
    "load_torque",
    "faults",
    "fault_words",
];

/// Column of the known effort, as a torque at the nut.
const KNOWN: &str = "known_torque";

pub fn columns(known: bool) -> Vec<&'static str> {
    let mut columns = COLUMNS.to_vec();
    columns.extend(known.then_some(KNOWN));
    columns
}

pub fn is_known(rows: &[Row]) -> bool {
    rows.iter().any(|row| row.known != 0.0)
}

pub fn record(row: &Row, known: bool) -> Vec<String> {
    let numbers = [
        row.acting.time,
        row.torque,
        row.acting.axial_load,
        row.angle,
        row.speed,
        row.friction,
        row.outputs.load_torque.into(),
    ];
    let mut record: Vec<String> = numbers.map(|number| number.to_string()).to_vec();
    record.push(row.outputs.faults.bits().to_string());
    record.push(flags::words(row.outputs.faults));
    record.extend(known.then(|| row.known.to_string()));
    record
}

/// How often the nut turned back, and what it did with its energy.
pub fn summary(rows: &[Row], inertia: f64, tick: f64, mut beyond: Option<Beyond>) -> Lines {
    let mut lines = Lines::default();
    let most =
        |value: &dyn Fn(&Row) -> f64| rows.iter().map(|row| value(row).abs()).fold(0.0, f64::max);
    let work = |torque: &dyn Fn(&Row) -> f64| -> f64 {
        rows.iter().map(|row| torque(row) * row.speed * tick).sum()
    };
    let moving: Vec<f64> = rows
        .iter()
        .map(|row| row.speed)
        .filter(|speed| speed.abs() > 1e-6)
        .collect();
    let reversals = moving
        .windows(2)
        .filter(|pair| pair[0] * pair[1] < 0.0)
        .count();
    lines.add("inertia", format!("{inertia} kg m^2"));
    lines.add(
        "turned through",
        format!("{:.4} turns at most", most(&|row| row.angle) / TAU),
    );
    lines.add(
        "nut speed",
        format!(
            "{:.4} rad/s ({:.1} rpm) at most",
            most(&|row| row.speed),
            most(&|row| row.speed) * 30.0 / PI
        ),
    );
    lines.add("reversals", reversals.to_string());
    lines.add("motor work", format!("{:.4} J", work(&|row| row.torque)));
    if is_known(rows) {
        lines.add(
            "known effort",
            format!(
                "{:.4} N m at the nut at most, its work {:.4} J",
                most(&|row| row.known),
                work(&|row| row.known)
            ),
        );
    }
    lines.add(
        "friction work",
        format!("{:.4} J", work(&|row| row.friction)),
    );
    let held = rows.iter().filter(|row| row.speed.abs() <= 1e-6).count();
    lines.add(
        "at rest",
        format!(
            "{:.1} % of the time",
            100.0 * held as f64 / rows.len().max(1) as f64
        ),
    );
    let mut flags = Flags::default();
    for row in rows {
        flags.add(row.outputs.faults);
        if let Some(beyond) = &mut beyond {
            beyond.add(row.speed, row.acting.axial_load, row.outputs.faults);
        }
    }
    flags.lines(&mut lines);
    if let Some(beyond) = beyond {
        beyond.lines(&mut lines);
    }
    lines
}

pub fn drawn(trace: &str, design: &str, rows: &[Row], form: Form) -> Result<String, Failure> {
    let title = format!("{trace} on {design}");
    let curve = |value: &dyn Fn(&Row) -> f64| form.curve(rows, &|row| row.acting.time, value);
    let panel = |title: String, label: &str, curves: Vec<(&str, Vec<(f64, f64)>)>| {
        let series = curves.into_iter().enumerate();
        Panel::Chart(Chart {
            title,
            x: Axis::linear("time (s)"),
            y: Axis::linear(label),
            series: series
                .map(|(colour, (name, points))| Series::new(name, colour, Mark::Line, points))
                .collect(),
            notes: Vec::new(),
        })
    };
    let mut torques = vec![
        ("motor", curve(&|row| row.torque)),
        ("load", curve(&|row| row.outputs.load_torque.into())),
        ("friction", curve(&|row| row.friction)),
    ];
    if is_known(rows) {
        torques.push(("known effort", curve(&|row| row.known)));
    }
    let panels = [
        panel(title.clone(), "torque at the nut (N m)", torques),
        panel(
            String::new(),
            "nut angle (rad)",
            vec![("", curve(&|row| row.angle))],
        ),
        panel(
            String::new(),
            "nut speed (rad/s)",
            vec![("", curve(&|row| row.speed))],
        ),
    ];
    form.draw(&title, &panels)
}
