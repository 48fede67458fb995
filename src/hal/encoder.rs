//! Nut speed from a magnetic angle sensor on the rotor.

use super::nut_speed::NutSpeed;
use crate::error::Error;
use embedded_hal::spi::SpiDevice;

/// Reasons why a tick has no speed.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum EncoderError<E> {
    /// The bus failed.
    Bus(E),
    /// An answer has odd parity.
    Parity {
        /// The frame as received.
        frame: u16,
    },
    /// The sensor flagged an error of the interface; by reading it, it is cleared.
    Interface(SensorErrors),
    /// The sensor says that it has no valid angle (or the bus is stuck low).
    NoAngle(Diagnostics),
    /// The first angle, or the first after so many failed ticks that the rotor may have gone further than a difference of angles tells.
    NoEarlierReading,
    /// The difference of the angles is more than the largest nut speed makes.
    TooFast,
    /// The angle does not change though the rotor turns.
    Stuck {
        /// Ticks without a change.
        ticks: u32,
    },
}

/// Motion of rotor and nut in a tick.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct NutMotion {
    /// Angle of the rotor, rad, 0 up to 2 pi.
    pub rotor_angle: f32,
    /// Angular speed of the nut, rad/s, smoothed.
    pub nut_speed: f32,
    /// Diagnostics of one tick before.
    pub diagnostics: Diagnostics,
}

/// The nut's speed from an AS5047P-class magnetic encoder (14 bits a turn, 16-bit frames, SPI mode 1)
/// on the rotor: `nut_speed = (angle - last_angle) / (gear_ratio tick)`, the shorter way round.
///
/// A tick exchanges two frames, each its own transaction: one asks for the angle and receives the diagnostics asked for before, the other receives the
/// angle and asks for the diagnostics: a bus stuck low is found at the next tick. Start and recovery take one frame more, an error flag two.
///
/// **Resolution.** The speed from one difference comes in steps of [`MagneticEncoder::resolution`], `2 pi / 2^14 / tick / gear_ratio`: 0.38 rad/s
/// at 1 ms, 7.7 rad/s at 50 us, both with gear ratio 1. Smoothing with a time constant of `n` ticks makes the ripple about `n` times finer and the
/// speed `n` ticks late. The reversal speed of the model is to be more than this ripple.
///
/// **Wrap-around.** The largest speed is at most a quarter of a turn in a tick; beyond it, up to three times as fast at least, a tick is
/// [`EncoderError::TooFast`], and the new angle is the base of the next one. After failed ticks the difference spans them, as long as the rotor cannot
/// have gone more than a quarter of a turn; then one tick is [`EncoderError::NoEarlierReading`].
#[derive(Debug)]
pub struct MagneticEncoder<SPI> {
    spi: SPI,
    speed: NutSpeed,
    asked: bool,
}

impl<SPI: SpiDevice> MagneticEncoder<SPI> {
    /// Checks the configuration. Nothing is sent.
    pub fn new(spi: SPI, configuration: &EncoderConfiguration) -> Result<Self, Error> {
        Ok(Self {
            spi,
            speed: NutSpeed::new(configuration)?,
            asked: false,
        })
    }

    /// Reads the angle and makes the speed; call it every [`EncoderConfiguration::tick`].
    ///
    /// `turning`: something else knows that the rotor turns by more than a count in [`EncoderConfiguration::stuck_ticks`] (the phase currents, the
    /// column's angle); `false` where nothing does: at standstill an unchanged angle is no fault.
    ///
    /// # Errors
    /// [`EncoderError`]; the next sound tick is as if nothing had been.
    pub fn tick(&mut self, turning: bool) -> Result<NutMotion, EncoderError<SPI::Error>> {
        let (angle, diagnostics) = match self.sample() {
            Ok(sample) => sample,
            Err(error) => {
                self.asked = false;
                self.speed.miss(turning);
                return Err(error);
            }
        };
        Ok(NutMotion {
            rotor_angle: NutSpeed::rotor_angle(angle),
            nut_speed: self.speed.take(angle, turning)?,
            diagnostics,
        })
    }

    /// Nut speed of one count in one tick, rad/s: the step of an unsmoothed speed.
    pub fn resolution(&self) -> f32 {
        self.speed.resolution()
    }

    /// The bus device back.
    pub fn release(self) -> SPI {
        self.spi
    }

    fn sample(&mut self) -> Result<(u16, Diagnostics), EncoderError<SPI::Error>> {
        if !self.asked {
            self.exchange(READ_DIAGNOSTICS)?;
            self.asked = true;
        }
        let diagnostics = Diagnostics(self.answer(READ_ANGLE)?);
        let angle = self.answer(READ_DIAGNOSTICS)?;
        if diagnostics.angle_is_valid() {
            Ok((angle, diagnostics))
        } else {
            Err(EncoderError::NoAngle(diagnostics))
        }
    }

    /// Sends a command; the data of the answer to the one before it.
    fn answer(&mut self, command: u16) -> Result<u16, EncoderError<SPI::Error>> {
        let frame = checked(self.exchange(command)?)?;
        if frame & ERROR_FLAG == 0 {
            return Ok(frame & DATA);
        }
        self.exchange(READ_ERRORS)?;
        let errors = checked(self.exchange(READ_DIAGNOSTICS)?)?;
        Err(EncoderError::Interface(SensorErrors(errors & DATA)))
    }

