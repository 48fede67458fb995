//! Four-point and double-row angular contact bearings under a load that turns from axial to radial: Lin 2019, section 4.3.1.
//!
//! A bearing is a ball screw without lead on a rigid shaft ([`StaticLoad`]); the ball of [`crate::rotary_ball`] gives its friction.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, TAU};

use crate::published::bearings::{INNER_SPEED, table_3_1};
use crate::rotary_ball::{RotaryBearing, RotaryContacts, RotaryConvention};
use epas_bench::report::statistics::evenly;
use epas_reference::error::ReferenceError;
use epas_reference::statics::ball::{Ball, NutPose};
use epas_reference::statics::problem::{Load, Setup, StaticLoad, Support, even_train};
use epas_reference::statics::shaft::Shaft;
use epas_reference::statics::solution::StaticSolution;
use epas_reference::statics::{ContactConstants, Elastic, Geometry, HertzConvention};

const BALLS: usize = 9;
const FRICTION: f64 = 0.1;
/// Force on the inner ring, N.
const FORCE: f64 = 3000.0;
/// Distance of the two rows, m.
const ROW_DISTANCE: f64 = 12e-3;

/// Geometry of a row on a pitch circle of 70 mm: grooves of conformity 0.54.
pub fn row_geometry(ball_radius: f64) -> Geometry {
    Geometry {
        pitch_radius: 35e-3,
        lead: 0.0,
        ball_radius,
        groove_radius: 1.08 * ball_radius,
        contact_angle: FRAC_PI_4,
    }
}

/// Evenly spaced balls of a row at an axial position, m.
pub fn row(geometry: &Geometry, balls: usize, position: f64) -> Vec<Ball> {
    even_train(geometry, balls, TAU / balls.max(1) as f64, position, 0.0)
}

/// A bearing whose inner ring is a rigid shaft, without loads and supports.
pub fn setup(geometry: Geometry, balls: Vec<Ball>, position: f64) -> Result<Setup, ReferenceError> {
    let convention = HertzConvention::Correct;
    Ok(Setup {
        geometry,
        shaft: Shaft::rigid(position),
        contact: ContactConstants::of_one_material(&geometry, Elastic::STEEL, convention)?,
        balls,
        supports: Vec::new(),
        loads: Vec::new(),
        nut: NutPose::default(),
        errors: std::array::from_fn(|_| Vec::new()),
        local_curvature: None,
    })
}

/// Both bearings under a load that turns (Table 4.2 and Figure 4.7), in kind. Not printed: friction coefficient (0.1 as in Table 3.1), azimuth
/// of the balls (0 from the plane of the load) and distance of the rows (half the printed thickness, back to back; of no effect without
/// tilt); curvatures are the right ones.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct TurningLoad {
    /// Ball radius less than fits the grooves, m, of both bearings; not printed, 0.
    pub undersize: f64,
    /// Whether the inner ring can tilt; not printed, the rack holds it.
    pub tilts: bool,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TurningPoint {
    /// Angle of the force from the axis, rad.
    pub angle: f64,
    pub four_point: f64,
    pub double_row: f64,
    pub four_point_balls: usize,
}

impl TurningLoad {
    /// A bearing under a force, N, along y and x, of the plane of axis and first ball.
    pub fn loaded(
        &self,
        geometry: Geometry,
        mut balls: Vec<Ball>,
        [radial, axial]: [f64; 2],
    ) -> Result<StaticSolution, ReferenceError> {
        for ball in &mut balls {
            ball.oversize = -self.undersize;
        }
        let held = (!self.tilts).then_some(0.0);
        let mut setup = setup(geometry, balls, 0.0)?;
        setup.supports = vec![Support {
            position: 0.0,
            held: [None, None, None, held, held, Some(0.0)],
        }];
        setup.loads = vec![Load {
            position: 0.0,
            force: [radial, 0.0, axial],
            moment: [0.0; 3],
        }];
        StaticLoad::new(setup)?.solve()
    }

    /// Both bearings under a force at an angle, rad, from the axis: nine balls of 6.25 mm radius, and twice nine of 4 mm.
    pub fn at(&self, angle: f64) -> Result<TurningPoint, ReferenceError> {
        let (sin, cos) = angle.sin_cos();
        let force = [FORCE * sin, FORCE * cos];
        let large = row_geometry(6.25e-3);
        let four = self.loaded(large, row(&large, BALLS, 0.0), force)?;
        let small = row_geometry(4e-3);
        let mut balls = row(&small, BALLS, -0.5 * ROW_DISTANCE);
        balls.extend(row(&small, BALLS, 0.5 * ROW_DISTANCE));
        for (index, ball) in balls.iter_mut().enumerate() {
            // The diagonals SL and NR, SR and NL.
            let forward = index < BALLS;
            ball.arcs = [forward, !forward, !forward, forward];
        }
        let double = self.loaded(small, balls, force)?;
        Ok(TurningPoint {
            angle,
            four_point: friction(&large, &four)?,
            double_row: friction(&small, &double)?,
            four_point_balls: four
                .forces
                .iter()
                .filter(|forces| forces.iter().all(|force| *force > 0.0))
                .count(),
        })
    }

    /// `steps + 1` directions from axial to radial.
    pub fn sweep(&self, steps: usize) -> Result<Vec<TurningPoint>, ReferenceError> {
        evenly(0.0, FRAC_PI_2, steps)
            .map(|angle| self.at(angle))
            .collect()
    }
}

/// Contacts of a ball in the order IL, IR, OR, OL.
pub fn contacts(loaded: &StaticSolution, ball: usize) -> RotaryContacts {
    let order = |[sl, sr, nl, nr]: [f64; 4]| [sl, sr, nr, nl];
    RotaryContacts {
        contact_angles: order(loaded.contact_angles[ball]),
        contact_forces: order(loaded.forces[ball]),
    }
}

/// Friction torque of all balls, N m, each in the motion of least dissipation. Balls do not touch each other; unloaded ones have no friction.
fn friction(geometry: &Geometry, loaded: &StaticSolution) -> Result<f64, ReferenceError> {
    let bearing = RotaryBearing {
        ball_radius: geometry.ball_radius,
        ..table_3_1(RotaryConvention::Physical)
    };
    let mut torque = 0.0;
    for ball in 0..loaded.forces.len() {
        let mut contacts = contacts(loaded, ball);
        let [il, ir, or, ol] = contacts.contact_forces;
        if il.max(ir) > 0.0 && or.max(ol) > 0.0 {
            let angles = contacts.contact_angles.iter_mut();
            // A lost contact's direction is without meaning.
            for (angle, force) in angles.zip(contacts.contact_forces) {
                if force <= 0.0 {
                    *angle = bearing.contact_angle;
                }
            }
            torque += bearing
                .motion(&contacts, FRICTION, INNER_SPEED)?
                .friction_torque;
        }
    }
    Ok(torque)
}

pub fn variation(points: &[TurningPoint]) -> [f64; 2] {
    let ratio = |value: fn(&TurningPoint) -> f64| {
        let values = points.iter().map(value);
        values.clone().fold(0.0, f64::max) / values.fold(f64::INFINITY, f64::min)
    };
    [
        ratio(|point| point.four_point),
        ratio(|point| point.double_row),
    ]
}
