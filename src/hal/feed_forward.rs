//! Friction torque to duty cycle.

use embedded_hal::pwm::SetDutyCycle;

use crate::error::{Error, in_range};
use crate::law::compensation::CompensationMargin;
use crate::scene::{Faults, Outputs, UncagedOutputs};

/// Which flagged outputs take the torque away.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum FaultReaction {
    /// Any fault ([`Faults::faulty`]): neutral. [`Faults::BEYOND_MODEL`] and [`Faults::FORCES_NOT_HELD`] are none: their torque is
    /// the best estimate, and stays.
    #[default]
    NeutralOnAnyFault,
    /// A value at its limit ([`Faults::SPEED_RANGE`], [`Faults::LOAD_RANGE`],
    /// [`Faults::FRICTION_LIMIT`]) is still output, so that the torque does not drop where it is largest;
    /// any other fault: neutral.
    LimitedValuesPass,
}

/// How a torque becomes a duty cycle; unchecked.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct FeedForwardConfiguration {
    /// Torque about the nut's axis at full duty, N m, 1e-6 to 1e6. With a belt: the
    /// motor's torque times the gear ratio.
    pub full_torque: f32,
    /// Largest output torque, N m, 0 up to `full_torque`: the authority of the compensation.
    pub largest_torque: f32,
    /// Output share of the friction torque, 0 to 1. Less than 1 leaves some friction to the
    /// driver and keeps an estimate that is too large from turning the wheel by itself.
    /// With a model that has a memory the largest share follows from its margin:
    /// [`FrictionFeedForward::with_memory`].
    pub share: f32,
    /// Which flagged outputs take the torque away.
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

/// Puts a share of the friction torque out as an offset-binary duty cycle: half the scale is no
/// torque, none is `-full_torque`, all is `+full_torque`:
/// `duty = round((1 + share torque / full_torque) max_duty / 2)`.
///
/// One channel without a direction pin: the reference input of a motor driver, or an H bridge in
/// locked antiphase. The torque saturates at `largest_torque`; faulty outputs and a torque that is NaN
/// give the neutral duty, which is also what [`FrictionFeedForward::neutral`] gives for a
/// controller that stops. Cost: three multiplications, no division.
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
    /// Checks the configuration. The duty cycle is left as it is; call
    /// [`FrictionFeedForward::neutral`] before the bridge is enabled.
    ///
    /// # Errors
    /// [`Error`] naming `full_torque`, `largest_torque` or `share`.
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

    /// For a model with memory: checks the share against what its breakaway and its play allow as well.
    ///
    /// Where friction is a spring in angle, its compensation is a negative one, and more of it than the true friction has makes the
    /// motor hum: see [`compensation`](crate::law::compensation) for the three bounds.
    ///
    /// # Errors
    /// [`Error`] as from [`FrictionFeedForward::new`]; `share` with the range that the margin leaves it; the margin's
    /// own fields.
    pub fn with_memory(
        pwm: PWM,
        configuration: &FeedForwardConfiguration,
        margin: &CompensationMargin,
    ) -> Result<Self, Error> {
        margin.checked_share(configuration.share)?;
        Self::new(pwm, configuration)
    }

    /// Outputs the friction torque of a tick.
    ///
    /// # Errors
    /// The channel's own error.
    pub fn apply(&mut self, outputs: &Outputs) -> Result<AppliedDuty, PWM::Error> {
        self.apply_torque(outputs.friction_torque, outputs.faults)
    }

    /// Outputs the friction torque of a tick of a screw without cage.
    ///
    /// # Errors
    /// The channel's own error.
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
    ///
    /// # Errors
    /// The channel's own error.
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

    /// Outputs a torque, -1/2 to 1/2 of the scale.
    fn put(&mut self, value: f32) -> Result<u16, PWM::Error> {
        let scale = self.pwm.max_duty_cycle();
        // The cast rounds down and saturates, so that the half rounds to nearest and an uneven scale
        // has its neutral half a count above the middle.
        let duty = (f32::from(scale) * (0.5 + value) + 0.5) as u16;
        let duty = if duty > scale { scale } else { duty };
        self.pwm.set_duty_cycle(duty)?;
        Ok(duty)
    }
}
