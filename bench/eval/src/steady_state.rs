//! `steady_state`: full sliding with the ball's inertia.

use std::f32::consts::TAU;

use epas_design::efficiency::DynamicCorrection;
use epas_friction::efficiency::EfficiencyGeometry;
use epas_friction::ranges::FRICTION_OR_NONE;
use epas_reference::ReferenceError;
use epas_reference::steady_state::BallScrewState;
use serde::Serialize;

use super::fields::{BadField, Fields, in_range, request, same};
use super::model::{Both, Model};

/// Density of a ball where the request gives none, kg/m³ (Lin, Velinsky, Ravani 1994).
pub const BALL_DENSITY: f64 = 7800.0;

request! {
    /// A ball screw at a steady speed.
    #[derive(Clone, Debug, Serialize)]
    pub struct Request {
        /// Lead angle, rad, within a right angle.
        lead_angle: f64,
        /// Contact angle, rad, within a right angle.
        contact_angle: f64,
        /// Friction coefficient, within [`FRICTION_OR_NONE`].
        friction: f64,
        /// Ball radius, m, 1e-5 to the pitch radius.
        ball_radius: f64,
        /// Pitch radius, m, 1e-4 to 10.
        pitch_radius: f64,
        /// Speed of the screw, rad/s, up to 1e6 either way.
        speed: f64,
        /// Axial load of a ball, N, 1e-3 to 1e7.
        axial_load: f64,
        /// Density of a ball, kg/m³, 1 to 1e5; a line may leave it out.
        ball_density: f64 = |fields: &mut Fields| fields.or("ball_density", BALL_DENSITY),
    }
}

/// What the crate finds.
#[derive(Clone, Debug, Serialize)]
pub struct InLoop {
    /// Efficiency with the dynamic correction.
    pub efficiency: f64,
}

/// What the reference finds; none where there is no steady state or the solver cannot tell.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Reference {
    /// Efficiency.
    pub efficiency: Option<f64>,
    /// Torque of a ball on the screw, N m.
    pub torque: Option<f64>,
    /// Normal force at the screw, N.
    pub normal_screw: Option<f64>,
    /// Normal force at the nut, N.
    pub normal_nut: Option<f64>,
    /// Normal force at the nut's other contact, N.
    pub normal_nut_minor: Option<f64>,
    /// Whether there is a steady state; none where the solver cannot tell.
    pub exists: Option<bool>,
}

impl Model for Request {
    const NAME: &'static str = "steady_state";
    type InLoop = InLoop;
    type Reference = Reference;

    fn evaluate(&self) -> Result<Both<InLoop, Reference>, BadField> {
        in_range(
            "friction",
            self.friction,
            0.0,
            FRICTION_OR_NONE.maximum.into(),
        )?;
        in_range("pitch_radius", self.pitch_radius, 1e-4, 10.0)?;
        in_range("ball_radius", self.ball_radius, 1e-5, self.pitch_radius)?;
        in_range("speed", self.speed, -1e6, 1e6)?;
        in_range("axial_load", self.axial_load, 1e-3, 1e7)?;
        in_range("ball_density", self.ball_density, 1.0, 1e5)?;
        Ok(Both {
            in_loop: self.in_loop()?,
            reference: self.reference()?,
        })
    }
}

impl Request {
    fn in_loop(&self) -> Result<InLoop, BadField> {
        let (r_b, r_m) = (self.ball_radius as f32, self.pitch_radius as f32);
        let geometry =
            EfficiencyGeometry::new(self.lead_angle as f32, self.contact_angle as f32, r_b / r_m)?;
        let mass = self.ball_density as f32 * (2.0 / 3.0 * TAU) * r_b * r_b * r_b;
        let speed = self.speed as f32;
        let dynamic_number = mass * r_m * speed * speed / self.axial_load as f32;
        let correction = DynamicCorrection::new(&geometry, self.friction as f32);
        Ok(InLoop {
            efficiency: correction.efficiency(dynamic_number).into(),
        })
    }

    fn reference(&self) -> Result<Reference, BadField> {
        let state = same!(BallScrewState {
            lead_angle, contact_angle, friction, ball_radius, pitch_radius, speed, axial_load, ball_density,
        } of self);
        match state.solve() {
            Ok(solution) => Ok(Reference {
                efficiency: Some(solution.efficiency),
                torque: Some(solution.torque),
                normal_screw: Some(solution.normal_screw),
                normal_nut: Some(solution.normal_nut),
                normal_nut_minor: Some(solution.normal_nut_minor),
                exists: Some(true),
            }),
            Err(error) if error.field().is_some() => Err(error.into()),
            Err(ReferenceError::Frictionless | ReferenceError::Locked | ReferenceError::NoSlip) => {
                Ok(Reference {
                    exists: Some(false),
                    ..Reference::default()
                })
            }
            Err(_) => Ok(Reference::default()),
        }
    }
}
