//! What a train keeps of one ball.

use super::grip::Grip;
use super::losses::RubbedBall;
use crate::error::Range;
use crate::stored::{Port, Refusal, Stored};

/// Forces that balls may press with, in the unit of speed times impedance: what 255 balls of the largest impedance do.
const FORCES: Range = Range::new(0.0, 1e12);

/// One ball of a train: 36 bytes, of which two words hold one thing after the other in the phases of a tick.
///
/// | | taken in | at the end of a cluster | settled |
/// |---|---|---|---|
/// | `speed` | free speed | free speed | actual speed |
/// | `slack` | slack | slack | rear ball of a cluster: the cluster's remainder |
/// | `force` | - | front ball: push; rear ball: inner slack | force on the ball in front |
/// | `of_cluster` | - | front ball: impedance; rear ball: the same, or where balls rub the tail | rear ball: impedance, as it weighs it |
/// | `others` | - | count over the cluster | the same |
///
/// A dash is what the last tick left, which nothing reads. Only the methods here touch the fields, each under the
/// name that its phase gives it; the other files read methods alone.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(super) struct Ball {
    speed: f32,
    impedance: f32,
    slack: f32,
    force: f32,
    of_cluster: f32,
    /// Part of the force behind it that the ball in front feels; 1 where no neighbour counts on it.
    transmitted: f32,
    /// Change of the friction torque with the speed, N m.
    torque_slope: f32,
    /// Place on the track, as a part of its length in units of 2^-32.
    position: u32,
    /// Sixteenths of a unit beyond the position, 0 to 15.
    sixteenths: u8,
    others: u8,
    /// Whether it counts in what the row loses.
    counts: bool,
}

const _: () = assert!(size_of::<Ball>() == 36);

/// Taken in: what the ball would do on its own.
impl Ball {
    /// At the nominal speed, without any force.
    pub(super) const IDLE: Self = Self {
        speed: 0.0,
        impedance: 1.0,
        slack: 0.0,
        force: 0.0,
        of_cluster: 0.0,
        transmitted: 1.0,
        torque_slope: 0.0,
        position: 0,
        sixteenths: 0,
        others: 0,
        counts: false,
    };

    /// Free speed, impedance and [`slack`](Self::slack).
    #[inline(always)]
    pub(super) fn take_in(&mut self, free_speed: f32, impedance: f32, slack: f32) {
        self.speed = free_speed;
        self.impedance = impedance;
        self.slack = slack;
    }

    /// A ball that neighbours rub on, and its [`slack`](Self::slack).
    #[inline(always)]
    pub(super) fn take_in_rubbed(&mut self, rubbed: &RubbedBall, slack: f32) {
        let grip = Grip::within(rubbed.grip);
        self.counts = rubbed.counts;
        self.transmitted = grip.transmitted();
        self.torque_slope = rubbed.torque_slope;
        self.take_in(rubbed.speed, rubbed.impedance * grip.of_impedance(), slack);
    }

    /// Change of its friction torque with its speed, N m.
    #[inline(always)]
    pub(super) fn torque_slope(&self) -> f32 {
        self.torque_slope
    }

    /// No neighbour counts on it.
    #[inline(always)]
    pub(super) fn set_smooth(&mut self) {
        self.counts = false;
        self.transmitted = 1.0;
    }

    /// Part of the force behind it that the ball in front feels.
    #[inline(always)]
    pub(super) fn transmitted(&self) -> f32 {
        self.transmitted
    }

    /// Whether it counts in what the row loses.
    #[inline(always)]
    pub(super) fn counts(&self) -> bool {
        self.counts
    }

    /// Puts in the slack alone, where the ball in front was not known when the ball was taken in.
    #[inline(always)]
    pub(super) fn set_slack(&mut self, slack: f32) {
        self.slack = slack;
    }

    /// Speed at which the ball would run on its own.
    #[inline(always)]
    pub(super) fn free_speed(&self) -> f32 {
        self.speed
    }

    /// Force that changes the ball's speed by one.
    #[inline(always)]
    pub(super) fn impedance(&self) -> f32 {
        self.impedance
    }

