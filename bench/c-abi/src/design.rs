//! Designs: the crate's from the C structure's, with the failure at the C structure's field.

use epas_friction::{
    BallScrewParameters, Clearance, Error, GrooveSize, LinearBearingParameters,
    Material as CrateMaterial,
};

use crate::status::{
    EPAS_FIELD_BALL_DENSITY, EPAS_FIELD_BALL_POISSON_RATIO, EPAS_FIELD_BALL_YOUNGS_MODULUS,
    EPAS_FIELD_BALLS, EPAS_FIELD_GROOVE_DENSITY, EPAS_FIELD_GROOVE_POISSON_RATIO,
    EPAS_FIELD_GROOVE_YOUNGS_MODULUS, EPAS_FIELD_LOADED_BALLS, EPAS_FIELD_NUT_CONFORMITY,
    EPAS_FIELD_SCREW_CONFORMITY, Failure,
};
use crate::types::{BallScrew, EPAS_MOST_BALLS, LinearBearing, Material};

/// Largest number of balls that carry load in a nut.
const MOST_LOADED_BALLS: u16 = 1000;

const fn material(material: &Material) -> CrateMaterial {
    CrateMaterial {
        youngs_modulus: material.youngs_modulus,
        poisson_ratio: material.poisson_ratio,
        density: material.density,
    }
}

/// Which of the two materials the crate refused: it has the balls' first.
fn material_field(error: &Error, ball: &Material) -> Option<u32> {
    let is_ball = |value: f32| value.to_bits() == error.value().to_bits();
    let pick = |ball: bool, fields: [u32; 2]| Some(if ball { fields[0] } else { fields[1] });
    match error.field() {
        "youngs_modulus" => pick(
            is_ball(ball.youngs_modulus),
            [
                EPAS_FIELD_BALL_YOUNGS_MODULUS,
                EPAS_FIELD_GROOVE_YOUNGS_MODULUS,
            ],
        ),
        "poisson_ratio" => pick(
            is_ball(ball.poisson_ratio),
            [
                EPAS_FIELD_BALL_POISSON_RATIO,
                EPAS_FIELD_GROOVE_POISSON_RATIO,
            ],
        ),
        "density" => pick(
            is_ball(ball.density),
            [EPAS_FIELD_BALL_DENSITY, EPAS_FIELD_GROOVE_DENSITY],
        ),
        _ => None,
    }
}

pub(crate) fn ball_screw(design: &BallScrew) -> Result<epas_friction::BallScrew, Failure> {
    epas_friction::BallScrew::new(BallScrewParameters {
        pitch_radius: design.pitch_radius,
        lead: design.lead,
        ball_radius: design.ball_radius,
        screw_groove: GrooveSize::Conformity(design.screw_conformity),
        nut_groove: GrooveSize::Conformity(design.nut_conformity),
        contact_angle: design.contact_angle,
        ball_material: material(&design.ball_material),
        groove_material: material(&design.groove_material),
    })
    .map_err(|error| match error.field() {
        // The screw's is checked first.
        "conformity" if error.value().to_bits() == design.screw_conformity.to_bits() => {
            Failure::at(error, EPAS_FIELD_SCREW_CONFORMITY)
        }
        "conformity" => Failure::at(error, EPAS_FIELD_NUT_CONFORMITY),
        // The groove is folded; what is allowed is a radius.
        "groove_radius" => Failure {
            value: design.screw_conformity,
            maximum: error.allowed().maximum / (2.0 * design.ball_radius),
            ..Failure::at(error, EPAS_FIELD_SCREW_CONFORMITY)
        },
        _ => match material_field(&error, &design.ball_material) {
            Some(field) => Failure::at(error, field),
            None => Failure::of(error),
        },
    })
}

pub(crate) fn linear_bearing(
    design: &LinearBearing,
) -> Result<epas_friction::LinearBearing, Failure> {
    epas_friction::LinearBearing::new(LinearBearingParameters {
        ball_radius: design.ball_radius,
        groove: GrooveSize::Conformity(design.conformity),
        contact_angle: design.contact_angle,
        ball_material: material(&design.ball_material),
        groove_material: material(&design.groove_material),
    })
    .map_err(
        |error| match material_field(&error, &design.ball_material) {
            Some(field) => Failure::at(error, field),
            None => Failure::of(error),
        },
    )
}

/// The crate's clearance, of a gap that is checked against the design where it is used.
pub(crate) fn clearance(gap: f32) -> Result<Clearance, Failure> {
    Clearance::new(gap).map_err(Failure::of)
}

/// The crate's number of loaded balls.
pub(crate) fn loaded_balls(count: u32) -> Result<u16, Failure> {
    counted(EPAS_FIELD_LOADED_BALLS, count, MOST_LOADED_BALLS)
}

/// The crate's number of balls in a circuit.
pub(crate) fn balls(count: u32) -> Result<u16, Failure> {
    let most = u16::try_from(EPAS_MOST_BALLS).unwrap_or(u16::MAX);
    counted(EPAS_FIELD_BALLS, count, most)
}

fn counted(field: u32, count: u32, most: u16) -> Result<u16, Failure> {
    match u16::try_from(count) {
        Ok(balls) if (1..=most).contains(&balls) => Ok(balls),
        _ => Err(Failure::count(field, count, 1, u32::from(most))),
    }
}
