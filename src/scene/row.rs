//! Sliding friction of a row of balls, whatever they run in.

use super::reversal::ReversalState;
use super::sliding::SlidingFriction;
use crate::error::Range;
use crate::ranges;
use crate::stored::{Port, Refusal, Stored};

/// Largest fading that counts: it bounds what friction near none makes of a quotient.
const LARGEST_FADING: f32 = 10.0;

/// Sliding friction of a row of balls, in the direction in which they go: torques of a screw, N m, or forces of a bearing, N.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct TrainFriction {
    /// Friction of the grooves, and of balls that rub against each other, not negative.
    pub(super) groove: f32,
    pub(super) ball: f32,
    /// Friction of the grooves where no ball presses on another, not negative.
    pub(super) free: f32,
    /// Groove friction forward and backward, each over that of the friction coefficient in the direction of the balls.
    pub(super) ratios: [f32; 2],
    /// What limits forward and backward still exceed this friction by, over it: see [`Self::continue_from`].
    pub(super) fading: [f32; 2],
    /// -1 where the balls go backward, else 1.
    pub(super) direction: f32,
    /// Load, preload counted, N.
    pub(super) load: f32,
    /// Pairs of balls that press on each other.
    pub(super) contacts: u8,
    /// Largest force between two balls, N.
    pub(super) largest_contact_force: f32,
}

/// What a row of balls puts out.
pub(super) struct RowOutputs {
    /// Friction of the grooves and between balls, with their sign.
    pub(super) groove: f32,
    pub(super) ball: f32,
    /// Pairs of balls that press on each other.
    pub(super) contacts: u8,
    /// Largest force between two balls, N.
    pub(super) largest_contact_force: f32,
}

impl TrainFriction {
    /// Limits of both directions.
    #[inline(always)]
    pub(super) fn friction(&self) -> SlidingFriction {
        let [forward, backward] = self.fading;
        SlidingFriction {
            forward: self.of(1.0) * (1.0 + forward),
            backward: self.of(-1.0) * (1.0 + backward),
            load: self.load,
        }
    }

    /// Sliding friction in the direction of a sign: groove friction times its ratio, plus ball friction; against the direction of the balls
    /// friction of the grooves alone, because balls that press would part.
    #[inline(always)]
    pub(super) fn of(&self, direction: f32) -> f32 {
        let [groove, ball] = self.parts(direction);
        groove + ball
    }

    /// Its parts from the grooves and from balls that rub.
    #[inline(always)]
    fn parts(&self, direction: f32) -> [f32; 2] {
        let ratio = of_direction(self.ratios, direction);
        if direction * self.direction < 0.0 {
            [ratio * self.free, 0.0]
        } else {
            [ratio * self.groove, self.ball]
        }
    }

    /// What the row puts out at a reversal state, friction with the sign of the factor.
    #[inline(always)]
    pub(super) fn outputs_at(&self, reversal: ReversalState) -> RowOutputs {
        let ReversalState {
            factor, carried, ..
        } = reversal;
        let [groove, ball] = self.parts(factor);
        let presses = factor * self.direction >= 0.0 && carried > 0.0;
        let factor = factor * (1.0 + of_direction(self.fading, factor));
        RowOutputs {
            groove: factor * groove,
            ball: factor * ball,
            contacts: if presses { self.contacts } else { 0 },
            largest_contact_force: if presses {
                carried * self.largest_contact_force
            } else {
                0.0
            },
        }
    }

    /// Takes over what the friction of the last tick leaves. Where balls turn round, limits that fall begin where they were, in proportion to
    /// the load, and fade by the whole friction with each half of the play that the balls go on; `travelled`: their travel over that half.
    #[inline(always)]
    pub(super) fn continue_from(&mut self, last: &Self, travelled: f32) {
        let excess = if self.direction == last.direction {
            last.fading
        } else {
            let (now, before) = (self.friction(), last.friction());
            let scale = self.load / last.load;
            let excess = |now: f32, before: f32| {
                let excess = before * scale / now - 1.0;
                if excess > LARGEST_FADING {
                    LARGEST_FADING
                } else {
                    excess
                }
            };
            [
                excess(now.forward, before.forward),
                excess(now.backward, before.backward),
            ]
        };
        self.fading = excess.map(|excess| not_negative(excess - travelled));
    }
}

/// The one of the numbers forward and backward that belongs to a sign.
#[inline(always)]
const fn of_direction([forward, backward]: [f32; 2], direction: f32) -> f32 {
    if direction < 0.0 { backward } else { forward }
}

/// 0 for a number below 0, and for what is no number.
#[inline(always)]
pub(super) const fn not_negative(number: f32) -> f32 {
    if number > 0.0 { number } else { 0.0 }
}

impl Stored for TrainFriction {
    const BYTES: usize = 10 * 4 + 1;

    fn exchange<P: Port>(&mut self, port: &mut P) -> Result<(), Refusal> {
        port.number("groove", &mut self.groove, ranges::STORED_FRICTION)?;
        port.number("ball", &mut self.ball, ranges::STORED_FRICTION)?;
        port.number("free", &mut self.free, ranges::STORED_FRICTION)?;
        port.numbers("ratios", &mut self.ratios, ranges::STORED_RATIOS)?;
        let fading = Range::new(0.0, LARGEST_FADING);
        port.numbers("fading", &mut self.fading, fading)?;
        port.number("direction", &mut self.direction, Range::new(-1.0, 1.0))?;
        port.number("load", &mut self.load, Range::new(0.0, 1e13))?;
        port.count("contacts", &mut self.contacts, u8::MAX)?;
        port.number(
            "largest_contact_force",
            &mut self.largest_contact_force,
            Range::new(0.0, 1e12),
        )
    }
}
