//! The law of one ball whose neighbours press on it, solved on a host and folded into constants: numbers of two knots around the load are
//! blended, and a ball's answer is three polynomials in the deviations of the two grooves at its position.

mod numbers;
mod row;

use super::folded::{FrictionInterval, holds, last_not_above, node_octaves};
use crate::error::{Error, attempt, in_range};
use crate::math;
use crate::ranges;
use crate::train::{IMPEDANCE_RANGE, LARGEST_GRIP};
use numbers::IMPEDANCES;
use row::STIFFENING;

pub(crate) use numbers::PowerSums;
pub use numbers::{
    BallNumbers, FreeMotion, LARGEST_WORK, NEIGHBOUR_KNOTS, NeighbourNumbers, POWERS, RUBBINGS,
    RubbedNode, SPEED_POWERS,
};
pub use row::{BallOfRow, NeighbourLaw, PressedTorques};

/// Largest friction of both neighbours of a ball that a law holds, over `mu W`.
const HELD_RUBBING: f32 = 0.45;

/// Least and largest `mu W` that count, N.
const SLIDING_LOADS: [f32; 2] = [1e-6, 1e5];

/// The law of one ball that its neighbours press on, for `NODES` friction coefficients: what `epas-design` folds and a scene evaluates.
///
/// Numbers ([`BallNumbers`]) are linear in the load `W = |F| + F_0` between knots, with the axial load `F` of the ball and the lift-off load
/// `F_0` of its preload; between two friction coefficients linear in their octaves. Below the first knot and above the last one impedance and
/// torque are in proportion to `W`.
///
/// Accuracy: that of the block's certificate. Cost: part of a step of [`UncagedBallScrew`](crate::UncagedBallScrew).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct BallLaw<const NODES: usize> {
    /// Nodes by rising friction coefficient.
    pub nodes: [BallNode; NODES],
    /// Largest deviations of the contact angles on the screw and in the nut for which the law holds, rad, above 0.
    pub deviations: [f32; 2],
    /// Axial load of one ball at which the preload's unloaded side lifts off, N, 0 to 1e7; 0 without a preload.
    pub lift_off: f32,
}

/// Constants of a row of balls beside their law.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct RowConstants {
    /// Friction of two balls that press over the force along the track: their friction coefficient over the cosine of the chord's angle.
    pub ball_friction: f32,
    /// Tangent of the chord's angle: outward force of two balls that press, over the force along the track.
    pub outward: f32,
    /// Force of two balls that press, over that along the track.
    pub normal: f32,
    /// Half the nominal speed against the nut, m per unit of nut speed.
    pub half_speed: f32,
}

impl<const NODES: usize> BallLaw<NODES> {
    /// Checks the law.
    pub const fn checked(&self) -> Result<(), Error> {
        const { assert!(NODES > 0) };
        let [screw, nut] = self.deviations;
        attempt!(in_range("deviations", screw, 1e-6, 1.0));
        attempt!(in_range("deviations", nut, 1e-6, 1.0));
        attempt!(in_range("lift_off", self.lift_off, 0.0, 1e7));
        let mut number = 0;
        while number < NODES {
            let node = &self.nodes[number];
            if number > 0 {
                let least = 1.01 * self.nodes[number - 1].friction;
                attempt!(in_range("friction", node.friction, least, 0.5));
            }
            attempt!(node.checked());
            number += 1;
        }
        Ok(())
    }

    /// Friction coefficients of the nodes.
    pub const fn frictions(&self) -> [f32; NODES] {
        let mut all = [0.0; NODES];
        let mut number = 0;
        while number < NODES {
            all[number] = self.nodes[number].friction;
            number += 1;
        }
        all
    }

    /// Least and largest friction coefficient.
    pub const fn friction_range(&self) -> (f32, f32) {
        (self.nodes[0].friction, self.nodes[NODES - 1].friction)
    }

    #[inline(always)]
    pub(crate) const fn holds(&self, friction: f32) -> bool {
        holds(self.friction_range(), friction)
    }

    /// The nodes between which a friction coefficient lies; beyond them impedance and torque are in proportion to it.
    pub const fn interval(&self, friction: f32) -> FrictionInterval {
        let frictions = self.frictions();
        FrictionInterval::among(&frictions, &node_octaves(&frictions), friction)
    }

    /// Load `W` of a ball, N, under an axial load, N, of either sign.
    #[inline(always)]
    pub const fn load_of(&self, axial_load: f32) -> f32 {
        axial_load.abs() + self.lift_off
    }

    /// Numbers of a ball under a load `W`, N, with a friction coefficient, in newtons and metres; `branch` 0 under a load that opposes the
    /// motion, 1 under one that assists it.
    #[inline(always)]
    pub fn numbers(&self, load: f32, branch: usize, friction: FrictionInterval) -> BallNumbers {
        self.per_sliding(load, branch, friction)
            .under(self.sliding(load, friction))
    }

    /// The same over `mu W`.
    #[inline(always)]
    pub fn per_sliding(&self, load: f32, branch: usize, friction: FrictionInterval) -> BallNumbers {
        self.between_nodes(friction, BallNumbers::towards, |node| {
            let (below, above, fraction) = around(&node.branches[branch & 1], load);
            below.towards(above, fraction)
        })
    }

    /// What holds at a friction coefficient, from what holds at the nodes below and above it.
    #[inline(always)]
    fn between_nodes<T>(
        &self,
        friction: FrictionInterval,
        towards: impl Fn(&T, &T, f32) -> T,
        at: impl Fn(&BallNode) -> T,
    ) -> T {
        let below = at(&self.nodes[friction.node() % NODES]);
        if NODES == 1 {
            return below;
        }
        let above = at(&self.nodes[(friction.node() + 1) % NODES]);
        towards(&below, &above, friction.fraction())
    }

