//! What a load case gives.

use super::geometry::{Contact, centre_signs};
use super::problem::{State, StaticLoad};
use super::system::Evaluation;

/// Whether the balls carry anything.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// At least one ball is in contact.
    Loaded,
    /// No ball is in contact: nothing resists an axial load, and displacements along it are arbitrary.
    AllBallsLost,
}

/// Forces and displacements of a load case.
#[derive(Clone, Debug, PartialEq)]
pub struct StaticSolution {
    /// Whether the balls carry anything.
    pub outcome: Outcome,
    /// Contact forces SL, SR, NL, NR of each ball, N.
    pub forces: Vec<[f64; 4]>,
    /// Contact angles SL, SR, NL, NR of each ball, rad; nominal where there is no such contact.
    pub contact_angles: Vec<[f64; 4]>,
    /// Number of balls without any contact force.
    pub balls_lost: usize,
    /// Positions of the shaft's nodes, m.
    pub positions: Vec<f64>,
    /// Displacement (m) and rotation (rad) of each node.
    pub displacements: Vec<[f64; 6]>,
    /// Forces (N) and moments (N m) of each support on the shaft, in the order given.
    pub reactions: Vec<[f64; 6]>,
    /// Force (N) of the balls on the nut and its moment (N m) about the origin.
    pub on_nut: [f64; 6],
    /// Energy, J.
    pub energy: f64,
    /// Steps taken.
    pub iterations: usize,
    /// Largest unbalanced force over the largest force.
    pub residual: f64,
    /// The unknowns, to start a neighbouring case from.
    pub state: State,
}

/// Least force, N, that residuals and lost contacts are measured against. In a screw without load all
/// forces go to zero, and relative to them no residual would ever be small.
pub const LEAST_FORCE: f64 = 1e-9;
const LOST: f64 = 1e-9;

impl StaticSolution {
    pub(super) fn new(
        case: &StaticLoad,
        state: &State,
        at: &Evaluation,
        iterations: usize,
        residual: f64,
    ) -> Self {
        let nominal = case.geometry.contact_angle;
        let forces: Vec<[f64; 4]> = at
            .touches
            .iter()
            .map(|four| four.map(|touch| touch.map_or(0.0, |touch| touch.force)))
            .collect();
        let contact_angles = at
            .touches
            .iter()
            .map(|four| {
                let mut angles = [nominal; 4];
                for ((angle, touch), contact) in angles.iter_mut().zip(four).zip(Contact::ALL) {
                    if let Some(touch) = touch {
                        let [outward, along] = centre_signs(contact);
                        *angle = (-along * touch.normal.y).atan2(-outward * touch.normal.x);
                    }
                }
                angles
            })
            .collect();
        let largest = forces
            .iter()
            .flatten()
            .fold(LEAST_FORCE, |most: f64, force| most.max(*force));
        let balls_lost = forces
            .iter()
            .filter(|four| four.iter().all(|force| *force <= LOST * largest))
            .count();
        let reactions = case
            .supports
            .iter()
            .map(|(node, values)| {
                let mut reaction = [0.0; 6];
                for (axis, entry) in reaction.iter_mut().enumerate() {
                    if values[axis].is_some() {
                        *entry = at.nodes[6 * node + axis];
                    }
                }
                reaction
            })
            .collect();
        Self {
            outcome: if balls_lost == forces.len() {
                Outcome::AllBallsLost
            } else {
                Outcome::Loaded
            },
            on_nut: on_nut(case, at),
            forces,
            contact_angles,
            balls_lost,
            positions: case.shaft.nodes.clone(),
            displacements: state
                .nodes
                .chunks_exact(6)
                .map(|six| [six[0], six[1], six[2], six[3], six[4], six[5]])
                .collect(),
            reactions,
            energy: at.energy,
            iterations,
            residual,
            state: state.clone(),
        }
    }

    /// Forces of one contact along the train, N.
    pub fn of(&self, contact: Contact) -> Vec<f64> {
        let index = Contact::ALL.iter().position(|other| *other == contact);
        self.forces
            .iter()
            .map(|four| four[index.unwrap_or(0)])
            .collect()
    }

    /// Axial displacement of the shaft's left end, m.
    pub fn axial_displacement(&self) -> f64 {
        self.displacements.first().map_or(0.0, |six| six[2])
    }

    /// Force (N) of the balls on the nut and its moment (N m) about a place on the axis, m.
    pub fn on_nut_about(&self, position: f64) -> [f64; 6] {
        let [x, y, z, about_x, about_y, about_z] = self.on_nut;
        [
            x,
            y,
            z,
            about_x + position * y,
            about_y - position * x,
            about_z,
        ]
    }

    /// Share of each ball in the axial load: the axial part of its forces on the nut over their sum.
    /// None where nothing is carried along the axis.
    pub fn axial_shares(&self) -> Option<Vec<f64>> {
        let axial: Vec<f64> = self
            .forces
            .iter()
            .zip(&self.contact_angles)
            .map(|(force, angle)| force[3] * angle[3].sin() - force[2] * angle[2].sin())
            .collect();
        let sum: f64 = axial.iter().sum();
        let largest = axial
            .iter()
            .fold(0.0, |most: f64, part| most.max(part.abs()));
        (largest > 0.0 && sum.abs() > 1e-9 * largest)
            .then(|| axial.iter().map(|part| part / sum).collect())
    }
}

fn on_nut(case: &StaticLoad, at: &Evaluation) -> [f64; 6] {
    let mut force = nalgebra::Vector3::zeros();
    let mut moment = nalgebra::Vector3::zeros();
    for (ball, four) in case.balls.iter().zip(&at.touches) {
        let axes = case.geometry.section_axes(ball.azimuth);
        for (touch, contact) in four.iter().zip(Contact::ALL) {
            let (Some(touch), true) = (touch, contact.on_nut()) else {
                continue;
            };
            let push = axes.transpose() * (touch.force * touch.normal);
            let (radial, along) = case.geometry.contact_point(contact, ball.azimuth);
            let arm = radial + nalgebra::Vector3::new(0.0, 0.0, ball.position + along);
            force += push;
            moment += arm.cross(&push);
        }
    }
    [force.x, force.y, force.z, moment.x, moment.y, moment.z]
}
