//! The table of a CSV file or a measurement file: which column holds what, and its numbers in SI units.

mod gaps;

use std::io::{Read, Seek};

use csv::{ByteRecord, ErrorKind, Reader, ReaderBuilder, Trim};

use epas_page::files::line_of;
use epas_traces::front;
use epas_traces::headings;
use epas_traces::mdf4;
use epas_traces::units::{Quantity, Unit, cut, heading};

/// Most samples: more than three hours at 1 kHz, and less than fills a memory.
pub const MOST_SAMPLES: usize = 12_000_000;
/// Most columns of the file; its own names stand in a message each.
const MOST_COLUMNS: usize = 1000;

/// One column that is known.
#[derive(Clone, Debug, PartialEq)]
pub struct Column {
    /// Name in the file.
    pub name: String,
    /// What it holds.
    pub quantity: Quantity,
    /// Unit in the file.
    pub unit: Unit,
    /// Values, in SI units.
    pub values: Vec<f64>,
    /// Samples that were left out and filled.
    pub left_out: Vec<usize>,
    /// Where it stands in a line.
    place: usize,
}

impl Column {
    /// A column in SI units.
    pub fn si(name: &str, quantity: Quantity, values: Vec<f64>) -> Self {
        Self {
            name: name.into(),
            quantity,
            unit: Unit::SI,
            values,
            left_out: Vec::new(),
            place: 0,
        }
    }
}

/// A table whose times rise.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    /// Time of every sample, s.
    pub times: Vec<f64>,
    /// All columns but the time.
    pub columns: Vec<Column>,
    /// Names of columns that are not known.
    pub ignored: Vec<String>,
    /// Rows that had the time of the one before, and were dropped: each with the sample that it stood behind.
    pub repeated: Vec<usize>,
    /// What was done to the samples.
    pub notes: Vec<String>,
    /// Samples of the file that are left, where some are not.
    left: Vec<usize>,
}

impl Table {
    /// A table of columns whose empty cells are no numbers; filled.
    ///
    /// # Errors
    /// A column with too few samples, or with gaps.
    pub fn of(times: Vec<f64>, columns: Vec<Column>) -> Result<Self, String> {
        gaps::filled(Self {
            times,
            columns,
            ignored: Vec::new(),
            repeated: Vec::new(),
            notes: Vec::new(),
            left: Vec::new(),
        })
    }

    /// The values of a column of this name.
    pub fn values(&self, name: &str) -> Option<&[f64]> {
        let column = self.columns.iter().find(|column| column.name == name);
        column.map(|column| column.values.as_slice())
    }

    /// Row of a sample in the file; the first one under the heading is 1.
    pub fn row(&self, sample: usize) -> usize {
        let sample = self.left.get(sample).copied().unwrap_or(sample);
        sample + 1 + self.repeated.partition_point(|before| *before < sample)
    }
}

/// Reads a table.
///
/// # Errors
/// What is wrong, with the line.
pub fn read(input: impl Read + Seek) -> Result<Table, String> {
    let input = front::Table::new(input);
    let (separator, above) = (input.separator, input.lines);
    let mut reader = ReaderBuilder::new()
        .trim(Trim::All)
        .delimiter(separator)
        .from_reader(input);
    let mut table = match header(&mut reader) {
        Ok(header) => header,
        Err(message) => return Err(format!("line {}: {message}", above + 1)),
    };
    table.separator = separator;
    let mut record = ByteRecord::new();
    loop {
        let (byte, line) = (reader.position().byte(), reader.position().line());
        let fault = match reader.read_byte_record(&mut record) {
            Ok(true) => table.add(&record).err(),
            Ok(false) => break,
            Err(error) => Some(message(&error)),
        };
        if let Some(message) = fault {
            let line = above + line_of(reader.into_inner(), byte, line);
            return Err(format!("line {line}: {message}"));
        }
    }
    let time = table.columns.remove(0);
    let (ignored, repeated) = (table.ignored, table.repeated);
    let table = Table::of(time.values, table.columns)?;
    Ok(Table {
        ignored,
        repeated,
        ..table
    })
}

/// The table of a measurement file, with the checks of [`read`].
///
/// # Errors
/// Too many samples.
pub fn of_measurement(found: mdf4::Table) -> Result<Table, String> {
    if found.times.len() > MOST_SAMPLES {
        return Err(format!(
            "a trace has at most {MOST_SAMPLES} samples; cut it"
        ));
    }
    // A sample at the time of the one before is dropped, as of a CSV file.
    let first = |sample: &usize| {
        let before = sample
            .checked_sub(1)
            .and_then(|before| found.times.get(before));
        before != found.times.get(*sample)
    };
    let kept: Vec<usize> = (0..found.times.len()).filter(first).collect();
    let at = |values: &[f64]| -> Vec<f64> {
        kept.iter()
            .filter_map(|sample| values.get(*sample).copied())
            .collect()
    };
    let columns = found.columns.iter().map(|column| Column {
        name: column.name.clone(),
        quantity: column.quantity,
        unit: column.unit,
        values: at(&column.values),
        left_out: Vec::new(),
        place: 0,
    });
    let dropped = (0..found.times.len()).filter(|sample| !first(sample));
    Ok(Table {
        times: at(&found.times),
        columns: columns.collect(),
        // So many were kept before it.
        repeated: dropped
            .enumerate()
            .map(|(before, row)| (row - before).saturating_sub(1))
            .collect(),
        ignored: found.ignored,
        notes: Vec::new(),
        left: Vec::new(),
    })
}

