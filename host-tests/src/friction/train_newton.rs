//! Trains of balls with unilateral contacts: the engine of [`super::chain`] and [`super::ball_screw_train`].

use nalgebra::{DMatrix, DVector, SMatrix, SVector};

use super::isotonic::pool_adjacent_violators;
use super::newton::{Local, STAGES};
use crate::error::ReferenceError;

pub(crate) trait Train<const N: usize> {
    /// Number of balls.
    fn balls(&self) -> usize;
    fn start(&self, ball: usize) -> SVector<f64, N>;
    fn local(&self, ball: usize, y: &SVector<f64, N>, rest_spin: f64) -> Local<N>;
    fn moves(&self, ball: usize, y: &SVector<f64, N>, rest_spin: f64) -> bool;
    /// Slip between two touching balls, two components, from the unknowns of the rear and of the front ball.
    fn slip(&self) -> [SMatrix<f64, 2, N>; 2];
    /// Friction coefficient between balls, per unit of the multiplier of `v_j <= v_(j+1)`.
    fn ball_friction(&self) -> f64;
    fn largest(&self) -> f64;
}

/// Solves a train: the convex problem without friction between balls, then with it.
///
/// Returns motions, multipliers and residual, and the smoothing they belong to.
pub(crate) fn solve_train<const N: usize>(
    train: &impl Train<N>,
) -> Result<(TrainMinimum<N>, f64), ReferenceError> {
    let cold: Vec<_> = (0..train.balls()).map(|j| train.start(j)).collect();
    let tolerance = 4e-14 * train.largest();
    let minimum_at = |start: &[SVector<f64, N>], rest_spin: f64| {
        minimise_train(start, tolerance, |j, y| train.local(j, y, rest_spin))
    };
    let mut rest_spin = 0.1;
    let mut iterations = 0;
    let mut stages = 1;
    let mut points = cold.clone();
    let solution = loop {
        let stage = minimum_at(&points, rest_spin);
        iterations += stage.iterations;
        points.clone_from(&stage.points);
        if points
            .iter()
            .enumerate()
            .all(|(j, y)| train.moves(j, y, rest_spin))
        {
            let exact = minimum_at(&points, 0.0);
            iterations += exact.iterations;
            if exact.residual <= 1e-10 * train.largest() {
                rest_spin = 0.0;
                break exact;
            }
        }
        if stages == STAGES {
            break stage;
        }
        stages += 1;
        rest_spin *= 0.1;
    };
    let mut solution = solution;
    if train.ball_friction() > 0.0 {
        let accept = f64::max(1e-10 * train.largest(), 2.0 * solution.residual);
        if let Some(raised) = raise_ball_friction(train, &solution, rest_spin, tolerance, accept) {
            solution = raised;
        } else {
            // Near the switch to two-point contact: raise the coefficient where the power is smooth, then sharpen it.
            let smooth = minimum_at(&cold, 0.1);
            let mut path =
                raise_ball_friction(train, &smooth, 0.1, tolerance, 1e-8 * train.largest());
            let mut spin = 0.1;
            let mut residual = f64::INFINITY;
            while let (Some(here), true) = (&path, spin > 1.0001e-8) {
                spin = f64::max(spin * 0.5, 1e-8);
                let next = solve_full_system(train, here, train.ball_friction(), spin, tolerance);
                iterations += next.iterations;
                residual = next.residual;
                let accept = f64::max(1e-8, 1e-14 / spin) * train.largest();
                path = (next.residual <= accept).then_some(next);
            }
            solution = path.ok_or(ReferenceError::unbalanced(residual))?;
            rest_spin = spin;
        }
    }
    if solution.residual.is_nan() || solution.residual > 1e-6 * train.largest() {
        return Err(ReferenceError::unbalanced(solution.residual));
    }
    solution.iterations += iterations;
    Ok((solution, rest_spin))
}

#[derive(Clone)]
pub(crate) struct TrainMinimum<const N: usize> {
    pub points: Vec<SVector<f64, N>>,
    pub multipliers: Vec<f64>,
    pub residual: f64,
    pub iterations: usize,
}

