//! The main job of `epas-friction`.

use std::process::ExitCode;

use clap::Parser as _;

fn main() -> ExitCode {
    match epas_bench::report::run(&epas_bench::report::Arguments::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => failure.report(),
    }
}
