//! The friction coefficient at one temperature: what a step evaluates.

use super::both::DirectionalCoefficient;
use super::drag::RollingDrag;
use super::form::CoefficientParameters;
use crate::error::{Error, attempt};
use crate::ranges;

/// Largest speed that churns, rad/s: that of a scene's limits. It keeps the torque finite.
const LARGEST_SPEED: f32 = 1e6;

/// Coefficients of one direction.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(super) struct Sides {
    full_film: f32,
    /// Boundary less full film.
    difference: f32,
}

/// Friction coefficient by speed and direction at one temperature.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct CoefficientAtTemperature {
    pub(super) forward: Sides,
    pub(super) backward: Sides,
    /// `w_m`, rad/s.
    pub(super) half_share_speed: f32,
    /// Churning torque over the speed, N m s.
    pub(super) churning: f32,
    pub(super) drag: RollingDrag,
    /// `eta^-0.8` with the viscosity in Pa s.
    pub(super) fluidity: f32,
}

impl Sides {
    pub(super) const fn new(
        parameters: &CoefficientParameters,
        factor: f32,
    ) -> Result<Self, Error> {
        let boundary = attempt!(ranges::FRICTION.checked("boundary", factor * parameters.boundary));
        let full_film =
            attempt!(ranges::FRICTION.checked("full_film", factor * parameters.full_film));
        Ok(Self {
            full_film,
            difference: boundary - full_film,
        })
    }

    /// The lesser one and the larger one.
    pub(super) const fn ends(&self) -> (f32, f32) {
        let boundary = self.full_film + self.difference;
        if self.difference < 0.0 {
            (boundary, self.full_film)
        } else {
            (self.full_film, boundary)
        }
    }

    #[inline(always)]
    const fn at(&self, share: f32) -> f32 {
        self.full_film + self.difference * share
    }
}

impl CoefficientAtTemperature {
    /// Friction coefficient at a speed of the nut, rad/s, in its direction; standstill counts as forward.
    ///
    /// NaN counts as standstill, infinity as a full film. Monotone in the speed's size, also in f32. Cost: one division, 43 modelled
    /// cycles; 70 with [`CoefficientLaw::at_temperature`](super::CoefficientLaw::at_temperature) in the same tick.
    #[inline(always)]
    #[must_use]
    pub const fn at(&self, speed: f32) -> f32 {
        let sides = if speed < 0.0 {
            &self.backward
        } else {
            &self.forward
        };
        sides.at(self.share(speed))
    }

    /// Friction coefficients that either direction would have at a speed of this size.
    #[inline(always)]
    #[must_use]
    pub const fn both(&self, speed: f32) -> DirectionalCoefficient {
        let share = self.share(speed);
        DirectionalCoefficient {
            forward: self.forward.at(share),
            backward: self.backward.at(share),
        }
    }

    /// Torque of churned lubricant, N m, with the sign of the speed that it opposes, rad/s: viscosity times speed. Speeds beyond
    /// 1e6 rad/s as that; NaN gives 0.
    #[inline]
    #[must_use]
    pub const fn churning_torque(&self, speed: f32) -> f32 {
        self.churning * within_speeds(speed)
    }

    /// Torque of viscous drag, N m, with the sign of the speed that it opposes, rad/s: of churned lubricant
    /// ([`Self::churning_torque`]) and of rolling contacts ([`RollingDrag`]) under an axial load and a preload whose flank lifts off
    /// at a load, N, both not negative.
    ///
    /// Cost: two square roots, one division, 9 other operations.
    #[inline]
    #[must_use]
    pub fn drag_torque(&self, speed: f32, load: f32, lift_off: f32) -> f32 {
        let speed = within_speeds(speed);
        let rolling = self.drag.at(self.fluidity, speed.abs(), [load, lift_off]);
        self.churning * speed + rolling.copysign(speed)
    }

    /// Whether the drag of rolling contacts is within the speeds for which its formula was fitted ([`RollingDrag::FITTED_SPEED`]), rad/s; a law
    /// without that drag holds at every speed, and NaN counts as standstill.
    #[inline]
    #[must_use]
    pub const fn holds_drag(&self, speed: f32) -> bool {
        !(speed.abs() > RollingDrag::FITTED_SPEED && self.drag.torque > 0.0)
    }

    /// Drag of the rolling contacts, without a temperature.
    #[must_use]
    pub const fn drag(&self) -> RollingDrag {
        self.drag
    }

    /// Speed at which half of the difference is gone, rad/s.
    #[inline]
    #[must_use]
    pub const fn half_share_speed(&self) -> f32 {
        self.half_share_speed
    }

    /// Steepest change of the coefficient with the speed, s/rad, at standstill; above 0 where friction rises.
    #[must_use]
    pub const fn steepest(&self) -> f32 {
        let difference = if self.forward.difference.abs() > self.backward.difference.abs() {
            self.forward.difference
        } else {
            self.backward.difference
        };
        -difference / self.half_share_speed
    }

    /// What is left of the difference at a speed: 1 at standstill, one half at the half-share speed.
    #[inline(always)]
    const fn share(&self, speed: f32) -> f32 {
        let half = self.half_share_speed;
        let sum = half + speed.abs();
        half / if speed.is_nan() { half } else { sum }
    }
}

/// A speed within 1e6 rad/s; NaN gives 0.
#[inline(always)]
const fn within_speeds(speed: f32) -> f32 {
    if speed >= LARGEST_SPEED {
        LARGEST_SPEED
    } else if speed <= -LARGEST_SPEED {
        -LARGEST_SPEED
    } else if speed >= 0.0 || speed < 0.0 {
        speed
    } else {
        0.0
    }
}
