//! What every elastic ball of a screw has in common.

use super::grooves::ElasticGrooves;
use super::renewal::Renewal;
use super::resistance::BallResistance;
use crate::ball::Clearance;
use crate::ball::preload::{LOST, preload_of};
use crate::contact::RollingResistance;
use crate::error::{Error, attempt};
use crate::geometry::BallScrew;
use crate::math;

/// Constants of the balls of a screw.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(crate) struct BallConstants {
    pub(super) grooves: ElasticGrooves,
    resistance: BallResistance,
    /// Contact force over axial load, `1/(sin beta cos alpha)`.
    pub(super) normal: f32,
    /// Sum of the deflections of both contacts under one newton over the ball radius.
    deflection: f32,
}

impl BallConstants {
    /// Folds the constants of a design.
    ///
    /// # Errors
    /// As [`ElasticGrooves::new`] and [`BallResistance::new`].
    pub(crate) const fn new(
        design: &BallScrew,
        rolling_resistance: RollingResistance,
    ) -> Result<Self, Error> {
        let grooves = attempt!(ElasticGrooves::new(design));
        Ok(Self {
            resistance: attempt!(BallResistance::new(design, rolling_resistance)),
            normal: 1.0 / design.axial_per_normal(),
            deflection: 1.0 / grooves.screw.stiffness + 1.0 / grooves.nut.stiffness,
            grooves,
        })
    }

    /// Checks a clearance against the balls.
    ///
    /// # Errors
    /// [`Error`] naming `clearance`.
    pub(crate) const fn checked(&self, clearance: Clearance) -> Result<Clearance, Error> {
        clearance.checked_for(self.grooves.ball_radius)
    }

    /// Contact force at which a preload's lost diagonal opens, N: that of [`Clearance::preload`] times the load over it.
    pub(super) fn lift_off(&self, clearance: f32) -> f32 {
        let gap = clearance / self.grooves.ball_radius;
        if gap < 0.0 {
            let ratio = -2.0 * gap / self.deflection;
            preload_of(ratio, math::sqrt(ratio)) * LOST
        } else {
            0.0
        }
    }

    /// Friction torque of a renewed ball on the nut, N m: that of friction in its contacts and their rolling resistance.
    ///
    /// The power after a step is one to first order: nothing but a ball that has not settled makes it negative.
    #[inline(always)]
    pub(super) fn torque(&self, found: &Renewal) -> f32 {
        let friction = if found.torque > 0.0 {
            found.torque
        } else {
            0.0
        };
        friction + self.resistance.torque(found.loads)
    }
}
