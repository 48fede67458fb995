//! What a changing load does to the laws.

use rayon::prelude::*;

use super::WIDE;
use super::laws::shown;
use crate::peers::candidates::{LOAD_EXACT, MULTIPLIED, PROPORTIONAL, under_load};
use crate::peers::compare::{
    LOAD_CASES, errors_under_load, exact_under_load, least_loss, load_cycle, work_of_a_load_cycle,
};
use crate::peers::torques;
use crate::report::Context;
use epas_bench::report::draw::{centres, chart, figure, map, table};
use epas_page::document::{Block, Cell};
use epas_page::failure::Failure;
use epas_page::plot::{Axis, Mark, Series};

/// Tables and pictures.
pub fn blocks(context: &Context) -> Result<Vec<Block>, Failure> {
    Ok(vec![
        Block::Text(
            "Under a load that changes, a contact is a row of springs of constant stiffness that meet the surface one after the other; elements may do the same (load-exact), or have limits in \
             proportion to the load, or be multiplied by the load as bristles of tyre models are. Multiplied ones give out energy: a nut that goes out under a low load and comes back under a high \
             one is pushed for ever."
                .into(),
        ),
        errors()?,
        energies(context)?,
        work()?,
        maps(if context.quick { 8 } else { 20 })?,
    ])
}

fn errors() -> Result<Block, Failure> {
    let laws = under_load(1.0);
    let names = laws.iter().map(|law| law.name.as_str());
    let columns: Vec<&str> = ["load", "longest stroke"]
        .into_iter()
        .chain(names)
        .collect();
    let row = |&((least, most), amplitude): &((f64, f64), f64)| {
        let range = Cell::from(format!("{least} to {most}"));
        let errors = errors_under_load(amplitude, (least, most))?.into_iter();
        let errors = errors.map(|(_, error)| Cell::fixed(100.0 * error, 1));
        let head = [range, Cell::fixed(amplitude, 1)];
        Ok(head.into_iter().chain(errors).collect())
    };
    let rows = LOAD_CASES
        .par_iter()
        .map(row)
        .collect::<Result<_, Failure>>()?;
    Ok(Block::Table(table(
        "memory_under_load",
        "Error under a random load and random strokes, per cent of the rms of the exact torque. Loads are over the reference load, strokes over the breakaway angle under it; \
         load-exact elements are made for the largest load of each row",
        &columns,
        rows,
    )))
}

fn energies(context: &Context) -> Result<Block, Failure> {
    let mut rows = Vec::new();
    for (one, other) in under_load(3.0).iter().zip(under_load(1.8)) {
        let least = least_loss(one.start()?.as_mut(), 200_000);
        let work = work_of_a_load_cycle(other.start()?.as_mut());
        rows.push(vec![
            Cell::from(one.name.as_str()),
            Cell::power(least),
            Cell::fixed(work, 4),
            shown(context, &one.cycles),
        ]);
    }
    Ok(Block::Table(table(
        "memory_energy",
        "Energy under a changing load, over limit times breakaway angle: least loss of a tick over 200,000 random ticks with loads of 0.1 to 3, and work in a cycle that goes \
         out by 0.2 under a load of 0.2 to 1 and back under 1 to 1.8. Energy given out is below zero; cycles as in the table of laws",
        &[
            "elements",
            "least loss in a tick",
            "work in a cycle",
            "cycles",
        ],
        rows,
    )))
}

/// Work taken so far, over cycles of the load.
fn work() -> Result<Block, Failure> {
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
    let exact = taken(exact_under_load(&path));
    let mut series = vec![Series::new("exact", 0, Mark::Line, exact)];
    let laws = under_load(1.8);
    for (colour, wanted) in [(1, LOAD_EXACT), (2, PROPORTIONAL), (3, MULTIPLIED)] {
        for law in laws.iter().filter(|law| law.name == wanted) {
            let found = torques(law.start()?.as_mut(), &path);
            series.push(Series::new(wanted, colour, Mark::Line, taken(found)));
        }
    }
    let x = Axis::linear("cycles");
    let y = Axis::linear("work over limit times breakaway angle");
    Ok(figure(
        "memory_energy_picture",
        "Work that friction has taken, over cycles that go out under a low load and back under a high one. It may swing with the stored energy; it must not fall from cycle to cycle.",
        WIDE,
        vec![chart("Energy under a changing load", x, y, series)],
    ))
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

/// Ends of the decimal logarithms of load range and stroke.
const RANGES: (f64, f64) = (0.02, 1.0);
const STROKES: (f64, f64) = (-1.0, 1.0);

fn maps(cells: usize) -> Result<Block, Failure> {
    let places = |ends| centres(ends, cells).map(|exponent| 10_f64.powf(exponent));
    let strokes: Vec<f64> = places(STROKES).collect();
    let lines = strokes
        .into_par_iter()
        .map(|stroke| {
            let ratios = places(RANGES);
            ratios
                .map(|ratio| errors_under_load(stroke, (1.0 / ratio, ratio)))
                .collect()
        })
        .collect::<Result<Vec<Vec<_>>, Failure>>()?;
    let panels = [PROPORTIONAL, LOAD_EXACT, MULTIPLIED].map(|wanted| {
        let error = |errors: &Vec<(String, f64)>| {
            let found = errors.iter().find(|(name, _)| *name == wanted);
            found.map_or(f64::NAN, |(_, error)| 100.0 * error)
        };
        let values = lines.iter().map(|line| line.iter().map(error).collect());
        let x = Axis::linear("log10 of the largest over the reference load")
            .between(RANGES.0, RANGES.1);
        let y = Axis::linear("log10 of the longest stroke over the breakaway angle")
            .between(STROKES.0, STROKES.1);
        map(wanted, (x, y), ("rms error (%)", &BOUNDS), values.collect())
    });
    Ok(figure(
        "memory_load_maps",
        "Error of eight elements over the range of a random load, from one over the largest to the largest, and over the length of random strokes; per cent of the rms of the exact torque.",
        (3, 540, 440),
        panels.into(),
    ))
}
