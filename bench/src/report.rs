//! The main job: the error of every formula and scene beside its run time, stability on stiff and extreme cases, cost on the target; as tables on the
//! screen and as Markdown, one HTML page, SVG, CSV and JSON in a folder.

mod accuracy;
mod cortex_m;
pub mod curvature;
pub mod draw;
mod efficiency;
mod friction;
mod hertz;
mod kernels;
pub mod provenance;
mod stability;
pub mod stages;
pub mod statistics;
mod summary;
pub mod times;
mod trains;
mod uncaged;
mod weave;

use std::path::PathBuf;

use crate::counts::{self, Figures};
use crate::timing::{Competition, compete};
use accuracy::Accuracy;
use epas_page::document::{Document, Part, Section};
use epas_page::failure::Failure;
use epas_page::folder;
use stages::Stages;
use uncaged::Flagship;

/// What every section works with.
pub(crate) struct Context {
    /// Whether coarser sweeps are enough.
    quick: bool,
    competition: Vec<Competition>,
    /// Stored counts on the target.
    counts: Figures,
    /// The ball screw without cage beside the exact one.
    flagship: Flagship,
    /// Errors that README and the page of accuracy print.
    accuracy: Vec<Accuracy>,
}

/// Timing rounds by default: a median that is right to some per cent within two seconds.
const ROUNDS: usize = 90;

/// Timing rounds of a full report.
const FULL_ROUNDS: usize = 1500;

/// Most rounds: far more than a median needs.
const MOST_ROUNDS: usize = 1_000_000;

/// Error against run time of every formula and of every scene of epas-friction, on this machine.
///
/// Prints tables and writes them, with plots, to a folder: report.md, report.html (one page that
/// needs nothing else), and every figure as SVG, CSV and JSON.
///
/// Sweeps are samples of those of --full, from the same domains. Counts of the target are those that epas-target has stored; tables and figures of
/// the four papers are made by epas-papers.
// Each is a switch of the command line.
#[allow(clippy::struct_excessive_bools)]
#[derive(Debug, PartialEq, Eq, clap::Parser)]
#[command(name = "epas-bench", version)]
pub struct Arguments {
    /// Folder to write to; a report written there before is replaced
    #[arg(long, default_value = "target/report")]
    output: PathBuf,
    /// Whole sweeps and 1500 timing rounds: some minutes
    #[arg(long)]
    full: bool,
    /// Timing rounds on this machine [default: 90; 1500 with --full]
    #[arg(long, value_parser = rounds, allow_negative_numbers = true)]
    rounds: Option<usize>,
    /// Store the errors that README and bench/accuracy.md print, and do nothing else
    #[arg(long, exclusive = true)]
    store: bool,
    /// Fail where an error differs from the stored one; its sweeps are those of --full
    #[arg(long)]
    gate: bool,
    /// Replace files of the same names that no report wrote
    #[arg(long)]
    force: bool,
}

/// A number of rounds: a median is over one or more.
pub fn rounds(text: &str) -> Result<usize, String> {
    match text.parse() {
        Ok(rounds) if (1..=MOST_ROUNDS).contains(&rounds) => Ok(rounds),
        _ => Err(format!("rounds are 1 to {MOST_ROUNDS}")),
    }
}

/// Makes a section.
pub type MakeSection<C> = fn(&C) -> Result<Section, Failure>;

/// A section, a line on it, and its share of the time in any unit.
pub type PlannedSection<C> = (MakeSection<C>, &'static str, f64);

/// Heading of a part, whether it is unfolded, and its sections.
pub type Plan<C> = (&'static str, bool, &'static [PlannedSection<C>]);

/// Shares of the time of all sections of some parts.
pub fn shares<C>(plans: &[Plan<C>]) -> impl Iterator<Item = f64> {
    let sections = plans.iter().flat_map(|(_, _, sections)| *sections);
    sections.map(|(_, _, share)| *share)
}

/// Shares of the stages before the sections: times, 37 balls, formulas, errors.
const BEFORE: [f64; 4] = [2.3, 1.7, 0.1, 3.8];

/// Every section, in the order of the report: what firmware steps first, then what it is made of.
#[rustfmt::skip]
const PARTS: [Plan<Context>; 3] = [
    ("Friction", true, &[
        (friction::section, "torque over a manoeuvre, its error and its cost", 0.8),
        (uncaged::section, "37 balls against the exact whole screw; pairs; settings", 5.5),
    ]),
    ("Stability and cost", false, &[
        (stability::section, "worst cases over whole domains, known limits, every promise", 4.0),
        (cortex_m::section, "instructions, modelled cycles, flash, RAM and stack of every function", 0.3),
    ]),
    ("What friction is made of", false, &[
        (trains::section, "how balls are driven apart or together, and what rubbing costs", 0.6),
        (hertz::section, "the contact ellipse against elliptic integrals", 0.1),
        (kernels::section, "roots and angles in single precision", 0.2),
    ]),
];

/// Makes the report. Each section is printed when it is made, the first within seconds.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    if arguments.store {
        return accuracy::store(&accuracy::measured(&Flagship::new(false), false)?);
    }
    let quick = !(arguments.full || arguments.gate);
    let rounds = arguments
        .rounds
        .unwrap_or(if quick { ROUNDS } else { FULL_ROUNDS });
    // A folder that cannot be written to is found before anything is computed.
    folder::check(&arguments.output, arguments.force)?;
    let stages = Stages::new(BEFORE.into_iter().chain(shares(&PARTS)).collect());
    stages.next("times on this machine");
    let competition = compete(rounds)?;
    stages.next("37 balls beside the exact whole screw");
    let mut context = Context {
        quick,
        competition,
        counts: counts::stored()?,
        flagship: Flagship::new(quick),
        accuracy: Vec::new(),
    };
    let made = provenance::lines("epas-bench", rounds);
    for line in &made {
        epas_page::document::print_line(line)?;
    }
    stages.next("every formula: largest error beside the time of one call");
    let summary = summary::section(&context)?;
    summary.print()?;
    stages.next("errors that README prints");
    context.accuracy = accuracy::measured(&context.flagship, quick)?;
    let errors = accuracy::section(&context.accuracy, quick)?;
    errors.print()?;
    let mut parts = parts(&PARTS, &context, &stages)?;
    let first = [
        (
            "every formula: largest error beside the time of one call",
            summary,
        ),
        (
            "every scene and formula: error at the same state, flagged states counted",
            errors,
        ),
    ];
    if let Some(part) = parts.first_mut() {
        part.sections.splice(0..0, first);
    }
    let document = Document {
        title: "epas-friction: friction of a ball screw, its error and its cost".into(),
        made,
        parts,
    };
    folder::mark(&arguments.output)?;
    document.write(&arguments.output)?;
    document.print_where(&arguments.output)?;
    if arguments.gate {
        accuracy::gate(&context.accuracy)?;
    }
    Ok(())
}

/// Makes every part and prints each section when it is made, saying which one it is at.
pub fn parts<C>(plans: &[Plan<C>], context: &C, stages: &Stages) -> Result<Vec<Part>, Failure> {
    plans
        .iter()
        .map(|&(title, open, sections)| {
            let sections = sections.iter().map(|(make, lead, _)| {
                stages.next(lead);
                let section = make(context)?;
                section.print()?;
                Ok((*lead, section))
            });
            Ok(Part {
                title,
                sections: sections.collect::<Result<_, Failure>>()?,
                open,
            })
        })
        .collect()
}
