//! The law of one ball, solved on a host and folded into constants: friction torque over its load.
//!
//! The control interrupt evaluates it: one logarithm, one search among eight parts, one cubic. Nothing is solved and nothing settles.

mod curve;
mod friction;

use crate::error::{Error, attempt, in_range};
use crate::ranges;

pub use curve::{LoadCurve, PARTS, octaves};
pub use friction::FrictionInterval;
pub(crate) use friction::{holds, node_octaves};

/// The curves for one friction coefficient.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct FrictionNode {
    /// Friction coefficient of ball and groove, 1e-6 to 0.5.
    pub friction: f32,
    /// Friction torque over load and friction coefficient, m, under a load that opposes the motion and under one that assists it.
    pub curves: [LoadCurve; 2],
    /// By how many octaves the load at which a contact begins to carry is higher at the next node's friction coefficient, of both curves, -30 to
    /// 30; 0 of the last node.
    pub shift: [f32; 2],
}

/// Friction torque of one ball over its load, for `NODES` friction coefficients: what `epas-design` folds and a scene evaluates.
///
/// ```text
/// T = mu W [(1 - t) c_k(x - t d w) + t c_(k+1)(x + (1 - t) d w)],    W = |F| + F_0,    x = octaves of W
/// ```
///
/// with the axial load `F` of the ball, the lift-off load `F_0` of its preload, the curves `c` of the two nodes around the friction coefficient
/// `mu`, its fraction `t` of the distance between them (0 to 1, by octaves), and the shift `d` that aligns the loads at which a contact begins to carry. Lift-off of a preload does not depend on friction: `w` rises from
/// 0 there to 1 an octave above it; without a preload it is 1.
/// Below the least load the torque is in proportion to `W`.
///
/// Accuracy: that of the block's certificate. Cost: part of a step of [`CagedBallScrew`](crate::CagedBallScrew).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct LoadLaw<const NODES: usize> {
    /// Nodes by rising friction coefficient.
    pub nodes: [FrictionNode; NODES],
    /// Least and largest [`octaves`] of `W`.
    pub ends: [f32; 2],
    /// Axial load of one ball at which the preload's unloaded side lifts off, N, 0 to 1e7; 0 without a preload.
    pub lift_off: f32,
    /// Octaves of `W` from which on loads are shifted between nodes: those of lift-off, 1 to 254; 1 without a preload.
    pub shifted_from: f32,
}

impl<const NODES: usize> LoadLaw<NODES> {
    /// Refuses numbers that are no law.
    ///
    /// # Errors
    /// [`Error`] naming `friction`, `starts`, `cubics`, `shift`, `ends`, `lift_off` or `shifted_from`.
    pub(crate) const fn checked(self) -> Result<Self, Error> {
        const { assert!(NODES > 0) };
        let [least, most] = self.ends;
        attempt!(in_range("ends", least, 1.0, 254.0));
        attempt!(in_range("ends", most, least, 254.0));
        attempt!(in_range("lift_off", self.lift_off, 0.0, 1e7));
        attempt!(in_range("shifted_from", self.shifted_from, 1.0, 254.0));
        let mut number = 0;
        while number < NODES {
            let FrictionNode {
                friction,
                curves: [drive, backdrive],
                shift: [forward, backward],
            } = self.nodes[number];
            attempt!(ranges::FRICTION_OF_A_ROW.checked("friction", friction));
            if number > 0 {
                let least = 1.01 * self.nodes[number - 1].friction;
                attempt!(in_range("friction", friction, least, 0.5));
            }
            attempt!(drive.checked());
            attempt!(backdrive.checked());
            attempt!(in_range("shift", forward, -30.0, 30.0));
            attempt!(in_range("shift", backward, -30.0, 30.0));
            number += 1;
        }
        Ok(self)
    }

    /// Least and largest friction coefficient.
    #[must_use]
    pub const fn friction_range(&self) -> (f32, f32) {
        (self.nodes[0].friction, self.nodes[NODES - 1].friction)
    }

    /// Whether a friction coefficient is one of those that the law is folded for.
    #[inline(always)]
    pub(crate) const fn holds(&self, friction: f32) -> bool {
        holds(self.friction_range(), friction)
    }

