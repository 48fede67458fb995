//! The longest path of a function with all that it calls.

use std::collections::{BTreeMap, BTreeSet};

use super::code::Code;
use super::context::Context;
use super::graph::Graph;
use super::limits::Known;
use super::loops::loops;
use super::origin::Origins;
use super::paths::{Limit, longest};
use super::steps::steps;
use crate::watch::{Bounded, Watch};
use epas_page::failure::Failure;

#[derive(Clone)]
struct Derived {
    cycles: u64,
    calls: BTreeSet<(u32, Context)>,
    bounded: Vec<Bounded>,
}

/// Longest paths of the functions of an image.
pub struct Worst<'image> {
    code: &'image Code,
    origins: &'image Origins<'image>,
    /// What is known already, or why it is not.
    found: BTreeMap<(u32, Context), Result<Derived, String>>,
    /// Functions that wait for those that they call.
    open: Vec<u32>,
}

impl<'image> Worst<'image> {
    pub fn new(code: &'image Code, origins: &'image Origins<'image>) -> Self {
        Self {
            code,
            origins,
            found: BTreeMap::new(),
            open: Vec::new(),
        }
    }

    /// Most cycles of a function, from its first instruction to its return; or why they are not known.
    pub fn cycles(&mut self, start: u32, context: Context) -> Result<u64, String> {
        if !self.found.contains_key(&(start, context)) {
            let name = self.code.function(start).map_err(text)?.name.clone();
            if self.open.contains(&start) {
                return Err(format!("{name} calls itself"));
            }
            self.open.push(start);
            let found = self.derived(start, context).map_err(|why| {
                // The function itself says where, not each that calls it.
                if why.contains(" in ") {
                    why
                } else {
                    format!("{why} in {name}")
                }
            });
            self.open.pop();
            self.found.insert((start, context), found);
        }
        match &self.found[&(start, context)] {
            Ok(derived) => Ok(derived.cycles),
            Err(why) => Err(why.clone()),
        }
    }

    fn derived(&mut self, start: u32, context: Context) -> Result<Derived, String> {
        let function = self.code.function(start).map_err(text)?;
        let steps = steps(self.code, function).map_err(text)?;
        let graph = Graph::new(&steps, start);
        let loops = loops(&graph).map_err(|block| {
            let address = graph.blocks[block].start();
            format!("the flow at {address:#x} has a loop with several entries")
        })?;
        let mut calls = BTreeSet::new();
        let mut cycles = Vec::with_capacity(graph.edges.len());
        for edge in &graph.edges {
            let mut sum = edge.cycles;
            if let Some(called) = edge.call {
                let call = graph.blocks[edge.from].end();
                let full = &self.code.function(called).map_err(text)?.name;
                let frames = self.origins.frames(call);
                let context = context.of_call(full, &steps, call, &frames)?;
                sum += self.cycles(called, context)?;
                calls.insert((called, context));
            }
            cycles.push(sum);
        }
        let known = Known {
            steps: &steps,
            graph: &graph,
            loops: &loops,
            origins: self.origins,
        };
        let limits = known.limits(context)?;
        Ok(Derived {
            cycles: longest(&graph, &cycles, &limits)?,
            calls,
            bounded: limits
                .into_iter()
                .map(|limit| bounded(&graph, limit))
                .collect(),
        })
    }

    /// The limits of a function and of all that it calls, to hold a run to.
    pub fn watch(&self, start: u32, context: Context) -> Watch {
        let mut watch = Watch::default();
        let mut open = vec![(start, context)];
        let mut met = BTreeSet::new();
        while let Some(next) = open.pop() {
            let Some(Ok(derived)) = self.found.get(&next) else {
                continue;
            };
            // Of a function that is called with several lengths only the first one is watched.
            if met.insert(next.0)
                && let Ok(function) = self.code.function(next.0)
            {
                watch.add(function.start..function.end, &derived.bounded);
                open.extend(&derived.calls);
            }
        }
        watch
    }
}

/// A limit by the addresses of its edges.
fn bounded(graph: &Graph, limit: Limit) -> Bounded {
    let addresses = |(edge, factor): (usize, f64)| {
        let edge = graph.edges[edge];
        let to = graph.blocks.get(edge.to?)?.start();
        Some(((graph.blocks[edge.from].end(), to), factor))
    };
    Bounded {
        terms: limit.terms.into_iter().filter_map(addresses).collect(),
        most: limit.most,
        what: limit.what,
    }
}

fn text(failure: Failure) -> String {
    match failure {
        Failure::Data(text) => text,
        other => format!("{other:?}"),
    }
}
