//! `contact_kinematics`: slip, spin and entrainment of the two contacts of a ball, at their centres.

use epas_friction::kinematics::{ContactKinematics, KinematicsParameters};
use epas_reference::kinematics::{self as reference, KinematicsInput, Revised};
use serde::Serialize;

use super::answer::Answer;
use super::fields::{BadField, Fields, in_range};

#[derive(Serialize)]
struct Ball {
    orbital_speed: f64,
    spin_speed: f64,
    screw: Contact,
    nut: Contact,
}

#[derive(Serialize)]
struct Contact {
    rolling_slip: f64,
    side_slip: f64,
    spin: f64,
    entrainment_speed: f64,
    entrainment_angle: f64,
    slide_to_roll: f64,
    /// None where nothing slides.
    slide_angle: Option<f64>,
    spin_to_roll: f64,
}

/// Answers one request.
pub fn evaluate(mut fields: Fields) -> Result<Answer, BadField> {
    let input = KinematicsInput {
        ball_diameter: fields.number("ball_diameter")?,
        pitch_radius: fields.number("pitch_radius")?,
        lead_angle: fields.number("lead_angle")?,
        groove_radius_screw: fields.number("groove_radius_screw")?,
        groove_radius_nut: fields.number("groove_radius_nut")?,
        contact_angle_screw: fields.number("contact_angle_screw")?,
        contact_angle_nut: fields.number("contact_angle_nut")?,
        pitch_angle: fields.number("pitch_angle")?,
        yaw_angle: fields.number("yaw_angle")?,
        rolling_radius_screw: fields.number("rolling_radius_screw")?,
        rolling_radius_nut: fields.number("rolling_radius_nut")?,
        speed: fields.number("speed")?,
        semi_major_screw: fields.number("semi_major_screw")?,
        semi_minor_screw: fields.number("semi_minor_screw")?,
        semi_major_nut: fields.number("semi_major_nut")?,
        semi_minor_nut: fields.number("semi_minor_nut")?,
    };
    fields.finish()?;
    in_range("speed", input.speed, -1e6, 1e6)?;
    let in_loop = in_loop(&input)?;
    let reference = Revised::new(&input)?.evaluate();
    Answer::both(
        &in_loop,
        &Ball {
            orbital_speed: reference.orbital_speed,
            spin_speed: reference.spin_speed,
            screw: reference.screw.into(),
            nut: reference.nut.into(),
        },
    )
}

fn in_loop(input: &KinematicsInput) -> Result<Ball, BadField> {
    let model = ContactKinematics::new(&KinematicsParameters {
        ball_diameter: input.ball_diameter as f32,
        pitch_radius: input.pitch_radius as f32,
        lead_angle: input.lead_angle as f32,
        groove_radius_screw: input.groove_radius_screw as f32,
        groove_radius_nut: input.groove_radius_nut as f32,
        contact_angle_screw: input.contact_angle_screw as f32,
        contact_angle_nut: input.contact_angle_nut as f32,
        pitch_angle: input.pitch_angle as f32,
        yaw_angle: input.yaw_angle as f32,
        rolling_radius_screw: input.rolling_radius_screw as f32,
        rolling_radius_nut: input.rolling_radius_nut as f32,
        semi_major_screw: input.semi_major_screw as f32,
        semi_minor_screw: input.semi_minor_screw as f32,
        semi_major_nut: input.semi_major_nut as f32,
        semi_minor_nut: input.semi_minor_nut as f32,
    })?;
    let ball = model.tick(input.speed as f32);
    let contact = |slip: epas_friction::kinematics::ContactSlip,
                   ratios: epas_friction::kinematics::SlipRatios| Contact {
        rolling_slip: slip.rolling_slip.into(),
        side_slip: slip.side_slip.into(),
        spin: slip.spin.into(),
        entrainment_speed: slip.entrainment_speed.into(),
        entrainment_angle: ratios.entrainment_angle.into(),
        slide_to_roll: ratios.slide_to_roll.into(),
        slide_angle: (ratios.slide_to_roll > 0.0).then(|| ratios.slide_angle.into()),
        spin_to_roll: ratios.spin_to_roll.into(),
    };
    Ok(Ball {
        orbital_speed: ball.orbital_speed.into(),
        spin_speed: ball.spin_speed.into(),
        screw: contact(ball.screw, model.screw().ratios()),
        nut: contact(ball.nut, model.nut().ratios()),
    })
}

impl From<reference::ContactKinematics> for Contact {
    fn from(contact: reference::ContactKinematics) -> Self {
        Self {
            rolling_slip: contact.rolling_slip,
            side_slip: contact.side_slip,
            spin: contact.spin,
            entrainment_speed: contact.entrainment_speed,
            entrainment_angle: contact.entrainment_angle,
            slide_to_roll: contact.slide_to_roll,
            slide_angle: contact.slide_angle,
            spin_to_roll: contact.spin_to_roll,
        }
    }
}
