//! Ways to choose the pitch angle: Alberdi et al., Table 1, and one from power.
//!
//! The raceway controls and the balanced angle are found as roots of the kinematics themselves, not
//! from closed forms. `None`: no such angle within 0.6 rad of the mean contact angle.
//!
//! Table 1's iterative method (ITE) is not defined in the paper and its 44° cannot be reconstructed.

use ellip::ellipe;
use epas_reference::kinematics::Revised;
use epas_reference::kinematics::{KinematicsInput, Raceway};
use roots::{SimpleConvergency, find_root_brent};
use std::f64::consts::FRAC_PI_2;

/// The kinematics at another pitch angle; `None` where they do not exist.
fn at(input: &KinematicsInput, pitch_angle: f64) -> Option<Revised> {
    Revised::new(&KinematicsInput {
        pitch_angle,
        ..*input
    })
    .ok()
}

fn root_near_contact_angle(input: &KinematicsInput, f: impl Fn(&Revised) -> f64) -> Option<f64> {
    let centre = 0.5 * (input.contact_angle_screw + input.contact_angle_nut);
    let low = (centre - 0.6).max(-FRAC_PI_2);
    let high = (centre + 0.6).min(FRAC_PI_2);
    let mut convergency = SimpleConvergency {
        eps: 1e-15,
        max_iter: 100,
    };
    let value = |angle| at(input, angle).map_or(f64::NAN, |revised| f(&revised));
    find_root_brent(low, high, value, &mut convergency).ok()
}

/// IRC, exact for a helix: no spin at the screw.
pub fn inner_raceway_control(input: &KinematicsInput) -> Option<f64> {
    root_near_contact_angle(input, |revised| revised.spin(Raceway::Screw))
}

/// ORC, exact for a helix: no spin at the nut.
pub fn outer_raceway_control(input: &KinematicsInput) -> Option<f64> {
    root_near_contact_angle(input, |revised| revised.spin(Raceway::Nut))
}

/// `D / d_m`.
fn ball_ratio(input: &KinematicsInput) -> f64 {
    0.5 * input.ball_diameter / input.pitch_radius
}

/// IRC as Table 1 prints it.
pub fn inner_raceway_control_printed(input: &KinematicsInput) -> f64 {
    let (sine, cosine) = input.contact_angle_screw.sin_cos();
    sine.atan2(cosine - ball_ratio(input))
}

/// ORC as Table 1 prints it.
pub fn outer_raceway_control_printed(input: &KinematicsInput) -> f64 {
    let (sine, cosine) = input.contact_angle_nut.sin_cos();
    sine.atan2(cosine + ball_ratio(input))
}

/// GEO: mean of the contact angles.
pub fn mean_contact_angle(input: &KinematicsInput) -> f64 {
    0.5 * (input.contact_angle_screw + input.contact_angle_nut)
}

/// Spin moment of a contact over `3/8 mu`: `W a E(1 - b^2/a^2)`; `None` for an ellipse without extent.
fn spin_moment(input: &KinematicsInput, raceway: Raceway, load: f64) -> Option<f64> {
    let contact = input.contact(raceway);
    let ratio = contact.semi_minor / contact.semi_major;
    let integral = ellipe(1.0 - ratio * ratio).ok()?;
    Some(load * contact.semi_major * integral)
}

/// DAL as Table 1 prints it; unverified, its source was not at hand.
pub fn d_alembert_printed(input: &KinematicsInput, load_screw: f64, load_nut: f64) -> Option<f64> {
    let c = spin_moment(input, Raceway::Nut, load_nut)?
        / spin_moment(input, Raceway::Screw, load_screw)?;
    Some(d_alembert_with(input, c, input.contact_angle_screw.cos()))
}

/// DAL with the two contradictions of Table 1 resolved: `cos alpha_o` beside `gamma'`, and `C`
/// turned over, so that the nut controls (ORC) where its spin moment rules. Unverified.
pub fn d_alembert(input: &KinematicsInput, load_screw: f64, load_nut: f64) -> Option<f64> {
    let c = spin_moment(input, Raceway::Screw, load_screw)?
        / spin_moment(input, Raceway::Nut, load_nut)?;
    Some(d_alembert_with(input, c, input.contact_angle_nut.cos()))
}

fn d_alembert_with(input: &KinematicsInput, c: f64, cosine_second: f64) -> f64 {
    let gamma = ball_ratio(input);
    let (sin_i, cos_i) = input.contact_angle_screw.sin_cos();
    let (sin_o, cos_o) = input.contact_angle_nut.sin_cos();
    let b = (1.0 + gamma * cos_o) / (1.0 - gamma * cos_i);
    let difference = input.contact_angle_screw - input.contact_angle_nut;
    let numerator = c * (b + 1.0) * sin_i + 2.0 * sin_o;
    let denominator =
        c * (b + 1.0) * cos_i + 2.0 * (cosine_second + gamma) + gamma * c * (difference.cos() - b);
    numerator.atan2(denominator)
}

/// Equal spin power `mu W 3/8 a E |spin|` at both contacts.
pub fn balanced_spin(input: &KinematicsInput, load_screw: f64, load_nut: f64) -> Option<f64> {
    let screw = spin_moment(input, Raceway::Screw, load_screw)?;
    let nut = spin_moment(input, Raceway::Nut, load_nut)?;
    root_near_contact_angle(input, |revised| {
        screw * revised.spin(Raceway::Screw) - nut * revised.spin(Raceway::Nut)
    })
}