    /// How much faster the ball could be, against the one in front, before the two meet within the tick: the free
    /// speed of the one in front less its own, and the room between them. Negative where the ball would run into
    /// the one in front.
    #[inline(always)]
    pub(super) fn slack(&self) -> f32 {
        self.slack
    }

    /// Whether the ball would run into the one in front if both ran at their free speeds: the sign bit of the
    /// slack, which costs no floating-point comparison. It is set for -0 and may be for NaN as well; a cluster
    /// that begins with either takes in no ball (see `Cluster::reached_by`).
    #[inline(always)]
    pub(super) fn may_run_into_next(&self) -> bool {
        (self.slack.to_bits() as i32) < 0
    }
}

/// At the end of a cluster: what the two end balls hold for all.
impl Ball {
    /// Makes the ball a cluster of its own.
    #[inline(always)]
    pub(super) fn stand_alone(&mut self) {
        self.others = 0;
    }

    /// Makes the ball the rear one of a cluster with `others` more balls.
    #[inline(always)]
    pub(super) fn set_rear(&mut self, others: usize, tail: f32, inner_slack: f32) {
        self.force = inner_slack;
        self.of_cluster = tail;
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

    /// Impedance of the cluster of which this is the front ball, two balls or more.
    #[inline(always)]
    pub(super) fn cluster_impedance(&self) -> f32 {
        self.of_cluster
    }

    /// Tail of the cluster of which this is the rear ball, two balls or more.
    #[inline(always)]
    pub(super) fn tail(&self) -> f32 {
        self.of_cluster
    }

    /// Push of the cluster of which this is the front ball, two balls or more.
    #[inline(always)]
    pub(super) fn push(&self) -> f32 {
        self.force
    }

    /// Sum of the slacks between the balls of the cluster of which this is the rear ball, two balls or more.
    #[inline(always)]
    pub(super) fn inner_slack(&self) -> f32 {
        self.force
    }
}

/// Settled: what the ball does in this tick.
impl Ball {
    /// Leaves speed and force.
    #[inline(always)]
    pub(super) fn settle(&mut self, speed: f32, force: f32) {
        self.speed = speed;
        self.force = force;
    }

    /// A ball alone at its free speed, which presses on none.
    #[inline(always)]
    pub(super) fn settle_alone(&mut self) {
        self.force = 0.0;
    }

    /// Actual speed.
    #[inline(always)]
    pub(super) fn speed(&self) -> f32 {
        self.speed
    }

    /// Force between the ball and the one in front.
    #[inline(always)]
    pub(super) fn force(&self) -> f32 {
        self.force
    }

    /// Corrects the force.
    #[inline(always)]
    pub(super) fn set_force(&mut self, force: f32) {
        self.force = force;
    }

    /// Leaves in a rear ball what rounding made of the force that pushes it, exactly zero.
    #[inline(always)]
    pub(super) fn leave_remainder(&mut self, remainder: f32) {
        self.slack = remainder;
    }

    /// Leaves in a rear ball the cluster's impedance, as it weighs it.
    #[inline(always)]
    pub(super) fn leave_remainder_impedance(&mut self, impedance: f32) {
        self.of_cluster = impedance;
    }

    /// The cluster's impedance, as its rear ball weighs it.
    #[inline(always)]
    pub(super) fn remainder_impedance(&self) -> f32 {
        self.of_cluster
    }

    /// What [`Ball::leave_remainder`] left.
    #[inline(always)]
    pub(super) fn remainder(&self) -> f32 {
        self.slack
    }
}

/// Where the ball is: kept from tick to tick.
impl Ball {
    /// Place on the track, as a part of its length in units of 2^-32.
    #[inline(always)]
    pub(super) fn position(&self) -> u32 {
        self.position
    }

    /// Puts the ball at a place; sixteenths of a unit stay.
    #[inline(always)]
    pub(super) fn set_position(&mut self, position: u32) {
        self.position = position;
    }

    /// Sixteenths of a unit beyond the position, 0 to 15.
    #[inline(always)]
    pub(super) fn sixteenths(&self) -> i32 {
        i32::from(self.sixteenths)
    }

    /// Keeps the part of a number of sixteenths that is no whole unit.
    #[inline(always)]
    pub(super) fn keep_sixteenths(&mut self, sixteenths: i32) {
        self.sixteenths = (sixteenths & 15) as u8;
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
