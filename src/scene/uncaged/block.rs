//! Folded part of a ball screw without cage as a block of words, between the header and the checksum of all blocks.
//!
//! | words | what |
//! |---|---|
//! | 9 | friction coefficient, lead, ball radius, path radius, nominal speed against the nut, reversal speed, limits of nut speed, axial load and friction torque |
//! | 3 | largest deviations of screw and nut, lift-off load of a ball |
//! | 2 243 a node | friction coefficient; 2 times 32 knots, each a load and 17 numbers; 2 times 16 knots, each a load and the 31 numbers of what neighbours change; the bits of both branches where forces are not held |
//!
//! Numbers are the bits of an `f32`.

use super::FoldedBall;
use crate::ball::pressed::{
    BallKnot, BallLaw, BallNode, BallNumbers, KNOTS, Knot, NEIGHBOUR_KNOTS, NeighbourKnot,
    NeighbourNumbers, RubbedNode,
};
use crate::error::{Error, attempt};
use crate::scene::contract::Limits;
use crate::scene::words::{HEADER, Layout, float, floats, word};

/// First word of a block: `EPAU` as bytes, least significant first.
const MAGIC: u32 = 0x5541_5045;

const VERSION: u32 = 5;

/// Numbers that do not depend on the nodes; words of a knot, and of a node.
const COMMON: usize = 12;
const KNOT: usize = 22;
const NEIGHBOUR_KNOT: usize = 32;
const BRANCH: usize = KNOTS * KNOT;
const NEIGHBOUR_BRANCH: usize = NEIGHBOUR_KNOTS * NEIGHBOUR_KNOT;
const NODE: usize = 1 + 2 * BRANCH + 2 * NEIGHBOUR_BRANCH + 2;

impl<const NODES: usize> FoldedBall<NODES> {
    /// Words of its block.
    pub const WORDS: usize = HEADER + COMMON + NODES * NODE + 1;

    const LAYOUT: Layout = Layout {
        magic: MAGIC,
        version: VERSION,
        words: Self::WORDS,
        nodes: NODES,
    };

    /// Reads a block that `epas-design` wrote, and checks its checksum, not its numbers. It returns all of the block: firmware that reads one
    /// at set-up calls [`Self::read_from`].
    ///
    /// # Errors
    /// [`Error`] naming `magic`, `version`, `nodes`, `words` (how many there are) or `checksum` (0 for one that is wrong).
    pub const fn read(words: &[u32]) -> Result<Self, Error> {
        let mut folded = Self::EMPTY;
        attempt!(folded.read_from(words));
        Ok(folded)
    }

    /// As [`Self::read`], into a `static`, say: the stack holds no copy.
    ///
    /// # Errors
    /// As those of [`Self::read`]; the place then is as it was.
    pub const fn read_from(&mut self, words: &[u32]) -> Result<(), Error> {
        attempt!(Self::LAYOUT.check(words));
        let mut number = 0;
        while number < NODES {
            read_node(
                &mut self.law.nodes[number],
                words,
                HEADER + COMMON + number * NODE,
            );
            number += 1;
        }
        self.law.deviations = floats(words, HEADER + 9);
        self.law.lift_off = float(words, HEADER + 11);
        self.friction = float(words, HEADER);
        self.lead = float(words, HEADER + 1);
        self.ball_radius = float(words, HEADER + 2);
        self.path_radius = float(words, HEADER + 3);
        self.speed = float(words, HEADER + 4);
        self.reversal_speed = float(words, HEADER + 5);
        self.limits = Limits {
            nut_speed: float(words, HEADER + 6),
            axial_load: float(words, HEADER + 7),
            friction_torque: float(words, HEADER + 8),
        };
        Ok(())
    }

    /// A place for [`Self::read_from`], which no model takes before.
    pub const EMPTY: Self = Self {
        law: BallLaw {
            nodes: [NO_NODE; NODES],
            deviations: [0.0; 2],
            lift_off: 0.0,
        },
        friction: 0.0,
        lead: 0.0,
        ball_radius: 0.0,
        path_radius: 0.0,
        speed: 0.0,
        reversal_speed: 0.0,
        limits: Limits {
            nut_speed: 0.0,
            axial_load: 0.0,
            friction_torque: 0.0,
        },
    };

