//! `calibrate`: from a measured trace to constants, with their uncertainty.
//!
//! | module | what |
//! |---|---|
//! | [`answer`] | what a calibration answers: parameters with intervals, what cannot be told, scores of models |
//! | [`trace`] | a measured trace on one sample clock, in SI units |
//! | [`columns`] | reads a trace from a CSV file |
//! | [`table`] | the file's numbers in SI units |
//! | [`clock`] | one sample clock: tick, gaps, jitter |
//! | [`channels`] | angles without jumps, the step of a sensor |
//! | [`checks`] | whether a trace may be believed |
//! | [`excitation`] | what a trace excites |
//! | [`relation`] | how effort and motion go together, roughly |
//! | [`finding`] | what a trace does not tell |
//! | [`filter`] | a low-pass filter without a shift in time |
//! | [`noise`] | noise of smoothed motion |
//! | [`signals`] | smoothed motion, and the rows of a regression |
//! | [`problem`] | what is fitted: parameters that enter linearly, and the few others |
//! | [`separable`] | the fit: linear parameters eliminated, Levenberg-Marquardt for the others, several starts |
//! | [`uncertainty`] | intervals, correlations, the direction that the rows do not see |
//! | [`telling`] | what the trace cannot tell, in sentences |
//! | [`profile`] | how the residual grows when a parameter is held elsewhere |
//! | [`cramer_rao`] | the least covariance that any estimator can have |
//! | [`experiment`] | which manoeuvre tells a parameter |
//! | [`manoeuvre`] | manoeuvres to choose from |
//! | [`sums`] | what many traces say together, as sums that merge |
//! | [`autocorrelation`] | how far the rows of a residual repeat each other |
//! | [`screw`] | a trace of a screw whose design is known |
//! | [`picture`] | what the page of a calibration draws, as plain data |
//! | [`spectrum`], [`shown`] | power spectral density; numbers as they are shown |
//! | [`page`] | the page of a calibration |
//! | [`design_file`] | the user's design file with the calibrated numbers |
//! | [`firmware`] | what firmware takes of a calibrated design, as plain numbers |
//! | [`outputs`] | what a calibration writes, and where |
//! | [`constants`] | the same as Rust constants for firmware |
//! | [`folder`] | every trace of a folder, and what they have in common |
//! | [`laws`] | laws of friction of unit level over a motion |
//! | [`slide`] | a trace without a design as a separable problem |
//! | [`choice`] | models of friction on a trace without a design |
//! | [`part`] | a part of a problem's rows |
//! | `wanted` | which manoeuvre tells a parameter of a screw |
//! | [`with_design`] | calibration of a trace of a screw whose design is known |
//! | [`without_design`] | calibration of a trace without a design |
//! | `command` | arguments, and what is printed |
//! | [`cost`] | cost of a law on the reference core |

pub mod answer;
pub mod autocorrelation;
pub mod channels;
pub mod checks;
#[cfg(test)]
mod checks_tests;
pub mod choice;
pub mod clock;
pub mod closed_loop;
pub mod columns;
#[cfg(test)]
mod columns_tests;
mod command;
pub mod constants;
pub mod controller;
pub mod cost;
pub mod cramer_rao;
pub mod design_file;
pub mod excitation;
pub mod experiment;
pub mod filter;
pub mod finding;
pub mod firmware;
pub mod folder;
pub mod laws;
pub mod manoeuvre;
pub mod noise;
pub mod outputs;
pub mod page;
pub mod part;
pub mod period;
pub mod picture;
pub mod problem;
pub mod profile;
pub mod relation;
pub mod screw;
pub mod separable;
pub mod shown;
pub mod signals;
#[cfg(test)]
mod signals_tests;
pub mod slide;
pub mod spectrum;
pub mod sums;
pub mod table;
pub mod telling;
#[cfg(test)]
mod toys;
pub mod trace;
pub mod uncertainty;
mod wanted;
pub mod with_design;
pub mod without_design;

use std::io::Cursor;

use crate::failure::Failure;

pub use command::{Arguments, run};

/// Reads a trace without a design and with one, smooths it and looks whether it may be believed; its number of samples.
pub(crate) fn accepts(text: &[u8]) -> Result<usize, String> {
    let frame = columns::Frame {
        lead: 7e-3,
        ratio: 2.5,
    };
    let look = |frame| -> Result<usize, Failure> {
        let trace = columns::from_reader(Cursor::new(text), "trace", frame)?;
        let motion = signals::Motion::of(&trace, &signals::SmoothingSettings::default())?;
        let rows = signals::Rows::new(trace.step, &signals::RowSettings::default())?;
        let rows = rows.of(&motion.speed);
        checks::examine(&trace, &motion)?;
        checks::load_gain(&trace, &motion, 1e-3)?;
        Ok(trace.len().max(rows.len()))
    };
    // Either may be refused by itself: a length and a torque need a design.
    look(Some(&frame))
        .and(look(None))
        .map_err(|failure| match failure {
            Failure::Data(message) => message,
            other => format!("{other:?}"),
        })
}
