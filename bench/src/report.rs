//! `report`: the error of every formula beside its run time, as tables on the screen and as Markdown,
//! one HTML page, SVG, CSV and JSON in a folder.

mod applications;
mod bearings;
mod context;
mod cortex_m;
mod curvature;
mod efficiency;
mod flagship;
mod hertz;
mod kernels;
mod kinematics;
mod loads;
mod measured;
mod memory;
mod published;
mod stability;
mod statistics;
mod summary;
mod times;
mod trains;
mod uncaged;

use std::path::PathBuf;

use crate::document::{Document, Section};
use crate::failure::Failure;
use crate::folder;
use crate::target::TargetFigures;
use crate::timing::compete;
use context::Context;
use flagship::Flagship;

/// Rounds whose medians are a measurement.
const ROUNDS: usize = 1500;

/// Rounds of a look.
const QUICK_ROUNDS: usize = 40;

/// The error of every formula against its run time, on this machine (the main job).
///
/// Prints tables and writes them, with plots, to a folder: report.md, report.html (one page that
/// needs nothing else), and every figure as SVG, CSV and JSON.
#[derive(Debug, PartialEq, Eq, clap::Args)]
pub struct Arguments {
    /// Folder to write to; a report written there before is replaced
    #[arg(long, default_value = "target/report")]
    output: PathBuf,
    /// Timing rounds on this machine: a median over a few is a look, not a measurement
    #[arg(long, default_value_t = ROUNDS)]
    rounds: usize,
    /// Few timing rounds, coarser sweeps, stored figures of the target: a look, not a measurement
    #[arg(long, conflicts_with = "rounds")]
    quick: bool,
    /// Write to a folder that holds other files, and replace those that have a report's names
    #[arg(long)]
    force: bool,
}

impl Default for Arguments {
    fn default() -> Self {
        Self {
            output: "target/report".into(),
            rounds: ROUNDS,
            quick: false,
            force: false,
        }
    }
}

/// Makes a section.
type MakeSection = fn(&Context) -> Result<Section, Failure>;

/// Every section, in the order of the report.
const SECTIONS: [MakeSection; 16] = [
    summary::section,
    curvature::section,
    hertz::section,
    efficiency::section,
    kinematics::section,
    loads::section,
    bearings::section,
    trains::section,
    uncaged::section,
    memory::section,
    applications::section,
    published::section,
    measured::section,
    kernels::section,
    cortex_m::section,
    stability::section,
];

/// Makes the report.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    folder::check(&arguments.output, arguments.force)?;
    let rounds = if arguments.quick {
        QUICK_ROUNDS
    } else {
        arguments.rounds
    };
    let context = Context {
        quick: arguments.quick,
        competition: compete(rounds)?,
        target: TargetFigures::new(arguments.quick)?,
        flagship: Flagship::new(arguments.quick)?,
    };
    let sections = SECTIONS
        .iter()
        .map(|section| section(&context))
        .collect::<Result<Vec<_>, _>>()?;
    let document = Document {
        title: "epas-friction: error against run time".into(),
        sections,
    };
    // Files first: a reader that closes the output early still gets the whole report in files.
    folder::mark(&arguments.output)?;
    document.write(&arguments.output)?;
    document.print(&arguments.output)
}
