//! A row of touching balls in a ball screw: each in elastic balance in both gothic grooves under its own axial load, with Coulomb friction
//! by exact contact integrals, and pressing on its neighbours. The screw floats axially under each ball.
//!
//! The forces between balls are those of a complementarity problem on the actual speeds: `F >= 0`, no ball overtakes the one in front, and
//! where a force is not zero the two speeds are equal. A ball's speed rises strictly with the force that pushes it, so that the solution is
//! unique: it is the isotonic regression of the free speeds, each ball with its own nonlinear law. The force acts along the chord as in
//! [`super::ball_screw_ring`].
//!
//! Source: Lin 2019, eqs. (2.11) to (2.14), (3.65) to (3.77), the last as complementarity on the actual speeds.

use super::ball_screw_ball::{ScrewMotion, dimensional};
use super::ball_screw_grooves::ElasticGrooves;
use super::ball_screw_placed::{BallState, Drive, PlacedBall, STICK_SPIN, Solved};
use super::ball_screw_ring_order::Neighbours;
use super::ball_screw_ring_solve::{Instant, Seat};
use super::ball_screw_rubbing::{BallContact, Pressing, press_and_rub};
use super::ball_screw_settle::settle;
use super::patch::Integration;
use crate::design::BallScrewDesign;
use crate::error::{ReferenceError, within};

/// A ball of the row, as the grooves meet it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RowBall {
    /// How far the arc centres of the screw's groove are turned, rad: contact angles `SL = beta - screw_deviation`,
    /// `SR = beta + screw_deviation`.
    pub screw_deviation: f64,
    /// The same of the nut's groove: `NL = beta - nut_deviation`, `NR = beta + nut_deviation`.
    pub nut_deviation: f64,
    /// Axial force of the screw on the ball, N: positive carried by SL and NR, negative by SR and NL; not zero.
    pub axial_load: f64,
}

/// A row of balls, rear to front in the direction of orbiting; all neighbours touch.
#[derive(Clone, Debug, PartialEq)]
pub struct ElasticRow {
    /// Screw.
    pub design: BallScrewDesign,
    /// Radial gap of every contact at the centred ball and the unloaded screw, m: play above zero, oversize below.
    pub clearance: f64,
    /// Friction coefficient of the grooves, 0.001 to 1.
    pub friction: f64,
    /// Friction coefficient between the balls, 0 to 1.
    pub ball_friction: f64,
    /// Angular velocity of the nut, rad/s; not zero.
    pub nut_speed: f64,
    /// Balls.
    pub balls: Vec<RowBall>,
    /// Whether forces between balls have the part that points outward because the track is curved: yes, but for figures of papers without it.
    pub chord: bool,
    /// Nodes of the contact integrals: [`Integration::Full`], but to compare with stored cases of fewer.
    pub integration: Integration,
}

/// One ball of the solution.
#[derive(Clone, Debug, PartialEq)]
pub struct RowBallMotion {
    /// Motion, and friction of the contacts that carry.
    pub motion: ScrewMotion,
    /// Loads of SL, SR, NL, NR, N.
    pub loads: [f64; 4],
    /// Ball centre in the cross section, x and z, m.
    pub position: [f64; 2],
    /// Axial displacement of the screw, m.
    pub screw_displacement: f64,
    /// Force of the neighbours on the ball in the direction of orbiting, N.
    pub force: f64,
}

impl RowBallMotion {
    pub(crate) fn of(ball: &PlacedBall<'_>, solved: &Solved, nut_speed: f64) -> Self {
        let BallState {
            place,
            motion,
            force,
            ..
        } = solved.state;
        let rows = ball.rows_of(&solved.state).unwrap_or_default();
        Self {
            motion: dimensional(
                &ball.grooves.track,
                &rows,
                &motion,
                STICK_SPIN,
                ball.friction,
                nut_speed,
                solved.residual / ball.friction,
            ),
            loads: ball.loads(&place),
            position: [place.x, place.y],
            screw_displacement: place.z,
            force,
        }
    }
}

/// Solution of a row.
#[derive(Clone, Debug, PartialEq)]
pub struct RowMotion {
    /// Every ball by itself, no neighbour pressing.
    pub free: Vec<RowBallMotion>,
    /// The balls as they press.
    pub pressing: Vec<RowBallMotion>,
    /// Forces between neighbours, N; zero where they part.
    pub contact_forces: Vec<f64>,
    /// Power lost in rubbing between balls, W.
    pub ball_loss: f64,
    /// Power that the nut puts in less all that is lost, over all that is lost.
    pub power_error: f64,
    /// Largest unbalanced force of a ball, N.
    pub residual: f64,
}

impl RowMotion {
    /// Power lost in the grooves while the balls press, W.
    pub fn groove_loss(&self) -> f64 {
        self.pressing.iter().map(|b| b.motion.power_loss).sum()
    }

    /// Power lost in the grooves while no ball presses, W.
    pub fn free_groove_loss(&self) -> f64 {
        self.free.iter().map(|b| b.motion.power_loss).sum()
    }
}

