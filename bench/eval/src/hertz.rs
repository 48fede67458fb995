//! `hertz`: the contact ellipse of one contact.

use epas_friction::hertz::HertzContact;
use epas_reference::hertz::Hertz;
use serde::Serialize;

use super::answer::Answer;
use super::fields::{BadField, Fields, in_range};

#[derive(Serialize)]
struct Ellipse {
    axis_ratio: f64,
    semi_major: f64,
    semi_minor: f64,
    deflection: f64,
    max_pressure: f64,
}

/// Answers one request.
pub fn evaluate(mut fields: Fields) -> Result<Answer, BadField> {
    let relative_radius_1 = fields.number("relative_radius_1")?;
    let relative_radius_2 = fields.number("relative_radius_2")?;
    let load = fields.number("load")?;
    let contact_modulus = fields.number("contact_modulus")?;
    fields.finish()?;

    in_range("load", load, 1e-12, 1e9)?;
    let contact = HertzContact::checked(
        relative_radius_1 as f32,
        relative_radius_2 as f32,
        contact_modulus as f32,
    )?;
    let ellipse = contact.at(load as f32);
    let in_loop = Ellipse {
        axis_ratio: contact.axis_ratio().into(),
        semi_major: ellipse.semi_major.into(),
        semi_minor: ellipse.semi_minor.into(),
        deflection: ellipse.deflection.into(),
        max_pressure: ellipse.max_pressure.into(),
    };

    let contact = Hertz::new(relative_radius_1, relative_radius_2, contact_modulus)?;
    let ellipse = contact.at(load);
    let reference = Ellipse {
        axis_ratio: contact.axis_ratio,
        semi_major: ellipse.semi_major,
        semi_minor: ellipse.semi_minor,
        deflection: ellipse.deflection,
        max_pressure: ellipse.max_pressure,
    };
    Answer::both(&in_loop, &reference)
}
