//! Calibration of a trace of a screw whose design is known: the answer, what its page draws, what it adds to other traces.

use crate::answer::Calibration;
use crate::folder::answered::Answered;
use crate::page::picture::Picture;
use crate::screw::friction::Screw;
use crate::screw::{Request, ScrewCalibration, calibrate};
use crate::signals::{Motion, Rows};
use crate::trace::Trace;
use crate::trace::known::placed;
use epas_design::files::Design;
use epas_page::failure::Failure;

/// What a trace tells of a screw.
pub struct Told {
    /// The answer.
    pub answer: Calibration,
    /// What its page draws.
    pub picture: Picture,
    /// The screw that was fitted.
    pub screw: Screw,
}

/// Calibrates a trace of a screw, with models of friction beside each other.
///
/// # Errors
/// A trace or a request from which nothing can be told.
pub fn told(trace: &Trace, design: &Design, request: &Request) -> Result<Told, Failure> {
    let found = calibrate(trace, design, request)?;
    Ok(Told {
        picture: picture(trace, request, &found)?,
        screw: found.screw,
        answer: found.answer,
    })
}

/// One trace of many, with what it adds to the others.
///
/// # Errors
/// A trace or a request from which nothing can be told.
pub fn summed(
    trace: &Trace,
    design: &Design,
    request: &Request,
) -> Result<(Calibration, Answered), Failure> {
    let request = Request {
        without_models: true,
        ..request.clone()
    };
    let found = calibrate(trace, design, &request)?;
    let answered = Answered::of(&found.fit.residual, &found.uncertainty, true)?;
    Ok((found.answer, answered))
}

/// What the page draws.
fn picture(trace: &Trace, request: &Request, found: &ScrewCalibration) -> Result<Picture, Failure> {
    let motion = Motion::of(trace, &request.smoothing)?;
    let trace = &*placed(trace, &motion);
    let rows = Rows::of_trace(trace, &request.rows)?;
    let samples: Vec<usize> = rows.samples(trace.len()).collect();
    let measured = (rows.of(&trace.acting()), &*found.fit.residual);
    let sure = &found.uncertainty;
    Ok(Picture::of(trace, &motion, &samples, measured, sure))
}
