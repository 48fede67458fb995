//! Run time of balls and trains, beside the times that Lin 2019 prints.

use std::time::Instant;

use epas_reference::friction::chain::solve_chain;

use super::Context;
use crate::failure::Failure;
use crate::plot::{Axis, Chart, Mark, Panel, Series};
use crate::report::document::{Block, Cell, Figure, Table};
use crate::study::{self, turned_ball};

/// Balls and key of each timed train.
const TRAINS: [(u8, &str); 9] = [
    (1, "press_1"),
    (2, "press_2"),
    (4, "press_4"),
    (8, "press_8"),
    (16, "press_16"),
    (32, "press_32"),
    (37, "press_37"),
    (48, "press_48"),
    (64, "press_64"),
];

/// Tables and figures.
pub fn blocks(context: &Context) -> Result<Vec<Block>, Failure> {
    Ok(vec![
        Block::Table(printed_times(context)?),
        Block::Table(train_times(context)?),
        Block::Figure(picture(context)?),
    ])
}

/// Median time of a call, s.
fn median_time(
    calls: usize,
    mut call: impl FnMut() -> Result<(), Failure>,
) -> Result<f64, Failure> {
    let mut times = Vec::with_capacity(calls);
    for _ in 0..calls {
        let start = Instant::now();
        call()?;
        times.push(start.elapsed().as_secs_f64());
    }
    times.sort_by(f64::total_cmp);
    Ok(times.get(calls / 2).copied().unwrap_or(f64::NAN))
}

/// Two balls, beside Tables 3.5 and 3.7.
fn printed_times(context: &Context) -> Result<Table, Failure> {
    let pair = [turned_ball(2.0, -0.6), turned_ball(2.0, 0.6)];
    let exact = median_time(if context.quick { 5 } else { 51 }, || {
        solve_chain(&pair, study::FRICTION, 1.0)?;
        Ok(())
    })?;
    let mut rows = Vec::new();
    let mut row = |name: &str, time: f64, against: &str, printed: f64| {
        rows.push(vec![
            Cell::from(name),
            Cell::fixed(1e9 * time, 0),
            against.into(),
            Cell::Number(printed, printed.to_string()),
            Cell::power(printed / time),
        ]);
    };
    let time = |key: &str| Ok::<f64, Failure>(1e-9 * context.times(key)?.latency.median);
    row(
        "linear bearing, closed form (3.43), (3.51), f32",
        time("pair_analytic")?,
        "analytical formula, Table 3.5",
        5.54e-3,
    );
    row(
        "linear bearing, 1 warm step with friction between balls, f32",
        time("pair_warm_step")?,
        "numerical model, Table 3.5",
        0.74,
    );
    row(
        "linear bearing, start and 3 steps, f32",
        time("pair_cold_3")?,
        "numerical model, Table 3.5",
        0.74,
    );
    row(
        "linear bearing, reference, f64",
        exact,
        "numerical model, Table 3.5",
        0.74,
    );
    Ok(Table {
        name: "pair_times",
        caption: "Two balls that press on each other: time on this machine (latency), and the times that Lin 2019 \
                  prints for an Intel i7-3770"
            .into(),
        columns: [
            "model",
            "time (ns)",
            "printed model",
            "printed time (s)",
            "ratio",
        ]
        .map(String::from)
        .to_vec(),
        rows,
    })
}

fn train_times(context: &Context) -> Result<Table, Failure> {
    let mut rows = Vec::new();
    for (balls, key) in TRAINS {
        let times = context.times(key)?;
        let (low, high) = times.latency.quartiles;
        rows.push(vec![
            Cell::fixed(balls.into(), 0),
            Cell::fixed(times.latency.median, 1),
            Cell::from(format!("{low:.1}-{high:.1}")),
            Cell::fixed(times.throughput.median, 1),
            Cell::fixed(times.latency.median / f64::from(balls), 2),
        ]);
    }
    Ok(Table {
        name: "train_times",
        caption: "Forces of a train from free speeds and compliances (Press::solve): one exact pass, in proportion \
                  to the number of balls"
            .into(),
        columns: [
            "balls",
            "latency (ns)",
            "quartiles",
            "throughput (ns)",
            "latency a ball (ns)",
        ]
        .map(String::from)
        .to_vec(),
        rows,
    })
}

fn picture(context: &Context) -> Result<Figure, Failure> {
    let mut latency = Vec::new();
    let mut throughput = Vec::new();
    for (balls, key) in TRAINS {
        let times = context.times(key)?;
        latency.push((f64::from(balls), times.latency.median));
        throughput.push((f64::from(balls), times.throughput.median));
    }
    Ok(Figure {
        name: "train_times_picture",
        caption: "Time of the forces of a train over its number of balls.".into(),
        panels: vec![Panel::Chart(Chart {
            title: String::new(),
            x: Axis::linear("balls").between(0.0, 66.0),
            y: Axis::linear("time of one pass (ns)"),
            series: vec![
                Series::new("", 0, Mark::Circles, latency.clone()),
                Series::new("latency", 0, Mark::Line, latency),
                Series::new("", 1, Mark::Circles, throughput.clone()),
                Series::new("throughput", 1, Mark::Line, throughput),
            ],
            notes: Vec::new(),
        })],
        columns: 1,
        size: (1080, 380),
    })
}
