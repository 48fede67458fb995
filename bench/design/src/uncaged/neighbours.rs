//! What neighbours change in a ball, at knots of its own, by least squares over the exact balls.
//!
//! Under each load the numbers are straight lines over the deviations and over friction between [`RUBBINGS`], zero without it; they are the
//! ones with the least squares of the errors over that friction. Along the loads they are linear between knots.

use epas_friction::ball::pressed::NEIGHBOUR_KNOTS;
use epas_friction::ball::pressed::RUBBINGS;
use nalgebra::{DMatrix, DVector};

use super::Column;
use super::ball::{BallSample, Neighbours, RubbedBall, line, powers};
use super::knots::Knots;

/// Powers `1, s, n` of a number.
const LINE: usize = 3;

/// Numbers at a node, and of all nodes.
const NODES: usize = RUBBINGS.len();
const PART: usize = NODES * LINE;

/// Friction over `mu W` below which errors of it count, not their share; and the weight of a ball in a corner of the box.
const LIGHT: f64 = 0.04;
const CORNER: f64 = 0.6;

/// Weight of a bend at a node beside the balls' errors, so that where no ball has an answer the straight line goes on; and of a number itself.
const BEND: f64 = 0.3;
const SIZE: f64 = 1e-4;

/// What neighbours change at a knot; see `NeighbourNumbers`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Numbers {
    pub push: [[f64; LINE]; NODES],
    pub impedance: [[f64; LINE]; NODES],
    pub torque: [[f64; LINE]; NODES],
    pub outward: [f64; LINE],
    pub outward_torque: f64,
}

const ALL: usize = 3 * PART + LINE + 1;

/// Knots with their loads, N, rising.
pub(super) fn fitted(samples: &[BallSample]) -> Vec<(f64, Numbers)> {
    let solved = samples
        .iter()
        .filter_map(|sample| Some((sample.load, sample.neighbours.as_ref()?)));
    let (loads, numbers): (Vec<f64>, Vec<[f64; ALL]>) = solved
        .filter(|(_, neighbours)| !neighbours.rubbed.is_empty())
        .map(|(load, neighbours)| (load, under_load(neighbours)))
        .unzip();
    // Lines count as their size at the middle of the box over all loads.
    let scale = |number: usize| {
        let middle = number / LINE * LINE;
        let squares: f64 = numbers.iter().map(|all| all[middle].powi(2)).sum();
        numbers.len() as f64 / squares.max(1e-30)
    };
    let columns: Vec<Column> = (0..ALL)
        .map(|number| Column {
            values: numbers.iter().map(|all| all[number]).collect(),
            weights: vec![scale(number); numbers.len()],
        })
        .collect();
    let knots = Knots::placed(&loads, &columns, NEIGHBOUR_KNOTS);
    let places = knots.places();
    let fitted: Vec<Vec<f64>> = columns
        .iter()
        .map(|column| knots.fitted(&places, column))
        .collect();
    let at = |knot: usize| Numbers::from(std::array::from_fn(|number| fitted[number][knot]));
    (0..knots.at.len())
        .map(|knot| (loads[knots.at[knot]], at(knot)))
        .collect()
}

impl From<[f64; ALL]> for Numbers {
    fn from(all: [f64; ALL]) -> Self {
        let line = |from: usize| std::array::from_fn(|power| all[from + power]);
        let part = |part: usize| std::array::from_fn(|node| line(part * PART + node * LINE));
        Self {
            push: part(0),
            impedance: part(1),
            torque: part(2),
            outward: line(3 * PART),
            outward_torque: all[ALL - 1],
        }
    }
}

fn under_load(neighbours: &Neighbours) -> [f64; ALL] {
    let Neighbours { rubbed, outward } = neighbours;
    let push = least_squares(rubbed, LINE, |ball| ball.push);
    let torque = least_squares(rubbed, 0, |ball| ball.torque);
    let of = |value: fn(&(usize, f64, f64)) -> f64| {
        let values: Vec<(usize, f64)> = outward.iter().map(|at| (at.0, value(at))).collect();
        line(&values)
    };
    let mut all = [0.0; ALL];
    all[..2 * PART].copy_from_slice(&push);
    all[2 * PART..3 * PART].copy_from_slice(&torque);
    all[3 * PART..ALL - 1].copy_from_slice(&of(|at| at.1));
    all[ALL - 1] = of(|at| at.2)[0];
    all
}

/// Hat functions of the nodes at a friction over `mu W`, zero without it.
fn hats(rubbing: f64) -> [f64; NODES] {
    let nodes = RUBBINGS.map(f64::from);
    let above = nodes.iter().position(|node| rubbing < *node);
    let mut hats = [0.0; NODES];
    let above = above.unwrap_or(NODES - 1);
    let below = if above == 0 { 0.0 } else { nodes[above - 1] };
    let share = (rubbing - below) / (nodes[above] - below);
    hats[above] = share;
    if above > 0 {
        hats[above - 1] = 1.0 - share;
    }
    hats
}

/// Lines at the nodes with the least squares of the errors over the friction, followed by what changes in proportion to the speed beyond the held
/// one: so many first powers of the deviations.
fn least_squares(
    balls: &[RubbedBall],
    by_speed: usize,
    value: impl Fn(&RubbedBall) -> f64,
) -> Vec<f64> {
    let furthest = balls
        .iter()
        .map(|ball| ball.shift.abs())
        .fold(1e-9, f64::max);
    let parts = [(0, LINE), (PART, by_speed)];
    let count = PART + NODES * by_speed;
    let bends = (NODES - 1) * (LINE + by_speed);
    let mut matrix = DMatrix::zeros(balls.len() + count + bends, count);
    let mut right = DVector::zeros(matrix.nrows());
    for (row, ball) in balls.iter().enumerate() {
        let deviations = &powers(ball.point)[..LINE];
        let corner = deviations[1].abs() + deviations[2].abs() > 1.5;
        let weight = if corner { CORNER } else { 1.0 } / (ball.rubbing + LIGHT);
        for ((from, terms), speed) in parts.into_iter().zip([1.0, ball.shift / furthest]) {
            for (node, hat) in hats(ball.rubbing).into_iter().enumerate() {
                for (power, deviation) in deviations.iter().take(terms).enumerate() {
                    let column = from + node * terms + power;
                    matrix[(row, column)] = weight * speed * hat * deviation;
                }
            }
        }
        right[row] = weight * value(ball);
    }
    for number in 0..count {
        matrix[(balls.len() + number, number)] = SIZE;
    }
    let nodes = RUBBINGS.map(f64::from);
    let mut row = balls.len() + count;
    for (from, terms) in parts {
        for (node, power) in (1..NODES).flat_map(|node| (0..terms).map(move |power| (node, power)))
        {
            let below = if node > 1 { nodes[node - 2] } else { 0.0 };
            let [before, after] = [nodes[node - 1] - below, nodes[node] - nodes[node - 1]];
            let column = |node: usize| from + node * terms + power;
            matrix[(row, column(node))] = BEND / after;
            matrix[(row, column(node - 1))] = -BEND * (1.0 / after + 1.0 / before);
            if node > 1 {
                matrix[(row, column(node - 2))] = BEND / before;
            }
            row += 1;
        }
    }
    let solved = matrix.svd(true, true).solve(&right, 1e-12);
    let mut found: Vec<f64> = solved.map_or_else(|_| vec![0.0; count], |all| all.as_slice().into());
    for number in &mut found[PART..] {
        *number /= furthest;
    }
    found
}