    /// A ball under a load `W`, N, with deviations of both grooves, each over its largest, and its friction torque alone, N m; `part`, above 0 to 1: its
    /// part of load and preload on the run-in between return and load.
    ///
    /// With a preload it is the ball under the whole load `W`, of which every contact carries `part`: friction of sliding falls with it, that of spin
    /// with its power of 4/3; the torque is taken with 7/6 between them.
    #[inline(always)]
    pub fn ball(
        &self,
        load: f32,
        branch: usize,
        friction: FrictionInterval,
        deviations: [f32; 2],
        part: f32,
    ) -> (BallOfRow, f32) {
        let (carried, factor) = if part == 1.0 {
            (load, 1.0)
        } else if self.lift_off > 0.0 {
            (load, math::sqrt(math::cbrt(part)))
        } else {
            (part * load, 1.0)
        };
        let motion = self.between_nodes(friction, FreeMotion::towards, |node| {
            let (below, above, fraction) = around(&node.branches[branch & 1], carried);
            below
                .at(deviations)
                .towards(&above.at(deviations), fraction)
        });
        let sliding = self.sliding(part * load, friction);
        let ball = BallOfRow {
            speed: motion.speed,
            impedance: motion.impedance,
            sliding,
            deviations,
        };
        (ball, factor * motion.torque * sliding)
    }

    /// Whether a load `W`, N, is not above the largest for which the law was folded.
    #[inline(always)]
    #[must_use]
    pub fn holds_load(&self, load: f32) -> bool {
        load <= self.nodes[0].branches[0][KNOTS - 1].load
    }

    /// Whether the forces between balls are accurate under a load `W`, N.
    #[inline]
    #[must_use]
    pub fn holds_forces(&self, load: f32, branch: usize, friction: FrictionInterval) -> bool {
        self.holds_forces_within([load; 2], branch, friction)
    }

    /// The same under every load from the larger to the lesser of two.
    #[inline(always)]
    pub(crate) fn holds_forces_within(
        &self,
        [larger, lesser]: [f32; 2],
        branch: usize,
        friction: FrictionInterval,
    ) -> bool {
        let node = &self.nodes[friction.node() % NODES];
        let knots = &node.branches[branch & 1];
        let knot = |load| {
            last_not_above::<KNOTS>(load, |knot| knots[knot % KNOTS].load) as u32 % KNOTS as u32
        };
        let (last, first) = (knot(larger), knot(lesser));
        // Bits of the knots from the first to the last.
        let beyond = if last < first {
            0
        } else {
            u32::MAX << 1 << last
        };
        node.unheld[branch & 1] & (u32::MAX << first) & !beyond == 0
    }

    /// Changes by neighbours in the balls of a row under a load `W`, N, with these numbers of [`Self::per_sliding`].
    #[inline(always)]
    pub fn neighbours(
        &self,
        load: f32,
        branch: usize,
        friction: FrictionInterval,
        numbers: &BallNumbers,
        row: RowConstants,
    ) -> NeighbourLaw {
        let found = self.between_nodes(friction, NeighbourNumbers::towards, |node| {
            let (below, above, fraction) = around(&node.neighbours[branch & 1], load);
            below.towards(above, fraction)
        });
        let outward = friction.friction() * row.outward;
        let found = NeighbourNumbers {
            outward: found.outward.map(|number| outward * number),
            outward_torque: outward * found.outward_torque,
            ..found
        };
        NeighbourLaw::new(
            found,
            row.ball_friction,
            numbers.held_speed(),
            numbers.slope,
            row.half_speed * numbers.work,
        )
    }

    /// `mu W` of a ball, N, under a load `W`, N, within 1e-6 to 1e5.
    #[inline(always)]
    pub fn sliding(&self, load: f32, friction: FrictionInterval) -> f32 {
        let [least, most] = SLIDING_LOADS;
        let sliding = friction.friction() * load;
        if sliding > most {
            most
        } else if sliding > least {
            sliding
        } else {
            least
        }
    }

    /// Whether the torque is accurate by the friction of both neighbours on the ball that is rubbed most, N, and its `mu W`, N: up to 0.45 of it.
    #[inline(always)]
    #[must_use]
    pub fn holds_rubbing(&self, rubbing: f32, sliding: f32) -> bool {
        rubbing <= HELD_RUBBING * sliding
    }
}

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

impl BallNode {
    const fn checked(&self) -> Result<(), Error> {
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

/// The numbers of the knots on both sides of a load, and its fraction of the distance between them, 0 to 1.
#[inline(always)]
fn around<T, const K: usize>(knots: &[Knot<T>; K], load: f32) -> (&T, &T, f32) {
    let knot = last_not_above::<K>(load, |knot| knots[knot % K].load);
    let below = &knots[knot % K];
    let fraction = (load - below.load) * below.per_width;
    (
        &below.numbers,
        &knots[(knot + 1) % K].numbers,
        if fraction > 0.0 { fraction } else { 0.0 },
    )
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

/// A train takes what a ball may have, with what friction between balls makes of it.
const _: () = assert!(
    STIFFENING[0] / (1.0 + LARGEST_GRIP) * IMPEDANCES.minimum * SLIDING_LOADS[0]
        >= IMPEDANCE_RANGE.0
        && STIFFENING[1] / (1.0 - LARGEST_GRIP) * IMPEDANCES.maximum * SLIDING_LOADS[1]
            <= IMPEDANCE_RANGE.1
);
