//! `groove_curvature`: first and second principal curvature at a contact point.

use epas_friction::curvature::DEFAULT_FIT_RANGE;
use epas_friction::curvature::{
    CircularGrooveCurvature, FittedCurvature, GothicArch, LiteratureCurvature,
};
use epas_friction::geometry::{ContactAngle, Groove, GrooveProfile, HelixPath};
use epas_reference::curvature::{self, Surface};
use serde::Serialize;

use super::answer::Answer;
use super::fields::{BadField, Fields, in_range};

#[derive(Serialize)]
struct InLoop {
    literature: Option<f64>,
    circular_groove: f64,
    fitted: f64,
    kappa1: f64,
    kappa2: f64,
}

#[derive(Serialize)]
struct Reference {
    kappa1: f64,
    kappa2: f64,
}

/// Answers one request.
pub fn evaluate(mut fields: Fields) -> Result<Answer, BadField> {
    let groove = fields.choice("groove", &[("screw", Groove::Screw), ("nut", Groove::Nut)])?;
    let pitch_radius = fields.number("pitch_radius")?;
    let lead_angle = fields.number("lead_angle")?;
    let contact_angle = fields.number("contact_angle")?;
    let groove_radius = fields.number("groove_radius")?;
    let offset_h = fields.number("offset_h")?;
    let offset_l = fields.number("offset_l")?;
    let ball_radius = fields.optional_number("ball_radius")?;
    fields.finish()?;

    let path = HelixPath::checked_from_lead_angle(pitch_radius as f32, lead_angle as f32)?;
    let angle = ContactAngle::checked(contact_angle as f32)?;
    let profile = GrooveProfile {
        groove_radius: groove_radius as f32,
        offset_h: offset_h as f32,
        offset_l: offset_l as f32,
    };
    let arch = GothicArch::checked(groove, &path, &profile, angle).map_err(|error| {
        // The path follows from the pitch radius and an angle that is within its range.
        BadField::from(error)
            .renamed("curvature", "pitch_radius")
            .renamed("torsion", "pitch_radius")
    })?;
    let literature = ball_radius
        .map(|radius| in_range("ball_radius", radius, 1e-9, 1e9))
        .transpose()?
        .map(|radius| {
            let form = LiteratureCurvature::new(groove, pitch_radius as f32, radius as f32);
            f64::from(form.first(angle))
        });
    let circular = CircularGrooveCurvature::new(groove, &path, profile.groove_radius);
    let exact = arch.principal(angle);
    let in_loop = InLoop {
        literature,
        circular_groove: circular.first(angle).into(),
        fitted: FittedCurvature::new(&arch, fit_range(contact_angle as f32))
            .first(angle)
            .into(),
        kappa1: exact.kappa1.into(),
        kappa2: exact.kappa2.into(),
    };

    let surface = Surface {
        groove: match groove {
            Groove::Screw => curvature::Groove::Screw,
            Groove::Nut => curvature::Groove::Nut,
        },
        pitch_radius,
        lead_angle,
        groove_radius,
        offset_h,
        offset_l,
    };
    surface.check(contact_angle)?;
    let truth = surface.principal(contact_angle);
    let reference = Reference {
        kappa1: truth.kappa1,
        kappa2: truth.kappa2,
    };
    Answer::both(&in_loop, &reference)
}

/// The default range of the fit, or as much more as puts this contact angle well inside.
pub fn fit_range(contact_angle: f32) -> f32 {
    /// Two degrees: as far as the outermost node stands from the end of the default range.
    const MARGIN: f32 = 0.035;
    (contact_angle + MARGIN).max(DEFAULT_FIT_RANGE)
}
