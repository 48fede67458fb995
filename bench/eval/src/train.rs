//! What requests about trains of balls have in common.

use epas_friction::train::{IMPEDANCE_RANGE, Press};
use epas_friction::{BallScrew, BallScrewParameters, Error, GrooveSize, Material};
use epas_reference::ReferenceError;
use epas_reference::design::BallScrewDesign;
use epas_reference::material::Elastic;

use serde::Serialize;

use super::fields::{BadField, in_range, request};

/// Most balls in a row of a request.
pub const LARGEST_TRAIN: usize = 64;

/// Rooms of a row of `count` balls that all touch, with nothing behind the first and ahead of the last.
pub fn room_of_a_row<const N: usize>(count: usize) -> [f32; N] {
    let mut room = [f32::INFINITY; N];
    for room in room.iter_mut().take(count.saturating_sub(1)) {
        *room = 0.0;
    }
    room
}

/// Lets balls press on each other by what each would do alone; false where one of them runs further from
/// nominal rolling than the crate counts.
pub fn pressed<const N: usize>(
    press: &mut Press<N>,
    free: &[f32; N],
    compliance: &[f32; N],
    room: &[f32; N],
) -> bool {
    let (least, most) = IMPEDANCE_RANGE;
    // A compliance beyond the range counts as the largest one: such a ball carries hardly any force.
    let impedance = compliance.map(|compliance| compliance.recip().clamp(least, most));
    press.solve(free, &impedance, room)
}

/// Between every ball and the next, the last one and the first included.
pub fn contact_forces<const N: usize>(press: &Press<N>) -> [f32; N] {
    let mut forces = [0.0; N];
    for (place, force) in forces.iter_mut().zip(press.forces()) {
        *place = force;
    }
    forces
}

request! {
    /// The numbers of a ball screw in a request; both grooves are alike.
    #[derive(Clone, Debug, Serialize)]
    pub struct ScrewNumbers {
        /// Pitch radius, m, 1e-4 to 10.
        pitch_radius: f64,
        /// Lead, m, 0 to 20 pitch radii.
        lead: f64,
        /// Ball radius, m, 1e-5 to 0.8 pitch radii.
        ball_radius: f64,
        /// Radius of the grooves' arcs, m, 1.002 to 1.999 ball radii.
        groove_radius: f64,
        /// Young's modulus of balls and grooves, Pa, 1e6 to 1e13.
        youngs_modulus: f64,
        /// Poisson's ratio, 0 to 0.49.
        poisson_ratio: f64,
    }
}

impl ScrewNumbers {
    /// The screw of Lin 2019, Table 2.1: what the report's and the tests' balls run in.
    pub const LIN_2_1: Self = Self {
        pitch_radius: 16.5e-3,
        lead: 20e-3,
        ball_radius: 2.778e-3,
        groove_radius: 3.254e-3,
        youngs_modulus: 2.1e11,
        poisson_ratio: 0.28,
    };

    pub(crate) fn check(&self) -> Result<(), BadField> {
        in_range("pitch_radius", self.pitch_radius, 1e-4, 10.0)?;
        in_range("lead", self.lead, 0.0, 20.0 * self.pitch_radius)?;
        let radius = self.ball_radius;
        in_range("ball_radius", radius, 1e-5, 0.8 * self.pitch_radius)?;
        // A ball that fills its groove has no place of its own.
        in_range(
            "groove_radius",
            self.groove_radius,
            1.002 * radius,
            1.999 * radius,
        )?;
        in_range("youngs_modulus", self.youngs_modulus, 1e6, 1e13)?;
        in_range("poisson_ratio", self.poisson_ratio, 0.0, 0.49)?;
        Ok(())
    }

    /// The reference's design with a nominal contact angle.
    pub(crate) const fn exact(&self, contact_angle: f64) -> BallScrewDesign {
        let material = Elastic {
            youngs_modulus: self.youngs_modulus,
            poisson_ratio: self.poisson_ratio,
        };
        BallScrewDesign {
            pitch_radius: self.pitch_radius,
            lead: self.lead,
            ball_radius: self.ball_radius,
            screw_groove_radius: self.groove_radius,
            nut_groove_radius: self.groove_radius,
            contact_angle,
            ball: material,
            groove: material,
        }
    }

    pub(crate) fn design(&self, contact_angle: f32) -> Result<BallScrew, Error> {
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

/// A refusal of the reference under the names that a request has for the numbers of a contact.
pub fn of_contact(error: impl Into<BadField>) -> BadField {
    error
        .into()
        .renamed("offset_h", "groove_radius")
        .renamed("relative_radius_1", "pitch_radius")
        .renamed("relative_radius_2", "groove_radius")
        .renamed("contact_modulus", "youngs_modulus")
}

/// The solution, `None` where there is none; an input out of range is a bad request.
pub fn solved<T>(result: Result<T, ReferenceError>) -> Result<Option<T>, BadField> {
    match result {
        Ok(solution) => Ok(Some(solution)),
        Err(error) if error.field().is_some() => Err(error.into()),
        Err(_) => Ok(None),
    }
}
