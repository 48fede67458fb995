//! One ball that stands for all balls of a screw that are alike: no deviations, no neighbour that presses.

use super::constants::BallConstants;
use super::renewal::{BallInputs, Settled};
use super::stored::{CLEARANCE, NOT_NEGATIVE};
use crate::ball::preload::preload_counted;
use crate::error::Range;
use crate::ranges;
use crate::stored::{Port, Refusal, Stored};

/// Axial load of a ball below which it counts as this, N: below it friction is taken in proportion to the load. The law over
/// the load ends there as well, at 0.008 N of 1000 N.
pub(crate) const SMALLEST_LOAD: f32 = 0.01;

/// Change of the contact force from which on the ball begins anew, as [`NominalBall::apart`] counts it: a factor of 2.7 to 3.
///
/// A start has to settle, which is flagged, and Newton's method follows small changes without. After jumps of the load by 2.5
/// 23 % of the ticks are flagged at factors of 1.5 and 2 without a gap and with play, 18 % from 3 on; after jumps by ten 19, 20, 22,
/// 24, 28 and 30 % at 1.5, 2, 3, 4, 6 and 10 with preload, 25 % up to 6 and 32 % at 10 without a gap. What is not flagged is the
/// same with all. Scans here and below: the 72 screws of `ring::chosen`, without deviations, as a caged one whose balls are
/// renewed in every tick, against its law over the load.
const LOAD_JUMP: u32 = 3 << 22;

/// Change of the contact force in a tick from which on the ball has to settle again, counted alike: a factor of 1.02 to 1.04. Its
/// friction is still that of the load before, and its next renewals find that of a ball on its way.
///
/// After jumps of the load by 2.5 one torque that is not flagged is off by up to 67, 11, 7.3 and 4.0 % of itself at factors of 1.5,
/// 1.25, 1.1 and 1.05 with preload, by 2.3e-4 from 1.03 down and as chosen; after jumps by ten by 20 % at 1.5, and by 150 %
/// without such a bound. One per cent more of the ticks is flagged than without, and a load that moves by 1 % a tick meets it
/// nowhere.
const LOAD_STEP: u32 = 5 << 16;

/// A renewal that changes the ratio of torque and load by more than this part of it shows that the ball still settles.
///
/// On a load that swings by a factor of 3, and by 1 % a tick where it is steepest, the torque that is not flagged is off by
/// up to 4.4e-4, 8.2e-4, 1.4e-3, 5.1e-3, 1.3e-2 at 1e-4, 2e-4, 3e-4, 6e-4, 1e-3; without a gap 97, 94, 91, 83 and 72 % of
/// the ticks are flagged.
const SETTLED: f32 = 3e-4;

/// Renewals without such a change after which the ball counts as settled.
///
/// One is not enough, because a step that friction turns back may be small: on that load torques are off by up to 1.1e-2;
/// with two to four by 1.4e-3; by 4.3e-4, 2.4e-4, 1.8e-4 and 1.9e-4 rms at most with 1, 2, 3 and 4. After jumps each more
/// flags two per cent more of the ticks.
const QUIET: u8 = 4;

/// A ball is taken into a law over the load once two renewals in turn have changed its ratio by less than this part of it.
///
/// Below `f32`'s rounding, 1e-7, balls take all the renewals they get, 10 300 for both laws of a screw. At 1e-6, 3e-6, 1e-5,
/// 1e-4 it is 4200, 3400, 2900 and 2300, and the laws are within 6e-4, 6.8e-5 rms, with all; at 1e-3 within 1.9e-3, and a
/// fifth of the loads is flagged, because balls still change by more than [`SETTLED`].
const FOLDED: f32 = 3e-6;

/// Changes of the friction coefficient, over it, and of the radial gap, m, that a ball follows without being flagged: each changes
/// the torque by no more than [`SETTLED`] allows a renewal (a gap larger by 1e-8 m by 0.4 % rms, 1.5 % at most).
const FOLLOWED: (f32, f32) = (SETTLED, 2e-10);

/// Friction and fit of the grooves: what may change while the model runs.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(crate) struct Grooving {
    pub(crate) friction: f32,
    /// Radial gap of every contact at the centred ball, m.
    clearance: f32,
    /// Contact force at which a preloaded ball loses its unloaded diagonal, N: `2 sqrt(2)` times the preload; 0 without.
    lift_off: f32,
}

impl Grooving {
    /// Neither friction nor gap.
    pub(crate) const NONE: Self = Self {
        friction: 0.0,
        clearance: 0.0,
        lift_off: 0.0,
    };

    pub(crate) fn new(ball: &BallConstants, friction: f32, clearance: f32) -> Self {
        Self {
            friction,
            clearance,
            lift_off: ball.lift_off(clearance),
        }
    }

    /// Contact force of a ball under an axial load and of a preload, N, `|F| + 2 sqrt(2) P`: what its friction torque is about in
    /// proportion to. (Balls of a ring have `sqrt(F^2 + 8 P^2)`, which is smooth where a load crosses zero between two renewals.)
    #[inline(always)]
    pub(crate) fn whole(&self, ball: &BallConstants, axial_load: f32) -> f32 {
        preload_counted(ball.normal * axial_load, self.lift_off)
    }

    /// Whether friction or fit jump from these.
    pub(crate) fn jumps_from(&self, before: &Self) -> bool {
        let (friction, gap) = FOLLOWED;
        (self.friction - before.friction).abs() > friction * before.friction
            || (self.clearance - before.clearance).abs() > gap
    }

