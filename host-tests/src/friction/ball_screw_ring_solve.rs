//! One instant of a ring of balls: place, motion and loads of every ball, and the forces between them.
//!
//! Newton's method on all balls at once. Which pairs press is first found by pooling of the balls' tangents; from then on a pair that would
//! pull is let go, and one whose rear ball would overtake is joined, until nothing changes and every ball is in balance.

use nalgebra::SVector;
use rayon::prelude::*;

use super::ball_screw_grooves::ElasticGrooves;
use super::ball_screw_placed::{BallState, Drive, PlacedBall, Rubbing, Solved};
use super::ball_screw_ring_newton::{InRow, Moving, Target, UNLOADED, row_step};
use super::ball_screw_ring_order::Neighbours;
use super::ball_screw_ring_pool::pool_ring;
use super::ball_screw_rubbing::{BallContact, press_and_rub};
use super::ball_screw_settle::settle;
use super::patch::Integration;
use crate::error::ReferenceError;

/// Unbalanced force over the sum of a ball's loads at which no further round is taken, and the largest that is accepted.
const BALANCED: f64 = 1e-12;
const ACCEPTED: f64 = 1e-8;
/// Rounds of Newton's method, and the one from which on balls that do not follow are solved one by one.
const ROUNDS: usize = 40;
const PATIENCE: usize = 8;
/// Overtaking over the nut's speed, and pulling over the loads, that is rounding.
const OVERTAKES: f64 = 1e-12;
const PULLS: f64 = 1e-10;

#[derive(Clone, Copy, Debug)]
pub(crate) struct Seat {
    pub grooves: ElasticGrooves,
    /// Axial force of the screw on the ball, N.
    pub axial_load: f64,
    /// Part of its load that it carries on the run-in, 1 between the run-ins.
    pub part: f64,
}

/// What is given at an instant. Balls stand in the order of the track; ball `j` touches the next one where `touching[j]`, the last the first.
pub(crate) struct Instant<'a> {
    pub seats: &'a [Option<Seat>],
    pub touching: &'a [bool],
    pub friction: f64,
    pub neighbours: Neighbours,
    pub between: BallContact,
    pub integration: Integration,
    pub idle_speed: f64,
}

#[derive(Clone, Debug)]
pub(crate) struct Settled {
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
}

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
    pub fn error(&self) -> f64 {
        let lost = self.grooves + self.balls;
        if lost > 0.0 {
            (self.put_in - lost) / lost
        } else {
            0.0
        }
    }
}

impl<'a> Instant<'a> {
    fn ball(&self, seat: &'a Seat) -> PlacedBall<'a> {
        PlacedBall::alone(
            &seat.grooves,
            self.friction,
            self.neighbours.direction,
            seat.axial_load,
            self.integration,
        )
    }

    /// From states near the end where there are any, and with the forces along the track that belong to them.
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
        let n = self.seats.len();
        let cold = self.seated(&vec![None; n])?;
        self.rounds(cold, &vec![0.0; n]).or_else(|_| self.by_rows())
    }

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

    fn rounds(
        &self,
        states: Vec<Option<BallState>>,
        forces: &[f64],
    ) -> Result<Settled, ReferenceError> {
        let mut moving = self.moving(states)?;
        let mut forces = forces.to_vec();
        self.push(&mut moving, &forces);
        let (unforced, compliance) = self.laws(&moving)?;
        let (mut speeds, pooled) = self.pool(&unforced, &compliance);
        let mut pressing: Vec<bool> = pooled.iter().map(|force| *force > 0.0).collect();
        forces = pooled;
        let mut settled = false;
        let mut best = f64::INFINITY;
        for round in 0..ROUNDS {
            let loss = self.push(&mut moving, &forces);
            let residual = residual(&moving);
            let whole = settled && goes_together(&moving, &speeds);
            let stalled = residual <= ACCEPTED && residual > 0.9 * best;
            if whole && (residual <= BALANCED || stalled) {
                return self.finished(&moving, speeds, forces, residual, loss);
            }
            best = best.min(residual);
            if round >= PATIENCE && round % 4 == 0 {
                one_by_one(&mut moving, &speeds)?;
                self.push(&mut moving, &forces);
            }
            let (targets, wanted) = self
                .targets(&moving, &speeds, &forces, &pressing)
                .ok_or(ReferenceError::unbalanced(best))?;
            speeds = targets.iter().map(|target| target.speed).collect();
            moving
                .par_iter_mut()
                .zip(&targets)
                .filter_map(|(m, target)| m.as_mut().map(|m| (m, target)))
                .for_each(|(m, target)| m.follow(target));
            let next = self.pressing_next(&pressing, &speeds, &wanted);
            settled = next == pressing;
            pressing = next;
            forces = wanted
                .iter()
                .zip(&pressing)
                .map(|(force, presses)| if *presses { force.max(0.0) } else { 0.0 })
                .collect();
        }
        Err(ReferenceError::unbalanced(best))
    }

