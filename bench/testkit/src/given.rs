//! The numbers that a design of the crate was made from, widened to float64, for the reference: inputs
//! only, nothing that the crate has computed.

use epas_friction::{BallScrewParameters, GrooveSize, LinearBearingParameters, Material};
use epas_reference::design::{BallScrewDesign, LinearBearingDesign};
use epas_reference::material::Elastic;

/// A ball screw.
pub fn ball_screw(parameters: &BallScrewParameters) -> BallScrewDesign {
    let ball_radius = f64::from(parameters.ball_radius);
    BallScrewDesign {
        pitch_radius: parameters.pitch_radius.into(),
        lead: parameters.lead.into(),
        ball_radius,
        screw_groove_radius: groove_radius(parameters.screw_groove, ball_radius),
        nut_groove_radius: groove_radius(parameters.nut_groove, ball_radius),
        contact_angle: parameters.contact_angle.into(),
        ball: elastic(&parameters.ball_material),
        groove: elastic(&parameters.groove_material),
    }
}

/// A linear bearing.
pub fn linear_bearing(parameters: &LinearBearingParameters) -> LinearBearingDesign {
    let ball_radius = f64::from(parameters.ball_radius);
    LinearBearingDesign {
        ball_radius,
        groove_radius: groove_radius(parameters.groove, ball_radius),
        ball: elastic(&parameters.ball_material),
        groove: elastic(&parameters.groove_material),
    }
}

fn groove_radius(size: GrooveSize, ball_radius: f64) -> f64 {
    match size {
        GrooveSize::Radius(radius) => radius.into(),
        GrooveSize::Conformity(conformity) => 2.0 * f64::from(conformity) * ball_radius,
    }
}

fn elastic(material: &Material) -> Elastic {
    Elastic {
        youngs_modulus: material.youngs_modulus.into(),
        poisson_ratio: material.poisson_ratio.into(),
    }
}
