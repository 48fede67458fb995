//! What the control interrupt knows of a linear bearing, and its bounds.

use crate::error::{Error, attempt, in_range};
use crate::scene::contract::CheckedInputs;
use crate::scene::faults::{Faults, bounded};
use crate::scene::reversal::Motion;

/// What the control interrupt knows of a linear bearing at a tick.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct LinearInputs {
    /// Speed of the carriage on the rail, m/s; limited to that of the [`LinearLimits`].
    pub speed: f32,
    /// Force that presses the carriage on the row of balls, N, preload included; zero or less lifts it
    /// off. Within the limits, as the speed.
    pub normal_load: f32,
    /// Force across, N: positive loads the diagonal from bottom left to top right. Within the limits, as the speed.
    pub side_load: f32,
}

/// Limits of inputs and outputs.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct LinearLimits {
    /// Largest speed that is believed, m/s, 1e-6 to 1e3.
    pub speed: f32,
    /// Largest normal and side load that is believed, N, 1e-3 to 1e7.
    pub load: f32,
    /// Largest friction force that is put out, N, 1e-6 to 1e6.
    pub friction_force: f32,
}

impl LinearLimits {
    /// The limits, checked.
    ///
    /// # Errors
    /// [`Error`] naming `speed`, `load` or `friction_force`.
    pub const fn checked(self) -> Result<Self, Error> {
        attempt!(in_range("speed", self.speed, 1e-6, 1e3));
        attempt!(in_range("load", self.load, 1e-3, 1e7));
        attempt!(in_range("friction_force", self.friction_force, 1e-6, 1e6));
        Ok(self)
    }

    /// The inputs within these limits, with what was wrong.
    #[inline(always)]
    pub(super) fn check_inputs(&self, inputs: LinearInputs) -> CheckedInputs<LinearInputs> {
        let LinearInputs {
            speed,
            normal_load,
            side_load,
        } = inputs;
        let loads_are_finite = normal_load.is_finite() && side_load.is_finite();
        if speed.is_finite() && loads_are_finite {
            CheckedInputs {
                inputs: Some(LinearInputs {
                    speed: bounded(speed, self.speed),
                    normal_load: bounded(normal_load, self.load),
                    side_load: bounded(side_load, self.load),
                }),
                faults: Faults::beyond(
                    speed.abs() > self.speed,
                    normal_load.abs() > self.load || side_load.abs() > self.load,
                ),
            }
        } else {
            CheckedInputs {
                inputs: None,
                faults: Faults::not_finite(!speed.is_finite(), !loads_are_finite),
            }
        }
    }
}

impl Motion for LinearInputs {
    const STILL: Self = Self {
        speed: 0.0,
        normal_load: 0.0,
        side_load: 0.0,
    };

    #[inline(always)]
    fn speed(&self) -> f32 {
        self.speed
    }

    #[inline(always)]
    fn load(&self) -> f32 {
        self.normal_load
    }

    #[inline(always)]
    fn with(self, speed: f32, load_factor: f32) -> Self {
        Self {
            speed,
            normal_load: load_factor * self.normal_load,
            side_load: load_factor * self.side_load,
        }
    }
}
