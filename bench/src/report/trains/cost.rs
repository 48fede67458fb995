//! Run time of balls and trains, beside the times that Lin 2019 prints.

use std::time::Instant;

use epas_reference::friction::ball_screw_elastic::ScrewSupport;
use epas_reference::friction::chain::solve_chain;

use crate::report::context::Context;
use crate::report::draw::{chart, figure, table};
use crate::report::times::{quartiles, time};
use crate::study::{self, turned_ball};
use crate::timing;
use crate::timing::Measure;
use epas_page::document::{Block, Cell, Table};
use epas_page::failure::Failure;
use epas_page::plot::{Axis, Mark, Series};

/// Balls of each timed train, and the keys of its forces, its tick and the tick of its scene.
const TRAINS: [(u8, [&str; 3]); 9] = [
    (1, ["press_1", "train_1", "step_train_1"]),
    (2, ["press_2", "train_2", "step_train_2"]),
    (4, ["press_4", "train_4", "step_train_4"]),
    (8, ["press_8", "train_8", "step_train_8"]),
    (16, ["press_16", "train_16", "step_train_16"]),
    (32, ["press_32", "train_32", "step_train_32"]),
    (37, ["press_37", "train_37", "step_train_37"]),
    (48, ["press_48", "train_48", "step_train_48"]),
    (64, ["press_64", "train_64", "step_train_64"]),
];

/// What the keys time.
const PARTS: [&str; 3] = [
    "forces alone, from speeds that vary from ball to ball",
    "forces and positions, from speeds of a run",
    "whole tick of the screw",
];

/// Tables and figures.
pub fn blocks(context: &Context) -> Result<Vec<Block>, Failure> {
    Ok(vec![
        Block::Table(printed_times(context)?),
        Block::Table(train_times(context)?),
        picture(context)?,
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
            Cell::power(1e9 * time),
            against.into(),
            Cell::Number(printed, printed.to_string()),
            Cell::power(printed / time),
        ]);
    };
    let screw = study::screw_pair([0.0, 2.0])?;
    let exact_screw = median_time(if context.quick { 1 } else { 11 }, || {
        screw.solve(ScrewSupport::Load(-100.0))?;
        Ok(())
    })?;
    let time = |key: &str| {
        Ok::<f64, Failure>(
            1e-9 * timing::times(&context.competition, key)?
                .latency
                .at_least_resolved(),
        )
    };
    row(
        "linear bearing, closed form (3.43), (3.51), f32",
        time("pair_analytic")?,
        "analytical formula, Table 3.5",
        5.54e-3,
    );
    row(
        "linear bearing, reference, f64",
        exact,
        "numerical model, Table 3.5",
        0.74,
    );
    const SCREW: &str = "numerical model, Table 3.7";
    row(
        "ball screw, closed form, f32",
        time("screw_row_pair")?,
        SCREW,
        15.0,
    );
    row("ball screw, reference, f64", exact_screw, SCREW, 15.0);
    row(
        "ball screw without cage, tick of 37 balls, f32",
        time("step_train_37")?,
        "numerical model of two balls, Table 3.7",
        15.0,
    );
    Ok(table(
        "pair_times",
        "Two balls that press on each other: time on this machine (latency), and the times that Lin 2019 \
                  prints for an Intel i7-3770",
        &[
            "model",
            "time (ns)",
            "printed model",
            "printed time (s)",
            "ratio",
        ],
        rows,
    ))
}

fn train_times(context: &Context) -> Result<Table, Failure> {
    let mut rows = Vec::new();
    for (balls, keys) in TRAINS {
        let mut row = vec![Cell::fixed(balls.into(), 0)];
        for key in keys {
            let times = timing::times(&context.competition, key)?;
            row.push(time(&times.latency, 1));
            row.push(quartiles(&times.latency, 1));
        }
        row.push(share(
            &timing::times(&context.competition, keys[2])?.latency,
            balls,
        ));
        rows.push(row);
    }
    Ok(table(
        "train_times",
        "Latency in ns of a train: its forces from free speeds and impedances that vary from ball to ball (`Press::solve`, one exact pass), \
                  forces and positions from speeds of a run, where fewer balls press (`Train::step`), and of a tick of the ball screw without cage that holds it; \
                  quartiles, and the latency of the tick for each ball",
        &[
            "balls",
            "forces",
            "quartiles",
            "forces and positions",
            "quartiles",
            "whole tick",
            "quartiles",
            "tick, a ball",
        ],
        rows,
    ))
}

/// A ball's part of a time, ns.
fn share(whole: &Measure, balls: u8) -> Cell {
    if whole.is_resolved() {
        Cell::fixed(whole.median / f64::from(balls), 1)
    } else {
        "".into()
    }
}

fn picture(context: &Context) -> Result<Block, Failure> {
    let mut series = Vec::new();
    for (colour, part) in PARTS.into_iter().enumerate() {
        let mut points = Vec::new();
        for (balls, keys) in TRAINS {
            points.push((
                f64::from(balls),
                timing::times(&context.competition, keys[colour])?
                    .latency
                    .at_least_resolved(),
            ));
        }
        series.push(Series::new("", colour, Mark::Circles, points.clone()));
        series.push(Series::new(part, colour, Mark::Line, points));
    }
    Ok(figure(
        "train_times_picture",
        "Latency of a train over its number of balls: in proportion to it, without an iteration.",
        (1, 1080, 380),
        vec![chart(
            "",
            Axis::linear("balls").between(0.0, 66.0),
            Axis::linear("latency (ns)"),
            series,
        )],
    ))
}
