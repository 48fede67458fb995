//! The block around a state.

use super::port::{Port, Reader, Stored, Writer};
use super::{Fingerprint, Refusal, crc32};

/// Version of the layout: counts up with every change of a state's bytes.
pub const VERSION: u16 = 3;

const MAGIC: [u8; 4] = *b"EPAF";

const HEADER: usize = 16;
const CHECKSUM: usize = 4;

pub(crate) const OVERHEAD: usize = HEADER + CHECKSUM;

/// Label of a block.
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

struct Header {
    magic: [u8; 4],
    version: u16,
    kind: u16,
    balls: u16,
    length: u16,
    fingerprint: u32,
}

impl Stored for Header {
    const BYTES: usize = HEADER;

    fn exchange<P: Port>(&mut self, port: &mut P) -> Result<(), Refusal> {
        port.bytes(&mut self.magic)?;
        port.long_count("version", &mut self.version, u16::MAX)?;
        port.long_count("kind", &mut self.kind, u16::MAX)?;
        port.long_count("balls", &mut self.balls, u16::MAX)?;
        port.long_count("length", &mut self.length, u16::MAX)?;
        port.word(&mut self.fingerprint)
    }
}

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

    fn header(&self) -> Header {
        Header {
            magic: MAGIC,
            version: VERSION,
            kind: self.label.kind,
            balls: self.label.balls,
            length: self.bytes as u16,
            fingerprint: self.label.fingerprint.value(),
        }
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
        self.header().exchange(&mut writer)?;
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
        let (body, checksum) = bytes.split_last_chunk::<CHECKSUM>().ok_or(wrong)?;
        let mut reader = Reader { rest: body };
        let mut found = self.header();
        if found.exchange(&mut reader).is_err() {
            return Err(wrong);
        }
        if found.magic != MAGIC {
            return Err(Refusal::NotAState);
        }
        if found.version != VERSION {
            return Err(Refusal::Version {
                found: found.version,
                expected: VERSION,
            });
        }
        if usize::from(found.length) != bytes.len() {
            return Err(Refusal::Length {
                found: bytes.len(),
                expected: usize::from(found.length),
            });
        }
        if crc32(body) != u32::from_le_bytes(*checksum) {
            return Err(Refusal::Damaged);
        }
        if found.kind != self.label.kind {
            return Err(Refusal::OtherScene);
        }
        if found.balls != self.label.balls {
            return Err(Refusal::OtherBalls {
                found: found.balls,
                expected: self.label.balls,
            });
        }
        if found.fingerprint != self.label.fingerprint.value() {
            return Err(Refusal::OtherConstants);
        }
        // Elements of another number have other constants.
        if bytes.len() == self.bytes {
            Ok(reader)
        } else {
            Err(wrong)
        }
    }
}
