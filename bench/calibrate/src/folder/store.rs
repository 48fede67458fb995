//! What is kept of every trace of a folder, so that a run that was stopped goes on where it was.

use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};
use std::time::UNIX_EPOCH;

use serde::{Deserialize, Serialize};

use crate::answer::{Calibration, Estimate};
use crate::sums::Sums;
use epas_page::failure::Failure;
use epas_page::files::{self, Existing};

/// Form of the files; another one is fitted again.
const VERSION: u32 = 3;

/// A trace's file at the time of its fit, and how it was fitted.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Key {
    version: u32,
    /// Bytes.
    size: u64,
    /// Time of its last change, ns since 1970; none where the system does not say.
    changed: Option<u64>,
    /// CRC-32 of all bytes.
    checksum: u32,
    /// CRC-32 of everything that the fit follows from beside the trace.
    settings: u32,
}

/// A parameter that a trace tells, or that was set.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Parameter {
    /// Name.
    pub name: String,
    /// Unit.
    pub unit: String,
    /// Value; none where it is not finite, as of the ends.
    pub value: Option<f64>,
    /// Low end of the 95 % interval.
    pub low: Option<f64>,
    /// High end.
    pub high: Option<f64>,
    /// Whether it was set.
    pub fixed: bool,
}

/// What one trace told.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Told {
    /// Parameters.
    pub parameters: Vec<Parameter>,
    /// Residual, rms, N m or N.
    pub residual_rms: f64,
    /// Residual over effort, rms.
    pub relative_error: f64,
    /// What it cannot tell.
    pub cannot_tell: Vec<String>,
    /// What it adds to the population.
    pub sums: Sums,
}

/// How a trace's calibration ended.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Ended {
    /// It told something.
    Told(Box<Told>),
    /// It was refused: why.
    Refused(String),
}

/// What is kept of one trace.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Stored {
    /// Name of the trace's file.
    pub trace: String,
    /// Its file and the settings.
    pub key: Key,
    /// How it ended.
    pub ended: Ended,
}

impl Told {
    /// What is kept of a calibration.
    pub fn of(calibration: &Calibration, sums: Sums) -> Self {
        let finite = |value: f64| value.is_finite().then_some(value);
        let parameter = |estimate: &Estimate| Parameter {
            name: estimate.name.clone(),
            unit: estimate.unit.into(),
            value: finite(estimate.value),
            low: finite(estimate.low),
            high: finite(estimate.high),
            fixed: estimate.fixed,
        };
        Self {
            parameters: calibration.parameters.iter().map(parameter).collect(),
            residual_rms: calibration.residual_rms,
            relative_error: calibration.relative_error,
            cannot_tell: calibration.cannot_tell.clone(),
            sums,
        }
    }
}

impl Key {
    /// Of a trace's file as it is now.
    ///
    /// # Errors
    /// A file that cannot be read.
    pub fn of(trace: &Path, settings: u32) -> Result<Self, Failure> {
        let failure = |error: io::Error| Failure::file("read", trace, &error);
        let (size, changed) = stamp(trace).map_err(failure)?;
        let mut hasher = Hasher(crc32fast::Hasher::new());
        let mut file = File::open(trace).map_err(failure)?;
        io::copy(&mut file, &mut hasher).map_err(failure)?;
        Ok(Self {
            version: VERSION,
            size,
            changed,
            checksum: hasher.0.finalize(),
            settings,
        })
    }

    /// Whether two traces have the same bytes and were fitted in the same way.
    pub fn same_data(&self, other: &Self) -> bool {
        (self.size, self.checksum, self.settings) == (other.size, other.checksum, other.settings)
    }
}

fn stamp(trace: &Path) -> io::Result<(u64, Option<u64>)> {
    let data = fs::metadata(trace)?;
    let since = data
        .modified()
        .ok()
        .and_then(|time| time.duration_since(UNIX_EPOCH).ok());
    let changed = since.and_then(|time| u64::try_from(time.as_nanos()).ok());
    Ok((data.len(), changed))
}

/// A checksum that bytes are written to.
struct Hasher(crc32fast::Hasher);

impl io::Write for Hasher {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.update(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

/// The place of a trace's answer.
pub fn place(output: &Path, trace: &str) -> PathBuf {
    output.join("traces").join(format!("{trace}.json"))
}

/// What is kept of a trace, where it is of the file as it is now and of the same settings. What cannot be read counts as
/// nothing, and is fitted again.
pub fn kept(output: &Path, trace: &Path, name: &str, settings: u32) -> Option<Stored> {
    let stored = read(&place(output, name)).ok()?;
    let key = &stored.key;
    if stored.trace != name || (key.version, key.settings) != (VERSION, settings) {
        return None;
    }
    let (size, changed) = stamp(trace).ok()?;
    if size != key.size {
        return None;
    }
    // A copy of the same bytes has another time.
    let unchanged = changed.is_some() && changed == key.changed
        || Key::of(trace, settings).is_ok_and(|now| now.checksum == key.checksum);
    unchanged.then_some(stored)
}

/// Reads one answer.
///
/// # Errors
/// What is wrong with the file.
pub fn read(path: &Path) -> Result<Stored, Failure> {
    let text = fs::read_to_string(path).map_err(|error| Failure::file("read", path, &error))?;
    serde_json::from_str(&text).map_err(|error| Failure::file("read", path, &error))
}

/// Writes one answer, whole or not at all.
///
/// # Errors
/// A file that cannot be written.
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

/// All answers of a folder in which a run has written, in the order of their names.
///
/// # Errors
/// A folder or a file that cannot be read.
pub fn all(output: &Path) -> Result<Vec<Stored>, Failure> {
    let folder = output.join("traces");
    list(&folder, &["json"])?
        .iter()
        .map(|path| read(path))
        .collect()
}

/// Files with one of these endings in a folder, in the order of their names; hidden ones are none.
///
/// # Errors
/// A folder that cannot be read.
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

/// Name of a file.
pub fn name(path: &Path) -> String {
    path.file_name()
        .unwrap_or_default()
        .to_string_lossy()
        .into_owned()
}
