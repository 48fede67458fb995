//! Writes a state into bytes and reads it from them.

use core::mem::take;

use super::Refusal;
use crate::error::Range;

/// Place to write numbers to, or to read them from. A number is checked in both directions: a model writes only what it can read again.
pub trait Port {
    /// Exchanges bytes.
    ///
    /// # Errors
    /// [`Refusal::Length`] where no room or no bytes are left.
    fn bytes<const B: usize>(&mut self, bytes: &mut [u8; B]) -> Result<(), Refusal>;

    /// Exchanges a whole number of any size.
    fn word(&mut self, word: &mut u32) -> Result<(), Refusal> {
        let mut bytes = word.to_le_bytes();
        self.bytes(&mut bytes)?;
        *word = u32::from_le_bytes(bytes);
        Ok(())
    }

    /// Exchanges a number within a range.
    ///
    /// # Errors
    /// As [`Port::bytes`], and [`Refusal::OutOfRange`] with this field.
    fn number(
        &mut self,
        field: &'static str,
        number: &mut f32,
        allowed: Range,
    ) -> Result<(), Refusal> {
        let mut bits = number.to_bits();
        self.word(&mut bits)?;
        let found = f32::from_bits(bits);
        if allowed.contains(found) {
            *number = found;
            Ok(())
        } else {
            Err(Refusal::OutOfRange { field })
        }
    }

    /// Exchanges numbers within a range.
    fn numbers(
        &mut self,
        field: &'static str,
        numbers: &mut [f32],
        allowed: Range,
    ) -> Result<(), Refusal> {
        numbers
            .iter_mut()
            .try_for_each(|number| self.number(field, number, allowed))
    }

    /// Exchanges a count of a byte, up to `most`.
    fn count(&mut self, field: &'static str, count: &mut u8, most: u8) -> Result<(), Refusal> {
        let mut bytes = [*count];
        self.bytes(&mut bytes)?;
        let [found] = bytes;
        if found <= most {
            *count = found;
            Ok(())
        } else {
            Err(Refusal::OutOfRange { field })
        }
    }

    /// Exchanges a count of two bytes, up to `most`.
    fn long_count(
        &mut self,
        field: &'static str,
        count: &mut u16,
        most: u16,
    ) -> Result<(), Refusal> {
        let mut bytes = count.to_le_bytes();
        self.bytes(&mut bytes)?;
        let found = u16::from_le_bytes(bytes);
        if found <= most {
            *count = found;
            Ok(())
        } else {
            Err(Refusal::OutOfRange { field })
        }
    }

    /// Exchanges a flag.
    fn flag(&mut self, field: &'static str, flag: &mut bool) -> Result<(), Refusal> {
        let mut count = u8::from(*flag);
        self.count(field, &mut count, 1)?;
        *flag = count == 1;
        Ok(())
    }
}

/// A state that can be kept as bytes.
pub trait Stored {
    /// Bytes at most.
    const BYTES: usize;

    /// Writes the state to a port, or reads it from one; checks every number by itself. The rest is afterwards as before the first tick. Callers give
    /// a copy: after a refusal it is of no use.
    ///
    /// # Errors
    /// The first number that is refused.
    fn exchange<P: Port>(&mut self, port: &mut P) -> Result<(), Refusal>;
}

/// After a flag that says whether it is there.
impl<T: Stored + Default> Stored for Option<T> {
    const BYTES: usize = 1 + T::BYTES;

    fn exchange<P: Port>(&mut self, port: &mut P) -> Result<(), Refusal> {
        let mut known = self.is_some();
        port.flag("known", &mut known)?;
        if known {
            self.get_or_insert_default().exchange(port)
        } else {
            *self = None;
            Ok(())
        }
    }
}

impl Stored for () {
    const BYTES: usize = 0;

    fn exchange<P: Port>(&mut self, _: &mut P) -> Result<(), Refusal> {
        Ok(())
    }
}

pub(super) struct Writer<'a> {
    pub(super) rest: &'a mut [u8],
}

pub(super) struct Reader<'a> {
    pub(super) rest: &'a [u8],
}

const fn ended(bytes: usize) -> Refusal {
    Refusal::Length {
        found: 0,
        expected: bytes,
    }
}

impl Port for Writer<'_> {
    fn bytes<const B: usize>(&mut self, bytes: &mut [u8; B]) -> Result<(), Refusal> {
        match take(&mut self.rest).split_first_chunk_mut::<B>() {
            Some((chunk, rest)) => {
                *chunk = *bytes;
                self.rest = rest;
                Ok(())
            }
            None => Err(ended(B)),
        }
    }
}

impl Port for Reader<'_> {
    fn bytes<const B: usize>(&mut self, bytes: &mut [u8; B]) -> Result<(), Refusal> {
        let (chunk, rest) = self.rest.split_first_chunk::<B>().ok_or(ended(B))?;
        *bytes = *chunk;
        self.rest = rest;
        Ok(())
    }
}
