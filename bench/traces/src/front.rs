//! What stands above the numbers of a table, as measuring tools write it: lines of text above the headings, a row of units
//! below them, columns that are separated by semicolons or tabs, letters of UTF-16.

use std::io::{self, Read, Seek, SeekFrom};

use csv::ByteRecord;

use crate::units::{Quantity, Unit, cut, heading, written};

const LONGEST: usize = 1 << 16;
const MOST_LINES: usize = 200;
const SEPARATORS: [u8; 3] = [b',', b';', b'\t'];

/// A table whose reading starts at its headings.
pub struct Table<R> {
    start: Vec<u8>,
    at: usize,
    skip: u64,
    rest: R,
    /// Whether `start` holds the whole text, which was UTF-16.
    decoded: bool,
    pub separator: u8,
    pub lines: u64,
}

impl<R: Read> Table<R> {
    /// Finds the headings: the first line with a time and another quantity that is known. The time's own heading may be an empty cell, with
    /// its unit in the row below. Without such a line the first one is taken, for its faults to be said.
    pub fn new(mut rest: R) -> Self {
        let mut start = Vec::new();
        // What cannot be read is said by whoever reads on.
        let _ = rest.by_ref().take(LONGEST as u64).read_to_end(&mut start);
        let decoded = utf_16(&start).is_some();
        if let Some(letter) = utf_16(&start) {
            let _ = rest.read_to_end(&mut start);
            let letters = start.chunks_exact(2).skip(1);
            let letters = letters.map(|pair| letter([pair[0], pair[1]]));
            let text = char::decode_utf16(letters);
            let text: String = text.map(|c| c.unwrap_or('\u{fffd}')).collect();
            start = text.into_bytes();
        }
        let mut found = (0, 0, b',');
        let mut place = 0;
        let head = start.get(..LONGEST).unwrap_or(&start);
        let mut lines = head.split_inclusive(|byte| *byte == b'\n').enumerate();
        let mut lines = lines.by_ref().take(MOST_LINES).peekable();
        while let Some((number, line)) = lines.next() {
            let below = lines.peek().map_or(&[][..], |(_, line)| line);
            let separator = SEPARATORS
                .into_iter()
                .find(|separator| is_heading(line, below, *separator));
            if let Some(separator) = separator {
                found = (place, number as u64, separator);
                break;
            }
            place += line.len();
        }
        let (skip, lines, separator) = found;
        Self {
            start,
            at: skip,
            skip: skip as u64,
            rest,
            decoded,
            separator,
            lines,
        }
    }
}

/// How two bytes are a letter of a text whose byte-order mark says UTF-16.
fn utf_16(start: &[u8]) -> Option<fn([u8; 2]) -> u16> {
    match start {
        [0xff, 0xfe, ..] => Some(u16::from_le_bytes),
        [0xfe, 0xff, ..] => Some(u16::from_be_bytes),
        _ => None,
    }
}

impl<R: Read> Read for Table<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let mut left = self.start.get(self.at..).unwrap_or_default();
        if left.is_empty() && !self.decoded {
            return self.rest.read(buffer);
        }
        let read = left.read(buffer)?;
        self.at += read;
        Ok(read)
    }
}

impl<R: Read + Seek> Seek for Table<R> {
    /// To a place from the headings on.
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        let SeekFrom::Start(byte) = to else {
            return Err(io::Error::from(io::ErrorKind::Unsupported));
        };
        self.at = self.start.len();
        if self.decoded {
            self.at = self.at.min((byte + self.skip) as usize);
        } else {
            self.rest.seek(SeekFrom::Start(byte + self.skip))?;
        }
        Ok(byte)
    }
}

/// Whether a line names a time and another quantity. The time may be an empty first cell above a unit of time.
fn is_heading(line: &[u8], below: &[u8], separator: u8) -> bool {
    let Ok(line) = std::str::from_utf8(line) else {
        return false;
    };
    let line = line.trim_start_matches('\u{feff}').trim_end();
    let known: Vec<Quantity> = line
        .split(char::from(separator))
        .filter_map(|name| heading(name.trim().trim_matches('"')).ok().flatten())
        .map(|(quantity, _)| quantity)
        .collect();
    if known.contains(&Quantity::Time) {
        return known.len() > 1;
    }
    let unit = below.split(|byte| *byte == separator).next();
    let timed = unit.is_some_and(|unit| written(Quantity::Time, text(unit).trim()).is_ok());
    !known.is_empty() && line.starts_with(char::from(separator)) && timed
}

/// A text that may be no UTF-8, as older tools write degrees.
fn text(bytes: &[u8]) -> String {
    std::str::from_utf8(bytes).map_or_else(
        |_| bytes.iter().map(|byte| char::from(*byte)).collect(),
        str::to_owned,
    )
}

/// The units of a row below the headings, for the columns at these places; none where the row holds numbers.
pub fn units(
    record: &ByteRecord,
    columns: &[(usize, &str, Quantity, Unit)],
) -> Option<Result<Vec<Unit>, String>> {
    let cell = |place: usize| {
        let text = text(record.get(place).unwrap_or_default());
        text.trim_matches(['[', ']', '(', ')', ' ']).to_owned()
    };
    let is_unit = |(place, _, quantity, _): &(usize, &str, Quantity, Unit)| {
        written(*quantity, &cell(*place)).is_ok()
    };
    let is_number = |(place, ..): &(usize, &str, Quantity, Unit)| {
        cell(*place).replace(',', ".").parse::<f64>().is_ok()
    };
    let of_time = |column: &&(usize, &str, Quantity, Unit)| column.2 == Quantity::Time;
    let time = columns.iter().find(of_time)?;
    if !is_unit(time) || columns.iter().any(is_number) {
        return None;
    }
    let units = columns.iter().map(|(place, name, quantity, own)| {
        let cell = cell(*place);
        if matches!(cell.as_str(), "" | "-") {
            return Ok(*own);
        }
        let below = written(*quantity, &cell).map_err(|accepted| {
            format!(
                "column {}: its unit {:?} in the row below is not known; known are {accepted}",
                cut(name),
                cut(&cell)
            )
        })?;
        if own.name.is_empty() || own.name == below.name {
            return Ok(below);
        }
        Err(format!(
            "column {}: its name says {}, and the row below {}",
            cut(name),
            own.shown(),
            below.shown()
        ))
    });
    Some(units.collect())
}

/// A cell's number; of a table that is not separated by commas it may have a decimal comma. A missing sample is none: an empty
/// cell, or what tools write for no number.
pub fn number(cell: &[u8], separator: u8) -> Option<Result<f64, ()>> {
    let text = std::str::from_utf8(cell).unwrap_or("?").trim();
    let lower = text.trim_start_matches(['-', '+']).to_ascii_lowercase();
    if lower.is_empty() && text.is_empty() || lower == "nan" || lower.starts_with("nan(") {
        return None;
    }
    let number = if separator == b',' {
        text.parse()
    } else {
        text.replace(',', ".").parse()
    };
    Some(number.map_err(|_| ()))
}
