//! Sliding friction of a scene in both directions, apart from how friction passes between them.

use super::contract::Faults;
use super::contract::{CheckedInputs, Motion, ReversalState, Scene};
use super::outputs::of_direction;
use crate::error::Range;
use crate::law::SlidingLimits;
use crate::law::coefficient::DirectionalCoefficient;
use crate::ranges;
use crate::stored::{Port, Refusal, Stored};

/// Friction of gross sliding in both directions at a tick, and the load under which it slides. Against the direction in which a row's balls
/// went last it is friction of the grooves alone: balls that press part there.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
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
    /// Limits of elements whose reference load has this inverse, 1/N.
    #[inline(always)]
    pub const fn limits(&self, per_reference_load: f32) -> SlidingLimits {
        SlidingLimits {
            forward: self.forward,
            backward: self.backward,
            load: self.load * per_reference_load,
        }
    }
}

/// Drag of a scene without one: `x + NO_DRAG` is `x` to the bit, also of -0.
pub(super) const NO_DRAG: f32 = -0.0;

/// A scene whose sliding friction can be had apart from its reversal: what [`WithMemory`](super::WithMemory) needs.
pub trait Sliding: Scene<Inputs: Motion> {
    /// Range of the friction coefficients of ball and groove that the scene takes.
    const FRICTION: Range;

    /// Sliding friction of a step in both directions.
    type Friction: Copy + core::fmt::Debug + PartialEq;

    /// The inputs within their limits, with what was wrong with them.
    fn check_inputs(
        constants: &Self::Constants,
        inputs: Self::Inputs,
    ) -> CheckedInputs<Self::Inputs>;

    /// Sliding friction under a friction coefficient in each direction; moves the balls on by a step. A speed of 0 counts as forward.
    fn sliding_friction(
        constants: &Self::Constants,
        state: &mut Self::State,
        inputs: Self::Inputs,
        friction: DirectionalCoefficient,
    ) -> Self::Friction;

    /// Whether the load of [`Self::by_direction`] is `|F| + 2 sqrt(2) F_0` under an axial load `F` and with a preload `F_0` of each flank:
    /// what [`PreloadedElements`](crate::law::memory::PreloadedElements) take.
    const COUNTS_PRELOAD: bool;

    /// Friction in both directions, and the load.
    fn by_direction(sliding: &Self::Friction) -> SlidingFriction;

    /// Takes over what the friction of the last step leaves to this one; `travelled`: the balls' travel in this step over half the play.
    #[inline(always)]
    fn continue_from(_sliding: &mut Self::Friction, _last: &Self::Friction, _travelled: f32) {}

    /// Outputs at this reversal state, with a viscous drag added to the friction, N m (N), and faults to the scene's own.
    fn outputs_at(
        constants: &Self::Constants,
        inputs: Self::Inputs,
        sliding: &Self::Friction,
        reversal: ReversalState,
        drag: f32,
        faults: Faults,
    ) -> Self::Outputs;

    /// Turn, rad (m of a bearing), of a given one that balls can make in a step, and the speed at which they make it; a scene that
    /// knows no time between steps makes all of it, at the measured speed.
    #[inline(always)]
    fn limited_travel(_constants: &Self::Constants, turn: f32, measured: f32) -> (f32, f32) {
        (turn, measured)
    }
}

/// Sliding friction of a screw whose balls do not touch, in both directions.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CagedFriction {
    /// Friction torques, N m, and the axial load of all balls, preload counted, N.
    pub(super) sliding: SlidingFriction,
    pub(super) faults: Faults,
}

impl CagedFriction {
    #[inline(always)]
    pub(super) const fn of(&self, direction: f32) -> f32 {
        of_direction([self.sliding.forward, self.sliding.backward], direction)
    }
}

impl Stored for CagedFriction {
    const BYTES: usize = SlidingLimits::BYTES + Faults::BYTES;

    fn exchange<P: Port>(&mut self, port: &mut P) -> Result<(), Refusal> {
        let SlidingFriction {
            forward,
            backward,
            load,
        } = &mut self.sliding;
        port.number("forward", forward, ranges::STORED_FRICTION)?;
        port.number("backward", backward, ranges::STORED_FRICTION)?;
        port.number("load", load, ranges::STORED_LOAD)?;
        self.faults.exchange(port)
    }
}
