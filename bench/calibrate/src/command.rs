//! `calibrate`: arguments, and which room does the work.

use std::path::{Path, PathBuf};

use clap::error::ErrorKind;

use crate::answer::Calibration;
use crate::controller::Controller;
use crate::experiment;
use crate::folder::answered::Answered;
use crate::folder::{self, Folder, FolderArguments};
use crate::outputs::{Known, Outcome, OutputArguments, folder_name, print_json};
use crate::page::{self, truth};
use crate::screw::choice::Wanted;
use crate::screw::quantities::names;
use crate::screw::{self, Request};
use crate::steady;
use crate::trace::columns::{self, Frame};
use crate::trace::{Coordinate, Trace};
use crate::without_design;
use crate::without_design::controller::SeenController;
use epas_design::files::{Design, DesignSource, text};
use epas_page::aside::say;
use epas_page::document::print_line;
use epas_page::failure::Failure;
use epas_page::files::refuse_shared;
use epas_traces::mdf4::{self, Mapping};
use epas_traces::source::Source;

/// Fits a model to a measured trace, and says how sure it is and what the trace cannot tell.
///
/// The trace is a CSV file, or a measurement file (MDF 4, .mf4), with the columns or channels time; position or speed (of the
/// nut, or of motor_ or carriage_); motor_torque or motor_force; and where there are any reference_position, axial_load or
/// load_torque, temperature, and known_torque or known_force (an effort that is known and that the controller did not command).
///
/// Units are SI (rad, m, N, N m, K); others stand in the column's name: nut_position_deg, motor_speed_rpm, axial_load_kN,
/// temperature_C, or in brackets behind it: Nut position [deg]. A measurement file says the units itself; --channels names its
/// channels where they have other names.
///
/// All channels are put on the raster of the position, or of the speed where there is none.
///
/// With a design the model is the one that firmware runs: friction coefficient by speed and temperature, preload, pre-sliding. Each
/// parameter is estimated where the trace can tell it.
///
/// Without a design a mass or an inertia with Coulomb and viscous friction is fitted, in the trace's own coordinate, with losses in
/// proportion to the load for driving and back-driving where one is measured.
///
/// Models of friction are compared on what was not fitted: another trace (--validate), or the last third of this one; with a design that is
/// every third twelfth. With --controller they are compared by the simulated closed loop.
///
/// Of a folder every trace (*.csv, *.mf4) is fitted, and their parameters together; a run that was stopped goes on where it was.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// Measured trace, or a folder of them; - for standard input
    #[arg(
        value_name = "TRACE.csv|TRACE.mf4|FOLDER",
        required_unless_present_any = ["wanted", "merge"]
    )]
    trace: Option<PathBuf>,
    /// Built-in design, or design file ending in .toml
    #[arg(long, value_name = "NAME|FILE.toml")]
    design: Option<DesignSource>,
    /// Turns of the motor in a turn of the nut [default with a design: 1]
    #[arg(long, value_name = "RATIO", value_parser = ratio)]
    ratio: Option<f64>,
    /// Rated torque of the motor, N m, where the trace has its torque in percent of it
    #[arg(long, value_name = "TORQUE", value_parser = rated_torque)]
    rated_torque: Option<f64>,
    /// With --design: parameters of the screw to estimate, by the names of the answer [default: what the trace can tell]
    #[arg(long, value_name = "NAME,...", value_delimiter = ',')]
    estimate: Option<Vec<String>>,
    /// With --design: parameters of the screw to set instead, as friction=0.1; without one all that the trace tells is estimated
    #[arg(long, value_name = "NAME=VALUE,...", value_delimiter = ',', value_parser = setting)]
    fix: Vec<(String, f64)>,
    /// Tell which manoeuvre would tell this parameter best, without a trace
    #[arg(
        long,
        value_name = "NAME",
        requires = "design",
        conflicts_with = "trace",
        value_parser = parameter
    )]
    wanted: Option<String>,
    /// Trace that is not fitted, by which models are scored
    #[arg(long, value_name = "OTHER.csv|OTHER.mf4")]
    validate: Option<PathBuf>,
    /// Which channel of a measurement file is which column, in TOML: nut_speed = "NAME", or with group, source and unit
    /// nut_speed = { channel = "NAME", group = "GROUP", source = "SOURCE", unit = "rpm" }; - for standard input
    #[arg(long, value_name = "MAPPING.toml")]
    channels: Option<PathBuf>,
    /// Controller of the trace: force = V (P (reference_position - position) - speed); where it has its speed from is found
    #[arg(
        long,
        value_name = "gain_position=P,gain_speed=V",
        conflicts_with = "design"
    )]
    controller: Option<Controller>,
    #[command(flatten)]
    outputs: OutputArguments,
    #[command(flatten)]
    folder: FolderArguments,
}

