//! The table of a CSV file or a measurement file: which column holds what, and its numbers in SI units. `calibrate` and `simulate` read it.

use std::io::{Read, Seek};

use csv::{ByteRecord, ErrorKind, Reader, ReaderBuilder, Trim};

use crate::front;
use crate::headings;
use crate::units::{Dimension, Quantity, Unit, cut, heading};
use epas_page::files::line_of;

use crate::gaps;
use crate::marks::LeftOut;

/// Largest trace file, bytes: what twelve million samples of many columns need; a quoted field may span lines, and is
/// held whole.
pub const LARGEST_FILE: u64 = 1 << 31;

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
    /// Samples that are not believed, in order.
    pub left_out: Vec<usize>,
    place: usize,
}

/// A table whose times rise.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    /// Time of every sample, s.
    pub times: Vec<f64>,
    /// Whether the file names the unit of the time.
    pub time_unit_said: bool,
    /// All columns but the time.
    pub columns: Vec<Column>,
    /// Names of columns that are not known.
    pub ignored: Vec<String>,
    /// How many rows had the time of the one before, and were dropped.
    pub repeated: usize,
    /// What was done to the samples.
    pub notes: Vec<String>,
    /// Samples that are not to be believed.
    pub left_out: Vec<LeftOut>,
    rows: Vec<u32>,
}

/// What a command takes from a table.
#[derive(Clone, Copy)]
pub struct Request<'a> {
    /// Whether it has a use for a quantity; other columns are left aside.
    pub wants: &'a dyn Fn(Quantity) -> bool,
    /// The motor's rated torque, N m: 100 % of a torque in percent.
    pub rated_torque: Option<f64>,
}

impl Column {
    pub(crate) fn of(
        (name, place): (String, usize),
        (quantity, unit): (Quantity, Unit),
        values: Vec<f64>,
    ) -> Self {
        Self {
            name,
            quantity,
            unit,
            values,
            left_out: Vec::new(),
            place,
        }
    }
}

impl Table {
    /// Of columns at times that never go back; a sample at the time of the one before is dropped.
    pub(crate) fn of(times: &[f64], mut columns: Vec<Column>, notes: Vec<String>) -> Self {
        let mut kept: Vec<usize> = (0..times.len()).collect();
        kept.dedup_by(|next, sample| times[*next] == times[*sample]);
        let at = |values: &[f64]| kept.iter().map(|sample| values[*sample]).collect();
        for column in &mut columns {
            column.values = at(&column.values);
        }
        Self {
            times: at(times),
            time_unit_said: true,
            columns,
            repeated: times.len() - kept.len(),
            rows: kept.iter().map(|sample| *sample as u32 + 1).collect(),
            ignored: Vec::new(),
            notes,
            left_out: Vec::new(),
        }
    }

    /// The column of a quantity.
    pub fn column(&self, quantity: Quantity) -> Option<&Column> {
        self.columns
            .iter()
            .find(|column| column.quantity == quantity)
    }

    /// Takes the column of a quantity out of the table.
    pub fn take(&mut self, quantity: Quantity) -> Option<Column> {
        let place = self
            .columns
            .iter()
            .position(|column| column.quantity == quantity)?;
        Some(self.columns.remove(place))
    }

    /// Keeps some of the samples.
    pub fn keep(&mut self, kept: &[bool]) {
        let kept_of = |values: &[f64]| {
            let all = values.iter().zip(kept).filter(|(_, kept)| **kept);
            all.map(|(value, _)| *value).collect()
        };
        self.times = kept_of(&self.times);
        for column in &mut self.columns {
            column.values = kept_of(&column.values);
        }
        let mut kept = kept.iter();
        self.rows.retain(|_| kept.next() == Some(&true));
    }

    /// Row of a sample in the file; the first one under the heading is 1.
    pub fn row(&self, sample: usize) -> usize {
        self.rows.get(sample).map_or(0, |row| *row as usize)
    }
}

/// Reads a table from a CSV file.
pub fn read(input: impl Read + Seek, request: Request<'_>) -> Result<Table, String> {
    let input = front::Table::new(input);
    let (separator, above) = (input.separator, input.lines);
    let mut reader = ReaderBuilder::new()
        .trim(Trim::All)
        .delimiter(separator)
        .from_reader(input);
    let mut table = header(&mut reader, request, separator)
        .map_err(|message| format!("line {}: {message}", above + 1))?;
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
    Table {
        times: time.values,
        time_unit_said: time.unit.dimension != Dimension::Unsaid,
        columns: table.columns,
        ignored: table.ignored,
        repeated: table.row as usize - table.rows.len(),
        rows: table.rows,
        notes: Vec::new(),
        left_out: Vec::new(),
    }
    .whole(request.rated_torque)
}

