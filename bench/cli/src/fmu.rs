//! `fmu`: a scene with a design as a co-simulation unit for FMI 2.0 and 3.0.
//!
//! `variables` and `parameters` say what a unit shows, `description` writes that as XML, `models` makes the models behind it and `running`
//! steps them, `unit` puts them together; `library` builds the shared library from `bench/fmu`, whose one job
//! is the foreign interface, and `run` packs the file. The models are those of `simulate`, and their outputs its bits.

mod description;
mod documentation;
mod library;
mod models;
mod parameters;
mod running;
mod scene;
#[cfg(test)]
mod tests;
mod unit;
mod variables;

use std::io::{self, Cursor, Write};
use std::path::PathBuf;

use epas_friction::Faults;
use zip::ZipWriter;
use zip::write::SimpleFileOptions;

use description::{Version, description};
use documentation::documentation;
use epas_design::files::DesignSource;
use epas_page::failure::Failure;
use epas_page::files::{Existing, Pending, ends, refuse_same, standard, told};
use epas_traces::flags::FLAGS;
pub use library::MARK;
pub use running::{Moment, Running};
pub use scene::SceneName;
pub use unit::{Stored, Unit};
pub use variables::{Causality, Choice, Kind, Variable};

/// The flags of accuracy alone: nothing is wrong with the inputs.
pub const ACCURACY: u32 = (Faults::BEYOND_MODEL.bits() | Faults::FORCES_NOT_HELD.bits()) as u32;

/// What flags mean, in words.
pub fn fault_words(faults: u32) -> String {
    let words = FLAGS
        .iter()
        .filter(|flag| faults & u32::from(flag.fault.bits()) != 0)
        .map(|flag| flag.meaning);
    words.collect::<Vec<_>>().join(", ")
}

/// Where a unit's design stands in its file.
pub const RESOURCE: &str = "unit.toml";

/// Writes a co-simulation unit (FMU) of a scene and a design.
///
/// The unit has the inputs, outputs and parameters of the scene: parameters start with the numbers of the design, and may be set before
/// the unit is initialised. Its outputs are those of `simulate`, bit for bit.
///
/// The command needs Rust and a clone of epas-friction, or a library that was built before (--library): it builds the shared library with cargo,
/// for this machine's platform, from bench/fmu of the clone that you are in, or of the one that this program was built from.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// Print the scenes
    #[arg(long, exclusive = true)]
    list: bool,
    /// What the unit is made of
    #[arg(long, value_enum, required_unless_present = "list")]
    scene: Option<SceneName>,
    /// Built-in design, or design file ending in .toml
    #[arg(long, value_name = "NAME|FILE.toml", required_unless_present = "list")]
    design: Option<DesignSource>,
    /// Version of FMI, 2.0 or 3.0
    #[arg(long, value_name = "2|3", default_value = "2", value_parser = version)]
    fmi: Version,
    /// Where the unit goes
    #[arg(long, value_name = "OUT.fmu", required_unless_present = "list")]
    output: Option<PathBuf>,
    /// Shared library that was built before, in place of building one: cargo build --release --package epas-fmu
    #[arg(long, value_name = "LIBRARY")]
    library: Option<PathBuf>,
    /// Replace a file that exists
    #[arg(long)]
    force: bool,
}

fn version(text: &str) -> Result<Version, String> {
    match text {
        "2" | "2.0" => Ok(Version::Two),
        "3" | "3.0" => Ok(Version::Three),
        _ => Err("allowed: 2 (FMI 2.0), 3 (FMI 3.0)".into()),
    }
}

/// Writes the unit, or lists the scenes.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let (Some(scene), Some(design), Some(output)) =
        (arguments.scene, &arguments.design, &arguments.output)
    else {
        let mut stdout = io::stdout().lock();
        for (_, name, about) in SceneName::ALL {
            writeln!(stdout, "{name:22} {about}")?;
        }
        return Ok(());
    };
    let existing = Existing::forced(arguments.force);
    if !ends(output, &["fmu"]) && !standard(output) {
        return Err(Failure::Data(format!(
            "{}: a unit ends in .fmu",
            output.display()
        )));
    }
    existing.check(output)?;
    refuse_same(
        [design.file(), arguments.library.as_deref()],
        std::iter::once(output),
    )?;
    let unit = Unit::new(scene, design)?;
    let place = library::place(arguments.fmi)?;
    let (library, from) = match &arguments.library {
        Some(path) => (library::read(path)?, path.clone()),
        None => library::build()?,
    };
    let file = packed(&unit, arguments.fmi, &place, &library)?;
    let mut pending = Pending::new(output, existing)?;
    pending
        .writer()
        .write_all(&file)
        .map_err(|error| Failure::file("write", output, &error))?;
    pending.finish()?;
    writeln!(
        told(std::iter::once(output)),
        "wrote {}: {} of {}, {} variables; library of {}",
        output.display(),
        scene.name(),
        unit.stored.design,
        unit.variables.len(),
        from.display()
    )?;
    Ok(())
}

fn packed(unit: &Unit, version: Version, place: &str, library: &[u8]) -> Result<Vec<u8>, Failure> {
    let failure = |error: &dyn std::fmt::Display| {
        Failure::Data(format!("the unit cannot be packed: {error}"))
    };
    let stored = toml::to_string(&unit.stored).map_err(|error| failure(&error))?;
    let description = description(unit, version);
    let documentation = documentation(unit, version, place);
    let mut zip = ZipWriter::new(Cursor::new(Vec::new()));
    let options = SimpleFileOptions::default();
    for (name, bytes) in [
        ("modelDescription.xml", description.as_bytes()),
        ("documentation/index.html", documentation.as_bytes()),
        (&format!("resources/{RESOURCE}"), stored.as_bytes()),
        (place, library),
    ] {
        zip.start_file(name, options)
            .map_err(|error| failure(&error))?;
        zip.write_all(bytes).map_err(|error| failure(&error))?;
    }
    let file = zip.finish().map_err(|error| failure(&error))?;
    Ok(file.into_inner())
}