/// Minimises `sum_j f_j(y_j)` under `y_j[0] <= y_(j+1)[0]` by sequential quadratic programming: the quadratic model's exact solution is
/// `pool_adjacent_violators` on the Newton speeds with the compliances `(H^-1)_00`; each step is shortened until the total falls.
fn minimise_train<const N: usize>(
    start: &[SVector<f64, N>],
    tolerance: f64,
    f: impl Fn(usize, &SVector<f64, N>) -> Local<N>,
) -> TrainMinimum<N> {
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
    let mut result = TrainMinimum {
        points: points.clone(),
        multipliers: vec![0.0; n.saturating_sub(1)],
        residual: f64::INFINITY,
        iterations: 0,
    };
    let mut stalled = 0;
    while result.iterations < 200 && stalled < 4 {
        result.iterations += 1;
        let Some(step) = quadratic_step(&points, &locals, &mut shift) else {
            return result;
        };
        if step.residual < result.residual {
            result.points.clone_from(&points);
            result.multipliers.clone_from(&step.multipliers);
            result.residual = step.residual;
            stalled = 0;
        } else {
            stalled += 1;
        }
        if step.residual <= tolerance {
            break;
        }
        if let Some(there) = shortened(&points, &locals, &step, evaluate) {
            if there.falls {
                stalled = 0;
            }
            (points, locals) = (there.points, there.locals);
            shift = (shift * 0.1).max(1e-14);
        } else {
            shift = (shift * 100.0).max(1e-12);
        }
        if shift > 1e3 {
            break;
        }
    }
    result
}

struct QuadraticStep<const N: usize> {
    directions: Vec<SVector<f64, N>>,
    multipliers: Vec<f64>,
    residual: f64,
    slope: f64,
}

