//! Why a block is refused.

use core::fmt;

/// Why a state was not written, or a block not taken.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Refusal {
    /// The block is too short, or longer than its state.
    Length {
        /// Bytes given.
        found: usize,
        /// Bytes of the block.
        expected: usize,
    },
    /// The block does not begin as one does.
    NotAState,
    /// The block is of another version of the layout.
    Version {
        /// Its version.
        found: u16,
        /// The version that is read.
        expected: u16,
    },
    /// The checksum is wrong.
    Damaged,
    /// The block is of another kind of scene.
    OtherScene,
    /// The block is of a circuit with another number of balls.
    OtherBalls {
        /// Its number of balls.
        found: u16,
        /// That of the model.
        expected: u16,
    },
    /// The block is of another design, or of another friction coefficient, clearance, memory or angle sensor.
    OtherConstants,
    /// A number is NaN or infinite, or out of the range of its field.
    OutOfRange {
        /// Which one.
        field: &'static str,
    },
}

impl fmt::Display for Refusal {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Length { found, expected } => {
                write!(formatter, "{found} bytes; the block has {expected}")
            }
            Self::NotAState => formatter.write_str("the bytes are no state"),
            Self::Version { found, expected } => {
                write!(formatter, "version {found}; {expected} is read")
            }
            Self::Damaged => formatter.write_str("the checksum is wrong"),
            Self::OtherScene => formatter.write_str("the state is of another kind of scene"),
            Self::OtherBalls { found, expected } => {
                write!(
                    formatter,
                    "the state has {found} balls, the model {expected}"
                )
            }
            Self::OtherConstants => formatter.write_str("the state is of other constants"),
            Self::OutOfRange { field } => write!(formatter, "{field} is out of range"),
        }
    }
}

impl core::error::Error for Refusal {}
