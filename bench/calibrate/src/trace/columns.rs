//! Reads a trace from the columns of a CSV file.
//!
//! Needed are `time`; a position or a speed, plain or of the motor, nut or carriage; `motor_force` or `motor_torque`.
//! Taken where there are any: a reference position, `axial_load` (or `rack_force`, or the torque `load_torque`), `known_force` or
//! `known_torque`, and `temperature`. A name may end in its unit (`nut_position_deg`); without, it is SI. Other columns are named and
//! left aside.
//!
//! Without a design the trace stays in its own coordinate: with a torque what turns, with a force what travels, and a
//! plain position or speed is that of what the effort acts on. With a design everything is referred to the nut: there, a
//! plain position or speed is the nut's beside a torque, and the carriage's beside a force.

#[cfg(test)]
mod tables;
#[cfg(test)]
mod tests;

use std::borrow::Cow;
use std::f64::consts::TAU;
use std::io::{Read, Seek};
use std::ops::Range;

use epas_design::files::Design;
use epas_design::files::plausible::FASTEST;
use epas_page::aside::say;
use epas_page::failure::Failure;
use epas_traces::mdf4::{self, Mapping};
use epas_traces::source::Source;

use crate::trace::acting;
use crate::trace::channels::{resolution, unwrap};
use crate::trace::clock::Clock;
use crate::trace::free_load::{self, LoadKind};
use crate::trace::known::KnownEffort;
use crate::trace::outliers;
use crate::trace::stuck;
use crate::trace::table::{self, Column, Table};
use crate::trace::{Coordinate, Repairs, Trace};
use epas_traces::units::{self, Dimension, Part, Quantity};

/// Largest trace file, bytes: what twelve million samples of many columns need; a quoted field may span lines, and is
/// held whole.
const LARGEST_FILE: u64 = 1 << 31;

/// Temperatures that a screw can have, K.
const TEMPERATURES: (f64, f64) = (150.0, 620.0);

/// What refers a motor and a carriage to the nut.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    /// Travel of the carriage in a turn of the nut, m.
    pub lead: f64,
    /// Turns of the motor in a turn of the nut.
    pub ratio: f64,
    /// Fastest that the nut is to turn, rad/s.
    pub fastest: f64,
}

impl Frame {
    /// That of a design whose motor makes so many turns in a turn of the nut, or one.
    pub fn of(design: &Design, ratio: Option<f64>) -> Self {
        Self {
            lead: design.screw().lead().into(),
            ratio: ratio.unwrap_or(1.0),
            fastest: design.caged.limits.nut_speed.into(),
        }
    }

    /// Refuses a motion whose name says no unit and that is far too fast for the design, but not where it is in degrees.
    fn check_unsaid(&self, column: &Unsaid, mut speeds: Vec<f64>) -> Result<(), String> {
        /// Share of the speeds that may be noise.
        const NOISE: f64 = 0.05;
        speeds.sort_by(f64::total_cmp);
        let place = ((1.0 - NOISE) * speeds.len() as f64) as usize;
        let speed = speeds.get(place).copied().unwrap_or_default();
        if speed < FASTEST * self.fastest || speed.to_radians() > self.fastest {
            return Ok(());
        }
        let Unsaid { name, units, part } = column;
        let gear = if *part == Part::Nut {
            ""
        } else {
            ", or that of a motor behind a gear (--ratio)"
        };
        Err(format!(
            "column {name}: the nut turns at {speed:.0} rad/s, and nut_speed in [limits] is {}; is the column in degrees{gear}? Then its name is {}; else raise nut_speed",
            self.fastest,
            units
                .iter()
                .map(|unit| format!("{name} [{unit}]"))
                .collect::<Vec<_>>()
                .join(" or "),
        ))
    }
}

/// A column of a motion that may turn, and says no unit.
struct Unsaid {
    name: String,
    /// Units that it may be in.
    units: &'static [&'static str],
    part: Part,
}

impl Unsaid {
    fn of(
        column: &Column,
        part: Part,
        reference: Reference,
        units: &'static [&'static str],
    ) -> Option<Self> {
        (column.unit.dimension == Dimension::Unsaid && reference.angle).then(|| Self {
            name: column.name.clone(),
            units,
            part,
        })
    }
}

/// Sizes of the mean speeds over stretches of a motion, so long that the steps of a sensor do not count.
fn mean_speeds(position: &[f64], step: f64) -> Vec<f64> {
    /// Length of a stretch, s.
    const STRETCH: f64 = 0.05;
    let ticks = ((STRETCH / step).round() as usize).max(1);
    let ends = position.iter().zip(position.iter().skip(ticks));
    ends.step_by(ticks)
        .map(|(from, to)| (to - from).abs() / (ticks as f64 * step))
        .collect()
}

