//! Traces of speed and load, and how they are read from tables and measurement files.

use std::io::{Read, Seek};

use csv::{ErrorKind, Position, Reader, ReaderBuilder, StringRecord, Trim};

use epas_calibrate::trace::outliers::{self, LeftOut};
use epas_calibrate::trace::table;
use epas_design::files::calibration::TEMPERATURES;
use epas_page::aside::say;
use epas_page::failure::Failure;
use epas_page::files::line_of;
use epas_traces::front;
use epas_traces::headings;
use epas_traces::mdf4::{self, Mapping};
use epas_traces::source::Source;
use epas_traces::units::{Dimension, Quantity, Unit, channel, cut, heading, quantity};

/// One moment of a trace: what one scene's columns hold.
pub trait Sample: Copy {
    /// Columns that a trace must have, time first.
    const COLUMNS: &'static [&'static str];

    /// Columns that a trace may have; where it has none, each of their numbers is 0.
    const OPTIONAL: &'static [&'static str] = &[];

    /// From the numbers in its columns.
    fn read<E>(column: impl FnMut(&'static str) -> Result<f64, E>) -> Result<Self, E>;

    /// The numbers in the order of the columns, those that a trace may have behind those that it must have.
    fn record(&self) -> Vec<String>;

    /// A moment between two, each of its numbers by this function of theirs.
    #[must_use]
    fn between(low: &Self, high: &Self, of: &dyn Fn(f64, f64) -> f64) -> Self {
        let numbers = |sample: &Self| -> Vec<f64> {
            let record = sample.record();
            // A number that is written reads back as the same one.
            record
                .iter()
                .map(|text| text.parse().unwrap_or(f64::NAN))
                .collect()
        };
        let (low, high) = (numbers(low), numbers(high));
        let read = Self::read(|name| {
            let mut columns = Self::COLUMNS.iter().chain(Self::OPTIONAL);
            let place = columns.position(|column| *column == name);
            let pair = place.and_then(|place| Some((*low.get(place)?, *high.get(place)?)));
            Ok::<_, std::convert::Infallible>(pair.map_or(f64::NAN, |(low, high)| of(low, high)))
        });
        match read {
            Ok(sample) => sample,
            Err(never) => match never {},
        }
    }

    /// Time, s.
    fn time(&self) -> f64;

    /// Speed of what moves, rad/s of a nut and m/s of a carriage.
    fn speed(&self) -> f64;

    /// Axial load of a screw, normal load of a bearing, N.
    fn load(&self) -> f64;
}

/// One moment of a trace that a scene follows.
pub trait SceneSample: Sample {
    /// Inputs of the scene.
    type Inputs: Copy;

    /// Its inputs at this moment.
    fn inputs(&self) -> Self::Inputs;

    /// Position as its sensor reads it, rad (m); 0 where the trace has none.
    fn position(&self) -> f64 {
        0.0
    }
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

impl<S: SceneSample> Trace<S> {
    /// Whether it has a position beside the speed.
    pub fn has_position(&self) -> bool {
        self.samples.iter().any(|sample| sample.position() != 0.0)
    }
}

/// Most samples of a trace: more than an hour at 1 kHz, and less than fills a memory.
const MOST_SAMPLES: usize = 5_000_000;

/// Largest trace file, bytes: what five million samples need; a quoted field may span lines, and is held
/// whole.
const LARGEST_FILE: u64 = 1 << 29;

/// A column of temperatures beside the samples of a trace.
#[derive(Clone, Debug, PartialEq)]
pub enum Temperature {
    /// There is none.
    None,
    /// There is one, and nothing follows it.
    Ignored,
    /// One for each sample, K.
    Followed(Vec<f32>),
}

/// Its name.
const TEMPERATURE: &str = "temperature";

impl Temperature {
    /// That of a sample where one is followed, K.
    pub fn at(&self, sample: usize) -> Option<f32> {
        match self {
            Self::Followed(values) => values.get(sample).copied(),
            Self::None | Self::Ignored => None,
        }
    }

    /// What the summary says of it.
    pub fn told(&self) -> Option<String> {
        match self {
            Self::None => None,
            Self::Ignored => Some(
                "the trace's is ignored; what follows it: --scene caged with --memory, or --mechanism, of a design with full_film_ratio in \
                 [calibration]"
                    .into(),
            ),
            Self::Followed(values) => {
                let low = values.iter().copied().fold(f32::INFINITY, f32::min);
                let high = values.iter().copied().fold(0.0, f32::max);
                Some(format!("{low:.1} to {high:.1} K, followed by the friction coefficient"))
            }
        }
    }

    /// Refuses what is no temperature, K.
    fn check(value: f64) -> Result<(), String> {
        let (low, high) = TEMPERATURES;
        if !(f64::from(low)..=f64::from(high)).contains(&value) {
            return Err(format!(
                "{TEMPERATURE} = {value} is out of range; allowed: {low} to {high} K; a column in degrees Celsius is named temperature_C"
            ));
        }
        Ok(())
    }

    /// One more value, K.
    fn take(&mut self, value: f64) -> Result<(), String> {
        Self::check(value)?;
        if let Self::Followed(values) = self {
            values.push(value as f32);
        }
        Ok(())
    }
}

/// Reads a trace: a table, or a measurement file with the channels of a mapping or those that have a column's name; with its
/// temperatures where they are `followed`.
pub fn read<S: Sample>(
    source: &Source<'_>,
    channels: Option<&Mapping>,
    followed: bool,
) -> Result<(Trace<S>, Temperature), Failure> {
    let input = source.open(LARGEST_FILE)?;
    let (samples, temperature) = if input.measurement {
        let found = channels_of(input, channels, followed);
        found.map_err(|message| Failure::Data(format!("{}: {message}", source.shown())))?
    } else {
        source.without_channels(channels)?;
        parse(input, followed).map_err(|Fault { line, message }| {
            Failure::Data(format!("{}, line {line}: {message}", source.shown()))
        })?
    };
    let name = source.name();
    Ok((Trace { name, samples }, temperature))
}

/// What a column cannot be measured in: a carriage travels, and a wanted angle of the nut is one.
fn refused(column: &str) -> Option<Dimension> {
    match column {
        "speed" => Some(Dimension::Angle),
        "reference_position" => Some(Dimension::Length),
        _ => None,
    }
}

/// The samples of a measurement file.
pub fn measured<S: Sample>(input: impl Read, channels: Option<&Mapping>) -> Result<Vec<S>, String> {
    channels_of(input, channels, false).map(|(samples, _)| samples)
}

/// The samples of a measurement file, with its temperatures where they are `followed`.
fn channels_of<S: Sample>(
    input: impl Read,
    channels: Option<&Mapping>,
    followed: bool,
) -> Result<(Vec<S>, Temperature), String> {
    let optional = || S::OPTIONAL.iter().chain(followed.then_some(&TEMPERATURE));
    let wanted: Vec<mdf4::Wanted> = S::COLUMNS
        .iter()
        .chain(optional())
        .filter_map(|name| {
            let (quantity, _) = channel(name).ok()??;
            (quantity != Quantity::Time).then(|| mdf4::Wanted {
                name,
                quantity,
                refuses: refused(name),
            })
        })
        .collect();
    let first: Vec<Quantity> = wanted
        .iter()
        .take(1)
        .map(|wanted| wanted.quantity)
        .collect();
    let request = mdf4::Request {
        wanted: &wanted,
        master: &first,
        mapping: channels,
    };
    let mut found = mdf4::read(input, &request)?;
    for note in &found.notes {
        say(format_args!("note: {note}"));
    }
    leave_out(&mut found)?;
    let mut places = Vec::new();
    for wanted in &wanted {
        let column = found
            .columns
            .iter()
            .find(|column| column.quantity == wanted.quantity);
        if column.is_none() && !optional().any(|name| *name == wanted.name) {
            return Err(format!(
                "channel {} is missing; a file for --channels says which channel it is",
                wanted.name
            ));
        }
        places.push(column);
    }
    let warm = found
        .columns
        .iter()
        .find(|column| column.quantity == Quantity::Temperature);
    let named = |name: &String| matches!(channel(name), Ok(Some((Quantity::Temperature, _))));
    let mut temperature = match warm {
        Some(_) => Temperature::Followed(Vec::new()),
        None if found.ignored.iter().any(named) => Temperature::Ignored,
        None => Temperature::None,
    };
    let mut samples: Vec<S> = Vec::new();
    for (row, time) in found.times.iter().enumerate() {
        let sample = S::read(|column| {
            let place = wanted.iter().position(|wanted| wanted.name == column);
            let value = match place.and_then(|place| places.get(place)) {
                None => Some(*time),
                Some(None) => Some(0.0),
                Some(Some(column)) => column.values.get(row).copied(),
            };
            value.ok_or("a sample is missing")
        })?;
        let next = follows(&samples, sample).and_then(|next| {
            let value = warm.and_then(|column| column.values.get(row));
            value.map_or(Ok(()), |value| temperature.take(*value))?;
            Ok(next)
        });
        samples.push(next.map_err(|message| format!("sample {row}: {message}"))?);
    }
    enough(&samples)?;
    Ok((samples, temperature))
}

/// Leaves out what no mechanism makes.
fn leave_out(found: &mut mdf4::Table) -> Result<(), String> {
    let columns = found
        .columns
        .iter()
        .map(|column| table::Column::si(&column.name, column.quantity, column.values.clone()));
    let mut table = table::Table::of(found.times.clone(), columns.collect())?;
    for left_out in outliers::clean(&mut table)? {
        say(format_args!("note: {}", left_out.told()));
    }
    for (column, cleaned) in found.columns.iter_mut().zip(table.columns) {
        column.values = cleaned.values;
    }
    Ok(())
}

/// A trace has a duration.
fn enough<S>(samples: &[S]) -> Result<(), String> {
    match samples.len() {
        0 => Err("the trace is empty".into()),
        1 => Err("the trace has a single sample: at least 2".into()),
        _ => Ok(()),
    }
}

/// The samples of a trace, or what is wrong in which line.
pub fn samples<S: Sample>(input: impl Read + Seek) -> Result<Vec<S>, String> {
    parse(input, false)
        .map(|(samples, _)| samples)
        .map_err(|Fault { line, message }| format!("line {line}: {message}"))
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

fn parse<S: Sample>(
    input: impl Read + Seek,
    followed: bool,
) -> Result<(Vec<S>, Temperature), Fault> {
    let input = front::Table::new(input);
    let (separator, above) = (input.separator, input.lines);
    let mut reader = ReaderBuilder::new()
        .trim(Trim::All)
        .delimiter(separator)
        .from_reader(input);
    let below = |mut fault: Fault| {
        fault.line += above;
        fault
    };
    let start = reader.position().clone();
    let header = match reader.headers() {
        Ok(header) => header.clone(),
        Err(error) => return Err(below(Fault::from_csv(&error, reader, &start))),
    };
    let mut rows = Rows::of::<S>(&header, followed).map_err(below)?;
    rows.separator = separator;
    let mut record = StringRecord::new();
    loop {
        let start = reader.position().clone();
        match reader.read_record(&mut record) {
            Ok(true) => {}
            Ok(false) => break,
            Err(error) => return Err(below(Fault::from_csv(&error, reader, &start))),
        }
        if let Err(message) = rows.add(&record) {
            let line = line_of(reader.into_inner(), start.byte(), start.line());
            return Err(below(Fault::new(line, message)));
        }
    }
    let last = above + reader.position().line();
    rows.samples().map_err(|message| Fault::new(last, message))
}

/// Rows of a table as they are read.
struct Rows {
    /// Name, place and unit of the columns, time first; the temperature last where it is followed.
    places: Vec<(&'static str, usize, Option<Unit>)>,
    values: Vec<Vec<f64>>,
    temperature: Temperature,
    separator: u8,
}

impl Rows {
    fn of<S: Sample>(header: &StringRecord, followed: bool) -> Result<Self, Fault> {
        if !header.is_empty() {
            headings::separated(header).map_err(|message| Fault::new(1, message))?;
        }
        let mut places = S::COLUMNS
            .iter()
            .map(|column| place(header, column).map(|(place, unit)| (*column, place, unit)))
            .collect::<Result<Vec<_>, _>>()?;
        for column in S::OPTIONAL {
            let optional = found(header, column)?;
            places.extend(optional.map(|(place, unit)| (*column, place, unit)));
        }
        let warm = if followed {
            found(header, TEMPERATURE)?
        } else {
            None
        };
        let named = |name| matches!(heading(name), Ok(Some((Quantity::Temperature, _))));
        let temperature = match warm {
            Some(_) => Temperature::Followed(Vec::new()),
            None if header.iter().any(named) => Temperature::Ignored,
            None => Temperature::None,
        };
        places.extend(warm.map(|(place, unit)| (TEMPERATURE, place, unit)));
        Ok(Self {
            values: vec![Vec::new(); places.len()],
            places,
            temperature,
            separator: b',',
        })
    }

    /// Takes units from a row below the headings; whether there are any.
    fn takes_units(&mut self, record: &StringRecord) -> Result<bool, String> {
        let columns: Vec<_> = self
            .places
            .iter()
            .filter_map(|(name, place, unit)| {
                let quantity = quantity(name)?;
                Some((*place, *name, quantity, unit.unwrap_or(Unit::SI)))
            })
            .collect();
        let Some(units) = front::units(record.as_byte_record(), &columns) else {
            return Ok(false);
        };
        for ((name, _, unit), below) in self.places.iter_mut().zip(units?) {
            if refused(name) == Some(below.dimension) {
                return Err(format!("{name} is not measured in {}", below.shown()));
            }
            *unit = Some(below);
        }
        Ok(true)
    }

    fn add(&mut self, record: &StringRecord) -> Result<(), String> {
        let times = self.values.first().map_or(0, Vec::len);
        if times == 0 && self.takes_units(record)? {
            return Ok(());
        }
        let all = self.places.iter().zip(&mut self.values).enumerate();
        for (column, ((name, place, unit), values)) in all {
            let cell = record.get(*place).unwrap_or_default();
            let value = match number(cell, name, self.separator)? {
                Some(value) => unit.map_or(value, |unit| unit.si(value)),
                None if column == 0 => return Err(format!("{name} has no number")),
                None => f64::NAN,
            };
            if column == 0 {
                rises(values, value)?;
            }
            if *name == TEMPERATURE && !value.is_nan() {
                Temperature::check(value)?;
            }
            values.push(value);
        }
        Ok(())
    }

    /// The samples: empty cells filled, and what no mechanism makes left out.
    fn samples<S: Sample>(self) -> Result<(Vec<S>, Temperature), String> {
        let mut values = self.values.into_iter();
        let times = values.next().unwrap_or_default();
        enough(&times)?;
        let names = self.places.iter().skip(1).zip(values);
        let columns = names.filter_map(|((name, ..), values)| {
            Some(table::Column::si(name, quantity(name)?, values))
        });
        let mut table = table::Table::of(times, columns.collect())?;
        let left_out = outliers::clean(&mut table)?;
        let repaired = left_out.iter().map(LeftOut::told);
        for note in table.notes.iter().cloned().chain(repaired) {
            say(format_args!("note: {note}"));
        }
        let mut temperature = self.temperature;
        for value in table.values(TEMPERATURE).unwrap_or_default() {
            temperature.take(*value)?;
        }
        let samples = (0..table.times.len()).map(|row| {
            S::read(|column| {
                let values = if column == "time" {
                    Some(&table.times[..])
                } else {
                    table.values(column)
                };
                let value = match values {
                    None if S::OPTIONAL.contains(&column) => Some(0.0),
                    None => None,
                    Some(values) => values.get(row).copied(),
                };
                value.ok_or_else(|| "a column is missing".to_owned())
            })
        });
        Ok((samples.collect::<Result<_, _>>()?, temperature))
    }
}

/// Refuses a time that does not rise, and a trace that is too long.
fn rises(times: &[f64], time: f64) -> Result<(), String> {
    if times.len() == MOST_SAMPLES {
        return Err(format!("a trace has at most {MOST_SAMPLES} samples"));
    }
    match times.last() {
        Some(last) if time < *last => Err(format!("time goes back from {last} to {time}")),
        Some(last) if time == *last => Err(format!(
            "time = {time} stands twice: samples at the same time cannot be told apart"
        )),
        _ => Ok(()),
    }
}

/// The sample, where it may follow those before it.
fn follows<S: Sample>(samples: &[S], sample: S) -> Result<S, String> {
    if samples.len() == MOST_SAMPLES {
        return Err(format!("a trace has at most {MOST_SAMPLES} samples"));
    }
    let last = samples.last().map(Sample::time);
    rises(last.as_slice(), sample.time()).map(|()| sample)
}

/// Place of a column and its unit, which must be there once: under its own name, else with a unit behind it or in brackets.
fn place(header: &StringRecord, column: &str) -> Result<(usize, Option<Unit>), Fault> {
    if header.is_empty() {
        return Err(Fault::new(1, "the file is empty"));
    }
    found(header, column)?.ok_or_else(|| Fault::new(1, headings::missing(column, header)))
}

/// The same, where it is there.
fn found(header: &StringRecord, column: &str) -> Result<Option<(usize, Option<Unit>)>, Fault> {
    let fault = |message: String| Err(Fault::new(1, message));
    // A spreadsheet may put a byte-order mark before the first name.
    let names = || {
        header
            .iter()
            .map(|name| name.trim_start_matches('\u{feff}'))
            .enumerate()
    };
    let exact: Vec<usize> = names()
        .filter(|(_, name)| *name == column)
        .map(|(place, _)| place)
        .collect();
    match exact[..] {
        [place] => {
            return match names().find(|(other, name)| *other != place && says_unit(name, column)) {
                None => Ok(Some((place, None))),
                Some((_, name)) => fault(format!(
                    "columns {column} and {} are both {column}; leave one of them out",
                    cut(name)
                )),
            };
        }
        [_, _, ..] => return fault(format!("column {column} is there twice")),
        [] => {}
    }
    let wanted = channel(column).ok().flatten().map(|(quantity, _)| quantity);
    let mut found = Vec::new();
    let mut unknown = None;
    for (place, name) in names() {
        match heading(name) {
            Ok(Some((quantity, unit))) if Some(quantity) == wanted => {
                found.push((place, name, unit));
            }
            Err(message) if starts_like(name, column) => unknown = Some(message),
            _ => {}
        }
    }
    match (&found[..], unknown) {
        ([(_, name, unit)], _) if refused(column) == Some(unit.dimension) => fault(format!(
            "column {}: {column} is not measured in {}",
            cut(name),
            unit.shown()
        )),
        ([(place, _, unit)], _) => Ok(Some((*place, Some(*unit)))),
        ([(_, one, _), (_, other, _), ..], _) => fault(format!(
            "columns {} and {} are both {column}",
            cut(one),
            cut(other)
        )),
        ([], Some(message)) => fault(message),
        ([], None) => Ok(None),
    }
}

/// Whether a name is a column's with a unit.
fn says_unit(name: &str, column: &str) -> bool {
    let own = channel(column).ok().flatten().map(|(quantity, _)| quantity);
    let found = heading(name).ok().flatten();
    starts_like(name, column)
        && found.is_some_and(|(quantity, unit)| Some(quantity) == own && unit != Unit::SI)
}

fn starts_like(name: &str, column: &str) -> bool {
    let own = name
        .get(..column.len())
        .unwrap_or_default()
        .replace([' ', '-'], "_");
    own.eq_ignore_ascii_case(column)
}

/// A number that f32 can hold; none where the sample is missing.
fn number(text: &str, column: &str, separator: u8) -> Result<Option<f64>, String> {
    let fault = |problem: &str| {
        let shown: String = text.chars().take(40).collect();
        format!("{column} = {shown:?} {problem}")
    };
    let Some(number) = front::number(text.as_bytes(), separator) else {
        return Ok(None);
    };
    let value = number.map_err(|()| fault(headings::no_number(text.as_bytes())))?;
    if !value.is_finite() {
        return Err(fault("is not finite"));
    }
    if value.abs() > f64::from(f32::MAX) {
        return Err(fault("is beyond the range of float32"));
    }
    Ok(Some(value))
}

#[cfg(test)]
mod tests;
