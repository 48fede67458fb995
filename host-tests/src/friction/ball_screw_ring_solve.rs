//! One instant of a ring of balls: place, motion and loads of every ball, and the forces between them.
//!
//! Newton's method on all balls at once: every ball's seven equations are replaced by their tangents, which leaves a linear law of its speed by
//! the force on it; pooling of these laws gives the forces between the balls; and the forces give all balls their next place and motion.
//! Complementarity then holds in every round, exactly, and what is left is the balls' unbalanced force, that falls quadratically. Friction
//! between balls, and the outward part of their force, follow one round behind.

use nalgebra::SVector;
use rayon::prelude::*;

use super::ball_screw_grooves::ElasticGrooves;
use super::ball_screw_placed::{
    Balance, BallState, Drive, PlacedBall, Rubbing, STICK_SPIN, Solved,
};
use super::ball_screw_ring_pool::pool_ring;
use super::ball_screw_rubbing::{BallContact, press_and_rub};
use super::ball_screw_settle::{settle, unit};
use super::ball_screw_tangent::Tangent;
use super::patch::Integration;
use crate::error::ReferenceError;

/// Change of a ball's force with its speed over the nut's speed where it carries no load, N: it goes along with its neighbours.
const UNLOADED: f64 = 1e-6;
/// Unbalanced force over the sum of a ball's loads at which no further round is taken, and the largest that is accepted.
const BALANCED: f64 = 1e-12;
const ACCEPTED: f64 = 1e-8;
/// Rounds of Newton's method, and the one from which on balls that do not follow are solved one by one.
const ROUNDS: usize = 40;
const PATIENCE: usize = 8;
/// Longest step of a motion over the nut's speed, and of a place over its unit.
const LONGEST_TURN: f64 = 0.5;
const LONGEST_WAY: f64 = 2.0;

/// A ball under load.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Seat {
    pub grooves: ElasticGrooves,
    /// Axial force of the screw on the ball, N.
    pub axial_load: f64,
}

/// What is given at an instant. Balls stand in the order of the track; ball `j` touches the next one where `touching[j]`, the last the first.
pub(crate) struct Instant<'a> {
    /// None for a ball that carries no load.
    pub seats: &'a [Option<Seat>],
    pub touching: &'a [bool],
    pub friction: f64,
    /// 1 where the nut turns forward, -1 backward.
    pub way: f64,
    pub between: BallContact,
    pub integration: Integration,
    /// Speed of a ball that carries no load, over the nut's speed.
    pub idle_speed: f64,
}

/// Solution of an instant.
#[derive(Clone, Debug)]
pub(crate) struct Settled {
    /// None for a ball that carries no load.
    pub states: Vec<Option<BallState>>,
    /// Orbital speeds over the nut's speed.
    pub speeds: Vec<f64>,
    /// Forces along the track between ball `j` and the next, N.
    pub forces: Vec<f64>,
    /// Laws of the balls: speed without force, and its change with it.
    pub unforced: Vec<f64>,
    pub compliance: Vec<f64>,
    /// Largest unbalanced force of a ball over the sum of its loads.
    pub residual: f64,
    pub power: Power,
    /// Rounds taken.
    pub rounds: usize,
}

/// Powers over `R_B w_N`, N.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Power {
    /// What the nut puts in.
    pub put_in: f64,
    /// Lost in the grooves.
    pub grooves: f64,
    /// Lost between balls.
    pub balls: f64,
}

impl Power {
    /// What the nut puts in less what is lost, over the latter; zero where nothing is lost.
    pub fn error(&self) -> f64 {
        let lost = self.grooves + self.balls;
        if lost > 0.0 {
            (self.put_in - lost) / lost
        } else {
            0.0
        }
    }
}

/// One ball under way, in the order of motion.
struct Moving<'a> {
    ball: PlacedBall<'a>,
    state: BallState,
    unit: f64,
    tangent: Tangent,
    /// Change of place and motion for the residual, and by a newton along the track.
    step: [SVector<f64, 7>; 2],
}

impl<'a> Moving<'a> {
    fn new(ball: PlacedBall<'a>, state: BallState) -> Option<Self> {
        let unit = unit(&ball);
        let tangent = ball.tangent(&state, unit)?;
        Some(Self {
            ball,
            state,
            unit,
            tangent,
            step: [SVector::zeros(); 2],
        })
    }

    fn residual(&self) -> f64 {
        self.tangent.balance.amax() / self.tangent.loads
    }

