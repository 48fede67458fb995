//! `simulate --mechanism`: what turns with the nut moves under motor torque and load, with the friction of the model: so that a model is judged by
//! motion, and not by torque alone.
//!
//! `J w' = torque + known - gain load lead/2pi - friction - drag w - offset`, with the scene without ball-to-ball friction and its memory. Every tick is
//! divided into steps that are implicit in the speed ([`epas_calibrate::mechanism`]): friction holds the nut at rest and lets it break away.

mod acting;
mod shown;

use std::io::Write as _;
use std::path::{Path, PathBuf};

use epas_design::CagedDesign;

use super::beyond::Beyond;
use super::caged;
use super::memory::{self, MemorySettings};
use super::nut::{Nut, STEPS};
use super::output::{targets, write_table};
use super::picture::Form;
use super::remembering::remembering;
use super::screw;
use super::summary::Lines;
use super::trace::Temperature;
use crate::model::{Model, TickOutputs};
#[cfg(test)]
pub use acting::Commanded;
use acting::{Acting, moments, tick};
use epas_calibrate::controller::Controller;
use epas_calibrate::mechanism::Mechanism;
use epas_design::files::Design;
use epas_page::failure::Failure;
use epas_page::files::{self, Existing, Pending, refuse_same};
use epas_traces::mdf4::Mapping;
use epas_traces::source::Source;
pub use shown::columns;
use shown::{drawn, record, summary};

/// Options of a mechanism.
#[derive(Debug, clap::Args)]
pub struct MechanismArguments {
    /// Move what turns with the nut under the torque and the load of the trace (columns time, motor_torque, axial_load), with friction that
    /// remembers; known_torque or known_force, where there are any, act beside the motor in the direction of positive motion
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
    pub fn wanted(&self) -> bool {
        self.mechanism
    }
}

/// The nut at the time of a sample: where it is, what it feels, and what acts on it from then on.
struct Row {
    acting: Acting,
    angle: f64,
    speed: f64,
    torque: f64,
    /// Torque of the known effort, N m.
    known: f64,
    /// Friction at that time, N m.
    friction: f64,
    /// What the screw says of the tick that begins: torque of the load, flags.
    outputs: TickOutputs,
}

pub fn run(
    design: &Design,
    (arguments, reference_load): (&MechanismArguments, Option<f32>),
    [input, channels]: [Option<&Path>; 2],
    [output, plot]: [&Option<PathBuf>; 2],
    existing: Existing,
) -> Result<(), Failure> {
    let input = input.ok_or_else(|| Failure::Data("there is no trace".into()))?;
    let (source, mapping) = (Source(input), channels.map(Mapping::read).transpose()?);
    let calibrated = design.calibrated.as_ref();
    let follows = design.follows_temperature();
    let (name, acting, temperature) = match arguments.controller {
        Some(_) => moments::<true>(&source, mapping.as_ref(), follows)?,
        None => moments::<false>(&source, mapping.as_ref(), follows)?,
    };
    let mut design = design.clone();
    design.by_default_law = calibrated.is_none() && matches!(temperature, Temperature::Followed(_));
    let design = &design;
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
        memory: MemorySettings {
            reference_load,
            ..MemorySettings::default()
        },
        tick,
    };
    caged::check_errors(design, true)?;
    let (rows, mut lines) = moved(&course)?;
    if let Some(told) = temperature.told() {
        lines.add("temperature", told);
    }
    write_files([&name, &design.name], &rows, &outputs, existing)?;
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
    let beyond = caged::fold(design, true)?.map(|fold| Beyond::caged(design, &fold));
    summary(&rows, inertia, tick, beyond).print(&mut stdout)?;
    lines.print(&mut stdout)?;
    for path in outputs.iter().flatten() {
        writeln!(stdout, "wrote {}", path.display())?;
    }
    Ok(())
}

fn write_files(
    [trace, design]: [&str; 2],
    rows: &[Row],
    outputs: &[Option<PathBuf>; 2],
    existing: Existing,
) -> Result<(), Failure> {
    let known = shown::is_known(rows);
    let mut written = Vec::new();
    if let [Some(table), _] = outputs {
        let mut pending = Pending::new(table, existing)?;
        let group = format!("{trace} on {design}");
        write_table(
            pending.writer(),
            table,
            (&group, &columns(known)),
            rows.iter().map(|row| record(row, known)),
        )?;
        written.push(pending);
    }
    if let [_, Some(picture)] = outputs {
        let mut pending = Pending::new(picture, existing)?;
        let drawn = drawn(trace, design, rows, Form::of(picture))?;
        files::all(&mut pending, picture, &drawn)?;
        written.push(pending);
    }
    for pending in written {
        pending.finish()?;
    }
    Ok(())
}

fn moved(course: &Course<'_>) -> Result<(Vec<Row>, Lines), Failure> {
    let Course {
        design,
        acting,
        memory,
        tick,
        ..
    } = *course;
    let loads = acting.iter().map(|acting| acting.axial_load);
    let speed = memory::speed((tick / STEPS as f64) as f32)
        .map_err(|error| Failure::Data(format!("{}: {error}", design.name)))?;
    // The nut's own motion has no noise.
    let mut found = remembering(design, memory.load(loads.clone()), (speed, 0.0))?;
    let far = memory.far(design, loads, found.proportional_at)?;
    found.lines.add_some(memory::FAR, far);
    Ok((motion(found.model, course), found.lines))
}

struct Course<'a> {
    design: &'a Design,
    acting: &'a [Acting],
    temperature: &'a Temperature,
    inertia: f64,
    controller: Option<Controller>,
    memory: MemorySettings,
    tick: f64,
}

fn motion(model: Box<dyn Model>, course: &Course<'_>) -> Vec<Row> {
    let Course {
        design,
        acting,
        temperature,
        inertia,
        controller,
        tick,
        ..
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
    let lead = f64::from(design.screw().lead());
    let mut rows = Vec::with_capacity(acting.len());
    for (sample, acting) in acting.iter().enumerate() {
        // A nut that has not moved yet feels no friction.
        let before = mechanism.resistance.outputs;
        let friction = before.map_or(0.0, |outputs| outputs.friction.into());
        let (angle, speed) = (mechanism.position, mechanism.speed);
        let torque = controller.map_or(acting.command, |controller| {
            controller.effort(acting.command, angle, speed)
        });
        mechanism.resistance.axial_load = acting.axial_load;
        let now = mechanism.resistance.temperature;
        mechanism.resistance.temperature = temperature.at(sample).unwrap_or(now);
        let known = acting.known(lead);
        for _ in 0..STEPS {
            mechanism.advance(torque + known, time);
        }
        if let Some(outputs) = mechanism.resistance.outputs {
            rows.push(Row {
                acting: *acting,
                angle,
                speed,
                torque,
                known,
                friction,
                outputs,
            });
        }
    }
    rows
}

#[cfg(test)]
mod tests;
