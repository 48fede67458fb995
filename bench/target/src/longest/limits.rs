//! Limits of a function's loops, from the table of bounds.

use std::collections::BTreeMap;

use super::bounds::{Bound, LOOPS, Row, Total, plain};
use super::context::Context;
use super::graph::Graph;
use super::loops::Loop;
use super::origin::Origins;
use super::paths::Limit;
use super::steps::{Step, Steps};

/// A function as far as it is known.
pub struct Known<'known, 'data> {
    pub steps: &'known Steps,
    pub graph: &'known Graph,
    pub loops: &'known [Loop],
    pub origins: &'known Origins<'data>,
}

/// Limits over all loops and places of a function, with the balls that the first of them knows.
type Totals = BTreeMap<Total, (Context, Limit)>;

impl Known<'_, '_> {
    /// All limits, or why there are none.
    pub fn limits(&self, context: Context) -> Result<Vec<Limit>, String> {
        let mut totals = Totals::new();
        let mut limits = Vec::new();
        for natural in self.loops {
            limits.extend(self.of_loop(natural, context, &mut totals)?);
        }
        for (total, (context, mut limit)) in totals {
            let most = context.count(total.most());
            limit.most = most.ok_or_else(|| format!("no number of balls for {total:?}"))?;
            limit.what = format!("{total:?}");
            limits.push(limit);
        }
        limits.retain(|limit| !limit.terms.is_empty());
        Ok(limits)
    }

    /// The limit of a loop by itself, if it has one, and what it takes from totals.
    fn of_loop(
        &self,
        natural: &Loop,
        context: Context,
        totals: &mut Totals,
    ) -> Result<Option<Limit>, String> {
        let addresses = natural.body.iter().flat_map(|&block| self.addresses(block));
        let frames = self.origins.common(addresses.copied());
        let context = context.within(&frames);
        let mut names = frames.iter().rev().map(|frame| plain(&frame.function));
        let owner = names.find(|name| is_of_a_crate(name)).unwrap_or_default();
        let start = self.graph.blocks[natural.header].start();
        let here = |what: &str| format!("{what} the loop of {owner} at {start:#x}");
        let mut limit = None;
        for &back in &natural.back {
            let row = self.row(&owner, back);
            let bound = row.ok_or_else(|| here("no bound for"))?.bound;
            if let Bound::Takes(taken) = bound {
                for &total in taken {
                    let entry = totals.entry(total).or_default();
                    entry.0 = context;
                    entry.1.add(back, 1.0);
                }
            } else {
                let found = self.limit(natural, bound, context);
                let mut found = found.ok_or_else(|| here("nothing known to count for"))?;
                found.what = here("turns of");
                limit = Some(found);
            }
        }
        Ok(limit)
    }

    fn addresses(&self, block: usize) -> &[u32] {
        &self.graph.blocks[block].addresses
    }

    /// The row of the table for a back edge.
    fn row(&self, owner: &str, back: usize) -> Option<&'static Row> {
        let from = self.graph.edges[back].from;
        LOOPS.iter().find(|row| {
            is_within(owner, row.function)
                && row.through.is_none_or(|through| self.has(from, through))
        })
    }

    /// Whether code of a function stands in a block.
    fn has(&self, block: usize, function: &str) -> bool {
        let mut addresses = self.addresses(block).iter();
        addresses.any(|&address| self.is_of(address, function))
    }

    fn is_of(&self, address: u32, function: &str) -> bool {
        let frames = self.origins.frames(address);
        frames
            .iter()
            .any(|frame| plain(&frame.function) == function)
    }

    /// The limit of a loop by itself: what all back edges take is no more than what all entries bring.
    fn limit(&self, natural: &Loop, bound: Bound, context: Context) -> Option<Limit> {
        let (per_back, per_entry) = match bound {
            Bound::Times(count) => {
                let first = f64::from(natural.asks_at_its_end(self.graph));
                (1.0, context.count(count)? - first)
            }
            Bound::Stores => (f64::from(self.stored(natural)), f64::from(context.bytes?)),
            // What is entered goes around no more than never.
            Bound::Never => (1.0, -1.0),
            Bound::Takes(_) => return None,
        };
        let mut limit = Limit::default();
        for &edge in &natural.back {
            limit.add(edge, per_back);
        }
        for &edge in &natural.entries {
            limit.add(edge, -per_entry);
        }
        // The function itself is entered once.
        limit.most = if natural.header == 0 { per_entry } else { 0.0 };
        (per_back > 0.0).then_some(limit)
    }

    /// Bytes that a loop stores in code that counts each time that it goes around.
    fn stored(&self, natural: &Loop) -> u32 {
        let blocks = natural.always.iter();
        let addresses = blocks.flat_map(|&block| self.addresses(block));
        let steps = addresses.filter_map(|address| self.steps.get(address));
        steps.map(bytes_stored).sum()
    }
}

fn bytes_stored(step: &Step) -> u32 {
    let (name, operands) = step.decoded.text.split_once(' ').unwrap_or_default();
    if step.conditional {
        return 0;
    }
    match name.split('.').next().unwrap_or_default() {
        "strb" => 1,
        "str" => 4,
        "strd" => 8,
        "vstr" => 4 << u32::from(operands.starts_with('d')),
        _ => 0,
    }
}

/// Whether a name is that of a function, or of one within it.
fn is_within(name: &str, function: &str) -> bool {
    let rest = name.strip_prefix(function);
    rest.is_some_and(|rest| rest.is_empty() || rest.starts_with("::"))
}

/// Whether a function is of a crate and not of the language.
fn is_of_a_crate(name: &str) -> bool {
    let crates = [
        "epas_friction::",
        "epas_firmware::",
        "libm::",
        "compiler_builtins::",
    ];
    crates.iter().any(|start| name.starts_with(start))
}
