//! The command-line program of `epas-friction`: the error of every formula beside its run time,
//! simulation of manoeuvres, and the `eval` interface for other people's reference data.

// The documentation of arguments is the program's help text, where back-quotes would be noise and
// square brackets are no links.
#![allow(clippy::doc_markdown, rustdoc::broken_intra_doc_links)]
// What only the program calls is there for it.
#![cfg_attr(not(feature = "program"), allow(dead_code, unused))]

#[cfg(feature = "program")]
mod a2l;
mod aside;
#[cfg(feature = "program")]
#[doc(hidden)]
pub mod bindings;
mod bristle;
#[doc(hidden)]
pub mod caged;
#[doc(hidden)]
pub mod calibrate;
#[cfg(feature = "program")]
mod cli;
mod controller;
#[cfg(feature = "program")]
mod design;
mod designs;
mod document;
mod eval;
#[cfg(feature = "program")]
#[doc(hidden)]
pub mod exact_ring;
mod failure;
mod files;
mod flags;
#[doc(hidden)]
pub mod fmu;
mod folder;
mod folds;
mod front;
mod headings;
#[doc(hidden)]
pub mod mdf4;
mod mechanism;
#[cfg(feature = "program")]
mod peers;
mod plot;
mod progress;
#[cfg(feature = "program")]
mod report;
#[cfg(feature = "program")]
mod screws;
mod simulate;
mod source;
#[cfg(feature = "program")]
mod study;
#[cfg(feature = "program")]
mod target;
#[cfg(feature = "program")]
mod timing;
#[doc(hidden)]
pub mod uncaged;
#[doc(hidden)]
pub mod units;

#[cfg(feature = "program")]
use std::process::ExitCode;

/// Runs the program with the arguments of the process.
#[cfg(feature = "program")]
pub fn run() -> ExitCode {
    match cli::run() {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => failure.report(),
    }
}

/// What reads untrusted text, without files: for the fuzz targets.
#[doc(hidden)]
pub mod untrusted {
    /// Answers one line as `eval` does; whether it was a good request.
    pub fn request(line: &str) -> bool {
        epas_eval::accepts(line)
    }

    /// Reads a trace as `simulate --input` does; its number of samples.
    ///
    /// # Errors
    /// What is wrong, with the line.
    pub fn trace(text: &[u8]) -> Result<usize, String> {
        epas_cli::simulate::accepts(text)
    }

    /// Reads a trace as `calibrate` does, without a design and with one, smooths it and looks whether it may be believed;
    /// its number of samples.
    ///
    /// # Errors
    /// What is wrong.
    pub fn calibration_trace(text: &[u8]) -> Result<usize, String> {
        epas_calibrate::accepts(text)
    }

    /// Reads a measurement file as `simulate --input` and `calibrate` do; its number of samples.
    ///
    /// # Errors
    /// What is wrong.
    pub fn measurement(bytes: &[u8]) -> Result<usize, String> {
        let trace = epas_calibrate::trace::columns::measured(bytes, "trace", None, None);
        let simulated = epas_cli::simulate::accepts_measurement(bytes)?;
        trace
            .map(|trace| trace.len().max(simulated))
            .map_err(|failure| format!("{failure:?}"))
    }

    /// Reads a design file as `simulate --design` does.
    ///
    /// # Errors
    /// What is wrong.
    pub fn design(text: &str) -> Result<(), String> {
        epas_design::files::accepts(text)
    }
}
