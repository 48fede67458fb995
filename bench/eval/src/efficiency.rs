//! `efficiency`: the closed forms and the locked states.

use epas_friction::efficiency::{Drive, EfficiencyGeometry};
use epas_friction::math::constant::sin_cos;
use epas_friction::ranges::FRICTION_OR_NONE;
use epas_reference::efficiency::Screw;
use serde::Serialize;

use super::fields::{BadField, Fields, in_range, request, same};
use super::model::{Both, Model};

request! {
    /// A ball screw, by its angles and friction.
    #[derive(Clone, Debug, Serialize)]
    pub struct Request {
        /// Lead angle, rad, within a right angle.
        lead_angle: f64,
        /// Contact angle, rad, within a right angle.
        contact_angle: f64,
        /// Friction coefficient, within [`FRICTION_OR_NONE`].
        friction: f64,
        /// Ball radius over pitch radius, below 1.
        ball_ratio: f64,
        /// Tangent of rolling friction, 0 to 1.
        rolling_tangent: f64 = |fields: &mut Fields| fields.or("rolling_tangent", 0.0),
    }
}

/// Efficiencies, and where they end.
#[derive(Clone, Debug, Serialize)]
pub struct Efficiencies {
    /// Of rolling balls, the screw driven.
    pub rolling_screw: f64,
    /// Of rolling balls, the nut driven; in the loop as printed.
    pub rolling_nut: f64,
    /// Of balls that slide, driving.
    pub sliding_drive: f64,
    /// Of balls that slide, back-driving.
    pub sliding_backdrive: f64,
    /// One less `sliding_drive`, without cancellation.
    pub loss_drive: f64,
    /// Whether driving locks.
    pub locked_drive: bool,
    /// Whether back-driving locks.
    pub locked_backdrive: bool,
}

impl Model for Request {
    const NAME: &'static str = "efficiency";
    type InLoop = Efficiencies;
    type Reference = Efficiencies;

    fn evaluate(&self) -> Result<Both<Efficiencies, Efficiencies>, BadField> {
        in_range(
            "friction",
            self.friction,
            0.0,
            FRICTION_OR_NONE.maximum.into(),
        )?;
        in_range("rolling_tangent", self.rolling_tangent, 0.0, 1.0)?;
        let in_loop = self.in_loop()?;
        let screw = same!(Screw { lead_angle, contact_angle, friction, ball_ratio, rolling_tangent } of self);
        let reference = Efficiencies {
            rolling_screw: screw.rolling_screw(),
            rolling_nut: screw.rolling_nut(),
            sliding_drive: screw.sliding_drive(),
            sliding_backdrive: screw.sliding_backdrive(),
            loss_drive: screw.loss_drive(),
            locked_drive: screw.locked_drive(),
            locked_backdrive: screw.locked_backdrive(),
        };
        Ok(Both { in_loop, reference })
    }
}

impl Request {
    fn in_loop(&self) -> Result<Efficiencies, BadField> {
        let (lead, contact) = (self.lead_angle as f32, self.contact_angle as f32);
        let (ratio, f, t) = (
            self.ball_ratio as f32,
            self.friction as f32,
            self.rolling_tangent as f32,
        );
        let geometry = EfficiencyGeometry::new(lead, contact, ratio)?;
        Ok(Efficiencies {
            rolling_screw: geometry.rolling_efficiency(f, t).into(),
            rolling_nut: rolling_nut_as_printed(lead, contact, ratio, f, t).into(),
            sliding_drive: geometry.sliding_efficiency(f).into(),
            sliding_backdrive: geometry.sliding_backdrive_efficiency(f).into(),
            loss_drive: geometry.sliding_loss(f).into(),
            locked_drive: geometry.locks(Drive::Driving, f),
            locked_backdrive: geometry.locks(Drive::BackDriving, f),
        })
    }
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
