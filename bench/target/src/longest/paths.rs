//! The longest path by implicit enumeration: how often each edge is taken is a variable, what flows into a block flows
//! out of it, limits bound loops, and the sum of all cycles is the largest possible.
//!
//! Y.-T. S. Li and S. Malik, "Performance analysis of embedded software using implicit path enumeration", 1995. Counts need not be whole
//! numbers here: the largest sum over real ones is no less than that over whole ones.

use std::collections::BTreeMap;

use microlp::{ComparisonOp, LinearExpr, OptimizationDirection, Problem, Variable};

use super::graph::Graph;

/// What bounds loops: the sum over some edges of their count times a factor is at most a number.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Limit {
    pub terms: BTreeMap<usize, f64>,
    pub most: f64,
    pub what: String,
}

impl Limit {
    /// Adds the count of an edge times a factor.
    pub fn add(&mut self, edge: usize, factor: f64) {
        *self.terms.entry(edge).or_default() += factor;
    }
}

/// Most cycles from the first block to the end, with the cycles of each edge; none where no path reaches an end. Else why
/// there is no answer.
pub fn longest(graph: &Graph, cycles: &[u64], limits: &[Limit]) -> Result<u64, String> {
    let mut problem = Problem::new(OptimizationDirection::Maximize);
    let counts: Vec<Variable> = cycles
        .iter()
        .map(|&cycles| problem.add_var(cycles as f64, (0.0, f64::INFINITY)))
        .collect();
    for block in 0..graph.blocks.len() {
        let mut balance = LinearExpr::empty();
        for edge in graph.out_of(block) {
            // Of an edge from a block to itself nothing is left in the balance.
            if graph.edges[edge].to != Some(block) {
                balance.add(counts[edge], 1.0);
            }
        }
        for edge in graph.into(block) {
            if graph.edges[edge].from != block {
                balance.add(counts[edge], -1.0);
            }
        }
        let entered = if block == 0 { 1.0 } else { 0.0 };
        problem.add_constraint(balance, ComparisonOp::Eq, entered);
    }
    for limit in limits {
        let mut sum = LinearExpr::empty();
        for (&edge, &factor) in &limit.terms {
            sum.add(counts[edge], factor);
        }
        problem.add_constraint(sum, ComparisonOp::Le, limit.most);
    }
    let solution = problem
        .solve()
        .map_err(|error| error.to_string())?
        .into_solution()
        .map_err(|_| "the solver gave up".to_owned())?;
    // The sum over whole numbers is a whole number itself, no larger than this one; sums of the solver are right to 1e-6.
    let most = solution.objective();
    Ok((most + 1e-6 * most + 1e-3).floor() as u64)
}
