//! `design`: a ball screw solved once, on this machine, into the constants that firmware evaluates, with a certificate of their errors.

mod c99;
mod made;
#[cfg(test)]
mod tests;

use std::io::{self, IsTerminal as _, Write};
use std::path::{Path, PathBuf};

use clap::ValueEnum as _;
use clap::error::ErrorKind;

use epas_calibrate::outputs::firmware;
use epas_design::files::train::no_row;
use epas_design::files::{Design, DesignSource};
use epas_design::{caged_scene as caged, folds, uncaged_scene as uncaged};
use epas_page::failure::Failure;
use epas_page::files::{self, Existing, Pending, ends, refuse_ending, refuse_same, standard, told};
use epas_page::progress::Progress;
use made::Made;

/// Folds a design: solves it once, here, into the constants that firmware evaluates.
///
/// The exact balance of a ball is solved in float64 at hundreds of loads. What comes out is a block of constants, and a certificate: the errors
/// of its friction against the exact solver, at states that were not fitted. The same design gives the same block, bit for bit.
///
/// With --scene caged the block is that of the scene CagedBallScrew: of a screw with a cage or spacer balls, whose balls press on nothing. With
/// --scene uncaged it is the ball of the scene UncagedBallScrew, over the deviations of the contact angles too.
///
/// The certificate is printed. --output also writes the block, in the format that the file's ending names: .rs (Rust), .h (C), .toml, or
/// .bin (each word with its least significant byte first, for a calibration page). --format without --output prints the block, and the
/// certificate to standard error.
///
/// --output gear.c writes C99 for processors without a Rust compiler, and gear.h beside it: constants, step and memory of a caged screw, with the
/// bits of the Rust crate. The memory is by the design, or by the table [calibration] of its file. A screw without cage is refused.
///
/// --new gear.toml writes a design file to start from. A design file may say the domain in a table [fold]: friction (a number, or [least, most]
/// for coefficients that change while firmware runs; without, the design's, or all that its calibrated law takes), axial_load ([least, most] of a ball, N; [5, 300] without),
/// seed (of the certificate's states; 1 without).
///
/// For --scene uncaged it may also have screw_deviation and nut_deviation (largest, rad; without, what the maps of [uncaged] reach, at
/// least 1e-4).
///
/// A closed form (branch = "rolling" or "sliding") is refused, because it needs no fold: simulate --reference compares it with the exact ball. So is a domain over which the torque is not accurate to
/// 3 %: the exit code is 1, and the message says where.
///
/// Firmware without a host needs no fold: built_in("25x5x3.175") of the crate's module scene has the block of any built-in design.
///
/// --json prints one object: version (of the layout), digest (of the inputs and of the version of the fold), bytes, domain (axial_load of a ball, N, friction, and without
/// cage screw_deviation and nut_deviation, rad, each [least, most]), certificate, seed, two_answers (with a cage: share of the states with two
/// exact answers), unsolved (states without one), seconds.
///
/// The certificate is a list of quantity (caged_torque of one ball, or ring_torque and ring_force of rows of balls, with rubbing_ before it where they rub, wave_ where
/// deviations go in waves), largest, rms, mean, states, flagged (share), unit.
// Each is a switch of the command line.
#[allow(clippy::struct_excessive_bools)]
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// Built-in design (`simulate --list` prints all), or design file ending in .toml; - for standard input
    #[arg(value_name = "NAME|GEAR.toml", required_unless_present_any = ["new", "store", "gate"])]
    design: Option<DesignSource>,
    /// Write a design file to start from, every key with its unit, its range and where it stands on a drawing
    #[arg(
        long,
        value_name = "GEAR.toml",
        conflicts_with_all = ["design", "scene", "format", "output", "json"]
    )]
    new: Option<PathBuf>,
    /// Whose ball is folded [default: uncaged where the table [fold] gives a deviation, else caged]
    #[arg(long, value_enum)]
    scene: Option<Scene>,
    /// What the block is written as [default: what the output's ending names]
    #[arg(long, value_enum)]
    format: Option<Format>,
    /// Where the block goes; - for standard output
    #[arg(long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Print one JSON object in the place of the text
    #[arg(long)]
    json: bool,
    /// Replace a file that exists
    #[arg(long)]
    force: bool,
    /// Fold every built-in design anew and store the blocks that the program brings with it, in its checkout, and do nothing else
    #[arg(long, exclusive = true)]
    store: bool,
    /// Fold every built-in design anew, in the checkout, and fail where a block that the program brings with it has other bits, and do nothing else
    #[arg(long, exclusive = true)]
    gate: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
