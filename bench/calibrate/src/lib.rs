//! `calibrate`: from a measured trace to constants, with their uncertainty.
//!
//! | module | what |
//! |---|---|
//! | [`estimator`] | the estimator of a drive: one linear least squares, intervals, words |
//! | [`trace`] | a measured trace on one sample clock, in SI units: columns of a file, units, clock, angles without jumps |
//! | [`fit`] | the estimator: parameters that enter linearly eliminated, the few others searched; intervals, profiles, what the rows do not see |
//! | [`experiment`] | which manoeuvre tells a parameter |
//! | [`laws`] | laws of friction of unit level over a motion, and what each costs on the reference core |
//! | [`screw`] | calibration of a trace of a screw whose design is known: the estimator's rows with the law of the ball |
//! | [`without_design`] | calibration of a trace without a design: models of friction, the period of a wave, the closed loop |
//! | [`steady`] | runs at one speed each as one measurement |
//! | [`answer`] | what a calibration answers: parameters with intervals, what cannot be told, scores of models |
//! | [`page`] | the page of a calibration, and what it draws as plain data |
//! | [`outputs`] | what a calibration writes, and where: design file, Rust constants |
//! | [`folder`] | every trace of a folder, and what they have in common |
//! | `command` | arguments, and what is printed |

// For the programs of this workspace: a failure is a sentence, whose causes the sentence names.
#![allow(clippy::missing_errors_doc)]
// The documentation of arguments is the program's help text, where back-quotes would be noise and
// square brackets are no links.
#![allow(
    clippy::doc_markdown,
    rustdoc::broken_intra_doc_links,
    rustdoc::private_intra_doc_links
)]

pub mod answer;
pub mod bristle;
mod command;
pub mod controller;
mod estimator;
mod experiment;
mod fit;
pub mod folder;
mod laws;
pub mod mechanism;
mod models;
pub mod outputs;
pub mod page;
pub mod screw;
mod steady;
pub mod trace;
pub mod without_design;

use std::io::Cursor;

use epas_page::failure::Failure;
use estimator::choice::{Wanted, estimate};

pub use command::{Arguments, run};

/// Reads a trace without a design and with one, and fits a drive to it with one kernel; its number of samples.
pub fn accepts(text: &[u8]) -> Result<usize, String> {
    let frame = trace::columns::Frame {
        lead: Some(7e-3),
        ratio: Some(2.5),
        fastest: Some(2e3),
        rated_torque: None,
    };
    let look = |frame| -> Result<usize, Failure> {
        let trace = trace::columns::from_reader(Cursor::new(text), "trace", frame)?;
        // One kernel in the place of a choice: thousands of inputs are looked at in seconds.
        let kernel = Some((8.0 * trace.step, 0.0));
        let wanted = Wanted {
            kernel,
            ..Wanted::default()
        };
        let found = estimate(&[without_design::record(&trace)], &wanted);
        Ok(trace.len().max(found.map_or(0, |found| found.values.len())))
    };
    // Either may be refused by itself: a length and a torque need a design.
    look(Some(&frame))
        .and(look(None))
        .map_err(|failure| match failure {
            Failure::Data(message) => message,
            other => format!("{other:?}"),
        })
}
