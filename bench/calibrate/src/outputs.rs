//! What a calibration writes, and where.

pub(crate) mod constants;
pub(crate) mod design_file;
pub(crate) mod drive;
pub mod firmware;

use std::path::{Path, PathBuf};

use serde::Serialize;

use crate::answer::Calibration;
use crate::outputs::design_file::Written;
use crate::page;
use crate::page::picture::Picture;
use crate::page::truth::Truth;
use crate::screw::friction::Screw;
use crate::without_design::drive::Drive;
use epas_page::document::print_line;
use epas_page::failure::Failure;
use epas_page::files::{self, Existing, refuse_ending, refuse_same};
use epas_page::folder;
use epas_traces::source::Source;

/// Where the outputs of a calibration go.
#[derive(Clone, Debug, Default, PartialEq, Eq, clap::Args)]
pub(crate) struct OutputArguments {
    /// Folder of the page with its figures and tables [default: target/calibrate/TRACE]
    #[arg(long, value_name = "FOLDER")]
    pub output: Option<PathBuf>,
    /// Where the design file with the calibrated numbers goes
    #[arg(long, value_name = "OUT.toml", requires = "design")]
    pub design_out: Option<PathBuf>,
    /// Where Rust constants for firmware go: of the screw with a design, else of a drive with losses in proportion to the load
    #[arg(long, value_name = "OUT.rs")]
    pub constants: Option<PathBuf>,
    /// Replace a design file or constants that exist, and write to a folder that holds other files
    #[arg(long)]
    pub force: bool,
    /// Print one JSON object
    #[arg(long)]
    pub json: bool,
}

/// What is known of what was calibrated.
#[derive(Clone, Copy)]
pub(crate) enum Known<'a> {
    /// Text of its design file, and the screw that was fitted.
    Design(&'a str, &'a Screw),
    Drive(&'a Drive),
}

#[derive(Clone, Copy)]
pub(crate) struct Outcome<'a> {
    pub calibration: &'a Calibration,
    pub picture: &'a Picture,
    pub of: Known<'a>,
    /// What the trace was made with, where its file says it.
    pub truth: &'a Truth,
}

impl OutputArguments {
    /// Fails before any work is done where an output would be in the way of a file, or is one of the inputs: the trace or one of those
    /// beside it.
    pub(crate) fn check<const N: usize>(
        &self,
        trace: &Path,
        beside: [Option<&Path>; N],
    ) -> Result<(), Failure> {
        refuse_ending("a design file", self.design_out.as_deref(), &["toml"])?;
        refuse_ending("constants", self.constants.as_deref(), &["rs"])?;
        for path in self.files() {
            self.existing().check(path)?;
        }
        refuse_same(beside.into_iter().chain([Some(trace)]), self.files())?;
        let name = if trace.is_dir() {
            folder_name(trace)
        } else {
            Source(trace).name()
        };
        folder::check(&self.folder(&name), self.force)
    }

    fn files(&self) -> impl Iterator<Item = &PathBuf> {
        self.design_out.iter().chain(&self.constants)
    }

    const fn existing(&self) -> Existing {
        Existing::forced(self.force)
    }

    pub(crate) fn write_drive(&self, drive: &Drive, trace: &str) -> Result<Vec<String>, Failure> {
        let Some(path) = &self.constants else {
            return Ok(Vec::new());
        };
        let numbers = drive.numbers()?;
        files::write(path, &drive::text(&numbers, trace)?, self.existing())?;
        let wrote = format!("wrote {}", path.display());
        Ok([wrote].into_iter().chain(numbers.notes).collect())
    }

    pub(crate) fn folder(&self, trace: &str) -> PathBuf {
        self.output.clone().unwrap_or_else(|| {
            let plain = |letter: char| letter.is_alphanumeric() || "-_".contains(letter);
            let name = trace.replace(|letter| !plain(letter), "_");
            Path::new("target").join("calibrate").join(name)
        })
    }

    /// Writes everything, and prints what is to be told: the page's text and tables, or one JSON object.
    pub(crate) fn write(&self, outcome: Outcome<'_>) -> Result<(), Failure> {
        let Outcome {
            calibration,
            picture,
            of,
            truth,
        } = outcome;
        let (mut told, design) = match of {
            Known::Drive(drive) => (self.write_drive(drive, &picture.name)?, None),
            Known::Design(text, screw) => (Vec::new(), Some((text, screw))),
        };
        let folder = self.folder(&picture.name);
        let document = page::document(calibration, picture, truth, design.is_some());
        folder::mark(&folder)?;
        document.write(&folder)?;
        let mut write = |path: &Path, text: &str| {
            told.push(format!("wrote {}", path.display()));
            files::write(path, text, self.existing())
        };
        let mut left = Vec::new();
        if let (Some((text, screw)), true) = (design, self.files().next().is_some()) {
            let told = (calibration, Some(screw));
            let Written {
                text,
                design,
                left_out,
                at_bound,
            } = design_file::written(text, told, &picture.name)
                .map_err(|message| Failure::Data(format!("the calibrated design: {message}")))?;
            if let Some(path) = &self.design_out {
                write(path, &text)?;
                let bound = "not written, because at a bound or beside one that is:";
                left = vec![
                    ("a design file has no key for", left_out),
                    (bound, at_bound),
                ];
            }
            if let Some(path) = &self.constants {
                write(path, &constants::text(&design, &picture.name)?)?;
            }
        }
        if self.json {
            return print_json(calibration);
        }
        document.print(&folder)?;
        let left = left.into_iter().filter(|(_, names)| !names.is_empty());
        told.extend(left.map(|(words, names)| format!("{words} {}", names.join(", "))));
        told.iter().try_for_each(|line| print_line(line))
    }
}

pub(crate) fn folder_name(traces: &Path) -> String {
    traces.file_name().map_or_else(
        || "folder".into(),
        |name| name.to_string_lossy().into_owned(),
    )
}

pub(crate) fn print_json(object: &impl Serialize) -> Result<(), Failure> {
    let text = serde_json::to_string(object).map_err(|error| Failure::Data(error.to_string()))?;
    print_line(&text)
}
