//! A load case: what is given, and its checks.

use std::sync::Arc;

use nalgebra::Vector2;

use super::ball::{Arm, ArmInput, Ball, Errors, NutPose};
use super::contact::{ContactConstants, exact, nominal_curvatures};
use super::geometry::{Contact, Geometry, centre_signs};
use super::shaft::{Shaft, ShaftModel};
use super::surface::SurfaceError;
use crate::error::{ReferenceError, within};
use crate::material::Elastic;

/// Balls evenly along the helix, `spacing` rad apart and centred at `position`, m, the first at `first_azimuth`, rad.
pub fn even_train(
    geometry: &Geometry,
    count: usize,
    spacing: f64,
    position: f64,
    first_azimuth: f64,
) -> Vec<Ball> {
    let advance = geometry.advance();
    let middle = 0.5 * (count as f64 - 1.0);
    (0..count)
        .map(|index| {
            let from_first = index as f64 * spacing;
            let from_centre = (index as f64 - middle) * spacing;
            Ball::new(first_azimuth + from_first, position + from_centre * advance)
        })
        .collect()
}

/// Displacements that are held at one place of the shaft.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Support {
    /// Position, m.
    pub position: f64,
    /// Held displacements (m) and rotations (rad) along and about x, y, z; None is free.
    pub held: [Option<f64>; 6],
}

impl Support {
    /// Only axial displacement is free: the driven end of the dissertation's case studies.
    pub const fn axial_guide(position: f64) -> Self {
        Self {
            position,
            held: [Some(0.0), Some(0.0), None, Some(0.0), Some(0.0), Some(0.0)],
        }
    }
}

/// A force and a moment on the shaft.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Load {
    /// Position, m.
    pub position: f64,
    /// Force, N.
    pub force: [f64; 3],
    /// Moment, N m.
    pub moment: [f64; 3],
}

impl Load {
    /// A force along the axis.
    pub const fn axial(position: f64, force: f64) -> Self {
        Self {
            position,
            force: [0.0, 0.0, force],
            moment: [0.0; 3],
        }
    }
}

/// Unknowns of the problem.
#[derive(Clone, Debug, PartialEq)]
pub struct State {
    /// Six per node: displacement, m, and rotation, rad.
    pub nodes: Vec<f64>,
    /// Displacement of each ball's centre in its section, m.
    pub balls: Vec<Vector2<f64>>,
}

/// A load case of a ball screw with a rigid nut that is held.
#[derive(Clone, Debug)]
pub struct StaticLoad {
    pub(super) geometry: Geometry,
    pub(super) shaft: Shaft,
    pub(super) contact: ContactConstants,
    pub(super) balls: Vec<Ball>,
    pub(super) arms: Vec<[Option<Arm>; 4]>,
    pub(super) supports: Vec<(usize, [Option<f64>; 6])>,
    pub(super) loads: Vec<f64>,
}

/// Everything that a load case is made from.
#[derive(Clone, Debug)]
pub struct Setup {
    /// Nominal geometry.
    pub geometry: Geometry,
    /// The shaft; nodes for supports and loads are added where there is none.
    pub shaft: Shaft,
    /// Hertzian constants of nominal contacts.
    pub contact: ContactConstants,
    /// The balls.
    pub balls: Vec<Ball>,
    /// Where the shaft is held.
    pub supports: Vec<Support>,
    /// Loads on the shaft.
    pub loads: Vec<Load>,
    /// Where the nut is held.
    pub nut: NutPose,
    /// Geometric errors of the surfaces SL, SR, NL, NR.
    pub errors: [Vec<Arc<dyn SurfaceError>>; 4],
    /// Materials of screw, nut and balls where each contact's Hertzian constant is to follow the local
    /// curvature of the surface with its errors; None takes the nominal constants.
    pub local_curvature: Option<[Elastic; 3]>,
}

/// Largest number of balls.
pub const LARGEST_TRAIN: usize = 100_000;

