//! Frames of an AS5047P-class encoder: 16 bits, the most significant first, parity even over all of
//! them.
//!
//! Command: parity in bit 15, 1 for a read in bit 14, the register's address below. Answer, in the
//! frame after: parity in bit 15, error flag in bit 14, 14 bits of data.

/// Error flag `EF` of an answer: something was wrong with the command that it answers.
pub(super) const ERROR_FLAG: u16 = 1 << 14;
/// The data of an answer.
pub(super) const DATA: u16 = ERROR_FLAG - 1;
/// Reads the angle with the sensor's compensation of its own delay (ANGLECOM, 0x3FFF).
pub(super) const READ_ANGLE: u16 = read(0x3FFF);
/// Reads the diagnostics (DIAAGC, 0x3FFC).
pub(super) const READ_DIAGNOSTICS: u16 = read(0x3FFC);
/// Reads the errors of the interface (ERRFL, 0x0001); the sensor clears them by it.
pub(super) const READ_ERRORS: u16 = read(0x0001);

/// The command that reads a register, with its parity.
const fn read(address: u16) -> u16 {
    let command = 1 << 14 | address;
    if even(command) {
        command
    } else {
        1 << 15 | command
    }
}

/// Whether an even number of bits is set.
#[inline]
pub(super) const fn even(frame: u16) -> bool {
    frame.count_ones() & 1 == 0
}

/// What the sensor says of its interface (ERRFL).
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

    /// The register as read. More than its three lowest bits: the line to the controller is stuck
    /// high.
    #[must_use]
    pub const fn bits(self) -> u16 {
        self.0
    }
}

/// What the sensor says of its magnet and its own work (DIAAGC).
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
    #[must_use]
    pub const fn bits(self) -> u16 {
        self.0
    }

    /// Whether an angle read beside it is one.
    #[inline]
    pub(super) const fn angle_is_valid(self) -> bool {
        self.ready() && !self.overflow()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The commands as the data sheet's rule gives them by hand.
    #[test]
    fn commands_carry_even_parity() {
        assert_eq!(READ_ANGLE, 0xFFFF);
        assert_eq!(READ_DIAGNOSTICS, 0xFFFC);
        assert_eq!(READ_ERRORS, 0x4001);
    }

    /// Each error and each finding has its bit, as the data sheet numbers them, and none reads as another.
    #[test]
    fn every_bit_is_its_own() {
        for bit in 0..16 {
            let errors = SensorErrors(1 << bit);
            assert_eq!(
                [errors.framing(), errors.invalid_command(), errors.parity()],
                [bit == 0, bit == 1, bit == 2]
            );
            let found = Diagnostics(1 << bit);
            assert_eq!(
                [
                    found.ready(),
                    found.overflow(),
                    found.magnet_too_strong(),
                    found.magnet_too_weak()
                ],
                [bit == 8, bit == 9, bit == 10, bit == 11]
            );
        }
    }
}
