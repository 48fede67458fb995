//! Sliding friction of a row of balls, whatever they run in.

use super::reversal::ReversalState;
use super::sliding::SlidingFriction;
use crate::error::Range;
use crate::ranges;
use crate::stored::{Port, Refusal, Stored};

/// Sliding friction of a row of balls, in the direction in which they go: torques of a screw, N m, or forces of a bearing, N.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct TrainFriction {
    /// Friction of the grooves, and of balls that rub against each other, not negative.
    pub(super) groove: f32,
    pub(super) ball: f32,
    /// Groove friction forward and backward, each over `groove`.
    pub(super) ratios: [f32; 2],
    /// Load, preload counted, N.
    pub(super) load: f32,
    /// Pairs of balls that press on each other.
    pub(super) contacts: u8,
    /// Largest force between two balls, N.
    pub(super) largest_contact_force: f32,
}

impl TrainFriction {
    /// Limits of both directions: groove friction times each direction's ratio, plus ball friction.
    #[inline(always)]
    pub(super) fn friction(&self) -> SlidingFriction {
        let [forward, backward] = self.ratios;
        SlidingFriction {
            forward: forward * self.groove + self.ball,
            backward: backward * self.groove + self.ball,
            load: self.load,
        }
    }

    /// Sliding friction in the direction of a sign.
    #[inline(always)]
    pub(super) const fn of(&self, direction: f32) -> f32 {
        self.ratio(direction) * self.groove + self.ball
    }

    /// Groove friction in the direction of a sign, over `groove`.
    #[inline(always)]
    const fn ratio(&self, direction: f32) -> f32 {
        let [forward, backward] = self.ratios;
        if direction < 0.0 { backward } else { forward }
    }

    /// Friction of the grooves and of the balls at a reversal state, with the sign of its factor.
    #[inline(always)]
    pub(super) fn outputs_at(&self, reversal: ReversalState) -> (f32, f32) {
        (
            reversal.factor * (self.ratio(reversal.factor) * self.groove),
            reversal.factor * self.ball,
        )
    }
}

impl Stored for TrainFriction {
    const BYTES: usize = 6 * 4 + 1;

    fn exchange<P: Port>(&mut self, port: &mut P) -> Result<(), Refusal> {
        port.number("groove", &mut self.groove, ranges::STORED_FRICTION)?;
        port.number("ball", &mut self.ball, ranges::STORED_FRICTION)?;
        port.numbers("ratios", &mut self.ratios, ranges::STORED_RATIOS)?;
        port.number("load", &mut self.load, Range::new(0.0, 1e13))?;
        port.count("contacts", &mut self.contacts, u8::MAX)?;
        port.number(
            "largest_contact_force",
            &mut self.largest_contact_force,
            Range::new(0.0, 1e12),
        )
    }
}
