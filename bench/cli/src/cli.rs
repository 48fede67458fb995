//! Arguments of the program.

use clap::{Arg, CommandFactory as _, FromArgMatches as _, Parser, Subcommand};

use crate::a2l;
use crate::design;
use crate::fmu;
use crate::simulate;
use epas_page::failure::Failure;
use epas_page::progress::Working;

/// Friction of ball screws for electric power steering: a design to a block for firmware, simulation, single evaluations, calibration.
///
/// All numbers are in SI units and radians.
#[derive(Debug, Parser)]
#[command(name = "epas", version)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    Simulate(Box<simulate::Arguments>),
    Design(design::Arguments),
    Calibrate(Box<epas_calibrate::Arguments>),
    Eval(epas_eval::Arguments),
    Fmu(fmu::Arguments),
    A2l(a2l::Arguments),
}

pub fn run() -> Result<(), Failure> {
    let matches = parser().get_matches();
    let command = Cli::from_arg_matches(&matches)
        .unwrap_or_else(|error| error.exit())
        .command;
    let _working = said(&command).map(Working::new);
    match command {
        Command::Simulate(arguments) => simulate::run(&arguments),
        Command::Design(arguments) => design::run(&arguments),
        Command::Calibrate(arguments) => epas_calibrate::run(&arguments),
        Command::Eval(arguments) => epas_eval::run(&arguments),
        Command::Fmu(arguments) => fmu::run(&arguments),
        Command::A2l(arguments) => a2l::run(&arguments),
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
const fn said(command: &Command) -> Option<&'static str> {
    match command {
        Command::Eval(_) => None,
        Command::Simulate(_) => Some("solving the design and simulating ..."),
        Command::Design(_) => Some("folding ..."),
        Command::Calibrate(_) => Some("fitting ..."),
        Command::Fmu(_) => Some("solving the design and building the unit's library ..."),
        Command::A2l(_) => Some("reading the image ..."),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arguments_are_consistent() {
        parser().debug_assert();
    }
}
