//! Tables and figures of the four papers, rivals and long studies.

use std::process::ExitCode;

use clap::{Parser, Subcommand};
use epas_papers::{report, screws};

/// Tables and figures of the four papers, made anew; rivals and long studies.
///
/// Without a subcommand the page of the papers is made.
#[derive(Debug, Parser)]
#[command(name = "epas-papers", version, args_conflicts_with_subcommands = true)]
struct Cli {
    #[command(flatten)]
    page: report::Arguments,
    #[command(subcommand)]
    study: Option<Study>,
}

#[derive(Debug, Subcommand)]
enum Study {
    Screws(screws::Arguments),
}

fn main() -> ExitCode {
    let Cli { page, study } = Cli::parse();
    let done = match study {
        Some(Study::Screws(arguments)) => screws::run(&arguments),
        None => report::run(&page),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => failure.report(),
    }
}
