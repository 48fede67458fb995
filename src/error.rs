//! The one error type: which field is wrong, its value, and what is allowed.

use core::fmt;

/// The value of a `Result`, or back with its error: `?` in a constant function.
macro_rules! attempt {
    ($result:expr) => {
        match $result {
            Ok(value) => value,
            Err(error) => return Err(error),
        }
    };
}
pub(crate) use attempt;

/// The closed interval that a field must lie in, in the field's own unit.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Range {
    /// Smallest allowed value.
    pub minimum: f32,
    /// Largest allowed value.
    pub maximum: f32,
}

impl Range {
    /// The closed interval from `minimum` to `maximum`.
    #[must_use]
    pub const fn new(minimum: f32, maximum: f32) -> Self {
        Self { minimum, maximum }
    }

    /// True where `value` is inside the interval; NaN never is.
    #[must_use]
    pub const fn contains(&self, value: f32) -> bool {
        value >= self.minimum && value <= self.maximum
    }

    /// `value`, or the error that names `field`.
    ///
    /// # Errors
    /// [`Error`] where `value` is NaN or outside the range.
    pub const fn checked(self, field: &'static str, value: f32) -> Result<f32, Error> {
        in_range(field, value, self.minimum, self.maximum)
    }
}

/// Refusal of a number at set-up. In the loop nothing returns a `Result`: a wrong input gives a finite, flagged output
/// (see [`Faults`](crate::Faults)).
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Error {
    /// The value is NaN or infinite.
    NotFinite {
        /// Name of the field, as it is spelled in the structure given.
        field: &'static str,
        /// The value found.
        value: f32,
        /// What is allowed.
        allowed: Range,
    },
    /// The value is a number outside the allowed range.
    OutOfRange {
        /// Name of the field, as it is spelled in the structure given.
        field: &'static str,
        /// The value found.
        value: f32,
        /// What is allowed.
        allowed: Range,
    },
    /// The groove surface would fold past the axis of the screw (`A < 1e-4`): the other fields leave no room for the value.
    FoldedGroove {
        /// Name of the field, as it is spelled in the structure given.
        field: &'static str,
        /// The value found.
        value: f32,
        /// What the other fields leave.
        allowed: Range,
    },
}

/// Fields that are lengths, which drawings print in millimetres: their errors say the unit.
const LENGTHS: [&str; 9] = [
    "pitch_radius",
    "lead",
    "ball_radius",
    "groove_radius",
    "clearance",
    "axial_play",
    "loaded_length",
    "return_length",
    "wavelength",
];

impl Error {
    /// A value that folds the groove surface, where the other fields leave it `minimum` to `maximum`, or less than the value.
    pub(crate) const fn folded(
        field: &'static str,
        value: f32,
        minimum: f32,
        maximum: f32,
    ) -> Self {
        let maximum = if maximum < value {
            maximum
        } else {
            value.next_down()
        };
        Self::FoldedGroove {
            field,
            value,
            allowed: Range::new(minimum, maximum),
        }
    }

    /// Name of the field that is wrong.
    pub const fn field(&self) -> &'static str {
        self.parts().0
    }

    /// The value that was refused, in the field's own unit.
    pub const fn value(&self) -> f32 {
        self.parts().1
    }

    /// The range that would have been accepted, in the field's own unit.
    pub const fn allowed(&self) -> Range {
        self.parts().2
    }

    const fn parts(&self) -> (&'static str, f32, Range) {
        let (Self::NotFinite {
            field,
            value,
            allowed,
        }
        | Self::OutOfRange {
            field,
            value,
            allowed,
        }
        | Self::FoldedGroove {
            field,
            value,
            allowed,
        }) = *self;
        (field, value, allowed)
    }
}

impl fmt::Display for Error {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let problem = match self {
            Self::NotFinite { .. } => "is not a finite number",
            Self::OutOfRange { .. } => "is out of range",
            Self::FoldedGroove { .. } => "folds the groove surface past the axis",
        };
        let Range { minimum, maximum } = self.allowed();
        let field = self.field();
        match field {
            "magic" => {
                return formatter.write_str("magic: these words are no block of this scene");
            }
            "checksum" => return formatter.write_str("checksum: the block is damaged"),
            _ => {}
        }
        let unit = if LENGTHS.contains(&field) {
            " m; lengths are in metres"
        } else {
            ""
        };
        write!(
            formatter,
            "{field} = {} {problem}; allowed: {minimum} to {maximum}{unit}",
            self.value(),
        )
    }
}

impl core::error::Error for Error {}

/// `value`, or the error that names `field` where it is NaN or outside `minimum..=maximum`.
pub(crate) const fn in_range(
    field: &'static str,
    value: f32,
    minimum: f32,
    maximum: f32,
) -> Result<f32, Error> {
    let allowed = Range::new(minimum, maximum);
    if !value.is_finite() {
        Err(Error::NotFinite {
            field,
            value,
            allowed,
        })
    } else if allowed.contains(value) {
        Ok(value)
    } else {
        Err(Error::OutOfRange {
            field,
            value,
            allowed,
        })
    }
}

/// Checks fields, each with its value and its least and largest one, in their order.
pub(crate) const fn all_in_range(fields: &[(&'static str, f32, f32, f32)]) -> Result<(), Error> {
    let mut index = 0;
    while index < fields.len() {
        let (field, value, minimum, maximum) = fields[index];
        attempt!(in_range(field, value, minimum, maximum));
        index += 1;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::*;
    use std::string::ToString;

    #[test]
    fn an_error_names_field_value_and_range() {
        let error = in_range("lead", -0.5, 0.0, 1.0).unwrap_err();
        assert_eq!(error.field(), "lead");
        assert_eq!(error.value(), -0.5);
        assert_eq!(error.allowed(), Range::new(0.0, 1.0));
        assert_eq!(
            error.to_string(),
            "lead = -0.5 is out of range; allowed: 0 to 1 m; lengths are in metres"
        );
        assert_eq!(
            in_range("friction", 2.0, 0.0, 1.0).unwrap_err().to_string(),
            "friction = 2 is out of range; allowed: 0 to 1"
        );
    }

    #[test]
    fn a_foreign_or_damaged_block_is_told_in_words() {
        let said = |field, value| in_range(field, value, 1.0, 1.0).unwrap_err().to_string();
        assert_eq!(
            said("magic", 2.0),
            "magic: these words are no block of this scene"
        );
        assert_eq!(said("checksum", 0.0), "checksum: the block is damaged");
    }

    #[test]
    fn the_range_that_folding_leaves_ends_below_the_value() {
        for maximum in [0.5, 2e-9, 2.1e-9, f32::INFINITY] {
            let error = Error::folded("groove_radius", 2e-9, 0.0, maximum);
            assert!(!error.allowed().contains(error.value()), "{error}");
        }
        assert_eq!(
            Error::folded("lead", 2.0, 0.0, 1.0).allowed(),
            Range::new(0.0, 1.0)
        );
    }
}
