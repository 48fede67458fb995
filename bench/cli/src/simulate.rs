//! `simulate`: the in-loop model over a trace of speed and load.

mod beyond;
#[doc(hidden)]
pub mod bindings;
pub(crate) mod caged;
mod caged_exact;
mod choice;
pub(crate) mod encoder;
mod exact_screw;
mod lawful;
pub(crate) mod linear;
mod loads;
mod manoeuvre;
mod measurement;
mod mechanism;
pub(crate) mod memory;
pub(crate) mod nut;
mod output;
mod picture;
mod progress;
mod reference;
pub(crate) mod remembering;
mod samples;
mod scene;
mod screw;
mod summary;
mod tick;
mod trace;
mod train;
pub(crate) mod uncaged;

use std::io::{self, Cursor, Write};
use std::path::PathBuf;

use clap::error::ErrorKind;

use choice::{Chosen, SceneName, choose};
use encoder::EncoderStep;
use epas_design::files::train::LinearDesign;
use epas_design::files::{self as designs, DesignSource};
use epas_page::failure::Failure;
use epas_page::files::{
    self, Existing, Pending, refuse_ending, refuse_same, refuse_shared, standard,
};
use epas_traces::mdf4::Mapping;
use epas_traces::source::Source;
pub use manoeuvre::Manoeuvre;
use memory::MemorySettings;
use output::{targets, write_table};
use picture::Form;
use progress::Progress;
use reference::ReferenceModel;
use samples::ScrewSample;
use scene::Scene;
use summary::Lines;
use trace::Temperature;

