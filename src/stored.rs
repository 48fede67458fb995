//! State as bytes: memory of a model from one ignition to the next, for
//! [`FrictionModel::export`](crate::FrictionModel::export) and
//! [`FrictionModel::import`](crate::FrictionModel::import).
//!
//! # Block
//!
//! Numbers are little-endian, an `f32` is stored as its bits.
//!
//! | bytes | what |
//! |---|---|
//! | 0 to 3 | `EPAF` |
//! | 4, 5 | version of the layout, [`VERSION`] |
//! | 6, 7 | kind of scene |
//! | 8, 9 | number of balls in the circuit, 0 without one |
//! | 10, 11 | length of the whole block |
//! | 12 to 15 | fingerprint of the constants that the state is read with |
//! | 16 on | the state |
//! | last 4 | [`crc32`] of all before |
//!
//! A block is refused for the first of these that is wrong: its first bytes, its version, its length, its checksum, its scene, its
//! balls, its constants, a number. A state has one description, [`Stored::exchange`], which runs in both directions.

mod block;
mod port;

use core::fmt;

pub(crate) use block::{Block, OVERHEAD};
pub use block::{Label, VERSION};
pub use port::{Port, Stored};

/// Reasons why a state was not written, or a block not taken.
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

/// Checksum of half a byte: polynomial `0xEDB88320`, bits reversed. 64 bytes.
const NIBBLES: [u32; 16] = {
    let mut table = [0; 16];
    let mut nibble = 0;
    while nibble < 16 {
        let mut rest = nibble as u32;
        let mut bit = 0;
        while bit < 4 {
            rest = if rest & 1 == 1 {
                (rest >> 1) ^ 0xEDB8_8320
            } else {
                rest >> 1
            };
            bit += 1;
        }
        table[nibble] = rest;
        nibble += 1;
    }
    table
};

/// CRC-32 as in IEEE 802.3 and zip files: any one to three wrong bits, and any burst of up to 32, are found in blocks of this size. 10 instructions a
/// byte.
///
/// ```
/// assert_eq!(epas_friction::stored::crc32(b"123456789"), 0xCBF4_3926);
/// ```
pub const fn crc32(bytes: &[u8]) -> u32 {
    !continued(u32::MAX, bytes)
}

/// A loop of its own: unrolled for every number of the constants it would be kilobytes.
#[inline(never)]
const fn continued(mut rest: u32, mut bytes: &[u8]) -> u32 {
    while let Some((&byte, others)) = bytes.split_first() {
        rest ^= byte as u32;
        rest = (rest >> 4) ^ NIBBLES[(rest & 15) as usize];
        rest = (rest >> 4) ^ NIBBLES[(rest & 15) as usize];
        bytes = others;
    }
    rest
}

/// [`crc32`] of words, each with its least significant byte first.
pub(crate) const fn crc32_of_words(mut words: &[u32]) -> u32 {
    let mut sum = Fingerprint::NONE;
    while let Some((&word, others)) = words.split_first() {
        sum.count(word);
        words = others;
    }
    sum.value()
}

/// Checksum of the constants that a state is read with, number by number: [`crc32`] of their bytes, least significant first.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Fingerprint(u32);

impl Fingerprint {
    /// Of nothing.
    pub const NONE: Self = Self(u32::MAX);

    /// Takes in a number, to the bit.
    pub const fn number(&mut self, number: f32) {
        self.count(number.to_bits());
    }

    /// Takes in numbers, in their order.
    pub fn numbers(&mut self, numbers: &[f32]) {
        for &number in numbers {
            self.number(number);
        }
    }

    /// Takes in a whole number.
    pub const fn count(&mut self, count: u32) {
        self.bytes(&count.to_le_bytes());
    }

    /// Takes in bytes.
    pub const fn bytes(&mut self, bytes: &[u8]) {
        self.0 = continued(self.0, bytes);
    }

    /// The checksum so far.
    pub const fn value(self) -> u32 {
        !self.0
    }
}

/// Constants that a state is read with: elements of a memory, an angle sensor.
pub trait Fingerprinted {
    /// Takes in the kind of the constants, and then every number on which the meaning of a state depends.
    fn fingerprint(&self, fingerprint: &mut Fingerprint);
}
