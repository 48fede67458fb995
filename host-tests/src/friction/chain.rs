//! Chains of balls that touch: ball-to-ball forces (Lin 2019, eqs. (3.26) to (3.31)).
//!
//! Balls stand rear to front along the positive direction of the track. The speeds are those that minimise the total power under
//! `v_j <= v_(j+1)`, and the contact forces are the multipliers.

use nalgebra::{SMatrix, Vector3};

use super::linear_ball::{LinearBall, LinearMotion};
use super::newton::Local;
use super::planar::{self, ContactFriction, PlanarContact};
use super::train_newton::{Train, solve_train};
use crate::error::{ReferenceError, within};

/// Motion of a chain of touching balls in a linear bearing.
#[derive(Clone, Debug, PartialEq)]
pub struct LinearChain {
    /// Each ball, rear to front.
    pub balls: Vec<LinearMotion>,
    /// Forces between neighbours, N; zero where they part.
    pub contact_forces: Vec<f64>,
    /// Speed of slip between neighbours, m/s, (3.26); balls that do not press slip without loss.
    pub ball_slip: Vec<f64>,
    /// Power lost between balls, W, (3.28).
    pub ball_loss: f64,
    /// Power lost in the grooves, W.
    pub groove_loss: f64,
    /// Largest unbalanced force, N, of (3.29) and (3.31).
    pub residual: f64,
    /// Newton steps over all stages.
    pub iterations: usize,
}

impl LinearChain {
    /// Total power lost, W.
    pub fn power_loss(&self) -> f64 {
        self.groove_loss + self.ball_loss
    }
}

struct LinearTrain<'a> {
    contacts: &'a [[PlanarContact; 4]],
    ball_friction: f64,
}

impl Train<3> for LinearTrain<'_> {
    fn balls(&self) -> usize {
        self.contacts.len()
    }

    fn start(&self, _ball: usize) -> Vector3<f64> {
        Vector3::new(0.5, 0.7, 0.0)
    }

    fn local(&self, ball: usize, y: &Vector3<f64>, rest_spin: f64) -> Local<3> {
        planar::dissipation(&self.contacts[ball], &Vector3::zeros(), y, rest_spin)
    }

    fn moves(&self, ball: usize, y: &Vector3<f64>, rest_spin: f64) -> bool {
        planar::all_move(&self.contacts[ball], y, rest_spin)
    }

    /// (3.26): the sums of the rotations about x and y.
    fn slip(&self) -> [SMatrix<f64, 2, 3>; 2] {
        [SMatrix::<f64, 2, 3>::new(0.0, 1.0, 0.0, 0.0, 0.0, 1.0); 2]
    }

    fn ball_friction(&self) -> f64 {
        self.ball_friction
    }

    fn largest(&self) -> f64 {
        self.contacts
            .iter()
            .flatten()
            .map(|c| c.friction_limit)
            .fold(0.0, f64::max)
    }
}

/// Solves a chain of touching balls, rear to front along +z: the `4 n - 1` equations (3.29) to (3.31).
///
/// `ball_friction` is the coefficient between balls. Without it the problem is convex and is solved as such; from there Newton steps on the
/// full system follow the rising coefficient. With a negative speed the front ball of the list becomes the rear one.
///
/// Corrected: the count of unknowns after (3.31) is `4 n - 1`; for the front ball of a pair the normal force reverses, but the moment terms
/// of (3.29) keep their sign (force and arm both reverse).
pub fn solve_chain(
    balls: &[LinearBall],
    ball_friction: f64,
    speed: f64,
) -> Result<LinearChain, ReferenceError> {
    within("ball_friction", ball_friction, 0.0, 1.0)?;
    within("speed", speed, -1e6, 1e6)?;
    within("balls", balls.len() as f64, 1.0, 1e4)?;
    if speed == 0.0 {
        return Err(ReferenceError::Standstill);
    }
    let radius = balls.first().map_or(1.0, |b| b.ball_radius);
    let friction = balls.first().map_or(0.0, |b| b.friction);
    let mut contacts: Vec<[PlanarContact; 4]> = Vec::with_capacity(balls.len());
    for ball in balls {
        ball.check()?;
        within("ball_radius", ball.ball_radius, radius, radius)?;
        within("friction", ball.friction, friction, friction)?;
        contacts.push(ball.contacts()?);
    }
    if speed < 0.0 {
        contacts.reverse();
    }
    // The friction coefficient scales groove forces and contact forces alike, so the ball's moments carry `ball_friction` alone.
    let train = LinearTrain {
        contacts: &contacts,
        ball_friction,
    };
    let (solution, rest_spin) = solve_train(&train).map_err(|error| error.scaled(friction))?;
    let (residual, iterations) = (solution.residual, solution.iterations);

    let mut motions = Vec::with_capacity(balls.len());
    let mut points = solution.points;
    let mut forces: Vec<f64> = solution.multipliers.iter().map(|f| f * friction).collect();
    if speed < 0.0 {
        points.reverse();
        forces.reverse();
        contacts.reverse();
    }
    for ((ball, contacts), y) in balls.iter().zip(&contacts).zip(&points) {
        let y = [y.x, y.y, y.z];
        let frictions: [ContactFriction; 4] = contacts.map(|c| c.friction(&y, rest_spin));
        let gap = contacts
            .iter()
            .zip(&frictions)
            .map(|(c, f)| c.friction(&y, 0.0).power - f.power)
            .sum::<f64>()
            .max(0.0);
        let gap = if rest_spin == 0.0 { 0.0 } else { gap };
        motions.push(ball.dimensional(speed, y, frictions, residual, gap, iterations));
    }
    let ball_slip: Vec<f64> = points
        .windows(2)
        .map(|pair| speed.abs() * (pair[0].y + pair[1].y).hypot(pair[0].z + pair[1].z))
        .collect();
    Ok(LinearChain {
        ball_loss: forces
            .iter()
            .zip(&ball_slip)
            .map(|(f, slip)| ball_friction * f * slip)
            .sum(),
        groove_loss: motions.iter().map(|m| m.power_loss).sum(),
        balls: motions,
        contact_forces: forces,
        ball_slip,
        residual: friction * residual,
        iterations,
    })
}
