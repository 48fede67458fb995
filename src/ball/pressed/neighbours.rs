//! What its neighbours change in a ball that they press and rub on.

use super::numbers::{between, blended};
use crate::error::{Error, attempt, in_range};

/// Knots of a branch for what neighbours change.
pub const NEIGHBOUR_KNOTS: usize = 16;

/// Largest size of a number at a node.
const LARGEST_NUMBER: f32 = 1e3;

/// Friction of both neighbours over `mu W` at which a law has numbers, between which they are linear; zero without friction, and beyond the last
/// one in proportion to it.
pub const RUBBINGS: [f32; 3] = [0.08, 0.25, 0.7];

/// What neighbours change in a ball under one load: each a line `1, s, n` over the deviations of both grooves.
///
/// A ball that its neighbours rub on needs and loses more than alone at the same speed `v`; with the friction of both,
/// `m = mu_b (F_behind + F_ahead)/(mu W cos(b))`, and `A`, `H`, `L` linear between the nodes [`RUBBINGS`], zero without friction and beyond the last node in
/// proportion to it (`H` as there):
///
/// ```text
/// net push         P = P_alone + A(m) + H(m) (v - v_h) + g O
/// friction torque  T = T_alone + L(m) + t O,                      O = tan(b) (F_behind + F_ahead),   sin(b) = R_B/R_path
/// ```
///
/// with the mean free speed `v_h` over all deviations and the outward force `O` of neighbours on a curved track. `L` holds the ball's half of what is
/// lost between balls, too. Source: Lin 2019, eqs. (3.70) to (3.77); least squares over exact balls, without a printed formula.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct NeighbourNumbers {
    /// At the nodes.
    pub nodes: [RubbedNode; 3],
    /// `g` over `mu`.
    pub outward: [f32; 3],
    /// `t` over `mu`, m.
    pub outward_torque: f32,
}

/// What friction of the neighbours changes in a ball at a node, over `mu W`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct RubbedNode {
    /// `A`.
    pub push: [f32; 3],
    /// `H`.
    pub impedance: [f32; 3],
    /// `L`, m.
    pub torque: [f32; 3],
}

impl RubbedNode {
    pub(super) const NONE: Self = Self {
        push: [0.0; 3],
        impedance: [0.0; 3],
        torque: [0.0; 3],
    };

    #[inline(always)]
    fn towards(&self, other: &Self, fraction: f32) -> Self {
        Self {
            push: blended(&self.push, &other.push, fraction),
            impedance: blended(&self.impedance, &other.impedance, fraction),
            torque: blended(&self.torque, &other.torque, fraction),
        }
    }
}

impl NeighbourNumbers {
    /// A ball in which neighbours change nothing.
    pub const NONE: Self = Self {
        nodes: [RubbedNode::NONE; 3],
        outward: [0.0; 3],
        outward_torque: 0.0,
    };

    /// These numbers, interpolated towards others by a fraction, 0 to 1.
    #[inline(always)]
    pub(super) fn towards(&self, others: &Self, fraction: f32) -> Self {
        let [first, second, third] = &self.nodes;
        let [other_first, other_second, other_third] = &others.nodes;
        Self {
            nodes: [
                first.towards(other_first, fraction),
                second.towards(other_second, fraction),
                third.towards(other_third, fraction),
            ],
            outward: blended(&self.outward, &others.outward, fraction),
            outward_torque: between(self.outward_torque, others.outward_torque, fraction),
        }
    }

    /// Refuses numbers that are not finite and of the size of a ball's.
    pub(super) const fn checked(&self) -> Result<(), Error> {
        let mut node = 0;
        while node < 3 {
            attempt!(check("push", &self.nodes[node].push));
            attempt!(check("rubbed_impedance", &self.nodes[node].impedance));
            attempt!(check("rubbed_torque", &self.nodes[node].torque));
            node += 1;
        }
        attempt!(check("outward", &self.outward));
        attempt!(check("outward_torque", &[self.outward_torque]));
        Ok(())
    }
}

/// Refuses numbers beyond a size.
const fn check(field: &'static str, numbers: &[f32]) -> Result<(), Error> {
    let mut number = 0;
    while number < numbers.len() {
        attempt!(in_range(
            field,
            numbers[number],
            -LARGEST_NUMBER,
            LARGEST_NUMBER
        ));
        number += 1;
    }
    Ok(())
}
