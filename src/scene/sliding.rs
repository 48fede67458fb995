//! Sliding friction of a scene in both directions, apart from how friction passes between them.

use super::contract::{CheckedInputs, Motion, ReversalState, Scene};
use super::faults::Faults;
use super::outputs::Outputs;
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

/// Largest fading that counts: it bounds what friction near none makes of a quotient.
const LARGEST_FADING: f32 = 10.0;

/// Sliding friction of a row of balls, in the direction in which they go: torques of a screw, N m, or forces of a bearing, N.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct TrainFriction {
    /// Friction of the grooves, and of balls that rub against each other, not negative.
    pub(super) groove: f32,
    pub(super) ball: f32,
    /// Friction of the grooves where no ball presses on another, not negative.
    pub(super) free: f32,
    /// Groove friction forward and backward, each over that of the friction coefficient in the direction of the balls.
    pub(super) ratios: [f32; 2],
    /// What limits forward and backward still exceed this friction by, over it: see [`Self::continue_from`].
    pub(super) fading: [f32; 2],
    /// -1 where the balls go backward, else 1.
    pub(super) direction: f32,
    /// Load, preload counted, N.
    pub(super) load: f32,
    pub(super) contacts: u8,
    pub(super) largest_contact_force: f32,
}

pub(super) struct RowOutputs {
    /// Friction of the whole row, N m or N, with load torque, regime and faults.
    pub(super) whole: Outputs,
    /// Its parts of the grooves and between balls, with their sign.
    pub(super) groove: f32,
    pub(super) ball: f32,
    pub(super) contacts: u8,
    pub(super) largest_contact_force: f32,
}

impl TrainFriction {
    #[inline(always)]
    pub(super) fn friction(&self) -> SlidingFriction {
        let [forward, backward] = self.fading;
        SlidingFriction {
            forward: self.of(1.0) * (1.0 + forward),
            backward: self.of(-1.0) * (1.0 + backward),
            load: self.load,
        }
    }

    /// Sliding friction in the direction of a sign; against the direction of the balls that of the grooves alone.
    #[inline(always)]
    pub(super) fn of(&self, direction: f32) -> f32 {
        let [groove, ball] = self.parts(direction);
        groove + ball
    }

    #[inline(always)]
    fn parts(&self, direction: f32) -> [f32; 2] {
        let ratio = of_direction(self.ratios, direction);
        if direction * self.direction < 0.0 {
            [ratio * self.free, 0.0]
        } else {
            [ratio * self.groove, self.ball]
        }
    }

    /// Outputs of the row with a drag added: see [`Outputs::new`].
    #[inline(always)]
    pub(super) fn outputs_at(
        &self,
        reversal: ReversalState,
        load_torque: f32,
        drag: f32,
        faults: Faults,
        largest: f32,
    ) -> RowOutputs {
        let sliding = self.of(reversal.direction);
        let ReversalState {
            factor, carried, ..
        } = reversal;
        let [groove, ball] = self.parts(factor);
        let presses = factor * self.direction >= 0.0 && carried > 0.0;
        let factor = factor * (1.0 + of_direction(self.fading, factor));
        let (groove, ball) = (factor * groove, factor * ball);
        RowOutputs {
            whole: Outputs::new(
                groove + ball + drag,
                sliding,
                load_torque,
                &reversal,
                faults,
                largest,
            ),
            groove,
            ball,
            contacts: if presses { self.contacts } else { 0 },
            largest_contact_force: if presses {
                carried * self.largest_contact_force
            } else {
                0.0
            },
        }
    }

    /// See [`Sliding::continue_from`]. Where balls turn round, limits that fall begin where they were, in proportion to the load, and fade by
    /// the whole friction with each half of the play.
    #[inline(always)]
    pub(super) fn continue_from(&mut self, last: &Self, travelled: f32) {
        let excess = if self.direction == last.direction {
            last.fading
        } else {
            let (now, before) = (self.friction(), last.friction());
            let scale = self.load / last.load;
            let excess = |now: f32, before: f32| {
                let excess = before * scale / now - 1.0;
                if excess > LARGEST_FADING {
                    LARGEST_FADING
                } else {
                    excess
                }
            };
            [
                excess(now.forward, before.forward),
                excess(now.backward, before.backward),
            ]
        };
        self.fading = excess.map(|excess| not_negative(excess - travelled));
    }
}

#[inline(always)]
const fn of_direction([forward, backward]: [f32; 2], direction: f32) -> f32 {
    if direction < 0.0 { backward } else { forward }
}

/// 0 for a number below 0, and for NaN.
#[inline(always)]
pub(super) const fn not_negative(number: f32) -> f32 {
    if number > 0.0 { number } else { 0.0 }
}

impl Stored for TrainFriction {
    const BYTES: usize = 10 * 4 + 1;

    fn exchange<P: Port>(&mut self, port: &mut P) -> Result<(), Refusal> {
        port.number("groove", &mut self.groove, ranges::STORED_FRICTION)?;
        port.number("ball", &mut self.ball, ranges::STORED_FRICTION)?;
        port.number("free", &mut self.free, ranges::STORED_FRICTION)?;
        port.numbers("ratios", &mut self.ratios, ranges::STORED_RATIOS)?;
        let fading = Range::new(0.0, LARGEST_FADING);
        port.numbers("fading", &mut self.fading, fading)?;
        port.number("direction", &mut self.direction, Range::new(-1.0, 1.0))?;
        port.number("load", &mut self.load, ranges::STORED_LOAD)?;
        port.count("contacts", &mut self.contacts, u8::MAX)?;
        port.number(
            "largest_contact_force",
            &mut self.largest_contact_force,
            Range::new(0.0, 1e12),
        )
    }
}
