//! Sliding friction of a scene in both directions, apart from how friction passes between them: by the speed in a scene
//! without memory, by the angle in one with it.

use super::contract::Scene;
use super::reversal::{Motion, ReversalState};
use crate::error::Range;
use crate::law::SlidingLimits;
use crate::law::coefficient::DirectionalCoefficient;

/// Friction of gross sliding in both directions at a tick, and the load under which it slides. Against the direction in which a row's balls
/// went last it is friction of the grooves alone: balls that press part there.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct SlidingFriction {
    /// Friction of sliding in the positive direction, N m or N, not negative.
    pub forward: f32,
    /// Friction of sliding in the negative direction, as a positive number, N m or N.
    pub backward: f32,
    /// Load, N, not negative: of a screw the axial load and `2 sqrt(2)` times the axial preload of a flank; of a bearing the normal
    /// load that presses both diagonals as hard as they are pressed, in which its preload is held.
    pub load: f32,
}

impl SlidingFriction {
    /// What the elements are limited by, whose reference load has this inverse, 1/N.
    #[inline(always)]
    #[must_use]
    pub const fn limits(&self, per_reference_load: f32) -> SlidingLimits {
        SlidingLimits {
            forward: self.forward,
            backward: self.backward,
            load: self.load * per_reference_load,
        }
    }
}

/// A scene whose sliding friction can be had apart from how it passes through the reversal.
///
/// What [`WithMemory`](super::WithMemory) needs of a scene.
pub trait Sliding: Scene<ValidInputs = <Self as Scene>::Inputs, Inputs: Motion> {
    /// Range of the friction coefficients of ball and groove that the scene takes.
    const FRICTION: Range;

    /// Sliding friction in a tick, in both directions, with what else the tick found.
    type Friction: Copy + core::fmt::Debug + PartialEq;

    /// Sliding friction under a friction coefficient of ball and groove in each direction; moves the balls on by a tick. A speed of 0 counts as
    /// forward.
    fn sliding_friction(
        constants: &Self::Constants,
        state: &mut Self::State,
        inputs: Self::Inputs,
        friction: DirectionalCoefficient,
    ) -> Self::Friction;

    /// Whether the load of [`Self::by_direction`] is `|F| + 2 sqrt(2) F_0` under an axial load `F` and with a preload `F_0` of each flank:
    /// what [`PreloadedElements`](crate::law::memory::PreloadedElements) take.
    const COUNTS_PRELOAD: bool;

    /// Its sizes in both directions, and the load.
    fn by_direction(sliding: &Self::Friction) -> SlidingFriction;

    /// Takes over what the friction of the last tick leaves to this one; `travelled`: the balls' travel in this tick over half the play. Nothing
    /// in a scene whose friction does not depend on where its balls went.
    #[inline(always)]
    fn continue_from(_sliding: &mut Self::Friction, _last: &Self::Friction, _travelled: f32) {}

    /// What the scene puts out at this reversal state.
    fn outputs_at(
        constants: &Self::Constants,
        inputs: Self::Inputs,
        sliding: &Self::Friction,
        reversal: ReversalState,
    ) -> Self::Outputs;

    /// Turn, rad (m of a bearing), of a given one that balls can make in a tick, and the speed at which they make it; a scene that
    /// knows no tick makes all of it, at the measured speed.
    fn limited_travel(constants: &Self::Constants, turn: f32, measured: f32) -> (f32, f32);
}
