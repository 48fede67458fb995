//! `report`: the error of every formula beside its run time, as tables on the screen and as Markdown,
//! one HTML page, SVG, CSV and JSON in a folder.

mod accuracy;
mod applications;
mod bearings;
mod context;
mod cortex_m;
mod curvature;
mod efficiency;
mod flagship;
mod folder;
mod friction;
mod hertz;
mod kernels;
mod kinematics;
mod loads;
mod measured;
mod memory;
mod provenance;
mod published;
mod stability;
mod stages;
mod statistics;
mod summary;
mod times;
mod trains;
mod uncaged;

use std::path::PathBuf;

use epas_page::document::{Document, Part, Section};
use epas_page::failure::Failure;
use epas_target::TargetFigures;
use crate::timing::compete;
use context::Context;
use flagship::Flagship;
use stages::Stages;

/// Rounds whose medians are a measurement.
const ROUNDS: usize = 1500;

/// Most rounds: far more than a median needs.
const MOST_ROUNDS: usize = 1_000_000;

/// Rounds of a look.
const QUICK_ROUNDS: usize = 40;

/// The error of every formula against its run time, on this machine (the main job).
///
/// Prints tables and writes them, with plots, to a folder: report.md, report.html (one page that
/// needs nothing else), and every figure as SVG, CSV and JSON.
// Each is a switch of the command line.
#[allow(clippy::struct_excessive_bools)]
#[derive(Debug, PartialEq, Eq, clap::Args)]
pub struct Arguments {
    /// Folder to write to; a report written there before is replaced
    #[arg(long, default_value = "target/report")]
    output: PathBuf,
    /// Timing rounds on this machine: a median over a few is a look, not a measurement
    #[arg(long, default_value_t = ROUNDS, value_parser = rounds)]
    rounds: usize,
    /// Few timing rounds, coarser sweeps, stored figures of the target: a look, not a measurement
    #[arg(long, conflicts_with = "rounds")]
    quick: bool,
    /// Store the errors that README and bench/accuracy.md print, and do nothing else
    #[arg(long, exclusive = true)]
    store: bool,
    /// Fail where an error differs from the stored one
    #[arg(long, conflicts_with = "quick")]
    gate: bool,
    /// Replace files of the same names that no report wrote
    #[arg(long)]
    force: bool,
}

/// A number of rounds: a median is over one or more.
fn rounds(text: &str) -> Result<usize, String> {
    match text.parse() {
        Ok(rounds) if (1..=MOST_ROUNDS).contains(&rounds) => Ok(rounds),
        _ => Err(format!("rounds are 1 to {MOST_ROUNDS}")),
    }
}

impl Default for Arguments {
    fn default() -> Self {
        Self {
            output: "target/report".into(),
            rounds: ROUNDS,
            quick: false,
            store: false,
            gate: false,
            force: false,
        }
    }
}

/// Makes a section.
type MakeSection = fn(&Context) -> Result<Section, Failure>;

/// Heading of a part, whether it is unfolded, and its sections with a line on each.
type Plan = (&'static str, bool, &'static [(MakeSection, &'static str)]);

/// Every section, in the order of the report: friction first, then what it is made of, then the papers.
const PARTS: [Plan; 4] = [
    (
        "Friction",
        true,
        &[(
            friction::section,
            "torque over a manoeuvre, its error and its cost",
        )],
    ),
    (
        "Friction in depth",
        false,
        &[
            (
                uncaged::section,
                "37 balls against the exact whole screw; pairs; settings; closed forms",
            ),
            (
                memory::section,
                "reversals: loops, laws in use today, changing loads, noise, compensation",
            ),
            (
                measured::section,
                "figures of real screws beside the model; what decides the friction of a screw",
            ),
            (
                cortex_m::section,
                "instructions, modelled cycles, flash, RAM and stack of every function",
            ),
            (
                stability::section,
                "worst cases over whole domains, known limits, every promise",
            ),
        ],
    ),
    (
        "What friction is made of",
        false,
        &[
            (
                summary::section,
                "every formula: largest error beside the time of one call",
            ),
            (
                trains::section,
                "how balls are driven apart or together, and what rubbing costs",
            ),
            (
                efficiency::section,
                "rolling and full sliding, driving and back-driving",
            ),
            (
                curvature::section,
                "radius of curvature of helical grooves: literature, circular groove, fitted, exact",
            ),
            (
                hertz::section,
                "the contact ellipse against elliptic integrals",
            ),
            (
                kinematics::section,
                "slip, spin and entrainment at the contacts",
            ),
            (loads::section, "shares of the balls in the axial load"),
            (kernels::section, "roots and angles in single precision"),
        ],
    ),
    (
        "The papers",
        false,
        &[
            (
                published::section,
                "every printed number that can be computed, and what did not reproduce",
            ),
            (bearings::section, "rotary and linear bearings of Lin 2019"),
            (
                applications::section,
                "lash, tie rod and wavy grooves of Lin 2019, chapter 4",
            ),
        ],
    ),
];

/// Makes the report.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    if arguments.store {
        return accuracy::store(&accuracy::measured(&Flagship::new(false))?);
    }
    let rounds = if arguments.quick {
        QUICK_ROUNDS
    } else {
        arguments.rounds
    };
    // A folder that cannot be written to is found before anything is computed.
    folder::check(&arguments.output, arguments.force)?;
    let sections: usize = PARTS.iter().map(|(_, _, sections)| sections.len()).sum();
    let stages = Stages::new(sections + 4);
    stages.next("times on this machine");
    let competition = compete(rounds)?;
    stages.next("counts on the target");
    let target = TargetFigures::new(arguments.quick)?;
    stages.next("37 balls beside the exact whole screw");
    let flagship = Flagship::new(arguments.quick);
    stages.next("errors that README prints");
    let accuracy = if arguments.quick {
        accuracy::stored()?
    } else {
        accuracy::measured(&flagship)?
    };
    let context = Context {
        quick: arguments.quick,
        competition,
        target,
        flagship,
        accuracy,
    };
    let document = Document {
        title: "epas-friction: friction of a ball screw, its error and its cost".into(),
        made: provenance::lines(rounds),
        parts: parts(&context, &stages)?,
    };
    // Files first: a reader that closes the output early still gets the whole report in files.
    document.write(&arguments.output)?;
    document.print(&arguments.output)?;
    if arguments.gate {
        accuracy::gate(&context.accuracy)?;
    }
    Ok(())
}

/// Makes every part, saying which section it is at.
fn parts(context: &Context, stages: &Stages) -> Result<Vec<Part>, Failure> {
    PARTS
        .iter()
        .map(|&(title, open, sections)| {
            let sections = sections.iter().map(|(make, lead)| {
                stages.next(lead);
                Ok((*lead, make(context)?))
            });
            Ok(Part {
                title,
                sections: sections.collect::<Result<_, Failure>>()?,
                open,
            })
        })
        .collect()
}