    /// Writes the block, with the digest of its inputs, to the begin of `words`: for a host.
    ///
    /// # Errors
    /// [`Error`] naming `words`, where there are fewer than [`Self::WORDS`].
    pub fn write(&self, digest: u64, words: &mut [u32]) -> Result<(), Error> {
        let [screw, nut] = self.law.deviations;
        let common = [
            self.friction,
            self.lead,
            self.ball_radius,
            self.path_radius,
            self.speed,
            self.reversal_speed,
            self.limits.nut_speed,
            self.limits.axial_load,
            self.limits.friction_torque,
            screw,
            nut,
            self.law.lift_off,
        ];
        let numbers = common.into_iter().map(f32::to_bits);
        let numbers = numbers.chain(self.law.nodes.iter().flat_map(of_node));
        Self::LAYOUT.write(digest, numbers, words)
    }
}

fn of_node(node: &BallNode) -> impl Iterator<Item = u32> {
    core::iter::once(node.friction.to_bits())
        .chain(node.branches.as_flattened().iter().flat_map(of_knot))
        .chain(
            node.neighbours
                .as_flattened()
                .iter()
                .flat_map(of_neighbours),
        )
        .chain(node.unheld)
}

fn of_knot(knot: &BallKnot) -> impl Iterator<Item = u32> + use<> {
    let BallNumbers {
        free,
        impedance,
        torque,
        slope,
        work,
    } = knot.numbers;
    core::iter::once(knot.load)
        .chain(free)
        .chain(impedance)
        .chain(torque)
        .chain([slope, work])
        .map(f32::to_bits)
}

fn of_neighbours(knot: &NeighbourKnot) -> impl Iterator<Item = u32> + use<> {
    let NeighbourNumbers {
        nodes,
        outward,
        outward_torque,
    } = knot.numbers;
    let lines = |node: RubbedNode| [node.push, node.impedance, node.torque];
    core::iter::once(knot.load)
        .chain(nodes.into_iter().flat_map(lines).flatten())
        .chain(outward)
        .chain([outward_torque])
        .map(f32::to_bits)
}

const NO_NODE: BallNode = BallNode {
    friction: 0.0,
    branches: [[Knot::none(BallNumbers::NONE); KNOTS]; 2],
    neighbours: [[Knot::none(NeighbourNumbers::NONE); NEIGHBOUR_KNOTS]; 2],
    unheld: [0; 2],
};

const fn read_node(node: &mut BallNode, words: &[u32], at: usize) {
    node.friction = float(words, at);
    let mut branch = 0;
    while branch < 2 {
        let knots = at + 1 + branch * BRANCH;
        let mut number = 0;
        while number < KNOTS {
            let at = knots + number * KNOT;
            let next = if number + 1 < KNOTS { at + KNOT } else { at };
            node.branches[branch][number] = Knot::between(
                float(words, at),
                float(words, next),
                BallNumbers {
                    free: floats(words, at + 1),
                    impedance: floats(words, at + 11),
                    torque: floats(words, at + 14),
                    slope: float(words, at + 20),
                    work: float(words, at + 21),
                },
            );
            number += 1;
        }
        let knots = at + 1 + 2 * BRANCH + branch * NEIGHBOUR_BRANCH;
        let last = knots + (NEIGHBOUR_KNOTS - 1) * NEIGHBOUR_KNOT;
        let mut number = 0;
        while number < NEIGHBOUR_KNOTS {
            let at = knots + number * NEIGHBOUR_KNOT;
            let next = if at < last { at + NEIGHBOUR_KNOT } else { last };
            node.neighbours[branch][number] = Knot::between(
                float(words, at),
                float(words, next),
                NeighbourNumbers {
                    nodes: [
                        rubbed_node(words, at + 1),
                        rubbed_node(words, at + 10),
                        rubbed_node(words, at + 19),
                    ],
                    outward: floats(words, at + 28),
                    outward_torque: float(words, at + 31),
                },
            );
            number += 1;
        }
        node.unheld[branch] = word(words, at + NODE - 2 + branch);
        branch += 1;
    }
}

const fn rubbed_node(words: &[u32], at: usize) -> RubbedNode {
    RubbedNode {
        push: floats(words, at),
        impedance: floats(words, at + 3),
        torque: floats(words, at + 6),
    }
}
