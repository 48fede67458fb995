//! What all kinds of elements share: their ranges, and what they say of themselves beside their friction.

use crate::error::Range;
use crate::law::{Elements, SlidingLimits};

/// Friction of gross sliding at the reference load: 1e-9 to 1e9 N m (N).
pub const REFERENCE_LIMIT: Range = Range::new(1e-9, 1e9);

/// Turn from no friction to full sliding: 1e-9 to 1e3 rad (m).
pub const BREAKAWAY: Range = Range::new(1e-9, 1e3);

/// Elements that hold, store energy, and have a stiffness and a breakaway.
pub trait Hysteresis: Elements {
    /// Friction without a turn: what is remembered, cut to the limits. For a tick without an angle.
    #[inline]
    fn hold(&self, state: &mut Self::State, limits: &SlidingLimits) -> f32 {
        self.follow(state, 0.0, limits)
    }

    /// Energy in the springs, J: `sum f_i²/(2 k_i)`.
    ///
    /// It never grows by more than the work `T dtheta` of the same tick.
    fn stored_energy(&self, state: &Self::State) -> f32;

    /// Friction over turn from rest at the reference load, N m/rad (N/m).
    fn initial_stiffness(&self) -> f32;

    /// Turn from rest to full sliding at the reference load, rad (m).
    fn breakaway(&self) -> f32;
}