enum Scene {
    /// A ball screw whose balls do not touch
    Caged,
    /// A ball screw whose balls press on each other
    Uncaged,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum Format {
    /// A static of checked constants
    Rust,
    /// A header with an array of words
    C,
    /// An array of words, with the summary as comments
    Toml,
    /// The words alone
    Binary,
    /// A source and its header: constants, step and memory of a caged screw
    C99,
}

impl Format {
    const fn endings(self) -> &'static [&'static str] {
        match self {
            Self::Rust => &["rs"],
            Self::C => &["h"],
            Self::Toml => &["toml"],
            Self::Binary => &["bin"],
            Self::C99 => &["c"],
        }
    }
}

struct Target {
    format: Format,
    path: PathBuf,
    /// Of C99, beside it.
    header: Option<PathBuf>,
    existing: Existing,
}

fn usage(kind: ErrorKind, message: &str) -> ! {
    clap::Error::raw(kind, format!("{message}\n")).exit()
}

impl Arguments {
    const fn existing(&self) -> Existing {
        Existing::forced(self.force)
    }

    fn target(&self) -> Result<Option<Target>, Failure> {
        let path = match (&self.output, self.format) {
            (Some(path), _) => path.clone(),
            (None, Some(_)) => "-".into(),
            (None, None) if self.force => usage(
                ErrorKind::MissingRequiredArgument,
                "--force replaces a file, and none is written: --output names one",
            ),
            (None, None) => return Ok(None),
        };
        let named = || {
            let formats = Format::value_variants().iter().copied();
            formats.into_iter().find(|one| ends(&path, one.endings()))
        };
        let Some(format) = self.format.or_else(named) else {
            refuse_ending("a block", Some(&path), &["rs", "h", "toml", "bin", "c"])?;
            usage(
                ErrorKind::MissingRequiredArgument,
                "the output's ending names no format: .rs, .h, .toml, .bin and .c do, as does --format",
            );
        };
        refuse_ending("a block of this format", Some(&path), format.endings())?;
        if standard(&path) && self.json {
            usage(
                ErrorKind::ArgumentConflict,
                "--json and the block both go to standard output; --output names a file for the block",
            );
        }
        if standard(&path) && format == Format::Binary && io::stdout().is_terminal() {
            usage(
                ErrorKind::ArgumentConflict,
                "a terminal shows no binary block; --output names a file for it",
            );
        }
        if format == Format::C99 && !ends(&path, format.endings()) {
            usage(
                ErrorKind::MissingRequiredArgument,
                "C99 is two files, a source and its header: --output gear.c names both",
            );
        }
        let header = (format == Format::C99).then(|| c99::header(&path));
        let existing = self.existing();
        for path in std::iter::once(&path).chain(&header) {
            existing.check(path)?;
        }
        let file = self.design.as_ref().and_then(DesignSource::file);
        refuse_same([file], std::iter::once(&path).chain(&header))?;
        Ok(Some(Target {
            format,
            path,
            header,
            existing,
        }))
    }
}

pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    if let Some(path) = &arguments.new {
        return start(path, arguments.existing());
    }
    // Without a design the parser asks for one of these.
    let Some(source) = &arguments.design else {
        return built_in(arguments.store);
    };
    let target = arguments.target()?;
    let design = source.load()?;
    let remembers = target
        .as_ref()
        .is_some_and(|target| target.header.is_some());
    if remembers {
        let presses = chosen(&design.fold, arguments.scene) == Scene::Uncaged;
        c99::check(&design, presses)?;
    }
    let made = made(&design, arguments.scene, remembers)?;
    let words = made.words()?.len();
    if let Some(target) = &target {
        let name = constant(if standard(&target.path) {
            design.name.as_ref()
        } else {
            target.path.file_stem().unwrap_or_default()
        });
        if let (Some(header), Made::Caged(folded)) = (&target.header, &made) {
            let stem = target
                .path
                .file_stem()
                .unwrap_or_default()
                .to_string_lossy();
            let files = c99::files(folded, &design, [&name.to_ascii_lowercase(), &stem])?;
            files::write(header, &files.header, target.existing)?;
            files::write(&target.path, &files.source, target.existing)?;
        } else {
            let block = made.written(target.format, &name)?;
            write(target, &block)?;
        }
    }
    let mut out = told(target.iter().map(|target| &target.path));
    if arguments.json {
        serde_json::to_writer(&mut out, &made.shown()?).map_err(io::Error::from)?;
        writeln!(out)?;
        return Ok(());
    }
    made.print(&mut out, &design, words)?;
    next(&mut out, target.as_ref(), &made, words)?;
    Ok(())
}

