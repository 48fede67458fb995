//! Checksum of a block, and the fingerprint of the constants that it belongs to.

/// What half a byte makes of the checksum: polynomial `0xEDB88320`, bits reversed. 64 bytes.
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

/// Checksum of bytes, CRC-32 as in IEEE 802.3 and zip files: any one to three wrong bits, and any burst of up to 32, are found in
/// blocks of this size. 10 instructions a byte.
///
/// ```
/// assert_eq!(epas_friction::stored::crc32(b"123456789"), 0xCBF4_3926);
/// ```
#[must_use]
pub fn crc32(bytes: &[u8]) -> u32 {
    !continued(u32::MAX, bytes)
}

/// A loop of its own: unrolled for every number of the constants it would be kilobytes.
#[inline(never)]
fn continued(state: u32, bytes: &[u8]) -> u32 {
    let half = |rest: u32| (rest >> 4) ^ NIBBLES[(rest & 15) as usize];
    bytes
        .iter()
        .fold(state, |rest, &byte| half(half(rest ^ u32::from(byte))))
}

/// The same of words, each with its least significant byte first; for constants too.
pub(crate) const fn crc32_of_words(words: &[u32]) -> u32 {
    let mut rest = u32::MAX;
    let mut number = 0;
    while number < words.len() {
        rest ^= words[number];
        let mut nibble = 0;
        while nibble < 8 {
            rest = (rest >> 4) ^ NIBBLES[(rest & 15) as usize];
            nibble += 1;
        }
        number += 1;
    }
    !rest
}

/// Checksum of the constants that a state is read with, number by number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Fingerprint(u32);

impl Default for Fingerprint {
    fn default() -> Self {
        Self(u32::MAX)
    }
}

impl Fingerprint {
    /// Takes in a number, to the bit.
    pub fn number(&mut self, number: f32) {
        self.count(number.to_bits());
    }

    /// Takes in numbers, in their order.
    pub fn numbers(&mut self, numbers: &[f32]) {
        for &number in numbers {
            self.number(number);
        }
    }

    /// Takes in a whole number.
    pub fn count(&mut self, count: u32) {
        self.0 = continued(self.0, &count.to_le_bytes());
    }

    /// The checksum so far.
    #[must_use]
    pub const fn value(self) -> u32 {
        !self.0
    }
}

/// Constants that a state is read with: elements of a memory, an angle sensor.
pub trait Fingerprinted {
    /// Takes in every number on which the meaning of a state depends, after one that says what kind of constants these are.
    fn fingerprint(&self, fingerprint: &mut Fingerprint);
}
