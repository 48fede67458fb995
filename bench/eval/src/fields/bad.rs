//! Why a request is refused.

use std::fmt;

use epas_design::files::plausible;
use epas_friction::Range;
use epas_reference::ReferenceError;
use serde::Serialize;

/// What is wrong with a request, and in which field.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct BadField {
    /// The field, or "request" for the line as a whole.
    pub field: String,
    /// What is wrong with it.
    pub message: String,
}

impl BadField {
    /// The field named, with what is wrong with it.
    pub(crate) fn new(field: impl Into<String>, message: impl Into<String>) -> Self {
        Self {
            field: field.into(),
            message: message.into(),
        }
    }

    /// The line as a whole is wrong.
    pub(crate) fn request(message: impl Into<String>) -> Self {
        Self::new("request", message)
    }

    /// This error with the place in a list where it was found.
    pub(crate) fn of_ball(self, index: usize) -> Self {
        Self {
            message: format!("ball {index} (counted from 0): {}", self.message),
            ..self
        }
    }

    /// This error under the name that the request has for the field.
    pub(crate) fn renamed(self, from: &str, to: &str) -> Self {
        if self.field == from {
            Self {
                field: to.into(),
                ..self
            }
        } else {
            self
        }
    }
}

impl fmt::Display for BadField {
    fn fmt(&self, formatter: &mut fmt::Formatter) -> fmt::Result {
        write!(formatter, "{}: {}", self.field, self.message)
    }
}

impl std::error::Error for BadField {}

impl From<epas_friction::Error> for BadField {
    fn from(error: epas_friction::Error) -> Self {
        let asked = plausible::asked(error.field(), error.value(), error.allowed());
        Self::new(error.field(), with(error.to_string(), asked))
    }
}

impl From<ReferenceError> for BadField {
    fn from(error: ReferenceError) -> Self {
        let asked = match error {
            ReferenceError::OutOfRange {
                field,
                value,
                min,
                max,
            } => asked(field, value, min, max),
            _ => None,
        };
        let field = error.field().unwrap_or("request");
        Self::new(field, with(error.to_string(), asked))
    }
}

fn asked(field: &str, value: f64, minimum: f64, maximum: f64) -> Option<String> {
    let allowed = Range::new(minimum as f32, maximum as f32);
    plausible::asked(field, value as f32, allowed)
}

/// A refusal with the unit that its number may be in.
fn with(said: String, asked: Option<String>) -> String {
    match asked {
        Some(unit) => format!("{said} ({unit})"),
        None => said,
    }
}

/// `value`, where it is within `minimum..=maximum`.
pub fn in_range(field: &str, value: f64, minimum: f64, maximum: f64) -> Result<f64, BadField> {
    if (minimum..=maximum).contains(&value) {
        Ok(value)
    } else {
        Err(BadField::new(
            field,
            with(
                format!("{field} = {value} is out of range; allowed: {minimum} to {maximum}"),
                asked(field, value, minimum, maximum),
            ),
        ))
    }
}
