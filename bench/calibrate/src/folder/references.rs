//! The point about which sums of a screw's traces are made: the same for all traces, and not far from any screw.

use crate::fit::problem::Scale;
use crate::fit::uncertainty::Uncertainty;
use crate::screw::quantities::{LINEAR, NONLINEAR};
use crate::sums::{Reference, Sums, SumsError};
use epas_page::failure::Failure;

/// What a screw usually has. Sums about it keep their digits: any other point would do.
const USUAL: [(&str, f64); 4] = [
    ("friction", 0.1),
    ("half_share_speed", 5.0),
    ("preload", 20.0),
    ("breakaway_angle", 1e-3),
];

/// Everything that a trace of a screw may tell.
pub fn of_screw() -> Vec<Reference> {
    let nonlinear = NONLINEAR.iter().map(|of| {
        let logarithmic = of.scale == Scale::Logarithmic;
        (of.name, logarithmic)
    });
    nonlinear
        .chain(LINEAR.iter().map(|of| (of.name, false)))
        .map(|(name, logarithmic)| {
            let usual = USUAL.iter().find(|(known, _)| *known == name);
            let other = if logarithmic { 1.0 } else { 0.0 };
            Reference {
                name: name.into(),
                logarithmic,
                value: usual.map_or(other, |(_, value)| *value),
            }
        })
        .collect()
}

/// What one trace's fit adds to the population: nothing where it leaves a parameter without a finite error.
///
/// # Errors
/// Parameters that the references do not have.
pub fn sums(
    references: Vec<Reference>,
    residual: &[f64],
    sure: &Uncertainty,
) -> Result<Sums, Failure> {
    let refused = |error: SumsError| Failure::Data(format!("population: {error}"));
    let mut sums = Sums::new(references).map_err(refused)?;
    match sums.add(residual, sure) {
        Ok(()) | Err(SumsError::NotFinite(_)) => Ok(sums),
        Err(error) => Err(refused(error)),
    }
}
