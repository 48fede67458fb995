//! The fields of one request, taken one by one; what is left over is refused.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::collections::btree_map::Entry;
use std::fmt;

use epas_reference::ReferenceError;
use serde::Serialize;
use serde::de::{Deserialize, Deserializer, MapAccess, Visitor};
use serde_json::value::RawValue;

/// What is wrong with a request, and in which field.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct BadField {
    field: String,
    message: String,
}

impl BadField {
    /// The field named, with what is wrong with it.
    pub fn new(field: impl Into<String>, message: impl Into<String>) -> Self {
        Self {
            field: field.into(),
            message: message.into(),
        }
    }

    /// The line as a whole is wrong.
    pub fn request(message: impl Into<String>) -> Self {
        Self::new("request", message)
    }

    /// This error with the place in a list where it was found.
    pub fn of_ball(self, index: usize) -> Self {
        Self {
            message: format!("ball {index} (counted from 0): {}", self.message),
            ..self
        }
    }

    /// This error under the name that the request has for the field.
    pub fn renamed(self, from: &str, to: &str) -> Self {
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

impl From<epas_friction::Error> for BadField {
    fn from(error: epas_friction::Error) -> Self {
        Self::new(error.field(), error.to_string())
    }
}

impl From<ReferenceError> for BadField {
    fn from(error: ReferenceError) -> Self {
        Self::new(error.field().unwrap_or("request"), error.to_string())
    }
}

/// `value`, where it is within `minimum..=maximum`.
pub fn in_range(field: &str, value: f64, minimum: f64, maximum: f64) -> Result<f64, BadField> {
    if (minimum..=maximum).contains(&value) {
        Ok(value)
    } else {
        Err(BadField::new(
            field,
            format!("{field} = {value} is out of range; allowed: {minimum} to {maximum}"),
        ))
    }
}

/// A number for all, or one for each.
pub enum OneOrMany {
    One(f64),
    Many(Vec<f64>),
}

/// The fields of one request that have not been taken yet.
pub struct Fields<'a> {
    values: BTreeMap<Cow<'a, str>, &'a RawValue>,
    duplicate: Option<String>,
}

impl<'a> Fields<'a> {
    /// The fields of a line that holds one JSON object.
    pub fn parse(line: &'a str) -> Result<Self, BadField> {
        serde_json::from_str(line).map_err(|error| BadField::request(error.to_string()))
    }

    /// The id, as it was written; one that is nested deeper than whoever reads the answer may follow is
    /// refused.
    pub fn id(&self) -> Result<Option<&'a RawValue>, BadField> {
        match self.values.get("id").copied() {
            Some(id) if depth(id) > DEEPEST => Err(BadField::new(
                "id",
                format!("is nested deeper than {DEEPEST}"),
            )),
            id => Ok(id),
        }
    }

    /// Refuses a request that gives a field twice or has no id.
    pub fn refuse_duplicate(&mut self) -> Result<(), BadField> {
        if let Some(field) = self.duplicate.take() {
            return Err(BadField::new(beginning(&field), "is given twice"));
        }
        self.take("id").map(drop)
    }

    /// Takes a list of exactly `N` numbers.
    pub fn numbers<const N: usize>(&mut self, field: &str) -> Result<[f64; N], BadField> {
        let raw = self.take(field)?;
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

    /// Takes a list of `1..=largest` numbers.
    pub fn list(&mut self, field: &str, largest: usize) -> Result<Vec<f64>, BadField> {
        list(field, self.take(field)?, largest)
    }

    /// Takes a list of `1..=largest` numbers that may be left out.
    pub fn optional_list(
        &mut self,
        field: &str,
        largest: usize,
    ) -> Result<Option<Vec<f64>>, BadField> {
        let raw = self.values.remove(field);
        raw.map(|raw| list(field, raw, largest)).transpose()
    }

    /// Takes the list `balls` of `1..=largest` objects, each read by `one`.
    pub fn balls<T>(
        &mut self,
        largest: usize,
        one: impl Fn(Fields<'a>) -> Result<T, BadField>,
    ) -> Result<Vec<T>, BadField> {
        let field = "balls";
        let raw = self.take(field)?;
        let values: Option<Vec<&RawValue>> = serde_json::from_str(raw.get()).ok();
        let Some(values) = values else {
            return Err(BadField::new(
                field,
                format!("must be a list of objects, not {}", shown(raw)),
            ));
        };
        if values.is_empty() || values.len() > largest {
            return Err(BadField::new(
                field,
                format!("{} of them; allowed: 1 to {largest}", values.len()),
            ));
        }
        values
            .into_iter()
            .enumerate()
            .map(|(index, raw)| {
                Self::nested(field, raw)
                    .and_then(&one)
                    .map_err(|error| error.of_ball(index))
            })
            .collect()
    }

    /// Takes an object.
    pub fn object(&mut self, field: &str) -> Result<Fields<'a>, BadField> {
        let raw = self.take(field)?;
        Self::nested(field, raw)
    }

    /// Takes an object that may be left out.
    pub fn optional_object(&mut self, field: &str) -> Result<Option<Fields<'a>>, BadField> {
        self.values
            .remove(field)
            .map(|raw| Self::nested(field, raw))
            .transpose()
    }

