//! The shared library of a unit: built from the sources, or built before.

use std::env::consts::{ARCH, DLL_PREFIX, DLL_SUFFIX, OS};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use super::description::{LIBRARY, Version};
use epas_page::failure::Failure;

/// What the library carries, so that another file is noticed.
pub const MARK: &[u8; 21] = b"epas-friction's units";

const SOURCES: &str = "bench/fmu";

/// Folder of its sources: in the checkout that the user is in, else in the one that this program was built from.
fn sources() -> Option<PathBuf> {
    let here = std::env::current_dir().ok();
    let around = here.iter().flat_map(|here| here.ancestors());
    let around = around.map(|folder| folder.join(SOURCES));
    let own = Path::new(env!("CARGO_MANIFEST_DIR")).join("../fmu");
    around
        .chain([own])
        .find(|sources| sources.join("Cargo.toml").is_file())
}

fn how() -> String {
    format!(
        "fmu builds the unit's library from a clone of epas-friction, and there is none here. In a clone: \
         cargo build --release --package epas-fmu; then here: --library CLONE/target/release/{DLL_PREFIX}epas_fmu{DLL_SUFFIX}"
    )
}

/// Platforms with their names in FMI 2.0, where it has one, and in FMI 3.0, with what they are: processor and system.
const PLATFORMS: [(Option<&str>, &str, [&str; 2]); 6] = [
    (Some("linux64"), "x86_64-linux", ["x86_64", "linux"]),
    (Some("win64"), "x86_64-windows", ["x86_64", "windows"]),
    (Some("darwin64"), "x86_64-darwin", ["x86_64", "macos"]),
    (None, "aarch64-linux", ["aarch64", "linux"]),
    (None, "aarch64-windows", ["aarch64", "windows"]),
    (None, "aarch64-darwin", ["aarch64", "macos"]),
];

/// Folders of platforms in a unit's file, each with processor and system.
pub fn platforms(version: Version) -> impl Iterator<Item = (&'static str, String)> {
    PLATFORMS.iter().filter_map(move |(two, three, of)| {
        let folder = match version {
            Version::Two => *two,
            Version::Three => Some(*three),
        };
        folder.map(|folder| (folder, of.join(" ")))
    })
}

pub fn platform() -> String {
    format!("{ARCH} {OS}")
}

/// Where a library stands in a unit's file, by the names that a version of FMI has for this platform.
pub fn place(version: Version) -> Result<String, Failure> {
    let own = platform();
    let known = platforms(version).find(|(_, of)| *of == own);
    let folder = known.map(|(folder, _)| folder.to_owned());
    let folder = match version {
        Version::Three => folder.or_else(|| Some(format!("{ARCH}-{OS}"))),
        Version::Two => folder,
    };
    let Some(folder) = folder else {
        return Err(Failure::Data(format!(
            "FMI 2.0 has no name for {ARCH} with {OS}; --fmi 3 has"
        )));
    };
    Ok(format!("binaries/{folder}/{LIBRARY}{DLL_SUFFIX}"))
}

pub fn read(path: &Path) -> Result<Vec<u8>, Failure> {
    let bytes = fs::read(path).map_err(|error| Failure::file("read", path, &error))?;
    if marked(&bytes) {
        return Ok(bytes);
    }
    Err(Failure::Data(format!(
        "{} is no library of a unit: cargo build --release --package epas-fmu builds it",
        path.display()
    )))
}

fn marked(bytes: &[u8]) -> bool {
    bytes.windows(MARK.len()).any(|window| window == MARK)
}

pub fn build() -> Result<(Vec<u8>, PathBuf), Failure> {
    let sources = sources().ok_or_else(|| Failure::Data(how()))?;
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    // That of the program itself, so that what both depend on is compiled once.
    let target = std::env::var_os("CARGO_TARGET_DIR")
        .map_or_else(|| sources.join("../../target"), PathBuf::from);
    let output = Command::new(cargo)
        .args([
            "build",
            "--locked",
            "--quiet",
            "--release",
            "--package",
            "epas-fmu",
        ])
        .arg("--target-dir")
        .arg(&target)
        .current_dir(&sources)
        .stdin(Stdio::null())
        .output()
        .map_err(|error| {
            Failure::Data(format!(
                "cannot run cargo ({error}), with which fmu builds the unit's library from a clone of epas-friction: https://rustup.rs installs Rust, \
                 or --library names a library that was built before, on any machine of this platform"
            ))
        })?;
    if !output.status.success() {
        let said = String::from_utf8_lossy(&output.stderr);
        return Err(Failure::Data(format!(
            "the unit's library does not build:\n{said}"
        )));
    }
    let path = target
        .join("release")
        .join(format!("{DLL_PREFIX}epas_fmu{DLL_SUFFIX}"));
    let bytes = fs::read(&path).map_err(|error| Failure::file("read", &path, &error))?;
    Ok((bytes, sources))
}
