//! Inputs, estimates and flags of an adaptation.

use crate::law::FrictionLevel;
use crate::scene::{Faults, Regime};

/// Inputs of an adaptation at a tick, after the model's step.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct AdaptationInputs {
    /// Torque of the motor to overcome friction, N m: its torque about the nut's axis, less that of the inertia, less `load_torque`. With the sign
    /// of the speed where friction opposes it.
    pub observed: f32,
    /// Friction torque of the model, N m: `friction_torque` of its outputs. This and the other torques up to `largest_torque`.
    pub modelled: f32,
    /// Lubricant drag in both, N m, which no level scales: [`FrictionModel::drag_torque`](crate::FrictionModel::drag_torque) of a scene with
    /// memory, 0 without one.
    pub lubricant_drag: f32,
    /// Levels of the model ([`FrictionModel::set_level`](crate::FrictionModel::set_level)), or [`FrictionLevel::ONE`].
    pub level: FrictionLevel,
    /// Nut speed, rad/s, up to the configuration's `largest_speed`.
    pub nut_speed: f32,
    /// Load torque that was taken off, N m: `load_torque` of the model's outputs.
    pub load_torque: f32,
    /// Regime of the model's outputs.
    pub regime: Regime,
    /// Flags of the model's outputs: with any of them the tick does not count.
    pub faults: Faults,
    /// Whether the motor was at its limit.
    pub saturated: bool,
}

/// Estimates of an adaptation.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Estimates {
    /// Friction over that of the model, in the positive direction, within the levels of the configuration (0.1 to 10 at most).
    pub forward: f32,
    /// Friction over that of the model, in the negative direction.
    pub backward: f32,
    /// Drag beyond the model's, N m s/rad, of either sign, up to `largest_drag`.
    pub drag: f32,
    /// Offset of the observed torque, N m, of either sign, up to `largest_offset`.
    pub offset: f32,
    /// Relative error of the load torque, of either sign, up to `largest_load_error` (1 at most): the true one is `1 + load_error` times as large.
    pub load_error: f32,
}

pub(super) const ESTIMATES: usize = 5;

impl Estimates {
    pub(super) const fn of(values: &[f32; ESTIMATES]) -> Self {
        let [forward, backward, drag, offset, load_error] = *values;
        Self {
            forward,
            backward,
            drag,
            offset,
            load_error,
        }
    }

    /// Friction levels.
    #[inline(always)]
    pub const fn level(&self) -> FrictionLevel {
        FrictionLevel {
            forward: self.forward,
            backward: self.backward,
        }
    }

    /// Friction torque, N m, of a model without memory that has `modelled`, N m, at a speed, rad/s: its level times the model's, with the drag.
    ///
    /// Not for a model with memory: a torque below breakaway times a level that changes may give more than it took.
    #[inline]
    pub const fn friction(&self, modelled: f32, nut_speed: f32) -> f32 {
        self.level().of(modelled) * modelled + self.drag * nut_speed
    }
}

/// Reasons why a tick of the adaptation did not count, and limits in it; a set of flags.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct AdaptationFlags(u8);

impl AdaptationFlags {
    /// The tick counted, and nothing was limited.
    pub const NONE: Self = Self(0);
    /// An input is NaN, infinite, or beyond its limit: it did not count.
    pub const INPUT_RANGE: Self = Self(1);
    /// The model's step had a flag: it did not count.
    pub const FAULTED: Self = Self(1 << 1);
    /// The motor was at its limit: it did not count.
    pub const SATURATED: Self = Self(1 << 2);
    /// The mechanism stands, is slower than the least speed, or its friction has not turned round yet: it did not count.
    pub const STANDING: Self = Self(1 << 3);
    /// The model's friction is below the least: it did not count.
    pub const TOO_WEAK: Self = Self(1 << 4);
    /// The error was beyond four of its deviations, and counted as one of four with more noise; flagged in ticks with a correction, four of nine.
    pub const ERROR_CUT: Self = Self(1 << 5);
    /// An estimate is at its bound: flagged in every tick that counts.
    pub const AT_BOUND: Self = Self(1 << 6);
    /// The flags with which a tick does not count.
    pub const CLOSED: Self = Self(0x1f);

    /// True where any flag is set.
    #[inline]
    #[must_use]
    pub const fn any(self) -> bool {
        self.0 != 0
    }

    /// True where every flag of `other` is set.
    #[inline]
    #[must_use]
    pub const fn contains(self, other: Self) -> bool {
        self.0 & other.0 == other.0
    }

    /// True where the tick counted.
    #[inline]
    #[must_use]
    pub const fn counted(self) -> bool {
        self.0 & Self::CLOSED.0 == 0
    }

    /// The flags as bits, in the order of their constants.
    pub const fn bits(self) -> u8 {
        self.0
    }

    #[inline(always)]
    pub(super) const fn with(self, condition: bool, other: Self) -> Self {
        Self(self.0 | if condition { other.0 } else { 0 })
    }
}