/// Runs the in-loop friction model over a trace.
///
/// The trace is a CSV file with the columns time (s), nut_speed (rad/s) and axial_load (N; positive where it opposes the travel
/// that a positive nut speed makes), in any order, a measurement file (MDF 4, .mf4) with channels of these names, or one of the
/// built-in manoeuvres.
///
/// For --scene linear the columns are time, speed (m/s), normal_load and side_load (N).
///
/// Other units stand in the column's name, nut_speed_rpm or Nut speed [rpm]; a measurement file says them itself. Channels of several
/// rasters are put on that of the speed: interpolated linearly, held for one tick of their own at the ends. Scenes with a train need a trace
/// of equal steps of time.
///
/// Loads of a manoeuvre are those of a rack: of a screw that bears less they are scaled down, so that the largest is the least of axial_load in
/// [limits], the static limit of its balls (4.2 GPa), and the largest load that its block holds. The summary says so.
///
/// Written are a CSV file with the model's outputs at every sample and an SVG plot; a trace that is refused leaves neither. The summary says
/// which settings are defaults.
///
/// A design file is TOML, in m and rad. `design --new gear.toml` writes one that says of every key its unit, its range and where it stands
/// on a drawing; the folder bench/designs has more.
///
/// Geometry: pitch_radius or nominal_diameter, lead, ball_radius or ball_diameter, conformity or groove_radius (for both grooves, or each in a
/// table [screw_groove], [nut_groove]), contact_angle; and if wanted name, youngs_modulus, poisson_ratio, density (for both bodies, or each in a
/// table [ball_material], [groove_material]; steel without).
///
/// Friction: friction (0.1 without), friction_law ("default" without, or "constant"), hysteresis_loss (0.01 without), lubricant_drag (N a contact
/// under 100 N; 0 without), reversal_speed (2 rad/s without).
///
/// branch ("contacts", or a paper's closed form: "rolling" has 0.02 to 1.1 times the exact torque, "sliding" 0.6 to 14 times), rolling_tangent
/// (closed forms).
///
/// Fit of the balls, one of: clearance (radial gap of every contact, m; play above 0, oversize below), axial_play (of the nut, m), preload (force
/// of one contact without a load, N), axial_preload (of the nut, N). Without, 1 um of oversize (clearance = -1e-6). loaded_balls is
/// needed with an oversize that is given; without, those of 2.5 turns.
///
/// Table [limits]: nut_speed (2000 rad/s without), axial_load (100000 N), friction_torque (100 N m).
///
/// The centrifugal force of the balls is
/// left out at every speed: m (0.55 nut_speed)^2 pitch_radius, for a ball of 5.6 mm at 16.5 mm 0.3 N at 300 rad/s and 14 N at 2000.
///
/// Table [uncaged], for --scene uncaged: balls (1 to 64), turns, and if wanted ball_friction (0.1 without), return_length (0 without),
/// screw_deviation and nut_deviation (lists of { order, cosine, sine }, over deviation_turns turns), load_shares (a list along the loaded
/// track) and negative_load_shares (as long a list, for loads below zero; load_shares serves both signs without it).
///
/// A measured deviation is the name of a chart beside the design file in the place of that list, such as "screw.csv" (columns angle or
/// angle_deg, deviation or deviation_deg), or a list of deviations at equal distances, rad.
///
/// Table [fold] (`design --help` names its keys): the loads of a ball for which a screw is solved before it runs, 5 to 300 N without, above
/// which outputs are flagged. A screw with a cage is solved within two seconds: what runs is the block that `design` writes for it, and what
/// `design` refuses is refused.
///
/// A screw without cage is solved in some seconds, for the deviations of its maps or those of [fold]; where [fold] gives no loads, for as
/// many as the trace needs. Where [calibration] makes the friction coefficient change, the block is one for its range, or the range is
/// refused with the reason.
///
/// Table [calibration], what `calibrate` writes: for --scene caged with --memory full_film_ratio and half_share_speed (rad/s) with
/// reference_temperature and viscosity_pole (K), direction_asymmetry, breakaway_angle (rad) at reference_load (N), elements ("proportional", or
/// with largest_load, N, "load_exact" or "preloaded"), backlash (rad), churning.
///
/// A column temperature (K; temperature_C in degrees Celsius) of the trace is followed by the scene caged and by --mechanism: by the law of
/// [calibration]; without that table by the default law.
///
/// The default law has the coefficient at standstill, 0.42 of it on a film, and the lubricant's drag. Beside --reference a temperature is not
/// followed, nor with friction_law = "constant".
///
/// Its rolling_drag is the drag of the lubricant over that of the default grease (1 for that; none without).
///
/// For --mechanism that table has inertia, drag, offset, gain. Its trace has time, motor_torque (or with --controller reference_position) and
/// axial_load, and where there are any known_torque (N m) or known_force (N, on what travels): an effort beside the motor's, in the
/// direction of positive motion, as in `calibrate`. harmonics (a list of { order, cosine, sine }) stand there too.
///
/// A linear bearing's file has ball_radius or ball_diameter, conformity or groove_radius, contact_angle, balls, loaded_length, and if wanted
/// return_length, wavelength, rail_deviation, carriage_deviation, load_shares, friction and ball_friction (0.1 without), materials as above,
/// reversal_speed (0.001 m/s without), and a table [limits] with speed, load, friction_force.
///
/// With --loads no friction is computed: the static model of the float64 reference finds the share of each ball in the axial load, for
/// load_shares. Shares change with the size of the load, because contacts get stiffer, and with its sign, because the other flank
/// carries.
///
/// So the program says which loads a table serves: those where friction of the grooves is within 1 % of that with the load's own
/// table, and each ball's load within 5 % of the largest one.
///
/// Loads of 5 to 300 N a ball of both signs are tried in steps of a tenth; with --input or --manoeuvre, those from 5 N a ball to
/// the largest load of the trace.
///
/// One table is written where it serves all loads of the trace, else one for each sign. Where that does not serve either, the program
/// says so, by how much it errs, and how many tables it would take.
///
/// Table [loads], for --loads, beside loaded_balls: screw_length, screw_diameter (outer), nut_position (axial centre of the balls), axial_load (on
/// the end that moves only along the axis; the other end is free and the nut rigid; positive towards the right), turns (of the loaded balls)
/// or ball_spacing.
///
/// If wanted it has loaded_end ("left", where the loaded track starts, or "right"; left without), ball_oversize (of the radius; a number, or a
/// list with one for each ball), end_offset (x displacement forced on the other end), pitch_error and roundness_error (amplitudes of the
/// screw's groove, once and twice a turn).
// Each is a flag of the command line.
#[allow(clippy::struct_excessive_bools)]
#[derive(Debug, clap::Args)]
#[command(after_long_help = epas_traces::flags::table())]
pub struct Arguments {
    /// Print the names of the built-in designs
    #[arg(long, exclusive = true)]
    list: bool,
    /// What is simulated [default: what the design or the manoeuvre is made for, or caged]
    #[arg(long, value_enum)]
    scene: Option<SceneName>,
    /// Built-in design, or design file ending in .toml [default for a manoeuvre: lin-4.1 caged, lin-3.6
    /// uncaged, lin-3.3 linear]
    #[arg(long, value_name = "NAME|FILE.toml")]
    design: Option<DesignSource>,
    /// Trace with the columns or channels time, nut_speed, axial_load (linear: time, speed, normal_load, side_load), and if wanted
    /// temperature (K), and of a screw nut_position (rad), which a memory of the scene caged follows in place of the sum of the speeds; - for standard
    /// input
    #[arg(long, value_name = "TRACE.csv|TRACE.mf4", conflicts_with = "manoeuvre")]
    input: Option<PathBuf>,
    /// Which channel of a measurement file is which column, in TOML: nut_speed = "NAME", or with group, source and unit
    /// nut_speed = { channel = "NAME", group = "GROUP", source = "SOURCE", unit = "rpm" }; - for standard input
    // What requires an argument is not heard where that argument conflicts with another: so each conflict is said again.
    #[arg(
        long,
        value_name = "MAPPING.toml",
        requires = "input",
        conflicts_with_all = ["manoeuvre", "axial_load"]
    )]
    channels: Option<PathBuf>,
    /// Built-in trace of rack force and rack travel
    #[arg(long, value_parser = manoeuvre::names())]
    manoeuvre: Option<Manoeuvre>,
    #[command(flatten)]
    loads: loads::LoadArguments,
    /// Where the outputs go: a table, or a measurement file where it ends in .mf4; - for standard output [default, with the plot:
    /// target/simulate/TRACE-DESIGN.csv; with --loads: stdout]
    #[arg(long, value_name = "OUT.csv|OUT.mf4")]
    output: Option<PathBuf>,
    /// Where the plot goes: a picture, or a page in which to look closer
    #[arg(long, value_name = "OUT.svg|OUT.html")]
    plot: Option<PathBuf>,
    /// Compute the float64 reference beside the model. Caged: one ball in elastic balance, exactly, or a closed
    /// form: the design's, or of a rolling ball. Uncaged: all balls, exactly without a name
    #[arg(
        long,
        value_enum,
        value_name = "MODEL",
        num_args = 0..=1,
        require_equals = true,
        default_missing_value = "exact"
    )]
    reference: Option<ReferenceModel>,
    /// Friction that remembers: it passes through a reversal with the angle, by elements of the design at the trace's mean
    /// load, in place of the reversal speed [default for a manoeuvre with reversals without --reference]
    #[arg(long)]
    memory: bool,
    /// Friction that passes through a reversal with the speed, also in a manoeuvre: too low below some reversal speeds
    #[arg(long, conflicts_with = "memory")]
    no_memory: bool,
    /// Step of the encoder, rad of the nut (m of a carriage): friction that remembers follows the motion behind a dead band of it, so that
    /// flicker at rest moves nothing, and feels a reversal that much later; 0 for none [default: that of the flicker of
    /// the trace's nut_position or speed]
    #[arg(long, value_name = "RAD", value_parser = encoder::step, conflicts_with_all = ["mechanism", "loads", "no_memory"])]
    encoder_step: Option<f64>,
    /// Load at which the elements of friction that remembers are exact, N (normal load of a bearing), in place of the trace's mean: the loads about
    /// which reversals count, so that a part of the trace has the friction of the whole
    #[arg(long, value_name = "N", value_parser = memory::reference_load, conflicts_with_all = ["loads", "no_memory"])]
    reference_load: Option<f32>,
    /// Time between two steps of the model, s, as of firmware at that rate, whatever the trace's is: between its samples the trace is
    /// interpolated linearly
    #[arg(long, value_name = "SECONDS", value_parser = tick::tick, conflicts_with_all = ["mechanism", "loads"])]
    tick: Option<f64>,
    #[command(flatten)]
    mechanism: mechanism::MechanismArguments,
    /// Replace files that exist
    #[arg(long)]
    force: bool,
}

