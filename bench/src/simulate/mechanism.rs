//! `simulate --mechanism`: what turns with the nut moves under motor torque and load, with the friction of the model: so that a model is judged by
//! motion, and not by torque alone.
//!
//! `J w' = torque - gain load lead/2pi - friction - drag w - offset`, with the scene without ball-to-ball friction and its memory. Every tick is
//! divided into steps that are implicit in the speed ([`crate::mechanism`]): friction holds the nut at rest and lets it break away.

use std::f64::consts::{PI, TAU};
use std::io::Write as _;
use std::path::{Path, PathBuf};

use epas_design::CagedDesign;
use epas_friction::Outputs;

use super::memory;
use super::nut::{Nut, STEPS};
use super::output::write_table;
use super::picture::Form;
use super::remembering::{Remembers, Use, remembering};
use super::screw;
use super::summary::{Flags, Lines};
use super::targets::targets;
use super::trace::{Sample, Temperature, read};
use crate::controller::Controller;
use crate::designs::Design;
use crate::designs::calibration::Calibrated;
use crate::failure::Failure;
use crate::files::{self, Existing, Pending, refuse_same};
use crate::flags;
use crate::mdf4::Mapping;
use crate::mechanism::Mechanism;
use crate::plot::{Axis, Chart, Mark, Panel, Series};
use crate::source::Source;

/// Options of a mechanism.
#[derive(Debug, clap::Args)]
pub struct MechanismArguments {
    /// Move what turns with the nut under the torque and the load of the trace (columns time, motor_torque, axial_load), with friction that
    /// remembers
    #[arg(long, requires = "input", conflicts_with_all = ["manoeuvre", "reference"])]
    mechanism: bool,
    /// Inertia at the nut, kg m^2 [default: that of the design's table [calibration]]
    // What requires an argument is not heard where that argument conflicts with another: so each conflict is said again.
    #[arg(
        long,
        value_name = "J",
        requires = "mechanism",
        conflicts_with_all = ["manoeuvre", "reference", "loads"],
        value_parser = inertia
    )]
    inertia: Option<f64>,
    /// Close the loop: motor torque = V (P (reference_position - nut angle) - nut speed); the trace has the column reference_position (rad) in
    /// place of motor_torque
    #[arg(
        long,
        value_name = "gain_position=P,gain_speed=V",
        requires = "mechanism",
        conflicts_with_all = ["manoeuvre", "reference", "loads"]
    )]
    controller: Option<Controller>,
}

/// An inertia, kg m^2.
fn inertia(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(value) if (1e-9..=1e3).contains(&value) => Ok(value),
        _ => Err("an inertia is 1e-9 to 1e3 kg m^2".into()),
    }
}

impl MechanismArguments {
    /// Whether a mechanism is simulated.
    pub fn wanted(&self) -> bool {
        self.mechanism
    }
}

/// One moment of what acts.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Acting {
    time: f64,
    /// Motor torque, N m, or wanted angle, rad.
    command: f64,
    axial_load: f64,
}

/// A moment of a torque.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Torque(Acting);

/// A moment of a wanted angle.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Wanted(Acting);

macro_rules! sample {
    ($name:ident, $command:literal) => {
        impl Sample for $name {
            const COLUMNS: &'static [&'static str] = &["time", $command, "axial_load"];

            fn read<E>(mut column: impl FnMut(&'static str) -> Result<f64, E>) -> Result<Self, E> {
                Ok(Self(Acting {
                    time: column("time")?,
                    command: column($command)?,
                    axial_load: column("axial_load")?,
                }))
            }

            fn record(&self) -> Vec<String> {
                [self.0.time, self.0.command, self.0.axial_load]
                    .map(|value| value.to_string())
                    .to_vec()
            }

            fn time(&self) -> f64 {
                self.0.time
            }

            fn speed(&self) -> f64 {
                0.0
            }

            fn load(&self) -> f64 {
                self.0.axial_load
            }
        }
    };
}

sample!(Torque, "motor_torque");
sample!(Wanted, "reference_position");

/// The nut at the time of a sample: where it is, what it feels, and what acts on it from then on.
struct Row {
    acting: Acting,
    angle: f64,
    speed: f64,
    torque: f64,
    /// Friction at that time, N m.
    friction: f64,
    /// What the screw says of the tick that begins: torque of the load, flags.
    outputs: Outputs,
}

