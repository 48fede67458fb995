//! `simulate`: the in-loop model over a trace of speed and load.

mod loads;
mod manoeuvre;
mod picture;
mod reference;
mod subject;
mod summary;
mod trace;
mod train;
mod train_picture;

use std::cell::Cell;
use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use epas_friction::{Outputs, Regime};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use crate::designs::train::LinearDesign;
use crate::designs::{self, DesignSource};
use crate::failure::Failure;
use crate::files::{self, Existing, Pending};
pub use manoeuvre::Manoeuvre;
use reference::Reference;
use subject::{Scene, Subject};
use summary::Summary;
use trace::{Sample, Trace};
use train::TrainRow;

/// Runs the in-loop friction model over a trace.
///
/// The trace is a CSV file with the columns time (s), nut_speed (rad/s) and axial_load (N; positive
/// where it opposes the travel that a positive nut speed makes), in any order, or one of the built-in
/// manoeuvres. Written are a CSV file with the model's outputs at every sample and an SVG plot; a trace
/// that is refused leaves neither.
///
/// A design file in TOML holds, in m and rad: pitch_radius or nominal_diameter, lead, ball_radius or
/// ball_diameter, conformity or groove_radius (for both grooves, or each in a table [screw_groove],
/// [nut_groove]), contact_angle; and if wanted name, youngs_modulus, poisson_ratio, density (for both
/// bodies, or each in a table [ball_material], [groove_material]; steel without), friction,
/// rolling_tangent, branch ("rolling" or "sliding"), preload, reversal_speed, loaded_balls, a table
/// [limits] with nut_speed, axial_load, friction_torque; and for --scene uncaged a table [uncaged] with
/// balls (1 to 64), turns, and if wanted ball_friction, fit ("zero", "play" or { preload = N }),
/// return_length, screw_deviation and nut_deviation (lists of { order, cosine, sine }, over
/// deviation_turns turns) and load_shares (a list along the loaded track).
///
/// For --scene linear a trace has the columns time, speed (m/s), normal_load and side_load (N), and a
/// design file ball_radius or ball_diameter, conformity or groove_radius, contact_angle, balls,
/// loaded_length, and if wanted return_length, wavelength, rail_deviation, carriage_deviation,
/// load_shares, friction, ball_friction, materials as above, reversal_speed, and a table [limits] with
/// speed, load, friction_force. Scenes with a train need a trace of equal steps of time.
///
/// With --loads no trace is run: the static model of the float64 reference finds the share of each ball in
/// the axial load, for load_shares. A design file says in a table [loads] what it needs beside loaded_balls:
/// screw_length, screw_diameter (outer), nut_position (axial centre of the balls), axial_load (on the left
/// end, which moves only along the axis; the right end is free and the nut rigid), turns (of the loaded
/// balls) or ball_spacing; and if wanted ball_oversize (of the radius; a number, or a list with one for each
/// ball), end_offset (x displacement forced on the right end), pitch_error and roundness_error (amplitudes
/// of the screw's groove, once and twice a turn).
// Each is a flag of the command line.
#[allow(clippy::struct_excessive_bools)]
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// Print the names of the built-in designs
    #[arg(long, exclusive = true)]
    list: bool,
    /// What is simulated [default: what the design or the manoeuvre is made for, or caged]
    #[arg(long, value_enum)]
    scene: Option<Scene>,
    /// Built-in design, or design file ending in .toml [default for a manoeuvre: lin-4.1 caged, lin-3.6
    /// uncaged, lin-3.3 linear]
    #[arg(long, value_name = "NAME|FILE.toml", required_unless_present_any = ["list", "manoeuvre"])]
    design: Option<DesignSource>,
    /// Trace with the columns time, nut_speed, axial_load (linear: time, speed, normal_load, side_load)
    #[arg(
        long,
        value_name = "TRACE.csv",
        required_unless_present_any = ["list", "manoeuvre", "loads"],
        conflicts_with = "manoeuvre"
    )]
    input: Option<PathBuf>,
    /// Built-in trace of rack force and rack travel
    #[arg(long, value_enum)]
    manoeuvre: Option<Manoeuvre>,
    #[command(flatten)]
    loads: loads::LoadArguments,
    /// Where the outputs go [default, with the plot: target/simulate/TRACE-DESIGN.csv; with --loads: stdout]
    #[arg(long, value_name = "OUT.csv")]
    output: Option<PathBuf>,
    /// Where the plot goes
    #[arg(long, value_name = "OUT.svg")]
    plot: Option<PathBuf>,
    /// Compute the float64 reference beside the model
    #[arg(long)]
    reference: bool,
    /// Replace files that exist
    #[arg(long)]
    force: bool,
}

/// One sample with what the models say to it.
#[derive(Clone, Copy, Debug)]
pub struct Row {
    sample: Sample,
    outputs: Outputs,
    reference: Option<reference::Friction>,
    train: Option<TrainRow>,
}

