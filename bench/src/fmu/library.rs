//! Builds the shared library of a unit from the source tree.

use std::env::consts::{ARCH, DLL_PREFIX, DLL_SUFFIX, OS};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use super::description::{LIBRARY, Version};
use crate::failure::Failure;

/// What a library of so many balls carries, so that one of another build is noticed.
pub fn mark(balls: u8) -> String {
    format!("epas-friction row of {balls:02} balls")
}

/// Folder of its sources.
fn sources() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("fmu")
}

/// Where a library stands in a unit's file, by the names that a version of FMI has for this platform.
///
/// # Errors
/// Where FMI has no name for it.
pub fn place(version: Version) -> Result<String, Failure> {
    let three = match (ARCH, OS) {
        ("x86_64", "macos") => "x86_64-darwin".to_owned(),
        ("aarch64", "macos") => "aarch64-darwin".to_owned(),
        (arch, os) => format!("{arch}-{os}"),
    };
    let two = match (ARCH, OS) {
        ("x86_64", "linux") => "linux64",
        ("x86_64", "windows") => "win64",
        ("x86_64", "macos") => "darwin64",
        _ => "",
    };
    let folder = match version {
        Version::Two => two,
        Version::Three => &three,
    };
    if folder.is_empty() {
        return Err(Failure::Data(format!(
            "FMI 2.0 has no name for {ARCH} with {OS}; --fmi 3 has"
        )));
    }
    Ok(format!("binaries/{folder}/{LIBRARY}{DLL_SUFFIX}"))
}

/// Builds the library for a row of so many balls; its bytes.
///
/// # Errors
/// Where cargo or its build fails.
pub fn build(balls: u8) -> Result<Vec<u8>, Failure> {
    let sources = sources();
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
        .env("EPAS_FMU_BALLS", balls.to_string())
        .stdin(Stdio::null())
        .output()
        .map_err(|error| Failure::Data(format!("cannot run cargo: {error}")))?;
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
    let mark = mark(balls);
    if bytes
        .windows(mark.len())
        .any(|window| window == mark.as_bytes())
    {
        Ok(bytes)
    } else {
        Err(Failure::Data(
            "another unit was built at the same time; once more, please".into(),
        ))
    }
}
