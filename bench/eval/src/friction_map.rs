//! `friction_map`: friction of one contact with slip and spin, normalised.

use epas_friction::contact::FrictionMap;
use epas_friction::contact::SMALLEST_AXIS_RATIO;
use epas_reference::friction::maps;
use serde::Serialize;

use super::answer::Answer;
use super::fields::{BadField, Fields, in_range};

/// Largest offset that is answered: beyond, the contact slides and nothing changes.
const LARGEST_OFFSET: f64 = 1e9;

#[derive(Serialize)]
struct Friction {
    force: f64,
    moment: f64,
    power: f64,
}

/// Answers one request.
pub fn evaluate(mut fields: Fields) -> Result<Answer, BadField> {
    let axis_ratio = fields.number("axis_ratio")?;
    let offset = fields.number("offset")?;
    fields.finish()?;

    in_range("axis_ratio", axis_ratio, SMALLEST_AXIS_RATIO.into(), 1.0)?;
    in_range("offset", offset, -LARGEST_OFFSET, LARGEST_OFFSET)?;
    let fast = FrictionMap::new(axis_ratio as f32)?.evaluate(offset as f32);
    let exact = maps::FrictionMap::new(axis_ratio)
        .map_err(|error| BadField::new("axis_ratio", error.to_string()))?
        .at(offset);
    Answer::both(
        &Friction {
            force: fast.force.into(),
            moment: fast.moment.into(),
            power: fast.power.into(),
        },
        &Friction {
            force: exact.force,
            moment: exact.moment,
            power: exact.power,
        },
    )
}
