//! The closed track: its units of length, and how much room balls have on it.

use super::motion::OVERLAP;
use crate::error::{Error, attempt, in_range};

/// Units of length on the track: positions wrap around where it closes.
const UNITS: f32 = 4_294_967_296.0;

/// Largest travel in a tick over the length of the track that counts. A ball's own travel beyond it, in sixteenths of 2^-32 of the
/// track, has to fit into 31 bits at the [largest free speed](super::LARGEST_FREE_SPEED): up to 1/32.
pub const LARGEST_TRAVEL: f32 = 0.03;

/// Nominal travel, in units, below which it counts as none: far below any motion (1e-30 m), and its inverse times a gap of the whole
/// track, 2^32 units, is still finite.
const NO_TRAVEL: f32 = 1e-20;

/// Length of a closed track and of what a ball takes of it, checked for a number of balls.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(crate) struct Track {
    /// Distance of the centres of two balls in contact, in units.
    pitch: u32,
    /// Units in a metre.
    units_per_metre: f32,
}

impl Track {
    /// A track of `length`, m, with `balls` balls that stand `pitch`, m, from centre to centre in contact.
    ///
    /// # Errors
    /// As [`Train::new`](super::Train::new), but for `gaps`.
    pub(crate) const fn new(length: f32, pitch: f32, balls: usize) -> Result<Self, Error> {
        attempt!(in_range("length", length, 1e-4, 1e4));
        attempt!(in_range(
            "pitch",
            pitch,
            1e-6 * length,
            length / balls as f32
        ));
        let units_per_metre = UNITS / length;
        let pitch = (pitch * units_per_metre) as u32;
        // f32 holds the pitch to 2^-24; balls that fill the track must not overfill it by that.
        let pitch = match (1_u64 << 32).checked_div(balls as u64) {
            Some(fits) if (pitch as u64) > fits => fits as u32,
            _ => pitch,
        };
        Ok(Self {
            pitch,
            units_per_metre,
        })
    }

    /// Checks that `other` is this track to the last bit: balls keep their places on the same track only.
    ///
    /// # Errors
    /// [`Error`] naming `length` or `pitch`, m.
    pub(super) const fn is_same(&self, other: &Self) -> Result<(), Error> {
        let (own, others) = (UNITS / self.units_per_metre, UNITS / other.units_per_metre);
        attempt!(in_range("length", others, own, own));
        let per_unit = 1.0 / self.units_per_metre;
        let pitch = self.pitch as f32 * per_unit;
        attempt!(in_range(
            "pitch",
            other.pitch as f32 * per_unit,
            pitch,
            pitch
        ));
        Ok(())
    }

    /// Distance of the centres of two balls in contact, in units.
    #[inline(always)]
    pub(super) const fn pitch(&self) -> u32 {
        self.pitch
    }

    /// Units in a metre.
    #[inline(always)]
    pub(super) const fn units_per_metre(&self) -> f32 {
        self.units_per_metre
    }

    /// A travel, m, in units: at most [`LARGEST_TRAVEL`] of the track in size, and zero where it is NaN.
    #[inline]
    pub(super) fn in_units(&self, travel: f32) -> f32 {
        let travel = travel * self.units_per_metre;
        let largest = LARGEST_TRAVEL * UNITS;
        if travel > largest {
            largest
        } else if travel < -largest {
            -largest
        } else if travel.is_nan() {
            0.0
        } else {
            travel
        }
    }

    /// Units between a ball and the one ahead, less what the balls themselves take.
    #[inline(always)]
    pub(super) const fn gap(&self, position: u32, ahead: u32) -> u32 {
        ahead.wrapping_sub(self.pitch).wrapping_sub(position)
    }
}

/// Rooms in front of the balls, one after the other from the last ball backwards.
///
/// The room is the speed at which a ball would close the gap in front of it within the tick, over the nominal
/// speed: the gap over the nominal travel.
#[derive(Clone, Copy)]
pub(super) struct Rooms {
    /// Where the next ball touches the one in front.
    touching: u32,
    track: Track,
    /// 1 / nominal travel in this tick, 1/units.
    per_unit: f32,
}

impl Rooms {
    /// For balls behind the one at `ahead`, in a tick with a nominal travel in units.
    #[inline(always)]
    pub(super) fn behind(ahead: u32, track: Track, travel: f32) -> Self {
        let distance = travel.abs();
        Self {
            touching: ahead.wrapping_sub(track.pitch),
            track,
            per_unit: if distance > NO_TRAVEL {
                1.0 / distance
            } else {
                1.0 / NO_TRAVEL
            },
        }
    }

    /// Room of the next ball, which is at this position.
    #[inline(always)]
    pub(super) fn next(&mut self, position: u32) -> f32 {
        let gap = self.touching.wrapping_sub(position);
        self.touching = position.wrapping_sub(self.track.pitch);
        gap as f32 * self.per_unit
    }

    /// Room between two balls that may overlap by rounding, which is none.
    #[inline(always)]
    pub(super) fn without_overlap(&self, position: u32, ahead: u32) -> f32 {
        let gap = self.track.gap(position, ahead);
        let gap = if gap > u32::MAX - OVERLAP { 0 } else { gap };
        gap as f32 * self.per_unit
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Another track is told by its length or its pitch, in metres.
    #[test]
    fn another_track_is_named_in_metres() {
        let own = Track::new(0.25, 0.006, 30).unwrap();
        assert_eq!(own.is_same(&own), Ok(()));
        for (other, field, value, allowed) in [
            (Track::new(0.3, 0.006, 30), "length", 0.3, 0.25),
            (Track::new(0.25, 0.0061, 30), "pitch", 0.0061, 0.006),
        ] {
            let error = own.is_same(&other.unwrap()).unwrap_err();
            let near = |one: f32, other: f32| (one / other - 1.0).abs() < 3e-7;
            assert!(
                error.field() == field
                    && near(error.value(), value)
                    && matches!(error, Error::OutOfRange { allowed: range, .. }
                        if near(range.minimum, allowed) && near(range.maximum, allowed)),
                "{error}"
            );
        }
    }
}