/// Reads a trace from a file: a table, or a measurement file with the channels of a mapping or those that have a column's name.
///
/// # Errors
/// A file that cannot be read, or what is wrong with it.
pub fn read(
    source: &Source<'_>,
    frame: Option<&Frame>,
    channels: Option<&Mapping>,
) -> Result<Trace, Failure> {
    let input = source.open(LARGEST_FILE)?;
    let name = source.name();
    let trace = if input.measurement {
        measured(input, &name, frame, channels)
    } else {
        source.without_channels(channels)?;
        from_reader(input, &name, frame)
    };
    trace.map_err(|failure| failure.of(&source.shown()))
}

/// Reads a trace from a measurement file.
///
/// # Errors
/// What is wrong with it.
pub fn measured(
    input: impl Read,
    name: &str,
    frame: Option<&Frame>,
    channels: Option<&Mapping>,
) -> Result<Trace, Failure> {
    let wanted: Vec<mdf4::Wanted> = units::names()
        .filter_map(|name| Some((name, units::quantity(name)?)))
        // Of two names of a quantity the first, which messages use.
        .filter(|(name, quantity)| {
            *quantity != Quantity::Time
                && units::names().find(|own| units::quantity(own) == Some(*quantity)) == Some(*name)
        })
        .map(|(name, quantity)| mdf4::Wanted {
            name,
            quantity,
            refuses: None,
        })
        .collect();
    let parts = [Part::Nut, Part::Motor, Part::Carriage, Part::Plain];
    let master: Vec<Quantity> = parts
        .map(Quantity::Position)
        .into_iter()
        .chain(parts.map(Quantity::Speed))
        .collect();
    let request = mdf4::Request {
        wanted: &wanted,
        master: &master,
        mapping: channels,
    };
    let found = mdf4::read(input, &request).map_err(Failure::Data)?;
    for note in &found.notes {
        say(format_args!("note: {name}: {note}"));
    }
    let table = table::of_measurement(found).map_err(Failure::Data)?;
    assemble(table, name, frame).map_err(Failure::Data)
}

/// Reads a trace.
///
/// # Errors
/// What is wrong with it, with the line where there is one.
pub fn from_reader(
    input: impl Read + Seek,
    name: &str,
    frame: Option<&Frame>,
) -> Result<Trace, Failure> {
    let table = table::read(input).map_err(Failure::Data)?;
    assemble(table, name, frame).map_err(Failure::Data)
}

/// How a column's values refer to the trace's coordinate.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Reference {
    /// Factor.
    factor: f64,
    /// Whether the column is an angle, which may wrap.
    angle: bool,
}

