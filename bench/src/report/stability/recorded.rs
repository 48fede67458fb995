//! Recorded runs, too long for every report, from `host-tests/recorded.json`.

use serde::Deserialize;

use crate::report::accuracy::Accuracy;
use crate::report::draw::table;
use crate::report::statistics::Errors;
use epas_page::document::{Block, Cell};
use epas_page::failure::Failure;

const RECORDED: &str = include_str!(concat!(
    env!("CARGO_MANIFEST_DIR"),
    "/../host-tests/recorded.json"
));

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Recorded {
    sweeps: Vec<Sweep>,
    runs: Vec<Run>,
    mended: Vec<Mended>,
    limits: Vec<String>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Sweep {
    quantity: String,
    inputs: u64,
    largest: f64,
    rms: f64,
    mean: f64,
    command: String,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Run {
    what: String,
    count: u64,
    failures: u64,
    command: String,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Mended {
    found: String,
    now: String,
}

fn recorded() -> Result<Recorded, Failure> {
    serde_json::from_str(RECORDED)
        .map_err(|error| Failure::Data(format!("host-tests/recorded.json: {error}")))
}

/// Names of the scalar kernels, and the sweeps over every f32 whose errors are theirs.
const KERNELS: [(&str, &[&str]); 2] = [
    ("cbrt", &["math::cbrt, ulp"]),
    (
        "sin_cos",
        &[
            "math::sin_cos: sin, absolute",
            "math::sin_cos: cos, absolute",
        ],
    ),
];

/// Errors of the scalar kernels over every f32.
pub fn errors() -> Result<Vec<Accuracy>, Failure> {
    let sweeps = recorded()?.sweeps;
    let kernel = |(name, quantities): (&str, &[&str])| {
        let of = |quantity: &&str| sweeps.iter().find(|sweep| sweep.quantity == **quantity);
        let found: Vec<&Sweep> = quantities.iter().filter_map(of).collect();
        if found.len() < quantities.len() {
            return Err(Failure::Data(format!(
                "host-tests/recorded.json has no sweep of {}",
                quantities.join(", ")
            )));
        }
        let over = |of: fn(&Sweep) -> f64| found.iter().map(|sweep| of(sweep)).fold(0.0, f64::max);
        Ok(Accuracy {
            name: name.into(),
            error: format!("{}: every f32 (recorded)", quantities.join(", ")),
            largest: over(|sweep| sweep.largest),
            rms: over(|sweep| sweep.rms),
            flagged: 0.0,
            states: found.iter().map(|sweep| sweep.inputs).sum(),
        })
    };
    KERNELS.into_iter().map(kernel).collect()
}

fn grouped(count: u64) -> Cell {
    let digits = count.to_string();
    let mut text = String::new();
    for (place, digit) in digits.char_indices() {
        if place > 0 && (digits.len() - place).is_multiple_of(3) {
            text.push(' ');
        }
        text.push(digit);
    }
    Cell::Number(count as f64, text)
}

pub fn blocks(swept: &Errors, requests: u64) -> Result<Vec<Block>, Failure> {
    let recorded = recorded()?;
    let sweeps = recorded.sweeps.into_iter().map(|sweep| {
        vec![
            sweep.quantity.into(),
            grouped(sweep.inputs),
            Cell::power(sweep.largest),
            Cell::power(sweep.rms),
            Cell::power(sweep.mean),
            sweep.command.into(),
        ]
    });
    let this = vec![
        format!("{requests} requests of the maps above, in this run").into(),
        grouped(requests),
        grouped(u64::from(!swept.largest.is_finite())),
        "cargo run --release -p epas-bench".into(),
    ];
    let runs = recorded.runs.into_iter().map(|run| {
        vec![
            run.what.into(),
            grouped(run.count),
            grouped(run.failures),
            run.command.into(),
        ]
    });
    Ok(vec![
        Block::Text(
            "Runs that take minutes to hours are recorded with the command that makes each; what this run has \
             swept stands in the last row below, in the column of inputs above, and under Scalar kernels. Failures are \
             panics, numbers that are not finite, torques beyond their limit or with the wrong sign, flags that \
             are missing or wrong, balls that are lost or overlap."
                .into(),
        ),
        Block::Table(table("recorded_sweeps", "Recorded: every f32 of a function's domain against float64", "quantity | inputs | largest | rms | mean | command", sweeps.collect())),
        Block::Table(table("recorded_runs", "Recorded: random, failing and extreme inputs", "what | count | failures | command", runs.chain([this]).collect())),
        Block::Table(table("mended", "What such runs found, and what the same input does now", "found | now", recorded
                .mended
                .into_iter()
                .map(|mended| vec![mended.found.into(), mended.now.into()])
                .collect())),
        Block::Table(table("known_limits", "Limits that are known and remain", "limit", recorded
                .limits
                .into_iter()
                .map(|limit| vec![limit.into()])
                .collect())),
    ])
}
