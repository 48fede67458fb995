//! Friction split into grooves and balls, and which balls press on each other, as Lin 2019, Figures 3.24
//! and 3.25.

use super::Row;
use super::picture::thin;
use super::subject::Subject;
use super::trace::Trace;
use crate::failure::Failure;
use crate::plot::{Axis, Chart, Mark, Panel, Series, render};

/// Moments at which contacts are marked, at most.
const MOMENTS: usize = 500;

/// Draws the panels: contacts, friction, and the largest force.
pub fn draw(trace: &Trace, subject: &Subject, rows: &[Row]) -> Result<String, Failure> {
    // Where the motion turns back, a way stands for more than one moment.
    let reverses = trace.samples.iter().any(|sample| sample.nut_speed > 0.0)
        && trace.samples.iter().any(|sample| sample.nut_speed < 0.0);
    let linear = matches!(subject, Subject::Linear(_));
    let (label, scale) = match (reverses, linear) {
        (true, _) => ("time (s)", None),
        (false, true) => ("travel (mm)", Some(1e3)),
        (false, false) => ("nut angle (degrees)", Some(1_f64.to_degrees())),
    };
    let place = |row: &Row| match (scale, &row.train) {
        (Some(scale), Some(train)) => scale * train.way,
        _ => row.sample.time,
    };
    let places = rows.iter().map(&place);
    let ends = places.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), place| {
        (low.min(place), high.max(place))
    });
    let curve = |value: &dyn Fn(&Row) -> f64| thin(rows, &place, value);
    let outputs = |row: &Row| row.train.map(|train| train.outputs);
    let of = |value: fn(&super::train::TrainOutputs) -> f32| {
        curve(&|row| outputs(row).map_or(f64::NAN, |outputs| f64::from(value(&outputs))))
    };

    let mut friction = vec![
        Series::new("grooves", 0, Mark::Line, of(|outputs| outputs.groove)),
        Series::new("ball to ball", 1, Mark::Line, of(|outputs| outputs.ball)),
        Series::new(
            "sum",
            6,
            Mark::Line,
            of(|outputs| outputs.common.friction_torque),
        ),
    ];
    if rows.first().is_some_and(|row| row.reference.is_some()) {
        friction.push(Series::new(
            "sum, reference in f64",
            2,
            Mark::Dashed,
            curve(&|row| {
                row.reference
                    .map_or(f64::NAN, |reference| reference.friction_torque)
            }),
        ));
    }
    let stride = rows.len().div_ceil(MOMENTS).max(1);
    let mut pressing = Vec::new();
    for row in rows.iter().step_by(stride) {
        let Some(train) = row.train else { continue };
        let balls = (0..u64::BITS).filter(|ball| train.pressing >> ball & 1 == 1);
        pressing.extend(balls.map(|ball| (place(row), f64::from(ball + 1))));
    }
    let friction_label = if linear {
        "friction force (N)"
    } else {
        "friction torque (N m)"
    };
    let panels = [
        (
            format!("{} on {}", trace.name, subject.name()),
            "ball that presses on the next",
            vec![Series::new("", 0, Mark::Circles, pressing)],
        ),
        (String::new(), friction_label, friction),
        (
            String::new(),
            "ball-to-ball contacts",
            vec![Series::new(
                "",
                0,
                Mark::Line,
                of(|outputs| f32::from(outputs.contacts)),
            )],
        ),
        (
            String::new(),
            "largest force between balls (N)",
            vec![Series::new(
                "",
                0,
                Mark::Line,
                of(|outputs| outputs.largest_contact_force),
            )],
        ),
    ]
    .map(|(title, y, series)| {
        Panel::Chart(Chart {
            title,
            x: Axis::linear(label).between(ends.0, ends.1),
            y: Axis::linear(y),
            series,
            notes: Vec::new(),
        })
    });
    render(&panels, 1, (1000, 300))
}
