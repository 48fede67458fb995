//! `steady_state`: full sliding with the ball's inertia.

use std::f32::consts::TAU;

use epas_design::efficiency::DynamicCorrection;
use epas_friction::efficiency::EfficiencyGeometry;
use epas_friction::ranges::FRICTION_OR_NONE;
use epas_reference::ReferenceError;
use epas_reference::steady_state::BallScrewState;
use serde::Serialize;

use super::answer::Answer;
use super::fields::{BadField, Fields, in_range};

/// Density of a ball where the request gives none, kg/m³ (Lin, Velinsky, Ravani 1994).
const BALL_DENSITY: f64 = 7800.0;

#[derive(Serialize)]
struct InLoop {
    efficiency: f64,
}

#[derive(Default, Serialize)]
struct Reference {
    efficiency: Option<f64>,
    torque: Option<f64>,
    normal_screw: Option<f64>,
    normal_nut: Option<f64>,
    normal_nut_minor: Option<f64>,
    /// None where the solver cannot tell.
    exists: Option<bool>,
}

/// Answers one request.
pub fn evaluate(mut fields: Fields) -> Result<Answer, BadField> {
    let lead_angle = fields.number("lead_angle")?;
    let contact_angle = fields.number("contact_angle")?;
    let friction = fields.number("friction")?;
    let ball_radius = fields.number("ball_radius")?;
    let pitch_radius = fields.number("pitch_radius")?;
    let speed = fields.number("speed")?;
    let axial_load = fields.number("axial_load")?;
    let ball_density = fields.optional_number("ball_density")?;
    fields.finish()?;

    in_range("friction", friction, 0.0, FRICTION_OR_NONE.maximum.into())?;
    in_range("pitch_radius", pitch_radius, 1e-4, 10.0)?;
    in_range("ball_radius", ball_radius, 1e-5, pitch_radius)?;
    in_range("speed", speed, -1e6, 1e6)?;
    in_range("axial_load", axial_load, 1e-3, 1e7)?;
    let density = in_range(
        "ball_density",
        ball_density.unwrap_or(BALL_DENSITY),
        1.0,
        1e5,
    )?;

    let (r_b, r_m) = (ball_radius as f32, pitch_radius as f32);
    let geometry = EfficiencyGeometry::new(lead_angle as f32, contact_angle as f32, r_b / r_m)?;
    let mass = density as f32 * (2.0 / 3.0 * TAU) * r_b * r_b * r_b;
    let dynamic_number = mass * r_m * speed as f32 * speed as f32 / axial_load as f32;
    let in_loop = InLoop {
        efficiency: DynamicCorrection::new(&geometry, friction as f32)
            .efficiency(dynamic_number)
            .into(),
    };

    let state = BallScrewState {
        lead_angle,
        contact_angle,
        friction,
        ball_radius,
        pitch_radius,
        speed,
        axial_load,
        ball_density: density,
    };
    let reference = match state.solve() {
        Ok(solution) => Reference {
            efficiency: Some(solution.efficiency),
            torque: Some(solution.torque),
            normal_screw: Some(solution.normal_screw),
            normal_nut: Some(solution.normal_nut),
            normal_nut_minor: Some(solution.normal_nut_minor),
            exists: Some(true),
        },
        Err(error) if error.field().is_some() => return Err(error.into()),
        Err(ReferenceError::Frictionless | ReferenceError::Locked | ReferenceError::NoSlip) => {
            Reference {
                exists: Some(false),
                ..Reference::default()
            }
        }
        Err(_) => Reference::default(),
    };
    Answer::both(&in_loop, &reference)
}
