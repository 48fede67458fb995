//! Two kinds of elements side by side.

use super::Hysteresis;
use crate::error::{Error, attempt, in_range};
use crate::law::{Elements, SlidingLimits};

/// Two kinds of elements that turn together and share the friction: spin beside the seat, as with clearance.
///
/// `T = A(share T±) + B((1 - share) T±)`. Both remember their own; as passive as both are. Cost: both, and 6 cycles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ParallelElements<A, B> {
    pub(super) first: A,
    pub(super) second: B,
    pub(super) share: f32,
}

/// What two kinds of elements remember.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct ParallelElementsState<A, B> {
    /// What the first ones remember.
    pub first: A,
    /// What the second ones remember.
    pub second: B,
}

impl<A: Copy, B: Copy> ParallelElements<A, B> {
    /// Both, the first ones with `share` (0 to 1) of the friction of gross sliding: their reference limits
    /// are to be these shares of the whole one.
    ///
    /// # Errors
    /// `share` outside 0 to 1.
    pub const fn new(first: A, second: B, share: f32) -> Result<Self, Error> {
        let share = attempt!(in_range("share", share, 0.0, 1.0));
        Ok(Self {
            first,
            second,
            share,
        })
    }
}

impl<A: Elements, B: Elements> Elements for ParallelElements<A, B> {
    type State = ParallelElementsState<A::State, B::State>;

    const VIRGIN: Self::State = ParallelElementsState {
        first: A::VIRGIN,
        second: B::VIRGIN,
    };

    const PRELOADED: bool = A::PRELOADED || B::PRELOADED;

    #[inline]
    fn follow(&self, state: &mut Self::State, turn: f32, limits: &SlidingLimits) -> f32 {
        let first = SlidingLimits {
            forward: self.share * limits.forward,
            backward: self.share * limits.backward,
            load: limits.load,
        };
        // Differences, so that both add up to the whole.
        let second = SlidingLimits {
            forward: limits.forward - first.forward,
            backward: limits.backward - first.backward,
            load: limits.load,
        };
        self.first.follow(&mut state.first, turn, &first)
            + self.second.follow(&mut state.second, turn, &second)
    }
}

impl<A: Hysteresis, B: Hysteresis> Hysteresis for ParallelElements<A, B> {
    fn stored_energy(&self, state: &Self::State) -> f32 {
        self.first.stored_energy(&state.first) + self.second.stored_energy(&state.second)
    }

    fn initial_stiffness(&self) -> f32 {
        self.first.initial_stiffness() + self.second.initial_stiffness()
    }

    fn breakaway(&self) -> f32 {
        let (first, second) = (self.first.breakaway(), self.second.breakaway());
        if first > second { first } else { second }
    }
}
