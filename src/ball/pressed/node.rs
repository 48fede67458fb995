//! The law of one ball for one friction coefficient: knots over the load.

use super::numbers::{BallNumbers, FreeMotion, NEIGHBOUR_KNOTS, NeighbourNumbers};
use crate::ball::folded::last_not_above;
use crate::error::{Error, attempt, in_range};
use crate::ranges;

/// Knots of a branch.
pub const KNOTS: usize = 32;

/// A load with numbers of a ball under it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Knot<T> {
    /// Load `W` of the ball, N, rising from knot to knot.
    pub load: f32,
    /// 1 over the distance to the next knot, 1/N; 0 of the last one.
    pub per_width: f32,
    /// Numbers of a ball under the load.
    pub numbers: T,
}

/// Knot of a ball on its own.
pub type BallKnot = Knot<BallNumbers>;

/// Knot of the changes by neighbours.
pub type NeighbourKnot = Knot<NeighbourNumbers>;

impl<T: Copy> Knot<T> {
    pub(crate) const fn none(numbers: T) -> Self {
        Self {
            load: 0.0,
            per_width: 0.0,
            numbers,
        }
    }

    /// Numbers under a load, N, with the one of the next knot, or this one's of the last.
    #[must_use]
    pub const fn between(load: f32, next: f32, numbers: T) -> Self {
        Self {
            load,
            per_width: if next > load {
                1.0 / (next - load)
            } else {
                0.0
            },
            numbers,
        }
    }
}

/// The knots for one friction coefficient.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct BallNode {
    /// Friction coefficient of ball and groove, 1e-6 to 0.5.
    pub friction: f32,
    /// Under a load that opposes the motion, and under one that assists it.
    pub branches: [[BallKnot; KNOTS]; 2],
    /// Changes by neighbours, under the same.
    pub neighbours: [[NeighbourKnot; NEIGHBOUR_KNOTS]; 2],
    /// A bit for each knot from which up to the next the forces between balls are not accurate, of both branches.
    pub unheld: [u32; 2],
}

#[derive(Clone, Copy)]
pub(super) struct KnotInterval {
    pub(super) knot: usize,
    /// Fraction of the distance to the next knot, 0 to 1.
    fraction: f32,
}

impl KnotInterval {
    #[inline(always)]
    fn among<T, const K: usize>(knots: &[Knot<T>; K], load: f32) -> Self {
        let knot = last_not_above::<K>(load, |knot| knots[knot % K].load);
        let below = &knots[knot % K];
        let fraction = (load - below.load) * below.per_width;
        KnotInterval {
            knot,
            fraction: if fraction > 0.0 { fraction } else { 0.0 },
        }
    }
}

impl BallNode {
    #[inline(always)]
    pub(super) fn interval(&self, branch: usize, load: f32) -> KnotInterval {
        KnotInterval::among(&self.branches[branch & 1], load)
    }

    /// Changes by neighbours under a load, over `mu W`.
    #[inline(always)]
    pub(super) fn neighbours(&self, branch: usize, load: f32) -> NeighbourNumbers {
        let knots = &self.neighbours[branch & 1];
        let KnotInterval { knot, fraction } = KnotInterval::among(knots, load);
        let below = &knots[knot % NEIGHBOUR_KNOTS].numbers;
        let above = &knots[(knot + 1) % NEIGHBOUR_KNOTS].numbers;
        below.towards(above, fraction)
    }

    /// Motion of a ball under a load, over `mu W`.
    #[inline(always)]
    pub(super) fn motion(&self, branch: usize, load: f32, deviations: [f32; 2]) -> FreeMotion {
        let knots = &self.branches[branch & 1];
        let KnotInterval { knot, fraction } = self.interval(branch, load);
        let below = knots[knot % KNOTS].numbers.at(deviations);
        let above = knots[(knot + 1) % KNOTS].numbers.at(deviations);
        below.towards(above, fraction)
    }

    #[inline(always)]
    pub(super) fn numbers(&self, branch: usize, interval: KnotInterval) -> BallNumbers {
        let knots = &self.branches[branch & 1];
        let below = &knots[interval.knot % KNOTS].numbers;
        let above = &knots[(interval.knot + 1) % KNOTS].numbers;
        below.towards(above, interval.fraction)
    }

    pub(super) const fn checked(&self) -> Result<(), Error> {
        attempt!(ranges::FRICTION_OF_A_ROW.checked("friction", self.friction));
        let mut branch = 0;
        while branch < 2 {
            let knots = &self.branches[branch];
            attempt!(check_loads(knots));
            let mut number = 0;
            while number < KNOTS {
                attempt!(knots[number].numbers.checked());
                number += 1;
            }
            let knots = &self.neighbours[branch];
            attempt!(check_loads(knots));
            let mut number = 0;
            while number < NEIGHBOUR_KNOTS {
                attempt!(knots[number].numbers.checked());
                number += 1;
            }
            branch += 1;
        }
        Ok(())
    }
}

/// Refuses knots whose loads do not rise, or whose widths are not theirs.
const fn check_loads<T, const K: usize>(knots: &[Knot<T>; K]) -> Result<(), Error> {
    let mut number = 0;
    while number < K {
        let Knot {
            load, per_width, ..
        } = knots[number];
        attempt!(in_range("load", load, 1e-6, 1e7));
        let width = if number + 1 < K {
            knots[number + 1].load - load
        } else {
            0.0
        };
        attempt!(in_range("load", width, 0.0, 1e7));
        // A fraction of 1 at the next knot but for roundings; knots that are not needed repeat the last one's load.
        let fraction = width * per_width;
        let (least, most) = if width > 0.0 {
            (1.0 - 1e-5, 1.0 + 1e-5)
        } else {
            (0.0, 0.0)
        };
        attempt!(in_range("per_width", fraction, least, most));
        attempt!(in_range("per_width", per_width, 0.0, 1e9));
        number += 1;
    }
    Ok(())
}
