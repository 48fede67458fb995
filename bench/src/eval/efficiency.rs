//! `efficiency`: the closed forms and the locked states.

use epas_friction::efficiency::{Drive, EfficiencyGeometry};
use epas_friction::ranges::FRICTION_OR_NONE;
use epas_reference::efficiency::Screw;
use serde::Serialize;

use super::Answer;
use super::fields::{BadField, Fields, in_range};

#[derive(Serialize)]
struct Efficiencies {
    rolling_screw: f64,
    rolling_nut: f64,
    sliding_drive: f64,
    sliding_backdrive: f64,
    loss_drive: f64,
    locked_drive: bool,
    locked_backdrive: bool,
}

/// Answers one request.
pub fn evaluate(mut fields: Fields) -> Result<Answer, BadField> {
    let lead_angle = fields.number("lead_angle")?;
    let contact_angle = fields.number("contact_angle")?;
    let friction = fields.number("friction")?;
    let ball_ratio = fields.number("ball_ratio")?;
    let rolling_tangent = fields.optional_number("rolling_tangent")?.unwrap_or(0.0);
    fields.finish()?;

    in_range("friction", friction, 0.0, FRICTION_OR_NONE.maximum.into())?;
    in_range("rolling_tangent", rolling_tangent, 0.0, 1.0)?;
    let geometry =
        EfficiencyGeometry::new(lead_angle as f32, contact_angle as f32, ball_ratio as f32)?;
    let (f, t) = (friction as f32, rolling_tangent as f32);
    let in_loop = Efficiencies {
        rolling_screw: geometry.rolling_efficiency(f, t).into(),
        rolling_nut: geometry.rolling_nut_as_printed(f, t).into(),
        sliding_drive: geometry.sliding_efficiency(f).into(),
        sliding_backdrive: geometry.sliding_backdrive_efficiency(f).into(),
        loss_drive: geometry.sliding_loss(f).into(),
        locked_drive: geometry.locks(Drive::Driving, f),
        locked_backdrive: geometry.locks(Drive::BackDriving, f),
    };

    let screw = Screw {
        lead_angle,
        contact_angle,
        friction,
        ball_ratio,
        rolling_tangent,
    };
    let reference = Efficiencies {
        rolling_screw: screw.rolling_screw(),
        rolling_nut: screw.rolling_nut(),
        sliding_drive: screw.sliding_drive(),
        sliding_backdrive: screw.sliding_backdrive(),
        loss_drive: screw.loss_drive(),
        locked_drive: screw.locked_drive(),
        locked_backdrive: screw.locked_backdrive(),
    };
    Answer::both(&in_loop, &reference)
}