    /// Friction coefficients of the nodes.
    const fn frictions(&self) -> [f32; NODES] {
        let mut all = [0.0; NODES];
        let mut number = 0;
        while number < NODES {
            all[number] = self.nodes[number].friction;
            number += 1;
        }
        all
    }

    /// The [`octaves`] of the nodes' friction coefficients, for [`Self::interval`].
    pub(crate) const fn node_octaves(&self) -> [f32; NODES] {
        node_octaves(&self.frictions())
    }

    /// The nodes between which a friction coefficient lies. Beyond the outermost nodes the torque is in proportion to it.
    #[inline(always)]
    pub(crate) const fn interval(
        &self,
        friction: f32,
        node_octaves: &[f32; NODES],
    ) -> FrictionInterval {
        FrictionInterval::among(&self.frictions(), node_octaves, friction)
    }

    /// Friction torque of a ball over its load `W`, m, whose octaves these are, within the ends; `branch` 0 under a load that opposes the
    /// motion, 1 under one that assists it. Never negative.
    #[inline(always)]
    pub(crate) const fn torque_over_load(
        &self,
        octaves: f32,
        branch: usize,
        interval: FrictionInterval,
    ) -> f32 {
        let below = &self.nodes[interval.node as usize % NODES];
        let value = if NODES == 1 {
            below.curves[branch & 1].at(octaves)
        } else {
            let above = &self.nodes[(interval.node as usize + 1) % NODES];
            let shift = below.shift[branch & 1] * shifted_part(octaves - self.shifted_from);
            let low = below.curves[branch & 1].at(octaves - interval.fraction * shift);
            let high = above.curves[branch & 1].at(octaves + (1.0 - interval.fraction) * shift);
            low + interval.fraction * (high - low)
        };
        if value > 0.0 {
            interval.friction * value
        } else {
            0.0
        }
    }
}

/// Part of the shift so many octaves above the load from which on there is one.
#[inline(always)]
#[must_use]
pub const fn shifted_part(above: f32) -> f32 {
    if above > 1.0 {
        1.0
    } else if above > 0.0 {
        above
    } else {
        0.0
    }
}

#[cfg(test)]
mod tests {
    use super::curve::tests::curve;
    use super::*;

    fn law() -> LoadLaw<2> {
        let node = |friction, value| FrictionNode {
            friction,
            curves: [curve([value; 4]); 2],
            shift: [0.0; 2],
        };
        LoadLaw {
            nodes: [node(0.05, 1.0), node(0.1, 2.0)],
            ends: [120.0, 128.0],
            lift_off: 0.0,
            shifted_from: 1.0,
        }
    }

    /// At a node the law is that node's; between two it lies between theirs; beyond them it is in proportion.
    #[test]
    fn friction_coefficients_lie_between_nodes() {
        let law = law().checked().unwrap();
        let over = |friction: f32| {
            let interval = law.interval(friction, &law.node_octaves());
            law.torque_over_load(120.0, 0, interval) / friction
        };
        assert_eq!(over(0.05), 1.0);
        assert_eq!(over(0.1), 2.0);
        assert_eq!(over(0.03), 1.0);
        assert_eq!(over(0.2), 2.0);
        let middle = over(0.071);
        assert!(middle > 1.4 && middle < 1.6, "{middle}");
        assert!(law.holds(0.05) && law.holds(0.1) && law.holds(0.071));
        assert!(!law.holds(0.0499) && !law.holds(0.1002));
    }

    #[test]
    fn what_is_no_law_is_refused() {
        let wrong = |change: fn(&mut LoadLaw<2>)| {
            let mut law = law();
            change(&mut law);
            law.checked().unwrap_err().field()
        };
        assert_eq!(wrong(|law| law.nodes[1].friction = 0.05), "friction");
        assert_eq!(wrong(|law| law.nodes[0].friction = f32::NAN), "friction");
        assert_eq!(wrong(|law| law.ends[1] = 119.0), "ends");
        assert_eq!(wrong(|law| law.lift_off = -1.0), "lift_off");
        assert_eq!(
            wrong(|law| law.nodes[1].curves[1].starts[2] = 121.0),
            "starts"
        );
        assert_eq!(
            wrong(|law| law.nodes[1].curves[0].cubics[3][0] = -1.0),
            "cubics"
        );
        assert_eq!(wrong(|law| law.nodes[0].shift[1] = f32::NAN), "shift");
    }
}
