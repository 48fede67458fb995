//! Mutation testing of epas-friction in an hour: all mutants that `cargo mutants` lists are compiled into one copy of the crate,
//! each behind a switch that is read while a test runs; the tests are compiled once, and each mutant runs the tests that reach
//! it, the quickest first, until one fails.
//!
//! ```sh
//! cargo install cargo-mutants
//! cargo run --release --manifest-path bench/mutants/Cargo.toml -- --file 'src/train/*.rs' --outcomes target/mutants.json
//! ```
//!
//! Mutants that do not compile behind the switch, or have no place there, and those that no test reaches while it runs (constants
//! of the compiler among them) are for `cargo mutants` itself.

mod failure;
mod list;
mod rewrite;
mod tree;
mod trial;

use std::collections::{BTreeMap, BTreeSet};
use std::path::PathBuf;
use std::sync::Mutex;
use std::time::{Duration, Instant};
use std::{env, thread};

use clap::Parser;

use crate::failure::Failure;
use crate::rewrite::Placed;
use crate::tree::Tree;
use crate::trial::{Outcome, Trial, locked};

/// Outcomes are written at most so often, and at the end: a run that is broken off loses no more.
const BETWEEN_WRITES: Duration = Duration::from_secs(10);

/// All mutants of epas-friction in one build.
#[derive(Debug, Parser)]
struct Arguments {
    /// Files whose mutants are tried, as `cargo mutants -f` takes them; all without.
    #[arg(long = "file", value_name = "GLOB")]
    files: Vec<String>,
    /// Where outcomes are kept; mutants that are in it with an outcome are not tried again, those no longer listed fall out.
    #[arg(long, default_value = "target/mutants.json")]
    outcomes: PathBuf,
    /// Tries again what stands, with the selected tests.
    #[arg(long)]
    standing: bool,
    /// Leaves out tests that take longer, s.
    #[arg(long, default_value_t = 60)]
    longest: u64,
    /// Runs no more tests of a mutant once they take longer in all, s: to find out which fall quickly.
    #[arg(long, default_value_t = 3600)]
    enough: u64,
    /// Mutants by a part of their names, instead of all.
    #[arg(long)]
    only: Option<String>,
    /// Folder of the changed copy; kept.
    #[arg(long, default_value = "target/mutants")]
    folder: PathBuf,
    /// Tests, as `cargo test` selects them.
    #[arg(last = true, default_values = ["-p", "epas-friction", "-p", "epas-reference", "--lib", "--tests"])]
    selection: Vec<String>,
}

fn main() -> Result<(), Failure> {
    let arguments = Arguments::parse();
    let checkout = env::current_dir()?;
    let folder = checkout.join(&arguments.folder);
    let mutants = list::mutants(&checkout, &arguments.files)?;
    println!("{} mutants", mutants.len());
    let mut outcomes = trial::read(&arguments.outcomes)?;
    let listed: BTreeSet<&str> = mutants.iter().map(|mutant| mutant.name.as_str()).collect();
    outcomes.retain(|name, _| listed.contains(name.as_str()));
    let uncompiled =
        |number: &usize| outcomes.get(&mutants[number - 1].name) == Some(&Outcome::Uncompiled);
    let uncompiled: BTreeSet<usize> = (1..=mutants.len()).filter(uncompiled).collect();
    let mut changed: BTreeSet<&str> = mutants.iter().map(|mutant| mutant.file.as_str()).collect();
    changed.insert("src/lib.rs");
    let tree = Tree::copied(
        &checkout,
        &folder.join("tree"),
        &folder.join("target"),
        &changed,
    )?;
    let switched = tree.switched(&mutants, uncompiled)?;
    let programs = tree.programs(&arguments.selection)?;
    let jobs = thread::available_parallelism().map_or(1, usize::from);
    let longest = Duration::from_secs(arguments.longest);
    let trial = Trial {
        environment: tree.environment()?,
        jobs,
        longest,
        enough: Duration::from_secs(arguments.enough),
        folder: folder.join("reached"),
    };
    let tests = trial.tests(&programs)?;
    println!("{} tests", tests.len());

    let outcomes = Mutex::new(outcomes);
    let written = Mutex::new(Instant::now());
    let wanted = |number: usize| {
        let name = &mutants[number - 1].name;
        let open = match locked(&outcomes).get(name) {
            None => true,
            Some(Outcome::Stands(_) | Outcome::Same | Outcome::Unreached) => arguments.standing,
            Some(_) => false,
        };
        open && arguments
            .only
            .as_ref()
            .is_none_or(|part| name.contains(part.as_str()))
    };
    let keep = |number: usize, outcome: Outcome| {
        let mut outcomes = locked(&outcomes);
        let name = mutants[number - 1].name.clone();
        if !matches!(outcome, Outcome::Falls(_)) {
            println!("{number} {name}: {outcome:?}");
        }
        // Other tests that know less of it say nothing new.
        if outcomes
            .get(&name)
            .is_none_or(|before| before.rank() <= outcome.rank())
        {
            outcomes.insert(name, outcome);
        }
        let mut written = locked(&written);
        if written.elapsed() > BETWEEN_WRITES {
            *written = Instant::now();
            if let Err(failure) = trial::write(&arguments.outcomes, &outcomes) {
                eprintln!("{}: {failure}", arguments.outcomes.display());
            }
        }
    };
    let placed: Vec<Placed> = switched
        .placed
        .iter()
        .copied()
        .filter(|mutant| wanted(mutant.number))
        .collect();
    let behind: BTreeSet<usize> = switched.placed.iter().map(|mutant| mutant.number).collect();
    for number in (1..=mutants.len()).filter(|number| !behind.contains(number)) {
        let compiles = !switched.uncompiled.contains(&number);
        let outcome = if compiles {
            Outcome::Unplaced
        } else {
            Outcome::Uncompiled
        };
        locked(&outcomes).insert(mutants[number - 1].name.clone(), outcome);
    }
    trial.tried(
        &tests,
        &placed,
        |number| mutants[number - 1].file.clone(),
        keep,
    );
    let outcomes = locked(&outcomes);
    trial::write(&arguments.outcomes, &outcomes)?;
    print!("{}", summary(&outcomes));
    Ok(())
}

/// How many of each outcome.
fn summary(outcomes: &BTreeMap<String, Outcome>) -> String {
    let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
    for outcome in outcomes.values() {
        let what = match outcome {
            Outcome::Falls(_) => "fall",
            Outcome::Time(_) => "fall by time",
            Outcome::Stands(_) => "stand",
            Outcome::Same => "give the same value in every test",
            Outcome::Unreached => "not reached while tests run",
            Outcome::Uncompiled => "do not compile",
            Outcome::Unplaced => "have no place",
        };
        *counts.entry(what).or_default() += 1;
    }
    counts.iter().fold(String::new(), |text, (what, count)| {
        format!("{text}{count} {what}\n")
    })
}
