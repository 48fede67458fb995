//! Errors as exceptions that carry field, value and range.

use epas_cli::bindings::Failure;
use epas_reference::ReferenceError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// What is refused, and why. In a box: kernels return it a million times, nearly always not at all.
#[derive(Clone, Debug)]
pub struct Refused(Box<Reason>);

#[derive(Clone, Debug, Default)]
struct Reason {
    message: String,
    field: Option<String>,
    value: Option<f64>,
    range: Option<(f64, f64)>,
    /// Place in the arrays.
    index: Option<Vec<usize>>,
    kind: Kind,
}

/// Which exception it is.
#[derive(Clone, Copy, Debug, Default)]
enum Kind {
    /// A value.
    #[default]
    Value,
    /// What is not a number.
    Type,
    /// Arrays that do not fit to each other.
    Shape,
}

impl Refused {
    fn of(reason: Reason) -> Self {
        Self(Box::new(reason))
    }

    /// A value that is refused for this reason.
    pub fn value(field: &str, message: impl Into<String>) -> Self {
        Self::of(Reason {
            message: message.into(),
            field: Some(field.into()),
            ..Reason::default()
        })
    }

    /// A value out of its range.
    pub fn range(field: &str, value: f64, minimum: f64, maximum: f64) -> Self {
        let problem = if value.is_finite() {
            "is out of range"
        } else {
            "is not a finite number"
        };
        Self::of(Reason {
            message: format!("{field} = {value} {problem}; allowed: {minimum} to {maximum}"),
            field: Some(field.into()),
            value: Some(value),
            range: Some((minimum, maximum)),
            ..Reason::default()
        })
    }

    /// A finite value that single precision takes for infinite, or for 0.
    pub fn lost(field: &str, value: f64) -> Self {
        let (least, largest) = (f64::from(f32::from_bits(1)), f64::from(f32::MAX));
        if value.abs() > largest {
            let mut this = Self::range(field, value, -largest, largest);
            this.0.message.push_str(" (single precision)");
            return this;
        }
        let message = format!(
            "{field} = {value:e} is 0 in single precision; allowed: 0, or {least:e} to {largest:e} in size"
        );
        let mut this = Self::value(field, message);
        this.0.value = Some(value);
        this.0.range = Some((least, largest));
        this
    }

    /// A value that is not above 0.
    pub fn not_above_zero(field: &str, value: f64) -> Self {
        let message = format!("{field} = {value} is out of range; allowed: above 0");
        let mut this = Self::value(field, message);
        this.0.value = Some(value);
        this.0.range = Some((0.0, f64::MAX));
        this
    }

    /// A tick that is too long for the largest speed of a design, whose field is named.
    #[must_use]
    pub fn tick_of(mut self, limit: &str, value: f32) -> Self {
        const LEAST: f64 = 1e-6;
        let Some((least, largest)) = self.0.range else {
            return self;
        };
        let tick = self.0.value.unwrap_or(f64::NAN);
        // The circuit's own range begins at 0; that of the scene at a microsecond.
        if self.0.field.as_deref() == Some("tick") && least < LEAST && tick > largest {
            self.0.range = Some((LEAST, largest));
            let (tick, largest) = (tick as f32, largest as f32);
            self.0.message = format!(
                "tick = {tick} is out of range; allowed: {LEAST} to {largest} s: {limit} = {value} of the design decides how far balls travel \
                 in a tick; lower it for a longer tick"
            );
        }
        self
    }

    /// A value of a trace that is NaN or infinite.
    pub fn no_number(field: &str, value: f64) -> Self {
        let message = format!("{field} = {value} is not a finite number");
        let mut this = Self::value(field, message);
        this.0.value = Some(value);
        this
    }

    /// An argument that is not a number.
    pub fn type_of(field: &str, message: impl Into<String>) -> Self {
        let mut this = Self::value(field, message);
        this.0.kind = Kind::Type;
        this
    }

    /// An argument whose shape does not fit.
    pub fn shape(field: &str, message: impl Into<String>) -> Self {
        let mut this = Self::value(field, message);
        this.0.kind = Kind::Shape;
        this
    }

    /// What a message of the program says: `[place: ]FIELD = VALUE ...; allowed: [above ]MINIMUM to [below ]MAXIMUM[ UNIT]`, or any other text.
    pub fn message(message: impl Into<String>) -> Self {
        let message = message.into();
        let (field, value, range) = told(&message).unwrap_or_default();
        Self::of(Reason {
            message,
            field,
            value,
            range,
            ..Reason::default()
        })
    }

