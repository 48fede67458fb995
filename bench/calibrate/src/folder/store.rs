//! What is kept of every trace of a folder, so that a run that was stopped goes on where it was.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::answered::Answered;
use epas_page::failure::Failure;
use epas_page::files::{self, Existing};

/// Form of the files; another one is fitted again.
const VERSION: u32 = 5;

/// A trace's file at the time of its fit, and how it was fitted.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Key {
    version: u32,
    /// CRC-32 of all bytes.
    checksum: u32,
    /// CRC-32 of everything that the fit follows from beside the trace.
    settings: u32,
}

impl Key {
    pub fn of(trace: &Path, settings: &str) -> Result<Self, Failure> {
        let bytes = fs::read(trace).map_err(|error| Failure::file("read", trace, &error))?;
        Ok(Self {
            version: VERSION,
            checksum: crc32fast::hash(&bytes),
            settings: crc32fast::hash(settings.as_bytes()),
        })
    }
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Told {
    /// The object that `calibrate --json` prints of it.
    pub answer: Value,
    pub answered: Answered,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Stored {
    pub trace: String,
    pub key: Key,
    pub ended: Result<Told, String>,
}

impl Told {
    /// Its estimated parameters: name, and object with value, interval and unit.
    pub fn estimates(&self) -> impl Iterator<Item = (&str, &Value)> {
        let parameters = self.answer["parameters"].as_object();
        let all = parameters.into_iter().flatten();
        all.filter(|(_, entry)| entry["fixed"] != true)
            .map(|(name, entry)| (name.as_str(), entry))
    }
}

pub fn place(output: &Path, trace: &str) -> PathBuf {
    output.join("traces").join(format!("{trace}.json"))
}

/// What is kept of a trace with this key. What cannot be read counts as nothing, and is fitted again.
pub fn kept(output: &Path, trace: &str, key: &Key) -> Option<Stored> {
    let stored = read(&place(output, trace)).ok()?;
    (stored.trace == trace && stored.key == *key).then_some(stored)
}

pub fn read(path: &Path) -> Result<Stored, Failure> {
    let text = fs::read_to_string(path).map_err(|error| Failure::file("read", path, &error))?;
    serde_json::from_str(&text).map_err(|error| Failure::file("read", path, &error))
}

/// Writes one answer, whole or not at all.
pub fn write(output: &Path, stored: &Stored) -> Result<(), Failure> {
    let path = place(output, &stored.trace);
    // Within the folder that a run fills.
    if let Some(folder) = path.parent() {
        fs::create_dir_all(folder).map_err(|error| Failure::file("write", &path, &error))?;
    }
    let text =
        serde_json::to_string(stored).map_err(|error| Failure::file("write", &path, &error))?;
    files::write(&path, &text, Existing::Replace)
}

pub fn all(output: &Path) -> Result<Vec<Stored>, Failure> {
    let folder = output.join("traces");
    let paths = list(&folder, &["json"])?;
    paths.iter().map(|path| read(path)).collect()
}

/// Files with one of these endings in a folder, in the order of their names; hidden ones are none.
pub fn list(folder: &Path, endings: &[&str]) -> Result<Vec<PathBuf>, Failure> {
    let failure = |error: io::Error| Failure::file("read", folder, &error);
    let mut paths = Vec::new();
    for entry in fs::read_dir(folder).map_err(failure)? {
        let path = entry.map_err(failure)?.path();
        let hidden = name(&path).starts_with('.');
        let fits = path.extension().is_some_and(|own| {
            endings
                .iter()
                .any(|ending| own.eq_ignore_ascii_case(ending))
        });
        if fits && !hidden && path.is_file() {
            paths.push(path);
        }
    }
    paths.sort();
    Ok(paths)
}

pub fn name(path: &Path) -> String {
    path.file_name()
        .unwrap_or_default()
        .to_string_lossy()
        .into_owned()
}
