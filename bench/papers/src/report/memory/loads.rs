//! What a changing load does to the laws.

use rayon::prelude::*;

use super::laws::shown;
use super::panel::PANEL;
use crate::peers::candidates::{LOAD_EXACT, MULTIPLIED, PROPORTIONAL, under_load};
use crate::peers::compare::{
    LOAD_CASES, errors_under_load, exact_under_load, least_loss, load_cycle, work_of_a_load_cycle,
};
use crate::peers::torques;
use crate::report::context::Context;
use epas_page::document::{Block, Cell, Figure, Table};
use epas_page::failure::Failure;
use epas_page::plot::{Axis, Chart, ColourMap, Colours, Mark, Panel, Series};

/// Tables and pictures.
pub fn blocks(context: &Context) -> Result<Vec<Block>, Failure> {
    Ok(vec![
        Block::Text(
            "Under a load that changes, a contact is a row of springs of constant stiffness that meet the surface one after the other; elements may do the same (load-exact), or have limits in \
             proportion to the load, or be multiplied by the load as bristles of tyre models are. Multiplied ones give out energy: a nut that goes out under a low load and comes back under a high \
             one is pushed for ever."
                .into(),
        ),
        Block::Table(errors()?),
        Block::Table(energies(context)?),
        Block::Figure(work()?),
        Block::Figure(maps(if context.quick { 8 } else { 20 })?),
    ])
}

fn errors() -> Result<Table, Failure> {
    let mut columns = vec!["load".to_owned(), "longest stroke".into()];
    let laws = under_load(1.0)?;
    columns.extend(laws.iter().map(|entry| entry.name.to_owned()));
    let rows = LOAD_CASES
        .par_iter()
        .map(|&((least, most), amplitude)| {
            let mut cells = vec![
                Cell::from(format!("{least} to {most}")),
                Cell::fixed(amplitude, 1),
            ];
            let errors = errors_under_load(amplitude, (least, most))?;
            cells.extend(
                errors
                    .into_iter()
                    .map(|(_, error)| Cell::fixed(100.0 * error, 1)),
            );
            Ok(cells)
        })
        .collect::<Result<_, Failure>>()?;
    Ok(Table {
        name: "memory_under_load",
        caption: "Error under a random load and random strokes, per cent of the rms of the exact torque. Loads are over the reference load, strokes over the breakaway angle under it; \
                  load-exact elements are made for the largest load of each row"
            .into(),
        columns,
        rows,
    })
}

fn energies(context: &Context) -> Result<Table, Failure> {
    let rows = under_load(3.0)?
        .into_iter()
        .zip(under_load(1.8)?)
        .map(|(mut one, mut other)| {
            let least = least_loss(one.law.as_mut(), 200_000);
            let work = work_of_a_load_cycle(other.law.as_mut());
            vec![
                Cell::from(one.name),
                Cell::power(least),
                Cell::fixed(work, 4),
                shown(context, &one.cycles),
            ]
        })
        .collect();
    Ok(Table {
        name: "memory_energy",
        caption: "Energy under a changing load, over limit times breakaway angle: least loss of a tick over 200,000 random ticks with loads of 0.1 to 3, and work in a cycle that goes \
                  out by 0.2 under a load of 0.2 to 1 and back under 1 to 1.8. Energy given out is below zero; cycles as in the table of laws"
            .into(),
        columns: ["elements", "least loss in a tick", "work in a cycle", "cycles"].map(String::from).to_vec(),
        rows,
    })
}

/// Work taken so far, over cycles of the load.
fn work() -> Result<Figure, Failure> {
    const TICKS: u32 = 200;
    const CYCLES: u32 = 8;
    let course = load_cycle(TICKS, CYCLES);
    let path = course.path();
    let taken = |torque: Vec<f64>| -> Vec<(f64, f64)> {
        let pieces = path.ticks().zip(torque.windows(2)).zip(1_u32..);
        let mut sum = 0.0;
        pieces
            .map(|((tick, pair), at)| {
                sum += 0.5 * (pair[0] + pair[1]) * tick.turn;
                (f64::from(at) / f64::from(TICKS), sum)
            })
            .collect()
    };
    let mut series = vec![Series::new(
        "exact",
        0,
        Mark::Line,
        taken(exact_under_load(&path)),
    )];
    for (colour, wanted) in [(1, LOAD_EXACT), (2, PROPORTIONAL), (3, MULTIPLIED)] {
        for entry in under_load(1.8)?
            .iter_mut()
            .filter(|entry| entry.name == wanted)
        {
            let found = torques(entry.law.as_mut(), &path);
            series.push(Series::new(wanted, colour, Mark::Line, taken(found)));
        }
    }
    Ok(Figure {
        name: "memory_energy_picture",
        caption: "Work that friction has taken, over cycles that go out under a low load and back under a high one. It may swing with the stored energy; it must not fall from cycle to cycle."
            .into(),
        panels: vec![Panel::Chart(Chart {
            title: "Energy under a changing load".into(),
            x: Axis::linear("cycles"),
            y: Axis::linear("work over limit times breakaway angle"),
            series,
            notes: Vec::new(),
        })],
        columns: 1,
        size: (2 * PANEL.0, PANEL.1),
    })
}

/// Bounds of the bands, per cent.
const BOUNDS: [(f64, &str); 8] = [
    (0.5, "0.5"),
    (1.0, "1"),
    (2.0, "2"),
    (5.0, "5"),
    (10.0, "10"),
    (20.0, "20"),
    (50.0, "50"),
    (100.0, "100"),
];

fn maps(cells: u32) -> Result<Figure, Failure> {
    /// Ends of the decimal logarithms of load range and stroke.
    const RANGES: (f64, f64) = (0.02, 1.0);
    const STROKES: (f64, f64) = (-1.0, 1.0);
    let at = |(start, end): (f64, f64), index: u32| {
        10_f64.powf(start + (end - start) * (f64::from(index) + 0.5) / f64::from(cells))
    };
    let lines = (0..cells)
        .into_par_iter()
        .map(|line| {
            (0..cells)
                .map(|column| {
                    let ratio = at(RANGES, column);
                    errors_under_load(at(STROKES, line), (1.0 / ratio, ratio))
                })
                .collect::<Result<Vec<_>, Failure>>()
        })
        .collect::<Result<Vec<_>, Failure>>()?;
    let panels = [PROPORTIONAL, LOAD_EXACT, MULTIPLIED]
        .into_iter()
        .map(|wanted| {
            let error = |errors: &Vec<(&str, f64)>| {
                let found = errors.iter().find(|(name, _)| *name == wanted);
                found.map_or(f64::NAN, |(_, error)| 100.0 * error)
            };
            Panel::Map(ColourMap {
                title: wanted.into(),
                x: Axis::linear("log10 of the largest over the reference load")
                    .between(RANGES.0, RANGES.1),
                y: Axis::linear("log10 of the longest stroke over the breakaway angle")
                    .between(STROKES.0, STROKES.1),
                quantity: "rms error (%)".into(),
                colours: Colours::Sequential,
                bounds: BOUNDS
                    .iter()
                    .map(|(bound, text)| (*bound, (*text).to_owned()))
                    .collect(),
                values: lines
                    .iter()
                    .map(|line| line.iter().map(error).collect())
                    .collect(),
            })
        })
        .collect();
    Ok(Figure {
        name: "memory_load_maps",
        caption: "Error of eight elements over the range of a random load, from one over the largest to the largest, and over the length of random strokes; per cent of the rms of the exact torque."
            .into(),
        panels,
        columns: 3,
        size: PANEL,
    })
}
