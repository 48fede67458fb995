//! Adapters for `embedded-hal` 1.0, behind the feature `embedded-hal`: nut speed in, motor duty out.
//!
//! [`MagneticEncoder`] reads the nut's speed from a magnetic angle sensor on the rotor of the motor; [`FrictionFeedForward`] turns the
//! friction torque into a duty cycle. A speed that is not known enters the model as NaN, comes out flagged, and leaves the bridge at its neutral duty:
//!
//! ```
//! use embedded_hal::{pwm::SetDutyCycle, spi::SpiDevice};
//! use epas_friction::{CagedBallScrew, CagedConstants, FrictionModel, Inputs};
//! use epas_friction::hal::{FrictionFeedForward, MagneticEncoder};
//!
//! fn tick<SPI: SpiDevice, PWM: SetDutyCycle>(
//!     encoder: &mut MagneticEncoder<SPI>,
//!     model: &mut FrictionModel<CagedBallScrew, &'static CagedConstants>,
//!     stage: &mut FrictionFeedForward<PWM>,
//!     axial_load: f32,
//!     turning: bool,
//! ) -> Result<(), PWM::Error> {
//!     let nut_speed = match encoder.tick(turning) {
//!         Ok(motion) => motion.nut_speed,
//!         Err(_fault) => f32::NAN, // and a diagnostic message
//!     };
//!     let outputs = model.step(Inputs { nut_speed, axial_load });
//!     stage.apply(&outputs).map(|_| ())
//! }
//! ```

mod encoder;
mod feed_forward;
mod nut_speed;

pub use encoder::{
    Diagnostics, EncoderConfiguration, EncoderError, MagneticEncoder, NutMotion, SensorErrors,
};
pub use feed_forward::{AppliedDuty, FaultReaction, FeedForwardConfiguration, FrictionFeedForward};
