//! Chains of balls that touch: ball-to-ball forces (Lin 2019, eqs. (3.26) to (3.31)).
//!
//! Balls stand in the order rear to front along the positive direction of the track, all neighbours close enough to touch. Two
//! balls press on each other when the rear one would be faster. The speeds then are those that minimise the total power under
//! `v_j <= v_(j+1)`, and the contact forces are the multipliers.

use nalgebra::{DMatrix, DVector, SVector, Vector3};

use super::linear_ball::{LinearBall, LinearMotion};
use super::newton::{Local, STAGES};
use super::planar::{self, ContactFriction, PlanarContact};
use super::{FrictionError, within};

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

/// Result of the chain's minimisation.
#[derive(Clone)]
pub(crate) struct ChainMinimum<const N: usize> {
    pub points: Vec<SVector<f64, N>>,
    pub multipliers: Vec<f64>,
    pub residual: f64,
    pub iterations: usize,
}

/// Minimises `sum_j f_j(y_j)` under `y_j[0] <= y_(j+1)[0]` by sequential quadratic programming.
///
/// The quadratic model's constraint acts on one unknown of each ball, so that its exact solution (active set
/// and all `N n + n - 1` unknowns of (3.31)) is `pool_adjacent_violators` on the Newton speeds
/// with the compliances `(H^-1)_00`. The start is made feasible; each step is a descent direction within the feasible
/// set, shortened until the total falls.
pub(crate) fn minimise_chain<const N: usize>(
    start: &[SVector<f64, N>],
    tolerance: f64,
    f: impl Fn(usize, &SVector<f64, N>) -> Local<N>,
) -> ChainMinimum<N> {
    let n = start.len();
    let mut points = start.to_vec();
    let first: Vec<f64> = points.iter().map(|y| y[0]).collect();
    for (y, speed) in points
        .iter_mut()
        .zip(pool_adjacent_violators(&first, &vec![1.0; n]).0)
    {
        y[0] = speed;
    }
    let evaluate = |points: &[SVector<f64, N>]| -> Vec<Local<N>> {
        points.iter().enumerate().map(|(j, y)| f(j, y)).collect()
    };
    let mut locals = evaluate(&points);
    let mut shift = 1e-14;
    let mut result = ChainMinimum {
        points: points.clone(),
        multipliers: vec![0.0; n.saturating_sub(1)],
        residual: f64::INFINITY,
        iterations: 0,
    };
    let mut stalled = 0;
    while result.iterations < 200 && stalled < 4 {
        result.iterations += 1;
        let mut free = Vec::with_capacity(n);
        let mut compliance = Vec::with_capacity(n);
        let mut steps = Vec::with_capacity(n);
        for (y, local) in points.iter().zip(&locals) {
            let mean = (local.hessian.trace() / N as f64).max(1e-300);
            let mut shifted = local.hessian + nalgebra::SMatrix::identity() * (shift * mean);
            let factor = loop {
                if let Some(factor) = shifted.cholesky() {
                    break factor;
                }
                shift = (shift * 100.0).max(1e-12);
                shifted = local.hessian + nalgebra::SMatrix::identity() * (shift * mean);
                if shift > 1e6 || !shift.is_finite() {
                    return result;
                }
            };
            let newton = factor.solve(&local.gradient);
            let mut unit = SVector::<f64, N>::zeros();
            unit[0] = 1.0;
            let column = factor.solve(&unit);
            free.push(y[0] - newton[0]);
            compliance.push(column[0]);
            steps.push((newton, column));
        }
        let (speeds, multipliers) = pool_adjacent_violators(&free, &compliance);
        let mut slope = 0.0;
        let mut residual = 0.0_f64;
        let mut directions = Vec::with_capacity(n);
        for (j, ((newton, column), local)) in steps.iter().zip(&locals).enumerate() {
            let behind = if j > 0 { multipliers[j - 1] } else { 0.0 };
            let net = multipliers.get(j).copied().unwrap_or(0.0) - behind;
            let mut step = -newton - column * net;
            // The speed as pooled, so that touching balls are exactly equally fast.
            step[0] = speeds[j] - points[j][0];
            let mut balance = local.gradient;
            balance[0] += net;
            residual = residual.max(balance.amax());
            slope += local.gradient.dot(&step);
            directions.push(step);
        }
        if residual < result.residual {
            result.points.clone_from(&points);
            result.multipliers = multipliers;
            result.residual = residual;
            stalled = 0;
        } else {
            stalled += 1;
        }
        if residual <= tolerance {
            break;
        }
        let total: f64 = locals.iter().map(|l| l.value).sum();
        let rounding = 1e-13 * total.abs();
        let mut fraction = 1.0;
        let mut moved = false;
        while fraction > 1e-10 {
            let there: Vec<_> = points
                .iter()
                .zip(&directions)
                .map(|(y, d)| y + d * fraction)
                .collect();
            let new = evaluate(&there);
            let value: f64 = new.iter().map(|l| l.value).sum();
            if value <= total + 1e-4 * fraction * slope || (value - total).abs() <= rounding {
                if (value - total).abs() > rounding {
                    stalled = 0;
                }
                points = there;
                locals = new;
                moved = true;
                break;
            }
            fraction *= 0.5;
        }
        shift = if moved {
            (shift * 0.1).max(1e-14)
        } else {
            (shift * 100.0).max(1e-12)
        };
        if shift > 1e3 {
            break;
        }
    }
    result
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

/// The system (3.29) to (3.31) at given motions and forces: unbalanced forces, moments and contact conditions, with the Jacobian.
///
/// Unknowns: three per ball, then the contact forces. A contact is closed when its force minus `penalty` times the
/// speed of parting is positive: then the condition is equal speed, otherwise no force.
fn full_system(
    locals: &[Local<3>],
    points: &[Vector3<f64>],
    forces: &[f64],
    ball_friction: f64,
    penalty: f64,
) -> (DVector<f64>, DMatrix<f64>) {
    let n = points.len();
    let size = 4 * n - 1;
    let mut residual = DVector::zeros(size);
    let mut jacobian = DMatrix::zeros(size, size);
    for (j, local) in locals.iter().enumerate() {
        residual.rows_mut(3 * j, 3).copy_from(&local.gradient);
        jacobian
            .view_mut((3 * j, 3 * j), (3, 3))
            .copy_from(&local.hessian);
    }
    for (k, (&force, pair)) in forces.iter().zip(points.windows(2)).enumerate() {
        let (rear, front, unknown) = (3 * k, 3 * k + 3, 3 * n + k);
        residual[rear] += force;
        residual[front] -= force;
        jacobian[(rear, unknown)] += 1.0;
        jacobian[(front, unknown)] -= 1.0;
        // Friction moment over R_B, (3.27): against the sum of the rotations, the same on both balls.
        let sum = [pair[0].y + pair[1].y, pair[0].z + pair[1].z];
        let slip = sum[0].hypot(sum[1]);
        if slip > 0.0 {
            let unit = sum.map(|x| x / slip);
            for (row, u) in unit.iter().enumerate() {
                for ball in [rear, front] {
                    let at = ball + 1 + row;
                    residual[at] += ball_friction * force * u;
                    jacobian[(at, unknown)] += ball_friction * u;
                    for (column, w) in unit.iter().enumerate() {
                        let across = if row == column { 1.0 } else { 0.0 } - u * w;
                        for other in [rear, front] {
                            jacobian[(at, other + 1 + column)] +=
                                ball_friction * force * across / slip;
                        }
                    }
                }
            }
        }
        let parting = pair[1].x - pair[0].x;
        if force - penalty * parting > 0.0 {
            residual[unknown] = penalty * parting;
            jacobian[(unknown, front)] = penalty;
            jacobian[(unknown, rear)] = -penalty;
        } else {
            residual[unknown] = force;
            jacobian[(unknown, unknown)] = 1.0;
        }
    }
    (residual, jacobian)
}

/// Newton steps on the `4 n - 1` equations with ball-to-ball friction, the set of contacts chosen anew at each step.
fn solve_full_system(
    contacts: &[[PlanarContact; 4]],
    start: &ChainMinimum<3>,
    ball_friction: f64,
    rest_spin: f64,
    tolerance: f64,
) -> ChainMinimum<3> {
    let n = start.points.len();
    let none = Vector3::zeros();
    let locals = |points: &[Vector3<f64>]| -> Vec<Local<3>> {
        contacts
            .iter()
            .zip(points)
            .map(|(c, y)| planar::dissipation(c, &none, y, rest_spin))
            .collect()
    };
    // A force per speed of the size of a ball's stiffness, so that forces and partings weigh alike.
    let penalty = contacts
        .iter()
        .flatten()
        .map(|c| c.friction_limit)
        .fold(0.0, f64::max);
    let mut points = start.points.clone();
    let mut forces = start.multipliers.clone();
    let (mut residual, mut jacobian) =
        full_system(&locals(&points), &points, &forces, ball_friction, penalty);
    let mut iterations = 0;
    let mut stalled = 0;
    while iterations < 100 && stalled < 3 && residual.amax() > tolerance {
        iterations += 1;
        let Some(step) = jacobian.clone().lu().solve(&residual) else {
            break;
        };
        let mut fraction = 1.0;
        loop {
            let there: Vec<_> = points
                .iter()
                .enumerate()
                .map(|(j, y)| y - Vector3::from_fn(|i, _| step[3 * j + i]) * fraction)
                .collect();
            let pushed: Vec<_> = forces
                .iter()
                .enumerate()
                .map(|(k, f)| f - fraction * step[3 * n + k])
                .collect();
            let (new, slope) =
                full_system(&locals(&there), &there, &pushed, ball_friction, penalty);
            let better = new.norm() < (1.0 - 1e-4 * fraction) * residual.norm();
            if better || fraction < 1e-6 {
                stalled = if better { 0 } else { stalled + 1 };
                if better {
                    (points, forces, residual, jacobian) = (there, pushed, new, slope);
                }
                break;
            }
            fraction *= 0.5;
        }
    }
    // Rounding may leave touching balls unequal in the last digit, and open contacts with a trace of force.
    ChainMinimum {
        points,
        multipliers: forces.iter().map(|f| f.max(0.0)).collect(),
        residual: residual.amax(),
        iterations,
    }
}

/// Follows the solution of the full system from no friction between balls to `ball_friction`, in strides as long as
/// Newton's method bears.
fn raise_ball_friction(
    contacts: &[[PlanarContact; 4]],
    start: &ChainMinimum<3>,
    ball_friction: f64,
    rest_spin: f64,
    tolerance: f64,
    accept: f64,
) -> Option<ChainMinimum<3>> {
    let mut here = start.clone();
    let mut reached = 0.0;
    let mut stride = ball_friction;
    while reached < ball_friction {
        let target = f64::min(reached + stride, ball_friction);
        let mut next = solve_full_system(contacts, &here, target, rest_spin, tolerance);
        if next.residual <= accept {
            next.iterations += here.iterations;
            here = next;
            reached = target;
        } else {
            stride *= 0.5;
            if stride < 0.02 * ball_friction {
                return None;
            }
        }
    }
    Some(here)
}

/// Solves a chain of touching balls, rear to front along +z: the `4 n - 1` equations (3.29) to (3.31).
///
/// `ball_friction` is the coefficient between balls; zero leaves the ball-to-ball moments out. Without them the
/// problem is convex and is solved as such. With them it has no potential; from the convex solution, Newton
/// steps on the full system with its contact conditions follow the rising coefficient.
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
) -> Result<LinearChain, FrictionError> {
    within("ball_friction", ball_friction, 0.0, 1.0)?;
    within("speed", speed, -1e6, 1e6)?;
    within("balls", balls.len() as f64, 1.0, 1e4)?;
    if speed == 0.0 {
        return Err(FrictionError::Standstill);
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
    let limits: f64 = contacts
        .iter()
        .flatten()
        .map(|c| c.friction_limit)
        .fold(0.0, f64::max);
    let tolerance = 4e-14 * limits;
    let none = Vector3::zeros();
    let minimum_at = |start: &[Vector3<f64>], rest_spin: f64| {
        minimise_chain(start, tolerance, |j, y| {
            planar::dissipation(&contacts[j], &none, y, rest_spin)
        })
    };
    let mut points = vec![Vector3::new(0.5, 0.7, 0.0); contacts.len()];
    let mut rest_spin = 1.0;
    let mut iterations = 0;
    let mut solution = None;
    for _ in 0..STAGES {
        rest_spin *= 0.1;
        let stage = minimum_at(&points, rest_spin);
        iterations += stage.iterations;
        points.clone_from(&stage.points);
        solution = Some((stage, rest_spin));
        if contacts
            .iter()
            .zip(&points)
            .all(|(c, y)| planar::all_move(c, y, rest_spin))
        {
            let exact = minimum_at(&points, 0.0);
            iterations += exact.iterations;
            if exact.residual <= 1e-10 * limits {
                solution = Some((exact, 0.0));
                break;
            }
        }
    }
    let Some((mut solution, rest_spin)) = solution else {
        return Err(FrictionError::NotConverged {
            residual: f64::INFINITY,
        });
    };

    // The friction coefficient scales groove forces and contact forces alike, so the moments carry `ball_friction` alone.
    let mut residual = solution.residual;
    let mut rest_spin = rest_spin;
    if ball_friction > 0.0 {
        let accept = f64::max(1e-10 * limits, 2.0 * residual);
        let raised = raise_ball_friction(
            &contacts,
            &solution,
            ball_friction,
            rest_spin,
            tolerance,
            accept,
        );
        if let Some(raised) = raised {
            iterations += raised.iterations;
            residual = raised.residual;
            solution = raised;
        } else {
            // Near the switch to two-point contact: raise the coefficient where the power is smooth, then sharpen it.
            let smooth = minimum_at(&vec![Vector3::new(0.5, 0.7, 0.0); contacts.len()], 0.1);
            let mut path = raise_ball_friction(
                &contacts,
                &smooth,
                ball_friction,
                0.1,
                tolerance,
                1e-8 * limits,
            );
            let mut spin = 0.1;
            while let (Some(here), true) = (&path, spin > 1.0001e-8) {
                spin = f64::max(spin * 0.5, 1e-8);
                let next = solve_full_system(&contacts, here, ball_friction, spin, tolerance);
                iterations += next.iterations;
                residual = next.residual;
                let accept = f64::max(1e-8, 1e-14 / spin) * limits;
                path = (next.residual <= accept).then_some(next);
            }
            match path {
                Some(path) => solution = path,
                None => {
                    return Err(FrictionError::NotConverged {
                        residual: friction * residual.max(accept),
                    });
                }
            }
            rest_spin = spin;
        }
    }
    if residual.is_nan() || residual > 1e-6 * limits {
        return Err(FrictionError::NotConverged {
            residual: friction * residual,
        });
    }

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
