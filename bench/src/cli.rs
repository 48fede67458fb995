//! Arguments of the program.

use clap::{Parser, Subcommand};

use crate::eval;
use crate::failure::Failure;
use crate::simulate;

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
    Simulate(Box<simulate::Arguments>),
    Eval(eval::Arguments),
}

/// Reads the arguments and runs what they ask for.
pub fn run() -> Result<(), Failure> {
    match Cli::parse().command {
        Some(Command::Simulate(arguments)) => simulate::run(&arguments),
        Some(Command::Eval(arguments)) => eval::run(&arguments),
        None => { tmp(); Ok(()) }
    }
}
pub fn tmp() {
    for c in crate::timing::compete(400).unwrap_or_default() {
        println!("{:46} {:44} lat {:7.2} [{:6.2} {:6.2}] x{:6.2}  thr {:7.2} [{:6.2} {:6.2}] x{:6.2}", c.group, c.name, c.latency.median, c.latency.quartiles.0, c.latency.quartiles.1, c.ratios.0, c.throughput.median, c.throughput.quartiles.0, c.throughput.quartiles.1, c.ratios.1);
    }
}
