//! What epas-friction costs on a Cortex-M4F.

use std::process::ExitCode;

use clap::Parser as _;

fn main() -> ExitCode {
    match epas_target::run(&epas_target::Arguments::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => failure.report(),
    }
}