fn assemble(mut table: Table, name: &str, frame: Option<&Frame>) -> Result<Trace, String> {
    let left_out = outliers::clean(&mut table)?;
    let lost = stuck::clean(&mut table)?;
    let lost: Vec<Range<f64>> = lost
        .iter()
        .map(|run| table.times[run.start]..table.times[run.end - 1])
        .collect();
    let clock = Clock::of(std::mem::take(&mut table.times), table.repeated.len())?;
    let (effort, torque) = effort(&mut table)?;
    let position = motion(&mut table, Quantity::Position);
    let speed = motion(&mut table, Quantity::Speed);
    let Some((_, part)) = position.as_ref().or(speed.as_ref()) else {
        return Err(absent(
            "a column position or speed is missing (of nut_, motor_, carriage_ or plain)",
            &table,
        ));
    };
    let reference = take(&mut table, Quantity::ReferencePosition).map(|column| (column, *part));
    let (load, load_is_effort) = acting::load(&mut table, torque, frame)?;
    let known = acting::known(&mut table, torque)?;
    let temperature = take(&mut table, Quantity::Temperature);
    if let Some(column) = &temperature {
        check_temperature(column, &table)?;
    }
    let refer = |column: &Column, part| refer(column, part, torque, frame);

    let speed = speed
        .map(|(column, part)| {
            let reference = refer(&column, part)?;
            let unsaid = Unsaid::of(&column, part, reference, &["rpm", "deg/s"]);
            let values = clock.resample(scaled(column.values, reference.factor));
            if let (Some(frame), Some(unsaid)) = (frame, unsaid) {
                frame.check_unsaid(&unsaid, values.iter().map(|speed| speed.abs()).collect())?;
            }
            Ok::<_, String>(values)
        })
        .transpose()?;
    // The sensor's step is found before samples are interpolated, which lie between its steps.
    let mut step_of_sensor = 0.0;
    let position = position
        .map(|(mut column, part)| {
            let reference = refer(&column, part)?;
            let filled = std::mem::take(&mut column.left_out);
            let unsaid = Unsaid::of(&column, part, reference, &["deg"]);
            let values = angle(column, reference)?;
            if let (Some(frame), Some(unsaid)) = (frame, &unsaid) {
                frame.check_unsaid(unsaid, mean_speeds(&values, clock.step))?;
            }
            step_of_sensor = resolution(&measured_only(&values, &filled));
            if let Some(unsaid) = &unsaid {
                check_degrees(&unsaid.name, step_of_sensor / reference.factor)?;
            }
            Ok::<_, String>(values)
        })
        .transpose()?;
    let position_summed = position.is_none();
    let position = match position {
        Some(values) => clock.resample(values),
        None => sum_up(speed.as_deref().unwrap_or_default(), clock.step),
    };
    let reference_position = reference
        .map(|(column, part)| {
            let reference = refer(&column, part)?;
            let mut values = angle(column, reference)?;
            if reference.angle {
                same_turn(&mut values, &position, reference.factor);
            }
            Ok::<_, String>(clock.resample(values))
        })
        .transpose()?;
    let effort = scaled(effort.values, effort_gain(torque, frame));
    table
        .ignored
        .extend(table.columns.drain(..).map(|column| column.name));
    let rotates = torque || frame.is_some();
    let mut repairs = Repairs {
        left_out,
        lost: lost.iter().map(|times| clock.ticks(times)).collect(),
        notes: table.notes,
        ..clock.repairs.clone()
    };
    let unit = if load_is_effort && torque { "N m" } else { "N" };
    let load =
        load.and_then(|column| measured_load(column, unit, &effort, clock.step, &mut repairs));
    let known = known.map(|column| scaled(column.values, effort_gain(torque, frame)));
    Ok(Trace {
        name: name.into(),
        coordinate: if rotates {
            Coordinate::Rotation
        } else {
            Coordinate::Translation
        },
        start: clock.start,
        step: clock.step,
        position,
        resolution: step_of_sensor,
        position_summed,
        speed,
        effort: clock.resample(effort),
        reference_position,
        load: load.map(|values| clock.resample(values)),
        load_is_effort,
        known: known.map(|values| KnownEffort {
            values: clock.resample(values),
            in_effort: false,
        }),
        temperature: temperature.map(|column| clock.resample(column.values)),
        repairs,
        ignored: table.ignored,
    })
}

/// The values without those that were filled in.
fn measured_only<'a>(values: &'a [f64], filled: &[usize]) -> Cow<'a, [f64]> {
    if filled.is_empty() {
        return Cow::Borrowed(values);
    }
    let mut filled = filled.iter().copied().peekable();
    let kept = values
        .iter()
        .enumerate()
        .filter(|(sample, _)| filled.next_if_eq(sample).is_none());
    Cow::Owned(kept.map(|(_, value)| *value).collect())
}

/// The load, unless its channel holds noise alone: none then, or the load that stays.
fn measured_load(
    column: Column,
    unit: &str,
    effort: &[f64],
    step: f64,
    repairs: &mut Repairs,
) -> Option<Vec<f64>> {
    match free_load::kind(&column.values, effort, step) {
        LoadKind::Changes => Some(column.values),
        LoadKind::Noise(mean, deviation) => {
            repairs.notes.push(format!(
                "column {}: it never leaves its own noise of {deviation:.3} {unit} (rms) about {mean:.3} {unit}, which is no load: it is not used; the load's gain stays 1, and friction is taken to be the same both ways",
                column.name
            ));
            None
        }
        LoadKind::Constant(mean, deviation) => {
            repairs.notes.push(format!(
                "column {}: it stays at {mean:.4} {unit} within its own noise of {deviation:.3} {unit} (rms), and is taken as that load throughout",
                column.name
            ));
            Some(vec![mean; column.values.len()])
        }
    }
}

/// Values times a factor.
fn scaled(mut values: Vec<f64>, factor: f64) -> Vec<f64> {
    for value in &mut values {
        *value *= factor;
    }
    values
}

/// A position in the trace's coordinate, without jumps of a turn.
fn angle(column: Column, reference: Reference) -> Result<Vec<f64>, String> {
    let mut values = column.values;
    if reference.angle {
        unwrap(&mut values).map_err(|message| format!("column {}: {message}", column.name))?;
    }
    Ok(scaled(values, reference.factor))
}

/// Takes the column of a quantity out of the table.
pub(super) fn take(table: &mut Table, quantity: Quantity) -> Option<Column> {
    let place = table
        .columns
        .iter()
        .position(|column| column.quantity == quantity)?;
    Some(table.columns.remove(place))
}

