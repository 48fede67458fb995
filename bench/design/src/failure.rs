//! Why a design is not folded.

use std::fmt;

use epas_friction::Error;
use epas_reference::ReferenceError;

/// Why a design is not folded.
#[derive(Debug)]
pub enum Failure {
    /// A number of the design or of the fold is out of range.
    Field(Error),
    /// The exact solver refuses the design.
    Reference(ReferenceError),
    /// What was asked for is contradictory or cannot be held, with the reason.
    Domain(String),
    /// A file cannot be written.
    File(std::io::Error),
}

impl Failure {
    /// The same failure of something with a name.
    #[must_use]
    pub fn of(self, name: &str) -> Self {
        Self::Domain(format!("{name}: {self}"))
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Field(error) => error.fmt(f),
            Self::Reference(error) => error.fmt(f),
            Self::Domain(reason) => f.write_str(reason),
            Self::File(error) => error.fmt(f),
        }
    }
}

impl std::error::Error for Failure {}

impl From<Error> for Failure {
    fn from(error: Error) -> Self {
        Self::Field(error)
    }
}

impl From<ReferenceError> for Failure {
    fn from(error: ReferenceError) -> Self {
        Self::Reference(error)
    }
}

impl From<std::io::Error> for Failure {
    fn from(error: std::io::Error) -> Self {
        Self::File(error)
    }
}
