//! Friction torque to duty cycle.

use embedded_hal::pwm::SetDutyCycle;

use crate::error::{Error, in_range};
use crate::law::compensation::CompensationMargin;
use crate::scene::{Faults, Outputs, UncagedOutputs};

/// Reaction to flagged outputs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum FaultReaction {
    /// A value at its limit ([`Faults::SPEED_RANGE`], [`Faults::LOAD_RANGE`], [`Faults::FRICTION_LIMIT`]) passes: neutral would drop the torque
    /// where it is largest. Any other fault: neutral.
    #[default]
    LimitedValuesPass,
    /// Any fault ([`Faults::faulty`], which has not [`Faults::BEYOND_MODEL`] and [`Faults::FORCES_NOT_HELD`]): neutral.
    NeutralOnAnyFault,
}

/// Configuration of a feed-forward of friction; unchecked.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct FeedForwardConfiguration {
    /// Torque about the nut's axis at full duty, N m, 1e-6 to 1e6: the motor's torque times the gear ratio.
    pub full_torque: f32,
    /// Largest output torque, N m, 0 up to `full_torque`: the authority of the compensation.
    pub largest_torque: f32,
    /// Output share of the friction torque, 0 to 1: less than 1 keeps an estimate that is too large from turning the wheel. For a model with memory
    /// see [`FrictionFeedForward::with_memory`].
    pub share: f32,
    /// Reaction to flagged outputs.
    pub reaction: FaultReaction,
}

/// The output.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct AppliedDuty {
    /// The duty cycle, counts of the channel's own scale.
    pub duty: u16,
    /// The torque was cut to [`FeedForwardConfiguration::largest_torque`].
    pub saturated: bool,
    /// The outputs were faulty or NaN: neutral duty in their place.
    pub neutral: bool,
}

/// Outputs a share of the friction torque as an offset-binary duty cycle, `duty = round((1 + share torque / full_torque) max_duty / 2)`: for the
/// reference input of a motor driver, or an H bridge in locked antiphase. The torque saturates at `largest_torque`; faulty outputs and a torque that
/// is NaN give the neutral duty. Cost: three multiplications, no division.
#[derive(Debug)]
pub struct FrictionFeedForward<PWM> {
    pwm: PWM,
    /// `share / (2 full_torque)`.
    scale: f32,
    /// `largest_torque / (2 full_torque)`.
    largest: f32,
    reaction: FaultReaction,
}

impl<PWM: SetDutyCycle> FrictionFeedForward<PWM> {
    /// Checks the configuration. The duty cycle is left as it is; call [`FrictionFeedForward::neutral`] before the bridge is enabled.
    pub fn new(pwm: PWM, configuration: &FeedForwardConfiguration) -> Result<Self, Error> {
        let FeedForwardConfiguration {
            full_torque,
            largest_torque,
            share,
            reaction,
        } = *configuration;
        in_range("full_torque", full_torque, 1e-6, 1e6)?;
        in_range("largest_torque", largest_torque, 0.0, full_torque)?;
        in_range("share", share, 0.0, 1.0)?;
        Ok(Self {
            pwm,
            scale: 0.5 * share / full_torque,
            largest: 0.5 * largest_torque / full_torque,
            reaction,
        })
    }

    /// For a model with memory: checks the share also against its breakaway and its play ([`compensation`](crate::law::compensation)).
    ///
    /// # Errors
    /// [`Error`] as from [`FrictionFeedForward::new`], or naming `share` or a field of the margin.
    pub fn with_memory(
        pwm: PWM,
        configuration: &FeedForwardConfiguration,
        margin: &CompensationMargin,
    ) -> Result<Self, Error> {
        margin.checked_share(configuration.share)?;
        Self::new(pwm, configuration)
    }

    /// Outputs the friction torque of a tick.
    pub fn apply(&mut self, outputs: &Outputs) -> Result<AppliedDuty, PWM::Error> {
        self.apply_torque(outputs.friction_torque, outputs.faults)
    }

    /// Outputs the friction torque of a tick of a screw without cage.
    pub fn apply_uncaged(&mut self, outputs: &UncagedOutputs) -> Result<AppliedDuty, PWM::Error> {
        self.apply_torque(outputs.friction_torque, outputs.faults)
    }

    fn apply_torque(&mut self, torque: f32, faults: Faults) -> Result<AppliedDuty, PWM::Error> {
        let value = torque * self.scale;
        if !value.is_finite() || self.refuses(faults) {
            let duty = self.put(0.0)?;
            return Ok(AppliedDuty {
                duty,
                saturated: false,
                neutral: true,
            });
        }
        let (value, saturated) = if value > self.largest {
            (self.largest, true)
        } else if value < -self.largest {
            (-self.largest, true)
        } else {
            (value, false)
        };
        Ok(AppliedDuty {
            duty: self.put(value)?,
            saturated,
            neutral: false,
        })
    }

    /// Outputs no torque.
    pub fn neutral(&mut self) -> Result<(), PWM::Error> {
        self.put(0.0).map(|_| ())
    }

    /// The channel back, at the duty that it has.
    pub fn release(self) -> PWM {
        self.pwm
    }

    fn refuses(&self, faults: Faults) -> bool {
        const PASSES: u16 = Faults::SPEED_RANGE.bits()
            | Faults::LOAD_RANGE.bits()
            | Faults::FRICTION_LIMIT.bits()
            | Faults::BEYOND_MODEL.bits()
            | Faults::FORCES_NOT_HELD.bits();
        match self.reaction {
            FaultReaction::NeutralOnAnyFault => faults.faulty(),
            FaultReaction::LimitedValuesPass => faults.bits() & !PASSES != 0,
        }
    }

    fn put(&mut self, value: f32) -> Result<u16, PWM::Error> {
        let scale = self.pwm.max_duty_cycle();
        // The cast rounds down and saturates; an uneven scale has its neutral half a count above the middle.
        let duty = (f32::from(scale) * (0.5 + value) + 0.5) as u16;
        let duty = if duty > scale { scale } else { duty };
        self.pwm.set_duty_cycle(duty)?;
        Ok(duty)
    }
}
