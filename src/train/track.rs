//! The closed track, and the positions of the balls on it from tick to tick, also as bytes.

use super::press::{Ball, Press};
use crate::error::{Error, Range, attempt, in_range};
use crate::stored::{Fingerprint, Port, Refusal, Stored};

/// Units of length on the track: positions wrap around where it closes.
pub(super) const UNITS: f32 = 4_294_967_296.0;

/// Largest travel in a tick over the length of the track: at the [largest free speed](super::LARGEST_FREE_SPEED) a ball's own travel beyond
/// it, in sixteenths of 2^-32 of the track, has to fit into 31 bits.
pub const LARGEST_TRAVEL: f32 = 0.03;

/// Distances this far below zero, in units, are contact: many times the rounding of two positions.
pub(super) const OVERLAP: u32 = 1 << 10;

/// Length of a closed track and of what a ball takes of it, checked for a number of balls.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(crate) struct Track {
    /// Distance of the centres of two balls in contact, in units.
    pitch: u32,
    /// Units in a metre.
    pub(super) units_per_metre: f32,
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

#[inline]
fn positions(balls: &[Ball]) -> impl ExactSizeIterator<Item = u32> + '_ {
    balls.iter().map(|ball| ball.position)
}

pub(crate) const BALL_BYTES: usize = Ball::BYTES;

/// Up to `N` balls on a closed track, which they fill in part: positions, distances, forces, from tick to tick.
///
/// Positions are integers, in units of the track's length over 2³²: they wrap around where the track closes, and distances that open and close
/// for hours do not drift. Balls that press on each other are set in contact exactly, the others within two units of where their speeds lead.
///
/// Free speeds are deviations from a common nominal speed, in units of its size: only the sense of motion and the distance travelled count
/// beside them. Forces follow from [`Press`].
///
/// ```
/// use epas_friction::train::Train;
/// // Three balls of 10 mm in contact on a track of 1 m, the fastest at the rear.
/// let mut train = Train::<3>::new(1.0, 0.01, &[0.0; 3])?;
/// train.step(&[0.02, 0.01, 0.0], &[1e3; 3], 1e-4);
/// assert!(train.forces().zip([10.0, 10.0, 0.0]).all(|(force, exact)| (force - exact).abs() < 1e-4));
/// // They go on as one, at the mean speed.
/// assert!(train.speeds().all(|speed| (speed - 0.01).abs() < 1e-7));
/// # Ok::<(), epas_friction::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Train<const N: usize> {
    /// Nominal travel that was less than a unit and goes over into the next tick, in units.
    pub(super) carried: f32,
    pub(super) press: Press<N>,
    pub(super) track: Track,
}

/// Two balls that press on each other.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct BallContact {
    /// Index of the ball behind; the one in front is the next, or ball 0.
    pub ball: u8,
    /// Position of the ball behind, as a part of the track's length in units of 2^-32.
    pub position: u32,
    /// Force between the two, in the unit of speed times impedance.
    pub force: f32,
}

impl<const N: usize> Train<N> {
    /// How many balls it has.
    pub const fn balls(&self) -> usize {
        self.press.count() as usize
    }

    /// Whether it has as many balls, on this track.
    pub(crate) const fn is_on(&self, track: &Track, balls: u16) -> Result<(), Error> {
        let own = self.balls() as f32;
        attempt!(in_range("balls", balls as f32, own, own));
        self.track.is_same(track)
    }

    /// Balls on a closed track of `length`, m, that stand `pitch`, m, from centre to centre in contact, as many as gaps: ball 0 starts at 0;
    /// `gaps[j]`, m, is left in front of ball `j`, in front of the last one whatever is left.
    ///
    /// # Errors
    /// [`Error`] naming `balls` (1 to `N`), `length` (1e-4 to 1e4), `pitch` (1e-6 of the length to that over the balls) or
    /// `gaps` (each zero or more, the last one not counted, all no more than the balls leave).
    pub fn new(length: f32, pitch: f32, gaps: &[f32]) -> Result<Self, Error> {
        in_range("balls", gaps.len() as f32, 1.0, N as f32)?;
        let track = Track::new(length, pitch, gaps.len())?;
        let mut free = (1_u64 << 32) - gaps.len() as u64 * u64::from(track.pitch());
        let mut train = Self::spread(track, gaps.len());
        let mut next = 0_u32;
        for (ball, &gap) in train.press.balls_mut().iter_mut().zip(gaps) {
            ball.position = next;
            let largest = free as f32 / track.units_per_metre;
            let gap = (in_range("gaps", gap, 0.0, largest)? * track.units_per_metre) as u64;
            let gap = if gap > free { free } else { gap };
            free -= gap;
            next = next.wrapping_add(track.pitch()).wrapping_add(gap as u32);
        }
        Ok(train)
    }