/// What the CSV reader found.
fn message(error: &csv::Error) -> String {
    match error.kind() {
        ErrorKind::UnequalLengths {
            expected_len, len, ..
        } => {
            let many = if *len == 1 { "" } else { "s" };
            format!("{len} column{many} where the first line has {expected_len}")
        }
        ErrorKind::Utf8 { .. } => "no UTF-8".into(),
        _ => error.to_string(),
    }
}

/// A table that grows; its first column is the time.
struct Growing {
    columns: Vec<Column>,
    ignored: Vec<String>,
    repeated: Vec<usize>,
    separator: u8,
}

fn header(reader: &mut Reader<impl Read>) -> Result<Growing, String> {
    let header = reader.headers().map_err(|error| message(&error))?;
    if header.is_empty() {
        return Err("the file is empty".into());
    }
    if header.len() > MOST_COLUMNS {
        return Err(format!("{} columns: at most {MOST_COLUMNS}", header.len()));
    }
    headings::separated(header)?;
    let mut table = Growing {
        columns: Vec::new(),
        ignored: Vec::new(),
        repeated: Vec::new(),
        separator: b',',
    };
    for (place, name) in header.iter().enumerate() {
        // A spreadsheet may put a byte-order mark before the first name.
        let name = name.trim_start_matches('\u{feff}');
        let Some((quantity, unit)) = heading(name)? else {
            table.ignored.push(cut(name));
            continue;
        };
        if let Some(other) = table
            .columns
            .iter()
            .find(|other| other.quantity == quantity)
        {
            return Err(format!(
                "columns {} and {name} are the same quantity",
                other.name
            ));
        }
        table.columns.push(Column {
            name: name.into(),
            quantity,
            unit,
            values: Vec::new(),
            left_out: Vec::new(),
            place,
        });
    }
    let time = table
        .columns
        .iter()
        .position(|column| column.quantity == Quantity::Time)
        .ok_or_else(|| headings::missing("time", header))?;
    table.columns.swap(0, time);
    Ok(table)
}

impl Growing {
    /// Takes units from a row below the headings; whether there are any.
    fn takes_units(&mut self, record: &ByteRecord) -> Result<bool, String> {
        let columns: Vec<_> = self
            .columns
            .iter()
            .map(|column| {
                (
                    column.place,
                    column.name.as_str(),
                    column.quantity,
                    column.unit,
                )
            })
            .collect();
        let Some(units) = front::units(record, &columns) else {
            return Ok(false);
        };
        for (column, unit) in self.columns.iter_mut().zip(units?) {
            column.unit = unit;
        }
        Ok(true)
    }

    /// Adds a line.
    fn add(&mut self, record: &ByteRecord) -> Result<(), String> {
        let first = self.columns.iter().all(|column| column.values.is_empty());
        if first && self.takes_units(record)? {
            return Ok(());
        }
        for place in 0..self.columns.len() {
            let Some(column) = self.columns.get_mut(place) else {
                continue;
            };
            let cell = record.get(column.place).unwrap_or_default();
            let value = match number(cell, &column.name, self.separator)? {
                Some(value) => column.unit.si(value),
                None if place == 0 => return Err(format!("{} has no number", column.name)),
                None => f64::NAN,
            };
            if place == 0 {
                match column.values.last() {
                    Some(last) if value < *last => {
                        return Err(format!("time goes back from {last} s to {value} s"));
                    }
                    Some(last) if value == *last => {
                        self.repeated.push(column.values.len() - 1);
                        return Ok(());
                    }
                    _ => {}
                }
                if column.values.len() == MOST_SAMPLES {
                    return Err(format!(
                        "a trace has at most {MOST_SAMPLES} samples; cut it, or take every few samples of a faster one"
                    ));
                }
            }
            column.values.push(value);
        }
        Ok(())
    }
}

/// A number that f32 can hold; none where the sample is missing.
fn number(text: &[u8], column: &str, separator: u8) -> Result<Option<f64>, String> {
    let fault = |problem: &str| {
        let shown: String = String::from_utf8_lossy(text).chars().take(40).collect();
        format!("{column} = {shown:?} {problem}")
    };
    let Some(number) = front::number(text, separator) else {
        return Ok(None);
    };
    let value = number.map_err(|()| fault(headings::no_number(text)))?;
    if !value.is_finite() {
        return Err(fault("is not finite"));
    }
    if value.abs() > f64::from(f32::MAX) {
        return Err(fault("is beyond the range of float32"));
    }
    Ok(Some(value))
}