fn within(text: &str, name: &str, range: std::ops::RangeInclusive<f64>) -> Result<f64, String> {
    let value = text.parse().ok().filter(|value| range.contains(value));
    value.ok_or_else(|| format!("{name} is {} to {}", range.start(), range.end()))
}

fn ratio(text: &str) -> Result<f64, String> {
    within(text, "a ratio", 0.01..=1000.0)
}

fn rated_torque(text: &str) -> Result<f64, String> {
    within(text, "a rated torque in N m", 1e-6..=1e6)
}

fn parameter(text: &str) -> Result<String, String> {
    let known: Vec<&str> = names().collect();
    if known.contains(&text) {
        return Ok(text.into());
    }
    Err(format!("allowed: {}", known.join(", ")))
}

fn setting(text: &str) -> Result<(String, f64), String> {
    let (name, value) = text.split_once('=').ok_or("expected NAME=VALUE")?;
    let number: f64 = value
        .trim()
        .parse()
        .map_err(|_| format!("{value} is not a number"))?;
    if !number.is_finite() {
        return Err(format!("{value} is not finite"));
    }
    Ok((name.trim().into(), number))
}

/// Calibrates a trace, or the traces of a folder.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    arguments.with_a_design();
    let file = arguments.design.as_ref().and_then(DesignSource::file);
    refuse_shared([
        file,
        arguments.trace.as_deref(),
        arguments.validate.as_deref(),
        arguments.channels.as_deref(),
    ])?;
    let design = arguments
        .design
        .as_ref()
        .map(|source| {
            let text = source.text()?;
            let design = source.load_from(text.as_deref())?;
            let text = text.unwrap_or_else(|| text::text(&design));
            Ok::<_, Failure>((design, text))
        })
        .transpose()?;
    let (design, text) = design.unzip();
    if let (Some(name), Some(design)) = (&arguments.wanted, &design) {
        return experiment::tell(design, name);
    }
    let merges = !arguments.folder.merge.is_empty();
    let trace = match &arguments.trace {
        Some(trace) => trace,
        // Folders that are merged have no name in common.
        None if merges => Path::new("merged"),
        None => return Err(Failure::Data("there is no trace".into())),
    };
    let folder = merges || trace.is_dir();
    arguments.fits(folder)?;
    let beside = [
        file,
        arguments.validate.as_deref(),
        arguments.channels.as_deref(),
    ];
    arguments.outputs.check(trace, beside)?;
    let mapping = arguments
        .channels
        .as_deref()
        .map(Mapping::read)
        .transpose()?;
    let mapping = mapping.as_ref();
    if folder {
        return whole_folder(arguments, trace, design.as_ref(), mapping);
    }
    let design = design.as_ref().zip(text.as_deref());
    one_trace(arguments, trace, design, mapping)
}

impl Arguments {
    fn with_a_design(&self) {
        let of_design = [
            ("--estimate", self.estimate.is_some()),
            ("--fix", !self.fix.is_empty()),
        ];
        let needless = of_design.iter().find(|(_, given)| *given);
        if let (Some((name, _)), None) = (needless, &self.design) {
            let word = format!(
                "{name} names parameters of a screw: give its design (--design NAME|FILE.toml); without one a drive's inertia, friction and losses are all estimated, and none is set\n"
            );
            clap::Error::raw(ErrorKind::MissingRequiredArgument, word).exit();
        }
    }

    fn fits(&self, folder: bool) -> Result<(), Failure> {
        let of_one_trace = [
            ("--design-out", self.outputs.design_out.is_some()),
            ("--validate", self.validate.is_some()),
            ("--controller", self.controller.is_some()),
        ];
        let needless = of_one_trace.iter().find(|(_, given)| *given && folder);
        if let Some((name, _)) = needless {
            return Err(Failure::Data(format!(
                "{name} is for one trace, and not for a folder of them"
            )));
        }
        if self.folder.part.is_some() && !folder {
            return Err(Failure::Data(
                "--part is for a folder of traces, and not for one trace".into(),
            ));
        }
        Ok(())
    }

    fn frame(&self, design: Option<&Design>) -> Frame {
        let alone = Frame {
            ratio: self.ratio,
            ..Frame::default()
        };
        let frame = design.map_or(alone, |design| Frame::of(design, self.ratio));
        frame.rated(self.rated_torque)
    }