/// Runs the mechanism of a design over a trace, and writes what is asked for.
pub fn run(
    design: &Design,
    arguments: &MechanismArguments,
    [input, channels]: [Option<&Path>; 2],
    [output, plot]: [&Option<PathBuf>; 2],
    existing: Existing,
) -> Result<(), Failure> {
    let input = input.ok_or_else(|| Failure::Data("there is no trace".into()))?;
    let (source, mapping) = (Source(input), channels.map(Mapping::read).transpose()?);
    let calibrated = design.calibrated.as_ref();
    let follows = calibrated.is_some_and(Calibrated::follows_temperature);
    let (name, acting, temperature) = match arguments.controller {
        Some(_) => moments::<Wanted>(&source, mapping.as_ref(), follows, |sample| sample.0)?,
        None => moments::<Torque>(&source, mapping.as_ref(), follows, |sample| sample.0)?,
    };
    let outputs = targets([output, plot], &name, &design.name);
    for path in outputs.iter().flatten() {
        existing.check(path)?;
    }
    refuse_same([Some(input)], outputs.iter().flatten())?;
    let inertia = arguments
        .inertia
        .or_else(|| calibrated.and_then(|found| found.inertia.map(f64::from)))
        .ok_or_else(|| {
            Failure::Data(
                "the inertia at the nut is missing: --inertia, or inertia in the design's table [calibration]".into(),
            )
        })?;
    let tick = tick(&acting)?;
    let course = Course {
        design,
        acting: &acting,
        temperature: &temperature,
        inertia,
        controller: arguments.controller,
        tick,
    };
    let (rows, mut lines) = moved(course)?;
    if let Some(told) = temperature.told() {
        lines.add("temperature", told);
    }
    let mut written = Vec::new();
    if let [Some(table), _] = &outputs {
        let mut pending = Pending::new(table, existing)?;
        let group = format!("{name} on {}", design.name);
        write_table(
            pending.writer(),
            table,
            (&group, &COLUMNS),
            rows.iter().map(record),
        )?;
        written.push(pending);
    }
    if let [_, Some(picture)] = &outputs {
        let mut pending = Pending::new(picture, existing)?;
        files::all(
            &mut pending,
            picture,
            &drawn(&name, &design.name, &rows, Form::of(picture))?,
        )?;
        written.push(pending);
    }
    for pending in written {
        pending.finish()?;
    }
    let mut stdout = files::told(outputs.iter().flatten());
    let CagedDesign {
        friction,
        clearance,
        ..
    } = design.caged;
    let mut settings = Lines::default();
    settings.add("design", design.name.clone());
    settings.append(screw::settings(design, friction, clearance));
    settings.print(&mut stdout)?;
    summary(&rows, inertia, tick).print(&mut stdout)?;
    lines.print(&mut stdout)?;
    for path in outputs.iter().flatten() {
        writeln!(stdout, "wrote {}", path.display())?;
    }
    Ok(())
}

fn moments<S: Sample>(
    source: &Source<'_>,
    channels: Option<&Mapping>,
    follows: bool,
    acting: fn(&S) -> Acting,
) -> Result<(String, Vec<Acting>, Temperature), Failure> {
    let (trace, temperature) = read::<S>(source, channels, follows)?;
    let moments = trace.samples.iter().map(acting).collect();
    Ok((trace.name, moments, temperature))
}

/// The tick of a trace of equal steps of time, s.
fn tick(acting: &[Acting]) -> Result<f64, Failure> {
    let refused = |message: &str| Err(Failure::Data(message.into()));
    let [first, .., last] = acting else {
        return refused("a mechanism needs two samples or more");
    };
    let tick = (last.time - first.time) / (acting.len() - 1) as f64;
    if !(1e-6..=1.0).contains(&tick) {
        return refused("the tick of the trace is out of range; allowed: 1e-6 to 1 s");
    }
    let uneven = acting
        .windows(2)
        .any(|pair| (pair[1].time - pair[0].time - tick).abs() > 0.01 * tick);
    if uneven {
        return refused("a mechanism needs a trace of equal steps of time");
    }
    Ok(tick)
}

/// Moves the nut of a design with friction that remembers.
fn moved(course: Course<'_>) -> Result<(Vec<Row>, Lines), Failure> {
    let Course {
        design,
        acting,
        tick,
        ..
    } = course;
    let load = acting
        .iter()
        .map(|acting| acting.axial_load.abs())
        .sum::<f64>()
        / acting.len() as f64;
    let speed = memory::speed((tick / STEPS as f64) as f32)
        .map_err(|error| Failure::Data(format!("{}: {error}", design.name)))?;
    remembering(design, load as f32, speed, course)
}

/// What moves the nut.
struct Course<'a> {
    design: &'a Design,
    acting: &'a [Acting],
    temperature: &'a Temperature,
    inertia: f64,
    controller: Option<Controller>,
    tick: f64,
}

impl Use for Course<'_> {
    type Made = Vec<Row>;

    fn with(self, screw: impl Remembers + 'static) -> Vec<Row> {
        motion(screw, &self)
    }
}

