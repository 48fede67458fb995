//! Reads a trace from the columns of a table or the channels of a measurement file.
//!
//! Needed are `time`; a position or a speed, plain or of the motor, nut or carriage; `motor_force` or `motor_torque`.
//! Taken where there are any: a reference position, `axial_load` (or `rack_force`, or the torque `load_torque`), `known_force` or
//! `known_torque`, and `temperature`. A name may end in its unit (`nut_position_deg`); without, it is SI. Other columns are named and
//! left aside.
//!
//! Without a design the trace stays in its own coordinate: with a torque what turns, with a force what travels, and a
//! plain position or speed is that of what the effort acts on. With a design everything is referred to the nut: there, a
//! plain position or speed is the nut's beside a torque, and the carriage's beside a force. A ratio alone refers a motor to the nut.

use std::f64::consts::TAU;
use std::io::{Read, Seek};
use std::ops::Range;

use epas_design::files::Design;
use epas_design::files::plausible::FASTEST;
use epas_page::aside::say;
use epas_page::failure::Failure;
use epas_traces::agreement;
use epas_traces::channels::{resolution, unwrap};
use epas_traces::clock::Clock;
use epas_traces::marks;
use epas_traces::mdf4::{self, Mapping};
use epas_traces::source::Source;
use epas_traces::table::{self, Column, Request, Table};
use epas_traces::units::{self, Dimension, Part, Quantity};

use crate::trace::KnownEffort;
use crate::trace::free_load;
use crate::trace::{Coordinate, Origins, Repairs, Trace};

const TEMPERATURES: (f64, f64) = (150.0, 620.0);

/// What refers a motor and a carriage to the nut.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Frame {
    /// Travel of the carriage in a turn of the nut, m, of a design.
    pub lead: Option<f64>,
    /// Turns of the motor in a turn of the nut, where it was given; with a design it is 1 where it was not.
    pub ratio: Option<f64>,
    /// Fastest that the nut of a design is to turn, rad/s.
    pub fastest: Option<f64>,
    /// The motor's rated torque, N m.
    pub rated_torque: Option<f64>,
}

impl Frame {
    /// That of a design whose motor makes so many turns in a turn of the nut, or one.
    pub fn of(design: &Design, ratio: Option<f64>) -> Self {
        Self {
            lead: Some(design.screw().lead().into()),
            ratio,
            fastest: Some(design.caged.limits.nut_speed.into()),
            rated_torque: None,
        }
    }

    /// The same with the motor's rated torque, N m.
    #[must_use]
    pub fn rated(self, rated_torque: Option<f64>) -> Self {
        Self {
            rated_torque,
            ..self
        }
    }

