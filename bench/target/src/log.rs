//! The log of the debug firmware, decoded with the strings that stay in the ELF file.

use std::fmt::Write as _;
use std::fs;

use defmt_decoder::{DecodeError, Table};

use super::tools::{Built, Core, build, check};
use epas_page::failure::Failure;

/// Builds the firmware that logs, runs it, and gives its log, a line for each message.
pub fn log() -> Result<String, Failure> {
    check()?;
    let folder = match build(&["log"], Core::M4, "dev", "log")? {
        Built::In(folder) => folder,
        Built::Panics(said) => return Err(Failure::Data(said)),
    };
    let path = folder.join("log");
    let image = fs::read(&path).map_err(|error| Failure::file("read", &path, &error))?;
    let table = Table::parse(&image)
        .map_err(|error| Failure::file("read", &path, &error))?
        .ok_or_else(|| Failure::Data(format!("{} has no log strings", path.display())))?;
    let run = Core::M4.run(&path)?;
    let mut decoder = table.new_stream_decoder();
    decoder.received(&run.output);
    let mut text = String::new();
    loop {
        match decoder.decode() {
            Ok(frame) => {
                let level = frame.level().map_or("", |level| level.as_str());
                let _ = writeln!(text, "{level:5} {}", frame.display_message());
            }
            Err(DecodeError::UnexpectedEof) => break,
            Err(DecodeError::Malformed) => {
                return Err(Failure::Data(format!(
                    "the log does not decode after\n{text}"
                )));
            }
        }
    }
    if run.passed {
        Ok(text)
    } else {
        Err(Failure::Data(format!("the firmware failed:\n{text}")))
    }
}
