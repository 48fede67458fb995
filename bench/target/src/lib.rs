//! Builds the firmware, runs it in QEMU, and prints what every function and scene costs there.

// For a program: a failure is a sentence, whose causes the sentence names.
#![allow(clippy::missing_errors_doc)]
// Pages are read by those who work on it: a link to a private item helps them.
#![allow(rustdoc::private_intra_doc_links)]

mod cycles;
mod debugger;
mod image;
mod log;
mod longest;
mod measure;
mod scenes;
mod stored;
mod text;
mod tools;
mod trace;
mod watch;

use std::io::{self, Write as _};

use measure::measure;

use epas_page::failure::Failure;

/// Cost of every function and scene on a Cortex-M4F: builds the firmware and runs it in QEMU.
///
/// Instructions are counted call by call; cycles are those of Arm's table for the Cortex-M4F, a model and no measurement in
/// silicon. Flash, RAM and stack are those of one image for each scene. The same run compares the results of every function with
/// the host's, bit for bit.
///
/// Needs qemu-system-arm and the target thumbv7em-none-eabihf, and says which command adds them.
// Each is a switch of the command line.
#[allow(clippy::struct_excessive_bools)]
#[derive(Debug, clap::Parser)]
#[command(name = "epas-target", version)]
pub struct Arguments {
    /// Print one JSON object instead of tables
    #[arg(long)]
    json: bool,
    /// Fail where a function or a scene costs more than the crate promises, or a function has more than 5 %
    /// more instructions than the stored figures say
    #[arg(long)]
    gate: bool,
    /// Store the figures of this run as those to compare with
    #[arg(long, conflicts_with = "gate")]
    store: bool,
    /// Store the host's results that the firmware compares its own with, and do nothing else
    #[arg(long, conflicts_with_all = ["gate", "store", "json"])]
    store_cases: bool,
    /// Print the log of the debug firmware, sent through defmt and decoded, and do nothing else
    #[arg(long, conflicts_with_all = ["gate", "store", "json", "store_cases"])]
    log: bool,
    /// Print the longest path of every function beside its counts, from one image, and do nothing else; fail where a count
    /// exceeds what the path rests on
    #[arg(long, conflicts_with_all = ["gate", "store", "json", "store_cases", "log"])]
    longest: bool,
}

/// Runs the program.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    if arguments.store_cases {
        return stored::write_cases();
    }
    if arguments.longest {
        return print_longest();
    }
    if arguments.log {
        return log::log();
    }
    let figures = measure()?;
    if arguments.store {
        stored::write_figures(&figures)?;
    }
    let mut out = io::stdout().lock();
    if arguments.json {
        let json = serde_json::to_string_pretty(&figures)
            .map_err(|error| Failure::Data(format!("cannot write JSON: {error}")))?;
        writeln!(out, "{json}")?;
    } else {
        out.write_all(text::text(&figures).as_bytes())?;
    }
    figures.require()?;
    if arguments.gate {
        epas_bench::counts::require(&figures)?;
        stored::gate(&figures)?;
    }
    Ok(())
}

/// Longest paths beside counts; fails where a count is above one, or exceeds a bound.
fn print_longest() -> Result<(), Failure> {
    tools::check()?;
    let (paths, mut beyond) = measure::longest_paths()?;
    io::stdout()
        .lock()
        .write_all(text::longest(&paths).as_bytes())?;
    for path in &paths {
        if path.longest.as_ref().is_ok_and(|&most| path.counted > most) {
            beyond.push(format!("{}: counted above the longest path", path.name));
        }
    }
    if beyond.is_empty() {
        return Ok(());
    }
    Err(Failure::Data(beyond.join("\n")))
}
