//! Sizing of bearing and ball screw against the tie-rod angle: section 4.2.2, Figures 4.4 and 4.5.
//!
//! The nut is a rigid body between the balls of the ball screw and those of a four-point bearing, whose outer ring is fixed. Its pose
//! minimises the sum of both energies, which is convex. The ball screw is that of Table 4.1, the bearing that of Table 4.2. Not printed: the
//! pinion's position, and the bearing's, which is taken as the nut's.

use nalgebra::{SMatrix, SVector};
use rayon::prelude::*;

use super::Tick;
use crate::rotary_bearing;
use epas_reference::error::ReferenceError;
use epas_reference::friction::newton::{Local, minimise};
use epas_reference::statics::ball::NutPose;
use epas_reference::statics::cases::CaseStudy;
use epas_reference::statics::geometry::Geometry;
use epas_reference::statics::problem::{Load, Setup, State, StaticLoad, Support};
use epas_reference::statics::solution::StaticSolution;

/// Sum `F` of the forces at both ends of the rack, N.
pub const RACK_LOAD: f64 = 14_500.0;

/// Where the pinion lets the rack only move along its axis, m: 100 mm from the far end. What leads the rack there takes the lateral force
/// of the far end, whichever way it points.
const PINION_POSITION: f64 = 0.65;

#[derive(Clone, Debug, PartialEq)]
pub struct TieRodLoads {
    pub angle: f64,
    pub screw: StaticSolution,
    pub bearing: StaticSolution,
    /// Largest unbalanced force, or moment over the nut's radius, on the nut, N.
    pub residual: f64,
}

impl TieRodLoads {
    /// Largest contact forces of ball screw and bearing, N.
    pub fn largest(&self) -> [f64; 2] {
        [&self.screw, &self.bearing].map(|solution| {
            let forces = solution.forces.iter().flatten();
            forces.copied().fold(0.0, f64::max)
        })
    }
}

/// Pose of the nut: displacement along x, y, z and rotation about x, y; the belt holds it about z.
type Pose = SVector<f64, 5>;

struct Sides {
    screw: StaticSolution,
    bearing: StaticSolution,
    energy: f64,
    gradient: Pose,
}

/// Rack and bearing without a pose of the nut.
struct Mechanism {
    screw: Setup,
    bearing: Setup,
    nut_position: f64,
    geometry: Geometry,
}

const BALLS: usize = 9;

impl Mechanism {
    fn new(angle: f64) -> Result<Self, ReferenceError> {
        let rack = CaseStudy::table_4_1();
        let mut screw = rack.setup()?;
        let half = 0.5 * RACK_LOAD;
        let (sin, cos) = angle.sin_cos();
        screw.supports = vec![Support::axial_guide(PINION_POSITION)];
        let end = |position| Load {
            position,
            force: [half * sin, 0.0, half * cos],
            moment: [0.0; 3],
        };
        screw.loads = [0.0, rack.screw_length].map(end).into();
        let geometry = rotary_bearing::row_geometry(6.25e-3);
        let balls = rotary_bearing::row(&geometry, BALLS, rack.nut_position);
        Ok(Self {
            screw,
            bearing: rotary_bearing::setup(geometry, balls, rack.nut_position)?,
            nut_position: rack.nut_position,
            geometry,
        })
    }

    fn sides(&self, pose: &Pose, start: Option<&State>) -> Result<Sides, ReferenceError> {
        let position = self.nut_position;
        let mut screw = self.screw.clone();
        screw.nut = NutPose {
            position,
            displacement: [pose[0], pose[1], pose[2]],
            rotation: [pose[3], pose[4], 0.0],
        };
        let screw = StaticLoad::new(screw)?;
        let screw = match start {
            Some(state) => screw.solve_from(state.clone()),
            None => screw.solve(),
        }?;
        let mut bearing = self.bearing.clone();
        bearing.supports = vec![Support {
            position,
            held: [pose[0], pose[1], pose[2], pose[3], pose[4], 0.0].map(Some),
        }];
        let bearing = StaticLoad::new(bearing)?.solve()?;
        let on_nut = screw.on_nut_about(position);
        let reaction = bearing.reactions.first().copied().unwrap_or([0.0; 6]);
        Ok(Sides {
            energy: screw.energy + bearing.energy,
            gradient: Pose::from_fn(|axis, _| reaction[axis] - on_nut[axis]),
            screw,
            bearing,
        })
    }

    /// The bearing's own pose under the mean axial load.
    fn start(&self, angle: f64) -> Pose {
        let contact = self.bearing.contact;
        let (sin, balls) = (self.geometry.contact_angle.sin(), BALLS as f64);
        let force = RACK_LOAD * angle.cos() / (balls * sin);
        let approach =
            (contact.screw.deflection + contact.nut.deflection) * force.abs().cbrt().powi(2) / sin;
        Pose::new(0.0, 0.0, approach, 0.0, 0.0)
    }
}

/// Balances the nut at one tie-rod angle, rad.
pub fn at(angle: f64) -> Result<TieRodLoads, ReferenceError> {
    let mechanism = Mechanism::new(angle)?;
    let radius = mechanism.geometry.pitch_radius;
    // Rotations count as displacements at the nut's radius.
    let scale = Pose::new(1.0, 1.0, 1.0, 1.0 / radius, 1.0 / radius);
    let sides = |y: &Pose, start: Option<&State>| mechanism.sides(&y.component_mul(&scale), start);
    let local = |y: &Pose| -> Result<Local<5>, ReferenceError> {
        let here = sides(y, None)?;
        let mut hessian = SMatrix::<f64, 5, 5>::zeros();
        for axis in 0..5 {
            // A difference of 10 nm is far below the deflections of some um.
            let mut step = Pose::zeros();
            step[axis] = 1e-8;
            let side = |y: Pose| sides(&y, Some(&here.screw.state));
            let slope = (side(y + step)?.gradient - side(y - step)?.gradient) / 2e-8;
            hessian.set_column(axis, &slope.component_mul(&scale));
        }
        Ok(Local {
            value: here.energy,
            gradient: here.gradient.component_mul(&scale),
            hessian: 0.5 * (hessian + hessian.transpose()),
        })
    };
    let tolerance = 1e-8 * RACK_LOAD;
    let end = minimise(mechanism.start(angle), tolerance, |y| {
        local(y).unwrap_or(Local {
            value: f64::INFINITY,
            gradient: Pose::zeros(),
            hessian: SMatrix::zeros(),
        })
    });
    let Sides {
        screw,
        bearing,
        gradient,
        ..
    } = sides(&end.point, None)?;
    let residual = gradient.component_mul(&scale).amax();
    if residual.is_nan() || residual > tolerance {
        return Err(ReferenceError::unbalanced(residual));
    }
    Ok(TieRodLoads {
        angle,
        screw,
        bearing,
        residual,
    })
}

pub fn over(angles: &[f64], tick: Tick<'_>) -> Result<Vec<TieRodLoads>, ReferenceError> {
    angles
        .par_iter()
        .map(|angle| {
            let loads = at(*angle)?;
            tick();
            Ok(loads)
        })
        .collect()
}
