//! A ball as a train takes it in, and as it keeps it.
use crate::error::Range;
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
    /// Force behind the ball by its own deviation from its free speed: `Z'` of [`FreeBall`].
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

#[cfg(test)]
mod tests {
    use super::super::press::Press;
    use super::FreeBall;

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