    fn nested(field: &str, raw: &'a RawValue) -> Result<Self, BadField> {
        let mut fields: Fields = serde_json::from_str(raw.get())
            .map_err(|_| BadField::new(field, format!("must be an object, not {}", shown(raw))))?;
        match fields.duplicate.take() {
            Some(twice) => Err(BadField::new(twice, "is given twice")),
            None => Ok(fields),
        }
    }

    /// Takes a number; any that float64 can hold.
    pub fn number(&mut self, field: &str) -> Result<f64, BadField> {
        number(field, self.take(field)?)
    }

    /// Takes a number that may be left out.
    pub fn optional_number(&mut self, field: &str) -> Result<Option<f64>, BadField> {
        self.values
            .remove(field)
            .map(|raw| number(field, raw))
            .transpose()
    }

    /// Takes a number, or a list of any length, that may be left out.
    pub fn optional_number_or_numbers(
        &mut self,
        field: &str,
    ) -> Result<Option<OneOrMany>, BadField> {
        let Some(raw) = self.values.remove(field) else {
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

    /// Takes a name and gives what stands beside it.
    pub fn choice<T: Copy>(&mut self, field: &str, choices: &[(&str, T)]) -> Result<T, BadField> {
        let raw = self.take(field)?;
        let name: Option<Cow<str>> = serde_json::from_str(raw.get()).ok();
        choices
            .iter()
            .find(|(choice, _)| Some(*choice) == name.as_deref())
            .map(|&(_, value)| value)
            .ok_or_else(|| {
                let names: Vec<_> = choices.iter().map(|(choice, _)| *choice).collect();
                BadField::new(
                    field,
                    format!("{} is none of: {}", shown(raw), names.join(", ")),
                )
            })
    }

    /// Refuses every field that is left.
    pub fn finish(self) -> Result<(), BadField> {
        match self.values.into_keys().next() {
            Some(field) => Err(BadField::new(beginning(&field), "is unknown to this model")),
            None => Ok(()),
        }
    }

    fn take(&mut self, field: &str) -> Result<&'a RawValue, BadField> {
        self.values
            .remove(field)
            .ok_or_else(|| BadField::new(field, "is missing"))
    }
}

/// A JSON list of `1..=largest` numbers.
fn list(field: &str, raw: &RawValue, largest: usize) -> Result<Vec<f64>, BadField> {
    let Ok(values) = serde_json::from_str::<Vec<&RawValue>>(raw.get()) else {
        return Err(BadField::new(
            field,
            format!("must be a list of numbers, not {}", shown(raw)),
        ));
    };
    if values.is_empty() || values.len() > largest {
        return Err(BadField::new(
            field,
            format!("{} of them; allowed: 1 to {largest}", values.len()),
        ));
    }
    values.into_iter().map(|raw| number(field, raw)).collect()
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

/// Deepest nesting of an id: the limit of common readers of JSON.
const DEEPEST: usize = 100;

/// How deep lists and objects of a JSON value are nested.
fn depth(raw: &RawValue) -> usize {
    let (mut depth, mut deepest) = (0_usize, 0);
    let (mut in_text, mut escaped) = (false, false);
    for byte in raw.get().bytes() {
        match byte {
            _ if escaped => escaped = false,
            b'\\' => escaped = in_text,
            b'"' => in_text = !in_text,
            b'[' | b'{' if !in_text => {
                depth += 1;
                deepest = deepest.max(depth);
            }
            b']' | b'}' if !in_text => depth = depth.saturating_sub(1),
            _ => {}
        }
    }
    deepest
}

/// The beginning of a JSON value, for a message.
fn shown(raw: &RawValue) -> Cow<'_, str> {
    beginning(raw.get())
}

/// The beginning of a text, for a message.
fn beginning(text: &str) -> Cow<'_, str> {
    const LENGTH: usize = 40;
    match text.char_indices().nth(LENGTH) {
        Some((end, _)) => Cow::Owned(format!("{}...", &text[..end])),
        None => Cow::Borrowed(text),
    }
}

