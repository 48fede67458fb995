//! Sizing of bearing and ball screw against the tie-rod angle: section 4.2.2, Figures 4.4 and 4.5.
//!
//! The nut is a rigid body between the balls of the ball screw and those of a four-point bearing, whose
//! outer ring is fixed. Its pose minimises the sum of both energies, which is convex.

use std::f64::consts::{FRAC_PI_4, TAU};

use nalgebra::{SMatrix, SVector};
use rayon::prelude::*;

use super::Tick;
use epas_reference::error::ReferenceError;
use epas_reference::statics::ball::NutPose;
use epas_reference::statics::cases::CaseStudy;
use epas_reference::statics::contact::ContactConstants;
use epas_reference::statics::geometry::Geometry;
use epas_reference::statics::problem::{Load, Setup, State, StaticLoad, Support, even_train};
use epas_reference::statics::shaft::Shaft;
use epas_reference::statics::solution::StaticSolution;

/// A rack with ball screw and bearing under tie-rod forces.
#[derive(Clone, Debug, PartialEq)]
pub struct TieRodLoad {
    /// Rack: ball screw, nut position, balls. Its own load is not used.
    pub rack: CaseStudy,
    /// Sum `F` of the forces at both ends, N; printed, 14500.
    pub rack_load: f64,
    /// Where the pinion lets the rack only move along its axis, m; not printed. What leads the rack there
    /// takes the lateral force of the far end, whichever way it points.
    pub pinion_position: f64,
    /// Four-point bearing around the nut, with a lead of zero.
    pub bearing: Geometry,
    /// Its number of balls.
    pub bearing_balls: usize,
    /// Its axial position, m; not printed, the nut's.
    pub bearing_position: f64,
    /// Undersize of its balls' radius, m; not printed, 0.
    pub bearing_undersize: f64,
}

impl Default for TieRodLoad {
    /// The ball screw of Table 4.1, the four-point bearing of Table 4.2, and the pinion 100 mm from the far end.
    fn default() -> Self {
        let rack = CaseStudy::table_4_1();
        Self {
            bearing_position: rack.nut_position,
            pinion_position: 0.65,
            rack,
            rack_load: 14_500.0,
            bearing: Geometry {
                pitch_radius: 35e-3,
                lead: 0.0,
                ball_radius: 6.25e-3,
                groove_radius: 6.75e-3,
                contact_angle: FRAC_PI_4,
            },
            bearing_balls: 9,
            bearing_undersize: 0.0,
        }
    }
}

/// Loads at one tie-rod angle.
#[derive(Clone, Debug, PartialEq)]
pub struct TieRodLoads {
    /// Tie-rod angle, rad.
    pub angle: f64,
    /// Of the ball screw.
    pub screw: StaticSolution,
    /// Of the bearing.
    pub bearing: StaticSolution,
    /// Largest unbalanced force or moment over the nut's radius on the nut, N.
    pub residual: f64,
    /// Steps of the nut's pose.
    pub iterations: usize,
}

impl TieRodLoads {
    /// Largest contact forces of ball screw and bearing, N.
    pub fn largest(&self) -> [f64; 2] {
        [&self.screw, &self.bearing].map(|solution| {
            solution
                .forces
                .iter()
                .flatten()
                .fold(0.0, |most: f64, force| most.max(*force))
        })
    }
}

/// Pose of the nut: displacement along x, y, z and rotation about x, y; the belt holds it about z.
type Pose = SVector<f64, 5>;

/// Both sides of the nut at one pose.
struct Sides {
    screw: StaticSolution,
    bearing: StaticSolution,
    energy: f64,
    gradient: Pose,
}

impl TieRodLoad {
    fn screw_setup(&self, angle: f64) -> Result<Setup, ReferenceError> {
        let mut setup = self.rack.setup()?;
        let half = 0.5 * self.rack_load;
        let (sin, cos) = angle.sin_cos();
        setup.supports = vec![Support::axial_guide(self.pinion_position)];
        let ends = [0.0, self.rack.screw_length];
        setup.loads = ends
            .map(|position| Load {
                position,
                force: [half * sin, 0.0, half * cos],
                moment: [0.0; 3],
            })
            .into();
        Ok(setup)
    }

    fn bearing_setup(&self) -> Result<Setup, ReferenceError> {
        let spacing = TAU / self.bearing_balls.max(1) as f64;
        let mut balls = even_train(
            &self.bearing,
            self.bearing_balls,
            spacing,
            self.bearing_position,
            0.0,
        );
        for ball in &mut balls {
            ball.oversize = -self.bearing_undersize;
        }
        Ok(Setup {
            geometry: self.bearing,
            shaft: Shaft::rigid(self.rack.nut_position),
            contact: ContactConstants::of_one_material(
                &self.bearing,
                self.rack.elastic,
                self.rack.convention,
            )?,
            balls,
            supports: Vec::new(),
            loads: Vec::new(),
            nut: NutPose::default(),
            errors: std::array::from_fn(|_| Vec::new()),
            local_curvature: None,
        })
    }

