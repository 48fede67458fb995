//! `groove_curvature`: first and second principal curvature at a contact point.

use epas_friction::curvature::DEFAULT_FIT_RANGE;
use epas_friction::curvature::{
    CircularGrooveCurvature, FittedCurvature, GothicArch, LiteratureCurvature,
};
use epas_friction::geometry::{self, ContactAngle, GrooveProfile, HelixPath};
use epas_reference::curvature::{self, Surface};
use serde::Serialize;

use super::fields::{BadField, Fields, Value, in_range, request};
use super::model::{Both, Model};

/// The groove that is asked about.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Groove {
    /// That of the screw.
    Screw,
    /// That of the nut.
    Nut,
}

impl Value<'_> for Groove {
    fn take(fields: &mut Fields, field: &str) -> Result<Self, BadField> {
        fields.choice(field, &[("screw", Self::Screw), ("nut", Self::Nut)])
    }
}

request! {
    /// A point of a gothic arch.
    #[derive(Clone, Debug, Serialize)]
    pub struct Request {
        /// Screw or nut.
        groove: Groove,
        /// Radius of the helix of ball centres, m.
        pitch_radius: f64,
        /// Lead angle, rad, within a right angle.
        lead_angle: f64,
        /// Contact angle, rad, 0 to a right angle.
        contact_angle: f64,
        /// Radius of the groove's arcs, m.
        groove_radius: f64,
        /// Offset of the arc's centre, radial, m.
        offset_h: f64,
        /// Offset of the arc's centre, along the axis, m.
        offset_l: f64,
        /// Radius of the ball, 1e-9 to 1e9 m; without it there is no curvature of the literature.
        #[serde(skip_serializing_if = "Option::is_none")]
        ball_radius: Option<f64>,
    }
}

/// Curvatures of the crate, 1/m.
#[derive(Clone, Debug, Serialize)]
pub struct InLoop {
    /// First curvature by the literature; none without a ball radius.
    pub literature: Option<f64>,
    /// First curvature of a circular groove.
    pub circular_groove: f64,
    /// First curvature by the fit.
    pub fitted: f64,
    /// First curvature.
    pub kappa1: f64,
    /// Second curvature.
    pub kappa2: f64,
}

/// Curvatures of the reference, 1/m.
#[derive(Clone, Debug, Serialize)]
pub struct Reference {
    /// First curvature.
    pub kappa1: f64,
    /// Second curvature.
    pub kappa2: f64,
}

impl Model for Request {
    const NAME: &'static str = "groove_curvature";
    type InLoop = InLoop;
    type Reference = Reference;

    fn evaluate(&self) -> Result<Both<InLoop, Reference>, BadField> {
        let in_loop = self.in_loop()?;
        let surface = Surface {
            groove: match self.groove {
                Groove::Screw => curvature::Groove::Screw,
                Groove::Nut => curvature::Groove::Nut,
            },
            pitch_radius: self.pitch_radius,
            lead_angle: self.lead_angle,
            groove_radius: self.groove_radius,
            offset_h: self.offset_h,
            offset_l: self.offset_l,
        };
        surface.check(self.contact_angle)?;
        let truth = surface.principal(self.contact_angle);
        let reference = Reference {
            kappa1: truth.kappa1,
            kappa2: truth.kappa2,
        };
        Ok(Both { in_loop, reference })
    }
}

impl Request {
    fn in_loop(&self) -> Result<InLoop, BadField> {
        let groove = match self.groove {
            Groove::Screw => geometry::Groove::Screw,
            Groove::Nut => geometry::Groove::Nut,
        };
        let pitch_radius = self.pitch_radius as f32;
        let path = HelixPath::checked_from_lead_angle(pitch_radius, self.lead_angle as f32)?;
        let angle = ContactAngle::checked(self.contact_angle as f32)?;
        let profile = GrooveProfile {
            groove_radius: self.groove_radius as f32,
            offset_h: self.offset_h as f32,
            offset_l: self.offset_l as f32,
        };
        let arch = GothicArch::checked(groove, &path, &profile, angle).map_err(|error| {
            // The path follows from the pitch radius and an angle that is within its range.
            BadField::from(error)
                .renamed("curvature", "pitch_radius")
                .renamed("torsion", "pitch_radius")
        })?;
        let literature = self
            .ball_radius
            .map(|radius| in_range("ball_radius", radius, 1e-9, 1e9))
            .transpose()?
            .map(|radius| {
                let form = LiteratureCurvature::new(groove, pitch_radius, radius as f32);
                f64::from(form.first(angle))
            });
        let circular = CircularGrooveCurvature::new(groove, &path, profile.groove_radius);
        let fitted = FittedCurvature::new(&arch, fit_range(self.contact_angle as f32));
        let exact = arch.principal(angle);
        Ok(InLoop {
            literature,
            circular_groove: circular.first(angle).into(),
            fitted: fitted.first(angle).into(),
            kappa1: exact.kappa1.into(),
            kappa2: exact.kappa2.into(),
        })
    }
}

/// The default range of the fit, or as much more as puts this contact angle well inside.
pub fn fit_range(contact_angle: f32) -> f32 {
    /// Two degrees: as far as the outermost node stands from the end of the default range.
    const MARGIN: f32 = 0.035;
    (contact_angle + MARGIN).max(DEFAULT_FIT_RANGE)
}
