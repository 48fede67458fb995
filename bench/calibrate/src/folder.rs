//! Every trace of a folder, and what they have in common.
//!
//! Each trace's answer is written as soon as it is there, and a run that was stopped goes on with the traces that have none. Parts
//! of a folder may be fitted anywhere and merged: the traces are put in the order of their names, and their sums are added, so that
//! every partition has the same answer.

mod page;
mod population;
pub mod references;
mod store;
#[cfg(test)]
mod tests;

use std::collections::BTreeMap;
use std::io::{self, Write as _};
use std::path::{Path, PathBuf};
use std::str::FromStr;

use rayon::prelude::*;

use crate::answer::Calibration;
use crate::sums::Sums;
use epas_page::failure::Failure;
use epas_page::progress::Progress;
use population::Together;
use store::{Ended, Key, Stored, Told};

/// How the traces of a folder are taken.
#[derive(Clone, Debug, Default, PartialEq, Eq, clap::Args)]
pub struct FolderArguments {
    /// Fit only part K of N of the folder's traces, K from 1 to N
    #[arg(long, value_name = "K/N")]
    pub part: Option<Part>,
    /// Merge what runs have written into these folders, fitting nothing
    #[arg(long, value_name = "FOLDER", num_args = 1.., conflicts_with = "part")]
    pub merge: Vec<PathBuf>,
}

/// One part of a folder: every so many traces, from one on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Part {
    /// From 0.
    index: usize,
    /// At least 1.
    count: usize,
}

impl FromStr for Part {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let parsed = text
            .split_once('/')
            .and_then(|(part, count)| Some((part.parse().ok()?, count.parse().ok()?)));
        match parsed {
            Some((part, count)) if (1..=count).contains(&part) => Ok(Self {
                index: part - 1,
                count,
            }),
            _ => Err("K/N with K from 1 to N, as 2/8".into()),
        }
    }
}

/// What is wanted of a folder.
pub struct Folder<'a> {
    /// Where the traces are.
    pub traces: &'a Path,
    /// Where answers and page go.
    pub output: &'a Path,
    /// Part, or what is merged.
    pub arguments: &'a FolderArguments,
    /// Everything that a fit follows from beside the trace, as text: design, filters, choice of parameters. Answers of other
    /// settings are fitted again.
    pub settings: &'a str,
    /// Whether one JSON object is printed.
    pub json: bool,
}

/// Fits every trace with `fit`, one on each core at a time, writes and prints what they tell together.
///
/// `fit` gives the calibration of a trace, and its sums about a reference that is the same for all traces.
///
/// # Errors
/// Folders and files that cannot be read or written; no trace that tells anything.
pub fn run(
    folder: &Folder<'_>,
    fit: impl Fn(&Path) -> Result<(Calibration, Sums), Failure> + Sync,
) -> Result<(), Failure> {
    let together = answer(folder, &fit)?;
    epas_page::folder::mark(folder.output)?;
    let document = page::document(&together);
    document.write(folder.output)?;
    if folder.json {
        let text = serde_json::to_string(&together.json())
            .map_err(|error| Failure::Data(error.to_string()))?;
        writeln!(io::stdout().lock(), "{text}")?;
    } else {
        document.print(folder.output)?;
    }
    together.nothing_told().map_or(Ok(()), Err)
}

/// What the traces tell together, fitted or merged.
fn answer(
    folder: &Folder<'_>,
    fit: &(impl Fn(&Path) -> Result<(Calibration, Sums), Failure> + Sync),
) -> Result<Together, Failure> {
    let stored = if folder.arguments.merge.is_empty() {
        fitted(folder, fit)?
    } else {
        merged(&folder.arguments.merge)?
    };
    Together::of(stored)
}

/// Answers of all traces of the part: those that are there, and the others fitted.
fn fitted(
    folder: &Folder<'_>,
    fit: &(impl Fn(&Path) -> Result<(Calibration, Sums), Failure> + Sync),
) -> Result<Vec<Stored>, Failure> {
    let part = folder.arguments.part.unwrap_or(Part { index: 0, count: 1 });
    let traces: Vec<PathBuf> = store::list(folder.traces, &["csv", "mf4"])?
        .into_iter()
        .skip(part.index)
        .step_by(part.count)
        .collect();
    if traces.is_empty() {
        return Err(Failure::Data(format!(
            "{}: no trace (a file ending in .csv or .mf4){}",
            folder.traces.display(),
            if part.count > 1 { " in this part" } else { "" }
        )));
    }
    // Answers are written one by one, and a run that is stopped here goes on.
    epas_page::folder::mark(folder.output)?;
    let settings = crc32fast::hash(folder.settings.as_bytes());
    let progress = Progress::new("traces", traces.len());
    traces
        .par_iter()
        .map(|trace| {
            let name = store::name(trace);
            let stored = match store::kept(folder.output, trace, &name, settings) {
                Some(stored) => stored,
                None => fit_one(folder.output, trace, name, settings, fit)?,
            };
            progress.step();
            Ok(stored)
        })
        .collect()
}

/// Fits one trace and keeps its answer; one that is refused keeps its word, and does not stop the others.
fn fit_one(
    output: &Path,
    trace: &Path,
    name: String,
    settings: u32,
    fit: &(impl Fn(&Path) -> Result<(Calibration, Sums), Failure> + Sync),
) -> Result<Stored, Failure> {
    let key = match Key::of(trace, settings) {
        Ok(key) => key,
        // A file that cannot be read may be readable next time: nothing is kept.
        Err(failure) => {
            return Ok(Stored {
                trace: name,
                key: Key::default(),
                ended: Ended::Refused(word(failure)?),
            });
        }
    };
    let ended = match fit(trace) {
        Ok((calibration, sums)) => Ended::Told(Box::new(Told::of(&calibration, sums))),
        Err(failure) => Ended::Refused(word(failure)?),
    };
    let stored = Stored {
        trace: name,
        key,
        ended,
    };
    store::write(output, &stored)?;
    Ok(stored)
}

/// Why a trace was refused; another failure stops the run.
fn word(failure: Failure) -> Result<String, Failure> {
    match failure {
        Failure::Data(word) => Ok(word),
        other => Err(other),
    }
}

/// Answers of several runs; a trace that stands in two of them counts once.
fn merged(folders: &[PathBuf]) -> Result<Vec<Stored>, Failure> {
    let mut all: BTreeMap<String, Stored> = BTreeMap::new();
    for folder in folders {
        for stored in store::all(folder)? {
            if let Some(other) = all.get(&stored.trace) {
                if !other.key.same_data(&stored.key) {
                    return Err(Failure::Data(format!(
                        "{}: {} stands in another folder with other data or settings",
                        folder.display(),
                        stored.trace
                    )));
                }
                continue;
            }
            all.insert(stored.trace.clone(), stored);
        }
    }
    Ok(all.into_values().collect())
}