    /// What the ball is under.
    #[inline(always)]
    const fn inputs(&self, axial_load: f32) -> BallInputs {
        BallInputs::alone(axial_load, self.friction, self.clearance)
    }
}

/// The ball, with what its last renewal found.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(crate) struct NominalBall {
    settled: Settled,
    /// Friction torque on the nut over the whole contact force, m.
    pub(super) ratio: f32,
    /// Whole contact force for which it is settled, N.
    whole: f32,
    /// Change of the ratio in the last renewal, over it.
    change: f32,
    /// Renewals until it counts as settled.
    unsettled: u8,
    two_point: bool,
}

impl NominalBall {
    /// A ball that has not settled, under a load in the frame in which the nut turns forward, N, not 0; with a ratio to begin
    /// with.
    pub(crate) fn new(
        ball: &BallConstants,
        grooving: &Grooving,
        axial_load: f32,
        ratio: f32,
    ) -> Self {
        Self {
            settled: ball.grooves.start(&grooving.inputs(axial_load)),
            ratio,
            whole: grooving.whole(ball, axial_load),
            change: 1.0,
            unsettled: QUIET,
            two_point: false,
        }
    }

    /// Distance of a contact force, preload counted, from that for which the ball is settled, in parts of 2^-23 octaves, an
    /// octave being taken as straight: what the bits of two positive numbers differ by. What is no number is far.
    #[inline(always)]
    fn apart(&self, whole: f32) -> u32 {
        whole.to_bits().abs_diff(self.whole.to_bits())
    }

    /// Whether the ball is settled for a load that is far from this one.
    #[inline(always)]
    pub(crate) fn is_far(&self, whole: f32) -> bool {
        self.apart(whole) > LOAD_JUMP
    }

    /// Takes notice of the contact force of a tick: after a step of it the ball has to settle again.
    #[inline(always)]
    pub(crate) fn meet(&mut self, whole: f32) {
        if self.apart(whole) > LOAD_STEP {
            self.unsettle();
        }
    }

    /// The ball has to settle again.
    #[inline(always)]
    pub(crate) fn unsettle(&mut self) {
        self.unsettled = QUIET;
    }

    /// Whether its friction still changes.
    #[inline(always)]
    pub(crate) const fn settles(&self) -> bool {
        self.unsettled > 0
    }

    /// Whether its friction changed in the last renewal.
    pub(super) fn changed(&self) -> bool {
        self.change > SETTLED
    }

    /// Whether both light contacts are open: friction of such a ball is not known as well as elsewhere.
    #[inline(always)]
    pub(crate) const fn in_two_points(&self) -> bool {
        self.two_point
    }

    /// Friction torque on the nut over the whole contact force, m.
    #[inline(always)]
    pub(crate) const fn ratio(&self) -> f32 {
        self.ratio
    }

    /// One Newton step of place and motion.
    #[inline(always)]
    pub(crate) fn renew(&mut self, ball: &BallConstants, grooving: &Grooving, axial_load: f32) {
        let inputs = grooving.inputs(axial_load);
        let found = ball.grooves.renew(&mut self.settled, &inputs);
        self.whole = grooving.whole(ball, axial_load);
        if found.lost {
            self.settled = ball.grooves.start(&inputs);
            self.change = 1.0;
            self.unsettled = QUIET;
            return;
        }
        // The torque is that of the load which the contacts carried before the step.
        let ratio = ball.torque(&found) / grooving.whole(ball, found.carried);
        let change = (ratio - self.ratio).abs();
        self.change = if found.taken < 1.0 || !(change < ratio) {
            1.0
        } else {
            change / ratio
        };
        self.unsettled = if self.changed() {
            QUIET
        } else {
            self.unsettled.saturating_sub(1)
        };
        self.ratio = ratio;
        self.two_point = found.two_point();
    }

    /// Renewals until friction no longer changes, so many at most.
    pub(super) fn settle(
        &mut self,
        ball: &BallConstants,
        grooving: &Grooving,
        axial_load: f32,
        most: u32,
    ) {
        let mut settled = 0;
        for _ in 0..most {
            self.renew(ball, grooving, axial_load);
            settled = if self.change < FOLDED { settled + 1 } else { 0 };
            if settled == 2 {
                break;
            }
        }
    }
}

impl Stored for Grooving {
    const BYTES: usize = 8;

    fn exchange<P: Port>(&mut self, port: &mut P) -> Result<(), Refusal> {
        port.number("friction", &mut self.friction, ranges::FRICTION_OF_A_ROW)?;
        port.number("clearance", &mut self.clearance, CLEARANCE)
    }
}

impl Grooving {
    /// Puts in what follows from the clearance.
    ///
    /// # Errors
    /// [`Refusal::OutOfRange`] naming `clearance`.
    pub(crate) fn complete(&mut self, ball: &BallConstants) -> Result<(), Refusal> {
        ball.takes(self.clearance)?;
        self.lift_off = ball.lift_off(self.clearance);
        Ok(())
    }
}

impl Stored for NominalBall {
    const BYTES: usize = Settled::BYTES + 3 * 4 + 2;

    fn exchange<P: Port>(&mut self, port: &mut P) -> Result<(), Refusal> {
        self.settled.exchange(port)?;
        port.number("ratio", &mut self.ratio, NOT_NEGATIVE)?;
        port.number("whole", &mut self.whole, NOT_NEGATIVE)?;
        port.number("change", &mut self.change, Range::new(0.0, 1.0))?;
        port.count("unsettled", &mut self.unsettled, QUIET)?;
        port.flag("two_point", &mut self.two_point)
    }
}
