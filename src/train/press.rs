//! Which balls of a train press on each other, and how hard: one exact pass.

use super::ball::{Ball, FreeBall};
use super::pool::pool;
use super::settle::{BallState, Pressing, balance, settle};
use crate::error::{Error, attempt, in_range};

/// Largest free speed that counts, a relative deviation: that of a ball that stands, or runs twice as fast as a nominal one.
pub const LARGEST_FREE_SPEED: f32 = 1.0;

/// Least and largest impedance that count, N: products of the sums over 255 balls, by which clusters are compared, are finite, and those of two
/// least ones are normal numbers. A ball of the bearing of Lin 2019, Table 3.3, has 500 N under 100 N.
pub const IMPEDANCE_RANGE: (f32, f32) = (1e-9, 1e9);

/// Whether all free speeds and impedances count, in integers and without a branch for each.
#[derive(Clone, Copy)]
pub(super) struct InputCheck {
    /// The sign bit is set where a number does not count.
    outside: u32,
}

impl InputCheck {
    /// Takes in the numbers of one ball. Numbers without a sign are in the order of their bits, NaN beyond all, so that a difference of bits
    /// is negative where the bound is passed; negative impedances fail one of their two bounds or the other.
    #[inline(always)]
    pub(super) fn add(&mut self, speed: f32, impedance: f32) {
        const FASTEST: u32 = LARGEST_FREE_SPEED.to_bits();
        const LEAST: u32 = IMPEDANCE_RANGE.0.to_bits();
        const MOST: u32 = IMPEDANCE_RANGE.1.to_bits();
        let impedance = impedance.to_bits();
        self.outside |= FASTEST.wrapping_sub(speed.abs().to_bits())
            | impedance.wrapping_sub(LEAST)
            | MOST.wrapping_sub(impedance);
    }

    #[inline(always)]
    pub(super) fn of(complete: bool) -> Self {
        Self {
            outside: if complete { 0 } else { 1 << 31 },
        }
    }

    #[inline(always)]
    pub(super) fn passed(self) -> bool {
        self.outside as i32 >= 0
    }
}

/// Speeds and forces of a train of up to `N` balls, 1 to 255, which touch or may touch.
///
/// Balls stand in a row, ball `j + 1` in front of ball `j`. Left alone, ball `j` runs at its free speed
/// `u_j`; a net push `P` makes it run at `u_j + Y_j P` with its compliance `Y_j`. The speed at which a
/// ball may run up to the one in front, the room `r_j`, is their distance over the time of a tick; no
/// ball passes through another:
///
/// ```text
/// v_j = u_j + Y_j (F_{j-1} - F_j),   F_j >= 0,   v_{j+1} - v_j + r_j >= 0,   F_j (v_{j+1} - v_j + r_j) = 0
/// ```
///
/// (Lin 2019, eqs. (3.31), (3.77), and (3.30), (3.76) of two balls, as complementarity on the actual speeds: the printed rule,
/// which lets the free speeds of two neighbours decide, makes chains of balls overlap.) These are the
/// optimality conditions of the isotonic regression `min sum (v_j - u_j)²/(2 Y_j)`, with the forces for
/// multipliers, and pooling adjacent violators solves it exactly, also on a ring ([`train`](crate::train)).
///
/// Speeds are deviations from a common nominal one over its size, signed along the row, also for a train that runs backwards. Scratch and
/// results are in the caller's memory.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Press<const N: usize> {
    /// Those beyond the count are not read.
    pub(super) places: [Ball; N],
    /// 1 to `N`.
    count: u8,
    pub(super) foremost: u8,
}

impl<const N: usize> Press<N> {
    const BALLS_FIT: () = assert!(N >= 1 && N <= 255, "a train has 1 to 255 balls");

    /// A train of `N` balls at rest, without forces.
    #[must_use]
    pub const fn new() -> Self {
        Self::of(N as u8)
    }

    /// A train of as many balls at rest.
    ///
    /// # Errors
    /// [`Error`] naming `balls` (1 to `N`).
    pub const fn with_balls(balls: usize) -> Result<Self, Error> {
        attempt!(in_range("balls", balls as f32, 1.0, N as f32));
        Ok(Self::of(balls as u8))
    }

    #[inline(always)]
    pub(crate) const fn of(count: u8) -> Self {
        let () = Self::BALLS_FIT;
        Self {
            places: [Ball::IDLE; N],
            count,
            foremost: count.saturating_sub(1),
        }
    }

    #[inline(always)]
    pub(super) fn balls(&self) -> &[Ball] {
        self.places
            .get(..usize::from(self.count))
            .unwrap_or_default()
    }

    #[inline(always)]
    pub(super) fn balls_mut(&mut self) -> &mut [Ball] {
        self.places
            .get_mut(..usize::from(self.count))
            .unwrap_or_default()
    }

    pub(super) const fn count(&self) -> u8 {
        self.count
    }

