//! `design`: a ball screw solved once, on this machine, into the constants that firmware evaluates, with a certificate of their errors.

use std::collections::BTreeMap;
use std::io::{self, IsTerminal as _, Write};
use std::path::PathBuf;

use clap::ValueEnum as _;
use clap::error::ErrorKind;
use epas_design::{Certificate, Figure, Folded};
use serde::Serialize;

use crate::caged::certified;
use crate::designs::{Design, DesignSource};
use crate::failure::Failure;
use crate::files::{Existing, Pending, ends, refuse_ending, refuse_same, standard, told};

/// Folds a design: solves it once, here, into the constants that firmware evaluates.
///
/// The exact balance of a ball is solved in float64 at hundreds of loads. What comes out is a block of constants for the scene
/// CagedBallScrew, and a certificate: the errors of its friction torque against the exact solver, at 2048 states that were not fitted.
/// The same design gives the same block, bit for bit.
///
/// The certificate is printed. --output also writes the block, in the format that the file's ending names: .rs (Rust), .h (C), .toml, or
/// .bin (each word with its least significant byte first, for a calibration page). --format without --output prints the block, and the
/// certificate to standard error.
///
/// A design file (`simulate --help` names its keys) may say the domain in a table [fold]: friction (a number, or [least, most] for
/// coefficients that change while firmware runs; the design's without), axial_load ([least, most] of a ball, N; [5, 300] without), seed
/// (of the certificate's states; 1 without).
///
/// The law is that of a ball that no other ball presses: of a screw with a cage or spacer balls. A closed form (branch = "rolling" or
/// "sliding") is refused, because it needs no fold. So is a domain over which the torque is not held to 3 %: the exit code is 1, and
/// the message says where.
///
/// --json prints one object: version (of the layout), digest (of the inputs), bytes, domain (axial_load of a ball, N, and friction, each
/// [least, most]), certificate (a list of quantity, largest, rms, mean, states, flagged (share), unit), seed, two_answers (share of the
/// states with two exact answers), unsolved (states without one), seconds.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// Built-in design (`simulate --list` prints all), or design file ending in .toml; - for standard input
    #[arg(value_name = "NAME|GEAR.toml")]
    design: DesignSource,
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
    #[arg(long, requires = "output")]
    force: bool,
}

/// What a block is written as.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
enum Format {
    /// A static of checked constants
    Rust,
    /// A header with an array of words
    C,
    /// An array of words, with the summary as comments
    Toml,
    /// The words alone
    Binary,
}

impl Format {
    /// Endings of its files.
    const fn endings(self) -> &'static [&'static str] {
        match self {
            Self::Rust => &["rs"],
            Self::C => &["h"],
            Self::Toml => &["toml"],
            Self::Binary => &["bin"],
        }
    }
}

/// A block that is written.
struct Target {
    format: Format,
    path: PathBuf,
    existing: Existing,
}

/// Ends the program with exit code 2.
fn usage(kind: ErrorKind, message: &str) -> ! {
    clap::Error::raw(kind, format!("{message}\n")).exit()
}

