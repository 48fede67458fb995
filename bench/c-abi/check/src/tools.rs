//! Compilers and what else is run; the header, as cbindgen makes it.

use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The value, or any error with its message.
pub type Outcome<T> = Result<T, Box<dyn std::error::Error>>;

/// What every C file is compiled with.
pub const WARNINGS: [&str; 9] = [
    "-Wall",
    "-Wextra",
    "-Wpedantic",
    "-Wconversion",
    "-Wshadow",
    "-Wstrict-prototypes",
    "-Wdouble-promotion",
    "-Wundef",
    "-Werror",
];

/// The library's name, as the linker wants it.
const ARCHIVE: &str = "libepas_friction_c.a";

/// The undefined function that a panic would call.
pub const PANIC: &str = "epas_friction_has_a_panic_path";

/// Runs a command to its end; what it printed.
pub fn run(command: &mut Command) -> Outcome<String> {
    run_to_end(command).map(|printed| printed.0)
}

/// Runs a command to its end; what it printed, and what it printed as errors.
pub fn run_to_end(command: &mut Command) -> Outcome<(String, String)> {
    let name = command.get_program().to_string_lossy().into_owned();
    let output = command.output().map_err(|error| match error.kind() {
        ErrorKind::NotFound => format!(
            "{name} is not there. On Debian or Ubuntu: apt-get install build-essential \
             gcc-arm-none-eabi qemu-system-arm clang cppcheck. Without cross compiler and QEMU: --host"
        ),
        _ => format!("{name}: {error}"),
    })?;
    let printed = String::from_utf8_lossy(&output.stdout).into_owned();
    let errors = String::from_utf8_lossy(&output.stderr).into_owned();
    if output.status.success() {
        Ok((printed, errors))
    } else {
        Err(format!("{command:?} failed ({})\n{printed}{errors}", output.status).into())
    }
}

/// Builds the library; where it is.
pub fn library(root: &Path, target: Option<&str>, release: bool) -> Outcome<PathBuf> {
    let mut command = Command::new(env!("CARGO"));
    // The configuration with the target's processor is found from here.
    command
        .current_dir(root)
        .args(["build", "--quiet", "--locked", "-p", "epas-friction-c"]);
    let mut folder = root.join("target");
    if let Some(target) = target {
        command.args(["--target", target]);
        folder.push(target);
    }
    if release {
        command.arg("--release");
    }
    run(command.env("CARGO_TARGET_DIR", root.join("target")))?;
    Ok(folder
        .join(if release { "release" } else { "debug" })
        .join(ARCHIVE))
}

/// The symbols of an archive or image that `nm` lists with these options: name and kind.
pub fn symbols(nm: &str, file: &Path) -> Outcome<Vec<(String, char)>> {
    let listed = run(Command::new(nm).arg(file))?;
    Ok(listed
        .lines()
        .filter_map(|line| {
            let mut words = line.split_whitespace().rev();
            let name = words.next()?;
            let kind = words.next()?;
            let mut letters = kind.chars();
            match (letters.next(), letters.next()) {
                (Some(kind), None) => Some((name.to_owned(), kind)),
                _ => None,
            }
        })
        .collect())
}

/// The header that belongs to the library's sources.
pub fn header(root: &Path) -> Outcome<String> {
    let configuration = cbindgen::Config::from_file(root.join("cbindgen.toml"))?;
    let bindings = cbindgen::generate_with_config(root, configuration)
        .map_err(|error| format!("cbindgen: {error}"))?;
    let mut text = Vec::new();
    bindings.write(&mut text);
    Ok(String::from_utf8(text)?)
}
