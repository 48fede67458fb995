//! What requests about trains of balls have in common.

use epas_friction::{BallScrew, BallScrewParameters, Error, GrooveSize, Material};
use epas_reference::ReferenceError;
pub use epas_rows::{LARGEST_TRAIN, contact_forces, pressed, room_of_a_row};

use super::fields::BadField;

/// The numbers of a ball screw in a request, SI; both grooves are alike.
pub struct ScrewNumbers {
    pub pitch_radius: f64,
    pub lead: f64,
    pub ball_radius: f64,
    pub groove_radius: f64,
    pub youngs_modulus: f64,
    pub poisson_ratio: f64,
}

impl ScrewNumbers {
    /// The crate's design with a nominal contact angle.
    pub fn design(&self, contact_angle: f32) -> Result<BallScrew, Error> {
        let material = Material {
            youngs_modulus: self.youngs_modulus as f32,
            poisson_ratio: self.poisson_ratio as f32,
            ..Material::STEEL
        };
        let groove = GrooveSize::Radius(self.groove_radius as f32);
        BallScrew::new(BallScrewParameters {
            pitch_radius: self.pitch_radius as f32,
            lead: self.lead as f32,
            ball_radius: self.ball_radius as f32,
            screw_groove: groove,
            nut_groove: groove,
            contact_angle,
            ball_material: material,
            groove_material: material,
        })
    }
}

/// The solution, `None` where there is none; an input out of range is a bad request.
pub fn solved<T>(result: Result<T, ReferenceError>) -> Result<Option<T>, BadField> {
    match result {
        Ok(solution) => Ok(Some(solution)),
        Err(error) if error.field().is_some() => Err(error.into()),
        Err(_) => Ok(None),
    }
}