    /// One frame each way, in a transaction of its own: the sensor takes a command when it is deselected.
    fn exchange(&mut self, command: u16) -> Result<u16, EncoderError<SPI::Error>> {
        let mut bytes = command.to_be_bytes();
        self.spi
            .transfer_in_place(&mut bytes)
            .map_err(EncoderError::Bus)?;
        Ok(u16::from_be_bytes(bytes))
    }
}

fn checked<E>(frame: u16) -> Result<u16, EncoderError<E>> {
    if even(frame) {
        Ok(frame)
    } else {
        Err(EncoderError::Parity { frame })
    }
}

/// Error flag `EF` of an answer: something was wrong with the command that it answers.
pub(super) const ERROR_FLAG: u16 = 1 << 14;
pub(super) const DATA: u16 = ERROR_FLAG - 1;
/// Reads the angle with the sensor's compensation of its own delay (ANGLECOM, 0x3FFF).
pub(super) const READ_ANGLE: u16 = read(0x3FFF);
/// Reads the diagnostics (DIAAGC, 0x3FFC).
pub(super) const READ_DIAGNOSTICS: u16 = read(0x3FFC);
/// Reads the errors of the interface (ERRFL, 0x0001); the sensor clears them by it.
pub(super) const READ_ERRORS: u16 = read(0x0001);

const fn read(address: u16) -> u16 {
    let command = 1 << 14 | address;
    if even(command) {
        command
    } else {
        1 << 15 | command
    }
}

#[inline]
pub(super) const fn even(frame: u16) -> bool {
    frame.count_ones() & 1 == 0
}

/// Errors of the sensor's interface (ERRFL).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct SensorErrors(pub(super) u16);

impl SensorErrors {
    /// The sensor saw a frame of another length than 16 bits.
    #[must_use]
    pub const fn framing(self) -> bool {
        self.0 & 1 != 0
    }

    /// The sensor was sent the address of no register.
    #[must_use]
    pub const fn invalid_command(self) -> bool {
        self.0 & 1 << 1 != 0
    }

    /// The sensor saw wrong parity in a command.
    #[must_use]
    pub const fn parity(self) -> bool {
        self.0 & 1 << 2 != 0
    }

    /// The register as read. More than its three lowest bits: the line to the controller is stuck high.
    pub const fn bits(self) -> u16 {
        self.0
    }
}

/// State of the sensor and its magnet (DIAAGC).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Diagnostics(pub(super) u16);

impl Diagnostics {
    /// The sensor has finished its start-up. A bus stuck low reads as never finished.
    #[must_use]
    pub const fn ready(self) -> bool {
        self.0 & 1 << 8 != 0
    }

    /// The angle is wrong: the sensor's arithmetic overflowed.
    #[must_use]
    pub const fn overflow(self) -> bool {
        self.0 & 1 << 9 != 0
    }

    /// The magnet is too close or too strong; the angle is still measured.
    #[must_use]
    pub const fn magnet_too_strong(self) -> bool {
        self.0 & 1 << 10 != 0
    }

    /// The magnet is too far or too weak; the angle is still measured, with more noise.
    #[must_use]
    pub const fn magnet_too_weak(self) -> bool {
        self.0 & 1 << 11 != 0
    }

    /// The register as read.
    pub const fn bits(self) -> u16 {
        self.0
    }

    #[inline]
    pub(super) const fn angle_is_valid(self) -> bool {
        self.ready() && !self.overflow()
    }
}

/// Configuration of an encoder; unchecked.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct EncoderConfiguration {
    /// Time between two calls of [`MagneticEncoder::tick`](super::MagneticEncoder::tick), s, 1e-6 to 1.
    pub tick: f32,
    /// Turns of the rotor in one turn of the nut, of magnitude 0.01 to 100: 1 on the nut itself, the ratio of the pulleys with a belt between. Negative
    /// where the sensor counts down while the nut turns forward.
    pub gear_ratio: f32,
    /// Largest nut speed, rad/s: 1e-3 up to a quarter of a turn of the rotor in one tick, `pi / (2 gear_ratio tick)`.
    pub largest_nut_speed: f32,
    /// Time constant of the first-order smoothing of the speed, s, 0 (none) to 10.
    pub smoothing_time: f32,
    /// Ticks without a change of the angle, while the rotor is known to turn, after which the sensor counts as stuck; 0 as 1.
    pub stuck_ticks: u32,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_bit_is_its_own() {
        for bit in 0..16 {
            let errors = SensorErrors(1 << bit);
            assert_eq!(
                [errors.framing(), errors.invalid_command(), errors.parity()],
                [bit == 0, bit == 1, bit == 2]
            );
            let found = Diagnostics(1 << bit);
            let flags = [found.ready(), found.overflow()];
            assert_eq!(flags, [bit == 8, bit == 9]);
            let magnet = [found.magnet_too_strong(), found.magnet_too_weak()];
            assert_eq!(magnet, [bit == 10, bit == 11]);
        }
    }
}
