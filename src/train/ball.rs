//! What a train keeps of one ball.

use super::grip::FreeBall;
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
///
/// A dash is what the last tick left, which nothing reads.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(super) struct Ball {
    pub(super) speed: f32,
    /// Force behind the ball by its own deviation from its free speed: `Z'` of [`FreeBall`].
    pub(super) impedance: f32,
    /// Force behind the ball over that in front, at its free speed; 1 where no neighbour rubs on it.
    pub(super) growth: f32,
    /// How much faster the ball could be, against the one in front, before the two meet within the tick: the free
    /// speed of the one in front less its own, and the room between them. Negative where it would run into that one.
    pub(super) slack: f32,
    pub(super) force: f32,
    pub(super) of_cluster: f32,
    /// Place on the track, as a part of its length in units of 2^-32.
    pub(super) position: u32,
    /// Sixteenths of a unit beyond the position, 0 to 15.
    pub(super) sixteenths: u8,
    others: u8,
    /// Part of the friction that its contact with the ball behind has, in units of 2^-15.
    rubs: u16,
}

const _: () = assert!(size_of::<Ball>() == 32);

impl Ball {
    /// At the nominal speed, without any force.
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

    /// What the ball would do on its own, and its slack.
    #[inline(always)]
    pub(super) fn take_in(&mut self, free: FreeBall, slack: f32) {
        self.speed = free.speed;
        self.impedance = free.impedance;
        self.growth = free.growth;
        self.slack = slack;
    }

    /// What it was taken in with.
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

    /// That part.
    #[inline(always)]
    pub(super) fn rubs(&self) -> f32 {
        f32::from(self.rubs) / f32::from(WHOLE)
    }

    /// Whether the ball would run into the one in front if both ran at their free speeds: the sign bit of the
    /// slack, which costs no floating-point comparison. It is set for -0 and may be for NaN as well; a cluster
    /// that begins with either takes in no ball (see `Cluster::reached_by`).
    #[inline(always)]
    pub(super) fn may_run_into_next(&self) -> bool {
        (self.slack.to_bits() as i32) < 0
    }

    /// Makes the ball a cluster of its own.
    #[inline(always)]
    pub(super) fn stand_alone(&mut self) {
        self.others = 0;
    }

    /// Makes the ball the rear one of a cluster with `others` more balls.
    #[inline(always)]
    pub(super) fn set_rear(&mut self, others: usize, growth: f32, inner_slack: f32) {
        self.force = inner_slack;
        self.of_cluster = growth;
        self.others = others as u8;
    }

    /// Makes the ball the front one of a cluster with `others` more balls.
    #[inline(always)]
    pub(super) fn set_front(&mut self, others: usize, impedance: f32, push: f32) {
        self.force = push;
        self.of_cluster = impedance;
        self.others = others as u8;
    }

    /// Balls of the cluster besides this one, of which this is the rear or the front ball.
    #[inline(always)]
    pub(super) fn others(&self) -> usize {
        usize::from(self.others)
    }

    /// Leaves speed and force.
    #[inline(always)]
    pub(super) fn settle(&mut self, speed: f32, force: f32) {
        self.speed = speed;
        self.force = force;
    }

    /// Leaves in a rear ball what rounding made of the force that pushes it, exactly zero, and the cluster's impedance.
    #[inline(always)]
    pub(super) fn leave_remainder(&mut self, remainder: f32, impedance: f32) {
        self.slack = remainder;
        self.of_cluster = impedance;
    }
}

/// Place and force are kept; the rest is of one tick.
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
