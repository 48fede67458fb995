//! What is stored beside the firmware: the host's results, and the figures to compare with.

use std::fs;
use std::path::{Path, PathBuf};

use epas_firmware::cases::{Sink, write};
use epas_firmware::control_loop::ControlLoop;
use epas_firmware::scenes::DESIGN;

use super::tools::firmware;
use epas_bench::counts::{self, Figures};
use epas_design::manoeuvre::Manoeuvre;
use epas_page::failure::Failure;
use epas_page::files::{self, Existing};

/// Growth of a function's instructions that is let pass.
const GROWTH: f64 = 1.05;

#[derive(Default)]
struct Bytes(Vec<u8>);

impl Sink for Bytes {
    fn bytes(&mut self, bytes: &[u8]) {
        self.0.extend_from_slice(bytes);
    }
}

fn cases() -> Result<Vec<u8>, Failure> {
    let mut bytes = Bytes::default();
    write(&mut bytes)
        .map_err(|error| Failure::Data(format!("the firmware's designs are refused: {error}")))?;
    Ok(bytes.0)
}

/// Ticks of the recorded manoeuvre, one for each millisecond.
const TICKS: usize = 600;

/// The manoeuvre that the firmware's control loop runs through, with what the host finds: a wheel strikes
/// a kerb.
fn manoeuvre() -> Result<Vec<u8>, Failure> {
    let refused = |error| Failure::Data(format!("the firmware's designs are refused: {error}"));
    let moments = Manoeuvre::Kerb
        .of_nut(&DESIGN)
        .ok_or_else(|| Failure::Data("the firmware's design has no lead".into()))?;
    let record = |digest: u32| -> Vec<u8> {
        let samples = moments.iter().step_by(10).take(TICKS);
        [TICKS as u32, digest]
            .into_iter()
            .chain(samples.flat_map(|sample| {
                [sample.speed, sample.force].map(|value| (value as f32).to_bits())
            }))
            .flat_map(u32::to_le_bytes)
            .collect()
    };
    // The loop takes a reference that is valid for ever, as to flash.
    let recorded = record(0).leak();
    let mut control = ControlLoop::new(recorded).map_err(refused)?;
    while control.tick() {}
    Ok(record(control.digest()))
}

/// The files and what the host finds for them.
fn results() -> Result<[(&'static str, Vec<u8>); 2], Failure> {
    Ok([("cases.bin", cases()?), ("manoeuvre.bin", manoeuvre()?)])
}

/// Stores the host's results.
pub fn write_cases() -> Result<(), Failure> {
    for (name, bytes) in results()? {
        let path = firmware().join(name);
        fs::write(&path, bytes).map_err(|error| Failure::file("write", &path, &error))?;
    }
    Ok(())
}

/// Fails where the stored results are no longer the host's.
pub fn check_cases() -> Result<(), Failure> {
    for (name, bytes) in results()? {
        let path = firmware().join(name);
        let stored = fs::read(&path).map_err(|error| Failure::file("read", &path, &error))?;
        if stored != bytes {
            return Err(Failure::Data(format!(
                "the host's results are no longer those stored in {}; where that is meant:\n  \
                 cargo run --release -p epas-target -- --store-cases",
                path.display()
            )));
        }
    }
    Ok(())
}

fn figures_path() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../target.json")
}

pub fn write_figures(figures: &Figures) -> Result<(), Failure> {
    let json = serde_json::to_string_pretty(figures)
        .map_err(|error| Failure::Data(format!("cannot write JSON: {error}")))?;
    files::write(&figures_path(), &(json + "\n"), Existing::Replace)
}

pub fn gate(now: &Figures) -> Result<(), Failure> {
    let grown = grown(&counts::stored()?, now);
    if grown.is_empty() {
        return Ok(());
    }
    Err(Failure::Data(format!(
        "more than 5 % more instructions than stored in bench/target.json:\n{}\nwhere that is meant:\n  \
         cargo run --release -p epas-target -- --store",
        grown.join("\n")
    )))
}

/// What has grown, or is missing where it was counted before.
fn grown(stored: &Figures, now: &Figures) -> Vec<String> {
    stored
        .functions
        .iter()
        .filter_map(|stored| match now.function(&stored.name) {
            None => Some(format!("  {} is no longer counted", stored.name)),
            Some(now) => {
                let (before, after) = (stored.instructions_max, now.instructions_max);
                (f64::from(after) > GROWTH * f64::from(before))
                    .then(|| format!("  {}: {before} -> {after}", stored.name))
            }
        })
        .collect()
}
