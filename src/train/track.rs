//! Where the balls of a train are, and how they get on.

use super::ball::Ball;
use super::pool::{FRACTIONS, Moves, OVERLAP, Pressing};
use super::press::Press;
use crate::error::{Error, attempt, in_range};

/// Units of length on the track: positions wrap around where it closes.
const UNITS: f32 = 4_294_967_296.0;

/// Largest travel in a tick over the length of the track that counts.
pub const LARGEST_TRAVEL: f32 = 0.03;

/// Balls on a closed track, which they fill in part: positions, distances, forces, from tick to tick.
///
/// Positions are integers, in units of the track's length over 2³² (a tenth of a nanometre on half a
/// metre): they wrap around where the track closes, and distances that open and close for hours do not
/// drift. Balls that press on each other are set in contact exactly, the others are within two units of
/// where their speeds lead, so that no overlap grows.
///
/// What the balls would do on their own comes as deviations from a common nominal speed, in units of its
/// size, and the forces follow from [`Press`]: nothing here depends on the size of the speed, only on the
/// sense of motion and on the way travelled.
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
    /// What of the nominal travel is not yet a whole unit.
    rest: f32,
    pub(super) press: Press<N>,
    track: Track,
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

/// Length of a closed track and of what a ball takes of it, checked for a number of balls.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(crate) struct Track {
    /// Distance of the centres of two balls in contact, in units.
    pitch: u32,
    /// Units in a metre.
    units: f32,
}

impl Track {
    pub(crate) const fn new(length: f32, pitch: f32, balls: usize) -> Result<Self, Error> {
        attempt!(in_range("length", length, 1e-4, 1e4));
        attempt!(in_range(
            "pitch",
            pitch,
            1e-6 * length,
            length / balls as f32
        ));
        let units = UNITS / length;
        let pitch = (pitch * units) as u32;
        // f32 holds the pitch to 2^-24; balls that fill the track must not overfill it by that.
        let pitch = match (1_u64 << 32).checked_div(balls as u64) {
            Some(fits) if (pitch as u64) > fits => fits as u32,
            _ => pitch,
        };
        Ok(Self { pitch, units })
    }
}

impl<const N: usize> Train<N> {
    /// Balls on a closed track of `length`, m, that stand `pitch`, m, from centre to centre in contact:
    /// on a straight track the ball diameter, on a helix the arc over it. Ball 0 starts at 0; `gaps[j]`,
    /// m, is left in front of ball `j`, in front of the last one whatever is left.
    ///
    /// # Errors
    /// [`Error`] naming `length` (1e-4 to 1e4), `pitch` (1e-6 of the length to its `N`-th part) or
    /// `gaps` (each zero or more, the last one not counted, all no more than the balls leave).
    pub fn new(length: f32, pitch: f32, gaps: &[f32; N]) -> Result<Self, Error> {
        let track = Track::new(length, pitch, N)?;
        let mut room = (1_u64 << 32) - N as u64 * u64::from(track.pitch);
        let mut position = [0; N];
        let mut next = 0_u32;
        for (place, &gap) in position.iter_mut().zip(gaps) {
            *place = next;
            let last = room as f32 / track.units;
            let gap = (in_range("gaps", gap, 0.0, last)? * track.units) as u64;
            let gap = if gap > room { room } else { gap };
            room -= gap;
            next = next.wrapping_add(track.pitch).wrapping_add(gap as u32);
        }
        Ok(Self::at(position, track))
    }

    /// Balls at equal distances.
    ///
    /// # Errors
    /// As [`Train::new`].
    pub fn evenly_spaced(length: f32, pitch: f32) -> Result<Self, Error> {
        Ok(Self::spread(Track::new(length, pitch, N)?))
    }

    pub(crate) fn spread(track: Track) -> Self {
        let step = (1_u64 << 32) / N as u64;
        Self::at(
            core::array::from_fn(|ball| (ball as u64 * step) as u32),
            track,
        )
    }

    fn at(position: [u32; N], track: Track) -> Self {
        let mut press = Press::new();
        for (ball, place) in press.balls.iter_mut().zip(position) {
            ball.position = place;
        }
        Self {
            rest: 0.0,
            press,
            track,
        }
    }