impl Arguments {
    /// Where the block goes, if anywhere.
    fn target(&self) -> Result<Option<Target>, Failure> {
        let path = match (&self.output, self.format) {
            (Some(path), _) => path.clone(),
            (None, Some(_)) => "-".into(),
            (None, None) => return Ok(None),
        };
        let named = || {
            let formats = Format::value_variants().iter().copied();
            formats.into_iter().find(|one| ends(&path, one.endings()))
        };
        let Some(format) = self.format.or_else(named) else {
            refuse_ending("a block", Some(&path), &["rs", "h", "toml", "bin"])?;
            usage(
                ErrorKind::MissingRequiredArgument,
                "the output's ending names no format: .rs, .h, .toml and .bin do, as does --format",
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
        let existing = if self.force {
            Existing::Replace
        } else {
            Existing::Keep
        };
        existing.check(&path)?;
        refuse_same([self.design.file()], std::iter::once(&path))?;
        Ok(Some(Target {
            format,
            path,
            existing,
        }))
    }
}

/// Folds the design, writes its block and prints its certificate.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let target = arguments.target()?;
    let design = arguments.design.load()?;
    let failure = |message: String| Failure::Data(format!("{}: {message}", design.name));
    let table = &design.fold;
    let fold = table
        .fold(&design)
        .map_err(|message| failure(format!("fold: {message}")))?;
    let folded = certified(&fold).map_err(|error| error.of(&design.name))?;
    let failed = |error: epas_design::Failure| failure(error.to_string());
    let words = folded.words().map_err(failed)?.len();
    if let Some(target) = &target {
        let name = constant(if standard(&target.path) {
            design.name.as_ref()
        } else {
            target.path.file_stem().unwrap_or_default()
        });
        let block = match target.format {
            Format::Rust => folded.rust(&name).map(String::into_bytes),
            Format::C => folded.c(&name).map(String::into_bytes),
            Format::Toml => folded.toml().map(String::into_bytes),
            Format::Binary => folded.bytes(),
        }
        .map_err(failed)?;
        write(target, &block)?;
    }
    let mut out = told(target.iter().map(|target| &target.path));
    if arguments.json {
        let version = folded.version().map_err(failed)?;
        serde_json::to_writer(&mut out, &Shown::of(&folded, version, 4 * words))
            .map_err(io::Error::from)?;
        writeln!(out)?;
        return Ok(());
    }
    print(&mut out, &design, &folded, words)?;
    next(&mut out, target.as_ref(), words, folded.block.nodes())?;
    Ok(())
}

/// The block in its file, whole or not at all.
fn write(target: &Target, block: &[u8]) -> Result<(), Failure> {
    let mut pending = Pending::new(&target.path, target.existing)?;
    pending
        .writer()
        .write_all(block)
        .map_err(|error| Failure::file("write", &target.path, &error))?;
    pending.finish()
}

/// A name for a constant in Rust and C.
fn constant(name: &std::ffi::OsStr) -> String {
    let name: String = name
        .to_string_lossy()
        .chars()
        .map(|letter| match letter {
            'a'..='z' | 'A'..='Z' | '0'..='9' => letter.to_ascii_uppercase(),
            _ => '_',
        })
        .collect();
    if name.starts_with(|first: char| first.is_ascii_uppercase()) {
        name
    } else {
        format!("GEAR_{name}")
    }
}

/// What `--json` prints.
#[derive(Serialize)]
struct Shown {
    version: u32,
    digest: String,
    bytes: usize,
    domain: BTreeMap<&'static str, [f32; 2]>,
    certificate: Vec<ShownFigure>,
    seed: u64,
    two_answers: f64,
    unsolved: usize,
    seconds: f64,
}

#[derive(Serialize)]
struct ShownFigure {
    quantity: &'static str,
    largest: f64,
    rms: f64,
    mean: f64,
    states: usize,
    flagged: f64,
    unit: &'static str,
}

impl Shown {
    fn of(folded: &Folded, version: u32, bytes: usize) -> Self {
        let (least, most) = folded.block.friction_range();
        let Certificate { seed, figures } = &folded.certificate;
        let [torque] = figures;
        Self {
            version,
            digest: format!("{:016x}", folded.digest),
            bytes,
            domain: [
                ("axial_load", folded.fold.axial_load),
                ("friction", [least, most]),
            ]
            .into(),
            certificate: figures
                .iter()
                .map(|figure| ShownFigure {
                    quantity: figure.quantity,
                    largest: figure.largest,
                    rms: figure.rms,
                    mean: figure.mean,
                    states: figure.states,
                    flagged: figure.flagged,
                    unit: "relative",
                })
                .collect(),
            seed: *seed,
            two_answers: torque.two_answers,
            unsolved: torque.unsolved,
            seconds: folded.seconds,
        }
    }
}

/// What was folded, over which domain, and how exact it is.
fn print(out: &mut dyn Write, design: &Design, folded: &Folded, words: usize) -> io::Result<()> {
    let gear = &folded.fold.gear;
    let (least, most) = folded.block.friction_range();
    let [from, to] = folded.fold.axial_load;
    let friction = if least < most {
        format!("{least} to {most}")
    } else {
        least.to_string()
    };
    writeln!(
        out,
        "{}: caged, friction coefficient {}{}, clearance {} um{}, {} loaded balls{}",
        design.name,
        gear.friction,
        design.mark("friction"),
        // To a nanometre: the gap is an f32.
        (1e9 * f64::from(gear.clearance.gap())).round() * 1e-3,
        design.mark("clearance"),
        gear.loaded_balls,
        design.mark("loaded_balls"),
    )?;
    writeln!(
        out,
        "domain: friction coefficient {friction}; axial load {from} to {to} N a ball, both signs"
    )?;
    writeln!(
        out,
        "block: {} bytes, digest {:016x}; folded in {:.1} s\n",
        4 * words,
        folded.digest,
        folded.seconds
    )?;
    let Certificate { seed, figures } = &folded.certificate;
    writeln!(
        out,
        "certificate      largest      rms       mean  states  flagged"
    )?;
    for figure in figures {
        writeln!(
            out,
            "{:14} {:7.3} % {:6.3} % {:+8.4} % {:7} {:6.2} %",
            figure.quantity,
            100.0 * figure.largest,
            100.0 * figure.rms,
            100.0 * figure.mean,
            figure.states,
            100.0 * figure.flagged,
        )?;
        notes(out, *seed, figure)?;
    }
    Ok(())
}

/// What a figure's numbers rest on.
fn notes(out: &mut dyn Write, seed: u64, figure: &Figure) -> io::Result<()> {
    writeln!(
        out,
        "Relative errors against the exact solver, at states that were not fitted (seed {seed}); largest at {:.4} N a ball, friction \
         coefficient {:.4}.",
        figure.worst_load, figure.worst_friction
    )?;
    if figure.two_answers > 0.0 {
        writeln!(
            out,
            "Two exact answers at {:.2} % of the states, where a contact opens later than it closes: the error is that to the nearer one.",
            100.0 * figure.two_answers
        )?;
    }
    if figure.unsolved > 0 {
        writeln!(
            out,
            "Without an exact answer, and not counted: {} states.",
            figure.unsolved
        )?;
    }
    Ok(())
}

/// How firmware takes the block in.
fn next(
    out: &mut dyn Write,
    target: Option<&Target>,
    words: usize,
    nodes: usize,
) -> io::Result<()> {
    let scene = match nodes {
        1 => "CagedBallScrew".to_owned(),
        nodes => format!("CagedBallScrew<{nodes}>"),
    };
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
    match format {
        Format::Rust => writeln!(
            out,
            "    include!(\"{file}\");\n    let mut model = FrictionModel::<{scene}, _>::of(&{name});"
        ),
        Format::C => writeln!(
            out,
            "    #include \"{file}\"    /* {name}_BLOCK, {words} words: what CagedConstants::<{nodes}>::from_block takes */"
        ),
        Format::Toml | Format::Binary => writeln!(
            out,
            "    let constants = CagedConstants::<{nodes}>::from_block(&words)?;    // {words} words\n    \
             let mut model = FrictionModel::<{scene}, _>::of(&constants);"
        ),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_constant_is_named_after_its_file() {
        for (name, wanted) in [
            ("gear", "GEAR"),
            ("lin-4.1", "LIN_4_1"),
            ("29x7x4", "GEAR_29X7X4"),
            ("_ä", "GEAR___"),
            ("", "GEAR_"),
        ] {
            assert_eq!(constant(name.as_ref()), wanted);
        }
    }
}
