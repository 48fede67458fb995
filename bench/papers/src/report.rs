//! Tables and figures of the four papers, rivals and long studies, as one page.

mod applications;
mod bearings;
mod curvature;
mod efficiency;
mod kinematics;
mod loads;
pub(crate) mod measured;
mod memory;
mod published;
mod uncaged;

use std::path::PathBuf;

use epas_bench::counts::{self, Figures};
use epas_bench::report::stages::Stages;
use epas_bench::report::{Plan, parts, provenance, shares};
use epas_bench::timing::{Competition, compete};
use epas_page::document::{Document, print_line};
use epas_page::failure::Failure;
use epas_page::folder;

/// What every section works with.
pub struct Context {
    /// Whether coarser sweeps are enough.
    quick: bool,
    /// Times on this machine.
    competition: Vec<Competition>,
    /// Stored counts on the target.
    counts: Figures,
}

/// Timing rounds of the papers' ratios of times.
const ROUNDS: usize = 120;

/// What makes the tables and figures of the papers.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// Folder to write to; a report written there before is replaced
    #[arg(long, default_value = "target/papers")]
    output: PathBuf,
    /// Coarser sweeps: a look, not a measurement
    #[arg(long)]
    quick: bool,
    /// Replace files of the same names that no report wrote
    #[arg(long)]
    force: bool,
}

/// Every section.
#[rustfmt::skip]
const PARTS: [Plan<Context>; 3] = [
    ("The papers", true, &[
        (published::section, "every printed number that can be computed, and what did not reproduce", 1.0),
        (curvature::section, "radius of curvature of helical grooves: Tables A1 and A2, Figures 8 to 11", 1.0),
        (efficiency::section, "rolling and full sliding, driving and back-driving", 1.0),
        (kinematics::section, "slip, spin and entrainment at the contacts", 1.0),
        (loads::section, "shares of the balls in the axial load", 1.0),
        (bearings::section, "rotary and linear bearings of Lin 2019", 1.0),
        (applications::section, "lash, tie rod and wavy grooves of Lin 2019, chapter 4", 1.0),
        (uncaged::section, "whole screws of Lin 2019; closed forms of a ball", 1.0),
    ]),
    ("Real screws", false, &[
        (measured::section, "figures of real screws beside the model; what decides the friction of a screw", 1.0),
    ]),
    ("Laws in use today", false, &[
        (memory::section, "reversals: loops, rival laws, changing loads, noise, compensation", 1.0),
    ]),
];

/// Makes the page.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    folder::check(&arguments.output, arguments.force)?;
    let stages = Stages::new(std::iter::once(1.0).chain(shares(&PARTS)).collect());
    let made = provenance::lines("epas-papers", ROUNDS);
    for line in &made {
        print_line(line)?;
    }
    stages.next("times on this machine");
    let context = Context {
        quick: arguments.quick,
        competition: compete(ROUNDS)?,
        counts: counts::stored()?,
    };
    let document = Document {
        title: "epas-friction: tables and figures of four papers, made anew".into(),
        made,
        parts: parts(&PARTS, &context, &stages)?,
    };
    folder::mark(&arguments.output)?;
    document.write(&arguments.output)?;
    document.print_where(&arguments.output)
}
