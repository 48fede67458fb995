//! What fields hold: numbers, lists, objects, and structs that are read from them.

use serde_json::value::RawValue;

use super::{BadField, Fields, shown};
use crate::train::LARGEST_TRAIN;

pub enum OneOrMany {
    One(f64),
    Many(Vec<f64>),
}

pub trait Value<'a>: Sized {
    fn take(fields: &mut Fields<'a>, field: &str) -> Result<Self, BadField>;
}

/// Any number that float64 can hold.
impl Value<'_> for f64 {
    fn take(fields: &mut Fields, field: &str) -> Result<Self, BadField> {
        number(field, fields.take(field)?)
    }
}

/// A number that may be left out.
impl Value<'_> for Option<f64> {
    fn take(fields: &mut Fields, field: &str) -> Result<Self, BadField> {
        let raw = fields.values.remove(field);
        raw.map(|raw| number(field, raw)).transpose()
    }
}

/// True or false; it may be left out.
impl Value<'_> for Option<bool> {
    fn take(fields: &mut Fields, field: &str) -> Result<Self, BadField> {
        let Some(raw) = fields.values.remove(field) else {
            return Ok(None);
        };
        serde_json::from_str(raw.get())
            .map(Some)
            .map_err(|_| BadField::new(field, format!("must be true or false, not {}", shown(raw))))
    }
}

/// A number or a list of any length; it may be left out.
impl Value<'_> for Option<OneOrMany> {
    fn take(fields: &mut Fields, field: &str) -> Result<Self, BadField> {
        let Some(raw) = fields.values.remove(field) else {
            return Ok(None);
        };
        match serde_json::from_str::<Vec<&RawValue>>(raw.get()) {
            Ok(values) => values
                .into_iter()
                .map(|raw| number(field, raw))
                .collect::<Result<_, _>>()
                .map(OneOrMany::Many),
            Err(_) => number(field, raw).map(OneOrMany::One),
        }
        .map(Some)
    }
}

/// Exactly `N` numbers.
impl<const N: usize> Value<'_> for [f64; N] {
    fn take(fields: &mut Fields, field: &str) -> Result<Self, BadField> {
        let raw = fields.take(field)?;
        let values: Option<Vec<&RawValue>> = serde_json::from_str(raw.get()).ok();
        let values: Option<[&RawValue; N]> = values.and_then(|values| values.try_into().ok());
        let Some(values) = values else {
            return Err(BadField::new(
                field,
                format!("must be a list of {N} numbers, not {}", shown(raw)),
            ));
        };
        let mut numbers = [0.0; N];
        for (to, raw) in numbers.iter_mut().zip(values) {
            *to = number(field, raw)?;
        }
        Ok(numbers)
    }
}

/// One to [`LARGEST_TRAIN`] objects.
impl<'a, T: Object> Value<'a> for Vec<T> {
    fn take(fields: &mut Fields<'a>, field: &str) -> Result<Self, BadField> {
        let raw = fields.take(field)?;
        let Ok(values) = serde_json::from_str::<Vec<&RawValue>>(raw.get()) else {
            return Err(BadField::new(
                field,
                format!("must be a list of objects, not {}", shown(raw)),
            ));
        };
        refuse_count(field, values.len(), LARGEST_TRAIN)?;
        let one = |(index, raw)| {
            let read = |raw| {
                let mut fields = Fields::nested(field, raw)?;
                let object = T::read(&mut fields)?;
                fields.finish().map(|()| object)
            };
            read(raw).map_err(|error: BadField| error.of_ball(index))
        };
        values.into_iter().enumerate().map(one).collect()
    }
}

/// What is read from the fields of a request, or of an object in it.
pub trait Object: Sized {
    /// Takes its fields; what else stands there is left.
    fn read(fields: &mut Fields) -> Result<Self, BadField>;
}

/// A struct with public fields which is read from JSON fields of the same names, in their order. One with `= function` is
/// read by that from all the fields.
macro_rules! request {
    (
        $(#[$about:meta])* $shown:vis struct $name:ident {
            $($(#[$of_field:meta])* $field:ident: $type:ty $(= $read:expr)?,)*
        }
    ) => {
        $(#[$about])* $shown struct $name { $($(#[$of_field])* pub $field: $type,)* }

        impl $crate::fields::Object for $name {
            fn read(fields: &mut $crate::fields::Fields) -> Result<Self, $crate::fields::BadField> {
                Ok(Self { $($field: $crate::fields::request!(@read fields $field $($read)?),)* })
            }
        }
    };
    (@read $fields:ident $field:ident) => { $fields.get(stringify!($field))? };
    (@read $fields:ident $field:ident $read:expr) => { $read($fields)? };
}
pub(crate) use request;

/// A struct whose fields are those of the same names in another; `as f32` rounds them.
macro_rules! same {
    ($name:ident { $($field:ident),* $(,)? } of $from:expr) => {
        $name { $($field: $from.$field.into()),* }
    };
    ($name:ident { $($field:ident),* $(,)? } of $from:expr, as f32) => {
        $name { $($field: $from.$field as f32),* }
    };
}
pub(crate) use same;

/// A JSON list of `1..=largest` numbers.
pub fn list(field: &str, raw: &RawValue, largest: usize) -> Result<Vec<f64>, BadField> {
    let Ok(values) = serde_json::from_str::<Vec<&RawValue>>(raw.get()) else {
        return Err(BadField::new(
            field,
            format!("must be a list of numbers, not {}", shown(raw)),
        ));
    };
    refuse_count(field, values.len(), largest)?;
    values.into_iter().map(|raw| number(field, raw)).collect()
}

/// Refuses a list that is empty or too long.
fn refuse_count(field: &str, count: usize, largest: usize) -> Result<(), BadField> {
    if (1..=largest).contains(&count) {
        Ok(())
    } else {
        let message = format!("{count} of them; allowed: 1 to {largest}");
        Err(BadField::new(field, message))
    }
}

/// A JSON number as float64. What is beyond its range reads as infinity and is refused here, so that
/// the field can be named.
fn number(field: &str, raw: &RawValue) -> Result<f64, BadField> {
    let text = raw.get();
    if !text.starts_with(|first: char| first == '-' || first.is_ascii_digit()) {
        return Err(BadField::new(
            field,
            format!("must be a number, not {}", shown(raw)),
        ));
    }
    match text.parse::<f64>() {
        Ok(value) if value.is_finite() => Ok(value),
        _ => Err(BadField::new(
            field,
            format!("{} is beyond the range of float64", shown(raw)),
        )),
    }
}