    /// Law of speed and force: `(unforced, compliance)`.
    fn law(&mut self) -> Option<(f64, f64)> {
        let factors = self.tangent.jacobian.lu();
        let mut push = Balance::zeros();
        push[3] = self.ball.path();
        let missing = -factors.solve(&self.tangent.balance)?;
        let by_force = -factors.solve(&push)?;
        self.step = [missing, by_force];
        let compliance = by_force[3];
        let unforced = self.state.motion[0] + missing[3] - compliance * self.state.force;
        (compliance > 0.0 && unforced.is_finite()).then_some((unforced, compliance))
    }

    /// Takes neighbours' other forces, which the balance holds as given.
    fn rub(&mut self, rubbing: Rubbing) {
        self.tangent.balance -= self.ball.given(&self.state);
        self.ball.rubbing = rubbing;
        self.tangent.balance += self.ball.given(&self.state);
    }

    /// Goes to a speed and force; shorter where the tangents do not lead that far. False where nothing leads on.
    fn follow(&mut self, speed: f64, force: f64) -> bool {
        let [missing, by_force] = self.step;
        let change = missing + by_force * (force - self.state.force);
        let way = change.fixed_rows::<3>(0).amax() / LONGEST_WAY;
        let turn = change.fixed_rows::<4>(3).amax() / LONGEST_TURN;
        let longest = way.max(turn);
        let mut fraction = if longest > 1.0 { 1.0 / longest } else { 1.0 };
        let before = self.tangent.balance.norm();
        let floor = 1e-9 * self.tangent.loads;
        let mut best: Option<(BallState, Tangent)> = None;
        for _ in 0..6 {
            let mut there = self.state;
            there.place += change.fixed_rows::<3>(0) * (self.unit * fraction);
            there.motion += change.fixed_rows::<4>(3) * fraction;
            if fraction == 1.0 {
                there.motion[0] = speed;
                there.force = force;
            } else {
                there.force += (force - there.force) * fraction;
            }
            if let Some(tangent) = self.ball.tangent(&there, self.unit) {
                let after = tangent.balance.norm();
                let falls = after < before.max(floor);
                if best.as_ref().is_none_or(|(_, b)| after < b.balance.norm()) {
                    best = Some((there, tangent));
                }
                if falls {
                    break;
                }
            }
            fraction *= 0.5;
        }
        let Some((state, tangent)) = best else {
            return false;
        };
        (self.state, self.tangent) = (state, tangent);
        true
    }
}

