//! What becomes of the torque while something is missing: it is held, it fades, it comes back. It never jumps.

use super::FAST_TICK;
use super::page::Calibration;

/// How the torque is output.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ReactionParameters {
    /// Share of the friction torque that is output, 0 to 0.95.
    pub share: f32,
    /// Time for which a torque stays that is not renewed, s.
    pub hold: f32,
    /// Part of the torque by which it fades in a tick, and comes back.
    pub fade_step: f32,
    /// Largest change in a tick, N m.
    pub largest_step: f32,
}

impl ReactionParameters {
    /// Those of a calibration.
    #[must_use]
    pub const fn of(calibration: &Calibration) -> Self {
        Self {
            share: calibration.share,
            hold: calibration.torque_hold,
            fade_step: FAST_TICK / calibration.torque_fade,
            largest_step: FAST_TICK * calibration.torque_slew,
        }
    }
}

/// The torque output, with what it remembers from tick to tick.
///
/// A value at its limit (load, speed, friction) is no reason to take the torque away: that would drop it where it is largest.
/// Only where nobody knows which way the nut turns, or the friction task has stopped, the torque is held for a while and fades then.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reaction {
    /// Friction torque last known, N m.
    friction: f32,
    /// Time since it was known, s.
    missing: f32,
    /// Share of the torque that is output, 0 to 1.
    part: f32,
    /// The torque output, N m.
    torque: f32,
}

impl Reaction {
    /// Before the first tick: no torque, which comes in as it would after a gap.
    pub const START: Self = Self {
        friction: 0.0,
        missing: 0.0,
        part: 0.0,
        torque: 0.0,
    };

    /// Torque of this tick, N m. `friction`: the model's friction torque, `None` where it was not asked because the friction task
    /// has it; `known`: whether the angle was read and the friction task runs.
    #[inline]
    pub fn torque(
        &mut self,
        friction: Option<f32>,
        known: bool,
        parameters: &ReactionParameters,
    ) -> f32 {
        if let Some(friction) = friction {
            self.friction = friction;
        }
        if known {
            self.missing = 0.0;
            self.part = least(self.part + parameters.fade_step, 1.0);
        } else if self.missing < parameters.hold {
            self.missing += FAST_TICK;
        } else {
            self.part = most(self.part - parameters.fade_step, 0.0);
        }
        let wanted = parameters.share * self.part * self.friction;
        let largest = parameters.largest_step;
        self.torque += most(least(wanted - self.torque, largest), -largest);
        self.torque
    }
}

/// The smaller one. `f32::min` is a call of a C function on a Cortex-M.
#[inline(always)]
fn least(one: f32, other: f32) -> f32 {
    if one < other { one } else { other }
}

/// The larger one.
#[inline(always)]
fn most(one: f32, other: f32) -> f32 {
    if one > other { one } else { other }
}
