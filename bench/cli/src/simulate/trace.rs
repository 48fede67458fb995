//! Traces of speed and load, and how they are read from tables and measurement files.

use std::io::{Read, Seek};

use crate::model::TickInputs;
use epas_design::files::calibration::TEMPERATURES;
use epas_page::aside::say;
use epas_page::failure::Failure;
use epas_traces::agreement;
use epas_traces::clock::check_raster;
use epas_traces::marks::{self, LeftOut};
use epas_traces::mdf4::{self, Mapping};
use epas_traces::source::Source;
use epas_traces::table::{self, Request, Table};
use epas_traces::units::{Dimension, Quantity, cut, heading, quantity};

/// One moment of a trace: what one scene's columns hold.
pub trait Sample: Copy {
    /// Columns that a trace must have, time first.
    const COLUMNS: &'static [&'static str];

    /// Columns that a trace may have; where it has none, each of their numbers is 0.
    const OPTIONAL: &'static [&'static str] = &[];

    /// A moment of its numbers in the order of the columns, those that a trace may have behind those that it must have.
    fn of(next: impl FnMut() -> f64) -> Self;

    /// The numbers in that order.
    fn numbers(&self) -> Vec<f64>;

    /// A moment between two, each of its numbers by this function of theirs.
    #[must_use]
    fn between(low: &Self, high: &Self, of: &dyn Fn(f64, f64) -> f64) -> Self {
        let mut pairs = low.numbers().into_iter().zip(high.numbers());
        Self::of(|| pairs.next().map_or(f64::NAN, |(low, high)| of(low, high)))
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
    fn inputs(&self) -> TickInputs;

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

/// A column of temperatures beside the samples of a trace.
#[derive(Clone, Debug, PartialEq)]
pub enum Temperature {
    /// The trace has none.
    None,
    /// There is one, and nothing follows it, for this reason.
    Ignored(&'static str),
    /// One for each sample, K.
    Followed(Vec<f32>),
}

/// Whether temperatures are followed, and if not, why.
pub type Follows = Result<(), &'static str>;

/// Reason where samples alone are wanted.
pub const UNREAD: &str = "only its samples are read";

const TEMPERATURE: &str = "temperature";

impl Temperature {
    /// That of a sample where one is followed, K.
    pub fn at(&self, sample: usize) -> Option<f32> {
        match self {
            Self::Followed(values) => values.get(sample).copied(),
            Self::None | Self::Ignored(_) => None,
        }
    }

    /// What the summary says of it.
    pub fn told(&self) -> Option<String> {
        match self {
            Self::None => None,
            Self::Ignored(reason) => Some(format!("the trace's is ignored: {reason}")),
            Self::Followed(values) => {
                let low = values.iter().copied().fold(f32::INFINITY, f32::min);
                let high = values.iter().copied().fold(0.0, f32::max);
                Some(format!(
                    "{low:.1} to {high:.1} K, followed by the friction coefficient"
                ))
            }
        }
    }

    fn of(table: &Table, followed: Follows) -> Self {
        let named = |name: &String| matches!(heading(name), Ok(Some((Quantity::Temperature, _))));
        if table.column(Quantity::Temperature).is_some() {
            return Self::Followed(Vec::new());
        }
        match followed {
            Err(reason) if table.ignored.iter().any(named) => Self::Ignored(reason),
            _ => Self::None,
        }
    }

    fn check(value: f64) -> Result<(), String> {
        let (low, high) = TEMPERATURES;
        if !(f64::from(low)..=f64::from(high)).contains(&value) {
            return Err(format!(
                "{TEMPERATURE} = {value} is out of range; allowed: {low} to {high} K; a column in degrees Celsius is named temperature_C"
            ));
        }
        Ok(())
    }

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
    followed: Follows,
) -> Result<(Trace<S>, Temperature), Failure> {
    let input = source.open(table::LARGEST_FILE)?;
    let found = if input.measurement {
        channels_of(input, channels, followed)
    } else {
        source.without_channels(channels)?;
        columns_of(input, followed)
    };
    let (samples, temperature) =
        found.map_err(|message| Failure::Data(message).of(&source.shown()))?;
    let name = source.name();
    Ok((Trace { name, samples }, temperature))
}

pub fn samples<S: Sample>(input: impl Read + Seek) -> Result<Vec<S>, String> {
    columns_of(input, Err(UNREAD)).map(|(samples, _)| samples)
}

pub fn measured<S: Sample>(input: impl Read, channels: Option<&Mapping>) -> Result<Vec<S>, String> {
    channels_of(input, channels, Err(UNREAD)).map(|(samples, _)| samples)
}

/// What a column cannot be measured in: a carriage travels, and a wanted angle of the nut is one.
fn refused(column: &str) -> Option<Dimension> {
    match column {
        "speed" => Some(Dimension::Angle),
        "reference_position" => Some(Dimension::Length),
        _ => None,
    }
}

fn wanted<S: Sample>(followed: Follows) -> Vec<mdf4::Wanted> {
    let names = S::COLUMNS.iter().chain(S::OPTIONAL);
    names
        .chain(followed.is_ok().then_some(&TEMPERATURE))
        .filter_map(|name| {
            let quantity = quantity(name)?;
            (quantity != Quantity::Time).then(|| mdf4::Wanted {
                name,
                quantity,
                refuses: refused(name),
            })
        })
        .collect()
}

fn columns_of<S: Sample>(
    input: impl Read + Seek,
    followed: Follows,
) -> Result<(Vec<S>, Temperature), String> {
    let wanted = wanted::<S>(followed);
    let request = Request {
        wants: &|quantity| wanted.iter().any(|wanted| wanted.quantity == quantity),
        rated_torque: None,
    };
    samples_of(table::read(input, request)?, &wanted, "column", followed)
}

fn channels_of<S: Sample>(
    input: impl Read,
    channels: Option<&Mapping>,
    followed: Follows,
) -> Result<(Vec<S>, Temperature), String> {
    let wanted = wanted::<S>(followed);
    let first: Vec<Quantity> = wanted.iter().take(1).map(|first| first.quantity).collect();
    let request = mdf4::Request {
        wanted: &wanted,
        master: &first,
        mapping: channels,
        rated_torque: None,
    };
    samples_of(mdf4::read(input, &request)?, &wanted, "channel", followed)
}

/// The samples of a table whose times are a raster without long gaps, with what no mechanism makes left out.
fn samples_of<S: Sample>(
    mut table: Table,
    wanted: &[mdf4::Wanted],
    kind: &str,
    followed: Follows,
) -> Result<(Vec<S>, Temperature), String> {
    let must = S::COLUMNS.len() - 1;
    for (place, wanted) in wanted.iter().enumerate() {
        match table.column(wanted.quantity) {
            Some(column) if wanted.refuses == Some(column.unit.dimension) => {
                return Err(format!(
                    "{kind} {}: {} is not measured in {}",
                    cut(&column.name),
                    wanted.name,
                    column.unit.shown()
                ));
            }
            None if place < must => {
                let other = table.columns.iter().map(|column| &column.name);
                let names: Vec<&str> = other.chain(&table.ignored).map(String::as_str).collect();
                let names = names.get(..12).unwrap_or(&names).join(", ");
                return Err(format!(
                    "{kind} {} is missing; beside the time there are {names}{}",
                    wanted.name,
                    match kind {
                        "channel" => "; a file for --channels says which channel it is",
                        _ => "",
                    }
                ));
            }
            _ => {}
        }
    }
    match table.times.len() {
        0 => return Err("the trace is empty".into()),
        1 => return Err("the trace has a single sample: at least 2".into()),
        _ => {}
    }
    check_raster(&table)?;
    marks::mark(&mut table)?;
    agreement::check(&table)?;
    tell(&table);
    let mut temperature = Temperature::of(&table, followed);
    if let Some(column) = table.column(Quantity::Temperature) {
        for value in &column.values {
            temperature.take(*value)?;
        }
    }
    let names = S::COLUMNS.iter().chain(S::OPTIONAL);
    let columns: Vec<Option<&[f64]>> = names
        .map(|name| match *name {
            "time" => Some(&table.times[..]),
            name => Some(&table.column(quantity(name)?)?.values[..]),
        })
        .collect();
    let samples = (0..table.times.len()).map(|row| {
        let mut columns = columns.iter();
        let mut next = || columns.next().copied().flatten();
        S::of(|| next().map_or(0.0, |values| values.get(row).copied().unwrap_or(f64::NAN)))
    });
    Ok((samples.collect(), temperature))
}

fn tell(table: &Table) {
    let left_out = table.left_out.iter().map(LeftOut::told);
    for note in table.notes.iter().cloned().chain(left_out) {
        say(format_args!("note: {note}"));
    }
    if table.repeated > 0 {
        say(format_args!(
            "note: {} samples have the time of the one before, and are dropped",
            table.repeated
        ));
    }
}

#[cfg(test)]
mod tests;
