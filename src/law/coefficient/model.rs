//! Friction coefficient of a scene in both directions.

use super::form::{CoefficientAtTemperature, CoefficientLaw};
use crate::error::{Error, attempt};
use crate::ranges;
use core::fmt::Debug;

/// Friction coefficients of ball and groove in both directions at one speed: what the limits of a memory need.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct DirectionalCoefficient {
    /// In the positive direction, 1e-6 to 1.
    pub forward: f32,
    /// In the negative direction, 1e-6 to 1.
    pub backward: f32,
}

impl DirectionalCoefficient {
    /// Coefficient of a direction, given by its sign, and of the opposite direction; 0 and NaN count as forward.
    #[inline]
    pub const fn of(&self, direction: f32) -> (f32, f32) {
        if direction < 0.0 {
            (self.backward, self.forward)
        } else {
            (self.forward, self.backward)
        }
    }

    /// Both coefficients, cut to `largest`; NaN becomes that.
    #[inline]
    #[must_use]
    pub const fn within(self, largest: f32) -> Self {
        Self {
            forward: if self.forward < largest {
                self.forward
            } else {
                largest
            },
            backward: if self.backward < largest {
                self.backward
            } else {
                largest
            },
        }
    }

    /// Both coefficients over the one of a direction, given by its sign, forward first: 1 and a ratio, 1e-6 to 1e6.
    #[inline]
    pub const fn over_own(&self, direction: f32) -> [f32; 2] {
        let (own, opposite) = self.of(direction);
        let ratio = opposite / own;
        if direction < 0.0 {
            [ratio, 1.0]
        } else {
            [1.0, ratio]
        }
    }
}

/// Model of the friction coefficient in a scene with memory: [`CoefficientLaw`], or [`OneCoefficient`], which leaves out its parts.
pub trait CoefficientModel: Copy + Debug + PartialEq {
    /// The coefficient at one temperature.
    type At: Copy + Debug + PartialEq;

    /// Least and largest coefficient that it gives, in either direction.
    fn extremes(&self) -> (f32, f32);

    /// The coefficient at a temperature, K.
    fn at_temperature(&self, temperature: f32) -> Self::At;

    /// Friction coefficients of both directions at a speed of this size.
    fn both(at: &Self::At, speed: f32) -> DirectionalCoefficient;

    /// Torque of viscous drag, N m, as [`CoefficientAtTemperature::drag_torque`].
    fn drag_torque(at: &Self::At, speed: f32, load: f32, lift_off: f32) -> f32;

    /// See [`CoefficientAtTemperature::holds_drag`].
    fn holds_drag(at: &Self::At, speed: f32) -> bool;
}

/// One friction coefficient at every speed and temperature, in both directions; no drag.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct OneCoefficient {
    friction: f32,
}

impl OneCoefficient {
    /// A friction coefficient, 1e-6 to 1.
    pub const fn new(friction: f32) -> Result<Self, Error> {
        let friction = attempt!(ranges::FRICTION.checked("friction", friction));
        Ok(Self { friction })
    }
}

impl CoefficientModel for OneCoefficient {
    type At = Self;

    fn extremes(&self) -> (f32, f32) {
        (self.friction, self.friction)
    }

    #[inline]
    fn at_temperature(&self, _: f32) -> Self {
        *self
    }

    #[inline]
    fn both(at: &Self, _: f32) -> DirectionalCoefficient {
        DirectionalCoefficient {
            forward: at.friction,
            backward: at.friction,
        }
    }

    #[inline]
    fn drag_torque(_: &Self, _: f32, _: f32, _: f32) -> f32 {
        0.0
    }

    #[inline]
    fn holds_drag(_: &Self, _: f32) -> bool {
        true
    }
}

impl CoefficientModel for CoefficientLaw {
    type At = CoefficientAtTemperature;

    fn extremes(&self) -> (f32, f32) {
        Self::extremes(self)
    }

    #[inline]
    fn at_temperature(&self, temperature: f32) -> CoefficientAtTemperature {
        Self::at_temperature(self, temperature)
    }

    #[inline]
    fn both(at: &CoefficientAtTemperature, speed: f32) -> DirectionalCoefficient {
        at.both(speed)
    }

    #[inline]
    fn drag_torque(at: &CoefficientAtTemperature, speed: f32, load: f32, lift_off: f32) -> f32 {
        at.drag_torque(speed, load, lift_off)
    }

    #[inline]
    fn holds_drag(at: &CoefficientAtTemperature, speed: f32) -> bool {
        at.holds_drag(speed)
    }
}