    /// Position of each ball, from the rear one to the front one, as a part of the track's length in
    /// units of 2^-32.
    #[inline]
    pub fn positions(&self) -> impl Iterator<Item = u32> + '_ {
        self.press.balls.iter().map(|ball| ball.position)
    }

    /// Distance in front of each ball, m: zero in contact, up to a few units below by rounding.
    pub fn gaps(&self) -> impl Iterator<Item = f32> + '_ {
        let metre = 1.0 / self.track.units;
        self.distances().map(move |distance| {
            if distance > u32::MAX - OVERLAP {
                (distance as i32) as f32 * metre
            } else {
                distance as f32 * metre
            }
        })
    }

    /// Force between each ball and the one in front of it, in the unit of speed times impedance; the last
    /// one acts between the last ball and the first.
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
    #[must_use]
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

    /// Joins of clusters that the last tick needed, at most `N - 1`.
    #[inline]
    #[must_use]
    pub fn joins(&self) -> usize {
        self.press.joins()
    }

    /// Moves the train by one tick.
    ///
    /// `travel`, m, is the nominal way of a ball in this tick, signed along the track. `free[j]` is the
    /// speed ball `j` would take on its own, less the nominal one, over the size of the nominal one;
    /// `impedance[j]` the force that takes all of the nominal speed from it, N. Speeds are signed along
    /// the track: of a train that runs backwards, a ball that is faster than the nominal one has a negative
    /// speed.
    ///
    /// Without travel the forces are those with which motion sets in; what the free speeds' signs say
    /// then is up to the caller. A travel that is NaN counts as zero, one beyond [`LARGEST_TRAVEL`] of
    /// the track as that. Speeds and impedances as in [`Press::solve`], whose answer is returned: where it
    /// is false, all balls move with the nominal speed and press on none.
    pub fn step(&mut self, free: &[f32; N], impedance: &[f32; N], travel: f32) -> bool {
        let travel = self.counted(travel);
        let mut room = self.room(travel);
        let sound = self
            .press
            .take(free, impedance, |_, ball| room.next(ball.position));
        self.without_overlap(room);
        self.press.join(sound);
        self.advance(travel);
        sound
    }

    /// Slacks of the two balls that the pass over all balls leaves: the last one, whose front ball comes at the
    /// pass's end, and the one that was foremost, which alone may have come too far by rounding.
    #[inline(always)]
    pub(super) fn without_overlap(&mut self, room: Room) {
        let last = N - 1;
        let foremost = self.press.foremost();
        for index in [last, foremost] {
            let ahead = if index == last { 0 } else { index + 1 };
            let Some(&Ball {
                position, speed, ..
            }) = self.press.balls.get(ahead)
            else {
                continue;
            };
            if let Some(ball) = self.press.balls.get_mut(index) {
                let distance = position
                    .wrapping_sub(room.pitch)
                    .wrapping_sub(ball.position);
                let way = without_rounding(distance) as f32 * room.per_unit;
                ball.slack = way + (speed - ball.speed);
            }
        }
    }

    #[inline(always)]
    pub(super) fn room(&self, travel: f32) -> Room {
        let way = travel.abs();
        let pitch = self.track.pitch;
        let first = self.press.balls.first().map_or(0, |ball| ball.position);
        Room {
            touching: first.wrapping_sub(pitch),
            pitch,
            per_unit: if way > 1e-20 { 1.0 / way } else { 1e20 },
        }
    }

    /// Travel in units.
    #[inline]
    pub(super) fn counted(&self, travel: f32) -> f32 {
        let travel = travel * self.track.units;
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

    /// Finds speeds and forces and moves the balls.
    #[inline(always)]
    pub(super) fn advance(&mut self, travel: f32) -> Pressing {
        let way = if travel < 0.0 { -travel } else { travel };
        let travel = travel + self.rest;
        let whole = travel as i32;
        self.rest = travel - whole as f32;
        self.press.settle(Moves {
            whole: whole as u32,
            scale: way * FRACTIONS,
            pitch: self.track.pitch,
        })
    }

    /// Distances in front of the balls, in units.
    #[inline]
    fn distances(&self) -> impl Iterator<Item = u32> + '_ {
        let pitch = self.track.pitch;
        let first = self.press.balls.first().map_or(0, |ball| ball.position);
        let ahead = self.press.balls.iter().skip(1).map(|ball| ball.position);
        self.press
            .balls
            .iter()
            .zip(ahead.chain(core::iter::once(first)))
            .map(move |(ball, ahead)| ahead.wrapping_sub(ball.position).wrapping_sub(pitch))
    }
}

/// Speeds at which balls may run up to the ones in front, from the last ball on.
#[derive(Clone, Copy)]
pub(super) struct Room {
    /// Where the next ball touches the one in front.
    touching: u32,
    pitch: u32,
    /// One over the way of the nominal speed in this tick, in units.
    per_unit: f32,
}

impl Room {
    #[inline(always)]
    pub(super) fn next(&mut self, place: u32) -> f32 {
        let distance = self.touching.wrapping_sub(place);
        self.touching = place.wrapping_sub(self.pitch);
        distance as f32 * self.per_unit
    }
}

/// A distance in units, none where it is below zero by rounding.
#[inline(always)]
const fn without_rounding(distance: u32) -> u32 {
    if distance > u32::MAX - OVERLAP {
        0
    } else {
        distance
    }
}