/// Moves the nut.
fn motion(model: impl Remembers, course: &Course<'_>) -> Vec<Row> {
    let Course {
        design,
        acting,
        temperature,
        inertia,
        controller,
        tick,
    } = *course;
    let nut = Nut::of(design, model);
    let start = match (controller, acting.first()) {
        (Some(_), Some(first)) => first.command,
        _ => 0.0,
    };
    let mut mechanism = Mechanism {
        inertia,
        position: start,
        speed: 0.0,
        resistance: nut,
    };
    let time = tick / STEPS as f64;
    let mut rows = Vec::with_capacity(acting.len());
    for (sample, acting) in acting.iter().enumerate() {
        // A nut that has not moved yet feels no friction.
        let before = mechanism.resistance.outputs;
        let friction = before.map_or(0.0, |outputs| outputs.friction_torque.into());
        let (angle, speed) = (mechanism.position, mechanism.speed);
        let torque = controller.map_or(acting.command, |controller| {
            controller.effort(acting.command, angle, speed)
        });
        mechanism.resistance.axial_load = acting.axial_load;
        let now = mechanism.resistance.temperature;
        mechanism.resistance.temperature = temperature.at(sample).unwrap_or(now);
        for _ in 0..STEPS {
            mechanism.advance(torque, time);
        }
        if let Some(outputs) = mechanism.resistance.outputs {
            rows.push(Row {
                acting: *acting,
                angle,
                speed,
                torque,
                friction,
                outputs,
            });
        }
    }
    rows
}

/// Columns of the table.
pub const COLUMNS: [&str; 9] = [
    "time",
    "motor_torque",
    "axial_load",
    "nut_position",
    "nut_speed",
    "friction_torque",
    "load_torque",
    "faults",
    "fault_words",
];

/// The values of [`COLUMNS`].
fn record(row: &Row) -> Vec<String> {
    let numbers = [
        row.acting.time,
        row.torque,
        row.acting.axial_load,
        row.angle,
        row.speed,
        row.friction,
        row.outputs.load_torque.into(),
    ];
    let mut record: Vec<String> = numbers.map(|number| number.to_string()).to_vec();
    record.push(row.outputs.faults.bits().to_string());
    record.push(flags::words(row.outputs.faults));
    record
}

/// How often the nut turned back, and what it did with its energy.
fn summary(rows: &[Row], inertia: f64, tick: f64) -> Lines {
    let mut lines = Lines::default();
    let most =
        |value: &dyn Fn(&Row) -> f64| rows.iter().map(|row| value(row).abs()).fold(0.0, f64::max);
    let work = |torque: &dyn Fn(&Row) -> f64| -> f64 {
        rows.iter().map(|row| torque(row) * row.speed * tick).sum()
    };
    let moving: Vec<f64> = rows
        .iter()
        .map(|row| row.speed)
        .filter(|speed| speed.abs() > 1e-6)
        .collect();
    let reversals = moving
        .windows(2)
        .filter(|pair| pair[0] * pair[1] < 0.0)
        .count();
    lines.add("inertia", format!("{inertia} kg m^2"));
    lines.add(
        "turned through",
        format!("{:.4} turns at most", most(&|row| row.angle) / TAU),
    );
    lines.add(
        "nut speed",
        format!(
            "{:.4} rad/s ({:.1} rpm) at most",
            most(&|row| row.speed),
            most(&|row| row.speed) * 30.0 / PI
        ),
    );
    lines.add("reversals", reversals.to_string());
    lines.add("motor work", format!("{:.4} J", work(&|row| row.torque)));
    lines.add(
        "friction work",
        format!("{:.4} J", work(&|row| row.friction)),
    );
    let held = rows.iter().filter(|row| row.speed.abs() <= 1e-6).count();
    lines.add(
        "at rest",
        format!(
            "{:.1} % of the time",
            100.0 * held as f64 / rows.len().max(1) as f64
        ),
    );
    let mut flags = Flags::default();
    for row in rows {
        flags.add(row.outputs.faults);
    }
    flags.lines(&mut lines);
    lines
}

fn drawn(trace: &str, design: &str, rows: &[Row], form: Form) -> Result<String, Failure> {
    let title = format!("{trace} on {design}");
    let curve = |value: &dyn Fn(&Row) -> f64| form.curve(rows, &|row| row.acting.time, value);
    let panel = |title: String, label: &str, curves: Vec<(&str, Vec<(f64, f64)>)>| {
        let series = curves.into_iter().enumerate();
        Panel::Chart(Chart {
            title,
            x: Axis::linear("time (s)"),
            y: Axis::linear(label),
            series: series
                .map(|(colour, (name, points))| Series::new(name, colour, Mark::Line, points))
                .collect(),
            notes: Vec::new(),
        })
    };
    let panels = [
        panel(
            title.clone(),
            "torque at the nut (N m)",
            vec![
                ("motor", curve(&|row| row.torque)),
                ("load", curve(&|row| row.outputs.load_torque.into())),
                ("friction", curve(&|row| row.friction)),
            ],
        ),
        panel(
            String::new(),
            "nut angle (rad)",
            vec![("", curve(&|row| row.angle))],
        ),
        panel(
            String::new(),
            "nut speed (rad/s)",
            vec![("", curve(&|row| row.speed))],
        ),
    ];
    form.draw(&title, &panels)
}

#[cfg(test)]
mod tests;