const WAYS: &str = "  simulate --manoeuvre parking                      a built-in trace: parking, weave, kerb, turns, stroke; --design as you like
  simulate --design NAME --input TRACE.csv          your trace: columns time, nut_speed, axial_load; or a measurement file .mf4
  simulate --design NAME --mechanism --input TRACE  the nut moves under motor_torque and axial_load
  simulate --design FILE.toml --loads               how balls share the load
  simulate --list                                   every built-in design
NAME is a built-in design, FILE.toml a design file: `design --new FILE.toml` writes one to start from.
";

impl Arguments {
    /// Ends the program, with exit code 2, where it is not said what is simulated.
    fn complete(&self) {
        let trace = self.input.is_some() || self.manoeuvre.is_some() || self.loads.wanted();
        let missing = match (trace, self.design.is_some() || self.manoeuvre.is_some()) {
            (true, true) => return,
            (false, _) => "a trace is missing: --input or --manoeuvre",
            (true, false) => "the design is missing: --design",
        };
        let message = format!("{missing}\n\n{WAYS}");
        clap::Error::raw(ErrorKind::MissingRequiredArgument, message).exit();
    }
}

/// Runs the simulation, or lists the designs.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    if arguments.list {
        return list();
    }
    arguments.complete();
    let inputs = [
        arguments.design.as_ref().and_then(DesignSource::file),
        arguments.input.as_deref(),
        arguments.channels.as_deref(),
    ];
    refuse_shared(inputs)?;
    refuse_same(inputs, arguments.output.iter().chain(&arguments.plot))?;
    let existing = Existing::forced(arguments.force);
    if let (true, Some(source)) = (arguments.loads.wanted(), &arguments.design) {
        // Standard output is where a load table goes by itself.
        let output = arguments.output.as_deref().filter(|path| !standard(path));
        refuse_ending("a load table", output, &["toml", "rs"])?;
        let loads = loads::Source {
            input: arguments.input.as_ref(),
            channels: arguments.channels.as_deref(),
            manoeuvre: arguments.manoeuvre,
        };
        return loads::run(&source.load()?, &arguments.loads, loads, output, existing);
    }
    refuse_ending("a table", arguments.output.as_deref(), &["csv", "mf4"])?;
    refuse_ending("a plot", arguments.plot.as_deref(), &["svg", "html"])?;
    if let (true, Some(source), Some(input)) = (
        arguments.mechanism.wanted(),
        &arguments.design,
        &arguments.input,
    ) {
        if let Some(SceneName::Uncaged | SceneName::Linear) = arguments.scene {
            let conflict = "--mechanism moves the nut of a ball screw whose balls do not touch: with it --scene is caged\n";
            clap::Error::raw(ErrorKind::ArgumentConflict, conflict).exit();
        }
        return mechanism::run(
            &source.load()?,
            (&arguments.mechanism, arguments.reference_load),
            [Some(input), arguments.channels.as_deref()],
            [&arguments.output, &arguments.plot],
            existing,
        );
    }
    match choose(
        arguments.scene,
        arguments.design.as_ref(),
        arguments.manoeuvre,
        remembers(arguments),
    )? {
        Chosen::Caged(scene) => simulate(*scene, arguments, existing),
        Chosen::Uncaged(scene) => simulate(*scene, arguments, existing),
        Chosen::Linear(scene) => simulate(*scene, arguments, existing),
    }
}

