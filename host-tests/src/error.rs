//! The one error type of the reference.

use std::fmt;

/// What was wrong with an input, or why no solution exists.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ReferenceError {
    /// Name of the field that is wrong.
    pub field: &'static str,
    /// What is wrong with it, with its value and what is allowed.
    pub message: String,
}

impl ReferenceError {
    /// An error about `field`.
    #[must_use]
    pub fn new(field: &'static str, message: impl Into<String>) -> Self {
        Self {
            field,
            message: message.into(),
        }
    }
}

impl fmt::Display for ReferenceError {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{}: {}", self.field, self.message)
    }
}

impl std::error::Error for ReferenceError {}

/// `value`, or the error that names `field` where it is not a number within `minimum..=maximum`.
///
/// # Errors
/// [`ReferenceError`] naming `field`.
pub fn within(
    field: &'static str,
    value: f64,
    minimum: f64,
    maximum: f64,
) -> Result<f64, ReferenceError> {
    if value.is_finite() && value >= minimum && value <= maximum {
        Ok(value)
    } else {
        Err(ReferenceError::new(
            field,
            format!("{value} is not within {minimum} to {maximum}"),
        ))
    }
}