/// Runs the simulation, or lists the designs.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    if arguments.list {
        return list();
    }
    let existing = if arguments.force {
        Existing::Replace
    } else {
        Existing::Keep
    };
    if let (true, Some(source)) = (arguments.loads.wanted(), &arguments.design) {
        let output = arguments.output.as_deref();
        refuse_same([source.file()], arguments.output.iter())?;
        return loads::run(&source.load()?, &arguments.loads, output, existing);
    }
    let subject = Subject::new(
        arguments.scene,
        arguments.design.as_ref(),
        arguments.manoeuvre,
    )?;
    let trace = match (&arguments.input, arguments.manoeuvre) {
        (Some(path), _) => trace::read(path, subject.columns())?,
        (None, Some(manoeuvre)) => subject.trace(manoeuvre)?,
        (None, None) => return Err(Failure::Data("there is no trace".into())),
    };

    let (output, plot) = targets(arguments, &trace, subject.name());
    for path in output.iter().chain(&plot) {
        existing.check(path)?;
    }
    let design = arguments.design.as_ref().and_then(DesignSource::file);
    refuse_same(
        [arguments.input.as_deref(), design],
        output.iter().chain(&plot),
    )?;

    // Every sample is computed once and written once.
    let steps = trace.samples.len() * (1 + usize::from(output.is_some()));
    let progress = Progress::new(steps);
    let (rows, summary) = simulate(&subject, &trace, arguments.reference, &progress)?;
    let table = output
        .as_deref()
        .map(|path| write_rows(path, subject.columns(), &rows, existing, &progress))
        .transpose()?;
    progress.clear();
    // Nothing takes its place before everything is complete.
    let picture = plot
        .as_deref()
        .map(|path| -> Result<_, Failure> {
            let svg = match subject {
                Subject::Caged(_) => picture::draw(&trace, subject.name(), &rows)?,
                _ => train_picture::draw(&trace, &subject, &rows)?,
            };
            let mut pending = Pending::new(path, existing)?;
            files::all(&mut pending, path, &svg)?;
            Ok(pending)
        })
        .transpose()?;
    for pending in [table, picture].into_iter().flatten() {
        pending.finish()?;
    }

    let mut stdout = io::stdout().lock();
    summary.print(&mut stdout, &trace, &subject)?;
    for path in output.iter().chain(&plot) {
        writeln!(stdout, "wrote {}", path.display())?;
    }
    Ok(())
}

/// Reads a trace; its number of samples.
pub fn accepts(text: &[u8]) -> Result<usize, String> {
    trace::samples(std::io::Cursor::new(text), trace::SCREW).map(|samples| samples.len())
}

fn list() -> Result<(), Failure> {
    let mut stdout = io::stdout().lock();
    for (name, parameters, loaded_balls) in designs::built_in() {
        write!(
            stdout,
            "{name:14} pitch radius {:8.3} mm, lead {:5.1} mm, ball radius {:6.4} mm",
            1e3 * parameters.pitch_radius,
            1e3 * parameters.lead,
            1e3 * parameters.ball_radius,
        )?;
        match loaded_balls {
            Some(balls) => writeln!(stdout, ", {balls} loaded balls")?,
            None => writeln!(stdout)?,
        }
    }
    let LinearDesign {
        name,
        balls,
        configuration,
    } = LinearDesign::built_in()?;
    writeln!(
        stdout,
        "{name:14} linear bearing, ball radius {:6.4} mm, {balls} balls",
        1e3 * configuration.bearing.ball_radius(),
    )?;
    Ok(())
}

/// Files asked for; both under their default names where none is named.
fn targets(
    arguments: &Arguments,
    trace: &Trace,
    design: &str,
) -> (Option<PathBuf>, Option<PathBuf>) {
    if arguments.output.is_some() || arguments.plot.is_some() {
        return (arguments.output.clone(), arguments.plot.clone());
    }
    // A design's name comes from a file and may hold anything.
    let stem: String = format!("{}-{design}", trace.name)
        .chars()
        .map(|letter| {
            if letter.is_alphanumeric() || "-_.".contains(letter) {
                letter
            } else {
                '_'
            }
        })
        .collect();
    let folder = Path::new("target").join("simulate");
    (
        Some(folder.join(format!("{stem}.csv"))),
        Some(folder.join(format!("{stem}.svg"))),
    )
}

/// Trace and design are never overwritten, nor one output by the other.
fn refuse_same<'a, const N: usize>(
    inputs: [Option<&Path>; N],
    outputs: impl Iterator<Item = &'a PathBuf>,
) -> Result<(), Failure> {
    let mut taken: Vec<PathBuf> = inputs.into_iter().flatten().map(place).collect();
    for output in outputs {
        let place = place(output);
        if taken.contains(&place) {
            return Err(Failure::Data(format!(
                "{} is named twice",
                output.display()
            )));
        }
        taken.push(place);
    }
    Ok(())
}

