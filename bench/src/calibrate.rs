//! `calibrate`: from a measured trace to constants, with their uncertainty.
//!
//! | module | what |
//! |---|---|
//! | [`answer`] | what a calibration answers: parameters with intervals, what cannot be told, scores of models |
//! | [`trace`] | a measured trace on one sample clock, in SI units |
//! | [`columns`] | reads a trace from a CSV file |
//! | [`table`] | the file's numbers in SI units |
//! | [`units`] | what a column's name says |
//! | [`clock`] | one sample clock: tick, gaps, jitter |
//! | [`channels`] | angles without jumps, the step of a sensor |
//! | [`checks`] | whether a trace may be believed |
//! | [`excitation`] | what a trace excites |
//! | [`relation`] | how effort and motion go together, roughly |
//! | [`finding`] | what a trace does not tell |
//! | [`filter`] | a low-pass filter without a shift in time |
//! | [`noise`] | noise of smoothed motion |
//! | [`signals`] | smoothed motion, and the rows of a regression |
//! | [`problem`] | what is fitted: parameters that enter linearly, and the few others |
//! | [`separable`] | the fit: linear parameters eliminated, Levenberg-Marquardt for the others, several starts |
//! | [`uncertainty`] | intervals, correlations, the direction that the rows do not see |
//! | [`telling`] | what the trace cannot tell, in sentences |
//! | [`profile`] | how the residual grows when a parameter is held elsewhere |
//! | [`cramer_rao`] | the least covariance that any estimator can have |
//! | [`experiment`] | which manoeuvre tells a parameter |
//! | [`manoeuvre`] | manoeuvres to choose from |
//! | [`sums`] | what many traces say together, as sums that merge |
//! | [`autocorrelation`] | how far the rows of a residual repeat each other |
//! | [`screw`] | a trace of a screw whose design is known |
//! | [`picture`] | what the page of a calibration draws, as plain data |
//! | [`spectrum`], [`shown`] | power spectral density; numbers as they are shown |
//! | [`page`] | the page of a calibration |
//! | [`design_file`] | the user's design file with the calibrated numbers |
//! | [`firmware`] | what firmware takes of a calibrated design, as plain numbers |
//! | [`outputs`] | what a calibration writes, and where |
//! | [`constants`] | the same as Rust constants for firmware |
//! | `folder` | every trace of a folder, and what they have in common |
//! | [`separable`] | the fit: linear parameters eliminated, Levenberg-Marquardt for the others, several starts |
//! | [`uncertainty`] | intervals, correlations, the direction that the rows do not see |
//! | [`autocorrelation`] | how far the rows of a residual repeat each other |
//! | [`laws`] | laws of friction of unit level over a motion |
//! | [`slide`] | a trace without a design as a separable problem |
//! | [`choice`] | models of friction on a trace without a design |
//! | [`part`] | a part of a problem's rows |
//! | [`cost`] | cost of a law on the reference core |

pub mod answer;
pub mod autocorrelation;
pub mod channels;
pub mod checks;
pub mod choice;
#[cfg(test)]
mod checks_tests;
pub mod clock;
pub mod closed_loop;
pub mod columns;
#[cfg(test)]
mod columns_tests;
pub mod controller;
pub mod cost;
mod design_file;
mod design_file;
pub mod excitation;
pub mod filter;
pub mod finding;
pub mod laws;
pub mod noise;
pub mod part;
pub mod period;
pub mod constants;
pub mod design_file;
pub mod filter;
pub mod finding;
pub mod firmware;
pub mod noise;
pub mod outputs;
pub mod page;
pub mod picture;
pub mod problem;
pub mod relation;
pub mod screw;
pub mod separable;
pub mod shown;
pub mod signals;
pub mod slide;
pub mod table;
pub mod cramer_rao;
mod design_file;
pub mod experiment;
pub mod filter;
pub mod finding;
pub mod manoeuvre;
pub mod noise;
pub mod picture;
pub mod problem;
pub mod profile;
pub mod separable;
mod shown;
pub mod signals;
pub mod sums;
pub mod table;
pub mod telling;
pub mod spectrum;
pub mod table;
#[cfg(test)]
mod toys;
pub mod trace;
pub mod uncertainty;
pub mod units;
pub mod without_design;

