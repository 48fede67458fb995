//! A friction coefficient between those that a law is folded for.

use super::curve::octaves;

/// Change of a friction coefficient, over it, that counts as none: roundings of what computed it.
const SAME_FRICTION: f32 = 1e-3;

/// Whether a friction coefficient is within the least and the largest of some, but for roundings.
#[inline(always)]
pub(crate) const fn holds((least, largest): (f32, f32), friction: f32) -> bool {
    friction >= (1.0 - SAME_FRICTION) * least && friction <= (1.0 + SAME_FRICTION) * largest
}

/// The [`octaves`] of friction coefficients.
pub(crate) const fn node_octaves<const NODES: usize>(frictions: &[f32; NODES]) -> [f32; NODES] {
    let mut all = [0.0; NODES];
    let mut number = 0;
    while number < NODES {
        all[number] = octaves(frictions[number]);
        number += 1;
    }
    all
}

/// A friction coefficient, and the nodes of a law between which it lies.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct FrictionInterval {
    pub(super) friction: f32,
    /// The node below it, and its fraction of the distance to the next node by octaves, 0 to 1.
    pub(super) node: u32,
    pub(super) fraction: f32,
}

impl FrictionInterval {
    /// The friction coefficient.
    #[must_use]
    pub const fn friction(&self) -> f32 {
        self.friction
    }

    /// The interval that holds a friction coefficient, among nodes with these coefficients, rising, and their octaves.
    #[inline(always)]
    pub(crate) const fn among<const NODES: usize>(
        frictions: &[f32; NODES],
        octaves_of: &[f32; NODES],
        friction: f32,
    ) -> Self {
        let mut node = 0;
        let mut number = 1;
        while number + 1 < NODES {
            if friction > frictions[number] {
                node = number;
            }
            number += 1;
        }
        let fraction = if NODES == 1 || friction <= frictions[0] {
            0.0
        } else if friction < frictions[NODES - 1] {
            let [low, high] = [octaves_of[node % NODES], octaves_of[(node + 1) % NODES]];
            (octaves(friction) - low) / (high - low)
        } else {
            1.0
        };
        Self {
            friction,
            node: node as u32,
            fraction,
        }
    }

    /// The node below it.
    #[inline(always)]
    pub(crate) const fn node(&self) -> usize {
        self.node as usize
    }

    /// Its fraction of the distance to the next node.
    #[inline(always)]
    pub(crate) const fn fraction(&self) -> f32 {
        self.fraction
    }

    /// The same interval for another friction coefficient, until [`LoadLaw::interval`](super::LoadLaw) has found its own.
    pub(crate) const fn with_friction(self, friction: f32) -> Self {
        Self { friction, ..self }
    }
}