impl StaticLoad {
    /// A load case, checked.
    pub fn new(setup: Setup) -> Result<Self, ReferenceError> {
        let Setup {
            geometry,
            mut shaft,
            contact,
            balls,
            supports,
            loads,
            nut,
            errors,
            local_curvature,
        } = setup;
        geometry.check()?;
        if balls.is_empty() || balls.len() > LARGEST_TRAIN {
            return Err(ReferenceError::input(
                "balls",
                format!("{} is not within 1 to {LARGEST_TRAIN}", balls.len()),
            ));
        }
        let [start, end] = shaft.ends();
        let rigid = shaft.model == ShaftModel::Rigid;
        let on_shaft = |field, position: f64| {
            if rigid {
                within(field, position, -100.0, 100.0)
            } else {
                within(field, position, start, end)
            }
        };
        for support in &supports {
            on_shaft("supports", support.position)?;
            for value in support.held.iter().flatten() {
                within("supports", *value, -0.1, 0.1)?;
            }
            shaft.node_at(support.position);
        }
        for load in &loads {
            on_shaft("loads", load.position)?;
            for value in load.force.iter().chain(&load.moment) {
                within("loads", *value, -1e9, 1e9)?;
            }
            shaft.node_at(load.position);
        }
        for ball in &balls {
            on_shaft("balls", ball.position)?;
            within("balls", ball.azimuth, -1e7, 1e7)?;
            within(
                "ball_oversize",
                ball.oversize,
                -0.2 * geometry.ball_radius,
                0.2 * geometry.ball_radius,
            )?;
        }
        within("nut", nut.position, -100.0, 100.0)?;
        for value in nut.displacement.iter().chain(&nut.rotation) {
            within("nut", *value, -0.1, 0.1)?;
        }
        let of_all = ArmInput {
            geometry: &geometry,
            shaft: &shaft,
            nut: &nut,
            errors: &errors,
            deflection: [contact.screw.deflection, contact.nut.deflection],
        };
        let arms = balls
            .iter()
            .map(|ball| arms(&of_all, ball, local_curvature))
            .collect::<Result<Vec<_>, _>>()?;
        let mut held = Vec::with_capacity(supports.len());
        for support in &supports {
            held.push((shaft.node_at(support.position), support.held));
        }
        let mut forces = vec![0.0; 6 * shaft.nodes.len()];
        for load in &loads {
            let node = shaft.node_at(load.position);
            let arm = load.position - shaft.nodes[node];
            let [x, y, _] = load.force;
            let carried = [-y * arm, x * arm, 0.0];
            for axis in 0..3 {
                forces[6 * node + axis] += load.force[axis];
                forces[6 * node + 3 + axis] += load.moment[axis] + carried[axis];
            }
        }
        Ok(Self {
            geometry,
            shaft,
            contact,
            balls,
            arms,
            supports: held,
            loads: forces,
        })
    }

    /// The shaft with its nodes.
    pub fn shaft(&self) -> &Shaft {
        &self.shaft
    }

    /// The balls.
    pub fn balls(&self) -> &[Ball] {
        &self.balls
    }

    /// The nominal geometry.
    pub fn geometry(&self) -> &Geometry {
        &self.geometry
    }

    /// Held degrees of freedom with their values; a bar holds all but the axial ones.
    pub(super) fn held(&self) -> Vec<Option<f64>> {
        let mut held = vec![None; self.loads.len()];
        if self.shaft.model == ShaftModel::Bar {
            for node in held.chunks_mut(6) {
                for axis in [0, 1, 3, 4, 5] {
                    node[axis] = Some(0.0);
                }
            }
        }
        for (node, values) in &self.supports {
            for (axis, value) in values.iter().enumerate() {
                if let Some(value) = value {
                    held[6 * node + axis] = Some(*value);
                }
            }
        }
        held
    }
}

fn arms(
    of_all: &ArmInput<'_>,
    ball: &Ball,
    local_curvature: Option<[Elastic; 3]>,
) -> Result<[Option<Arm>; 4], ReferenceError> {
    let mut arms = [const { None }; 4];
    for (index, which) in Contact::ALL.into_iter().enumerate() {
        if !ball.arcs[index] {
            continue;
        }
        let nominal = of_all.deflection[usize::from(which.on_nut())];
        let deflection = match local_curvature {
            Some(materials) => {
                let errors = &of_all.errors[index];
                local_deflection(of_all.geometry, which, ball, errors, materials)?
            }
            None => nominal,
        };
        arms[index] = Some(Arm::new(which, index, of_all, ball, deflection));
    }
    Ok(arms)
}

/// Hertzian constant with the curvatures of the surface with its errors at the nominal contact point.
fn local_deflection(
    geometry: &Geometry,
    which: Contact,
    ball: &Ball,
    errors: &Errors,
    [screw, nut, sphere]: [Elastic; 3],
) -> Result<f64, ReferenceError> {
    let metal = if which.on_nut() { nut } else { screw };
    let mut curvatures = nominal_curvatures(geometry, which.part())?;
    let angle = geometry.contact_angle;
    let [outward, along] = centre_signs(which);
    let height = |azimuth: f64| {
        errors
            .iter()
            .map(|error| {
                let deviation = error.deviation(azimuth, angle);
                deviation.offset
                    + outward * deviation.shift[0] * angle.cos()
                    + along * deviation.shift[1] * angle.sin()
            })
            .sum::<f64>()
    };
    let bend = errors
        .iter()
        .map(|error| {
            let deviation = error.deviation(ball.azimuth, angle);
            deviation.offset + deviation.bend
        })
        .sum::<f64>();
    // Towards the ball is convex. Across the path a polar curve of radius r_G - offset has the curvature (1 + (offset + offset'') / r_G) /
    // r_G; along the path the wave's own curvature is added, by a central difference over a thousandth of a radian's arc.
    curvatures.kappa2 -= bend / geometry.groove_radius.powi(2);
    let step = 1e-3;
    let wave = (height(ball.azimuth + step) + height(ball.azimuth - step)
        - 2.0 * height(ball.azimuth))
        / (step * step);
    let arc = geometry.pitch_radius.hypot(geometry.advance());
    curvatures.kappa1 -= wave / (arc * arc);
    let modulus = metal.contact_modulus(&sphere);
    exact(geometry.ball_radius, curvatures, modulus).map(|contact| contact.deflection)
}