use std::io::{self, Write};
use std::path::PathBuf;

use crate::controller::Controller;
use crate::failure::Failure;
use answer::Calibration;
use without_design::{Filters, Told};

/// Fits a model to a measured trace, and says how sure it is and what the trace cannot tell.
///
/// The trace is a CSV file with the columns time; position or speed (of the nut, or with motor_ or carriage_ before it);
/// motor_torque or motor_force; and where there are any reference_position, axial_load, temperature. Units are SI (rad, m, N, N m, K);
/// others stand in the column's name: nut_position_deg, motor_speed_rpm, temperature_C.
///
/// Without a design a mass or an inertia with load-free friction is fitted, in the trace's own coordinate, and models of
/// friction are compared on what was not fitted: another trace (--validate), or the last third of this one. With --controller they are
/// compared by the simulated closed loop.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// Measured trace
    #[arg(value_name = "TRACE.csv")]
    trace: PathBuf,
    /// Trace that is not fitted, by which models are scored
    #[arg(long, value_name = "OTHER.csv")]
    validate: Option<PathBuf>,
    /// Controller of the trace: force = V (P (reference_position - position) - speed); where it has its speed from is found
    #[arg(long, value_name = "gain_position=P,gain_speed=V")]
    controller: Option<Controller>,
    /// Cut-off of the zero-phase filter of the motion, Hz [default: 100, less where the sensor is coarse]
    #[arg(long, value_name = "HZ")]
    smoothing: Option<f64>,
    /// Cut-off of the zero-phase filter of both sides of the regression, Hz [default: 40]
    #[arg(long, value_name = "HZ")]
    rows: Option<f64>,
    /// Print one JSON object
    #[arg(long)]
    json: bool,
}

/// Calibrates a trace.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let trace = columns::read(&arguments.trace, None)?;
    let unseen = arguments
        .validate
        .as_deref()
        .map(|path| columns::read(path, None))
        .transpose()?;
    let filters = Filters {
        smoothing: arguments.smoothing,
        rows: arguments.rows,
    };
    let told = without_design::calibrate(&trace, unseen.as_ref(), arguments.controller, &filters)?;
    let mut stdout = io::stdout().lock();
    if arguments.json {
        let text = serde_json::to_string(&told.answer)
            .map_err(|error| Failure::Data(error.to_string()))?;
        writeln!(stdout, "{text}")?;
    } else {
        print(&mut stdout, &told)?;
    }
    Ok(())
}

fn print(out: &mut impl Write, told: &Told) -> Result<(), Failure> {
    let Calibration {
        parameters,
        residual_rms,
        relative_error,
        cannot_tell,
        models,
        winner,
        ..
    } = &told.answer;
    for estimate in parameters {
        writeln!(
            out,
            "{:28} {:12.5} {:10} ({:.5} to {:.5})",
            estimate.name, estimate.value, estimate.unit, estimate.low, estimate.high
        )?;
    }
    writeln!(
        out,
        "residual {residual_rms:.5}, {:.3} % of the effort",
        100.0 * relative_error
    )?;
    if let Some(controller) = &told.controller {
        writeln!(
            out,
            "controller: its speed is {}",
            controller.source.words()
        )?;
    }
    writeln!(
        out,
        "\n{:60} {:>9} {:>9} {:>9} {:>9} {:>6} {:>7}",
        "model", "error %", "unseen %", "rows %", "unseen %", "par.", "cycles"
    )?;
    for model in models {
        let percent = |value: Option<f64>| {
            value.map_or_else(String::new, |value| format!("{:.3}", 100.0 * value))
        };
        writeln!(
            out,
            "{:60} {:>9} {:>9} {:>9} {:>9} {:>6} {:>7}",
            model.name,
            percent(Some(model.relative_error)),
            percent(model.relative_error_unseen),
            percent(Some(model.relative_error_inverse)),
            percent(model.relative_error_inverse_unseen),
            model.parameters,
            model
                .cycles
                .map_or_else(String::new, |cycles| cycles.to_string()),
        )?;
    }
    if let Some(winner) = winner {
        writeln!(out, "best on what was not fitted: {winner}")?;
    }
    for sentence in cannot_tell {
        writeln!(out, "cannot tell: {sentence}")?;
    }
    Ok(())
}
