//! `calibrate`: arguments, and what is printed.

use std::io::{self, Write};
use std::path::PathBuf;

use super::answer::Calibration;
use super::columns;
use super::without_design::{self, Filters, Told};
use crate::controller::Controller;
use crate::failure::Failure;

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
