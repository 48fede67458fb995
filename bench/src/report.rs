//! `report`: the error of every formula beside its run time, and the papers' tables and figures.

mod console;
mod curvature_cost;
mod curvature_maps;
mod curvature_sizes;
mod document;
mod efficiency_curves;
mod efficiency_limits;
mod forms;
mod hertz;
mod html;
mod kernels;
mod markdown;

use std::io::{self, Write};
use std::path::{Path, PathBuf};

use crate::failure::Failure;
use crate::files::{self, Existing};
use crate::timing::{Competition, compete};
use document::{Block, Section};

/// Error against run time of every model, on this machine: tables on stdout, and a folder with
/// Markdown, a self-contained HTML page, SVG plots, and CSV and JSON of every figure and table.
#[allow(clippy::doc_markdown)] // Help text, where backticks would stand as they are.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// Folder that the report goes to; a report that is there is replaced
    #[arg(long, value_name = "DIR", default_value = "target/report")]
    output: PathBuf,
    /// Coarser maps and fewer rounds of timing
    #[arg(long)]
    quick: bool,
}

impl Default for Arguments {
    /// What the program does without a subcommand.
    fn default() -> Self {
        Self {
            output: "target/report".into(),
            quick: false,
        }
    }
}

/// What the sections share.
pub struct Context {
    /// Coarser and faster.
    quick: bool,
    /// Every function's time.
    times: Vec<Competition>,
}

impl Context {
    /// The time of a function.
    fn time(&self, key: &str) -> Result<&Competition, Failure> {
        self.times
            .iter()
            .find(|competition| competition.key == key)
            .ok_or_else(|| Failure::Data(format!("{key} has not been timed")))
    }
}

/// Makes a section.
type MakeSection = fn(&Context) -> Result<Section, Failure>;

/// Every section, in the order of the report.
const SECTIONS: [MakeSection; 7] = [
    curvature_sizes::section,
    curvature_maps::section,
    curvature_cost::section,
    efficiency_curves::section,
    efficiency_limits::section,
    hertz::section,
    kernels::section,
];

/// Title of the report.
const TITLE: &str = "Ball-screw friction: error against run time";

/// Makes the report.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    // Timing first, while nothing else has warmed the machine up.
    let context = Context {
        quick: arguments.quick,
        times: compete(if arguments.quick { 60 } else { 1000 })?,
    };
    let sections = SECTIONS
        .iter()
        .map(|section| section(&context))
        .collect::<Result<Vec<_>, _>>()?;

    // Files first: whoever reads only the head of the output gets the whole report all the same.
    let folder = &arguments.output;
    write_files(folder, &sections)?;
    let mut stdout = io::stdout().lock();
    for section in &sections {
        console::print(&mut stdout, section)?;
    }
    writeln!(
        stdout,
        "wrote {} and {}, with every figure and table beside them",
        folder.join("report.html").display(),
        folder.join("report.md").display()
    )?;
    Ok(())
}

fn write_files(folder: &Path, sections: &[Section]) -> Result<(), Failure> {
    let write = |name: &str, contents: &str| -> Result<(), Failure> {
        files::write(&folder.join(name), contents, Existing::Replace)
    };
    for section in sections {
        for block in &section.blocks {
            let data = match block {
                Block::Paragraph(_) => continue,
                Block::Table(table) => table,
                Block::Figure(figure) => {
                    write(&format!("{}.svg", figure.data.id), &figure.svg)?;
                    &figure.data
                }
            };
            write(&format!("{}.csv", data.id), &data.csv()?)?;
            write(&format!("{}.json", data.id), &data.json()?)?;
        }
    }
    write("report.md", &markdown::render(TITLE, sections))?;
    write("report.html", &html::render(TITLE, sections))
}
