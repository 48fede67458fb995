//! The balls of a train, which of them press on each other, and how hard: one exact pass.

use super::pool::{BallState, Pressing, ROUNDING, pool, settle, take_out};
use crate::error::{Error, Range, attempt, in_range};
use crate::stored::{Port, Refusal, Stored};

/// Forces that balls may press with, in the unit of speed times impedance: what 255 balls of the largest impedance do.
const FORCES: Range = Range::new(0.0, 1e12);

/// All of the friction in [`Ball::rubs`].
const WHOLE: u16 = 1 << 15;

/// One ball of a train: 32 bytes, of which some words hold one thing after the other in the phases of a tick.
///
/// | | taken in | at the end of a cluster | settled |
/// |---|---|---|---|
/// | `speed` | free speed | free speed | actual speed |
/// | `slack` | slack | slack | rear ball of a cluster: the cluster's remainder |
/// | `force` | - | front ball: push; rear ball: inner slack | force on the ball in front |
/// | `of_cluster` | - | front ball: impedance; rear ball: growth | rear ball: impedance |
/// | `others` | - | count over the cluster | the same |
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(super) struct Ball {
    pub(super) speed: f32,
    /// `Z'` of [`FreeBall`].
    pub(super) impedance: f32,
    /// Force behind the ball over that in front, at its free speed; 1 where no neighbour rubs on it.
    pub(super) growth: f32,
    /// Free speed of the ball in front less its own, and the room between them. Negative where it would run into that one.
    pub(super) slack: f32,
    pub(super) force: f32,
    pub(super) of_cluster: f32,
    /// Place on the track, as a part of its length in units of 2^-32.
    pub(super) position: u32,
    /// Sixteenths of a unit beyond the position, 0 to 15.
    pub(super) sixteenths: u8,
    /// Balls of the cluster besides this one, of which this is the rear or the front ball; 0 of a ball alone.
    pub(super) others: u8,
    /// Part of the friction that its contact with the ball behind has, in units of 2^-15.
    rubs: u16,
}

const _: () = assert!(size_of::<Ball>() == 32);

impl Ball {
    pub(super) const IDLE: Self = Self {
        speed: 0.0,
        impedance: 1.0,
        growth: 1.0,
        slack: 0.0,
        force: 0.0,
        of_cluster: 0.0,
        position: 0,
        sixteenths: 0,
        others: 0,
        rubs: WHOLE,
    };

    #[inline(always)]
    pub(super) fn take_in(&mut self, free: FreeBall, slack: f32) {
        self.speed = free.speed;
        self.impedance = free.impedance;
        self.growth = free.growth;
        self.slack = slack;
    }

    #[inline(always)]
    pub(super) fn free(&self) -> FreeBall {
        FreeBall {
            speed: self.speed,
            impedance: self.impedance,
            growth: self.growth,
        }
    }

    /// Puts in the part of the friction that its contact with the ball behind has, 0 to 1.
    #[inline(always)]
    pub(super) fn set_rubs(&mut self, part: f32) {
        self.rubs = (part * f32::from(WHOLE)) as i32 as u16;
    }

    #[inline(always)]
    pub(super) fn rubs(&self) -> f32 {
        f32::from(self.rubs) / f32::from(WHOLE)
    }

    /// Whether the ball would run into the one in front if both ran at their free speeds: the sign bit of the
    /// slack, without a floating-point comparison. A cluster that begins with -0 or NaN takes in no ball.
    #[inline(always)]
    pub(super) fn may_run_into_next(&self) -> bool {
        (self.slack.to_bits() as i32) < 0
    }

    #[inline(always)]
    pub(super) fn others(&self) -> usize {
        usize::from(self.others)
    }
}

impl Stored for Ball {
    const BYTES: usize = 9;

    fn exchange<P: Port>(&mut self, port: &mut P) -> Result<(), Refusal> {
        let Self {
            mut position,
            mut sixteenths,
            mut force,
            ..
        } = *self;
        port.word(&mut position)?;
        port.count("sixteenths", &mut sixteenths, 15)?;
        port.number("force", &mut force, FORCES)?;
        *self = Self {
            force,
            position,
            sixteenths,
            ..Self::IDLE
        };
        Ok(())
    }
}

/// Largest size of a grip: with it a force falls or grows by 1.9 from ball to ball.
pub const LARGEST_GRIP: f32 = 0.3;

/// A ball on its own, and the grip of its neighbours' friction. With the speed `v` it needs the net push
///
/// ```text
/// F_behind - F_ahead = Z (v - u) + r (F_behind + F_ahead)
/// ```
///
/// with its free speed `u`, its impedance `Z` and the grip `r`. With `g = (1 + r)/(1 - r)` and `Z' = Z/(1 - r)` that is
/// `F_behind = g F_ahead + Z' (v - u)`: the train of balls that do not rub, but for a factor from ball to ball. Seen from
/// the rear ball of a cluster, each net push grows by the factors of all balls behind its own; so weighed, they add up to zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FreeBall {
    pub(crate) speed: f32,
    /// `Z'`.
    pub(crate) impedance: f32,
    /// `g`.
    pub(crate) growth: f32,
}

impl FreeBall {
    /// A ball that no neighbour rubs on, of a free speed and an impedance.
    #[inline(always)]
    #[must_use]
    pub const fn smooth(speed: f32, impedance: f32) -> Self {
        Self {
            speed,
            impedance,
            growth: 1.0,
        }
    }

