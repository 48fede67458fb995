//! The command-line program of `epas-friction`: the error of every formula beside its run time,
//! simulation of manoeuvres, and the `eval` interface for other people's reference data.

// The documentation of arguments is the program's help text, where back-quotes would be noise and
// square brackets are no links.
#![allow(clippy::doc_markdown, rustdoc::broken_intra_doc_links)]

mod cli;
mod designs;
mod eval;
mod failure;
mod files;
mod plot;
mod report;
mod simulate;
mod study;
mod target;
mod timing;

use std::process::ExitCode;

fn main() -> ExitCode {
    match cli::run() {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => failure.report(),
    }
}
