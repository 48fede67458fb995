//! An angle in radians that starts again after a period.

use super::turn::{NutAngle, Turn, within_half};
use crate::error::{Error, attempt, in_range};

/// An angle as it is set up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WrappedAngleParameters {
    /// Smallest angle, rad: -1e6 to 1e6; 0 or minus half a period.
    pub lowest: f32,
    /// Turn after which it starts again at `lowest`, rad: 1e-3 to 1e6. As the sensor's side rounds it: an f32 of a full turn
    /// is 1.7e-7 rad more than one, which adds up over turns in one direction and has no effect on a reversal.
    pub period: f32,
    /// Most that the nut turns between two readings, rad: [`LARGEST_TURN`](super::LARGEST_TURN), and at most half a period.
    pub largest_turn: f32,
}

/// Nut angle in radians: `dtheta = theta - theta_last`, the shorter way round.
///
/// Differences of neighbours are exact (Sterbenz) where neither is over twice the other; across the end both distances
/// from it are, and the turn is rounded once. What is left is the readings' own resolution: half an ulp, 2e-7 rad near a
/// full turn. An angle outside `lowest` to `lowest + period`, or no number, is no reading. 65 cycles.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct WrappedAngle {
    pub(super) lowest: f32,
    pub(super) highest: f32,
    half: f32,
    largest_turn: f32,
}

/// The last angle, where there was one.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct AngleReading(pub(super) Option<f32>);

impl WrappedAngle {
    /// Constants of an angle.
    ///
    /// # Errors
    /// The field that is out of range.
    pub const fn new(parameters: WrappedAngleParameters) -> Result<Self, Error> {
        let WrappedAngleParameters {
            lowest,
            period,
            largest_turn,
        } = parameters;
        attempt!(in_range("lowest", lowest, -1e6, 1e6));
        attempt!(in_range("period", period, 1e-3, 1e6));
        let half = 0.5 * period;
        attempt!(within_half(largest_turn, half));
        Ok(Self {
            lowest,
            highest: lowest + period,
            half,
            largest_turn,
        })
    }

    #[inline(always)]
    fn difference(&self, last: f32, now: f32) -> f32 {
        let turn = now - last;
        if turn > self.half {
            (self.lowest - last) - (self.highest - now)
        } else if turn < -self.half {
            (self.highest - last) + (now - self.lowest)
        } else {
            turn
        }
    }
}

impl NutAngle for WrappedAngle {
    type Reading = f32;
    type State = AngleReading;

    const FRESH: Self::State = AngleReading(None);

    fn is_valid_state(&self, state: &Self::State) -> bool {
        state
            .0
            .is_none_or(|last| last >= self.lowest && last <= self.highest)
    }

    #[inline]
    fn turn(&self, state: &mut Self::State, reading: f32) -> Turn {
        // False for what is no number.
        if !(reading >= self.lowest && reading <= self.highest) {
            return Turn::Unknown;
        }
        let last = state.0.replace(reading);
        Turn::within(
            last.map_or(0.0, |last| self.difference(last, reading)),
            self.largest_turn,
        )
    }
}
