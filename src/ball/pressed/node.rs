//! The law of one ball for one friction coefficient: knots over the load.

use super::numbers::{BallNumbers, FreeMotion};
use crate::error::{Error, attempt, in_range};
use crate::ranges;

/// Knots of a branch.
pub const KNOTS: usize = 32;

/// A load with what a ball does under it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct BallKnot {
    /// Load `W` of the ball, N, rising from knot to knot.
    pub load: f32,
    /// 1 over the distance to the next knot, 1/N; 0 of the last one.
    pub per_width: f32,
    /// What a ball does.
    pub numbers: BallNumbers,
}

impl BallKnot {
    /// [`Self::per_width`] of a knot with this load, N, and that of the next one.
    #[must_use]
    pub const fn per_width(load: f32, next: f32) -> f32 {
        if next > load {
            1.0 / (next - load)
        } else {
            0.0
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
    /// A bit for each knot from which up to the next the forces between balls are not held, of both branches.
    pub unheld: [u32; 2],
}

/// The knots between which a load lies.
#[derive(Clone, Copy)]
pub(super) struct KnotInterval {
    /// The knot below the load.
    pub(super) knot: usize,
    /// Fraction of the distance to the next knot, 0 to 1.
    fraction: f32,
}

impl BallNode {
    /// The knot below a load, and the load's fraction of the distance to the next knot, 0 to 1.
    #[inline(always)]
    pub(super) fn interval(&self, branch: usize, load: f32) -> KnotInterval {
        let knots = &self.branches[branch & 1];
        // Loads are not negative: integers compare their bits.
        let bits = load.to_bits().cast_signed();
        let mut knot = 0;
        let mut step = KNOTS / 2;
        while step > 0 {
            // The mask tells the compiler what the halving ensures.
            if bits >= knots[(knot + step) % KNOTS].load.to_bits().cast_signed() {
                knot += step;
            }
            step /= 2;
        }
        let below = &knots[knot % KNOTS];
        let fraction = (load - below.load) * below.per_width;
        KnotInterval {
            knot,
            fraction: if fraction > 0.0 { fraction } else { 0.0 },
        }
    }

    /// What a ball does under a load, over `mu W`.
    #[inline(always)]
    pub(super) fn motion(&self, branch: usize, load: f32, deviations: [f32; 2]) -> FreeMotion {
        let knots = &self.branches[branch & 1];
        let KnotInterval { knot, fraction } = self.interval(branch, load);
        let [below, above] =
            [knot, knot + 1].map(|knot| knots[knot % KNOTS].numbers.at(deviations));
        below.towards(above, fraction)
    }

    /// Numbers within an interval.
    #[inline(always)]
    pub(super) fn numbers(&self, branch: usize, interval: KnotInterval) -> BallNumbers {
        let knots = &self.branches[branch & 1];
        let below = &knots[interval.knot % KNOTS].numbers;
        let above = &knots[(interval.knot + 1) % KNOTS].numbers;
        below.towards(above, interval.fraction)
    }

    /// Refuses numbers that are no law.
    pub(super) const fn checked(&self) -> Result<(), Error> {
        attempt!(ranges::FRICTION_OF_A_ROW.checked("friction", self.friction));
        let mut branch = 0;
        while branch < 2 {
            let knots = &self.branches[branch];
            let mut number = 0;
            while number < KNOTS {
                let BallKnot {
                    load,
                    per_width,
                    numbers,
                } = knots[number];
                attempt!(in_range("load", load, 1e-6, 1e7));
                attempt!(numbers.checked());
                let width = if number + 1 < KNOTS {
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
            branch += 1;
        }
        Ok(())
    }
}
