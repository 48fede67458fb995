//! What crate and reference say at a point of a map.

use epas_eval::{BadField, Both, Model};
use epas_page::failure::Failure;
use serde::Serialize;
use serde_json::Value;

use crate::report::statistics::Errors;

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Numbers {
    pub found: Option<f64>,
    pub exact: Option<f64>,
    /// Of the reference, by which the error is divided; 1 for an absolute error.
    pub scale: Option<f64>,
}

#[derive(Clone, Debug)]
pub struct Sample {
    pub line: String,
    pub numbers: Numbers,
}

pub struct Answers {
    line: String,
    in_loop: Value,
    reference: Value,
}

/// An answer as JSON: a number that is not finite is null. One that has no such text has no field either, which [`Answers::sample`] says.
fn json(answer: &impl Serialize) -> Value {
    serde_json::to_value(answer).unwrap_or_else(|error| Value::String(error.to_string()))
}

/// What stands at a place of an answer, `Null` where it or what it is a part of is null.
fn at<'a>(answer: &'a Value, place: &str) -> Result<&'a Value, Failure> {
    let mut value = answer;
    for field in place.split('/').skip(1) {
        let inner = match value {
            Value::Object(fields) => fields.get(field),
            Value::Array(list) => field.parse().ok().and_then(|index: usize| list.get(index)),
            Value::Null if !std::ptr::eq(value, answer) => return Ok(value),
            _ => None,
        };
        value = inner.ok_or_else(|| Failure::Data(format!("{place} is not in {answer}")))?;
    }
    Ok(value)
}

fn number(answer: &Value, place: &str) -> Result<Option<f64>, Failure> {
    match at(answer, place)? {
        Value::Null => Ok(None),
        value => match value.as_f64() {
            None => Err(Failure::Data(format!(
                "{place} is not a number in {answer}"
            ))),
            number => Ok(number),
        },
    }
}

pub fn ask<M: Model>(request: &M) -> Result<Answers, BadField> {
    let Both { in_loop, reference } = request.evaluate()?;
    Ok(Answers {
        line: request.line()?,
        in_loop: json(&in_loop),
        reference: json(&reference),
    })
}

impl Answers {
    /// The numbers at these places of the crate and of the reference, and that of the reference which the error is over, 1 for an empty place;
    /// the reference's counts not where the place `unless` says so.
    pub fn sample(self, [found, exact, over]: [&str; 3], unless: &str) -> Result<Sample, Failure> {
        let excluded = !unless.is_empty() && at(&self.reference, unless)? == &Value::Bool(true);
        let scale = if over.is_empty() {
            Some(1.0)
        } else {
            number(&self.reference, over)?
        };
        Ok(Sample {
            numbers: Numbers {
                found: number(&self.in_loop, found)?,
                exact: number(&self.reference, exact)?.filter(|_| !excluded),
                scale: scale.filter(|scale| *scale != 0.0),
            },
            line: self.line,
        })
    }
}

#[derive(Default)]
pub struct Tally {
    pub errors: Errors,
    pub compared: u32,
    /// Points that the crate or the reference refuses.
    pub refused: u32,
    /// Points where the reference has no number, or none that counts.
    pub not_exact: u32,
    /// Points where the reference has a number and the crate none.
    pub not_found: u32,
    pub worst: Option<(f64, Sample)>,
}

impl Tally {
    pub fn add(&mut self, point: Result<Sample, BadField>) -> Option<f64> {
        let Ok(sample) = point else {
            self.refused += 1;
            return None;
        };
        let Numbers {
            found,
            exact,
            scale,
        } = sample.numbers;
        let (Some(exact), Some(scale)) = (exact, scale) else {
            self.not_exact += 1;
            return None;
        };
        let Some(found) = found else {
            self.not_found += 1;
            return None;
        };
        let error = (found - exact) / scale;
        self.compared += 1;
        self.errors.add(error);
        if self
            .worst
            .as_ref()
            .is_none_or(|(worst, _)| error.abs() >= *worst)
        {
            self.worst = Some((error.abs(), sample));
        }
        Some(error.abs())
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    /// A refusal, a number that only one side has, and one that does not count are four things, and none is an error.
    #[test]
    fn every_point_is_counted_once() {
        let mut tally = Tally::default();
        let mut add = |found: f64, exact: f64, over: f64, locked: bool| {
            let answers = Answers {
                line: String::new(),
                in_loop: json!({ "value": found }),
                reference: json!({ "value": exact, "over": over, "locked": locked }),
            };
            let places = ["/value", "/value", "/over"];
            tally.add(Ok(answers.sample(places, "/locked").unwrap()))
        };
        assert_eq!(add(3.0, 2.0, -4.0, false), Some(0.25));
        assert_eq!(add(2.0, 2.0, 1.0, false), Some(0.0));
        assert_eq!(add(f64::NAN, 2.0, 1.0, false), None);
        assert_eq!(add(2.0, f64::NAN, 1.0, false), None);
        assert_eq!(add(2.0, f64::INFINITY, 1.0, false), None);
        assert_eq!(add(2.0, 2.0, 0.0, false), None);
        assert_eq!(add(2.0, 2.0, 1.0, true), None);
        let friction = epas_eval::friction_map::Request {
            axis_ratio: 2.0,
            offset: 0.0,
        };
        let refused = ask(&friction).err().unwrap();
        assert_eq!(tally.add(Err(refused)), None);
        let counts = [
            tally.compared,
            tally.refused,
            tally.not_exact,
            tally.not_found,
        ];
        assert_eq!(counts, [2, 1, 4, 1]);
        assert_eq!(tally.worst.map(|(error, _)| error), Some(0.25));
    }

    /// What a map compares is a field of both answers: null where a quantity does not exist, and an error where the field does not.
    #[test]
    fn a_missing_field_is_an_error() {
        let sample = |places: [&str; 3], unless: &str| {
            let answers = Answers {
                line: String::new(),
                in_loop: json!({ "value": null, "name": "screw", "list": [1.0] }),
                reference: json!({ "value": 2.0, "list": null }),
            };
            answers.sample(places, unless).map(|sample| sample.numbers)
        };
        let numbers = sample(["/value", "/value", ""], "").unwrap();
        assert_eq!((numbers.found, numbers.exact), (None, Some(2.0)));
        let listed = sample(["/list/0", "/list/0", ""], "").unwrap();
        assert_eq!((listed.found, listed.exact), (Some(1.0), None));
        for (places, unless) in [
            (["/force", "/value", ""], ""),
            (["/value", "/force", ""], ""),
            (["/value", "/value", "/over"], ""),
            (["/value", "/value", ""], "/locked"),
            (["/name", "/value", ""], ""),
            (["/list/1", "/value", ""], ""),
        ] {
            assert!(sample(places, unless).is_err(), "{places:?} {unless}");
        }
        let broken = Answers {
            line: String::new(),
            in_loop: Value::Null,
            reference: json!({ "value": 2.0 }),
        };
        assert!(broken.sample(["/value", "/value", ""], "").is_err());
    }
}
