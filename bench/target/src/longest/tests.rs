//! Small functions whose longest paths are known: as graphs made by hand, and as instructions.

use rand::{RngExt as _, SeedableRng as _};
use rand_pcg::Pcg64Mcg;

use super::code::{Code, Function};
use super::flow::Flow;
use super::graph::{Block, Edge, Graph};
use super::loops::{Loop, loops};
use super::paths::{Limit, longest};
use super::steps::steps;

/// A graph of edges from block to block with their cycles; the block beyond the last one is the end.
fn graph(blocks: usize, edges: &[(usize, usize, u64)]) -> Graph {
    Graph {
        blocks: vec![Block::default(); blocks],
        edges: edges
            .iter()
            .map(|&(from, to, cycles)| Edge {
                from,
                to: (to < blocks).then_some(to),
                call: None,
                cycles,
            })
            .collect(),
    }
}

fn cycles(graph: &Graph) -> Vec<u64> {
    graph.edges.iter().map(|edge| edge.cycles).collect()
}

/// So many turns each time that a loop is entered.
fn turns(natural: &Loop, most: f64) -> Limit {
    let mut limit = Limit::default();
    for &edge in &natural.back {
        limit.add(edge, 1.0);
    }
    for &edge in &natural.entries {
        limit.add(edge, -most);
    }
    limit
}

fn most(graph: &Graph, limits: &[Limit]) -> Result<u64, String> {
    longest(graph, &cycles(graph), limits)
}

#[test]
fn the_longer_side_of_a_diamond_counts() {
    let diamond = graph(4, &[(0, 1, 3), (0, 2, 1), (1, 3, 5), (2, 3, 9), (3, 4, 2)]);
    assert_eq!(loops(&diamond), Ok(Vec::new()));
    assert_eq!(most(&diamond, &[]), Ok(1 + 9 + 2));
}

#[test]
fn a_loop_turns_as_often_as_its_bound() {
    let one = graph(3, &[(0, 1, 2), (1, 1, 7), (1, 2, 3), (2, 3, 1)]);
    let found = loops(&one).unwrap();
    assert_eq!((found.len(), &found[0].back[..]), (1, &[1][..]));
    assert!(found[0].asks_at_its_end(&one));
    assert_eq!(most(&one, &[turns(&found[0], 4.0)]), Ok(2 + 4 * 7 + 3 + 1));
    // Without a bound there is no longest path.
    assert!(most(&one, &[]).is_err());
}

#[test]
fn bounds_of_nested_loops_multiply() {
    let nested = graph(
        4,
        &[
            (0, 1, 1),
            (1, 2, 10),
            (2, 2, 100),
            (2, 1, 20),
            (1, 3, 5),
            (3, 4, 1),
        ],
    );
    let found = loops(&nested).unwrap();
    assert_eq!(found.len(), 2);
    assert!(!found[0].asks_at_its_end(&nested));
    let limits = [turns(&found[0], 3.0), turns(&found[1], 2.0)];
    assert_eq!(
        most(&nested, &limits),
        Ok(1 + 3 * (10 + 2 * 100 + 20) + 5 + 1)
    );
}

/// The inner loop turns six times in all, whatever the turns of the outer one.
#[test]
fn a_total_over_all_entries_does_not_multiply() {
    let nested = graph(
        4,
        &[
            (0, 1, 1),
            (1, 2, 10),
            (2, 2, 100),
            (2, 1, 20),
            (1, 3, 5),
            (3, 4, 1),
        ],
    );
    let found = loops(&nested).unwrap();
    let mut total = Limit {
        most: 6.0,
        ..Limit::default()
    };
    total.add(found[1].back[0], 1.0);
    let limits = [turns(&found[0], 3.0), total];
    assert_eq!(
        most(&nested, &limits),
        Ok(1 + 3 * (10 + 20) + 6 * 100 + 5 + 1)
    );
}

#[test]
fn a_loop_with_two_entries_has_no_header() {
    let knot = graph(3, &[(0, 1, 1), (0, 2, 1), (1, 2, 1), (2, 1, 1), (2, 3, 1)]);
    assert!(loops(&knot).is_err_and(|block| block > 0));
}

#[test]
fn what_traps_is_no_end() {
    // The path over block 1 is longer and leads nowhere.
    let trap = graph(3, &[(0, 1, 50), (0, 2, 1), (2, 3, 4)]);
    assert_eq!(most(&trap, &[]), Ok(5));
    assert!(most(&graph(2, &[(0, 1, 1)]), &[]).is_err());
}

/// All paths through graphs without loops.
fn tried(graph: &Graph, block: usize) -> Option<u64> {
    let paths = graph.out_of(block).filter_map(|edge| {
        let edge = graph.edges[edge];
        let rest = edge.to.map_or(Some(0), |to| tried(graph, to))?;
        Some(edge.cycles + rest)
    });
    paths.max()
}

