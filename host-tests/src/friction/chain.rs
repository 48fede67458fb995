//! Chains of balls that touch: ball-to-ball forces (Lin 2019, eqs. (3.26) to (3.31)).
//!
//! Balls stand in the order rear to front along the positive direction of the track, all neighbours close enough to touch. Two
//! balls press on each other when the rear one would be faster. The speeds then are those that minimise the total power under
//! `v_j <= v_(j+1)`, and the contact forces are the multipliers.

use nalgebra::{DMatrix, DVector, SMatrix, Vector3};

use super::linear_ball::{LinearBall, LinearMotion};
use super::newton::Local;
use super::planar::{self, ContactFriction, PlanarContact};
use super::train_newton::{Train, solve_train};
use crate::error::{ReferenceError, within};

/// Pools the adjacent violators of `x_j <= x_(j+1)` in `min sum (x_j - free_j)^2/(2 compliance_j)`.
///
/// Returns the speeds and the contact forces between neighbours, `F_j = sum_(i <= j) (free_i - x)/compliance_i` within a cluster.
/// Exact for the linear model, in at most `2 n - 1` comparisons.
///
/// Source: the complementarity form of Lin 2019, eqs. (3.30), (3.31), for the linear model of (3.49).
pub fn pool_adjacent_violators(free: &[f64], compliance: &[f64]) -> (Vec<f64>, Vec<f64>) {
    struct Cluster {
        weight: f64,
        moment: f64,
        balls: usize,
    }
    let mut clusters: Vec<Cluster> = Vec::with_capacity(free.len());
    for (&x, &s) in free.iter().zip(compliance) {
        clusters.push(Cluster {
            weight: 1.0 / s,
            moment: x / s,
            balls: 1,
        });
        while let [.., rear, front] = clusters.as_slice() {
            if rear.moment * front.weight <= front.moment * rear.weight {
                break;
            }
            let merged = Cluster {
                weight: rear.weight + front.weight,
                moment: rear.moment + front.moment,
                balls: rear.balls + front.balls,
            };
            clusters.truncate(clusters.len() - 2);
            clusters.push(merged);
        }
    }
    let speeds: Vec<f64> = clusters
        .iter()
        .flat_map(|c| std::iter::repeat_n(c.moment / c.weight, c.balls))
        .collect();
    let mut forces = Vec::with_capacity(free.len().saturating_sub(1));
    let mut balls = free.iter().zip(compliance).zip(&speeds);
    for cluster in &clusters {
        let mut force = 0.0;
        for ((x, s), speed) in balls.by_ref().take(cluster.balls - 1) {
            force += (x - speed) / s;
            forces.push(force.max(0.0));
        }
        if balls.next().is_some() {
            forces.push(0.0);
        }
    }
    forces.pop();
    (speeds, forces)
}

/// The same by the min-max formula of isotonic regression, `x_j = max_(i <= j) min_(k >= j) mean(i..k)`: no pooling, no order
/// of merges; the reference for long chains. Takes `n^3` operations.
pub fn isotonic_by_min_max(free: &[f64], compliance: &[f64]) -> (Vec<f64>, Vec<f64>) {
    let n = free.len();
    let mut weight = vec![0.0];
    let mut moment = vec![0.0];
    for (x, s) in free.iter().zip(compliance) {
        weight.push(weight[weight.len() - 1] + 1.0 / s);
        moment.push(moment[moment.len() - 1] + x / s);
    }
    let mean = |i: usize, k: usize| (moment[k + 1] - moment[i]) / (weight[k + 1] - weight[i]);
    let speeds: Vec<f64> = (0..n)
        .map(|j| {
            (0..=j)
                .map(|i| (j..n).map(|k| mean(i, k)).fold(f64::INFINITY, f64::min))
                .fold(f64::NEG_INFINITY, f64::max)
        })
        .collect();
    // Prefix sums over the whole chain: the force behind the first and ahead of the last ball is zero.
    let mut force = 0.0;
    let forces = free
        .iter()
        .zip(compliance)
        .zip(&speeds)
        .take(n.saturating_sub(1))
        .map(|((x, s), speed)| {
            force += (x - speed) / s;
            force
        })
        .collect();
    (speeds, forces)
}

/// The same by trying every set of contacts, `2^(n-1)` linear systems: the reference for short chains (at most 16 balls).
///
/// A set of contacts is the solution when all its forces push and no open neighbours overtake. Returns the
/// set that comes nearest to both, which is exact up to rounding; `None` beyond 16 balls.
pub fn exhaustive_contacts(free: &[f64], compliance: &[f64]) -> Option<(Vec<f64>, Vec<f64>)> {
    let n = free.len();
    if n > 16 {
        return None;
    }
    let mut best: Option<(f64, Vec<f64>, Vec<f64>)> = None;
    for set in 0..1_usize << n.saturating_sub(1) {
        let active: Vec<usize> = (0..n.saturating_sub(1))
            .filter(|j| set >> j & 1 == 1)
            .collect();
        let m = active.len();
        // x_j = free_j + s_j (F_(j-1) - F_j) with x_j = x_(j+1) for every active contact j.
        let matrix = DMatrix::from_fn(m, m, |row, column| {
            let (i, j) = (active[row], active[column]);
            if i == j {
                compliance[j] + compliance[j + 1]
            } else if i == j + 1 {
                -compliance[i]
            } else if j == i + 1 {
                -compliance[j]
            } else {
                0.0
            }
        });
        let right = DVector::from_fn(m, |row, _| free[active[row]] - free[active[row] + 1]);
        let solution = if m == 0 {
            Some(right)
        } else {
            matrix.lu().solve(&right)
        };
        let Some(solution) = solution else { continue };
        let mut forces = vec![0.0; n.saturating_sub(1)];
        for (&j, &force) in active.iter().zip(solution.iter()) {
            forces[j] = force;
        }
        let speeds: Vec<f64> = (0..n)
            .map(|j| {
                let behind = if j > 0 { forces[j - 1] } else { 0.0 };
                free[j] + compliance[j] * (behind - forces.get(j).copied().unwrap_or(0.0))
            })
            .collect();
        let pull = active
            .iter()
            .map(|&j| -forces[j] * compliance[j])
            .fold(0.0, f64::max);
        let overtake = speeds
            .windows(2)
            .map(|pair| pair[0] - pair[1])
            .fold(0.0, f64::max);
        let violation = pull.max(overtake);
        if best.as_ref().is_none_or(|(least, ..)| violation < *least) {
            best = Some((violation, speeds, forces));
        }
    }
    best.map(|(_, speeds, forces)| (speeds, forces))
}

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
/// `ball_friction` is the coefficient between balls; zero leaves the ball-to-ball moments out. Without them the
/// problem is convex and is solved as such. With them it has no potential; from the convex solution, Newton
/// steps on the full system of `4 n - 1` unknowns with its contact conditions follow the rising coefficient.
/// With a negative speed the balls roll the other way, and the front ball of the list becomes the rear one.
///
/// Corrected: the count of unknowns after (3.31) is `4 n - 1`; for the front ball of a pair the normal force reverses, but the
/// moment terms of (3.29) keep their sign (force and arm both reverse).
///
/// # Errors
/// As [`LinearBall::solve`]; when the balls' radii or friction coefficients differ; with an empty list.
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