    #[inline(always)]
    pub(super) const fn last(&self) -> u8 {
        self.count.saturating_sub(1)
    }

    /// Force between ball `j` and the ball in front of it, in the unit of speed times impedance; the last one acts on the first ball.
    pub fn forces(&self) -> impl DoubleEndedIterator<Item = f32> + ExactSizeIterator + '_ {
        self.balls().iter().map(|ball| ball.force)
    }

    /// Actual speed of each ball.
    pub fn speeds(&self) -> impl DoubleEndedIterator<Item = f32> + ExactSizeIterator + '_ {
        self.balls().iter().map(|ball| ball.speed)
    }

    /// Index of a ball that does not press on the one in front of it: the last one, unless that does on a ring.
    pub const fn foremost(&self) -> usize {
        self.foremost as usize
    }

    /// Joins that the last pass needed, at most one less than the balls: what of its cost depends on data.
    pub fn joins(&self) -> usize {
        let mut joins = 0;
        let mut front = self.foremost();
        let mut left = usize::from(self.count);
        while left > 0 {
            let others = self.balls().get(front).map_or(0, Ball::others);
            joins += others;
            for _ in 0..=others {
                front = front.checked_sub(1).unwrap_or(usize::from(self.last()));
                left = left.saturating_sub(1);
            }
        }
        joins
    }

    /// Finds actual speeds and forces from free speeds, impedances `1/Y` and rooms.
    ///
    /// `room[j]` belongs to ball `j` and the one in front of it, the last one to the last ball and the first: infinite on an open track, zero or less
    /// is contact, NaN none. A ring without any room moves as one at the weighted mean speed, and its least force counts as zero. A ball that
    /// nothing drives has a small impedance: it goes along with its neighbours.
    ///
    /// Returns whether all balls have their numbers, all speeds lie within [`LARGEST_FREE_SPEED`] and all impedances within
    /// [`IMPEDANCE_RANGE`]; where not, all speeds and forces are zero.
    ///
    /// Largest error of a force over the largest force: 6e-7 for impedances that differ by up to a factor 4,
    /// against a complementarity solver in f64, 37 and 64 balls; 2.5e-6 for a factor 1e6, against an
    /// exhaustive search with up to 9 balls. Exact otherwise: at most `N - 1` joins, one division for each cluster of two or
    /// more balls. Cost for 37 balls: 8,600 modelled cycles.
    pub fn solve(&mut self, free: &[f32], impedance: &[f32], room: &[f32]) -> bool {
        let complete = free.len() == impedance.len();
        let inputs = free.iter().zip(impedance);
        self.solve_all(
            inputs.map(|(&speed, &impedance)| FreeBall::smooth(speed, impedance)),
            room,
            complete,
        )
    }

    /// As [`Self::solve`], for balls that rub on each other.
    pub fn solve_rubbing(&mut self, balls: &[FreeBall], room: &[f32]) -> bool {
        self.solve_all(balls.iter().copied(), room, true)
    }

    #[inline(always)]
    fn solve_all(
        &mut self,
        free: impl DoubleEndedIterator<Item = FreeBall> + ExactSizeIterator + Clone,
        room: &[f32],
        complete: bool,
    ) -> bool {
        let balls = usize::from(self.count);
        let mut check = InputCheck::of(complete && free.len() == balls && room.len() == balls);
        let mut ahead = free.clone().next().map_or(0.0, |first| first.speed);
        let inputs = free.zip(room);
        for (ball, (free, &room)) in self.balls_mut().iter_mut().zip(inputs).rev() {
            check.add(free.speed, free.impedance);
            let room = if room < 0.0 { 0.0 } else { room };
            ball.take_in(free, room + (ahead - free.speed));
            ahead = free.speed;
        }
        self.join(check.passed());
        self.settle(|_, _, _| ());
        check.passed()
    }

    /// Joins balls to clusters, or leaves all at the nominal speed where not all that was taken in counts.
    #[inline(never)]
    pub(super) fn join(&mut self, valid: bool) {
        if valid {
            self.foremost = pool(self.balls_mut()) as u8;
        } else {
            self.let_go();
        }
    }

    #[cold]
    #[inline(never)]
    fn let_go(&mut self) {
        for ball in self.balls_mut() {
            ball.take_in(FreeBall::smooth(0.0, 1.0), 0.0);
            ball.others = 0;
        }
        self.foremost = self.last();
    }

    #[inline(always)]
    pub(super) fn settle(
        &mut self,
        mut each: impl FnMut(usize, &mut Ball, &BallState),
    ) -> Pressing {
        let foremost = self.foremost();
        let balls = self.balls_mut();
        let pressing = settle(balls, foremost, |index, ball, settled| {
            (ball.speed, ball.force) = (settled.speed, settled.force);
            each(index, ball, settled);
        });
        balance(balls, foremost, &pressing);
        pressing
    }
}

impl<const N: usize> Default for Press<N> {
    fn default() -> Self {
        Self::new()
    }
}
