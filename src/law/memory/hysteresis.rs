//! What every kind of elements can say of itself beside its friction.

use crate::law::{Elements, SlidingLimits};

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
