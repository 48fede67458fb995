//! The stored cases: inputs, and the results that a host found.
//!
//! One file, little endian: for each function its name's length and name, its numbers in and out and its
//! cases as `u32`, then the cases, each its inputs and outputs as the bits of f32.

use epas_friction::Error;

use crate::contexts::Contexts;
use crate::inputs::CASES;
use crate::spread::Spread;
use crate::subjects::{SUBJECTS, Subject, WIDEST};

/// The stored file.
pub static STORED: &[u8] = include_bytes!("../cases.bin");

/// What is left to read of a file.
#[derive(Clone, Copy, Debug)]
pub struct Reader<'a> {
    rest: &'a [u8],
}

impl<'a> Reader<'a> {
    /// Starts at the beginning.
    #[must_use]
    pub const fn new(file: &'a [u8]) -> Self {
        Self { rest: file }
    }

    /// The next number.
    pub fn word(&mut self) -> Option<u32> {
        let (word, rest) = self.rest.split_first_chunk()?;
        self.rest = rest;
        Some(u32::from_le_bytes(*word))
    }

    /// Fills a slice with the next numbers.
    pub fn numbers(&mut self, numbers: &mut [f32]) -> Option<()> {
        for number in numbers {
            *number = f32::from_bits(self.word()?);
        }
        Some(())
    }

    /// The number of cases of a function, where the file goes on with this function.
    pub fn header(&mut self, subject: &Subject) -> Option<u32> {
        let length = self.word()? as usize;
        let (name, rest) = self.rest.split_at_checked(length)?;
        self.rest = rest;
        let known = name == subject.name.as_bytes()
            && self.word()? as usize == subject.inputs
            && self.word()? as usize == subject.outputs;
        if known { self.word() } else { None }
    }

    /// Whether nothing is left.
    #[must_use]
    pub const fn is_empty(&self) -> bool {
        self.rest.is_empty()
    }
}

/// A file's lengths and bits, as [`Reader`] reads them.
pub trait Sink {
    /// Takes some bytes.
    fn bytes(&mut self, bytes: &[u8]);
}

/// Writes what [`CASES`] of every function give on the machine at hand.
pub fn write(sink: &mut impl Sink) -> Result<(), Error> {
    let mut contexts = Contexts::new(|| 0)?;
    let mut inputs = [0.0; WIDEST];
    let mut outputs = [0.0; WIDEST];
    for subject in SUBJECTS {
        sink.bytes(&(subject.name.len() as u32).to_le_bytes());
        sink.bytes(subject.name.as_bytes());
        for number in [subject.inputs as u32, subject.outputs as u32, CASES] {
            sink.bytes(&number.to_le_bytes());
        }
        for case in 0..CASES {
            let (Some(inputs), Some(outputs)) = (
                inputs.get_mut(..subject.inputs),
                outputs.get_mut(..subject.outputs),
            ) else {
                continue;
            };
            (subject.fill)(&mut Spread::new(case), inputs);
            (subject.run)(&mut contexts, inputs, outputs);
            for number in inputs.iter().chain(&*outputs) {
                sink.bytes(&number.to_bits().to_le_bytes());
            }
        }
    }
    Ok(())
}

/// Whether two results are the same: the same bits, or both not a number (of which there are many, and
/// which one an operation gives differs from processor to processor).
#[must_use]
pub fn same(one: f32, other: f32) -> bool {
    one.to_bits() == other.to_bits() || (one.is_nan() && other.is_nan())
}
