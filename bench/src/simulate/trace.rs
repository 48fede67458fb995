//! Traces of speed and load, and how they are read from CSV.

use std::fs::File;
use std::io::{Read, Seek};
use std::path::Path;

use csv::{ErrorKind, Position, Reader, ReaderBuilder, StringRecord, Trim};

use crate::failure::Failure;
use crate::files::{Bounded, line_of};

/// One moment of a trace: what one scene's columns hold.
pub trait Sample: Copy {
    /// Columns that a trace must have, time first.
    const COLUMNS: &'static [&'static str];

    /// From the numbers in its columns.
    fn read<E>(column: impl FnMut(&'static str) -> Result<f64, E>) -> Result<Self, E>;

    /// The numbers in the order of the columns, for a table.
    fn record(&self) -> Vec<String>;

    /// Time, s.
    fn time(&self) -> f64;

    /// Speed of what moves, rad/s of a nut and m/s of a carriage.
    fn speed(&self) -> f64;

    /// Axial load of a screw, normal load of a bearing, N.
    fn load(&self) -> f64;
}

/// A trace, never empty, its times never going back.
#[derive(Clone, Debug)]
pub struct Trace<S> {
    /// Name, for headings and file names.
    pub name: String,
    /// The samples in order.
    pub samples: Vec<S>,
}

impl<S: Sample> Trace<S> {
    /// From the first sample to the last, s.
    pub fn duration(&self) -> f64 {
        match (self.samples.first(), self.samples.last()) {
            (Some(first), Some(last)) => last.time() - first.time(),
            _ => 0.0,
        }
    }

    /// Whether the motion turns back.
    pub fn reverses(&self) -> bool {
        self.samples.iter().any(|sample| sample.speed() > 0.0)
            && self.samples.iter().any(|sample| sample.speed() < 0.0)
    }
}

/// Most samples of a trace: more than an hour at 1 kHz, and less than fills a memory.
const MOST_SAMPLES: usize = 5_000_000;

/// Largest trace file, bytes: what five million samples need; a quoted field may span lines, and is held
/// whole.
const LARGEST_FILE: u64 = 1 << 29;

/// Reads a trace.
pub fn read<S: Sample>(path: &Path) -> Result<Trace<S>, Failure> {
    let file = File::open(path).map_err(|error| Failure::file("open", path, &error))?;
    // What is no file, a pipe or a device, does not say its size and may never end.
    let samples = samples(Bounded::new(file, LARGEST_FILE))
        .map_err(|message| Failure::Data(format!("{}, {message}", path.display())))?;
    Ok(Trace {
        name: path
            .file_stem()
            .unwrap_or_default()
            .to_string_lossy()
            .into_owned(),
        samples,
    })
}

/// The samples of a trace, or what is wrong in which line.
pub fn samples<S: Sample>(input: impl Read + Seek) -> Result<Vec<S>, String> {
    parse(input).map_err(|Fault { line, message }| format!("line {line}: {message}"))
}

/// What is wrong with a trace, and in which line.
#[derive(Debug, PartialEq)]
struct Fault {
    line: u64,
    message: String,
}

impl Fault {
    fn new(line: u64, message: impl Into<String>) -> Self {
        Self {
            line,
            message: message.into(),
        }
    }

    /// A fault that the CSV reader found in the record that starts at `start`.
    fn from_csv(error: &csv::Error, reader: Reader<impl Read + Seek>, start: &Position) -> Self {
        let message = match error.kind() {
            ErrorKind::UnequalLengths {
                expected_len, len, ..
            } => format!("{len} columns where the first line has {expected_len}"),
            ErrorKind::Utf8 { .. } => "no UTF-8".into(),
            _ => error.to_string(),
        };
        Self::new(
            line_of(reader.into_inner(), start.byte(), start.line()),
            message,
        )
    }
}

fn parse<S: Sample>(input: impl Read + Seek) -> Result<Vec<S>, Fault> {
    let mut reader = ReaderBuilder::new().trim(Trim::All).from_reader(input);
    let start = reader.position().clone();
    let header = match reader.headers() {
        Ok(header) => header.clone(),
        Err(error) => return Err(Fault::from_csv(&error, reader, &start)),
    };
    let places = S::COLUMNS
        .iter()
        .map(|column| place(&header, column))
        .collect::<Result<Vec<_>, _>>()?;

    let mut samples: Vec<S> = Vec::new();
    let mut record = StringRecord::new();
    loop {
        let start = reader.position().clone();
        match reader.read_record(&mut record) {
            Ok(true) => {}
            Ok(false) => break,
            Err(error) => return Err(Fault::from_csv(&error, reader, &start)),
        }
        let sample = S::read(|column| {
            let index = S::COLUMNS.iter().position(|known| *known == column);
            let place = index.and_then(|index| places.get(index));
            number(&record, place.copied().unwrap_or(usize::MAX), column)
        });
        match sample.and_then(|sample| follows(&samples, sample)) {
            Ok(sample) => samples.push(sample),
            Err(message) => {
                let line = line_of(reader.into_inner(), start.byte(), start.line());
                return Err(Fault::new(line, message));
            }
        }
    }
    if samples.is_empty() {
        return Err(Fault::new(reader.position().line(), "the trace is empty"));
    }
    Ok(samples)
}

/// The sample, where it may follow those before it.
fn follows<S: Sample>(samples: &[S], sample: S) -> Result<S, String> {
    if samples.len() == MOST_SAMPLES {
        return Err(format!("a trace has at most {MOST_SAMPLES} samples"));
    }
    match samples.last() {
        Some(last) if sample.time() < last.time() => Err(format!(
            "time goes back from {} to {}",
            last.time(),
            sample.time()
        )),
        _ => Ok(sample),
    }
}

/// Place of a column, which must be there once.
fn place(header: &StringRecord, column: &str) -> Result<usize, Fault> {
    // A spreadsheet may put a byte-order mark before the first name.
    let mut found = header
        .iter()
        .enumerate()
        .filter(|(_, name)| name.trim_start_matches('\u{feff}') == column)
        .map(|(index, _)| index);
    match (found.next(), found.next()) {
        (Some(index), None) => Ok(index),
        (Some(_), Some(_)) => Err(Fault::new(1, format!("column {column} is there twice"))),
        (None, _) if header.is_empty() => Err(Fault::new(1, "the file is empty")),
        (None, _) => Err(Fault::new(1, format!("column {column} is missing"))),
    }
}

/// A number that f32 can hold.
fn number(record: &StringRecord, index: usize, column: &str) -> Result<f64, String> {
    let text = record.get(index).unwrap_or_default();
    let fault = |problem: &str| {
        let shown: String = text.chars().take(40).collect();
        format!("{column} = {shown:?} {problem}")
    };
    let value: f64 = text.parse().map_err(|_| fault("is no number"))?;
    if !value.is_finite() {
        return Err(fault("is not finite"));
    }
    if value.abs() > f64::from(f32::MAX) {
        return Err(fault("is beyond the range of float32"));
    }
    Ok(value)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::Cursor;

    #[derive(Clone, Copy, Debug, PartialEq)]
    struct Moment {
        time: f64,
        speed: f64,
        load: f64,
    }

    impl Sample for Moment {
        const COLUMNS: &'static [&'static str] = &["time", "nut_speed", "axial_load"];

        fn read<E>(mut column: impl FnMut(&'static str) -> Result<f64, E>) -> Result<Self, E> {
            Ok(Self {
                time: column("time")?,
                speed: column("nut_speed")?,
                load: column("axial_load")?,
            })
        }

        fn record(&self) -> Vec<String> {
            [self.time, self.speed, self.load]
                .map(|x| x.to_string())
                .to_vec()
        }

        fn time(&self) -> f64 {
            self.time
        }

        fn speed(&self) -> f64 {
            self.speed
        }

        fn load(&self) -> f64 {
            0.0
        }
    }

    fn parse(text: &[u8]) -> Result<Vec<Moment>, Fault> {
        super::parse(Cursor::new(text))
    }

    #[test]
    fn columns_stand_in_any_order_among_others() {
        let text = "\u{feff}axial_load, gear ,time,nut_speed\n1e3,3,0,-2\n\n1e3,3,0.5,2\n";
        let samples = parse(text.as_bytes()).unwrap();
        assert_eq!(
            samples,
            [(0.0, -2.0), (0.5, 2.0)].map(|(time, speed)| Moment {
                time,
                speed,
                load: 1e3,
            })
        );
    }

    #[test]
    fn every_fault_names_its_line() {
        for (text, line, word) in [
            ("", 1, "empty"),
            ("time,nut_speed\n0,1\n", 1, "axial_load"),
            ("time,nut_speed,axial_load,time\n0,1,2,3\n", 1, "twice"),
            ("time,nut_speed,axial_load\n", 2, "empty"),
            ("time,nut_speed,axial_load\n0,1,2\n1,fast,2\n", 3, "fast"),
            (
                "time,nut_speed,axial_load\n0,1,2\n\n\n1,fast,2\n",
                5,
                "fast",
            ),
            (
                "time,nut_speed,axial_load\r\n0,1,2\r\n1,fast,2\r\n",
                3,
                "fast",
            ),
            ("time,nut_speed,axial_load\n0,1,NaN\n", 2, "finite"),
            ("time,nut_speed,axial_load\n0,1,-inf\n", 2, "finite"),
            ("time,nut_speed,axial_load\n0,1,1e39\n", 2, "float32"),
            ("time,nut_speed,axial_load\n0,1,2\n1,1\n", 3, "columns"),
            ("time,nut_speed,axial_load\n0,1,\n", 2, "no number"),
            (
                "time,nut_speed,axial_load\n0,1,2\n1,1,2\n0.5,1,2\n",
                4,
                "back",
            ),
        ] {
            let fault = parse(text.as_bytes()).unwrap_err();
            assert!(
                fault.line == line && fault.message.contains(word),
                "{text:?}: {fault:?}"
            );
        }
        let fault = parse(b"time,nut_speed,axial_load\n0,1,2\n0,\xff,2\n").unwrap_err();
        assert_eq!(fault.line, 3);
    }
}
