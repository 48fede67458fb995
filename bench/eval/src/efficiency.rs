//! `efficiency`: the closed forms and the locked states.

use epas_friction::efficiency::{Drive, EfficiencyGeometry};
use epas_friction::math::constant::sin_cos;
use epas_friction::ranges::FRICTION_OR_NONE;
use epas_reference::efficiency::Screw;
use serde::Serialize;

use super::answer::Answer;
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
        rolling_nut: rolling_nut_as_printed(
            lead_angle as f32,
            contact_angle as f32,
            ball_ratio as f32,
            f,
            t,
        )
        .into(),
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

/// Rolling efficiency of a driven nut by eq. (4) of Lin, Velinsky, Ravani 1994 as printed, in f32, from angles in
/// rad, ball radius over pitch radius, friction coefficient and rolling tangent.
///
/// The print is wrong: `a + 2 Cb` and `a + Cb` stand where `a` and `a - Cb` must, which breaks the energy balance
/// by `2 f Cb`. It is answered because readers compare with the paper; the crate has eq. (3) for either drive.
fn rolling_nut_as_printed(
    lead_angle: f32,
    contact_angle: f32,
    ball_ratio: f32,
    friction: f32,
    rolling_tangent: f32,
) -> f32 {
    let (sin_lead, cos_lead) = sin_cos(lead_angle);
    let tan_lead = sin_lead / cos_lead;
    let (sin_contact, cos_contact) = sin_cos(contact_angle);
    let slide = friction * (ball_ratio + 2.0 * cos_contact);
    let grip = sin_contact + friction * (ball_ratio + cos_contact);
    let loss = if rolling_tangent > 0.0 {
        let secant_squared = 1.0 + tan_lead * tan_lead;
        (slide * tan_lead + rolling_tangent * secant_squared) / (grip * tan_lead + rolling_tangent)
    } else {
        slide / grip
    };
    1.0 - loss
}
