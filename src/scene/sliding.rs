//! Full friction of a scene in both directions, apart from how friction passes between them: by the speed in a scene
//! without memory, by the angle in one with it.

use super::contract::Scene;
use super::passage::{Motion, Passage};
use crate::error::Range;
use crate::law::SlidingLimits;
use crate::law::coefficient::DirectionalCoefficient;

/// A scene whose full friction can be computed apart from its passage through the reversal: what
/// [`WithMemory`](super::WithMemory) needs of a scene.
pub trait Sliding: Scene<Known = <Self as Scene>::Inputs, Inputs: Motion> {
    /// Range of the friction coefficients of ball and groove that the scene takes.
    const FRICTION: Range;

    /// What is folded before the first tick for friction coefficients other than the configuration's.
    type Coefficients: Copy + core::fmt::Debug + PartialEq;
    /// Full friction in a tick, in both directions, with what else the tick found.
    type Full: Copy + core::fmt::Debug + PartialEq;

    /// Folds it for coefficients from `least` to `largest`.
    fn coefficients(constants: &Self::Constants, least: f32, largest: f32) -> Self::Coefficients;

    /// Full friction under a friction coefficient of ball and groove in each direction; moves the balls on by a tick. Where nothing
    /// was folded for other coefficients, friction is in proportion to the coefficient. A speed of 0 counts as forward.
    fn full(
        constants: &Self::Constants,
        state: &mut Self::State,
        coefficients: Option<&Self::Coefficients>,
        inputs: Self::Inputs,
        friction: DirectionalCoefficient,
    ) -> Self::Full;

    /// Sizes of a full friction in both directions, and the load: the axial one of a screw or the normal one of a bearing, N, preload
    /// counted.
    fn limits(full: &Self::Full) -> SlidingLimits;

    /// What the scene puts out at this passage.
    fn passed(
        constants: &Self::Constants,
        inputs: Self::Inputs,
        full: &Self::Full,
        passage: Passage,
    ) -> Self::Outputs;

    /// Speed at which a turn, rad (m of a bearing), is made in a tick; a scene that knows no tick gives the measured speed.
    fn speed_of(constants: &Self::Constants, turn: f32, measured: f32) -> f32;
}
