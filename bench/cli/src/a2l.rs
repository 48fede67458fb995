//! `a2l`: describes the calibration page and the measured numbers of the friction task for a tuner, from its image.

mod description;
mod variables;

use std::fs;
use std::path::PathBuf;

use description::describe;
use epas_page::failure::Failure;
use epas_page::files::{self, Existing, refuse_ending, refuse_same};
use variables::Variables;

/// An A2L file of the firmware's friction task: addresses and types from the debug information of the image.
///
/// Names, units, limits and long identifiers are those of the table in the firmware's source (bench/firmware/src/friction_task). An image
/// whose page has other fields than this table is refused.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// Image of the friction task, with its debug information
    #[arg(long, value_name = "ELF")]
    image: PathBuf,
    /// A2L file to write
    #[arg(long, value_name = "FILE")]
    output: PathBuf,
    /// Replace the file where there is one
    #[arg(long)]
    force: bool,
}

pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let existing = Existing::forced(arguments.force);
    refuse_ending("a description", Some(&arguments.output), &["a2l"])?;
    existing.check(&arguments.output)?;
    let image = &arguments.image;
    refuse_same([Some(image.as_path())], std::iter::once(&arguments.output))?;
    let bytes = fs::read(image).map_err(|error| Failure::file("read", image, &error))?;
    let name = image.display().to_string();
    let variables = Variables::read(&bytes).map_err(|failure| failure.of(&name))?;
    let text = describe(&variables).map_err(|failure| failure.of(&name))?;
    files::write(&arguments.output, &text, existing)
}