impl Table {
    /// The table with every cell filled, shares of a rated torque in N m.
    pub(crate) fn whole(mut self, rated_torque: Option<f64>) -> Result<Self, String> {
        if self.times.len() > MOST_SAMPLES {
            return Err(format!(
                "a trace has at most {MOST_SAMPLES} samples; cut it"
            ));
        }
        for column in &mut self.columns {
            if column.unit.dimension != Dimension::Rated {
                continue;
            }
            let Some(torque) = rated_torque else {
                return Err(format!(
                    "column {}: it is in {} of the motor's rated torque, which the file does not say: calibrate --rated-torque takes it in N m, from the motor's data sheet; or give the column in N m",
                    cut(&column.name),
                    column.unit.shown()
                ));
            };
            for value in &mut column.values {
                *value *= torque;
            }
            column.unit.factor *= torque;
        }
        gaps::fill(&mut self)?;
        Ok(self)
    }
}

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
    /// The row that is added, and those that were kept.
    row: u32,
    rows: Vec<u32>,
    separator: u8,
    /// Whether the heading of the time is an empty cell, so that a unit must stand below it.
    unnamed_time: bool,
}

fn header(
    reader: &mut Reader<impl Read>,
    request: Request<'_>,
    separator: u8,
) -> Result<Growing, String> {
    let header = reader.headers().map_err(|error| message(&error))?;
    if header.is_empty() {
        return Err("the file is empty".into());
    }
    if header.len() > MOST_COLUMNS {
        return Err(format!("{} columns: at most {MOST_COLUMNS}", header.len()));
    }
    headings::separated(header)?;
    // A spreadsheet may put a byte-order mark before the first name.
    let names = || {
        header
            .iter()
            .map(|name| name.trim_start_matches('\u{feff}'))
    };
    let is_time = |name| matches!(heading(name), Ok(Some((Quantity::Time, _))));
    let mut table = Growing {
        columns: Vec::new(),
        ignored: Vec::new(),
        row: 0,
        rows: Vec::new(),
        separator,
        unnamed_time: names().next() == Some("") && !names().any(is_time),
    };
    for (place, name) in names().enumerate() {
        let known = match place {
            0 if table.unnamed_time => Some((Quantity::Time, Unit::SI)),
            _ => heading(name)?,
        };
        let known = known.filter(|(known, _)| *known == Quantity::Time || (request.wants)(*known));
        let Some((quantity, unit)) = known else {
            table.ignored.push(cut(name));
            continue;
        };
        let mut others = table.columns.iter();
        if let Some(other) = others.find(|other| other.quantity == quantity) {
            return Err(format!(
                "columns {} and {} are the same quantity; leave one of them out",
                cut(&other.name),
                cut(name)
            ));
        }
        let column = Column::of((name.into(), place), (quantity, unit), Vec::new());
        table.columns.push(column);
    }
    let mut columns = table.columns.iter();
    let time = columns
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

    fn add(&mut self, record: &ByteRecord) -> Result<(), String> {
        if self.columns.iter().all(|column| column.values.is_empty()) {
            if self.takes_units(record)? {
                return Ok(());
            }
            if self.unnamed_time && self.columns[0].unit == Unit::SI {
                return Err(
                    "the first column has no name, and no unit of a time below it: name it time"
                        .into(),
                );
            }
        }
        self.row += 1;
        for (place, column) in self.columns.iter_mut().enumerate() {
            let cell = record.get(column.place).unwrap_or_default();
            let value = match number(cell, &column.name, self.separator)? {
                Some(value) => column.unit.si(value),
                None if place == 0 => return Err(format!("{} has no number", column.name)),
                None => f64::NAN,
            };
            match column.values.last() {
                Some(last) if place == 0 && value < *last => {
                    return Err(format!("time goes back from {last} s to {value} s"));
                }
                Some(last) if place == 0 && value == *last => return Ok(()),
                _ => column.values.push(value),
            }
        }
        self.rows.push(self.row);
        if self.rows.len() > MOST_SAMPLES {
            return Err(format!(
                "a trace has at most {MOST_SAMPLES} samples; cut it, or take every few samples of a faster one"
            ));
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
