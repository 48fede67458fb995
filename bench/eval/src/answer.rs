//! What a model answers: what the crate computes, and what the reference computes.

use serde::Serialize;
use serde_json::value::{RawValue, to_raw_value};

use super::fields::BadField;

/// What one model says to one request.
pub struct Answer {
    /// What the crate computes in f32; null where only the reference has the model.
    pub in_loop: Option<Box<RawValue>>,
    /// What the float64 reference computes.
    pub reference: Option<Box<RawValue>>,
}

impl Answer {
    /// The answer of a model that both the crate and the reference have.
    pub fn both(in_loop: &impl Serialize, reference: &impl Serialize) -> Result<Self, BadField> {
        Ok(Self {
            in_loop: Some(json(in_loop)?),
            reference: Some(json(reference)?),
        })
    }

    /// The answer of a model that only the reference has.
    pub fn reference_only(reference: &impl Serialize) -> Result<Self, BadField> {
        Ok(Self {
            in_loop: Some(json(&())?),
            reference: Some(json(reference)?),
        })
    }
}

/// Writes numbers with the fewest digits that read back as the same float64, and those that are not
/// finite as null.
fn json(value: &impl Serialize) -> Result<Box<RawValue>, BadField> {
    to_raw_value(value).map_err(|error| BadField::request(error.to_string()))
}
