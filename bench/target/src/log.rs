//! The log of the debug firmware, decoded by `defmt-print` with the strings that stay in the ELF file.

use std::io::{self, Write as _};
use std::process::{Command, Stdio};

use super::tools::{Built, Core, build, check};
use epas_page::failure::Failure;

/// Builds the firmware that logs, runs it, and lets `defmt-print` print its log.
pub fn log() -> Result<(), Failure> {
    check()?;
    let folder = match build(&["log"], Core::M4, "dev", "log")? {
        Built::In(folder) => folder,
        Built::Panics(said) => return Err(Failure::Data(said)),
    };
    let path = folder.join("log");
    let run = Core::M4.run(&path)?;
    printed("defmt-print", &path.to_string_lossy(), &run.output)?;
    if run.passed {
        Ok(())
    } else {
        Err(Failure::Data("the firmware failed".into()))
    }
}

/// Hands a log to the program that prints it with the strings of an image.
fn printed(program: &str, image: &str, log: &[u8]) -> Result<(), Failure> {
    let started = Command::new(program)
        .args(["-e", image, "stdin"])
        .stdin(Stdio::piped())
        .spawn();
    let mut printer = started.map_err(|error| match error.kind() {
        io::ErrorKind::NotFound => Failure::Data(format!(
            "{program} is not installed; this adds it:\n  cargo install defmt-print --locked"
        )),
        _ => Failure::from(error),
    })?;
    if let Some(mut input) = printer.stdin.take() {
        input.write_all(log)?;
    }
    if printer.wait()?.success() {
        Ok(())
    } else {
        Err(Failure::Data(format!(
            "{program} does not decode the log of {image}"
        )))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_missing_printer_is_named_and_a_failing_one_fails() {
        let Err(Failure::Data(message)) = printed("no-such-printer", "log", &[]) else {
            panic!("a program that is not there prints a log");
        };
        assert!(message.contains("cargo install defmt-print"), "{message}");
        let Err(Failure::Data(message)) = printed("false", "log", &[]) else {
            panic!("a log that does not decode passes");
        };
        assert!(message.contains("does not decode"), "{message}");
        printed("true", "log", &[]).unwrap();
    }
}
