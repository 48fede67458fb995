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
//! | 4 | lift-off load of a ball, least and largest biased logarithm, that from which on loads are shifted |
//! | 83 a node | friction coefficient; two curves, each 8 begins and 8 times 4 coefficients; two shifts |
//! | 1 | CRC-32 of all words before it, each with its least significant byte first |
//!
//! Numbers are the bits of an `f32`.

use super::{CagedBallScrewConfiguration, CagedConstants};
use crate::ball::folded::{FrictionNode, LoadCurve, LoadLaw, PARTS};
use crate::error::{Error, attempt};
use crate::scene::contract::Limits;
use crate::scene::words::{HEADER, Layout, float, floats};

/// First word of a block: `EPAS` as bytes, least significant first.
const MAGIC: u32 = 0x5341_5045;

const VERSION: u32 = 1;

/// Numbers that do not depend on the nodes, and words of a node.
const COMMON: usize = 11;
const NODE: usize = 3 + 2 * 5 * PARTS;

impl<const NODES: usize> CagedBallScrewConfiguration<NODES> {
    /// Words of its block.
    pub const WORDS: usize = HEADER + COMMON + NODES * NODE + 1;

    const LAYOUT: Layout = Layout {
        magic: MAGIC,
        version: VERSION,
        words: Self::WORDS,
        nodes: NODES,
    };

    /// Reads a block that `epas-design` wrote, and checks its checksum, not its numbers.
    ///
    /// # Errors
    /// [`Error`] naming `magic`, `version`, `nodes`, `words` (how many there are) or `checksum` (0 for one that is wrong).
    pub const fn read(words: &[u32]) -> Result<Self, Error> {
        attempt!(Self::LAYOUT.check(words));
        let mut nodes = [NO_NODE; NODES];
        let mut number = 0;
        while number < NODES {
            let at = HEADER + COMMON + number * NODE;
            let shift = at + 1 + 2 * 5 * PARTS;
            nodes[number] = FrictionNode {
                friction: float(words, at),
                curves: [curve(words, at + 1), curve(words, at + 1 + 5 * PARTS)],
                shift: floats(words, shift),
            };
            number += 1;
        }
        Ok(Self {
            law: LoadLaw {
                nodes,
                lift_off: float(words, HEADER + 7),
                ends: floats(words, HEADER + 8),
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

    /// Writes the block, with the digest of its inputs, to the begin of `words`: for a host.
    ///
    /// # Errors
    /// [`Error`] naming `words`, where there are fewer than [`Self::WORDS`].
    pub fn write(&self, digest: u64, words: &mut [u32]) -> Result<(), Error> {
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
        Self::LAYOUT.write(digest, numbers.map(f32::to_bits), words)
    }
}

impl<const NODES: usize> CagedConstants<NODES> {
    /// Constants of a block that `epas-design` wrote.
    ///
    /// # Errors
    /// [`Error`] naming `magic`, `version`, `nodes`, `words` or `checksum` of words that are no block, or a
    /// field that [`CagedConstants::new`] refuses.
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

const fn curve(words: &[u32], at: usize) -> LoadCurve {
    let mut curve = NO_CURVE;
    curve.starts = floats(words, at);
    let mut part = 0;
    while part < PARTS {
        curve.cubics[part] = floats(words, at + PARTS + 4 * part);
        part += 1;
    }
    curve
}
