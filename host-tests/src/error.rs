//! The one error type of the reference.

use std::fmt;

/// Why a model of the reference has no answer.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum ReferenceError {
    /// A number outside the range in which the model means something.
    OutOfRange {
        /// Name of the input, as spelled in the structure or argument list.
        field: &'static str,
        /// The value given.
        value: f64,
        /// Smallest value allowed.
        min: f64,
        /// Largest value allowed.
        max: f64,
    },
    /// An input that is wrong in another way.
    Input {
        /// Name of the input, as spelled in the structure or argument list.
        field: &'static str,
        /// What is wrong with it.
        message: String,
    },
    /// Coulomb friction does not depend on the magnitude of the speed, and has no direction at rest.
    Standstill,
    /// The loaded contacts leave the speed of the ball open: a loaded contact is missing on one side.
    Undriven,
    /// No contact takes up the load: it points out of the grooves, or play is larger than the model allows.
    Unsupported,
    /// A steady state needs friction: without it nothing holds the ball's spin.
    Frictionless,
    /// Driving locks: `f R >= Sb`, eq. (16) of Lin, Velinsky and Ravani.
    Locked,
    /// The slip at the nut would have to be negative: the lead angle is below the limit of the steady state.
    NoSlip,
    /// A normal load turned negative: the contact opens.
    ContactLost {
        /// Angle of the turning part, rad.
        angle: f64,
    },
    /// An iteration stopped before its residual came under the tolerance.
    NotConverged {
        /// Largest residual left.
        residual: f64,
        /// What the residual is measured in.
        unit: &'static str,
    },
    /// An integration in time stopped before its end.
    Integrator {
        /// What the integrator says.
        reason: String,
    },
    /// The caller stopped the study.
    Cancelled,
}

impl ReferenceError {
    /// An input that is wrong in another way than by its range.
    pub fn input(field: &'static str, message: impl Into<String>) -> Self {
        Self::Input {
            field,
            message: message.into(),
        }
    }

    /// An iteration that left unbalanced forces, N.
    pub const fn unbalanced(residual: f64) -> Self {
        Self::NotConverged {
            residual,
            unit: "N",
        }
    }

    /// Name of the wrong input; None where all inputs are fine and the model has no solution for them.
    pub const fn field(&self) -> Option<&'static str> {
        match self {
            Self::OutOfRange { field, .. } | Self::Input { field, .. } => Some(field),
            _ => None,
        }
    }

    /// This error about an input that the caller knows by another name.
    pub fn renamed(mut self, to: &'static str) -> Self {
        if let Self::OutOfRange { field, .. } | Self::Input { field, .. } = &mut self {
            *field = to;
        }
        self
    }

    /// This error with a residual times `factor`: of a model that was solved in scaled units.
    pub(crate) fn scaled(mut self, factor: f64) -> Self {
        if let Self::NotConverged { residual, .. } = &mut self {
            *residual *= factor;
        }
        self
    }
}

impl fmt::Display for ReferenceError {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::OutOfRange {
                field,
                value,
                min,
                max,
            } => write!(out, "{field} = {value} is not within {min} to {max}"),
            Self::Input { field, message } => write!(out, "{field}: {message}"),
            Self::Standstill => {
                out.write_str("speed is zero: Coulomb friction has no direction at rest")
            }
            Self::Undriven => out.write_str("the loaded contacts leave the speed of the ball open"),
            Self::Unsupported => out.write_str("no contact takes up the load"),
            Self::Frictionless => out.write_str("without friction nothing holds the ball's spin"),
            Self::Locked => out.write_str("driving locks"),
            Self::NoSlip => out.write_str("the lead angle is too small for a steady state"),
            Self::ContactLost { angle } => {
                write!(out, "a contact opens at an angle of {angle} rad")
            }
            Self::NotConverged { residual, unit } => {
                write!(
                    out,
                    "no convergence: a residual of {residual:e} {unit} is left"
                )
            }
            Self::Integrator { reason } => write!(out, "the integrator stopped: {reason}"),
            Self::Cancelled => out.write_str("cancelled"),
        }
    }
}

impl std::error::Error for ReferenceError {}

/// `value`, or the error that names `field` where it is not a number within `min..=max`. An end of the range that was written in single
/// precision is in it, whichever way it was rounded.
pub fn within(field: &'static str, value: f64, min: f64, max: f64) -> Result<f64, ReferenceError> {
    let an_end = |end: f64| value == f64::from(end as f32);
    if value.is_finite() && ((min..=max).contains(&value) || an_end(min) || an_end(max)) {
        Ok(value)
    } else {
        Err(ReferenceError::OutOfRange {
            field,
            value,
            min,
            max,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 0.2 in single precision is 0.2000000030; its neighbour is out of range, and so is what has no size.
    #[test]
    fn an_end_in_single_precision_is_within_its_range() {
        let checked = |value| within("field", value, 1e-6, 0.2);
        for end in [1e-6_f32, 0.2] {
            assert_eq!(checked(end.into()), Ok(f64::from(end)));
        }
        assert!(checked(0.2_f32.next_up().into()).is_err());
        assert!(checked(1e-6_f32.next_down().into()).is_err());
        assert!(checked(f64::NAN).is_err());
        assert!(within("field", f64::INFINITY, 0.0, f64::INFINITY).is_err());
    }
}