impl<'a> Instant<'a> {
    fn ball(&self, seat: &'a Seat) -> PlacedBall<'a> {
        PlacedBall {
            grooves: &seat.grooves,
            friction: self.friction,
            way: self.way,
            axial_load: seat.axial_load,
            rubbing: Rubbing::default(),
            integration: self.integration,
        }
    }

    /// Balls in the order of motion, rear to front.
    fn order(&self) -> Vec<usize> {
        let n = self.seats.len();
        if self.way > 0.0 {
            (0..n).collect()
        } else {
            (0..n).rev().collect()
        }
    }

    /// Index of the pair of a ball and the next one ahead.
    fn pair_ahead(&self, ball: usize) -> usize {
        let n = self.seats.len();
        if self.way > 0.0 {
            ball
        } else {
            (ball + n - 1) % n
        }
    }

    fn ahead(&self, ball: usize) -> usize {
        let n = self.seats.len();
        if self.way > 0.0 {
            (ball + 1) % n
        } else {
            (ball + n - 1) % n
        }
    }

    /// From states near the end where there are any, and with the forces along the track that belong to them.
    ///
    /// # Errors
    /// [`ReferenceError::NotConverged`] where a balance is not met.
    pub fn settle(
        &self,
        start: &[Option<BallState>],
        forces: &[f64],
    ) -> Result<Settled, ReferenceError> {
        let first = self
            .seated(start)
            .and_then(|states| self.rounds(states, forces));
        if let Ok(found) = first {
            return Ok(found);
        }
        // From nothing.
        let n = self.seats.len();
        let cold = self.seated(&vec![None; n])?;
        self.rounds(cold, &vec![0.0; n]).or_else(|_| self.by_rows())
    }

    /// States of the balls under load: given ones, and those of balls that came under load without a neighbour's force.
    fn seated(
        &self,
        start: &[Option<BallState>],
    ) -> Result<Vec<Option<BallState>>, ReferenceError> {
        self.seats
            .par_iter()
            .zip(start)
            .map(|(seat, state)| {
                let Some(seat) = seat else { return Ok(None) };
                if state.is_some() {
                    return Ok(*state);
                }
                let found = settle(&self.ball(seat), Drive::Force(0.0), None)?;
                Ok(Some(found.state))
            })
            .collect()
    }

    /// Newton's method on all balls.
    fn rounds(
        &self,
        states: Vec<Option<BallState>>,
        forces: &[f64],
    ) -> Result<Settled, ReferenceError> {
        let mut moving: Vec<Option<Moving<'a>>> = self
            .seats
            .par_iter()
            .zip(states)
            .map(|(seat, state)| Moving::new(self.ball(seat.as_ref()?), state?))
            .collect();
        if moving
            .iter()
            .zip(self.seats)
            .any(|(m, s)| m.is_none() && s.is_some())
        {
            return Err(ReferenceError::unbalanced(f64::INFINITY));
        }
        let mut speeds: Vec<f64> = moving
            .iter()
            .map(|m| m.as_ref().map_or(self.idle_speed, |m| m.state.motion[0]))
            .collect();
        let mut forces = forces.to_vec();
        let mut best = f64::INFINITY;
        for round in 0..ROUNDS {
            let loss = self.rub(&mut moving, &forces);
            let residual = moving
                .iter()
                .flatten()
                .map(Moving::residual)
                .fold(0.0, f64::max);
            let whole = round > 0 && self.goes_together(&moving, &speeds);
            let stalled = residual <= ACCEPTED && residual > 0.3 * best;
            if whole && (residual <= BALANCED || stalled) {
                return self.finished(&mut moving, speeds, forces, residual, loss, round);
            }
            if whole {
                best = best.min(residual);
            }
            if round >= PATIENCE && round % 4 == 0 {
                self.one_by_one(&mut moving, &speeds)?;
            }
            let (unforced, compliance) = self.laws(&mut moving)?;
            (speeds, forces) = self.pool(&unforced, &compliance);
            let nets = self.net(&forces);
            let going = moving
                .par_iter_mut()
                .enumerate()
                .map(|(j, m)| m.as_mut().is_none_or(|m| m.follow(speeds[j], nets[j])))
                .reduce(|| true, |a, b| a && b);
            if !going {
                break;
            }
        }
        Err(ReferenceError::unbalanced(best))
    }

    /// True where every ball has gone the whole step: it has the speed that pooling gave it.
    fn goes_together(&self, moving: &[Option<Moving<'a>>], speeds: &[f64]) -> bool {
        moving
            .iter()
            .zip(speeds)
            .all(|(m, speed)| m.as_ref().is_none_or(|m| m.state.motion[0] == *speed))
    }

    /// Laws of speed and force of all balls.
    fn laws(
        &self,
        moving: &mut [Option<Moving<'a>>],
    ) -> Result<(Vec<f64>, Vec<f64>), ReferenceError> {
        let idle = (self.idle_speed, 1.0 / UNLOADED);
        moving
            .iter_mut()
            .map(|m| m.as_mut().map_or(Some(idle), Moving::law))
            .collect::<Option<Vec<_>>>()
            .map(|laws| laws.into_iter().unzip())
            .ok_or(ReferenceError::unbalanced(f64::INFINITY))
    }

    /// Speeds and forces by linear laws, in the order of the track.
    pub fn pool(&self, unforced: &[f64], compliance: &[f64]) -> (Vec<f64>, Vec<f64>) {
        let n = self.seats.len();
        let order = self.order();
        let of = |values: &[f64]| order.iter().map(|j| values[*j]).collect::<Vec<_>>();
        let open: Vec<bool> = order
            .iter()
            .map(|j| !self.touching[self.pair_ahead(*j)])
            .collect();
        let (row_speeds, row_forces) = pool_ring(&of(unforced), &of(compliance), &open);
        let (mut speeds, mut forces) = (vec![0.0; n], vec![0.0; n]);
        for (at, j) in order.iter().enumerate() {
            speeds[*j] = row_speeds[at];
            forces[self.pair_ahead(*j)] = row_forces[at];
        }
        (speeds, forces)
    }

    /// Net forces on the balls in the direction of orbiting.
    fn net(&self, forces: &[f64]) -> Vec<f64> {
        let mut nets = vec![0.0; forces.len()];
        for j in 0..forces.len() {
            let force = forces[self.pair_ahead(j)];
            nets[j] -= force;
            nets[self.ahead(j)] += force;
        }
        nets
    }

    /// Puts the other forces between neighbours on the balls; the power lost over `R_B w_N`. Balls that carry no load do not rub.
    fn rub(&self, moving: &mut [Option<Moving<'a>>], forces: &[f64]) -> f64 {
        if !self.between.acts() {
            return 0.0;
        }
        let mut all = vec![Rubbing::default(); moving.len()];
        let mut loss = 0.0;
        for rear in 0..moving.len() {
            let force = forces[self.pair_ahead(rear)];
            let front = self.ahead(rear);
            if let (Some(a), Some(b)) = (&moving[rear], &moving[front])
                && force > 0.0
            {
                let between = self.between.between(force, &a.state, &b.state);
                all[rear] += between.on_rear;
                all[front] += between.on_front;
                loss += between.loss;
            }
        }
        for (m, rubbing) in moving.iter_mut().zip(all) {
            if let Some(m) = m {
                m.rub(rubbing);
            }
        }
        loss
    }

    /// Balls that Newton's method on all leaves unbalanced, each at its speed.
    fn one_by_one(
        &self,
        moving: &mut [Option<Moving<'a>>],
        speeds: &[f64],
    ) -> Result<(), ReferenceError> {
        moving
            .par_iter_mut()
            .zip(speeds)
            .filter_map(|(m, speed)| m.as_mut().map(|m| (m, speed)))
            .filter(|(m, _)| m.residual() > ACCEPTED)
            .try_for_each(|(m, speed)| {
                let found = settle(&m.ball, Drive::Speed(*speed), Some(&m.state))?;
                *m = Moving::new(m.ball, found.state)
                    .ok_or(ReferenceError::unbalanced(found.residual))?;
                Ok(())
            })
    }

    /// Row by row, each by the laws of its balls: slow, and sure. Only where some gap is open and all balls carry load.
    fn by_rows(&self) -> Result<Settled, ReferenceError> {
        let n = self.seats.len();
        let order = self.order();
        let unsolved = ReferenceError::unbalanced(f64::INFINITY);
        let broken = order
            .iter()
            .position(|j| !self.touching[self.pair_ahead(*j)]);
        let (Some(broken), true) = (broken, self.seats.iter().all(Option::is_some)) else {
            return Err(unsolved);
        };
        let mut states = vec![None; n];
        let mut forces = vec![0.0; n];
        let mut row: Vec<usize> = Vec::new();
        for at in broken + 1..=broken + n {
            let ball = order[at % n];
            row.push(ball);
            if self.touching[self.pair_ahead(ball)] {
                continue;
            }
            let mut balls: Vec<PlacedBall<'_>> = row
                .iter()
                .filter_map(|j| self.seats[*j].as_ref())
                .map(|seat| self.ball(seat))
                .collect();
            let free = balls
                .iter()
                .map(|ball| settle(ball, Drive::Force(0.0), None))
                .collect::<Result<Vec<Solved>, _>>()?;
            let found = press_and_rub(&mut balls, &free, &self.between)?;
            for (at, j) in row.iter().enumerate() {
                states[*j] = Some(found.balls[at].state);
                if let Some(force) = found.forces.get(at) {
                    forces[self.pair_ahead(*j)] = *force;
                }
            }
            row.clear();
        }
        let mut moving: Vec<Option<Moving<'a>>> = self
            .seats
            .iter()
            .zip(states)
            .map(|(seat, state)| Moving::new(self.ball(seat.as_ref()?), state?))
            .collect();
        let loss = self.rub(&mut moving, &forces);
        let residual = moving
            .iter()
            .map(|m| m.as_ref().map_or(f64::INFINITY, Moving::residual))
            .fold(0.0, f64::max);
        // Forces that were found pass by pass agree to 1e-10 of the largest.
        if !(residual <= 10.0 * ACCEPTED) {
            return Err(ReferenceError::unbalanced(residual));
        }
        let speeds = moving.iter().flatten().map(|m| m.state.motion[0]).collect();
        self.finished(&mut moving, speeds, forces, residual, loss, ROUNDS)
    }

    fn finished(
        &self,
        moving: &mut [Option<Moving<'a>>],
        speeds: Vec<f64>,
        forces: Vec<f64>,
        residual: f64,
        loss: f64,
        rounds: usize,
    ) -> Result<Settled, ReferenceError> {
        let mut power = Power {
            balls: loss,
            ..Power::default()
        };
        for m in moving.iter().flatten() {
            let rows = m.ball.rows(&m.state.place).unwrap_or_default();
            power.put_in += m.ball.power_in(&rows, &m.state.motion);
            power.grooves += rows
                .iter()
                .map(|row| {
                    row.local(&m.state.motion, STICK_SPIN)
                        .gradient
                        .dot(&row.velocity(&m.state.motion))
                })
                .sum::<f64>()
                * self.friction;
        }
        let (unforced, compliance) = self.laws(moving)?;
        Ok(Settled {
            states: moving.iter().map(|m| m.as_ref().map(|m| m.state)).collect(),
            speeds,
            forces,
            unforced,
            compliance,
            residual,
            power,
            rounds,
        })
    }
}
