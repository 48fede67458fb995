//! Run time of balls and trains, beside the times that Lin 2019 prints.

use std::time::Instant;

use epas_reference::friction::ball_screw_elastic::ScrewSupport;
use epas_reference::friction::chain::solve_chain;

use crate::report::Context;
use crate::report::draw::{chart, figure, table};
use crate::report::times::{quartiles, time};
use crate::study::{self, turned_ball};
use crate::timing;
use crate::timing::Measure;
use epas_page::document::{Block, Cell, Table};
use epas_page::failure::Failure;
use epas_page::plot::{Axis, Mark, Series};

/// Balls of each timed train.
const TRAINS: [u8; 9] = [1, 2, 4, 8, 16, 32, 37, 48, 64];

/// Latency of the forces of a train, of its tick, and of the tick of its scene.
fn latencies(context: &Context, balls: u8) -> Result<[&Measure; 3], Failure> {
    let of = |kind: &str| -> Result<&Measure, Failure> {
        let key = format!("{kind}_{balls}");
        Ok(&timing::times(&context.competition, &key)?.latency)
    };
    Ok([of("press")?, of("train")?, of("step_train")?])
}

const PARTS: [&str; 3] = [
    "forces alone, from speeds that vary from ball to ball",
    "forces and positions, from speeds of a run",
    "whole tick of the screw",
];

pub fn blocks(context: &Context) -> Result<Vec<Block>, Failure> {
    Ok(vec![
        Block::Table(printed_times(context)?),
        Block::Table(train_times(context)?),
        picture(context)?,
    ])
}

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
        "model | time (ns) | printed model | printed time (s) | ratio",
        rows,
    ))
}

fn train_times(context: &Context) -> Result<Table, Failure> {
    let mut rows = Vec::new();
    for balls in TRAINS {
        let latencies = latencies(context, balls)?;
        let mut row = vec![Cell::fixed(balls.into(), 0)];
        for latency in latencies {
            row.extend([time(latency, 1), quartiles(latency, 1)]);
        }
        row.push(share(latencies[2], balls));
        rows.push(row);
    }
    Ok(table(
        "train_times",
        "Latency in ns of a train: its forces from free speeds and impedances that vary from ball to ball (`Press::solve`, one exact pass), \
                  forces and positions from speeds of a run, where fewer balls press (`Train::step`), and of a tick of the ball screw without cage that holds it; \
                  quartiles, and the latency of the tick for each ball",
        "balls | forces | quartiles | forces and positions | quartiles | whole tick | \
         quartiles | tick, a ball",
        rows,
    ))
}

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
        for balls in TRAINS {
            let latency = latencies(context, balls)?[colour];
            points.push((f64::from(balls), latency.at_least_resolved()));
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
