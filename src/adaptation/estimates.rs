//! What an adaptation finds.

use crate::law::FrictionLevel;

/// What an adaptation finds.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Estimates {
    /// Friction over that of the model, in the positive direction, within the levels of the configuration (0.1 to 10 at most).
    pub forward: f32,
    /// The same in the negative direction.
    pub backward: f32,
    /// Drag beyond the model's, N m s/rad, of either sign, up to `largest_drag`.
    pub drag: f32,
    /// Offset of the observed torque, N m, of either sign, up to `largest_offset`.
    pub offset: f32,
    /// Relative error of the load torque that was taken off, of either sign, up to `largest_load_error` (1 at most): the true one is
    /// `1 + load_error` times as large.
    pub load_error: f32,
}

/// How many there are.
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
    #[must_use]
    pub const fn level(&self) -> FrictionLevel {
        FrictionLevel {
            forward: self.forward,
            backward: self.backward,
        }
    }

    /// Friction torque, N m, of a model without memory that has `modelled`, N m, at a speed, rad/s: its level times the model's,
    /// with the drag. What belongs to sensors is not in it.
    ///
    /// Not for a model with memory: a torque below breakaway times a level that changes is a spring that may give more than it took.
    #[inline]
    #[must_use]
    pub const fn friction(&self, modelled: f32, nut_speed: f32) -> f32 {
        self.level().of(modelled) * modelled + self.drag * nut_speed
    }
}
