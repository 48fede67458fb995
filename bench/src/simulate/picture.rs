//! Load, speed, friction torque and efficiency against time.

use super::Row;
use super::trace::Trace;
use crate::failure::Failure;
use crate::plot::{Axis, Chart, Mark, Panel, Series, render};

/// Buckets of time that a curve is thinned to: about the pixels of its width.
const BUCKETS: usize = 900;

/// Draws the four panels.
pub fn draw(trace: &Trace, design: &str, rows: &[Row]) -> Result<String, Failure> {
    let time = |row: &Row| row.sample.time;
    let curve = |value: &dyn Fn(&Row) -> f64| thin(rows, &time, value);
    let single = |value: &dyn Fn(&Row) -> f64| vec![Series::new("", 0, Mark::Line, curve(value))];
    let with_reference = rows.first().is_some_and(|row| row.reference.is_some());
    let pair = |value: &dyn Fn(&Row) -> f64, reference: &dyn Fn(&Row) -> f64| {
        let mut series = vec![Series::new("in the loop, f32", 0, Mark::Line, curve(value))];
        if with_reference {
            series.push(Series::new(
                "reference, f64",
                1,
                Mark::Dashed,
                curve(reference),
            ));
        }
        series
    };
    let panels = [
        (
            format!("{} on {design}", trace.name),
            Axis::linear("axial load (N)"),
            single(&|row| row.sample.axial_load),
        ),
        (
            String::new(),
            Axis::linear("nut speed (rad/s)"),
            single(&|row| row.sample.nut_speed),
        ),
        (
            String::new(),
            Axis::linear("friction torque (N m)"),
            pair(&|row| row.outputs.friction_torque.into(), &|row| {
                row.reference
                    .map_or(f64::NAN, |friction| friction.friction_torque)
            }),
        ),
        (
            String::new(),
            Axis::linear("efficiency"),
            pair(&|row| row.outputs.efficiency.into(), &|row| {
                row.reference
                    .map_or(f64::NAN, |friction| friction.efficiency)
            }),
        ),
    ]
    .map(|(title, y, series)| {
        Panel::Chart(Chart {
            title,
            x: Axis::linear("time (s)"),
            y,
            series,
            notes: Vec::new(),
        })
    });
    render(&panels, 1, (1000, 270))
}

/// At most four points for each bucket of time: first, lowest, highest and last, so that no peak is
/// lost.
pub fn thin(
    rows: &[Row],
    place: &dyn Fn(&Row) -> f64,
    value: &dyn Fn(&Row) -> f64,
) -> Vec<(f64, f64)> {
    let size = rows.len().div_ceil(BUCKETS).max(1);
    let point = |row: &Row| (place(row), value(row));
    if size <= 4 {
        return rows.iter().map(point).collect();
    }
    let mut points = Vec::with_capacity(4 * BUCKETS);
    for bucket in rows.chunks(size) {
        let by_value = |one: &&Row, other: &&Row| value(one).total_cmp(&value(other));
        let mut kept: Vec<&Row> = [
            bucket.first(),
            bucket.iter().min_by(by_value),
            bucket.iter().max_by(by_value),
            bucket.last(),
        ]
        .into_iter()
        .flatten()
        .collect();
        kept.sort_by(|one, other| one.sample.time.total_cmp(&other.sample.time));
        points.extend(kept.into_iter().map(point));
    }
    points
}
