//! How much of a friction that remembers a motor may compensate without a limit cycle. Checked at set-up.
//!
//! Near a reversal friction is a spring, and its compensation a negative one. Three things keep the loop of motor, delay, encoder and true friction
//! quiet, however short or long the delay is:
//!
//! 1. **Less friction than there is.** `g q <= 0.95`, `g` the output share, `q` the model's sliding friction over
//!    the true one. At 1 nothing stops the nut once it moves.
//! 2. **Less stiffness than there is.** `g q b <= 0.97`, `b` the true breakaway angle over the model's: initial stiffness is 1.5 times
//!    friction over breakaway angle.
//! 3. **Less loss than there is.** In units of friction and breakaway angle a swing to either side by the amplitude `A >= 1` loses `4 A - 3.2`; the
//!    compensation behind a play of the half width `p` gives `g q (4 A - 8 p - 3.2/b)`, and most in proportion to the loss at `A = 1`. So a model that
//!    breaks away 5 % too early feeds a swing of one breakaway angle. Six elements or more replace a smooth curve within
//!    0.04 breakaway angles, which the play has to cover: `g q (4 - 8 (p - 0.04) - 3.2/b) <= 0.8` and `p >= 0.04`.
//!
//! So: set the breakaway angle to the high end of its confidence band, and put a play of 5 % of it, beyond the noise, between sensor and
//! elements ([`Deadband`](super::motion::Deadband)): that allows 0.95. Noise that passes the play works as an earlier breakaway; after a reversal
//! friction is late by twice the play.
//!
//! The simulated loop in `host-tests/tests/all/scenes/compensation.rs` is quiet inside these bounds and hums outside.

use crate::error::{Error, Range, attempt, in_range};
use crate::law::memory::BREAKAWAY;

/// Largest part of the true friction that is compensated: the simulated loop is quiet at 0.95, at every rate, delay and breakaway that was tried,
/// and at 1 never comes to rest.
pub const LARGEST_PART: f32 = 0.95;

/// Largest initial stiffness of the compensation over that of the true friction: quiet in the simulated loop, as above.
pub const LARGEST_STIFFNESS: f32 = 0.97;

/// Least play beyond the noise over the largest breakaway angle: elements differ from a smooth curve by so much.
pub const LEAST_PLAY: f32 = 0.04;

/// Largest friction of the model over the true one: 0.1 to 10, the range of a [level](crate::law::LEVEL).
pub const FRICTION_RATIO: Range = Range::new(0.1, 10.0);

/// Margin of the model's friction to the true one where it is compensated; unchecked.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct CompensationMargin {
    /// Breakaway angle of the model's elements, rad, 1e-9 to 1e3.
    pub breakaway_angle: f32,
    /// Largest breakaway angle of the true friction: the high end of its confidence band, rad, 1e-9 to 1e3.
    pub largest_breakaway_angle: f32,
    /// Largest ratio of the model's sliding friction to the true one, 0.1 to 10.
    pub friction_ratio: f32,
    /// Play between sensor and elements, rad: its half width less half the width of the angle's noise; 0.04 times the largest
    /// breakaway angle up to 1e3.
    pub play: f32,
}

impl CompensationMargin {
    /// Largest output share of the friction: `min(0.95, 0.97/b, 0.8/(4 - 8 (p - 0.04) - 3.2/b))/q`.
    pub const fn largest_share(&self) -> Result<f32, Error> {
        let Self {
            breakaway_angle,
            largest_breakaway_angle,
            friction_ratio,
            play,
        } = *self;
        attempt!(BREAKAWAY.checked("breakaway_angle", breakaway_angle));
        attempt!(BREAKAWAY.checked("largest_breakaway_angle", largest_breakaway_angle));
        attempt!(FRICTION_RATIO.checked("friction_ratio", friction_ratio));
        let least = LEAST_PLAY * largest_breakaway_angle;
        attempt!(in_range("play", play, least, 1e3));
        let model = breakaway_angle / largest_breakaway_angle;
        let play = (play - least) / largest_breakaway_angle;
        let mut largest = LARGEST_PART;
        if LARGEST_STIFFNESS * model < largest {
            largest = LARGEST_STIFFNESS * model;
        }
        let given = 4.0 - 8.0 * play - 3.2 * model;
        // The true friction loses 4 - 3.2 in a swing of one breakaway angle.
        if 0.8 < largest * given {
            largest = 0.8 / given;
        }
        Ok(largest / friction_ratio)
    }

    /// `share`, where the loop is quiet with it.
    ///
    /// # Errors
    /// [`Error`] naming `share`, with the range that this margin leaves it (at most 1), or the margin's field out of range.
    pub const fn checked_share(&self, share: f32) -> Result<f32, Error> {
        let largest = attempt!(self.largest_share());
        let largest = if largest < 1.0 { largest } else { 1.0 };
        in_range("share", share, 0.0, largest)
    }
}
