//! Errors that README and the page of accuracy print, in one file: `bench/accuracy.json`.
//!
//! `report --store` finds and writes them, `report --gate` compares those of a full report with what is stored, and a test compares both pages with
//! the file.

mod caged;
mod measured;
#[cfg(test)]
mod pages;

use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

pub use measured::{measured, memory};

use super::statistics::Errors;
use crate::report::draw;
use epas_page::document::{Block, Cell, Section, Table};
use epas_page::failure::Failure;
use epas_page::files::{self, Existing};

/// Relative difference of two errors that is let pass: roundings of another processor's library of functions, far below the two digits that pages
/// print.
const SAME: f64 = 1e-3;

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Accuracy {
    pub name: String,
    pub error: String,
    pub largest: f64,
    pub rms: f64,
    /// Share of the states that are flagged; they count in the errors.
    pub flagged: f64,
    pub states: u64,
}

impl Accuracy {
    fn of(name: &str, error: &str, errors: &Errors) -> Self {
        Self {
            name: name.into(),
            error: error.into(),
            largest: errors.largest,
            rms: errors.rms(),
            flagged: 0.0,
            states: errors.count() as u64,
        }
    }

    fn same(&self, other: &Self) -> bool {
        let near = |one: f64, other: f64| (one - other).abs() <= SAME * one.abs();
        near(self.largest, other.largest)
            && near(self.rms, other.rms)
            && (self.flagged, self.states) == (other.flagged, other.states)
    }
}

fn path() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("accuracy.json")
}

pub fn store(found: &[Accuracy]) -> Result<(), Failure> {
    let json = serde_json::to_string_pretty(found)
        .map_err(|error| Failure::Data(format!("cannot write JSON: {error}")))?;
    files::write(&path(), &(json + "\n"), Existing::Replace)
}

pub fn stored() -> Result<Vec<Accuracy>, Failure> {
    serde_json::from_str(include_str!("../../accuracy.json"))
        .map_err(|error| Failure::Data(format!("bench/accuracy.json: {error}")))
}

/// Fails where an error is not the stored one.
pub fn gate(found: &[Accuracy]) -> Result<(), Failure> {
    let differing = differing(&stored()?, found);
    if differing.is_empty() {
        return Ok(());
    }
    Err(Failure::Data(format!(
        "errors are not those stored in bench/accuracy.json:\n{}\nwhere that is meant:\n  \
         cargo run --release -p epas-bench -- --store",
        differing.join("\n")
    )))
}

fn differing(stored: &[Accuracy], found: &[Accuracy]) -> Vec<String> {
    let of = |list: &[Accuracy], name: &str| list.iter().find(|entry| entry.name == name).cloned();
    let changed = stored.iter().filter_map(|before| match of(found, &before.name) {
        None => Some(format!("  {}: stored and not found", before.name)),
        Some(now) if now.same(before) => None,
        Some(now) => Some(format!(
            "  {}: largest {:.3e} -> {:.3e}, rms {:.3e} -> {:.3e}, flagged {} -> {}, states {} -> {}",
            before.name,
            before.largest,
            now.largest,
            before.rms,
            now.rms,
            before.flagged,
            now.flagged,
            before.states,
            now.states
        )),
    });
    let new = found
        .iter()
        .filter(|now| of(stored, &now.name).is_none())
        .map(|now| format!("  {}: found and not stored", now.name));
    changed.chain(new).collect()
}

pub fn section(found: &[Accuracy], quick: bool) -> Result<Section, Failure> {
    Ok(Section {
        title: "Errors of scenes and formulas",
        blocks: vec![Block::Table(errors(found, quick)?)],
    })
}

fn errors(found: &[Accuracy], quick: bool) -> Result<Table, Failure> {
    let stored = stored()?;
    let row = |entry: &Accuracy| {
        let full = stored.iter().find(|stored| stored.name == entry.name);
        vec![
            Cell::from(entry.name.as_str()),
            Cell::power(entry.largest),
            Cell::power(entry.rms),
            Cell::fixed(100.0 * entry.flagged, 1),
            Cell::fixed(entry.states as f64, 0),
            full.map_or("".into(), |full| Cell::power(full.largest)),
            full.map_or("".into(), |full| Cell::power(full.rms)),
            entry.error.as_str().into(),
        ]
    };
    let sweeps = if quick { "samples" } else { "whole sweeps" };
    Ok(draw::table(
        "accuracy",
        format!(
            "Errors at the same state, flagged states counted: {sweeps} of this run, beside those of the whole sweeps (`epas-bench --full`) that README and \
             bench/accuracy.md print; those over every f32 are recorded"
        ),
        "quantity | largest error | rms | flagged (%) | states | stored: largest | rms | \
         error of what, over which states",
        found.iter().map(row).collect(),
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn another_error_fails() {
        let stored = stored().unwrap();
        gate(&stored).unwrap();
        let mut found = stored.clone();
        found[0].largest *= 1.0 + 0.5 * SAME;
        gate(&found).unwrap();
        found[0].largest *= 1.0 + SAME;
        found[1].states += 1;
        found[2].flagged += 1e-6;
        let last = found.pop().unwrap();
        let lines = differing(&stored, &found);
        assert_eq!(lines.len(), 4, "{lines:?}");
        assert!(lines[3].starts_with(&format!("  {}: stored", last.name)));
        assert_eq!(differing(&stored[1..], &stored).len(), 1);
        assert!(gate(&found).unwrap_err().message().contains("-- --store"));
    }
}
