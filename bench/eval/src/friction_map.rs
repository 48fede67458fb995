//! `friction_map`: friction of one contact with slip and spin, normalised.

use epas_friction::contact::FrictionMap;
use epas_friction::contact::SMALLEST_AXIS_RATIO;
use epas_reference::friction::maps;
use serde::Serialize;

use super::fields::{BadField, in_range, request, same};
use super::model::{Both, Model};

/// Largest offset that is answered: beyond, the contact slides and nothing changes.
const LARGEST_OFFSET: f64 = 1e9;

request! {
    /// A contact that slips and spins.
    #[derive(Clone, Debug, Serialize)]
    pub struct Request {
        /// Minor over major axis of the contact, [`SMALLEST_AXIS_RATIO`] to 1.
        axis_ratio: f64,
        /// Offset of the pole of the motion over the semi-major axis, up to 1e9 either way.
        offset: f64,
    }
}

/// Friction, normalised.
#[derive(Clone, Debug, Serialize)]
pub struct Friction {
    /// Force over friction coefficient and load.
    pub force: f64,
    /// Moment over the same and the semi-major axis.
    pub moment: f64,
    /// Power.
    pub power: f64,
}

impl Model for Request {
    const NAME: &'static str = "friction_map";
    type InLoop = Friction;
    type Reference = Friction;

    fn evaluate(&self) -> Result<Both<Friction, Friction>, BadField> {
        let ratio = in_range(
            "axis_ratio",
            self.axis_ratio,
            SMALLEST_AXIS_RATIO.into(),
            1.0,
        )?;
        in_range("offset", self.offset, -LARGEST_OFFSET, LARGEST_OFFSET)?;
        let fast = FrictionMap::new(ratio as f32)?.evaluate(self.offset as f32);
        let exact = maps::FrictionMap::new(ratio)
            .map_err(|error| BadField::new("axis_ratio", error.to_string()))?
            .at(self.offset);
        Ok(Both {
            in_loop: same!(Friction { force, moment, power } of fast),
            reference: same!(Friction { force, moment, power } of exact),
        })
    }
}