#[test]
fn the_solver_finds_what_trying_all_paths_finds() {
    let mut random = Pcg64Mcg::seed_from_u64(1);
    for _ in 0..100 {
        let blocks = 12;
        let mut edges = Vec::new();
        for from in 0..blocks {
            for _ in 0..random.random_range(1..4) {
                let to = random.random_range(from + 1..=blocks);
                edges.push((from, to, random.random_range(0..100)));
            }
        }
        let graph = graph(blocks, &edges);
        assert_eq!(most(&graph, &[]).ok(), tried(&graph, 0), "{edges:?}");
    }
}

/// Functions of half-words from an address on, the first one under test.
fn code(functions: &[(u32, &[u16])]) -> Code {
    let named = functions.iter().map(|&(start, words)| Function {
        name: format!("function_{start:x}"),
        start,
        end: start + 2 * words.len() as u32,
    });
    let bytes = functions.iter().map(|&(start, words)| {
        let bytes = words.iter().flat_map(|word| word.to_le_bytes());
        (start, bytes.collect())
    });
    Code::new(bytes.collect(), named).unwrap()
}

/// The flow of the first function.
fn flow(functions: &[(u32, &[u16])]) -> Result<Graph, String> {
    let code = code(functions);
    let start = functions[0].0;
    let steps = steps(&code, code.function(start).unwrap());
    let steps = steps.map_err(|error| format!("{error:?}"))?;
    Ok(Graph::new(&steps, start))
}

const BX_LR: u16 = 0x4770;
const NOP: u16 = 0xBF00;

/// `cmp r0, #0`, `beq` over a `nop` and a division to `bx lr`.
#[test]
fn a_branch_costs_more_when_it_is_taken() {
    let words = [0x2800, 0xD002, NOP, 0xFBB0, 0xF0F1, BX_LR];
    let graph = flow(&[(0x100, &words)]).unwrap();
    assert_eq!(graph.blocks.len(), 3);
    let taken = graph
        .edges
        .iter()
        .find(|edge| edge.from == 0 && edge.cycles == 4);
    assert_eq!(taken.and_then(|edge| edge.to), Some(2));
    // Compare 1, branch passed over 1, nop 1, division 12, return 3.
    assert_eq!(most(&graph, &[]), Ok(18));
}

/// `cmp r0, #0`, `itt eq`, `moveq r0, #1`, `bxeq lr`, `nop`, `bx lr`.
#[test]
fn a_block_that_may_be_passed_over_costs_the_same() {
    let words = [0x2800, 0xBF04, 0x2001, BX_LR, NOP, BX_LR];
    let graph = flow(&[(0x100, &words)]).unwrap();
    let ends = graph.edges.iter().filter(|edge| edge.to.is_none()).count();
    assert_eq!((graph.blocks.len(), ends), (2, 2));
    // The return that is passed over costs 3 all the same, as it does in a count.
    assert_eq!(most(&graph, &[]), Ok(1 + 1 + 1 + 3 + 1 + 3));
}

/// `bl` to a function, then `b` to another one.
#[test]
fn calls_and_tail_calls_lead_through_functions() {
    let words = [0xF000, 0xF87E, 0xE0FC];
    let others: &[u16] = &[NOP, BX_LR];
    let graph = flow(&[(0x100, &words), (0x200, others), (0x300, others)]).unwrap();
    let calls: Vec<_> = graph
        .edges
        .iter()
        .map(|edge| (edge.call, edge.to))
        .collect();
    assert_eq!(calls, [(Some(0x200), Some(1)), (Some(0x300), None)]);
    assert_eq!(cycles(&graph), [3, 3]);
}

/// `tbb [pc, r0]` with two entries: `nop`, `bx lr`; `bx lr`.
#[test]
fn a_table_ends_where_its_first_target_stands() {
    let words = [0xE8DF, 0xF000, 0x0301, NOP, BX_LR, BX_LR];
    let graph = flow(&[(0x100, &words)]).unwrap();
    let mut targets: Vec<u32> = graph
        .out_of(0)
        .filter_map(|edge| Some(graph.blocks[graph.edges[edge].to?].start()))
        .collect();
    targets.sort_unstable();
    assert_eq!(targets, [0x106, 0x10A]);
}

#[test]
fn a_call_by_address_is_named() {
    let why = flow(&[(0x100, &[NOP, 0x4798, BX_LR])]).unwrap_err();
    assert!(why.contains("function_100 at 0x102"), "{why}");
    assert_eq!(Flow::of("blx", "r3"), Flow::Unknown);
}
