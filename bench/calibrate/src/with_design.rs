//! Calibration of a trace of a screw whose design is known: the answer, what its page draws, its sums.

use crate::answer::Calibration;
use crate::folder::answered::Answered;
use crate::page::picture::Picture;
use crate::screw::friction::Screw;
use crate::screw::{Request, ScrewCalibration, calibrate};
use crate::trace::Trace;
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
pub fn told(trace: &Trace, design: &Design, request: &Request) -> Result<Told, Failure> {
    let found = calibrate(trace, design, request)?;
    Ok(Told {
        picture: picture(trace, &found),
        screw: found.screw,
        answer: found.answer,
    })
}

/// One trace of many, with its sums about a reference that is the same for all.
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
    let answered = Answered::of(&found.residual, &found.uncertainty, true)?;
    Ok((found.answer, answered))
}

fn picture(trace: &Trace, found: &ScrewCalibration) -> Picture {
    let measured = (found.measured.clone(), &*found.residual);
    let sure = &found.uncertainty;
    let names = sure.intervals.iter().map(|of| of.name.into()).collect();
    Picture::of(trace, &found.samples, measured, (names, &sure.covariance))
}