/// Whether friction remembers: where that is asked for, and in a manoeuvre with reversals, but for a comparison with the reference, which
/// has no memory.
fn remembers(arguments: &Arguments) -> bool {
    let reverses = arguments.manoeuvre.is_some_and(Manoeuvre::reverses);
    arguments.memory || reverses && !arguments.no_memory && arguments.reference.is_none()
}

fn simulate<S: Scene>(
    mut scene: S,
    arguments: &Arguments,
    existing: Existing,
) -> Result<(), Failure> {
    let mut scaled = None;
    let (trace, temperature) = match (&arguments.input, arguments.manoeuvre) {
        (Some(path), _) => {
            let channels = arguments.channels.as_deref();
            let mapping = channels.map(Mapping::read).transpose()?;
            let followed = scene.follows_temperature(arguments.reference.is_some());
            let (trace, temperature) = trace::read(&Source(path), mapping.as_ref(), followed)?;
            if let Temperature::Followed(_) = temperature {
                scene.follow_temperature();
            }
            (trace, temperature)
        }
        (None, Some(manoeuvre)) => {
            let (trace, words) = scene.within(scene.manoeuvre(manoeuvre)?);
            scaled = words;
            (trace, Temperature::None)
        }
        (None, None) => return Err(Failure::Data("there is no trace".into())),
    };

    // Between samples a trace has no steps.
    scene.set_memory(MemorySettings {
        encoder: EncoderStep::of(arguments.encoder_step, &trace),
        reference_load: arguments.reference_load,
    });
    let (trace, temperature) = match arguments.tick {
        Some(tick) => tick::resampled(&trace, &temperature, tick)?,
        None => (trace, temperature),
    };

    let asked = [&arguments.output, &arguments.plot];
    let [output, plot] = targets(asked, &trace.name, scene.name());
    for path in output.iter().chain(&plot) {
        existing.check(path)?;
    }
    let design = arguments.design.as_ref().and_then(DesignSource::file);
    refuse_same(
        [
            arguments.input.as_deref(),
            arguments.channels.as_deref(),
            design,
        ],
        output.iter().chain(&plot),
    )?;

    scene.check_errors()?;
    // Every sample is computed once and written once.
    let steps = trace.samples.len() * (1 + usize::from(output.is_some()));
    let progress = Progress::new(steps);
    let done = || progress.step();
    let (rows, reference) = scene.rows(&trace, &temperature, arguments.reference, &done)?;
    let table = output
        .as_deref()
        .map(|path| {
            let mut pending = Pending::new(path, existing)?;
            let columns = scene::columns::<S>(arguments.reference.is_some());
            let outputs = S::outputs();
            let records = rows.iter().map(|row| {
                progress.step();
                scene::record(&outputs, row)
            });
            let group = format!("{} on {}", trace.name, scene.name());
            write_table(pending.writer(), path, (&group, &columns), records)?;
            Ok::<_, Failure>(pending)
        })
        .transpose()?;
    drop(progress);
    // Nothing takes its place before everything is complete.
    let picture = plot
        .as_deref()
        .map(|path| {
            let svg = scene.picture(&trace, &rows, Form::of(path))?;
            let mut pending = Pending::new(path, existing)?;
            files::all(&mut pending, path, &svg)?;
            Ok::<_, Failure>(pending)
        })
        .transpose()?;
    for pending in [table, picture].into_iter().flatten() {
        pending.finish()?;
    }

    let mut stdout = files::told(output.iter().chain(&plot));
    let mut summary = scene.summary(&trace, &rows);
    if let Some(words) = scaled {
        summary.add("manoeuvre", words);
    }
    if let Some(tick) = arguments.tick {
        summary.add("tick", format!("{tick} s, of --tick"));
    }
    if let Some(model) = arguments.reference {
        let from = format!("; f64 is {}", scene.reference_name(model));
        summary.amend(screw::DIFFERENCE, &from);
    }
    summary.print(&mut stdout)?;
    reference.print(&mut stdout)?;
    if let Some(told) = temperature.told() {
        let mut lines = Lines::default();
        lines.add("temperature", told);
        lines.print(&mut stdout)?;
    }
    for path in output.iter().chain(&plot) {
        writeln!(stdout, "wrote {}", path.display())?;
    }
    Ok(())
}