    fn moving(
        &self,
        states: Vec<Option<BallState>>,
    ) -> Result<Vec<Option<Moving<'a>>>, ReferenceError> {
        self.seats
            .par_iter()
            .zip(states)
            .map(|(seat, state)| {
                let (Some(seat), Some(state)) = (seat, state) else {
                    return Ok(None);
                };
                let lost = ReferenceError::unbalanced(f64::INFINITY);
                Moving::new(&self.ball(seat), state).map(Some).ok_or(lost)
            })
            .collect()
    }

    /// Pairs that press in the next round: not those that would pull, and those whose rear ball would overtake.
    fn pressing_next(&self, pressing: &[bool], speeds: &[f64], forces: &[f64]) -> Vec<bool> {
        let load = self
            .seats
            .iter()
            .flatten()
            .map(|seat| seat.axial_load.abs())
            .fold(0.0, f64::max);
        let mut next = pressing.to_vec();
        for rear in 0..speeds.len() {
            let pair = self.neighbours.pair_ahead(rear);
            next[pair] = if pressing[pair] {
                forces[pair] > -PULLS * load
            } else {
                self.touching[pair]
                    && speeds[rear] > speeds[self.neighbours.ahead(rear)] + OVERTAKES
            };
        }
        next
    }

    fn targets(
        &self,
        moving: &[Option<Moving<'a>>],
        speeds: &[f64],
        forces: &[f64],
        pressing: &[bool],
    ) -> Option<(Vec<Target>, Vec<f64>)> {
        let n = moving.len();
        let nets = self.neighbours.net(forces);
        let mut changes = vec![SVector::<f64, 7>::zeros(); n];
        let mut common = speeds.to_vec();
        let mut wanted = vec![0.0; n];
        let rows = self.neighbours.rows_of(pressing);
        let steps: Vec<_> = rows
            .par_iter()
            .map(|row| {
                let balls: Vec<InRow<'_, '_>> = row
                    .iter()
                    .map(|ball| match &moving[*ball] {
                        Some(m) => InRow::Loaded(m),
                        None => InRow::Idle {
                            speed: speeds[*ball],
                            unforced: self.idle_speed,
                            force: nets[*ball],
                        },
                    })
                    .collect();
                let slopes: Vec<_> = row
                    .windows(2)
                    .map(|pair| {
                        let force = forces[self.neighbours.pair_ahead(pair[0])];
                        let idle = BallState::new(
                            nalgebra::Vector3::zeros(),
                            nalgebra::Vector4::zeros(),
                            0.0,
                        );
                        let state = |ball: usize| moving[ball].as_ref().map(|m| m.state);
                        match (state(pair[0]), state(pair[1])) {
                            (Some(a), Some(b)) => {
                                self.contact(pair[0], pair[1]).slope(force, &a, &b)
                            }
                            _ => self.between.smooth().slope(force, &idle, &idle),
                        }
                    })
                    .collect();
                row_step(&balls, &slopes)
            })
            .collect();
        for (row, step) in rows.iter().zip(steps) {
            let step = step?;
            let first = row[0];
            let present = moving[first]
                .as_ref()
                .map_or(speeds[first], |m| m.state.motion[0]);
            for (ball, change) in row.iter().zip(&step.changes) {
                changes[*ball] = *change;
                common[*ball] = present + step.changes[0][3];
            }
            for (ball, change) in row.iter().zip(&step.forces) {
                let pair = self.neighbours.pair_ahead(*ball);
                wanted[pair] = forces[pair] + change;
            }
        }
        let after: Vec<Option<BallState>> = moving
            .iter()
            .zip(&changes)
            .map(|(m, change)| {
                let mut state = m.as_ref()?.state;
                state.motion += change.fixed_rows::<4>(3);
                Some(state)
            })
            .collect();
        let (rubbing, _) = self.rubbing(&after, &wanted);
        let nets = self.neighbours.net(&wanted);
        let targets = (0..n)
            .map(|ball| Target {
                change: changes[ball],
                speed: common[ball],
                force: nets[ball],
                rubbing: rubbing[ball],
            })
            .collect();
        Some((targets, wanted))
    }

    /// Contact of two balls: on the run-in they rub by the lesser of their parts, so that friction sets in with the load.
    fn contact(&self, rear: usize, front: usize) -> BallContact {
        let part = |ball: usize| self.seats[ball].map_or(0.0, |seat| seat.part);
        self.between.in_part(part(rear).min(part(front)))
    }

    fn laws(&self, moving: &[Option<Moving<'a>>]) -> Result<(Vec<f64>, Vec<f64>), ReferenceError> {
        let idle = (self.idle_speed, 1.0 / UNLOADED);
        moving
            .par_iter()
            .map(|m| m.as_ref().map_or(Some(idle), Moving::law))
            .collect::<Option<Vec<_>>>()
            .map(|laws| laws.into_iter().unzip())
            .ok_or(ReferenceError::unbalanced(f64::INFINITY))
    }

    pub fn pool(&self, unforced: &[f64], compliance: &[f64]) -> (Vec<f64>, Vec<f64>) {
        let n = self.seats.len();
        let order = self.neighbours.order();
        let of = |values: &[f64]| order.iter().map(|j| values[*j]).collect::<Vec<_>>();
        let open: Vec<bool> = order
            .iter()
            .map(|j| !self.touching[self.neighbours.pair_ahead(*j)])
            .collect();
        let (row_speeds, row_forces) = pool_ring(&of(unforced), &of(compliance), &open);
        let (mut speeds, mut forces) = (vec![0.0; n], vec![0.0; n]);
        for (at, j) in order.iter().enumerate() {
            speeds[*j] = row_speeds[at];
            forces[self.neighbours.pair_ahead(*j)] = row_forces[at];
        }
        (speeds, forces)
    }

    /// What neighbours do to each ball besides pushing it along the track, and the power lost over `R_B w_N`. Balls that carry no load do not
    /// rub.
    fn rubbing(&self, states: &[Option<BallState>], forces: &[f64]) -> (Vec<Rubbing>, f64) {
        let mut all = vec![Rubbing::default(); states.len()];
        let mut loss = 0.0;
        if !self.between.acts() {
            return (all, loss);
        }
        for rear in 0..states.len() {
            let force = forces[self.neighbours.pair_ahead(rear)];
            let front = self.neighbours.ahead(rear);
            if !(force > 0.0) {
                continue;
            }
            if let (Some(a), Some(b)) = (&states[rear], &states[front]) {
                let between = self.contact(rear, front).between(force, a, b);
                all[rear] += between.on_rear;
                all[front] += between.on_front;
                loss += between.loss;
            } else {
                let outward = self.between.outward_force(force);
                all[rear].in_plane[0] += outward;
                all[front].in_plane[0] += outward;
            }
        }
        (all, loss)
    }

    fn push(&self, moving: &mut [Option<Moving<'a>>], forces: &[f64]) -> f64 {
        let states: Vec<_> = moving.iter().map(|m| m.as_ref().map(|m| m.state)).collect();
        let (rubbing, loss) = self.rubbing(&states, forces);
        let nets = self.neighbours.net(forces);
        for ((m, rubbing), net) in moving.iter_mut().zip(rubbing).zip(nets) {
            if let Some(m) = m {
                m.push(net, rubbing);
            }
        }
        loss
    }

    /// Row by row, each by the laws of its balls: slow, and sure but where friction between balls matters much. Only for balls that all carry
    /// load, with a gap somewhere.
    fn by_rows(&self) -> Result<Settled, ReferenceError> {
        let n = self.seats.len();
        let whole = |seat: &Option<Seat>| seat.is_some_and(|seat| seat.part == 1.0);
        if self.touching.iter().all(|touching| *touching) || !self.seats.iter().all(whole) {
            return Err(ReferenceError::unbalanced(f64::INFINITY));
        }
        let mut states = vec![None; n];
        let mut forces = vec![0.0; n];
        for row in self.neighbours.rows_of(self.touching) {
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
                    forces[self.neighbours.pair_ahead(*j)] = *force;
                }
            }
        }
        let mut moving = self.moving(states)?;
        let loss = self.push(&mut moving, &forces);
        let residual = residual(&moving);
        if !(residual <= ACCEPTED) {
            return Err(ReferenceError::unbalanced(residual));
        }
        let speeds = moving.iter().flatten().map(|m| m.state.motion[0]).collect();
        self.finished(&moving, speeds, forces, residual, loss)
    }

    fn finished(
        &self,
        moving: &[Option<Moving<'a>>],
        speeds: Vec<f64>,
        forces: Vec<f64>,
        residual: f64,
        loss: f64,
    ) -> Result<Settled, ReferenceError> {
        let mut power = Power {
            balls: loss,
            ..Power::default()
        };
        for m in moving.iter().flatten() {
            let rows = m.ball.rows_of(&m.state).unwrap_or_default();
            power.put_in += m.ball.power_in(&rows, &m.state.motion);
            power.grooves += rows
                .iter()
                .map(|row| {
                    row.local(&m.state.motion, m.ball.rest_spin)
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
        })
    }
}

fn residual(moving: &[Option<Moving<'_>>]) -> f64 {
    let balls = moving.iter().flatten();
    balls.map(Moving::residual).fold(0.0, f64::max)
}

fn goes_together(moving: &[Option<Moving<'_>>], speeds: &[f64]) -> bool {
    moving
        .iter()
        .zip(speeds)
        .all(|(m, speed)| m.as_ref().is_none_or(|m| m.state.motion[0] == *speed))
}

fn one_by_one(moving: &mut [Option<Moving<'_>>], speeds: &[f64]) -> Result<(), ReferenceError> {
    moving
        .par_iter_mut()
        .zip(speeds)
        .filter_map(|(m, speed)| m.as_mut().map(|m| (m, speed)))
        .filter(|(m, _)| m.residual() > ACCEPTED)
        .try_for_each(|(m, speed)| {
            let found = settle(&m.ball, Drive::Speed(*speed), Some(&m.state))?;
            *m = Moving::new(&m.ball, found.state)
                .ok_or(ReferenceError::unbalanced(found.residual))?;
            Ok(())
        })
}
