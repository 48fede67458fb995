//! One ball of a ball screw and what drives it: input of the steady state and of the ball's motion.

use crate::error::{ReferenceError, within};

/// One ball under its share of the axial load, screw driving.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BallScrewState {
    /// Lead angle, rad, above 0 to 1.5.
    pub lead_angle: f64,
    /// Contact angle, rad, 0.01 to 1.56.
    pub contact_angle: f64,
    /// Friction coefficient, 0 to 1.
    pub friction: f64,
    /// Ball radius, m.
    pub ball_radius: f64,
    /// Pitch radius, m.
    pub pitch_radius: f64,
    /// Angular speed of the screw, rad/s, not 0 in magnitude.
    pub speed: f64,
    /// Axial load of this ball, N.
    pub axial_load: f64,
    /// Density of the ball, kg/m³.
    pub ball_density: f64,
}

impl BallScrewState {
    /// Mass of the ball, kg.
    pub fn ball_mass(&self) -> f64 {
        self.ball_density * 4.0 / 3.0 * std::f64::consts::PI * self.ball_radius.powi(3)
    }

    /// Dynamic number `m r_m Omega² / Fa` of the first-order correction.
    pub fn dynamic_number(&self) -> f64 {
        self.ball_mass() * self.pitch_radius * self.speed * self.speed / self.axial_load
    }

    /// Refuses inputs outside their ranges.
    pub fn check(&self) -> Result<(), ReferenceError> {
        within("lead_angle", self.lead_angle, 1e-6, 1.5)?;
        within("contact_angle", self.contact_angle, 0.01, 1.56)?;
        within("friction", self.friction, 0.0, 1.0)?;
        within("pitch_radius", self.pitch_radius, 1e-6, 1e3)?;
        within(
            "ball_radius",
            self.ball_radius,
            1e-7,
            0.99 * self.pitch_radius,
        )?;
        within("speed", self.speed, -1e6, 1e6)?;
        if self.speed.abs() < 1e-6 {
            return Err(ReferenceError::input(
                "speed",
                "a steady state needs motion",
            ));
        }
        within("axial_load", self.axial_load, 1e-6, 1e9)?;
        within("ball_density", self.ball_density, 1.0, 1e6)?;
        Ok(())
    }
}
