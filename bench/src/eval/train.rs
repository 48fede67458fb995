//! What requests about trains of balls have in common.

use epas_friction::train::IMPEDANCE_RANGE;
use epas_friction::train::Press;
use epas_friction::{BallScrew, BallScrewParameters, Error, GrooveSize, Material};
use epas_reference::ReferenceError;

use super::fields::BadField;

/// Most balls in a request.
pub const LARGEST_TRAIN: usize = 64;

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

/// Rooms of a row of `count` balls that all touch, with nothing behind the first and ahead of the last.
pub fn room_of_a_row(count: usize) -> [f32; LARGEST_TRAIN] {
    let mut room = [f32::INFINITY; LARGEST_TRAIN];
    for room in room.iter_mut().take(count.saturating_sub(1)) {
        *room = 0.0;
    }
    room
}

/// The solution, `None` where there is none; an input out of range is a bad request.
pub fn solved<T>(result: Result<T, ReferenceError>) -> Result<Option<T>, BadField> {
    match result {
        Ok(solution) => Ok(Some(solution)),
        Err(error) if error.field().is_some() => Err(error.into()),
        Err(_) => Ok(None),
    }
}

/// Lets balls press on each other by what each would do alone; false where one of them runs further from
/// nominal rolling than the crate counts.
pub fn pressed(
    press: &mut Press<LARGEST_TRAIN>,
    free: &[f32; LARGEST_TRAIN],
    compliance: &[f32; LARGEST_TRAIN],
    room: &[f32; LARGEST_TRAIN],
) -> bool {
    let (least, most) = IMPEDANCE_RANGE;
    // A compliance beyond the range counts as the largest one: such a ball carries hardly any force.
    let impedance = compliance.map(|compliance| compliance.recip().clamp(least, most));
    press.solve(free, &impedance, room)
}

/// Between every ball and the next, the last one and the first included.
pub fn contact_forces(press: &Press<LARGEST_TRAIN>) -> [f32; LARGEST_TRAIN] {
    let mut forces = [0.0; LARGEST_TRAIN];
    for (place, force) in forces.iter_mut().zip(press.forces()) {
        *place = force;
    }
    forces
}