    fn sides(
        &self,
        screw: &Setup,
        bearing: &Setup,
        pose: &Pose,
        start: Option<&State>,
    ) -> Result<Sides, ReferenceError> {
        let mut screw = screw.clone();
        screw.nut = NutPose {
            position: self.rack.nut_position,
            displacement: [pose[0], pose[1], pose[2]],
            rotation: [pose[3], pose[4], 0.0],
        };
        let screw = StaticLoad::new(screw)?;
        let screw = match start {
            Some(state) => screw.solve_from(state.clone()),
            None => screw.solve(),
        }?;
        let mut bearing = bearing.clone();
        bearing.supports = vec![Support {
            position: self.rack.nut_position,
            held: [pose[0], pose[1], pose[2], pose[3], pose[4], 0.0].map(Some),
        }];
        let bearing = StaticLoad::new(bearing)?.solve()?;
        let on_nut = screw.on_nut_about(self.rack.nut_position);
        let reaction = bearing.reactions.first().copied().unwrap_or([0.0; 6]);
        Ok(Sides {
            energy: screw.energy + bearing.energy,
            gradient: Pose::from_fn(|axis, _| reaction[axis] - on_nut[axis]),
            screw,
            bearing,
        })
    }

    /// Balances the nut at one tie-rod angle, rad, by Newton's method with differences of forces.
    pub fn at(&self, angle: f64) -> Result<TieRodLoads, ReferenceError> {
        let (screw, bearing) = (self.screw_setup(angle)?, self.bearing_setup()?);
        let radius = self.bearing.pitch_radius;
        let scale = Pose::new(1.0, 1.0, 1.0, 1.0 / radius, 1.0 / radius);
        let measure = |gradient: &Pose| gradient.component_mul(&scale).amax();
        // The bearing's own pose under the mean axial load.
        let contact = bearing.contact;
        let (sin, balls) = (self.bearing.contact_angle.sin(), self.bearing_balls as f64);
        let mut pose = Pose::zeros();
        pose[2] = (contact.screw.deflection + contact.nut.deflection)
            * (self.rack_load * angle.cos() / (balls * sin))
                .abs()
                .cbrt()
                .powi(2)
            / sin
            * self.rack_load.signum();
        let mut here = self.sides(&screw, &bearing, &pose, None)?;
        let tolerance = 1e-8 * self.rack_load.abs().max(1.0);
        let mut levenberg = 0.0;
        for iteration in 0..100 {
            let residual = measure(&here.gradient);
            if residual <= tolerance {
                return Ok(TieRodLoads {
                    angle,
                    screw: here.screw,
                    bearing: here.bearing,
                    residual,
                    iterations: iteration,
                });
            }
            let mut hessian = SMatrix::<f64, 5, 5>::zeros();
            for axis in 0..5 {
                // A difference of 10 nm is far below the deflections of some um.
                let step = 1e-8 * scale[axis];
                let side = |sign: f64| {
                    let mut moved = pose;
                    moved[axis] += sign * step;
                    let state = Some(&here.screw.state);
                    self.sides(&screw, &bearing, &moved, state)
                        .map(|sides| sides.gradient)
                };
                let slope = (side(1.0)? - side(-1.0)?) / (2.0 * step);
                hessian.set_column(axis, &slope);
            }
            hessian = 0.5 * (hessian + hessian.transpose());
            let diagonal = hessian.diagonal().map(|value| value.abs().max(1.0));
            let mut moved = None;
            while moved.is_none() && levenberg < 1e6 {
                let damped = hessian + SMatrix::from_diagonal(&(levenberg * diagonal));
                if let Some(factor) = damped.cholesky() {
                    let trial = pose - factor.solve(&here.gradient);
                    if trial.amax() < 0.05
                        && let Ok(there) =
                            self.sides(&screw, &bearing, &trial, Some(&here.screw.state))
                        && (measure(&there.gradient) < residual || there.energy < here.energy)
                    {
                        moved = Some((trial, there));
                    }
                }
                levenberg = if moved.is_some() {
                    if levenberg < 1e-8 {
                        0.0
                    } else {
                        0.05 * levenberg
                    }
                } else {
                    (10.0 * levenberg).max(1e-6)
                };
            }
            let Some((trial, there)) = moved else {
                return Err(ReferenceError::unbalanced(residual));
            };
            (pose, here) = (trial, there);
        }
        Err(ReferenceError::unbalanced(measure(&here.gradient)))
    }

    /// All of some tie-rod angles, rad.
    pub fn over(&self, angles: &[f64], tick: Tick<'_>) -> Result<Vec<TieRodLoads>, ReferenceError> {
        angles
            .par_iter()
            .map(|angle| {
                let loads = self.at(*angle)?;
                tick();
                Ok(loads)
            })
            .collect()
    }
}
