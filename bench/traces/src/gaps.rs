//! Empty cells of a table: columns of slower rasters, and samples that are missing.

use crate::clock::LONGEST_GAP;
use crate::marks::{Fault, bridge, leave_out, runs};
use crate::table::Table;
use crate::units::{Part, Quantity};

/// Fills empty cells by straight lines between the column's own samples, and holds its first and last one; rows in which the motion itself
/// is empty are left out. Where several of a column's own samples in a row are missing, they are marked.
pub fn fill(table: &mut Table) -> Result<(), String> {
    let parts = [Part::Nut, Part::Motor, Part::Carriage, Part::Plain];
    let positions = parts.map(Quantity::Position);
    let motion = positions.into_iter().chain(parts.map(Quantity::Speed));
    let mut motion = motion.filter_map(|quantity| table.column(quantity));
    if let Some(motion) = motion.next().or(table.columns.first()) {
        let moves: Vec<bool> = motion.values.iter().map(|value| !value.is_nan()).collect();
        if moves.contains(&false) && moves.contains(&true) {
            table.keep(&moves);
        }
    }
    for place in 0..table.columns.len() {
        let column = &table.columns[place];
        let all = 0..column.values.len();
        let (empty, own): (Vec<usize>, Vec<usize>) =
            all.partition(|sample| column.values[*sample].is_nan());
        if empty.is_empty() {
            continue;
        }
        if own.len() < 2 {
            return Err(format!(
                "column {}: it has fewer than two numbers",
                column.name
            ));
        }
        let mut ticks: Vec<usize> = own.windows(2).map(|pair| pair[1] - pair[0]).collect();
        let middle = ticks.len() / 2;
        let tick = *ticks.select_nth_unstable(middle).1;
        let empty = runs(&empty);
        let inner = |run: &&std::ops::Range<usize>| run.start > 0 && run.end < column.values.len();
        let longest = empty.iter().filter(inner).max_by_key(|run| run.len());
        if let Some(run) = longest.filter(|run| run.len() as f64 > LONGEST_GAP * tick as f64) {
            return Err(format!(
                "column {}: it is empty from row {} to {}: at most {LONGEST_GAP} of its own samples are filled; cut the trace there",
                column.name,
                table.row(run.start),
                table.row(run.end - 1)
            ));
        }
        table.notes.push(format!(
            "column {}: {} samples, interpolated linearly to {}",
            column.name,
            own.len(),
            column.values.len()
        ));
        let column = &mut table.columns[place];
        bridge(&table.times, column, &empty);
        let missing = empty.into_iter().filter(|run| run.len() >= 2 * tick);
        leave_out(table, place, Fault::Missing, missing.collect())?;
    }
    Ok(())
}
