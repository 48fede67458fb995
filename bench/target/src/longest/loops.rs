//! Loops of a function.

use std::collections::BTreeSet;

use petgraph::algo::dominators::{Dominators, simple_fast};
use petgraph::algo::toposort;
use petgraph::graph::{DiGraph, NodeIndex};

use super::graph::Graph;

/// A natural loop: all that lies on a path from its header back to it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Loop {
    /// The block through which every path into the loop leads.
    pub header: usize,
    /// Blocks of the loop, the header among them.
    pub body: BTreeSet<usize>,
    /// Edges that lead back to the header.
    pub back: Vec<usize>,
    /// Edges that lead to the header from outside.
    pub entries: Vec<usize>,
    /// Blocks of the loop through which every path around it leads.
    pub always: BTreeSet<usize>,
}

impl Loop {
    /// Whether the loop asks at its end, after what it does, whether to go on: then it does it once more than it goes back.
    pub fn asks_at_its_end(&self, graph: &Graph) -> bool {
        self.back.iter().all(|&back| {
            let mut out = graph.out_of(graph.edges[back].from);
            out.any(|edge| {
                graph.edges[edge]
                    .to
                    .is_none_or(|to| !self.body.contains(&to))
            })
        })
    }
}

/// The loops of a function, or a block on a cycle that has no header.
pub fn loops(graph: &Graph) -> Result<Vec<Loop>, usize> {
    let flow = flow(graph, |_| true);
    let dominators = simple_fast(&flow, NodeIndex::new(0));
    let is_back = |edge: usize| {
        let edge = graph.edges[edge];
        edge.to
            .is_some_and(|to| dominates(&dominators, to, edge.from))
    };
    if let Err(cycle) = toposort(&self::flow(graph, |edge| !is_back(edge)), None) {
        return Err(cycle.node_id().index());
    }
    let mut loops = Vec::new();
    for header in 0..graph.blocks.len() {
        let (back, entries): (Vec<usize>, Vec<usize>) =
            graph.into(header).partition(|&edge| is_back(edge));
        if !back.is_empty() {
            let body = body(graph, header, &back);
            let mut always = body.clone();
            always.retain(|&block| {
                let mut latches = back.iter().map(|&edge| graph.edges[edge].from);
                latches.all(|latch| dominates(&dominators, block, latch))
            });
            loops.push(Loop {
                header,
                body,
                back,
                entries,
                always,
            });
        }
    }
    Ok(loops)
}

/// The edges between blocks for which `keep` holds.
fn flow(graph: &Graph, keep: impl Fn(usize) -> bool) -> DiGraph<(), ()> {
    let mut flow = DiGraph::new();
    for _ in &graph.blocks {
        flow.add_node(());
    }
    for (index, edge) in graph.edges.iter().enumerate() {
        if let Some(to) = edge.to
            && keep(index)
        {
            flow.add_edge(NodeIndex::new(edge.from), NodeIndex::new(to), ());
        }
    }
    flow
}

fn dominates(dominators: &Dominators<NodeIndex>, above: usize, below: usize) -> bool {
    dominators
        .dominators(NodeIndex::new(below))
        .is_some_and(|mut all| all.any(|node| node.index() == above))
}

/// All blocks from which the edges back are reached without the header.
fn body(graph: &Graph, header: usize, back: &[usize]) -> BTreeSet<usize> {
    let mut body = BTreeSet::from([header]);
    let mut open: Vec<usize> = back.iter().map(|&edge| graph.edges[edge].from).collect();
    while let Some(block) = open.pop() {
        if body.insert(block) {
            open.extend(graph.into(block).map(|edge| graph.edges[edge].from));
        }
    }
    body
}
