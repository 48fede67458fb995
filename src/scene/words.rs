//! What the blocks of all scenes have in common: header and checksum around numbers, as words.
//!
//! | words | what |
//! |---|---|
//! | 1 | the scene's magic word |
//! | 1 | version of the layout |
//! | 1 | number of words, this header and the checksum included |
//! | 1 | number of friction coefficients (nodes) |
//! | 2 | digest of the inputs from which the block was folded, low word first |
//! | n | numbers: the bits of an `f32` |
//! | 1 | CRC-32 of all words before it, each with its least significant byte first |

use crate::error::{Error, Range, attempt, in_range};
use crate::stored::crc32_of_words;

pub(super) const HEADER: usize = 6;

#[derive(Clone, Copy)]
pub(super) struct Layout {
    pub(super) magic: u32,
    pub(super) version: u32,
    pub(super) words: usize,
    pub(super) nodes: usize,
}

impl Layout {
    #[inline]
    pub(super) const fn check(&self, words: &[u32]) -> Result<(), Error> {
        let length = self.words as f32;
        let Some((words, _)) = words.split_at_checked(self.words) else {
            return Err(Error::OutOfRange {
                field: "words",
                value: words.len() as f32,
                allowed: Range::new(length, f32::MAX),
            });
        };
        attempt!(is("magic", word(words, 0), self.magic));
        attempt!(is("version", word(words, 1), self.version));
        attempt!(is("nodes", word(words, 3), self.nodes as u32));
        attempt!(is("words", word(words, 2), self.words as u32));
        let sound = match words.split_last() {
            Some((checksum, counted)) => crc32_of_words(counted) == *checksum,
            None => false,
        };
        attempt!(in_range("checksum", sound as u8 as f32, 1.0, 1.0));
        Ok(())
    }

    pub(super) fn write(
        &self,
        digest: u64,
        numbers: impl Iterator<Item = u32>,
        words: &mut [u32],
    ) -> Result<(), Error> {
        let count = words.len() as f32;
        let Some(block) = words.get_mut(..self.words) else {
            return in_range("words", count, self.words as f32, f32::MAX).map(|_| ());
        };
        let header = [
            self.magic,
            self.version,
            self.words as u32,
            self.nodes as u32,
            digest as u32,
            (digest >> 32) as u32,
        ];
        for (word, value) in block.iter_mut().zip(header.into_iter().chain(numbers)) {
            *word = value;
        }
        if let Some((checksum, counted)) = block.split_last_mut() {
            *checksum = crc32_of_words(counted);
        }
        Ok(())
    }
}

/// The word at a place; 0 beyond the last, where a block whose length has been checked has none.
#[inline]
pub(super) const fn word(words: &[u32], at: usize) -> u32 {
    if at < words.len() { words[at] } else { 0 }
}

#[inline]
pub(super) const fn float(words: &[u32], at: usize) -> f32 {
    f32::from_bits(word(words, at))
}

#[inline]
pub(super) const fn floats<const M: usize>(words: &[u32], at: usize) -> [f32; M] {
    let mut all = [0.0; M];
    let mut number = 0;
    while number < M {
        all[number] = float(words, at + number);
        number += 1;
    }
    all
}

/// Refuses a word that is not the expected one, though an `f32` may not tell them apart.
const fn is(field: &'static str, word: u32, expected: u32) -> Result<(), Error> {
    if word == expected {
        Ok(())
    } else {
        Err(Error::OutOfRange {
            field,
            value: word as f32,
            allowed: Range::new(expected as f32, expected as f32),
        })
    }
}
