//! The flow of a function: blocks of instructions that follow each other, and the edges between blocks.

use std::collections::{BTreeMap, BTreeSet};

use super::steps::{Following, Steps};
use crate::cycles::Instruction;

/// Instructions of which each is followed by the next alone.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Block {
    pub addresses: Vec<u32>,
}

impl Block {
    pub fn start(&self) -> u32 {
        self.addresses.first().copied().unwrap_or_default()
    }

    pub fn end(&self) -> u32 {
        self.addresses.last().copied().unwrap_or_default()
    }
}

/// An edge from one block to another or out of the function.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Edge {
    pub from: usize,
    /// The block that it leads to; none where the function ends.
    pub to: Option<usize>,
    /// A function that runs to its return on this edge.
    pub call: Option<u32>,
    /// Cycles of the block that it leaves and of the edge, the function that is called not counted.
    pub cycles: u64,
}

/// Blocks and edges; the function begins with the first block.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Graph {
    pub blocks: Vec<Block>,
    pub edges: Vec<Edge>,
}

impl Graph {
    /// From the instructions of a function that begins at `start`.
    pub fn new(steps: &Steps, start: u32) -> Self {
        let leaders = leaders(steps, start);
        let index: BTreeMap<u32, usize> = leaders
            .iter()
            .enumerate()
            .map(|(index, &address)| (address, index))
            .collect();
        let mut graph = Self::default();
        for (from, &leader) in leaders.iter().enumerate() {
            let mut block = Block::default();
            let mut inner = 0;
            let mut address = leader;
            while let Some(step) = steps.get(&address) {
                block.addresses.push(address);
                if let [only] = step.following[..]
                    && only.call.is_none()
                    && let Some(next) = only.to
                    && !index.contains_key(&next)
                {
                    inner += cycles(steps, address, only);
                    address = next;
                    continue;
                }
                graph
                    .edges
                    .extend(step.following.iter().map(|&following| Edge {
                        from,
                        to: following.to.and_then(|next| index.get(&next).copied()),
                        call: following.call,
                        cycles: inner + cycles(steps, address, following),
                    }));
                break;
            }
            graph.blocks.push(block);
        }
        graph
    }

    /// Indices of the edges into a block.
    pub fn into(&self, block: usize) -> impl Iterator<Item = usize> + '_ {
        let edges = self.edges.iter().enumerate();
        edges.filter_map(move |(index, edge)| (edge.to == Some(block)).then_some(index))
    }

    /// Indices of the edges out of a block.
    pub fn out_of(&self, block: usize) -> impl Iterator<Item = usize> + '_ {
        let edges = self.edges.iter().enumerate();
        edges.filter_map(move |(index, edge)| (edge.from == block).then_some(index))
    }
}

/// Addresses at which blocks begin, that of the function first.
fn leaders(steps: &Steps, start: u32) -> Vec<u32> {
    let mut leaders = BTreeSet::new();
    let mut met = BTreeSet::new();
    for step in steps.values() {
        let ends = !matches!(step.following[..], [Following { call: None, .. }]);
        for next in step.following.iter().filter_map(|following| following.to) {
            if ends || !met.insert(next) {
                leaders.insert(next);
            }
        }
    }
    leaders.remove(&start);
    std::iter::once(start).chain(leaders).collect()
}

/// Cycles of an instruction, by what is executed after it.
fn cycles(steps: &Steps, address: u32, following: Following) -> u64 {
    let Some(step) = steps.get(&address) else {
        return 0;
    };
    let next = following
        .to
        .filter(|_| following.call.is_none())
        .and_then(|next| steps.get(&next));
    let other = Instruction::new(2, "nop", "");
    let next = next.map_or(&other, |next| &next.decoded.cost);
    u64::from(step.decoded.cost.cycles(next, following.jumps))
}