    /// How a position or speed of this part refers to the trace's coordinate: factor, and whether it is an angle.
    fn refer(&self, column: &Column, part: Part, torque: bool) -> Result<(f64, bool), String> {
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
        let factor = match (angle, self.lead) {
            (true, lead) if torque || lead.is_some() => match part {
                Part::Motor => 1.0 / self.ratio.unwrap_or(1.0),
                _ => 1.0,
            },
            (false, Some(lead)) => TAU / lead,
            (false, None) if !torque => 1.0,
            _ => {
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
        Ok((factor, angle))
    }

    /// What the motor's effort is multiplied by to act on the trace's coordinate.
    fn effort_gain(&self, torque: bool) -> f64 {
        if torque {
            self.ratio.unwrap_or(1.0)
        } else {
            self.lead.map_or(1.0, |lead| lead / TAU)
        }
    }

    /// Refuses a motion whose name says no unit and that is far too fast for the design, but not where it is in degrees.
    fn check_unit(
        &self,
        (column, part): &(Column, Part),
        motion: &[f64],
        tick: f64,
    ) -> Result<(), String> {
        /// Share of the speeds that may be noise, and length of a stretch, s, in which the steps of a sensor do not count.
        const NOISE: (f64, f64) = (0.05, 0.05);
        let unsaid = column.unit.dimension == Dimension::Unsaid && *part != Part::Carriage;
        let Some(fastest) = self.fastest.filter(|_| unsaid) else {
            return Ok(());
        };
        let (ticks, units) = match column.quantity {
            Quantity::Position(_) => (((NOISE.1 / tick).round() as usize).max(1), "deg"),
            _ => (0, "rpm] or {name} [deg/s"),
        };
        let mut speeds: Vec<f64> = if ticks == 0 {
            motion.iter().map(|speed| speed.abs()).collect()
        } else {
            let ends = motion.iter().zip(motion.iter().skip(ticks)).step_by(ticks);
            ends.map(|(from, to)| (to - from).abs() / (ticks as f64 * tick))
                .collect()
        };
        speeds.sort_by(f64::total_cmp);
        let place = ((1.0 - NOISE.0) * speeds.len() as f64) as usize;
        let speed = speeds.get(place).copied().unwrap_or_default();
        if speed < FASTEST * fastest || speed.to_radians() > fastest {
            return Ok(());
        }
        let name = &column.name;
        let gear = match part {
            Part::Nut => "",
            _ => ", or that of a motor behind a gear (--ratio)",
        };
        Err(format!(
            "column {name}: the nut turns at {speed:.0} rad/s, and nut_speed in [limits] is {fastest}; is the column in degrees{gear}? Then its name is {name} [{}]; else raise nut_speed",
            units.replace("{name}", name)
        ))
    }
}

/// Reads a trace from a file: a table, or a measurement file with the channels of a mapping or those that have a column's name.
pub fn read(
    source: &Source<'_>,
    frame: Option<&Frame>,
    channels: Option<&Mapping>,
) -> Result<Trace, Failure> {
    let input = source.open(table::LARGEST_FILE)?;
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
pub fn measured(
    input: impl Read,
    name: &str,
    frame: Option<&Frame>,
    channels: Option<&Mapping>,
) -> Result<Trace, Failure> {
    let mut wanted: Vec<mdf4::Wanted> = Vec::new();
    for name in units::names() {
        // Of several names of a quantity the first, which messages use.
        let new = |of: &Quantity| wanted.iter().all(|own| own.quantity != *of);
        let quantity = units::quantity(name).filter(new);
        wanted.extend(
            quantity
                .filter(|of| *of != Quantity::Time)
                .map(|quantity| mdf4::Wanted {
                    name,
                    quantity,
                    refuses: None,
                }),
        );
    }
    let master = [PARTS.map(Quantity::Position), PARTS.map(Quantity::Speed)].concat();
    let request = mdf4::Request {
        wanted: &wanted,
        master: &master,
        mapping: channels,
        rated_torque: frame.and_then(|frame| frame.rated_torque),
    };
    let mut found = mdf4::read(input, &request).map_err(Failure::Data)?;
    for note in std::mem::take(&mut found.notes) {
        say(format_args!("note: {name}: {note}"));
    }
    let frame = frame.copied().unwrap_or_default();
    assemble(found, name, &frame).map_err(Failure::Data)
}

/// Reads a trace from a table.
pub fn from_reader(
    input: impl Read + Seek,
    name: &str,
    frame: Option<&Frame>,
) -> Result<Trace, Failure> {
    let frame = frame.copied().unwrap_or_default();
    let everything = Request {
        wants: &|_| true,
        rated_torque: frame.rated_torque,
    };
    let table = table::read(input, everything).map_err(Failure::Data)?;
    assemble(table, name, &frame).map_err(Failure::Data)
}

const PARTS: [Part; 4] = [Part::Nut, Part::Motor, Part::Carriage, Part::Plain];

fn assemble(mut table: Table, name: &str, frame: &Frame) -> Result<Trace, String> {
    marks::mark(&mut table)?;
    agreement::check(&table)?;
    let marked = table.left_out.iter().flat_map(|found| &found.samples);
    let marked: Vec<[f64; 2]> = marked
        .map(|run| [table.times[run.start], table.times[run.end - 1]])
        .collect();
    let (effort, torque) = effort(&mut table)?;
    if frame.ratio.is_some() && frame.lead.is_none() && !torque {
        return Err(format!(
            "column {} and --ratio: a ratio is of a motor that turns; a force needs --design, which says the lead",
            effort.name
        ));
    }
    let position = motion(&mut table, Quantity::Position);
    let speed = motion(&mut table, Quantity::Speed);
    let Some((main, part)) = position.as_ref().or(speed.as_ref()) else {
        return Err(absent(
            "a column position or speed is missing (of nut_, motor_, carriage_ or plain)",
            &table,
        ));
    };
    let (main, part) = (main.name.clone(), *part);
    let reference = table.take(Quantity::ReferencePosition);
    let (load, load_is_effort) = load(&mut table, torque, frame)?;
    let known = known(&mut table, torque)?;
    let temperature = table.take(Quantity::Temperature);
    if let Some(column) = &temperature {
        check_temperature(column, &table)?;
    }
    let clock = Clock::of(std::mem::take(&mut table.times), table.repeated)?;
    let origins = Origins {
        motion: Some((main, part)),
        effort: effort.name.clone(),
        load: load.as_ref().map(|column| column.name.clone()),
        ratio_known: frame.ratio.is_some(),
    };
    let speed = speed.map(|own| {
        let (factor, _) = frame.refer(&own.0, own.1, torque)?;
        let values = clock.resample(scaled(&own.0.values, factor));
        frame.check_unit(&own, &values, clock.step)?;
        Ok::<_, String>(values)
    });
    let speed = speed.transpose()?;
    let position_summed = position.is_none();
    let (position, resolution) = match position {
        Some(own) => position_of(&own, frame, torque, &clock)?,
        None => (
            sum_up(speed.as_deref().unwrap_or_default(), clock.step),
            0.0,
        ),
    };
    let reference_position = reference.map(|column| {
        let (factor, angle) = frame.refer(&column, part, torque)?;
        let mut values = angle_of(column, factor, angle)?;
        if angle {
            same_turn(&mut values, &position, factor);
        }
        Ok::<_, String>(clock.resample(values))
    });
    let gain = frame.effort_gain(torque);
    let mut notes = table.notes;
    let effort = scaled(&effort.values, gain);
    let unit = if load_is_effort && torque { "N m" } else { "N" };
    let load = load.and_then(|column| measured_load(column, unit, &effort, clock.step, &mut notes));
    let others = table.columns.drain(..).map(|column| column.name);
    table.ignored.extend(others);
    let effort = clock.resample(effort);
    Ok(Trace {
        name: name.into(),
        coordinate: if torque || frame.lead.is_some() {
            Coordinate::Rotation
        } else {
            Coordinate::Translation
        },
        start: clock.start,
        step: clock.step,
        left_out: joined(&marked, &clock, effort.len()),
        position,
        resolution,
        position_summed,
        speed,
        effort,
        reference_position: reference_position.transpose()?,
        load: load.map(|values| clock.resample(values)),
        load_is_effort,
        known: known.map(|column| KnownEffort {
            values: clock.resample(scaled(&column.values, gain)),
            in_effort: false,
        }),
        temperature: temperature.map(|column| clock.resample(column.values)),
        origins,
        repairs: Repairs {
            left_out: table.left_out,
            notes,
            missing: clock.missing,
            jittered: clock.jittered,
            repeated: table.repeated,
            free_running: clock.free_running,
        },
        ignored: table.ignored,
    })
}

/// Ticks about the marked times, and those that fill a gap: in order and apart.
fn joined(marked: &[[f64; 2]], clock: &Clock, samples: usize) -> Vec<Range<usize>> {
    let marked = marked
        .iter()
        .map(|[first, last]| clock.ticks(*first, *last));
    let mut all: Vec<Range<usize>> = marked.chain(clock.filled.iter().cloned()).collect();
    all.sort_by_key(|run| run.start);
    let mut joined: Vec<Range<usize>> = Vec::new();
    for run in all {
        let run = run.start..run.end.min(samples);
        match joined.last_mut() {
            Some(last) if last.end >= run.start => last.end = last.end.max(run.end),
            _ if run.is_empty() => {}
            _ => joined.push(run),
        }
    }
    joined
}

fn position_of(
    own: &(Column, Part),
    frame: &Frame,
    torque: bool,
    clock: &Clock,
) -> Result<(Vec<f64>, f64), String> {
    let (factor, angle) = frame.refer(&own.0, own.1, torque)?;
    let values = angle_of(own.0.clone(), factor, angle)?;
    // What was interpolated lies between the sensor's steps.
    let mut filled = own.0.left_out.iter().peekable();
    let measured = values.iter().enumerate();
    let measured = measured.filter(|(sample, _)| filled.next_if_eq(&sample).is_none());
    let step = resolution(&measured.map(|(_, value)| *value).collect::<Vec<_>>());
    let values = clock.resample(values);
    frame.check_unit(own, &values, clock.step)?;
    if own.0.unit.dimension == Dimension::Unsaid && angle {
        check_degrees(&own.0.name, step / factor)?;
    }
    Ok((values, step))
}

/// The load, unless its channel holds noise alone: none then, or the load that stays.
fn measured_load(
    column: Column,
    unit: &str,
    effort: &[f64],
    step: f64,
    notes: &mut Vec<String>,
) -> Option<Vec<f64>> {
    /// A mean of so many deviations is a load that stays.
    const STAYS: f64 = 2.0;
    let Some((mean, deviation)) = free_load::noise(&column.values, effort, step) else {
        return Some(column.values);
    };
    let stays = mean.abs() > STAYS * deviation;
    notes.push(if stays {
        format!(
            "column {}: it stays at {mean:.4} {unit} within its own noise of {deviation:.3} {unit} (rms), and is taken as that load throughout",
            column.name
        )
    } else {
        format!(
            "column {}: it never leaves its own noise of {deviation:.3} {unit} (rms) about {mean:.3} {unit}, which is no load: it is not used; the load's gain stays 1, and friction is taken to be the same both ways",
            column.name
        )
    });
    stays.then(|| vec![mean; column.values.len()])
}

fn scaled(values: &[f64], factor: f64) -> Vec<f64> {
    values.iter().map(|value| value * factor).collect()
}

/// A position in the trace's coordinate, of an angle without jumps of a turn.
fn angle_of(mut column: Column, factor: f64, angle: bool) -> Result<Vec<f64>, String> {
    if angle {
        unwrap(&mut column.values)
            .map_err(|message| format!("column {}: {message}", column.name))?;
    }
    Ok(scaled(&column.values, factor))
}

fn either(
    table: &mut Table,
    quantities: [Quantity; 2],
    what: &str,
) -> Result<Option<(Column, bool)>, String> {
    match quantities.map(|quantity| table.take(quantity)) {
        [Some(one), Some(other)] => Err(format!(
            "columns {} and {}: give the {what} once",
            one.name, other.name
        )),
        [Some(one), None] => Ok(Some((one, true))),
        [None, other] => Ok(other.map(|other| (other, false))),
    }
}

fn effort(table: &mut Table) -> Result<(Column, bool), String> {
    let found = either(
        table,
        [Quantity::MotorTorque, Quantity::MotorForce],
        "effort",
    )?;
    found.ok_or_else(|| absent("column motor_torque or motor_force is missing", table))
}

/// The load's column, and whether it is in the effort's own unit. With a design, a torque about the nut's axis is the axial load over the
/// lead.
fn load(table: &mut Table, torque: bool, frame: &Frame) -> Result<(Option<Column>, bool), String> {
    let found = either(table, [Quantity::LoadTorque, Quantity::Load], "load")?;
    let mut column = match found {
        Some((column, true)) => column,
        force => {
            let force = force.map(|(force, _)| force);
            return Ok((force, frame.lead.is_none() && !torque));
        }
    };
    match frame.lead {
        Some(lead) => {
            column.values = scaled(&column.values, TAU / lead);
            Ok((Some(column), false))
        }
        None if torque => Ok((Some(column), true)),
        None => Err(format!(
            "column {} and a motor_force: give the load as axial_load",
            column.name
        )),
    }
}

fn known(table: &mut Table, torque: bool) -> Result<Option<Column>, String> {
    let kinds = [Quantity::KnownTorque, Quantity::KnownForce];
    match either(table, kinds, "known effort")? {
        Some((other, of_torque)) if of_torque != torque => {
            let kind = if torque { "torque" } else { "force" };
            Err(format!(
                "column {} and a motor_{kind}: give what is known as known_{kind}",
                other.name
            ))
        }
        own => Ok(own.map(|(own, _)| own)),
    }
}

fn absent(missing: &str, table: &Table) -> String {
    let known = table.columns.iter().map(|column| &column.name);
    let all = known.chain(&table.ignored).map(String::as_str);
    let names: Vec<&str> = all.take(12).collect();
    if names.is_empty() {
        return format!("{missing}; there are no other columns");
    }
    format!("{missing}; left are {}", names.join(", "))
}

fn motion(table: &mut Table, of: fn(Part) -> Quantity) -> Option<(Column, Part)> {
    PARTS
        .into_iter()
        .find_map(|part| Some((table.take(of(part))?, part)))
}

/// Refuses an angle whose sensor has a power of two of steps in 360 of its unit.
fn check_degrees(name: &str, step: f64) -> Result<(), String> {
    /// Distance from a power of two, of its logarithm. Of encoders with such a step in radians, the first has 18,301 steps in a turn.
    const NEAR: f64 = 2e-5;
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
    let odd = |value: &&f64| !(low..=high).contains(*value);
    let Some(value) = column.values.iter().find(odd) else {
        return Ok(());
    };
    let sample = column.values.iter().position(|other| other == value);
    Err(format!(
        "column {}: {value} K, in row {}, is no temperature of a screw; a column in degrees Celsius is named temperature_C",
        column.name,
        table.row(sample.unwrap_or_default())
    ))
}

fn sum_up(speed: &[f64], step: f64) -> Vec<f64> {
    let steps = speed
        .windows(2)
        .map(|pair| 0.5 * (pair[0] + pair[1]) * step);
    let places = std::iter::once(0.0).chain(steps).take(speed.len());
    places
        .scan(0.0, |place, step| {
            *place += step;
            Some(*place)
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
