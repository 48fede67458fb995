//! Writes a synthetic trace of a steering gear's screw (lin-4.1) as CSV: something to try `calibrate` on. Lines above the headings say what it was
//! made with; readers of traces skip them, and the page of a calibration shows it beside what was found.
//!
//! ```text
//! cargo run --release -p epas-rig -- [whole|vehicle|rig] [SEED] [other-physics] > trace.csv
//! ```

use std::io::{Write as _, stdout};
use std::process::ExitCode;

use epas_rig::Rig;
use epas_rig::course::Course;
use epas_rig::parameters::Parameters;

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
    let mut out = stdout().lock();
    let truth = parameters.header();
    let rig = Rig::new(parameters).map_err(|error| error.to_string())?;
    let trace = rig.run(&course, seed).map_err(|error| error.to_string())?;
    let written = out.write_all(truth.as_bytes());
    written.map_err(|error| error.to_string())?;
    trace.write_csv(out).map_err(|error| error.to_string())
}
