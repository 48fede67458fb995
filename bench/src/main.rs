//! The command-line program of `epas-friction`.

use std::process::ExitCode;

fn main() -> ExitCode {
    epas_bench::run()
}
