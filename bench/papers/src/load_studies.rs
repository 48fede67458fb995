//! Applications of the static model: Lin 2019, chapter 4. Where the text leaves a parameter out, it is an input here with a stated default,
//! and what comes out is to be compared with the text in kind.

pub mod lash;
pub mod tie_rod;

use std::sync::Arc;

use epas_reference::error::ReferenceError;
use epas_reference::statics::cases::CaseStudy;
use epas_reference::statics::problem::StaticLoad;
use epas_reference::statics::solution::StaticSolution;
use epas_reference::statics::surface::HarmonicError;

pub type Tick<'a> = &'a (dyn Fn() + Sync);

/// Error of the screw's grooves: section 4.3.2, Figure 4.10.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Waviness {
    /// Pitch error, once a turn: eq. (4.1).
    Pitch,
    /// Roundness error, twice a turn: eq. (4.3).
    Roundness,
}

impl Waviness {
    /// The loads of a ball screw whose groove has this error with an amplitude, m; printed, 5 um under 1000 N. The text does not say which
    /// ball screw: 25 of 71 balls lose contact by roundness with that of Table 4.1, none with that of Table 2.1.
    pub fn loads(self, case: &CaseStudy, amplitude: f64) -> Result<StaticSolution, ReferenceError> {
        let mut setup = case.setup()?;
        let error = match self {
            Self::Pitch => HarmonicError::pitch(&case.geometry, amplitude),
            Self::Roundness => HarmonicError::roundness(amplitude),
        };
        for surface in &mut setup.errors[..2] {
            surface.push(Arc::new(error));
        }
        StaticLoad::new(setup)?.solve()
    }
}
