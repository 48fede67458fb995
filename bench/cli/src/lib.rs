//! The program `epas`: a design to a block for firmware, simulation of manoeuvres and traces, single evaluations beside the exact model,
//! calibration from measured traces, co-simulation units.

// The documentation of arguments is the program's help text, where back-quotes would be noise and
// square brackets are no links.
#![allow(
    clippy::doc_markdown,
    rustdoc::broken_intra_doc_links,
    rustdoc::private_intra_doc_links
)]
// For the programs of this workspace: a failure is a sentence, whose causes the sentence names.
#![allow(clippy::missing_errors_doc)]

mod a2l;
pub mod bindings;
mod cli;
mod design;
pub mod design_study;
pub mod fmu;
mod model;
pub mod simulate;

use std::process::ExitCode;

/// Runs the program with the arguments of the process.
pub fn run() -> ExitCode {
    match cli::run() {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => failure.report(),
    }
}

/// What reads untrusted text, without files: for the fuzz targets.
pub mod untrusted {
    /// Answers one line as `eval` does; whether it was a good request.
    pub fn request(line: &str) -> bool {
        epas_eval::accepts(line)
    }

    /// Reads a trace as `simulate --input` does; its number of samples.
    pub fn trace(text: &[u8]) -> Result<usize, String> {
        crate::simulate::accepts(text)
    }

    /// Reads a trace as `calibrate` does, without a design and with one, and calibrates it as a drive;
    /// its number of samples.
    pub fn calibration_trace(text: &[u8]) -> Result<usize, String> {
        epas_calibrate::accepts(text)
    }

    /// Reads a measurement file as `simulate --input` and `calibrate` do; its number of samples.
    pub fn measurement(bytes: &[u8]) -> Result<usize, String> {
        let trace = epas_calibrate::trace::columns::measured(bytes, "trace", None, None);
        let simulated = crate::simulate::accepts_measurement(bytes)?;
        trace
            .map(|trace| trace.len().max(simulated))
            .map_err(|failure| format!("{failure:?}"))
    }

    /// Reads a design file as `simulate --design` does.
    pub fn design(text: &str) -> Result<(), String> {
        epas_design::files::accepts(text)
    }
}