/// The effort, and whether it is a torque.
fn effort(table: &mut Table) -> Result<(Column, bool), String> {
    match (
        take(table, Quantity::MotorTorque),
        take(table, Quantity::MotorForce),
    ) {
        (Some(torque), None) => Ok((torque, true)),
        (None, Some(force)) => Ok((force, false)),
        (Some(torque), Some(force)) => Err(format!(
            "columns {} and {}: give the effort once",
            torque.name, force.name
        )),
        (None, None) => Err(absent(
            "column motor_torque or motor_force is missing",
            table,
        )),
    }
}

/// What is missing, beside what is there.
fn absent(missing: &str, table: &Table) -> String {
    let known = table.columns.iter().map(|column| &column.name);
    let all = known.chain(&table.ignored).map(String::as_str);
    let names: Vec<&str> = all.take(12).collect();
    if names.is_empty() {
        return format!("{missing}; there are no other columns");
    }
    format!("{missing}; left are {}", names.join(", "))
}

/// The column that tells the motion best: the nut's, before the motor's, the carriage's and a plain one.
fn motion(table: &mut Table, of: fn(Part) -> Quantity) -> Option<(Column, Part)> {
    [Part::Nut, Part::Motor, Part::Carriage, Part::Plain]
        .into_iter()
        .find_map(|part| Some((take(table, of(part))?, part)))
}

/// How a position or speed of this part refers to the trace's coordinate.
fn refer(
    column: &Column,
    part: Part,
    torque: bool,
    frame: Option<&Frame>,
) -> Result<Reference, String> {
    let angle = match (part, column.unit.dimension) {
        (Part::Motor | Part::Nut, Dimension::Length) | (Part::Carriage, Dimension::Angle) => {
            return Err(format!(
                "column {} has a unit that its part does not move in",
                column.name
            ));
        }
        (Part::Motor | Part::Nut, _) | (_, Dimension::Angle) => true,
        (Part::Carriage, _) | (_, Dimension::Length) => false,
        (Part::Plain, _) => torque,
    };
    let factor = match (frame, angle) {
        (Some(Frame { ratio, .. }), true) if part == Part::Motor => 1.0 / ratio,
        (Some(_), true) => 1.0,
        (Some(Frame { lead, .. }), false) => TAU / lead,
        (None, _) if angle == torque => 1.0,
        (None, _) => {
            return Err(format!(
                "column {} and a {} need a design, which says the lead",
                column.name,
                if torque {
                    "motor_torque"
                } else {
                    "motor_force"
                }
            ));
        }
    };
    Ok(Reference { factor, angle })
}

/// What the motor's effort is multiplied by to act on the trace's coordinate.
fn effort_gain(torque: bool, frame: Option<&Frame>) -> f64 {
    match frame {
        Some(Frame { ratio, .. }) if torque => *ratio,
        Some(Frame { lead, .. }) => lead / TAU,
        None => 1.0,
    }
}

/// Refuses an angle whose sensor has a power of two of steps in 360 of its unit.
fn check_degrees(name: &str, step: f64) -> Result<(), String> {
    /// Distance from a power of two, of its logarithm. Of encoders with such a step in radians, the first has 18,301 steps in a turn.
    const NEAR: f64 = 2e-5;
    /// Bits of encoders.
    const BITS: std::ops::RangeInclusive<f64> = 6.0..=24.0;
    let bits = (360.0 / step).log2();
    if !BITS.contains(&bits) || (bits - bits.round()).abs() > NEAR {
        return Ok(());
    }
    Err(format!(
        "column {name}: its sensor has steps of 360/2^{bits:.0}, as an angle in degrees: name it {name}_deg (or {name}_rad, if they are radians)"
    ))
}

fn check_temperature(column: &Column, table: &Table) -> Result<(), String> {
    let (low, high) = TEMPERATURES;
    let odd = column
        .values
        .iter()
        .enumerate()
        .find(|(_, value)| !(low..=high).contains(*value));
    let Some((sample, value)) = odd else {
        return Ok(());
    };
    Err(format!(
        "column {}: {value} K, in row {}, is no temperature of a screw; a column in degrees Celsius is named temperature_C",
        column.name,
        table.row(sample)
    ))
}

/// Position from speed: the sum of trapezoids.
fn sum_up(speed: &[f64], step: f64) -> Vec<f64> {
    let mut position = 0.0;
    let mut last = None;
    speed
        .iter()
        .map(|speed| {
            position += 0.5 * (last.unwrap_or(-speed) + speed) * step;
            last = Some(*speed);
            position
        })
        .collect()
}

/// Shifts an angle by whole turns of its sensor to where another one starts.
fn same_turn(angle: &mut [f64], other: &[f64], factor: f64) {
    let turn = TAU * factor;
    if let (Some(first), Some(start)) = (angle.first().copied(), other.first()) {
        let shift = ((start - first) / turn).round() * turn;
        for value in angle {
            *value += shift;
        }
    }
}
