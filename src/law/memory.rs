//! Elements that stick and slip: friction as a hysteresis in angle.
//!
//! Contacts deflect before they slide. Parallel springs, each in series with a slider
//!
//! `f_i <- clamp(f_i + k_i dtheta, -lambda_i T-, +lambda_i T+)`, `T = sum f_i`, `sum lambda_i = 1`
//!
//! `T+` and `T-` are the friction of gross sliding of the same tick. The clamp is the implicit step (return mapping; Simo and Hughes 1998), exact for a
//! turn at constant speed. Stiffnesses `k_i` are constant, so the elements are passive: stored energy `sum f_i²/(2 k_i)` never grows by more than the
//! work done, however the limits change.
//!
//! | type | shares `lambda_i` | for |
//! |---|---|---|
//! | [`ProportionalElements`] | constant, from [tables](backbone) | a preloaded screw, whose load varies by half |
//! | [`LoadExactElements`] | of the same tick's load: springs come into contact with it | any load, without a preload |
//! | [`PreloadedElements`] | the same, at the load that both flanks share | a preloaded screw under any load |
//! | [`SeatElement`] | one nonlinear spring with free play | a screw with clearance, whose balls go from seat to seat |
//! | [`ParallelElements`] | of two of these | spin beside the seat |
//!
//! Turn is an angle, rad, and friction a torque, N m, of a screw; of a linear bearing they are a path, m, and a force, N.

pub mod backbone;
mod composed;
mod load_exact;
mod proportional;
mod seat;
mod state;

pub use backbone::{
    Backbone, BackboneElement, SLIP_4, SLIP_6, SLIP_8, SLIP_10, SPIN_4, SPIN_6, SPIN_8, SPIN_10,
};
pub use composed::{ParallelElements, ParallelElementsState, PreloadedElements};
pub use load_exact::LoadExactElements;
pub use proportional::{Part, ProportionalElements};
pub use seat::{SeatElement, SeatState};
pub use state::MemoryState;

use super::{Elements, SlidingLimits};
use crate::error::Range;

/// Friction of gross sliding at the reference load: 1e-9 to 1e9 N m (N).
pub const REFERENCE_LIMIT: Range = Range::new(1e-9, 1e9);

/// Turn from no friction to full sliding: 1e-9 to 1e3 rad (m).
pub const BREAKAWAY: Range = Range::new(1e-9, 1e3);

/// Elements that hold, store energy, and have a stiffness and a breakaway.
pub trait Hysteresis: Elements {
    /// Friction without a turn: that of the last one, cut to the limits.
    #[inline]
    fn hold(&self, state: &mut Self::State, limits: &SlidingLimits) -> f32 {
        self.follow(state, 0.0, limits)
    }

    /// Energy in the springs, J: `sum f_i²/(2 k_i)`; it never grows by more than the work `T dtheta` of the same tick.
    fn stored_energy(&self, state: &Self::State) -> f32;

    /// Friction over turn from rest at the reference load, N m/rad (N/m).
    fn initial_stiffness(&self) -> f32;

    /// Turn from rest to full sliding at the reference load, rad (m).
    fn breakaway(&self) -> f32;
}
