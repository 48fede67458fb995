//! Trains of touching balls in a ball screw with given contacts (Lin 2019, eqs. (3.73) to (3.77)).
//!
//! The in-plane forces between balls, some per cent of the loads, do not move the contacts here: the contact force differs by up to two per
//! cent from that of [`super::ball_screw_elastic`].

use nalgebra::{SMatrix, Vector4};

use super::ball_screw_ball::{
    ScrewContact, ScrewMotion, ScrewRow, ScrewTrack, ball_dissipation, ball_minimum, ball_rows,
    dimensional, rolling,
};
use super::newton::Local;
use super::train_newton::{Train, solve_train};
use crate::error::{ReferenceError, within};

/// Motion of a train of balls, all neighbours close enough to touch.
#[derive(Clone, Debug, PartialEq)]
pub struct ScrewTrain {
    /// Orbital speeds when no ball touches another, rad/s.
    pub free_speeds: Vec<f64>,
    /// Motion of each ball in the train, rear to front.
    pub balls: Vec<ScrewMotion>,
    /// Forces between neighbours, N; zero where they part.
    pub contact_forces: Vec<f64>,
    /// Slip between neighbours, m/s, (3.73).
    pub ball_slip: Vec<f64>,
    /// Power lost in the grooves, W.
    pub groove_loss: f64,
    /// Power lost between balls, W.
    pub ball_loss: f64,
    /// Largest unbalanced force, N.
    pub residual: f64,
}

impl ScrewTrain {
    /// Total power lost, W.
    pub fn power_loss(&self) -> f64 {
        self.groove_loss + self.ball_loss
    }
}

struct Rows<'a> {
    track: &'a ScrewTrack,
    balls: &'a [Vec<ScrewRow>],
    /// Friction coefficient between balls, per unit of the train's multiplier: the force between two balls is the multiplier over
    /// `cos b L/(2 pi R_B)`.
    ball_friction: f64,
    /// 1 where the balls orbit along +y, -1 where they orbit along -y.
    direction: f64,
}

impl Train<4> for Rows<'_> {
    fn balls(&self) -> usize {
        self.balls.len()
    }

    fn start(&self, ball: usize) -> Vector4<f64> {
        ball_minimum(&self.balls[ball], rolling(self.track), false)
            .0
            .point
    }

    fn local(&self, ball: usize, y: &Vector4<f64>, rest_spin: f64) -> Local<4> {
        ball_dissipation(&self.balls[ball], y, rest_spin)
    }

    fn moves(&self, ball: usize, y: &Vector4<f64>, rest_spin: f64) -> bool {
        self.balls[ball].iter().all(|row| row.moves(y, rest_spin))
    }

    fn slip(&self) -> [SMatrix<f64, 2, 4>; 2] {
        self.track.slip_between(self.direction)
    }

    fn ball_friction(&self) -> f64 {
        self.ball_friction
    }

    fn largest(&self) -> f64 {
        self.balls
            .iter()
            .flatten()
            .map(|row| row.patch.friction_limit)
            .fold(0.0, f64::max)
    }
}

/// Solves a train with given contacts, rear to front in the direction of orbiting, as [`super::chain::solve_chain`]. The force of `n`
/// newtons acts along the chord between two balls, `cos b` of it along the track, (3.75).
///
/// The friction between balls acts on each by virtual power of the slip (3.73), which keeps the power balance exact; the moments of (3.75)
/// follow, with `cos a` in place of one (1.8 per cent at a lead angle of 11 degrees) in its part along the track.
pub fn solve_screw_train(
    track: &ScrewTrack,
    balls: &[Vec<ScrewContact>],
    friction: f64,
    ball_friction: f64,
    nut_speed: f64,
) -> Result<ScrewTrain, ReferenceError> {
    let mu = within("friction", friction, 0.0, 1.0)?;
    let between = within("ball_friction", ball_friction, 0.0, 1.0)?;
    within("nut_speed", nut_speed, -1e6, 1e6)?;
    within("balls", balls.len() as f64, 1.0, 1e4)?;
    if nut_speed == 0.0 {
        return Err(ReferenceError::Standstill);
    }
    let rows = balls
        .iter()
        .map(|contacts| ball_rows(track, contacts))
        .collect::<Result<Vec<_>, _>>()?;
    let free_speeds = rows
        .iter()
        .map(|rows| ball_minimum(rows, rolling(track), false).0.point[0] * nut_speed)
        .collect();
    let (_, cos_b) = track.ball_contact_angle();
    let arm = cos_b * track.path_radius() / track.ball_radius;
    let train = Rows {
        track,
        balls: &rows,
        ball_friction: between / arm,
        direction: nut_speed.signum(),
    };
    let (solution, rest_spin) = solve_train(&train).map_err(|error| error.scaled(mu))?;
    let motions: Vec<_> = rows
        .iter()
        .zip(&solution.points)
        .map(|(rows, y)| dimensional(track, rows, y, rest_spin, mu, nut_speed, solution.residual))
        .collect();
    let contact_forces: Vec<f64> = solution.multipliers.iter().map(|m| mu * m / arm).collect();
    let [of_rear, of_front] = train.slip();
    let ball_slip: Vec<f64> = solution
        .points
        .windows(2)
        .map(|pair| {
            (of_rear * pair[0] + of_front * pair[1]).norm() * track.ball_radius * nut_speed.abs()
        })
        .collect();
    Ok(ScrewTrain {
        free_speeds,
        groove_loss: motions.iter().map(|m| m.power_loss).sum(),
        ball_loss: contact_forces
            .iter()
            .zip(&ball_slip)
            .map(|(force, slip)| between * force * slip)
            .sum(),
        balls: motions,
        contact_forces,
        ball_slip,
        residual: mu * solution.residual,
    })
}
