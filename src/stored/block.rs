//! The block around a state: what it is of, and whether it is whole.

use super::Refusal;
use super::port::{Port, Reader, Stored, Writer};
use super::{Fingerprint, crc32};

/// Version of the layout: counts up with every change of what a state's bytes mean.
pub const VERSION: u16 = 3;

const MAGIC: [u8; 4] = *b"EPAF";

const HEADER: usize = 16;
const CHECKSUM: usize = 4;

pub(crate) const OVERHEAD: usize = HEADER + CHECKSUM;

/// What a state is of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Label {
    /// Kind of scene.
    pub kind: u16,
    /// Number of balls in the circuit, 0 without one.
    pub balls: u16,
    /// Of the constants.
    pub fingerprint: Fingerprint,
}

/// A block of a fixed length around a state of type `T`.
pub(crate) struct Block {
    label: Label,
    bytes: usize,
}

impl Block {
    /// Of states that take at most so many bytes.
    pub(crate) const fn new(label: Label, state: usize) -> Self {
        Self {
            label,
            bytes: OVERHEAD + state,
        }
    }

    fn header(&self) -> [u8; HEADER] {
        let [m0, m1, m2, m3] = MAGIC;
        let [v0, v1] = VERSION.to_le_bytes();
        let [k0, k1] = self.label.kind.to_le_bytes();
        let [b0, b1] = self.label.balls.to_le_bytes();
        let [l0, l1] = (self.bytes as u16).to_le_bytes();
        let [f0, f1, f2, f3] = self.label.fingerprint.value().to_le_bytes();
        [
            m0, m1, m2, m3, v0, v1, k0, k1, b0, b1, l0, l1, f0, f1, f2, f3,
        ]
    }

    /// The state as a block at the begin of `bytes`; bytes that it does not need are 0.
    pub(crate) fn seal<T: Stored>(
        &self,
        state: &mut T,
        bytes: &mut [u8],
    ) -> Result<usize, Refusal> {
        let wrong = Refusal::Length {
            found: bytes.len(),
            expected: self.bytes,
        };
        let body = self.bytes.saturating_sub(CHECKSUM);
        let (body, rest) = bytes.split_at_mut_checked(body).ok_or(wrong)?;
        let checksum = rest.first_chunk_mut::<CHECKSUM>().ok_or(wrong)?;
        let mut writer = Writer { rest: body };
        writer.bytes(&mut self.header())?;
        state.exchange(&mut writer)?;
        writer.rest.fill(0);
        *checksum = crc32(body).to_le_bytes();
        Ok(self.bytes)
    }

    pub(crate) fn open<T: Stored>(&self, state: &mut T, bytes: &[u8]) -> Result<(), Refusal> {
        let mut reader = self.checked(bytes)?;
        state.exchange(&mut reader)?;
        if reader.rest.iter().all(|&byte| byte == 0) {
            Ok(())
        } else {
            Err(Refusal::OutOfRange { field: "unused" })
        }
    }

    /// The bytes of the state in a block that is whole and of these constants.
    #[inline(never)]
    fn checked<'a>(&self, bytes: &'a [u8]) -> Result<Reader<'a>, Refusal> {
        let wrong = Refusal::Length {
            found: bytes.len(),
            expected: self.bytes,
        };
        let (header, state) = bytes.split_first_chunk::<HEADER>().ok_or(wrong)?;
        let (state, checksum) = state.split_last_chunk::<CHECKSUM>().ok_or(wrong)?;
        let ([magic, fingerprint], [found, kind, balls, length]) = numbers(header);
        if magic != MAGIC {
            return Err(Refusal::NotAState);
        }
        if found != VERSION {
            return Err(Refusal::Version {
                found,
                expected: VERSION,
            });
        }
        if usize::from(length) != bytes.len() {
            return Err(Refusal::Length {
                found: bytes.len(),
                expected: usize::from(length),
            });
        }
        let (body, _) = bytes.split_last_chunk::<CHECKSUM>().ok_or(wrong)?;
        if crc32(body) != u32::from_le_bytes(*checksum) {
            return Err(Refusal::Damaged);
        }
        if kind != self.label.kind {
            return Err(Refusal::OtherScene);
        }
        if balls != self.label.balls {
            return Err(Refusal::OtherBalls {
                found: balls,
                expected: self.label.balls,
            });
        }
        if u32::from_le_bytes(fingerprint) != self.label.fingerprint.value() {
            return Err(Refusal::OtherConstants);
        }
        // Elements of another number have other constants.
        if bytes.len() == self.bytes {
            Ok(Reader { rest: state })
        } else {
            Err(wrong)
        }
    }
}

fn numbers(header: &[u8; HEADER]) -> ([[u8; 4]; 2], [u16; 4]) {
    let [
        m0,
        m1,
        m2,
        m3,
        v0,
        v1,
        k0,
        k1,
        b0,
        b1,
        l0,
        l1,
        f0,
        f1,
        f2,
        f3,
    ] = *header;
    let words = [[v0, v1], [k0, k1], [b0, b1], [l0, l1]].map(u16::from_le_bytes);
    ([[m0, m1, m2, m3], [f0, f1, f2, f3]], words)
}
