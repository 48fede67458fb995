//! The closed track: its units of length, how much room balls have on it, and how far they get in a tick.

use super::ball::Ball;
use crate::error::{Error, attempt, in_range};
use crate::stored::Fingerprint;

/// Units of length on the track: positions wrap around where it closes.
const UNITS: f32 = 4_294_967_296.0;

/// Largest travel in a tick over the length of the track: at the [largest free speed](super::LARGEST_FREE_SPEED) a ball's own travel beyond
/// it, in sixteenths of 2^-32 of the track, has to fit into 31 bits.
pub const LARGEST_TRAVEL: f32 = 0.03;

/// Nominal travel, in units, below which it counts as none: its inverse times a gap of the whole track, 2^32 units, is finite.
const NO_TRAVEL: f32 = 1e-20;

/// A position keeps sixteenths of a unit: slow balls move by less than a unit in a tick.
pub(super) const SIXTEENTHS: f32 = 16.0;
const SIXTEENTH_BITS: u32 = 4;

/// Distances this far below zero, in units, are contact: many times the rounding of two positions.
pub(super) const OVERLAP: u32 = 1 << 10;

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
    pub(crate) const fn new(length: f32, pitch: f32, balls: usize) -> Result<Self, Error> {
        attempt!(in_range("length", length, 1e-4, 1e4));
        let longest = length / balls as f32;
        attempt!(in_range("pitch", pitch, 1e-6 * length, longest));
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
    pub(super) const fn is_same(&self, other: &Self) -> Result<(), Error> {
        let (own, others) = (UNITS / self.units_per_metre, UNITS / other.units_per_metre);
        attempt!(in_range("length", others, own, own));
        let per_unit = 1.0 / self.units_per_metre;
        let pitch = self.pitch as f32 * per_unit;
        let others = other.pitch as f32 * per_unit;
        attempt!(in_range("pitch", others, pitch, pitch));
        Ok(())
    }

    #[inline(always)]
    pub(super) const fn pitch(&self) -> u32 {
        self.pitch
    }

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

    pub(crate) fn fingerprint(&self, fingerprint: &mut Fingerprint) {
        fingerprint.count(self.pitch);
        fingerprint.number(self.units_per_metre);
    }
}

/// Slacks of balls that come one after the other, each behind the one before it: the room in front of a ball, the gap over the nominal travel (0
/// where rounding lets two balls overlap), and the free speed of the one ahead less its own.
#[derive(Clone, Copy)]
pub(super) struct Slacks {
    track: Track,
    /// 1 / nominal travel in this tick, 1/units.
    per_unit: f32,
    /// Position and free speed of the ball ahead.
    ahead: (u32, f32),
}

impl Slacks {
    /// In a tick with a nominal travel in units. The first ball comes once more at the end, when the one ahead of it is known.
    #[inline(always)]
    pub(super) fn new(track: Track, travel: f32) -> Self {
        let distance = travel.abs();
        Self {
            track,
            per_unit: if distance > NO_TRAVEL {
                1.0 / distance
            } else {
                1.0 / NO_TRAVEL
            },
            ahead: (0, 0.0),
        }
    }

    #[inline(always)]
    pub(super) fn next(&mut self, position: u32, speed: f32) -> f32 {
        let (ahead, speed_ahead) = self.ahead;
        let gap = self.track.gap(position, ahead);
        let gap = if gap > u32::MAX - OVERLAP { 0 } else { gap };
        self.ahead = (position, speed);
        gap as f32 * self.per_unit + (speed_ahead - speed)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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

#[derive(Clone, Copy)]
pub(super) struct Motion {
    /// Whole units that the nominal speed moves every ball, signed along the track.
    pub(super) nominal: u32,
    /// Sixteenths of a unit by which a ball moves beyond that, over its speed.
    pub(super) sixteenths_per_speed: f32,
    /// Distance of the centres of two balls in contact, in units.
    pub(super) pitch: u32,
}

impl Motion {
    /// A place that no ball comes near in this tick, a quarter of the track in front of where this one goes.
    #[inline(always)]
    pub(super) fn far_ahead(&self, ball: &Ball) -> u32 {
        ball.position
            .wrapping_add(self.nominal.wrapping_add(1 << 30))
    }

    /// Moves a ball by its speed, at most to `limit`, where it touches the one in front; gives the limit of the one behind.
    #[inline(always)]
    pub(super) fn advance(&self, ball: &mut Ball, limit: u32) -> u32 {
        let sixteenths = (ball.speed * self.sixteenths_per_speed) as i32;
        let sixteenths = sixteenths.wrapping_add(i32::from(ball.sixteenths));
        let place = ball.position.wrapping_add(self.nominal);
        let place = place.wrapping_add_signed(sixteenths >> SIXTEENTH_BITS);
        // Clusters do not run into each other, but rounding may leave that much.
        let place = if limit.wrapping_sub(place) > u32::MAX - OVERLAP {
            limit
        } else {
            place
        };
        ball.position = place;
        ball.sixteenths = (sixteenths & 15) as u8;
        self.touching(place)
    }

    /// Where the ball behind touches one at a place.
    #[inline(always)]
    pub(super) fn touching(&self, place: u32) -> u32 {
        place.wrapping_sub(self.pitch)
    }
}