pub const START: &str = include_str!("../../designs/rack-29x7.toml");

fn start(path: &Path, existing: Existing) -> Result<(), Failure> {
    refuse_ending("a design file", Some(path), &["toml"])?;
    if !standard(path) && !ends(path, &["toml"]) {
        return Err(Failure::Data(format!(
            "{}: a design file ends in .toml",
            path.display()
        )));
    }
    existing.check(path)?;
    files::write(path, START, existing)?;
    if !standard(path) {
        let path = path.display();
        writeln!(
            io::stdout(),
            "wrote {path}, a rack-assist gear; put your drawing's numbers in, then: design {path}"
        )?;
    }
    Ok(())
}

fn built_in(store: bool) -> Result<(), Failure> {
    if store {
        return Ok(folds::store()?);
    }
    let blocks = folds::gate()?;
    writeln!(
        io::stdout(),
        "{blocks} blocks of built-in designs have the bits of a new fold"
    )?;
    Ok(())
}

fn chosen(table: &epas_design::files::fold::FoldTable, asked: Option<Scene>) -> Scene {
    asked.unwrap_or(if table.says_deviations() {
        Scene::Uncaged
    } else {
        Scene::Caged
    })
}

/// Folds a design; `remembers`: with the memory of its calibration.
fn made(design: &Design, scene: Option<Scene>, remembers: bool) -> Result<Made, Failure> {
    let table = &design.fold;
    let failure = |message: String| Failure::Data(format!("{}: {message}", design.name));
    let of_fold = |message: String| failure(format!("fold: {message}"));
    let named = |error: epas_design::Failure| error.of(&design.name);
    let progress = Progress::of_fold();
    match chosen(table, scene) {
        Scene::Caged => {
            // What a calibrated coefficient takes, as `calibrate --constants` folds it.
            let (least, largest) = firmware::coefficients(design)?;
            let fold = if least < largest && (remembers || !table.says_friction()) {
                caged::fold_for(design, (least, largest)).map_err(failure)?
            } else {
                table.fold(design).map_err(of_fold)?
            };
            let folded = caged::certified(&fold, &|share| progress.share(share)).map_err(named)?;
            Ok(Made::Caged(Box::new(folded)))
        }
        Scene::Uncaged if design.uncaged.is_none() && !table.says_deviations() => {
            Err(Failure::Data(no_row(&design.name)))
        }
        Scene::Uncaged => {
            let row = design.uncaged.as_ref();
            let fold = table.fold_uncaged(design, row).map_err(of_fold)?;
            let folded =
                uncaged::certified(&fold, &|share| progress.share(share)).map_err(named)?;
            Ok(Made::Uncaged(Box::new(folded)))
        }
    }
}

fn write(target: &Target, block: &[u8]) -> Result<(), Failure> {
    let mut pending = Pending::new(&target.path, target.existing)?;
    pending
        .writer()
        .write_all(block)
        .map_err(|error| Failure::file("write", &target.path, &error))?;
    pending.finish()
}

/// A name for a constant in Rust and C: letters and digits, what is between them as one underscore.
fn constant(name: &std::ffi::OsStr) -> String {
    let name = name.to_string_lossy().to_ascii_uppercase();
    let parts: Vec<&str> = name
        .split(|letter: char| !letter.is_ascii_alphanumeric())
        .filter(|part| !part.is_empty())
        .collect();
    let name = parts.join("_");
    if name.starts_with(|first: char| first.is_ascii_uppercase()) {
        name
    } else if name.is_empty() {
        "GEAR".into()
    } else {
        format!("GEAR_{name}")
    }
}

fn next(out: &mut dyn Write, target: Option<&Target>, made: &Made, words: usize) -> io::Result<()> {
    let Some(Target { format, path, .. }) = target.filter(|target| !standard(&target.path)) else {
        if target.is_none() {
            writeln!(
                out,
                "\nNext: --output gear.rs writes the block for firmware (gear.h for C, gear.toml, gear.bin for a calibration page)."
            )?;
        }
        return Ok(());
    };
    let file = path.file_name().unwrap_or_default().to_string_lossy();
    let name = constant(path.file_stem().unwrap_or_default());
    writeln!(out, "\nwrote {}; in firmware:", path.display())?;
    made.next(out, *format, (&file, &name), words)
}
