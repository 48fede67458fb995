//! What the engineer sets for a caged screw.

use crate::ball::folded::LoadLaw;
use crate::scene::contract::Limits;

/// What the engineer sets for a caged screw; unchecked.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct CagedBallScrewConfiguration<const NODES: usize = 1> {
    /// Law of one ball.
    pub law: LoadLaw<NODES>,
    /// Friction coefficient of ball and groove before [`FrictionModel::set_friction`](crate::FrictionModel::set_friction), within the
    /// law's nodes.
    pub friction: f32,
    /// Advance of the nut per turn, m, 0 to 0.2.
    pub lead: f32,
    /// Number of balls that carry load, 1 to 1000.
    pub loaded_balls: u16,
    /// Nut speed over which friction changes its direction, rad/s, 1e-6 to 1e3: at this speed it has 71 % of its full value.
    pub reversal_speed: f32,
    /// Limits of inputs and outputs.
    pub limits: Limits,
}

impl<const NODES: usize> CagedBallScrewConfiguration<NODES> {
    /// The same for the node whose friction coefficient is nearest to one: a fifth of the constants and as exact as a fold for that coefficient alone.
    /// For constants too; without a number, the least node.
    #[must_use]
    pub const fn nearest(&self, friction: f32) -> CagedBallScrewConfiguration {
        const { assert!(NODES > 0) };
        let mut nearest = self.law.nodes[0];
        let mut number = 1;
        while number < NODES {
            let node = self.law.nodes[number];
            if (node.friction - friction).abs() < (nearest.friction - friction).abs() {
                nearest = node;
            }
            number += 1;
        }
        nearest.shift = [0.0; 2];
        let LoadLaw {
            ends,
            lift_off,
            shifted_from,
            ..
        } = self.law;
        CagedBallScrewConfiguration {
            law: LoadLaw {
                nodes: [nearest],
                ends,
                lift_off,
                shifted_from,
            },
            friction: nearest.friction,
            lead: self.lead,
            loaded_balls: self.loaded_balls,
            reversal_speed: self.reversal_speed,
            limits: self.limits,
        }
    }
}
