//! What two readings say of a turn.

use crate::error::{Error, Range, in_range};

/// Largest turn of a tick that a set-up may allow, rad (m): 1e-6 to 1e3.
pub const LARGEST_TURN: Range = Range::new(1e-6, 1e3);

/// The largest turn of a sensor that starts again after twice `half`: it cannot tell more than half a period.
///
/// # Errors
/// [`Error`] naming `largest_turn`.
pub(super) const fn within_half(largest_turn: f32, half: f32) -> Result<f32, Error> {
    let most = if half < LARGEST_TURN.maximum {
        half
    } else {
        LARGEST_TURN.maximum
    };
    in_range("largest_turn", largest_turn, LARGEST_TURN.minimum, most)
}

/// What two readings say of the turn between them.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Turn {
    /// The turn, rad (m); none at the first reading.
    Measured(f32),
    /// More than the largest turn that a tick can have: cut to that.
    Limited(f32),
    /// The reading is not valid. Friction holds; the next reading's turn spans the gap.
    Unknown,
}

impl Turn {
    /// The turn to apply, rad (m): 0 where it is unknown.
    #[inline]
    #[must_use]
    pub const fn angle(self) -> f32 {
        match self {
            Self::Measured(turn) | Self::Limited(turn) => turn,
            Self::Unknown => 0.0,
        }
    }

    /// Whether the turn is as it was read.
    #[inline]
    #[must_use]
    pub const fn is_measured(self) -> bool {
        matches!(self, Self::Measured(_))
    }

    /// A turn as it is, cut to `largest`.
    #[inline(always)]
    pub(super) fn within(turn: f32, largest: f32) -> Self {
        if turn > largest {
            Self::Limited(largest)
        } else if turn < -largest {
            Self::Limited(-largest)
        } else {
            Self::Measured(turn)
        }
    }
}

/// A sensor of the nut's angle: constants, folded at set-up.
pub trait NutAngle {
    /// What the sensor gives.
    type Reading: Copy;
    /// The last good reading.
    type State: Copy + core::fmt::Debug + PartialEq;

    /// No reading yet.
    const FRESH: Self::State;

    /// Whether this sensor can have left such a state: one that was read from bytes may be that of another sensor.
    fn is_valid_state(&self, state: &Self::State) -> bool {
        let _ = state;
        true
    }

    /// The turn since the last good reading; bounded time, no panic.
    fn turn(&self, state: &mut Self::State, reading: Self::Reading) -> Turn;
}