    /// A ball that needs the net push `impedance (v - at) + push + grip (F_behind + F_ahead)`, with a grip of at most [`LARGEST_GRIP`] in size.
    #[inline(always)]
    #[must_use]
    pub fn rubbed(at: f32, impedance: f32, push: f32, grip: f32) -> Self {
        let (passed, kept) = (1.0 + grip, 1.0 - grip);
        let inverse = 1.0 / (impedance * kept);
        let stiff = impedance * inverse;
        Self {
            speed: at - push * (kept * inverse),
            impedance: impedance * stiff,
            growth: passed * stiff,
        }
    }
}

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

    /// Gives each ball its actual speed and force, and passes it on. Remainders of more than a part of the largest force are taken out.
    #[inline(always)]
    pub(super) fn settle(
        &mut self,
        mut each: impl FnMut(usize, &mut Ball, &BallState),
    ) -> Pressing {
        let foremost = self.foremost();
        let balls = self.balls_mut();
        let pressing = settle(balls, foremost, |index, ball, settled| {
            (ball.speed, ball.force) = (settled.neighbours.speed, settled.force);
            each(index, ball, settled);
        });
        let least = ROUNDING * pressing.largest;
        if pressing.remainder > least {
            take_out(balls, foremost, least);
        }
        pressing
    }
}

impl<const N: usize> Default for Press<N> {
    fn default() -> Self {
        Self::new()
    }
}

#[cfg(test)]
mod tests {
    use super::{FreeBall, Press};

    const BALLS: usize = 9;

    fn random(seed: &mut u32) -> f32 {
        *seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (*seed >> 8) as f32 / 16_777_216.0
    }

    /// What was solved meets its conditions: each ball's push, no pull, none that overtakes, and no force where balls part.
    #[test]
    fn rubbing_balls_are_in_balance() {
        let rounds = if cfg!(miri) { 20 } else { 2_000 };
        let mut seed = 1;
        let mut pressing = 0;
        for round in 0..rounds {
            let free: [f32; BALLS] = core::array::from_fn(|_| 0.1 * random(&mut seed) - 0.05);
            let impedance: [f32; BALLS] =
                core::array::from_fn(|_| 200.0 + 800.0 * random(&mut seed));
            let mut room: [f32; BALLS] = core::array::from_fn(|_| {
                let room = 0.03 * random(&mut seed) - 0.02;
                if room > 0.0 { room } else { 0.0 }
            });
            // A ring keeps a gap somewhere, and so does a row.
            room[round % BALLS] = if round % 2 == 0 { f32::INFINITY } else { 0.08 };
            let grip: [f32; BALLS] = core::array::from_fn(|_| 0.6 * random(&mut seed) - 0.3);
            let mut press = Press::<BALLS>::new();
            let balls: [FreeBall; BALLS] =
                core::array::from_fn(|j| FreeBall::rubbed(free[j], impedance[j], 0.0, grip[j]));
            assert!(press.solve_rubbing(&balls, &room));
            let forces: [f32; BALLS] = core::array::from_fn(|j| press.forces().nth(j).unwrap());
            let speeds: [f32; BALLS] = core::array::from_fn(|j| press.speeds().nth(j).unwrap());
            let largest = forces.iter().copied().fold(0.0, f32::max);
            for j in 0..BALLS {
                let behind = forces[(j + BALLS - 1) % BALLS];
                let push = behind - forces[j];
                let needed = impedance[j] * (speeds[j] - free[j]) + grip[j] * (behind + forces[j]);
                // Roundings of the forces, 1e-6 of the largest, and of the speeds, 1e-8 of up to 0.1 times 1000 N.
                let left = (push - needed).abs();
                assert!(
                    left <= 1e-5 * largest + 2e-5,
                    "{round} {j}: {push} {needed}"
                );
                let parts = speeds[(j + 1) % BALLS] - speeds[j] + room[j];
                assert!(forces[j] >= 0.0 && parts > -1e-7, "{round} {j}: {parts}");
                assert!(
                    forces[j] <= 1e-6 * largest || parts < 1e-7,
                    "{round} {j}: {parts}"
                );
                pressing += usize::from(forces[j] > 0.0);
            }
        }
        assert!(pressing > rounds * BALLS / 3, "{pressing}");
    }

    /// Without friction between balls the answer is that of balls that do not rub, to the bit but for one rounding of each number.
    #[test]
    fn no_grip_is_no_friction() {
        let free = [0.02, 0.01, 0.03, -0.01, 0.0, 0.02, -0.03, 0.01, -0.02];
        let (mut smooth, mut rubbing) = (Press::<BALLS>::new(), Press::<BALLS>::new());
        let room = [0.0, 0.0, 1e-3, 0.0, 0.0, 0.0, 0.0, 2e-3, f32::INFINITY];
        assert!(smooth.solve(&free, &[500.0; BALLS], &room));
        let balls = free.map(|speed| FreeBall::rubbed(speed, 500.0, 0.0, 0.0));
        assert!(rubbing.solve_rubbing(&balls, &room));
        for (one, other) in smooth.forces().zip(rubbing.forces()) {
            assert!((one - other).abs() < 1e-5, "{one} {other}");
        }
    }
}
