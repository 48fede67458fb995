//! Simulated devices of the control loop: an angle sensor that turns with the recorded manoeuvre, and a
//! half bridge.

use core::convert::Infallible;

use embedded_hal::pwm::{self, SetDutyCycle};
use embedded_hal::spi::{self, Operation, SpiDevice};

use crate::cases::Reader;

/// A tick, s.
pub const TICK: f32 = 1e-3;

/// Turns of the rotor in a turn of the nut.
pub const GEAR_RATIO: f32 = 2.0;

/// Ticks from one frame with a flipped bit to the next.
pub const BIT_LOST: u32 = 97;

const ANGLE: u16 = 0x3FFF;
const DIAGNOSTICS: u16 = 0x3FFC;
/// Diagnostics of a sensor that works: the offset compensation is done.
const READY: u16 = 1 << 8;

/// An AS5047P-class sensor: the answer to a command comes with the next one.
pub struct Sensor {
    manoeuvre: Reader<'static>,
    /// Angle of the rotor in units of 2^-32 turns.
    angle: u32,
    answer: u16,
    ticks: u32,
}

impl Sensor {
    /// A sensor on a rotor that follows a manoeuvre: nut speed and load for each tick.
    #[must_use]
    pub const fn new(manoeuvre: Reader<'static>) -> Self {
        Self {
            manoeuvre,
            angle: 0,
            answer: 0,
            ticks: 0,
        }
    }

    /// The frame that answers a command.
    fn answer(&mut self, command: u16) -> u16 {
        let data = match command & ANGLE {
            ANGLE => {
                let mut input = [0.0; 2];
                if self.manoeuvre.numbers(&mut input).is_some() {
                    let [nut_speed, _] = input;
                    let turns = nut_speed * (GEAR_RATIO * TICK / core::f32::consts::TAU);
                    self.angle = self
                        .angle
                        .wrapping_add_signed((turns * 4_294_967_296.0) as i32);
                }
                self.ticks = self.ticks.wrapping_add(1);
                (self.angle >> 18) as u16
            }
            DIAGNOSTICS => READY,
            _ => 0,
        };
        let odd = data.count_ones() & 1 == 1;
        let frame = if odd { data | 1 << 15 } else { data };
        if command & ANGLE == ANGLE && self.ticks.is_multiple_of(BIT_LOST) {
            frame ^ 1
        } else {
            frame
        }
    }
}

impl spi::ErrorType for Sensor {
    type Error = Infallible;
}

impl SpiDevice for Sensor {
    fn transaction(&mut self, operations: &mut [Operation<'_, u8>]) -> Result<(), Infallible> {
        for operation in operations {
            if let Operation::TransferInPlace(bytes) = operation
                && let Ok(frame) = <&mut [u8; 2]>::try_from(&mut **bytes)
            {
                let command = u16::from_be_bytes(*frame);
                *frame = self.answer.to_be_bytes();
                self.answer = self.answer(command);
            }
        }
        Ok(())
    }
}

/// A half bridge that remembers its duty.
#[derive(Default)]
pub struct Bridge {
    /// The duty it was last given.
    pub duty: u16,
}

impl pwm::ErrorType for Bridge {
    type Error = Infallible;
}

impl SetDutyCycle for Bridge {
    fn max_duty_cycle(&self) -> u16 {
        8399
    }

    fn set_duty_cycle(&mut self, duty: u16) -> Result<(), Infallible> {
        self.duty = duty;
        Ok(())
    }
}
