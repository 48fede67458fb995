//! Friction under a coefficient that changes in every tick: between laws for three coefficients.

use crate::ball::elastic::constants::BallConstants;
use crate::ball::elastic::load_law::{Grooved, LoadLaws, LoadRange};
use crate::ball::elastic::nominal::Grooving;

/// If the configuration's coefficient is within this share of the range from one end, the middle replaces that end as a
/// node: closer nodes lose digits.
///
/// The parabola's three weights add up to at most 2.6 in size with a node at a fifth of the range, and to 3.7 at the end that
/// the middle has replaced: by so much errors of the laws grow. At a fiftieth of the range it would be 25.
const APART: f32 = 0.2;

/// Range of the coefficients, over the largest one, from which on they are more than one: closer nodes would coincide, and friction
/// would be no number.
///
/// A coefficient that differs by 2 % changes the torque by 5.8 % at most more than in proportion: one that differs by this, by 0.03 %.
const SEVERAL: f32 = 1e-4;

/// Laws for two friction coefficients beside that of the configuration.
///
/// Friction torque over friction coefficient is a parabola of the coefficient through all three. It is no constant: with more
/// friction a ball is held off its seat, more of it spins. Beyond the outermost coefficients it stays as there.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(super) struct CoefficientLaws {
    /// For the first of the two, under a load that opposes the motion and under one that assists it; then for the second.
    laws: LoadLaws<4>,
    /// The three coefficients, that of the configuration first.
    nodes: [f32; 3],
    /// For each of them, 1 over its distances from the other two and from 0: `1/((m - m') (m - m'') m)`.
    weights: [f32; 3],
    /// Least and largest coefficient that the laws are made for.
    least: f32,
    largest: f32,
}

impl CoefficientLaws {
    /// Laws for coefficients between `least` and `largest`, beside those for `own`; none where there is one coefficient alone.
    pub(super) fn new(
        ball: &BallConstants,
        gap: f32,
        range: LoadRange,
        own: f32,
        (least, largest): (f32, f32),
    ) -> Option<Self> {
        let least = if least < own { least } else { own };
        let largest = if largest > own { largest } else { own };
        let span = largest - least;
        if !(span > SEVERAL * largest) {
            return None;
        }
        let middle = 0.5 * (least + largest);
        let others = if own - least < APART * span {
            [middle, largest]
        } else if largest - own < APART * span {
            [middle, least]
        } else {
            [least, largest]
        };
        let nodes = [own, others[0], others[1]];
        let [a, b, c] = nodes;
        let [second, third] = others.map(|friction| Grooving::new(ball, friction, gap));
        let grooved = [(second, 1.0), (second, -1.0), (third, 1.0), (third, -1.0)];
        let grooved = grooved.map(|(grooving, side)| Grooved { grooving, side });
        let mut laws = LoadLaws::NONE;
        laws.fold(ball, &grooved, range);
        Some(Self {
            laws,
            nodes,
            weights: [
                1.0 / ((a - b) * (a - c) * a),
                1.0 / ((b - a) * (b - c) * b),
                1.0 / ((c - a) * (c - b) * c),
            ],
            least,
            largest,
        })
    }

    /// Friction torque over contact force, m, under a load of a size, N, that opposes the motion, and under one that assists it,
    /// each with its friction coefficient; `first` has both ratios under the configuration's coefficient. Beside them, whether
    /// each is beyond the model's accuracy.
    #[inline(always)]
    pub(super) fn at(
        &self,
        range: LoadRange,
        load: f32,
        [opposed, assisted]: [f32; 2],
        first: [f32; 2],
    ) -> ([f32; 2], [bool; 2]) {
        let place = self.laws.at(range, load);
        let [second, second_back, third, third_back] = place.ratios();
        let [drive, backdrive] = first;
        (
            [
                self.over(opposed, [drive, second, third]),
                self.over(assisted, [backdrive, second_back, third_back]),
            ],
            [
                place.beyond(0) || place.beyond(2),
                place.beyond(1) || place.beyond(3),
            ],
        )
    }

    /// Friction torque over contact force, m, with a friction coefficient, from that with each of the three.
    #[inline(always)]
    fn over(&self, friction: f32, [first, second, third]: [f32; 3]) -> f32 {
        let at = if friction > self.largest {
            self.largest
        } else if friction > self.least {
            friction
        } else {
            self.least
        };
        let [a, b, c] = self.nodes.map(|node| at - node);
        let [first_weight, second_weight, third_weight] = self.weights;
        let over = b * c * (first_weight * first)
            + a * c * (second_weight * second)
            + a * b * (third_weight * third);
        friction * over
    }
}
