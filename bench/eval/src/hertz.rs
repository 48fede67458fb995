//! `hertz`: the contact ellipse of one contact.

use epas_friction::hertz::HertzContact;
use epas_reference::hertz::Hertz;
use serde::Serialize;

use super::fields::{BadField, in_range, request};
use super::model::{Both, Model};

request! {
    /// Two bodies that touch.
    #[derive(Clone, Debug, Serialize)]
    pub struct Request {
        /// Relative radius of curvature in one principal plane, m.
        relative_radius_1: f64,
        /// Relative radius of curvature in the other, m.
        relative_radius_2: f64,
        /// Normal force, N, 1e-12 to 1e9.
        load: f64,
        /// Contact modulus, Pa.
        contact_modulus: f64,
    }
}

/// The contact ellipse.
#[derive(Clone, Debug, Serialize)]
pub struct Ellipse {
    /// Minor over major axis.
    pub axis_ratio: f64,
    /// Semi-major axis, m.
    pub semi_major: f64,
    /// Semi-minor axis, m.
    pub semi_minor: f64,
    /// Approach of the bodies, m.
    pub deflection: f64,
    /// Largest pressure, Pa.
    pub max_pressure: f64,
}

impl Model for Request {
    const NAME: &'static str = "hertz";
    type InLoop = Ellipse;
    type Reference = Ellipse;

    fn evaluate(&self) -> Result<Both<Ellipse, Ellipse>, BadField> {
        in_range("load", self.load, 1e-12, 1e9)?;
        let (r1, r2) = (self.relative_radius_1, self.relative_radius_2);
        let modulus = self.contact_modulus;
        let contact = HertzContact::checked(r1 as f32, r2 as f32, modulus as f32)?;
        let ellipse = contact.at(self.load as f32);
        let in_loop = Ellipse {
            axis_ratio: contact.axis_ratio().into(),
            semi_major: ellipse.semi_major.into(),
            semi_minor: ellipse.semi_minor.into(),
            deflection: ellipse.deflection.into(),
            max_pressure: ellipse.max_pressure.into(),
        };
        let contact = Hertz::new(r1, r2, modulus)?;
        let ellipse = contact.at(self.load);
        let reference = Ellipse {
            axis_ratio: contact.axis_ratio,
            semi_major: ellipse.semi_major,
            semi_minor: ellipse.semi_minor,
            deflection: ellipse.deflection,
            max_pressure: ellipse.max_pressure,
        };
        Ok(Both { in_loop, reference })
    }
}