impl<'de: 'a, 'a> Deserialize<'de> for Fields<'a> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_map(FieldsVisitor)
    }
}

struct FieldsVisitor;

impl<'de> Visitor<'de> for FieldsVisitor {
    type Value = Fields<'de>;

    fn expecting(&self, formatter: &mut fmt::Formatter) -> fmt::Result {
        formatter.write_str("a JSON object")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Fields<'de>, A::Error> {
        let mut fields = Fields {
            values: BTreeMap::new(),
            duplicate: None,
        };
        while let Some((name, value)) = map.next_entry::<Name, &RawValue>()? {
            match fields.values.entry(name.0) {
                Entry::Vacant(entry) => {
                    entry.insert(value);
                }
                Entry::Occupied(entry) => {
                    fields
                        .duplicate
                        .get_or_insert_with(|| entry.key().clone().into_owned());
                }
            }
        }
        Ok(fields)
    }
}

/// A field's name: borrowed where it holds no escapes.
#[derive(serde::Deserialize)]
struct Name<'a>(#[serde(borrow)] Cow<'a, str>);

#[cfg(test)]
mod tests {
    use super::*;

    fn error(line: &str) -> BadField {
        let mut fields = match Fields::parse(line) {
            Ok(fields) => fields,
            Err(error) => return error,
        };
        let taken = fields
            .refuse_duplicate()
            .and_then(|()| fields.number("load"))
            .and_then(|_| fields.finish());
        taken.unwrap_err()
    }

    #[test]
    fn every_fault_names_its_field() {
        for (line, field) in [
            (r#"{"id": 1}"#, "load"),
            (r#"{"load": 1}"#, "id"),
            (r#"{"id": 1, "load": "NaN"}"#, "load"),
            (r#"{"id": 1, "load": null}"#, "load"),
            (r#"{"id": 1, "load": true}"#, "load"),
            (r#"{"id": 1, "load": [1]}"#, "load"),
            (r#"{"id": 1, "load": 1e999}"#, "load"),
            (r#"{"id": 1, "load": -1e999}"#, "load"),
            (r#"{"id": 1, "load": 1, "load": 2}"#, "load"),
            (r#"{"id": 1, "load": 1, "l\u006fad": 2}"#, "load"),
            (r#"{"id": 1, "load": 1, "lead": 2}"#, "lead"),
            (r#"{"id": 1, "load": NaN}"#, "request"),
            (r#"{"id": 1, "load": 1"#, "request"),
            (r#"{"id": 1, "load": 01}"#, "request"),
            ("[1]", "request"),
            ("7", "request"),
        ] {
            assert_eq!(error(line).field, field, "{line}");
        }
    }

    #[test]
    fn depth_counts_what_is_no_text() {
        for (json, expected) in [
            ("1", 0),
            ("[]", 1),
            (r#"{"a": [1, {"b": []}]}"#, 4),
            (r#"["[[[\"[[", "{\\"]"#, 1),
            (r#"[[],[[]],"]"]"#, 3),
        ] {
            let raw: &RawValue = serde_json::from_str(json).unwrap();
            assert_eq!(depth(raw), expected, "{json}");
        }
    }

    #[test]
    fn deep_nesting_is_no_danger() {
        let deep = format!(r#"{{"id": 1, "load": {}}}"#, "[".repeat(100_000));
        assert_eq!(error(&deep).field, "request");
        let deep = format!(
            r#"{{"id": 1, "load": {}{}}}"#,
            "[".repeat(100_000),
            "]".repeat(100_000)
        );
        assert_eq!(error(&deep).field, "load");
    }
}
