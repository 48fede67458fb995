//! A design of the crate as one of the reference: the numbers of its drawing, in float64.

use epas_friction::{BallScrewParameters, GrooveSize, Material};
use epas_reference::design::BallScrewDesign;
use epas_reference::material::Elastic;

/// The reference's design with the numbers of a drawing.
#[must_use]
pub fn drawing(parameters: &BallScrewParameters) -> BallScrewDesign {
    let ball_radius = f64::from(parameters.ball_radius);
    let groove_radius = |size: GrooveSize| match size {
        GrooveSize::Conformity(conformity) => 2.0 * f64::from(conformity) * ball_radius,
        GrooveSize::Radius(radius) => radius.into(),
    };
    let elastic = |material: &Material| Elastic {
        youngs_modulus: material.youngs_modulus.into(),
        poisson_ratio: material.poisson_ratio.into(),
    };
    BallScrewDesign {
        pitch_radius: parameters.pitch_radius.into(),
        lead: parameters.lead.into(),
        ball_radius,
        screw_groove_radius: groove_radius(parameters.screw_groove),
        nut_groove_radius: groove_radius(parameters.nut_groove),
        contact_angle: parameters.contact_angle.into(),
        ball: elastic(&parameters.ball_material),
        groove: elastic(&parameters.groove_material),
    }
}