fn quadratic_step<const N: usize>(
    points: &[SVector<f64, N>],
    locals: &[Local<N>],
    shift: &mut f64,
) -> Option<QuadraticStep<N>> {
    let n = points.len();
    let mut free = Vec::with_capacity(n);
    let mut compliance = Vec::with_capacity(n);
    let mut steps = Vec::with_capacity(n);
    for (y, local) in points.iter().zip(locals) {
        let mean = (local.hessian.trace() / N as f64).max(1e-300);
        let mut shifted = local.hessian + nalgebra::SMatrix::identity() * (*shift * mean);
        let factor = loop {
            if let Some(factor) = shifted.cholesky() {
                break factor;
            }
            *shift = (*shift * 100.0).max(1e-12);
            shifted = local.hessian + nalgebra::SMatrix::identity() * (*shift * mean);
            if *shift > 1e6 || !shift.is_finite() {
                return None;
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
    for (j, ((newton, column), local)) in steps.iter().zip(locals).enumerate() {
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
    Some(QuadraticStep {
        directions,
        multipliers,
        residual,
        slope,
    })
}

struct Reached<const N: usize> {
    points: Vec<SVector<f64, N>>,
    locals: Vec<Local<N>>,
    falls: bool,
}

/// The step, halved until the total falls or changes no more than by rounding; None where it never does.
fn shortened<const N: usize>(
    points: &[SVector<f64, N>],
    locals: &[Local<N>],
    step: &QuadraticStep<N>,
    evaluate: impl Fn(&[SVector<f64, N>]) -> Vec<Local<N>>,
) -> Option<Reached<N>> {
    let total: f64 = locals.iter().map(|l| l.value).sum();
    let rounding = 1e-13 * total.abs();
    let mut fraction = 1.0;
    while fraction > 1e-10 {
        let there: Vec<_> = points
            .iter()
            .zip(&step.directions)
            .map(|(y, d)| y + d * fraction)
            .collect();
        let new = evaluate(&there);
        let value: f64 = new.iter().map(|l| l.value).sum();
        let within_rounding = (value - total).abs() <= rounding;
        if value <= total + 1e-4 * fraction * step.slope || within_rounding {
            return Some(Reached {
                points: there,
                locals: new,
                falls: (value - total).abs() > rounding,
            });
        }
        fraction *= 0.5;
    }
    None
}

/// The full system at given motions and forces (unknowns: `N` per ball, then the contact forces), with the Jacobian. Friction between two
/// balls acts on each along the slip's derivative by its unknowns (virtual power). A contact is closed when its force minus `penalty` times
/// the speed of parting is positive.
fn full_system<const N: usize>(
    train: &impl Train<N>,
    locals: &[Local<N>],
    points: &[SVector<f64, N>],
    forces: &[f64],
    ball_friction: f64,
    penalty: f64,
) -> (DVector<f64>, DMatrix<f64>) {
    let n = points.len();
    let size = (N + 1) * n - 1;
    let mut residual = DVector::zeros(size);
    let mut jacobian = DMatrix::zeros(size, size);
    for (j, local) in locals.iter().enumerate() {
        residual.rows_mut(N * j, N).copy_from(&local.gradient);
        jacobian
            .view_mut((N * j, N * j), (N, N))
            .copy_from(&local.hessian);
    }
    let [of_rear, of_front] = train.slip();
    for (k, (&force, pair)) in forces.iter().zip(points.windows(2)).enumerate() {
        let (rear, front, unknown) = (N * k, N * k + N, N * n + k);
        residual[rear] += force;
        residual[front] -= force;
        jacobian[(rear, unknown)] += 1.0;
        jacobian[(front, unknown)] -= 1.0;
        let slip = of_rear * pair[0] + of_front * pair[1];
        let size = slip.norm();
        if size > 0.0 {
            let unit = slip / size;
            let across = (SMatrix::<f64, 2, 2>::identity() - unit * unit.transpose())
                * (ball_friction * force / size);
            for (at, map) in [(rear, of_rear), (front, of_front)] {
                let pull = map.transpose() * unit * ball_friction;
                for i in 0..N {
                    residual[at + i] += pull[i] * force;
                    jacobian[(at + i, unknown)] += pull[i];
                }
                for (other, by) in [(rear, of_rear), (front, of_front)] {
                    let mut block = jacobian.view_mut((at, other), (N, N));
                    block += map.transpose() * across * by;
                }
            }
        }
        let parting = pair[1][0] - pair[0][0];
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

fn solve_full_system<const N: usize>(
    train: &impl Train<N>,
    start: &TrainMinimum<N>,
    ball_friction: f64,
    rest_spin: f64,
    tolerance: f64,
) -> TrainMinimum<N> {
    let n = start.points.len();
    let penalty = train.largest();
    let system = |points: &[SVector<f64, N>], forces: &[f64]| {
        let locals: Vec<_> = points
            .iter()
            .enumerate()
            .map(|(j, y)| train.local(j, y, rest_spin))
            .collect();
        full_system(train, &locals, points, forces, ball_friction, penalty)
    };
    let mut points = start.points.clone();
    let mut forces = start.multipliers.clone();
    let (mut residual, mut jacobian) = system(&points, &forces);
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
                .map(|(j, y)| y - SVector::<f64, N>::from_fn(|i, _| step[N * j + i]) * fraction)
                .collect();
            let pushed: Vec<_> = forces
                .iter()
                .enumerate()
                .map(|(k, f)| f - fraction * step[N * n + k])
                .collect();
            let (new, slope) = system(&there, &pushed);
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
    // Rounding may leave a small negative force in an open contact.
    TrainMinimum {
        points,
        multipliers: forces.iter().map(|f| f.max(0.0)).collect(),
        residual: residual.amax(),
        iterations,
    }
}

/// Follows the solution of the full system while the friction between balls rises from nothing to the train's. A step of the
/// coefficient from which Newton's method does not converge is halved.
fn raise_ball_friction<const N: usize>(
    train: &impl Train<N>,
    start: &TrainMinimum<N>,
    rest_spin: f64,
    tolerance: f64,
    accept: f64,
) -> Option<TrainMinimum<N>> {
    let mut here = start.clone();
    let mut reached = 0.0;
    let mut stride = 1.0;
    while reached < 1.0 {
        let target = f64::min(reached + stride, 1.0);
        let mut next = solve_full_system(
            train,
            &here,
            target * train.ball_friction(),
            rest_spin,
            tolerance,
        );
        if next.residual <= accept {
            next.iterations += here.iterations;
            here = next;
            reached = target;
        } else {
            stride *= 0.5;
            if stride < 0.02 {
                return None;
            }
        }
    }
    Some(here)
}