    /// The same under the name that a function has for the field.
    #[must_use]
    pub fn renamed(mut self, from: &str, to: &str) -> Self {
        if self.0.field.as_deref() == Some(from) {
            self.0.field = Some(to.into());
        }
        self
    }

    /// The same of a field.
    #[must_use]
    pub fn of_field(mut self, field: &str) -> Self {
        self.0.field = Some(field.into());
        self
    }

    /// Whether a field is to blame.
    pub const fn has_field(&self) -> bool {
        self.0.field.is_some()
    }

    /// What it says.
    pub fn said(&self) -> &str {
        &self.0.message
    }

    /// The same at a place of the arrays.
    #[must_use]
    pub fn at(mut self, shape: &[usize], place: usize) -> Self {
        let mut rest = place;
        let mut index: Vec<usize> = shape
            .iter()
            .rev()
            .map(|size| {
                let here = rest % size;
                rest /= size;
                here
            })
            .collect();
        index.reverse();
        if !index.is_empty() {
            self.0.message = format!("{} (at index {index:?})", self.0.message);
            self.0.index = Some(index);
        }
        self
    }
}

/// Field, value and range of a message, each where it stands there.
type Told = (Option<String>, Option<f64>, Option<(f64, f64)>);

/// Reads field, value and range out of a message.
fn told(message: &str) -> Option<Told> {
    let (before, rest) = message.split_once(" = ")?;
    let field = before.rsplit(char::is_whitespace).next()?.to_string();
    let number = |text: &str| -> Option<f64> {
        // An end that is open itself: "above 0 to 0.2", "0 to below 1".
        text.split_whitespace()
            .find(|word| !["above", "below"].contains(word))?
            .trim_end_matches([';', ','])
            .parse()
            .ok()
    };
    let range = rest.split_once("allowed: ").and_then(|(_, allowed)| {
        let (minimum, maximum) = allowed.split_once(" to ")?;
        Some((number(minimum)?, number(maximum)?))
    });
    Some((Some(field), number(rest), range))
}

impl From<epas_friction::Error> for Refused {
    fn from(error: epas_friction::Error) -> Self {
        let allowed = error.allowed();
        let mut message = error.to_string();
        // The end itself is refused: the range is open there.
        let ends = [(allowed.minimum, "above"), (allowed.maximum, "below")];
        if let Some((end, word)) = ends.into_iter().find(|(end, _)| *end == error.value()) {
            let closed = format!("allowed: {} to {}", allowed.minimum, allowed.maximum);
            let open = if word == "above" {
                format!("allowed: above {end} to {}", allowed.maximum)
            } else {
                format!("allowed: {} to below {end}", allowed.minimum)
            };
            message = message.replace(&closed, &open);
        }
        Self::of(Reason {
            message,
            field: Some(error.field().into()),
            value: Some(error.value().into()),
            range: Some((allowed.minimum.into(), allowed.maximum.into())),
            ..Reason::default()
        })
    }
}

impl From<ReferenceError> for Refused {
    fn from(error: ReferenceError) -> Self {
        let mut this = Self::message(error.to_string());
        if let Some(field) = error.field() {
            this.0.field = Some(field.into());
        }
        this
    }
}

impl From<epas_design::Failure> for Refused {
    fn from(failure: epas_design::Failure) -> Self {
        Failure::from(failure).into()
    }
}

impl From<Failure> for Refused {
    fn from(failure: Failure) -> Self {
        match failure {
            Failure::Data(message) => Self::message(message),
            other => Self::message(format!("{other:?}")),
        }
    }
}

impl From<String> for Refused {
    fn from(message: String) -> Self {
        Self::message(message)
    }
}

/// The exception.
pub fn refused(py: Python<'_>, refused: impl Into<Refused>) -> PyErr {
    let error = refused.into();
    exception(py, &error.0).unwrap_or_else(|failure| failure)
}

fn exception(py: Python<'_>, error: &Reason) -> PyResult<PyErr> {
    let name = match error.kind {
        Kind::Value => "Error",
        Kind::Type => "NumberTypeError",
        Kind::Shape => "ShapeError",
    };
    let fields = PyDict::new(py);
    fields.set_item("field", &error.field)?;
    fields.set_item("value", error.value)?;
    fields.set_item("range", error.range)?;
    fields.set_item(
        "index",
        error
            .index
            .as_ref()
            .map(|index| pyo3::types::PyTuple::new(py, index))
            .transpose()?,
    )?;
    let class = py.import("epas_friction.errors")?.getattr(name)?;
    Ok(PyErr::from_value(
        class.call((&error.message,), Some(&fields))?,
    ))
}