/// Where a file is or will be, under one name however it is spelled.
fn place(path: &Path) -> PathBuf {
    fs::canonicalize(path).unwrap_or_else(|_| {
        let absolute = std::path::absolute(path).unwrap_or_else(|_| path.into());
        match (absolute.parent().map(fs::canonicalize), path.file_name()) {
            (Some(Ok(folder)), Some(name)) => folder.join(name),
            _ => absolute,
        }
    })
}

fn simulate(
    subject: &Subject,
    trace: &Trace,
    with_reference: bool,
    progress: &Progress,
) -> Result<(Vec<Row>, Summary), Failure> {
    let mut model = subject.model(trace)?;
    let reference = with_reference
        .then(|| Reference::new(subject, trace))
        .transpose()?;

    let mut summary = Summary::new(subject);
    let mut rows = Vec::with_capacity(trace.samples.len());
    for (index, &sample) in trace.samples.iter().enumerate() {
        let (outputs, train) = model.step(&sample);
        let row = Row {
            sample,
            outputs,
            reference: reference
                .as_ref()
                .and_then(|reference| reference.friction(index, &sample)),
            train,
        };
        summary.add(&row);
        rows.push(row);
        progress.step();
    }
    Ok((rows, summary))
}

/// A progress bar that appears only when the work takes longer than a second.
struct Progress {
    bar: ProgressBar,
    start: Instant,
    done: Cell<u64>,
}

impl Progress {
    fn new(length: usize) -> Self {
        let bar = ProgressBar::with_draw_target(Some(length as u64), ProgressDrawTarget::hidden());
        if let Ok(style) = ProgressStyle::with_template("{bar:40} {percent} % {eta} left") {
            bar.set_style(style);
        }
        Self {
            bar,
            start: Instant::now(),
            done: Cell::new(0),
        }
    }

    fn step(&self) {
        const STRIDE: u64 = 1 << 14;
        let done = self.done.get() + 1;
        self.done.set(done);
        if !done.is_multiple_of(STRIDE) {
            return;
        }
        if self.bar.is_hidden() && self.start.elapsed() > Duration::from_secs(1) {
            self.bar.set_draw_target(ProgressDrawTarget::stderr());
        }
        self.bar.set_position(done);
    }

    fn clear(&self) {
        self.bar.finish_and_clear();
    }
}

fn write_rows(
    path: &Path,
    inputs: &[&str],
    rows: &[Row],
    existing: Existing,
    progress: &Progress,
) -> Result<Pending, Failure> {
    let mut pending = Pending::new(path, existing)?;
    write_table(pending.writer(), inputs, rows, progress)
        .map_err(|error| Failure::file("write", path, &error))?;
    Ok(pending)
}

fn write_table(
    writer: &mut impl Write,
    inputs: &[&str],
    rows: &[Row],
    progress: &Progress,
) -> Result<(), csv::Error> {
    let mut table = csv::Writer::from_writer(writer);
    let linear = inputs.len() > trace::SCREW.len();
    let mut columns = inputs.to_vec();
    if linear {
        columns.push("friction_force");
    } else {
        columns.extend(["friction_torque", "load_torque", "efficiency"]);
    }
    columns.extend(["regime", "faults"]);
    if rows.first().is_some_and(|row| row.train.is_some()) {
        columns.extend([
            if linear { "travel" } else { "nut_angle" },
            "groove_friction",
            "ball_friction",
            "contacts",
            "largest_contact_force",
        ]);
    }
    if rows.first().is_some_and(|row| row.reference.is_some()) {
        columns.extend(["reference_friction_torque", "reference_efficiency"]);
    }
    table.write_record(&columns)?;
    for Row {
        sample,
        outputs,
        reference,
        train,
    } in rows
    {
        let mut record = vec![
            sample.time.to_string(),
            sample.nut_speed.to_string(),
            sample.axial_load.to_string(),
        ];
        if linear {
            record.push(sample.side_load.to_string());
        }
        record.push(outputs.friction_torque.to_string());
        if !linear {
            record.push(outputs.load_torque.to_string());
            record.push(outputs.efficiency.to_string());
        }
        record.push(regime_name(outputs.regime).into());
        record.push(outputs.faults.bits().to_string());
        if let Some(TrainRow { outputs, way, .. }) = train {
            record.push(way.to_string());
            record.push(outputs.groove.to_string());
            record.push(outputs.ball.to_string());
            record.push(outputs.contacts.to_string());
            record.push(outputs.largest_contact_force.to_string());
        }
        if let Some(reference) = reference {
            record.push(reference.friction_torque.to_string());
            record.push(reference.efficiency.to_string());
        }
        table.write_record(&record)?;
        progress.step();
    }
    table.flush()?;
    Ok(())
}

fn regime_name(regime: Regime) -> &'static str {
    match regime {
        Regime::Standing => "standing",
        Regime::Driving => "driving",
        Regime::BackDriving => "back-driving",
        Regime::Locked => "locked",
    }
}
