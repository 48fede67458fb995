//! Error and cost of every law under constant limits.

use super::WIDE;
use crate::peers::candidates::{Candidate, Cycles};
use crate::peers::compare::Comparison;
use crate::report::Context;
use epas_bench::report::draw::{figure, table};
use epas_page::document::{Block, Cell};
use epas_page::failure::Failure;
use epas_page::plot::{Axis, Chart, Mark, Note, Panel, Series};

const COLUMNS: &str = "law | loop of 0.3: area (%) | of 0.7 | of 1 | of 3 | \
     random strokes: rms (% of the limit) | largest | small loop opens by | after five | \
     drift in a cycle, torque 0.3 +- 0.2 | 0.5 +- 0.35 | largest turn in a tick | \
     least loss in a tick | cycles";

pub fn blocks(context: &Context, candidates: &[Candidate]) -> Result<Vec<Block>, Failure> {
    let found = candidates
        .iter()
        .map(|candidate| Ok((candidate, Comparison::new(candidate)?)))
        .collect::<Result<Vec<_>, Failure>>()?;
    let rows = found
        .iter()
        .map(|(candidate, comparison)| row(context, candidate, comparison))
        .collect();
    Ok(vec![
        Block::Table(table(
            "memory_laws",
            "Friction laws against the exact hysteresis. Area of a loop: relative error of what a cycle of that amplitude loses. Small loop: from -0.1 to 0.4 and back, \
             torque missed. Drift: creep of the angle under a torque that swings below breakaway, over the breakaway angle; 1e-7 and less is the resolution of an f32. \
             Largest turn: the largest one in a tick with which sliding still comes to its limit. Least loss: work less gain of stored energy, limits jumping between 0.1 and 3; \
             below zero a law gives out energy that nobody put in. Below an amplitude of 0.15 no element of six or eight slips: no loss, \
             where the exact one is under 0.4 % of that of full friction. Cycles of a Cortex-M4F: modelled where a function is counted on the target, static counts in brackets",
            COLUMNS,
            rows,
        )),
        picture(context, &found),
    ])
}

fn row(context: &Context, candidate: &Candidate, found: &Comparison) -> Vec<Cell> {
    let mut cells = vec![Cell::from(candidate.name.clone())];
    cells.extend(found.areas.map(|error| Cell::fixed(100.0 * error, 1)));
    cells.push(Cell::fixed(100.0 * found.random.0, 2));
    cells.push(Cell::fixed(100.0 * found.random.1, 1));
    cells.push(Cell::fixed(found.opening.0, 3));
    cells.push(Cell::fixed(found.opening.1, 3));
    cells.extend(found.drift.map(Cell::power));
    cells.push(
        found
            .largest_turn
            .map_or_else(|| "any".into(), |turn| Cell::fixed(turn, 2)),
    );
    cells.push(Cell::power(found.least_loss));
    cells.push(shown(context, &candidate.cycles));
    cells
}

pub fn shown(context: &Context, cycles: &Cycles) -> Cell {
    match counted(context, cycles) {
        Some(cycles) => Cell::fixed(cycles, 0),
        None => format!("({})", cycles.expected).into(),
    }
}

fn counted(context: &Context, cycles: &Cycles) -> Option<f64> {
    let function = context.counts.function(cycles.counted?)?;
    Some(function.cycles_max.into())
}

fn picture(context: &Context, found: &[(&Candidate, Comparison)]) -> Block {
    let mut series = Vec::new();
    let mut notes = Vec::new();
    for (ours, name, mark) in [
        (false, "in use today", Mark::Crosses),
        (true, "this crate", Mark::Circles),
    ] {
        let mut points = Vec::new();
        for (candidate, comparison) in found {
            let cycles = counted(context, &candidate.cycles)
                .or_else(|| candidate.cycles.expected.parse().ok());
            // With its best constants a law stands where it stands with others.
            let drawn = candidate.name.starts_with("this crate") == ours
                && !candidate.name.contains("best");
            let Some(cycles) = cycles.filter(|_| drawn) else {
                continue;
            };
            let at = (cycles, 100.0 * comparison.random.0);
            points.push(at);
            notes.push(Note {
                at,
                text: candidate.name.replace("this crate, ", ""),
            });
        }
        series.push(Series::new(name, usize::from(ours), mark, points));
    }
    let panel = Panel::Chart(Chart {
        title: "Friction laws: error against cost".into(),
        x: Axis::linear("cycles of a Cortex-M4F").between(0.0, 300.0),
        y: Axis::log("rms error (% of the limit)").between(0.1, 100.0),
        series,
        notes,
    });
    figure(
        "memory_error_against_cycles",
        "Error over random strokes against cycles of a step, where these are known; LuGre with its Stribeck curve.",
        WIDE,
        vec![panel],
    )
}
