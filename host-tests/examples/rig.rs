//! Writes a synthetic trace of a steering gear's screw (lin-4.1) as CSV: something to try `calibrate` on.
//!
//! ```text
//! cargo run --release -p epas-reference --example rig -- [whole|vehicle|rig] [SEED] [other-physics] > trace.csv
//! ```

use std::io::stdout;
use std::process::ExitCode;

use epas_reference::rig::course::Course;
use epas_reference::rig::parameters::Parameters;
use epas_reference::rig::{Rig, Sensors};

fn main() -> ExitCode {
    match run() {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("{message}");
            ExitCode::FAILURE
        }
    }
}

fn run() -> Result<(), String> {
    let (mut course, mut seed, mut parameters) = (Course::whole(), 0, Parameters::default());
    for argument in std::env::args().skip(1) {
        match argument.as_str() {
            "whole" => course = Course::whole(),
            "vehicle" => course = Course::vehicle(),
            "rig" => course = Course::rig(),
            "other-physics" => parameters = Parameters::other_physics(),
            other => {
                seed = other.parse().map_err(|_| {
                    format!("{other}: neither whole, vehicle, rig, other-physics nor a seed")
                })?;
            }
        }
    }
    let rig = Rig::new(parameters, Sensors::default()).map_err(|error| error.to_string())?;
    let trace = rig.run(&course, seed).map_err(|error| error.to_string())?;
    trace
        .write_csv(stdout().lock())
        .map_err(|error| error.to_string())
}
