//! The seat of a ball: free play, then a contact that stiffens, until all slides.

use super::state::{not_negative, turned};
use super::{BREAKAWAY, Hysteresis, REFERENCE_LIMIT};
use crate::error::{Error, Range, attempt};
use crate::law::{Elements, SlidingLimits};
use crate::math::{cbrt_squared, constant, sqrt};
use crate::stored::{Fingerprint, Fingerprinted, Port, Refusal, Stored};

/// Free play in each direction: 0 to 1e3 rad (m).
pub const FREE_PLAY: Range = Range::new(0.0, 1e3);

/// One nonlinear spring with free play in series with one slider: balls that go from one seat to the other.
///
/// `x <- clamp(x + dtheta, -x_b, x_f)`, `T = K ((|x| - g)+)^(3/2) sgn x`, `K = T_ref/theta_b^(3/2)`; `x_f` and `x_b` are where
/// `T` is the friction of gross sliding, `g + (T±/K)^(2/3)`.
///
/// Across-slip forces of both contacts push a ball in the same direction, until a third contact holds it: `x` is the ball's displacement
/// in its clearance in terms of the turn, `g` half the clearance, and `(x - g)^(3/2)` Hertz's law of the third contact
/// (which bears `2 mu F`, so that `K = N l_1/(2 c_3^(3/2))` of `N` balls does not depend on the load). With clearance this decides how far a nut
/// turns before it slides. Stored energy is a convex function of `x` alone, and the slider moves towards the friction: passive, whatever the limits do.
///
/// f32 against f64 is 5e-7 of the limit. 172 cycles, 100 where nothing slides. Finite limits and any turn; a turn that is NaN or from `2^20` on
/// counts as 0.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct SeatElement {
    pub(super) free_play: f32,
    /// Turn from the end of the play to sliding at the reference.
    breakaway_angle: f32,
    reference_limit: f32,
    /// Friction over turn to the power 3/2.
    pub(super) stiffness: f32,
    inverse_stiffness: f32,
}

/// State of a seat.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct SeatState {
    pub(super) displacement: f32,
}

impl SeatState {
    /// Turn from the middle of the play, rad (m).
    pub const fn displacement(&self) -> f32 {
        self.displacement
    }

    /// A state from a turn from the middle of the play; beyond sliding it is cut in the next tick.
    ///
    /// # Errors
    /// [`Error`] naming `displacement`, where it is NaN or beyond 1e6.
    pub const fn from_displacement(displacement: f32) -> Result<Self, Error> {
        let displacement = attempt!(Range::new(-1e6, 1e6).checked("displacement", displacement));
        Ok(Self { displacement })
    }
}

impl SeatElement {
    /// A seat with `free_play`, rad (m), to either side, which slides with `reference_limit`, N m (N), after `breakaway_angle`, rad (m), beyond it.
    pub const fn new(
        reference_limit: f32,
        free_play: f32,
        breakaway_angle: f32,
    ) -> Result<Self, Error> {
        attempt!(REFERENCE_LIMIT.checked("reference_limit", reference_limit));
        attempt!(FREE_PLAY.checked("free_play", free_play));
        attempt!(BREAKAWAY.checked("breakaway_angle", breakaway_angle));
        let power = breakaway_angle * constant::sqrt(breakaway_angle);
        Ok(Self {
            free_play,
            breakaway_angle,
            reference_limit,
            stiffness: reference_limit / power,
            inverse_stiffness: power / reference_limit,
        })
    }
}

impl Elements for SeatElement {
    type State = SeatState;

    const VIRGIN: Self::State = SeatState { displacement: 0.0 };

    #[inline]
    fn follow(&self, state: &mut Self::State, turn: f32, limits: &SlidingLimits) -> f32 {
        let displacement = state.displacement + turned(turn);
        let is_back = displacement < 0.0;
        let (size, limit) = if is_back {
            (-displacement, limits.backward)
        } else {
            (displacement, limits.forward)
        };
        let pressed = not_negative(size - self.free_play);
        let friction = self.stiffness * (pressed * sqrt(pressed));
        let (size, friction) = if friction > limit {
            let pressed = cbrt_squared(limit * self.inverse_stiffness);
            (self.free_play + pressed, limit)
        } else {
            (size, friction)
        };
        if is_back {
            state.displacement = -size;
            -friction
        } else {
            state.displacement = size;
            friction
        }
    }
}

impl Hysteresis for SeatElement {
    fn stored_energy(&self, state: &Self::State) -> f32 {
        let pressed = not_negative(state.displacement.abs() - self.free_play);
        0.4 * self.stiffness * (pressed * pressed) * sqrt(pressed)
    }

    /// The play is free, and the contact starts without stiffness.
    fn initial_stiffness(&self) -> f32 {
        0.0
    }

    fn breakaway(&self) -> f32 {
        self.free_play + self.breakaway_angle
    }
}

const SEAT: u32 = 3;

impl Stored for SeatState {
    const BYTES: usize = 4;

    fn exchange<P: Port>(&mut self, port: &mut P) -> Result<(), Refusal> {
        let turns = Range::new(-1e6, 1e6);
        port.number("displacement", &mut self.displacement, turns)
    }
}

impl Fingerprinted for SeatElement {
    fn fingerprint(&self, fingerprint: &mut Fingerprint) {
        fingerprint.count(SEAT);
        fingerprint.numbers(&[self.free_play, self.stiffness]);
    }
}
