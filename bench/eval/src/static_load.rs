//! `static_load`: how the balls of a ball screw share an axial load.

use epas_reference::statics::cases::{CaseStudy, ScrewEnd};
use epas_reference::statics::{Contact, Elastic, Geometry, HertzConvention, StaticSolution};
use serde::Serialize;

use super::fields::{BadField, Fields, OneOrMany, in_range};
use super::model::{Answer, Both};
use super::train::solved;

/// Most balls in a request.
const LARGEST_TRAIN: f64 = 10_000.0;

/// All null where the solver cannot tell.
#[derive(Default, Serialize)]
struct Reference {
    screw_left: Option<Vec<f64>>,
    screw_right: Option<Vec<f64>>,
    nut_left: Option<Vec<f64>>,
    nut_right: Option<Vec<f64>>,
    axial_displacement: Option<f64>,
    balls_lost: Option<usize>,
}

impl From<StaticSolution> for Reference {
    fn from(solution: StaticSolution) -> Self {
        Self {
            screw_left: Some(solution.of(Contact::ScrewLeft)),
            screw_right: Some(solution.of(Contact::ScrewRight)),
            nut_left: Some(solution.of(Contact::NutLeft)),
            nut_right: Some(solution.of(Contact::NutRight)),
            axial_displacement: Some(solution.axial_displacement()),
            balls_lost: Some(solution.balls_lost),
        }
    }
}

/// Answers one request.
pub fn evaluate(mut fields: Fields) -> Result<Answer, BadField> {
    let balls = whole("balls", fields.get("balls")?)?;
    let case = CaseStudy {
        geometry: Geometry {
            pitch_radius: fields.get("pitch_radius")?,
            lead: fields.get("lead")?,
            ball_radius: fields.get("ball_radius")?,
            groove_radius: fields.get("groove_radius")?,
            contact_angle: fields.get("contact_angle")?,
        },
        elastic: Elastic {
            youngs_modulus: fields.get("youngs_modulus")?,
            poisson_ratio: fields.get("poisson_ratio")?,
        },
        screw_length: fields.get("screw_length")?,
        screw_diameter: fields.get("screw_diameter")?,
        balls,
        ball_spacing: fields.get("ball_spacing")?,
        first_azimuth: 0.0,
        nut_position: fields.get("nut_position")?,
        axial_load: fields.get("axial_load")?,
        loaded_end: ScrewEnd::Left,
        ball_oversize: match fields.get("ball_oversize")? {
            None => Vec::new(),
            Some(OneOrMany::One(all)) => vec![all; balls],
            Some(OneOrMany::Many(each)) if each.len() == balls => each,
            Some(OneOrMany::Many(each)) => {
                return Err(BadField::new(
                    "ball_oversize",
                    format!("has {} numbers for {balls} balls", each.len()),
                ));
            }
        },
        end_offset: fields.get("end_offset")?,
        refinement: 1,
        convention: HertzConvention::Correct,
    };
    fields.finish()?;
    let solution = solved(case.load()?.solve())?;
    let reference = solution.map_or_else(Reference::default, Reference::from);
    Both {
        in_loop: (),
        reference,
    }
    .json()
}

fn whole(field: &str, value: f64) -> Result<usize, BadField> {
    in_range(field, value, 1.0, LARGEST_TRAIN)?;
    if value.fract() == 0.0 {
        Ok(value as usize)
    } else {
        Err(BadField::new(
            field,
            format!("{value} is not a whole number"),
        ))
    }
}