/// Reads a trace; its number of samples.
pub fn accepts(text: &[u8]) -> Result<usize, String> {
    trace::samples::<ScrewSample>(Cursor::new(text)).map(|samples| samples.len())
}

/// Reads a measurement file; its number of samples.
pub fn accepts_measurement(bytes: &[u8]) -> Result<usize, String> {
    trace::measured::<ScrewSample>(bytes, None).map(|samples| samples.len())
}

fn list() -> Result<(), Failure> {
    let mut stdout = io::stdout().lock();
    for (name, parameters, loaded_balls) in designs::built_in() {
        let design = name
            .parse::<DesignSource>()
            .map_err(Failure::Data)?
            .load()?;
        write!(
            stdout,
            "{name:14} pitch radius {:8.3} mm, lead {:5.1} mm, ball radius {:6.4} mm, friction {:5.3}, clearance {:4.1} um",
            1e3 * parameters.pitch_radius,
            1e3 * parameters.lead,
            1e3 * parameters.ball_radius,
            design.caged.friction,
            1e6 * design.caged.clearance.gap(),
        )?;
        if let Some(balls) = loaded_balls {
            write!(stdout, ", {balls} loaded balls")?;
        }
        if let Some(balls) = &design.uncaged {
            let [screw, nut] = balls.deviations().map(|angle| 1e3 * angle);
            write!(
                stdout,
                "; uncaged also: friction between balls {}, contact angle off by {screw:.1} mrad on the screw, {nut:.1} mrad in the nut",
                balls.ball_friction,
            )?;
        }
        writeln!(stdout)?;
    }
    let LinearDesign {
        name,
        balls,
        configuration,
        ..
    } = LinearDesign::built_in()?;
    writeln!(
        stdout,
        "{name:14} linear bearing, ball radius {:6.4} mm, {balls} balls",
        1e3 * configuration.bearing.ball_radius(),
    )?;
    writeln!(stdout, "{}", designs::SOURCES)?;
    Ok(())
}
