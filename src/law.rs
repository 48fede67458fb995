//! Friction as a law of motion: between its two directions, and its coefficient by speed and temperature. A scene without memory links
//! nothing of it.
//!
//! | module | what |
//! |---|---|
//! | [`memory`] | elements that stick and slip: friction as a hysteresis in angle |
//! | [`motion`] | the turn between two readings of a nut angle, exactly |
//! | [`coefficient`] | friction coefficient by speed, temperature and direction; lubricant drag |
//! | [`compensation`] | how much of a friction that remembers may be compensated |

pub mod coefficient;
pub mod compensation;
pub(crate) mod fade;
pub mod memory;
pub mod motion;

use crate::error::{Error, Range, attempt};

/// Friction of gross sliding in both directions at a tick: between them friction passes with the angle.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct SlidingLimits {
    /// Friction of sliding in the positive direction, N m or N, not negative.
    pub forward: f32,
    /// Friction of sliding in the negative direction, as a positive number, N m or N.
    pub backward: f32,
    /// Load over the reference load of the elements, not negative; only load-exact elements read it.
    pub load: f32,
}

impl SlidingLimits {
    /// These limits times a level in each direction; the load stays.
    #[inline(always)]
    #[must_use]
    pub const fn times(&self, level: &FrictionLevel) -> Self {
        Self {
            forward: self.forward * level.forward,
            backward: self.backward * level.backward,
            load: self.load,
        }
    }
}

/// Elements of friction that remember: constants of one kind, folded at set-up.
pub trait Elements {
    /// Memory of the elements.
    type State: Copy + core::fmt::Debug + PartialEq;

    /// Nothing remembered: no element carries anything.
    const VIRGIN: Self::State;

    /// Whether the load over the reference load counts as `1 + |F|/(2 sqrt(2) P)`, with the preload `P` of each flank and an axial load `F`.
    const PRELOADED: bool = false;

    /// Friction after a turn of `turn` rad (m of a bearing) under these limits: between `-backward` and `forward`, with the sign
    /// of the motion that it opposes. `turn` and the limits are finite; bounded time, no panic.
    fn follow(&self, state: &mut Self::State, turn: f32, limits: &SlidingLimits) -> f32;
}

/// Least and largest level: where a level of 0.1 or 10 was right, the model was of another screw.
pub const LEVEL: Range = Range::new(0.1, 10.0);

/// Friction of gross sliding over that of the model, in both directions; 0.1 to 10. It scales the limits of a memory: the stiffness of its
/// elements stays, and friction stays passive.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct FrictionLevel {
    /// In the positive direction, 0.1 to 10.
    pub forward: f32,
    /// In the negative direction, 0.1 to 10.
    pub backward: f32,
}

impl FrictionLevel {
    /// Friction as the model has it.
    pub const ONE: Self = Self {
        forward: 1.0,
        backward: 1.0,
    };

    /// These levels, checked.
    pub const fn checked(self) -> Result<Self, Error> {
        attempt!(LEVEL.checked("forward", self.forward));
        attempt!(LEVEL.checked("backward", self.backward));
        Ok(self)
    }

    /// Level of a direction, given by its sign; 0 counts as forward.
    #[inline(always)]
    pub const fn of(&self, direction: f32) -> f32 {
        if direction < 0.0 {
            self.backward
        } else {
            self.forward
        }
    }
}
