//! A caged screw as a block of words: layout, version, checksum.
//!
//! | words | what |
//! |---|---|
//! | 1 | [`MAGIC`] |
//! | 1 | [`VERSION`] |
//! | 1 | number of words, this header and the checksum included |
//! | 1 | number of friction coefficients (nodes) |
//! | 2 | digest of the inputs from which the block was folded, low word first |
//! | 7 | friction coefficient, lead, number of loaded balls, reversal speed, limits of nut speed, axial load and friction torque |
//! | 4 | lift-off load of a ball, least and largest octaves, octaves from which on loads are shifted |
//! | 83 a node | friction coefficient; two curves, each 8 begins and 8 times 4 coefficients; two shifts |
//! | 1 | CRC-32 of all words before it, each with its least significant byte first |
//!
//! Numbers are the bits of an `f32`.

use super::{CagedBallScrewConfiguration, CagedConstants};
use crate::ball::folded::{FrictionNode, LoadCurve, LoadLaw, PARTS};
use crate::error::{Error, Range, attempt, in_range};
use crate::scene::contract::Limits;
use crate::stored::crc32_of_words;

/// First word of a block: `EPAS` as bytes, least significant first.
const MAGIC: u32 = 0x5341_5045;

/// Version of the layout.
const VERSION: u32 = 1;

/// Words before the numbers, numbers that do not depend on the nodes, and words of a node.
const HEADER: usize = 6;
const COMMON: usize = 11;
const NODE: usize = 3 + 2 * 5 * PARTS;

impl<const NODES: usize> CagedBallScrewConfiguration<NODES> {
    /// Words of its block.
    pub const WORDS: usize = HEADER + COMMON + NODES * NODE + 1;

    /// Reads a block that `epas-design` wrote; for constants too. Its numbers are not checked, but for the checksum over them.
    ///
    /// # Errors
    /// [`Error`] naming `magic`, `version`, `nodes`, `words` (how many there are) or `checksum` (0 for one that is wrong).
    pub const fn read(words: &[u32]) -> Result<Self, Error> {
        let length = Self::WORDS as f32;
        let Some((words, _)) = words.split_at_checked(Self::WORDS) else {
            return Err(Error::OutOfRange {
                field: "words",
                value: words.len() as f32,
                allowed: Range::new(length, f32::MAX),
            });
        };
        attempt!(is("magic", word(words, 0), MAGIC));
        attempt!(is("version", word(words, 1), VERSION));
        attempt!(is("nodes", word(words, 3), NODES as u32));
        attempt!(is("words", word(words, 2), Self::WORDS as u32));
        let sound = match words.split_last() {
            Some((checksum, counted)) => crc32_of_words(counted) == *checksum,
            None => false,
        };
        attempt!(in_range("checksum", sound as u8 as f32, 1.0, 1.0));
        let mut nodes = [NO_NODE; NODES];
        let mut number = 0;
        while number < NODES {
            let at = HEADER + COMMON + number * NODE;
            let shift = at + 1 + 2 * 5 * PARTS;
            nodes[number] = FrictionNode {
                friction: float(words, at),
                curves: [curve(words, at + 1), curve(words, at + 1 + 5 * PARTS)],
                shift: [float(words, shift), float(words, shift + 1)],
            };
            number += 1;
        }
        Ok(Self {
            law: LoadLaw {
                nodes,
                lift_off: float(words, HEADER + 7),
                ends: [float(words, HEADER + 8), float(words, HEADER + 9)],
                shifted_from: float(words, HEADER + 10),
            },
            friction: float(words, HEADER),
            lead: float(words, HEADER + 1),
            loaded_balls: float(words, HEADER + 2) as u16,
            reversal_speed: float(words, HEADER + 3),
            limits: Limits {
                nut_speed: float(words, HEADER + 4),
                axial_load: float(words, HEADER + 5),
                friction_torque: float(words, HEADER + 6),
            },
        })
    }

    /// Writes the block, with the digest of what it was folded from, to the begin of `words`: for a host.
    ///
    /// # Errors
    /// [`Error`] naming `words`, where there are fewer than [`Self::WORDS`].
    pub fn write(&self, digest: u64, words: &mut [u32]) -> Result<(), Error> {
        let count = words.len() as f32;
        let Some(block) = words.get_mut(..Self::WORDS) else {
            return in_range("words", count, Self::WORDS as f32, f32::MAX).map(|_| ());
        };
        let header = [
            MAGIC,
            VERSION,
            Self::WORDS as u32,
            NODES as u32,
            digest as u32,
            (digest >> 32) as u32,
        ];
        let [least, most] = self.law.ends;
        let common = [
            self.friction,
            self.lead,
            self.loaded_balls.into(),
            self.reversal_speed,
            self.limits.nut_speed,
            self.limits.axial_load,
            self.limits.friction_torque,
            self.law.lift_off,
            least,
            most,
            self.law.shifted_from,
        ];
        let of_curve = |curve: &'_ LoadCurve| {
            let LoadCurve { starts, cubics } = *curve;
            starts.into_iter().chain(cubics.into_iter().flatten())
        };
        let of_node = |node: &'_ FrictionNode| {
            let [drive, backdrive] = &node.curves;
            core::iter::once(node.friction)
                .chain(of_curve(drive))
                .chain(of_curve(backdrive))
                .chain(node.shift)
        };
        let numbers = common
            .into_iter()
            .chain(self.law.nodes.iter().flat_map(of_node));
        let all = header.into_iter().chain(numbers.map(f32::to_bits));
        for (word, value) in block.iter_mut().zip(all) {
            *word = value;
        }
        if let Some((checksum, counted)) = block.split_last_mut() {
            *checksum = crc32_of_words(counted);
        }
        Ok(())
    }
}

impl<const NODES: usize> CagedConstants<NODES> {
    /// Constants of a block that `epas-design` wrote: in a constant when firmware is compiled, or of a calibration page.
    ///
    /// # Errors
    /// [`Error`] naming `magic`, `version`, `nodes`, `words` or `checksum` of a block that is none, or what
    /// [`CagedConstants::new`] refuses.
    pub const fn from_block(words: &[u32]) -> Result<Self, Error> {
        let configuration = attempt!(CagedBallScrewConfiguration::read(words));
        Self::new(&configuration)
    }
}

const NO_CURVE: LoadCurve = LoadCurve {
    starts: [0.0; PARTS],
    cubics: [[0.0; 4]; PARTS],
};

const NO_NODE: FrictionNode = FrictionNode {
    friction: 0.0,
    curves: [NO_CURVE; 2],
    shift: [0.0; 2],
};

/// The word at a place; 0 beyond the last, where a block whose length has been checked has none.
const fn word(words: &[u32], at: usize) -> u32 {
    if at < words.len() { words[at] } else { 0 }
}

/// The number in a word.
const fn float(words: &[u32], at: usize) -> f32 {
    f32::from_bits(word(words, at))
}

/// The curve that begins at a word.
const fn curve(words: &[u32], at: usize) -> LoadCurve {
    let mut curve = NO_CURVE;
    let mut part = 0;
    while part < PARTS {
        curve.starts[part] = float(words, at + part);
        let mut power = 0;
        while power < 4 {
            curve.cubics[part][power] = float(words, at + PARTS + 4 * part + power);
            power += 1;
        }
        part += 1;
    }
    curve
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
