//! Drag of the lubricant that rolling contacts displace, in the form of its first publication.
//!
//! Sources: Biboulet and Houpert 2010, "Hydrodynamic force and moment in pure rolling lubricated contacts, part 2: point contacts", eqs. (14)
//! and (30) to (32); SKF General Catalogue, model of the frictional moment: rolling moment, inlet shear heating, starvation.

use std::f64::consts::{PI, TAU};

use crate::curvature::Groove;
use crate::design::BallScrewDesign;
use crate::error::ReferenceError;
use crate::hertz::{Hertz, complete_integrals};

/// A contact that rolls, with its lubricant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RollingFilm {
    /// Relative radius along the direction of rolling, m.
    pub rolling_radius: f64,
    /// Relative radius across it, m, not smaller.
    pub transverse_radius: f64,
    /// Contact modulus, Pa; `E'` is twice that.
    pub contact_modulus: f64,
}

impl RollingFilm {
    /// Force on each surface, N, under a load, N, at a viscosity, Pa s, and a mean speed of the surfaces, m/s:
    ///
    /// ```text
    /// FR = E' Rx^2 (2a/Rx) [(0.77 beta^(-1/3) kappa^0.12 U^(-1/12) - 1.8 beta^(-1/4))/(1 + M/6.6) + 1.8 beta^(-1/4)] U^(3/4)
    /// U = 2 eta u/(E' Rx)     M = beta^(1/4) kappa W/U^(3/4)     beta = 4/pi E/(1 + Rx/Rz)     kappa = b/a
    /// ```
    pub fn force(&self, load: f64, viscosity: f64, speed: f64) -> Result<f64, ReferenceError> {
        let Self {
            rolling_radius: radius,
            transverse_radius,
            contact_modulus,
        } = *self;
        let contact = Hertz::new(radius, transverse_radius, contact_modulus)?;
        let (_, second) = complete_integrals(contact.axis_ratio)?;
        let modulus = 2.0 * contact_modulus;
        let beta = 4.0 / PI * second / (1.0 + radius / transverse_radius);
        let kappa = contact.axis_ratio;
        let u = 2.0 * viscosity * speed / (modulus * radius);
        let w = load / (modulus * radius * radius);
        let m = beta.powf(0.25) * kappa * w / u.powf(0.75);
        let rigid = 0.77 * beta.powf(-1.0 / 3.0) * kappa.powf(0.12) * u.powf(-1.0 / 12.0);
        let elastic = 1.8 * beta.powf(-0.25);
        let length = 2.0 * contact.at(load).semi_major / radius;
        Ok(modulus
            * radius
            * radius
            * length
            * ((rigid - elastic) / (1.0 + m / 6.6) + elastic)
            * u.powf(0.75))
    }
}

/// Drag torque of a ball screw, N m, whose balls carry an axial load, N, in one flank: every contact by [`RollingFilm::force`], with the
/// power `2 FR u`, and [`inlet_shear_heating`] on the pitch circle.
pub fn screw_torque(
    design: &BallScrewDesign,
    balls: f64,
    axial_load: f64,
    (viscosity, density): (f64, f64),
    nut_speed: f64,
) -> Result<f64, ReferenceError> {
    let cos_lead = design.lead_angle().cos();
    let (sin, cos) = design.contact_angle.sin_cos();
    let load = axial_load / (balls * sin * cos_lead);
    let ratio = design.ball_radius * cos / design.pitch_radius;
    let speed = 0.5 * nut_speed * design.pitch_radius / cos_lead * (1.0 - ratio * ratio);
    let mut power = 0.0;
    for groove in [Groove::Screw, Groove::Nut] {
        let curvatures = design.surface(groove).principal(design.contact_angle);
        let ball = 1.0 / design.ball_radius;
        let contact = RollingFilm {
            rolling_radius: 1.0 / (ball + curvatures.kappa1),
            transverse_radius: 1.0 / (ball + curvatures.kappa2),
            contact_modulus: design.ball.contact_modulus(&design.groove),
        };
        power += balls * 2.0 * contact.force(load, viscosity, speed)? * speed;
    }
    let heating = inlet_shear_heating(
        nut_speed * 60.0 / TAU,
        2e3 * design.pitch_radius,
        1e6 * viscosity / density,
    );
    Ok(heating * power / nut_speed)
}

/// SKF's factor of inlet shear heating at a speed, 1/min, a mean diameter, mm, and a kinematic viscosity, mm²/s.
pub fn inlet_shear_heating(speed: f64, mean_diameter: f64, viscosity: f64) -> f64 {
    1.0 / (1.0 + 1.84e-9 * (speed * mean_diameter).powf(1.28) * viscosity.powf(0.64))
}
