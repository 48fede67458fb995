//! Calibration of a trace of a screw whose design is known: the answer, what its page draws, its sums.

use crate::answer::Calibration;
use crate::fit::problem::Scale;
use crate::page::picture::{Correlations, Picture};
use crate::screw::friction::Screw;
use crate::screw::quantities::{LINEAR, NONLINEAR};
use crate::screw::{Request, ScrewCalibration, calibrate};
use crate::signals::{Motion, SmoothingSettings};
use crate::sums::{Reference, Sums, SumsError};
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
///
/// # Errors
/// A trace or a request from which nothing can be told.
pub fn told(trace: &Trace, design: &Design, request: &Request) -> Result<Told, Failure> {
    let found = calibrate(trace, design, request)?;
    Ok(Told {
        picture: picture(trace, &found)?,
        screw: found.screw,
        answer: found.answer,
    })
}

/// One trace of many, with its sums about a reference that is the same for all.
///
/// # Errors
/// A trace or a request from which nothing can be told.
pub fn summed(
    trace: &Trace,
    design: &Design,
    request: &Request,
) -> Result<(Calibration, Sums), Failure> {
    let request = Request {
        without_models: true,
        ..request.clone()
    };
    let found = calibrate(trace, design, &request)?;
    let sums = sums(&found).map_err(|error| Failure::Data(error.to_string()))?;
    Ok((found.answer, sums))
}

/// What a calibration adds to those of other traces.
///
/// # Errors
/// Numbers that are not finite.
pub fn sums(found: &ScrewCalibration) -> Result<Sums, SumsError> {
    let nonlinear = NONLINEAR
        .iter()
        .map(|quantity| (quantity.name, quantity.scale));
    let linear = LINEAR.iter().map(|quantity| (quantity.name, Scale::Linear));
    let references = nonlinear.chain(linear).map(|(name, scale)| {
        let logarithmic = scale == Scale::Logarithmic;
        Reference {
            name: name.into(),
            logarithmic,
            value: if logarithmic { 1.0 } else { 0.0 },
        }
    });
    let mut sums = Sums::new(references.collect())?;
    sums.add(&found.residual, &found.uncertainty)?;
    Ok(sums)
}

/// What the page draws.
fn picture(trace: &Trace, found: &ScrewCalibration) -> Result<Picture, Failure> {
    let motion = Motion::of(trace, &SmoothingSettings::default())?;
    let at = |signal: &[f64]| -> Vec<f64> {
        let samples = found.samples.iter();
        samples.map(|sample| signal[*sample]).collect()
    };
    let model = found.measured.iter().zip(&found.residual);
    let names = found.uncertainty.intervals.iter();
    let correlations = found.uncertainty.correlation.row_iter();
    Ok(Picture {
        name: trace.name.clone(),
        coordinate: trace.coordinate,
        time: found
            .samples
            .iter()
            .map(|sample| trace.start + trace.step * *sample as f64)
            .collect(),
        measured: found.measured.clone(),
        model: model.map(|(measured, left)| measured - left).collect(),
        position: at(&motion.position),
        speed: at(&motion.speed),
        load: trace.load.as_deref().map(&at),
        temperature: trace.temperature.as_deref().map(&at),
        correlations: Correlations {
            names: names.map(|interval| interval.name.to_string()).collect(),
            rows: correlations
                .map(|row| row.iter().copied().collect())
                .collect(),
        },
    })
}