    fn unseen(&self, frame: &Frame, mapping: Option<&Mapping>) -> Result<Option<Trace>, Failure> {
        self.validate
            .as_deref()
            .map(|path| {
                columns::read(
                    &Source(path),
                    Some(frame),
                    mapping.filter(|_| mdf4::named(path)),
                )
            })
            .transpose()
    }

    fn request(&self) -> Request {
        Request {
            wanted: Wanted {
                estimate: self.estimate.clone(),
                fix: self.fix.clone(),
                ..Wanted::default()
            },
            ratio_unsaid: self.ratio.is_none(),
            ..Request::default()
        }
    }
}

fn one_trace(
    arguments: &Arguments,
    path: &Path,
    design: Option<(&Design, &str)>,
    mapping: Option<&Mapping>,
) -> Result<(), Failure> {
    let truth = &truth::of(path);
    let frame = arguments.frame(design.map(|(design, _)| design));
    let trace = columns::read(&Source(path), Some(&frame), mapping)?;
    let unseen = arguments.unseen(&frame, mapping)?;
    let Some((design, text)) = design else {
        let told = without_design::calibrate(&trace, unseen.as_ref(), arguments.controller)?;
        if let Some(controller) = &told.controller {
            tell(controller, trace.coordinate);
        }
        return arguments.outputs.write(Outcome {
            calibration: &told.answer,
            picture: &told.picture,
            of: Known::Drive(&told.drive),
            truth,
        });
    };
    let request = Request {
        unseen,
        ..arguments.request()
    };
    let found = screw::calibrate(&trace, design, &request)?;
    arguments.outputs.write(Outcome {
        calibration: &found.answer,
        picture: &found.picture,
        of: Known::Design(text, &found.screw),
        truth,
    })
}

/// What the trace shows of its controller; beside the answer, so that a JSON object stays alone.
fn tell(seen: &SeenController, coordinate: Coordinate) {
    let unit = match coordinate {
        Coordinate::Rotation => "N m",
        Coordinate::Translation => "N",
    };
    say(format_args!(
        "The controller's speed is {}; it leaves {:.3e} {unit} rms of the effort, {:.1} %.",
        seen.source.1,
        seen.residual,
        100.0 * seen.share
    ));
}

fn whole_folder(
    arguments: &Arguments,
    traces: &Path,
    design: Option<&Design>,
    mapping: Option<&Mapping>,
) -> Result<(), Failure> {
    let name = folder_name(traces);
    let output = arguments.outputs.folder(&name);
    if design.is_some() {
        arguments.request().check()?;
    }
    let alone = arguments.folder.part.is_none() && arguments.folder.merge.is_empty();
    if design.is_none()
        && alone
        && let Some(steady) =
            steady::of_folder(traces, |path| read(arguments, None, mapping, path))?
    {
        let document = page::of_runs(&steady, &name);
        epas_page::folder::mark(&output)?;
        document.write(&output)?;
        let wrote = arguments.outputs.write_drive(&steady.drive, &name)?;
        if arguments.outputs.json {
            return print_json(&steady.answer);
        }
        document.print(&output)?;
        return wrote.iter().try_for_each(|line| print_line(line));
    }
    if arguments.outputs.constants.is_some() {
        return Err(Failure::Data(
            "--constants is for one trace, or without a design for a folder of runs at one speed each; of traces with reversals give the one that stands for the others".into(),
        ));
    }
    let mut settings = format!(
        "{} {:?} {:?} {:?} {:?}",
        env!("CARGO_PKG_VERSION"),
        design.map(|design| (&design.caged, design.branch, &design.calibrated)),
        (arguments.ratio, arguments.rated_torque),
        arguments.estimate,
        arguments.fix,
    );
    if let Some(mapping) = mapping {
        settings.extend([" ", &format!("{mapping:?}")]);
    }
    let folder = Folder {
        traces,
        output: &output,
        arguments: &arguments.folder,
        settings: &settings,
        json: arguments.outputs.json,
    };
    folder::run(&folder, |path| one(arguments, design, mapping, path))
}

fn read(
    arguments: &Arguments,
    design: Option<&Design>,
    mapping: Option<&Mapping>,
    path: &Path,
) -> Result<Trace, Failure> {
    // A folder may hold tables beside measurement files.
    let mapping = mapping.filter(|_| mdf4::named(path));
    columns::read(&Source(path), Some(&arguments.frame(design)), mapping)
}

fn one(
    arguments: &Arguments,
    design: Option<&Design>,
    mapping: Option<&Mapping>,
    path: &Path,
) -> Result<(Calibration, Answered), Failure> {
    let trace = read(arguments, design, mapping, path)?;
    let Some(design) = design else {
        return without_design::plain(&trace);
    };
    screw::plain(&trace, design, &arguments.request())
}
