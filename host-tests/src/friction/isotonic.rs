//! Speeds and contact forces of a row of balls that push each other, where each ball answers a force in proportion: a ball that
//! is pushed by `F` from behind and by `F'` from ahead moves at `free + compliance (F - F')`.
//!
//! It is the regression of the free speeds by a rising sequence, weighted by `1/compliance`. Three ways that share nothing:
//! pooling, the min-max formula, and trial of every set of contacts.

use nalgebra::{DMatrix, DVector};

/// Solves `min sum (x_j - free_j)^2/(2 compliance_j)` under `x_j <= x_(j+1)`: neighbours that break the condition are joined into one
/// cluster with their weighted mean speed, until none does (pool adjacent violators).
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

/// The same by the min-max formula of isotonic regression, `x_j = max_(i <= j) min_(k >= j) mean(i..k)`, in which nothing is
/// joined and no order matters: the reference for long chains. Takes `n^3` operations.
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
