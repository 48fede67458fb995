//! Empty cells of a table: columns of slower rasters, and samples that are missing.
//!
//! A column is what its own samples say, on the raster of what moves, by the rules of measurement files
//! ([`epas_traces::mdf4`]): interpolated linearly between neighbouring samples, held for one tick of its own beyond its ends.
//! Rows in which the motion itself is empty are left out.

use super::{Column, Table};
use epas_traces::mdf4::columns::Times;
use epas_traces::mdf4::raster::{Track, align};
use epas_traces::mdf4::samples::Samples;
use epas_traces::units::{Part, Quantity};

/// A table without empty cells.
///
/// # Errors
/// A column with too few samples, or with gaps.
pub fn filled(table: Table) -> Result<Table, String> {
    let whole = |column: &Column| !column.values.iter().any(|value| value.is_nan());
    if table.columns.iter().all(whole) {
        return Ok(table);
    }
    let moves = moving(&table).unwrap_or_default();
    let mut rasters: Vec<Vec<bool>> = Vec::new();
    let mut groups = Vec::new();
    for column in &table.columns {
        let own: Vec<bool> = column.values.iter().map(|value| !value.is_nan()).collect();
        if own.iter().filter(|own| **own).count() < 2 {
            return Err(format!(
                "column {}: it has fewer than two numbers",
                column.name
            ));
        }
        let known = rasters.iter().position(|known| *known == own);
        groups.push(known.unwrap_or_else(|| {
            rasters.push(own);
            rasters.len() - 1
        }));
    }
    let kept = |values: &[f64], raster: &[bool]| -> Vec<f64> {
        let pairs = values.iter().zip(raster);
        pairs.filter(|(_, own)| **own).map(|(v, _)| *v).collect()
    };
    let samples = |values: &[f64], group: usize| Samples {
        values: kept(values, &rasters[group]),
        valid: Vec::new(),
    };
    let times: Times = (0..rasters.len())
        .map(|group| (group, samples(&table.times, group)))
        .collect();
    let tracks: Vec<Track> = table
        .columns
        .iter()
        .zip(&groups)
        .map(|(column, group)| Track {
            name: column.name.clone(),
            quantity: column.quantity,
            unit: column.unit,
            group: *group,
            samples: samples(&column.values, *group),
        })
        .collect();
    let found = align(&times, &tracks, groups[moves])?;
    let left = left(&table.times, &found.times);
    let columns = table.columns.into_iter().zip(found.columns);
    Ok(Table {
        columns: columns
            .map(|(column, found)| Column {
                values: found.values,
                ..column
            })
            .collect(),
        times: found.times,
        notes: found
            .notes
            .iter()
            .map(|note| note.replacen("channel", "column", 1))
            .collect(),
        left,
        ..table
    })
}

/// The column whose raster is taken: a position, else a speed, else the first one.
fn moving(table: &Table) -> Option<usize> {
    let parts = [Part::Nut, Part::Motor, Part::Carriage, Part::Plain];
    let of = |of: fn(Part) -> Quantity| {
        parts.into_iter().find_map(|part| {
            table
                .columns
                .iter()
                .position(|column| column.quantity == of(part))
        })
    };
    of(Quantity::Position).or_else(|| of(Quantity::Speed))
}

/// Places of some times among others, both of which rise.
fn left(all: &[f64], times: &[f64]) -> Vec<usize> {
    let mut place = 0;
    times
        .iter()
        .map(|time| {
            while all.get(place).is_some_and(|other| other < time) {
                place += 1;
            }
            place
        })
        .collect()
}