    /// As many balls at equal distances.
    pub fn evenly_spaced(length: f32, pitch: f32, balls: usize) -> Result<Self, Error> {
        in_range("balls", balls as f32, 1.0, N as f32)?;
        Ok(Self::spread(Track::new(length, pitch, balls)?, balls))
    }

    #[inline(always)]
    pub(crate) fn spread(track: Track, balls: usize) -> Self {
        // 2^32 over the balls, in 32 bits.
        let count = balls as u32;
        let less_one = count.wrapping_neg().checked_div(count).unwrap_or_default();
        let step = less_one.wrapping_add(1);
        let mut train = Self {
            carried: 0.0,
            press: Press::of(balls as u8),
            track,
        };
        // Over all places, beyond the balls too: the compiler knows how many.
        for (index, ball) in train.press.places.iter_mut().enumerate() {
            ball.position = step.wrapping_mul(index as u32);
        }
        train
    }

    /// Position of each ball, from the rear one to the front one, in units of 2^-32 of the track's length.
    #[inline]
    pub fn positions(&self) -> impl ExactSizeIterator<Item = u32> + '_ {
        positions(self.press.balls())
    }

    /// Distance in front of each ball, m: zero in contact, up to a few units below by rounding.
    pub fn gaps(&self) -> impl Iterator<Item = f32> + '_ {
        let metres_per_unit = 1.0 / self.track.units_per_metre;
        let ahead = self.positions().skip(1).chain(self.positions().take(1));
        self.positions().zip(ahead).map(move |(position, ahead)| {
            let gap = self.track.gap(position, ahead);
            if gap > u32::MAX - OVERLAP {
                (gap as i32) as f32 * metres_per_unit
            } else {
                gap as f32 * metres_per_unit
            }
        })
    }

    /// Force between each ball and the one in front of it, in the unit of speed times impedance; of the last one and the first.
    #[inline]
    pub fn forces(&self) -> impl DoubleEndedIterator<Item = f32> + ExactSizeIterator + '_ {
        self.press.forces()
    }

    /// Actual speed of each ball in the last tick, as the free speeds are counted.
    #[inline]
    pub fn speeds(&self) -> impl DoubleEndedIterator<Item = f32> + ExactSizeIterator + '_ {
        self.press.speeds()
    }

    /// Pairs of balls that press on each other, from the rear of the train on.
    pub fn contacts(&self) -> heapless::Vec<BallContact, N> {
        self.positions()
            .zip(self.forces())
            .enumerate()
            .filter(|(_, (_, force))| *force > 0.0)
            .map(|(ball, (position, force))| BallContact {
                ball: ball as u8,
                position,
                force,
            })
            .collect()
    }

    /// Whether the balls follow each other once around the track, none of them within the next. The last ball and the foremost one may be by
    /// a rounding: they are moved before the balls in front of them.
    pub(crate) fn in_order(&self) -> Result<(), Refusal> {
        let ahead = self.positions().skip(1).chain(self.positions().take(1));
        let around: i64 = self
            .positions()
            .zip(ahead)
            .enumerate()
            .map(|(index, (position, ahead))| {
                let gap = self.track.gap(position, ahead);
                let rounds =
                    index == usize::from(self.press.last()) || index == self.press.foremost();
                let gap = if rounds && gap > u32::MAX - OVERLAP {
                    i64::from(gap.cast_signed())
                } else {
                    i64::from(gap)
                };
                gap + i64::from(self.track.pitch())
            })
            .sum();
        if around == 1 << 32 {
            Ok(())
        } else {
            Err(Refusal::OutOfRange { field: "position" })
        }
    }
}

impl<const N: usize> Stored for Train<N> {
    const BYTES: usize = 4 + 1 + N * BALL_BYTES;

    /// The track stays that of the constants.
    fn exchange<P: Port>(&mut self, port: &mut P) -> Result<(), Refusal> {
        port.number("carried", &mut self.carried, Range::new(-1.0, 1.0))?;
        let last = self.press.last();
        port.count("foremost", &mut self.press.foremost, last)?;
        self.press
            .balls_mut()
            .iter_mut()
            .try_for_each(|ball| ball.exchange(port))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_overlap_by_rounding_is_a_gap_just_below_zero() {
        let mut train = Train::<2>::new(1.0, 0.01, &[0.0; 2]).unwrap();
        let rear = &mut train.press.balls_mut()[0];
        rear.position = rear.position.wrapping_add(3);
        // Three of 2^32 units to a metre.
        let gap = train.gaps().next().unwrap();
        assert!((gap + 3.0 / 4_294_967_296.0).abs() < 1e-15, "{gap}");
    }

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