/// Largest error of the power balance that is accepted.
const POWER_ERROR: f64 = 1e-8;

impl ElasticRow {
    /// Solves the row: every ball alone, then pressing.
    pub fn solve(&self) -> Result<RowMotion, ReferenceError> {
        let grooves = self.grooves()?;
        let direction = self.nut_speed.signum();
        let mut balls: Vec<PlacedBall<'_>> = grooves
            .iter()
            .zip(&self.balls)
            .map(|(grooves, ball)| {
                let load = ball.axial_load;
                PlacedBall::alone(grooves, self.friction, direction, load, self.integration)
            })
            .collect();
        let free = balls
            .iter()
            .map(|ball| settle(ball, Drive::Force(0.0), None))
            .collect::<Result<Vec<_>, _>>()?;
        let track = (&self.design).into();
        let contact = BallContact::new(&track, self.ball_friction, direction, self.chord);
        // Balls that hardly hold their spin answer friction between them too much for passes.
        let pressing = press_and_rub(&mut balls, &free, &contact)
            .or_else(|_| self.at_once(&balls, &free, contact))?;
        let residual = free
            .iter()
            .chain(&pressing.balls)
            .map(|solved| solved.residual)
            .fold(0.0, f64::max);
        let unit = self.design.ball_radius * self.nut_speed.abs();
        let result = RowMotion {
            free: self.results(&balls, &free),
            power_error: pressing.power_error(&balls),
            ball_loss: pressing.ball_loss * unit,
            pressing: self.results(&balls, &pressing.balls),
            contact_forces: pressing
                .forces
                .iter()
                .map(|along| contact.normal_force(*along))
                .collect(),
            residual,
        };
        if result.power_error.abs() <= POWER_ERROR {
            Ok(result)
        } else {
            Err(ReferenceError::NotConverged {
                residual: result.power_error,
                unit: "of the power lost",
            })
        }
    }

    fn at_once(
        &self,
        balls: &[PlacedBall<'_>],
        free: &[Solved],
        between: BallContact,
    ) -> Result<Pressing, ReferenceError> {
        let direction = self.nut_speed.signum();
        let along = |index: usize| {
            if direction > 0.0 {
                index
            } else {
                balls.len() - 1 - index
            }
        };
        let of = |index: usize| (&balls[along(index)], free[along(index)].state);
        let seats: Vec<Option<Seat>> = (0..balls.len())
            .map(|index| {
                let (ball, _) = of(index);
                Some(Seat {
                    grooves: *ball.grooves,
                    axial_load: ball.axial_load,
                    part: 1.0,
                })
            })
            .collect();
        let start: Vec<_> = (0..balls.len()).map(|index| Some(of(index).1)).collect();
        let mut touching = vec![true; balls.len()];
        touching[balls.len() - 1] = false;
        let instant = Instant {
            seats: &seats,
            touching: &touching,
            friction: self.friction,
            neighbours: Neighbours {
                balls: balls.len(),
                direction,
            },
            between,
            integration: self.integration,
            idle_speed: 0.0,
        };
        let found = instant.settle(&start, &vec![0.0; balls.len()])?;
        let solved = (0..balls.len())
            .filter_map(|index| {
                Some(Solved {
                    state: found.states[along(index)]?,
                    residual: found.residual
                        * sum_of_loads(&balls[index], &found.states[along(index)]?),
                    stiffness: 1.0 / found.compliance[along(index)],
                })
            })
            .collect();
        let mut forces = found.forces;
        forces.truncate(balls.len() - 1);
        if direction < 0.0 {
            forces.reverse();
        }
        Ok(Pressing {
            balls: solved,
            forces,
            ball_loss: found.power.balls,
        })
    }

    fn grooves(&self) -> Result<Vec<ElasticGrooves>, ReferenceError> {
        within("friction", self.friction, 1e-3, 1.0)?;
        within("ball_friction", self.ball_friction, 0.0, 1.0)?;
        within("nut_speed", self.nut_speed, -1e6, 1e6)?;
        if self.nut_speed == 0.0 {
            return Err(ReferenceError::Standstill);
        }
        within("balls", self.balls.len() as f64, 1.0, 1e4)?;
        let grooves = ElasticGrooves::of(&self.design, self.clearance)?;
        self.balls
            .iter()
            .map(|ball| {
                within("axial_load", ball.axial_load, -1e6, 1e6)?;
                if ball.axial_load == 0.0 {
                    return Err(ReferenceError::Undriven);
                }
                grooves.deviating(ball.screw_deviation, ball.nut_deviation)
            })
            .collect()
    }

    fn results(&self, balls: &[PlacedBall<'_>], solved: &[Solved]) -> Vec<RowBallMotion> {
        balls
            .iter()
            .zip(solved)
            .map(|(ball, solved)| RowBallMotion::of(ball, solved, self.nut_speed))
            .collect()
    }
}

fn sum_of_loads(ball: &PlacedBall<'_>, state: &BallState) -> f64 {
    ball.loads(&state.place).iter().sum()
}
