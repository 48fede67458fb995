//! Applications of the static model: Lin 2019, chapter 4.
//!
//! Where the text leaves a parameter out, it is an input here with a stated default, and what comes out is
//! to be compared with the text in kind.
//!
//! Each study computes its points on all cores and calls `tick` after each point; where that returns false,
//! the study ends with [`StudyError::Cancelled`].

pub mod lash;
pub mod scaling;
pub mod tie_rod;
pub mod waviness;

use std::fmt;

use super::solution::StaticError;
use crate::error::ReferenceError;

/// Told of each point that is done; false ends the study.
pub type Tick<'a> = &'a (dyn Fn() -> bool + Sync);

/// For whoever waits without looking.
#[must_use]
pub fn quietly() -> bool {
    true
}

/// Why a study has no result.
#[derive(Clone, Debug, PartialEq)]
pub enum StudyError {
    /// A point has no solution.
    Static(StaticError),
    /// It was told to stop.
    Cancelled,
}

impl From<StaticError> for StudyError {
    fn from(error: StaticError) -> Self {
        Self::Static(error)
    }
}

impl From<ReferenceError> for StudyError {
    fn from(error: ReferenceError) -> Self {
        Self::Static(error.into())
    }
}

impl fmt::Display for StudyError {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Static(error) => error.fmt(formatter),
            Self::Cancelled => formatter.write_str("cancelled"),
        }
    }
}

impl std::error::Error for StudyError {}

fn told(tick: Tick<'_>) -> Result<(), StudyError> {
    if tick() {
        Ok(())
    } else {
        Err(StudyError::Cancelled)
    }
}
