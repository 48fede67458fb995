//! Arguments of the program.

use clap::{Arg, CommandFactory as _, FromArgMatches as _, Parser, Subcommand};

use crate::a2l;
use crate::calibrate;
use crate::design;
use crate::eval;
use crate::failure::Failure;
use crate::fmu;
use crate::progress::Working;
use crate::report;
use crate::screws;
use crate::simulate;
use crate::target;

/// Friction of ball screws for electric power steering: error against run time of every formula,
/// simulation of manoeuvres, single evaluations.
///
/// All numbers are in SI units and radians. Without a subcommand the report is made.
#[derive(Debug, Parser)]
#[command(name = "epas-bench", version)]
struct Cli {
    #[command(subcommand)]
    command: Option<Command>,
}

#[derive(Debug, Subcommand)]
enum Command {
    Report(report::Arguments),
    Simulate(Box<simulate::Arguments>),
    Design(design::Arguments),
    Calibrate(Box<calibrate::Arguments>),
    Eval(eval::Arguments),
    Target(target::Arguments),
    Screws(screws::Arguments),
    Fmu(fmu::Arguments),
    A2l(a2l::Arguments),
}

/// Reads the arguments and runs what they ask for.
pub fn run() -> Result<(), Failure> {
    let matches = parser().get_matches();
    let command = Cli::from_arg_matches(&matches)
        .unwrap_or_else(|error| error.exit())
        .command;
    let _working = said(command.as_ref()).map(Working::new);
    match command {
        Some(Command::Simulate(arguments)) => simulate::run(&arguments),
        Some(Command::Design(arguments)) => design::run(&arguments),
        Some(Command::Calibrate(arguments)) => calibrate::run(&arguments),
        Some(Command::Eval(arguments)) => eval::run(&arguments),
        Some(Command::Target(arguments)) => target::run(&arguments),
        Some(Command::Screws(arguments)) => screws::run(&arguments),
        Some(Command::Fmu(arguments)) => fmu::run(&arguments),
        Some(Command::A2l(arguments)) => a2l::run(&arguments),
        Some(Command::Report(arguments)) => report::run(&arguments),
        None => report::run(&report::Arguments::default()),
    }
}

/// A number below zero is an option's value, and is told its range; it is no option.
fn parser() -> clap::Command {
    let of_option = |argument: Arg| {
        let list = argument.get_id() == "axial_load";
        let number = !argument.is_positional() && argument.get_action().takes_values();
        argument
            .allow_negative_numbers(number)
            .allow_hyphen_values(list)
    };
    Cli::command().mut_subcommands(move |command| command.mut_args(of_option))
}

/// What a command says after a second. The answers of `eval` come one by one.
fn said(command: Option<&Command>) -> Option<&'static str> {
    match command {
        // A report tells its stages from the first moment on.
        Some(Command::Eval(_) | Command::Report(_)) | None => None,
        Some(Command::Simulate(_)) => Some("solving the design and simulating ..."),
        Some(Command::Design(_)) => Some("folding ..."),
        Some(Command::Calibrate(_)) => Some("fitting ..."),
        Some(Command::Target(_)) => Some(
            "building the firmware and counting its instructions: some minutes the first time ...",
        ),
        Some(Command::Screws(_)) => Some("computing whole screws ..."),
        Some(Command::Fmu(_)) => Some("solving the design and building the unit's library ..."),
        Some(Command::A2l(_)) => Some("reading the image ..."),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn without_a_subcommand_the_report_has_its_defaults() {
        parser().debug_assert();
        assert!(Cli::parse_from(["epas-bench"]).command.is_none());
        let named = Cli::parse_from(["epas-bench", "report"]).command;
        assert!(
            matches!(named, Some(Command::Report(named)) if named == report::Arguments::default())
        );
    }
}
