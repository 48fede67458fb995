//! Every trace of a folder, and what they have in common.
//!
//! Each trace's answer is written as soon as it is there, and a run that was stopped goes on with the traces that have none. Parts
//! of a folder may be fitted anywhere and merged: what the traces tell together follows from the list of their answers in the order of
//! their names, so that every partition has the same answer to the last bit.

pub mod answered;
mod page;
pub mod population;
mod store;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::str::FromStr;

use rayon::prelude::*;
use serde_json::{Value, json};

use crate::answer::Calibration;
use crate::outputs::print_json;
use answered::{Answered, alike};
use epas_page::failure::Failure;
use epas_page::progress::Progress;
use population::{HALF_INTERVAL, Outlier, Population, outliers, populations};
pub use store::list;
use store::{Key, Stored, Told};

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
/// `fit` gives the calibration of a trace, and what it adds to the population.
pub fn run(
    folder: &Folder<'_>,
    fit: impl Fn(&Path) -> Result<(Calibration, Answered), Failure> + Sync,
) -> Result<(), Failure> {
    let together = answer(folder, &fit)?;
    epas_page::folder::mark(folder.output)?;
    let document = page::document(&together);
    document.write(folder.output)?;
    if folder.json {
        print_json(&together.json())?;
    } else {
        document.print(folder.output)?;
    }
    together.nothing_told().map_or(Ok(()), Err)
}

#[derive(Default)]
struct Together {
    /// One for each trace, in the order of their names.
    traces: Vec<Stored>,
    population: Vec<Population>,
    /// The same without the traces that stand out; empty where none does.
    without_outliers: Vec<Population>,
    outliers: Vec<Outlier>,
}

impl Together {
    /// Puts traces in the order of their names, and looks what they tell together.
    fn of(mut traces: Vec<Stored>) -> Result<Self, Failure> {
        traces.sort_by(|one, other| one.trace.cmp(&other.trace));
        let mut together = Self {
            traces,
            ..Self::default()
        };
        let outliers = together.far();
        let far = |name: &str| outliers.iter().any(|out| out.trace == name);
        let told = together.told();
        let all: Vec<&Answered> = told.map(|(_, told)| &told.answered).collect();
        let near = together.told().filter(|(name, _)| !far(name));
        let near: Vec<&Answered> = near.map(|(_, told)| &told.answered).collect();
        alike(&all).map_err(Failure::Data)?;
        let without = (near.len() < all.len()).then(|| populations(&near));
        together.population = populations(&all);
        together.without_outliers = without.unwrap_or_default();
        together.outliers = outliers;
        Ok(together)
    }

    fn told(&self) -> impl Iterator<Item = (&str, &Told)> {
        let all = self.traces.iter();
        all.filter_map(|stored| Some((&*stored.trace, stored.ended.as_ref().ok()?)))
    }

    fn refused(&self) -> impl Iterator<Item = (&str, &str)> {
        let all = self.traces.iter();
        all.filter_map(|stored| Some((&*stored.trace, &**stored.ended.as_ref().err()?)))
    }

    fn far(&self) -> Vec<Outlier> {
        let mut all: BTreeMap<&str, Vec<(&str, f64, f64)>> = BTreeMap::new();
        for (trace, told) in self.told() {
            for (name, entry) in told.estimates() {
                let ends = ["value", "low", "high"].map(|key| entry[key].as_f64());
                if let [Some(value), Some(low), Some(high)] = ends {
                    let error = 0.5 * (high - low) / HALF_INTERVAL;
                    all.entry(name).or_default().push((trace, value, error));
                }
            }
        }
        let all = all.into_iter();
        all.flat_map(|(name, told)| outliers(name, &told)).collect()
    }

    fn nothing_told(&self) -> Option<Failure> {
        if self.told().next().is_some() {
            return None;
        }
        let word = self.refused().next().map_or_else(
            || "there is none".into(),
            |(trace, word)| format!("{trace}: {word}"),
        );
        Some(Failure::Data(format!("no trace tells anything; {word}")))
    }

    fn json(&self) -> Value {
        let answer = |stored: &Stored| match &stored.ended {
            Ok(told) => told.answer.clone(),
            Err(word) => json!({ "error": word }),
        };
        let traces = self.traces.iter();
        json!({
            "traces": traces
                .map(|stored| (stored.trace.clone(), answer(stored)))
                .collect::<serde_json::Map<_, _>>(),
            "population": self.population,
            "population_without_outliers": self.without_outliers,
            "outliers": self.outliers,
        })
    }
}

type Fit<'a> = &'a (dyn Fn(&Path) -> Result<(Calibration, Answered), Failure> + Sync);

fn answer(folder: &Folder<'_>, fit: Fit<'_>) -> Result<Together, Failure> {
    Together::of(match &*folder.arguments.merge {
        [] => fitted(folder, fit)?,
        folders => merged(folders)?,
    })
}

/// Answers of all traces of the part: those that are there, and the others fitted.
fn fitted(folder: &Folder<'_>, fit: Fit<'_>) -> Result<Vec<Stored>, Failure> {
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
    let progress = Progress::new("traces", traces.len());
    let one = |trace: &PathBuf| {
        let stored = one(folder, trace, fit)?;
        progress.step();
        Ok(stored)
    };
    traces.par_iter().map(one).collect()
}

/// The answer of one trace: kept, or fitted and kept. One that is refused keeps its word, and does not stop the others.
fn one(folder: &Folder<'_>, trace: &Path, fit: Fit<'_>) -> Result<Stored, Failure> {
    let stored = |key, ended| Stored {
        trace: store::name(trace),
        key,
        ended,
    };
    // One that is refused says why; another failure ends the run.
    let word = |failure| match failure {
        Failure::Data(word) => Ok(Err(word)),
        other => Err(other),
    };
    let key = match Key::of(trace, folder.settings) {
        Ok(key) => key,
        // A file that cannot be read may be readable next time: nothing is kept.
        Err(failure) => return Ok(stored(Key::default(), word(failure)?)),
    };
    if let Some(kept) = store::kept(folder.output, &store::name(trace), &key) {
        return Ok(kept);
    }
    let told = fit(trace).and_then(|(calibration, answered)| {
        let answer = serde_json::to_value(calibration);
        let answer = answer.map_err(|error| Failure::Data(error.to_string()))?;
        Ok(Told { answer, answered })
    });
    let stored = stored(key, told.map_or_else(word, |told| Ok(Ok(told)))?);
    store::write(folder.output, &stored)?;
    Ok(stored)
}

/// Answers of several runs; a trace that stands in two of them counts once.
fn merged(folders: &[PathBuf]) -> Result<Vec<Stored>, Failure> {
    let mut all: BTreeMap<String, Stored> = BTreeMap::new();
    for folder in folders {
        for stored in store::all(folder)? {
            let known = all.entry(stored.trace.clone());
            if known.or_insert_with(|| stored.clone()).key != stored.key {
                return Err(Failure::Data(format!(
                    "{}: {} stands in another folder with other data or settings",
                    folder.display(),
                    stored.trace
                )));
            }
        }
    }
    Ok(all.into_values().collect())
}

#[cfg(test)]
mod tests;
