//! The fields of one request, taken one by one; what is left over is refused.

mod bad;
mod values;

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::collections::btree_map::Entry;
use std::fmt;

use serde::de::{Deserialize, Deserializer, MapAccess, Visitor};
use serde_json::value::RawValue;

pub use bad::{BadField, in_range};
use values::list;
pub use values::{Object, OneOrMany, Value};
pub(crate) use values::{request, same};

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

    /// Takes a value.
    pub fn get<T: Value<'a>>(&mut self, field: &str) -> Result<T, BadField> {
        T::take(self, field)
    }

    /// Takes a number that may be left out, and counts as this one then.
    pub fn or(&mut self, field: &str, default: f64) -> Result<f64, BadField> {
        self.get::<Option<f64>>(field)
            .map(|number| number.unwrap_or(default))
    }

    /// Whether a field says so; not without it.
    pub fn flag(&mut self, field: &str) -> Result<bool, BadField> {
        self.get::<Option<bool>>(field)
            .map(|flag| flag.unwrap_or(false))
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
    pub fn finish(&self) -> Result<(), BadField> {
        match self.values.keys().next() {
            Some(field) => Err(BadField::new(beginning(field), "is unknown to this model")),
            None => Ok(()),
        }
    }

    fn take(&mut self, field: &str) -> Result<&'a RawValue, BadField> {
        self.values
            .remove(field)
            .ok_or_else(|| BadField::new(field, "is missing"))
    }
}

/// Deepest nesting of an id: the limit of common readers of JSON.
const DEEPEST: usize = 100;

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

fn shown(raw: &RawValue) -> Cow<'_, str> {
    beginning(raw.get())
}

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
}
