//! What was folded, with a cage or without one: its block in every format, and what is shown of it.

use std::collections::BTreeMap;
use std::io::{self, Write};

use epas_design::uncaged::{RowFigures, UncagedCertificate, UncagedFigure};
use epas_design::{Certificate, Figure, Folded, FoldedUncaged};
use epas_friction::BallScrew;
use epas_friction::geometry::ContactAngle;
use serde::Serialize;

use super::Format;
use epas_design::files::{Design, capacity};
use epas_page::failure::Failure;

pub enum Made {
    Caged(Box<Folded>),
    Uncaged(Box<FoldedUncaged>),
}

#[derive(Serialize)]
pub struct Shown {
    version: u32,
    digest: String,
    bytes: usize,
    domain: BTreeMap<&'static str, [f32; 2]>,
    certificate: Vec<ShownFigure>,
    seed: u64,
    #[serde(skip_serializing_if = "Option::is_none")]
    two_answers: Option<f64>,
    unsolved: usize,
    seconds: f64,
}

#[derive(Serialize)]
struct ShownFigure {
    quantity: &'static str,
    largest: f64,
    rms: f64,
    mean: f64,
    states: usize,
    flagged: f64,
    unit: &'static str,
}

struct Head {
    about: String,
    friction: (f32, f32),
    axial_load: [f32; 2],
    digest: u64,
    seconds: f64,
}

impl Made {
    pub fn words(&self) -> Result<Vec<u32>, Failure> {
        Ok(match self {
            Self::Caged(folded) => folded.words()?,
            Self::Uncaged(folded) => folded.words()?,
        })
    }

    pub fn written(&self, format: Format, name: &str) -> Result<Vec<u8>, Failure> {
        let text = match (self, format) {
            // Two files, which `c99::files` makes of a caged screw.
            (_, Format::C99) => return Err(Failure::Data(super::c99::HAS.into())),
            (Self::Caged(folded), Format::Rust) => folded.rust(name),
            (Self::Caged(folded), Format::C) => folded.c(name),
            (Self::Caged(folded), Format::Toml) => folded.toml(),
            (Self::Caged(folded), Format::Binary) => return Ok(folded.bytes()?),
            (Self::Uncaged(folded), Format::Rust) => folded.rust(name),
            (Self::Uncaged(folded), Format::C) => folded.c(name),
            (Self::Uncaged(folded), Format::Toml) => folded.toml(),
            (Self::Uncaged(folded), Format::Binary) => return Ok(folded.bytes()?),
        };
        Ok(text?.into_bytes())
    }

    pub fn shown(&self) -> Result<Shown, Failure> {
        let bytes = 4 * self.words()?.len();
        Ok(match self {
            Self::Caged(folded) => {
                let Certificate { seed, figures } = &folded.certificate;
                let [torque] = figures;
                Shown {
                    version: folded.version()?,
                    digest: format!("{:016x}", folded.digest),
                    bytes,
                    domain: domain(folded.fold.axial_load, folded.block.friction_range()),
                    certificate: figures.iter().map(of_ball).collect(),
                    seed: *seed,
                    two_answers: Some(torque.two_answers),
                    unsolved: torque.unsolved,
                    seconds: folded.seconds,
                }
            }
            Self::Uncaged(folded) => {
                let certificate = &folded.certificate;
                let range = folded.block.friction_range();
                let mut domain = domain(folded.fold.axial_load, range);
                let [screw, nut] = folded.fold.gear.deviations;
                domain.insert("screw_deviation", [-screw, screw]);
                domain.insert("nut_deviation", [-nut, nut]);
                Shown {
                    version: self.words()?.get(1).copied().unwrap_or_default(),
                    digest: format!("{:016x}", folded.digest),
                    bytes,
                    domain,
                    certificate: of_rows(certificate).collect(),
                    seed: certificate.seed,
                    two_answers: None,
                    unsolved: certificate.unsolved,
                    seconds: folded.seconds,
                }
            }
        })
    }

    /// Load of the ball that carries most, N, under one of the screw.
    fn ball_load(&self, design: &Design, axial_load: f32) -> f32 {
        match (self, &design.uncaged) {
            (Self::Uncaged(_), Some(row)) => row.ball_load(axial_load),
            _ => axial_load / f32::from(design.caged.loaded_balls),
        }
    }

    fn head(&self, design: &Design) -> Head {
        match self {
            Self::Caged(folded) => Head {
                about: format!(
                    "caged, friction coefficient {}{}, clearance {} um{}, {} loaded balls{}",
                    folded.fold.gear.friction,
                    design.mark("friction"),
                    micrometres(folded.fold.gear.clearance.gap()),
                    design.mark("clearance"),
                    folded.fold.gear.loaded_balls,
                    design.mark("loaded_balls"),
                ),
                friction: folded.block.friction_range(),
                axial_load: folded.fold.axial_load,
                digest: folded.digest,
                seconds: folded.seconds,
            },
            Self::Uncaged(folded) => {
                let epas_design::UncagedDesign { gear, deviations } = &folded.fold.gear;
                let [screw, nut] = deviations.map(|largest| 1e3 * largest);
                Head {
                    about: format!(
                        "balls that press on each other, friction coefficient {}{}, clearance {} um{}, contact angle off by up to {screw:.2} mrad \
                         on the screw and {nut:.2} mrad in the nut",
                        gear.friction,
                        design.mark("friction"),
                        micrometres(gear.clearance.gap()),
                        design.mark("clearance"),
                    ),
                    friction: folded.block.friction_range(),
                    axial_load: folded.fold.axial_load,
                    digest: folded.digest,
                    seconds: folded.seconds,
                }
            }
        }
    }

    pub fn print(&self, out: &mut dyn Write, design: &Design, words: usize) -> io::Result<()> {
        let Head {
            about,
            friction: (least, most),
            axial_load: [from, to],
            digest,
            seconds,
        } = self.head(design);
        let friction = if least < most {
            format!("{least} to {most}")
        } else {
            least.to_string()
        };
        writeln!(out, "{}: {about}", design.name)?;
        writeln!(
            out,
            "domain: friction coefficient {friction}; axial load {from} to {to} N a ball, both signs"
        )?;
        let screw = design.screw();
        writeln!(out, "geometry: {}", geometry(screw))?;
        let limit = design.caged.limits.axial_load;
        let axial = to / self.ball_load(design, 1.0);
        if limit > 1.001 * axial {
            writeln!(
                out,
                "loads: {to} N a ball are {axial:.0} N of the screw; beyond, up to its limit of {limit:.0} N, they are flagged"
            )?;
        }
        let preload = capacity::Preload::of(screw, design.caged.clearance);
        if preload.force > 0.0 {
            let axial = design
                .caged
                .clearance
                .axial_preload(screw, design.caged.loaded_balls);
            writeln!(
                out,
                "preload: {} a contact, {axial:.0} N of the nut",
                preload.words()
            )?;
            if let Some(words) = capacity::unusual(screw, preload) {
                writeln!(out, "unusual preload: {words}")?;
            }
        }
        if let Some(words) = capacity::beyond(screw, to) {
            writeln!(out, "beyond the static limit: {words}")?;
        }
        writeln!(
            out,
            "block: {} bytes, digest {digest:016x}; folded in {seconds:.1} s\n",
            4 * words
        )?;
        writeln!(
            out,
            "certificate                   largest      rms       mean  states  flagged"
        )?;
        match self {
            Self::Caged(folded) => {
                let Certificate { seed, figures } = &folded.certificate;
                for figure in figures {
                    line(out, &of_ball(figure))?;
                    notes(out, *seed, figure)?;
                }
            }
            Self::Uncaged(folded) => notes_of_rows(out, folded)?,
        }
        Ok(())
    }

    /// How firmware takes the block in, of a file with a name and a constant's name.
    pub fn next(
        &self,
        out: &mut dyn Write,
        format: Format,
        (file, name): (&str, &str),
        words: usize,
    ) -> io::Result<()> {
        match self {
            Self::Caged(folded) => {
                let nodes = folded.block.nodes();
                let (scene, constants) = match nodes {
                    1 => ("CagedBallScrew".to_owned(), "CagedConstants".to_owned()),
                    nodes => (
                        format!("CagedBallScrew<{nodes}>"),
                        format!("CagedConstants<{nodes}>"),
                    ),
                };
                match format {
                    Format::Rust => writeln!(
                        out,
                        "    include!(\"{file}\");\n    let mut model: FrictionModel<{scene}, &'static {constants}> = FrictionModel::of(&{name});"
                    ),
                    Format::C => writeln!(
                        out,
                        "    #include \"{file}\"    /* {name}_BLOCK, {words} words: what CagedConstants::<{nodes}>::from_block takes */"
                    ),
                    Format::C99 => {
                        let name = name.to_ascii_lowercase();
                        let header = file.trim_end_matches(".c");
                        writeln!(
                            out,
                            "    #include \"{header}.h\"    /* compile {file} with -ffp-contract=off */\n    static {name}_t model;\n    \
                             {name}_init(&model);    /* once, where {name}_arithmetic_is_sound() */\n    \
                             {name}_step(&model, nut_speed, axial_load, &outputs);"
                        )
                    }
                    Format::Toml | Format::Binary => writeln!(
                        out,
                        "    let constants = CagedConstants::<{nodes}>::from_block(&words)?;    // {words} words\n    \
                         let mut model = FrictionModel::<{scene}, _>::of(&constants);"
                    ),
                }
            }
            Self::Uncaged(folded) => {
                let nodes = folded.block.nodes();
                match format {
                    Format::Rust => writeln!(
                        out,
                        "    include!(\"{file}\");    // {name}: the field `folded` of an UncagedBallScrewConfiguration<{nodes}>"
                    ),
                    Format::C => writeln!(
                        out,
                        "    #include \"{file}\"    /* {name}_BLOCK, {words} words: what FoldedBall::<{nodes}>::read takes */"
                    ),
                    Format::Toml | Format::Binary | Format::C99 => writeln!(
                        out,
                        "    let folded = FoldedBall::<{nodes}>::read(&words)?;    // {words} words: the field `folded` of an \
                         UncagedBallScrewConfiguration<{nodes}>"
                    ),
                }
            }
        }
    }
}

/// A gap in micrometres, to a nanometre: it is an f32.
fn micrometres(gap: f32) -> f64 {
    // 0 of either sign is 0.
    (1e9 * f64::from(gap)).round() / 1e3 + 0.0
}

fn geometry(screw: &BallScrew) -> String {
    let millimetres = |length: f32| (1e6 * f64::from(length)).round() / 1e3;
    let ContactAngle { cos, sin } = screw.contact_angle();
    format!(
        "ball circle {} mm, lead {} mm, balls of {} mm, contact angle {:.1} degrees",
        2.0 * millimetres(screw.pitch_radius()),
        millimetres(screw.lead()),
        2.0 * millimetres(screw.ball_radius()),
        sin.atan2(cos).to_degrees()
    )
}

fn domain(axial_load: [f32; 2], friction: (f32, f32)) -> BTreeMap<&'static str, [f32; 2]> {
    let (least, most) = friction;
    [("axial_load", axial_load), ("friction", [least, most])].into()
}

fn of_ball(figure: &Figure) -> ShownFigure {
    ShownFigure {
        quantity: figure.quantity,
        largest: figure.largest,
        rms: figure.rms,
        mean: figure.mean,
        states: figure.states,
        flagged: figure.flagged,
        unit: "relative",
    }
}

/// Figures of rows of balls, flagged ones in the count: of rows without friction between balls, with it, and the same of rows in waves.
fn of_rows(certificate: &UncagedCertificate) -> impl Iterator<Item = ShownFigure> {
    let shown = |quantity, figure: &UncagedFigure, of: &RowFigures, unit| ShownFigure {
        quantity,
        largest: figure.largest,
        rms: figure.rms,
        mean: figure.mean,
        states: of.rows,
        flagged: of.flagged,
        unit,
    };
    [
        ("ring_torque", "ring_force", &certificate.smooth),
        (
            "rubbing_ring_torque",
            "rubbing_ring_force",
            &certificate.rubbing,
        ),
        ("wave_ring_torque", "wave_ring_force", &certificate.waves),
        (
            "rubbing_wave_ring_torque",
            "rubbing_wave_ring_force",
            &certificate.rubbing_waves,
        ),
    ]
    .into_iter()
    .filter(|(.., of)| of.rows > 0)
    .flat_map(move |(torque, force, of)| {
        [
            shown(torque, &of.torque, of, "relative"),
            shown(force, &of.forces, of, "of the largest"),
        ]
    })
}

fn line(out: &mut dyn Write, figure: &ShownFigure) -> io::Result<()> {
    writeln!(
        out,
        "{:27} {:7.3} % {:6.3} % {:+8.4} % {:7} {:6.2} %",
        figure.quantity,
        100.0 * figure.largest,
        100.0 * figure.rms,
        100.0 * figure.mean,
        figure.states,
        100.0 * figure.flagged,
    )
}

fn notes(out: &mut dyn Write, seed: u64, figure: &Figure) -> io::Result<()> {
    writeln!(
        out,
        "Relative errors against the exact solver, at states that were not fitted (seed {seed}); largest at {:.4} N a ball, friction \
         coefficient {:.4}.",
        figure.worst_load, figure.worst_friction
    )?;
    if figure.two_answers > 0.0 {
        writeln!(
            out,
            "Two exact answers at {:.2} % of the states, where a contact opens later than it closes: the error is that to the nearer one.",
            100.0 * figure.two_answers
        )?;
    }
    unsolved(out, figure.unsolved, "states")
}

fn notes_of_rows(out: &mut dyn Write, folded: &FoldedUncaged) -> io::Result<()> {
    let certificate = &folded.certificate;
    for figure in of_rows(certificate) {
        line(out, &figure)?;
    }
    let UncagedFigure {
        worst_load,
        worst_friction,
        ..
    } = certificate.smooth.torque;
    writeln!(
        out,
        "Errors against the exact solver, on rows of {} touching balls that were not fitted (seed {}), flagged rows in the count: of the torque of \
         a row, relative, without friction between balls largest at {worst_load:.4} N a ball, friction coefficient {worst_friction:.4}; of the forces \
         between its balls, over the largest of the row. Rubbing: with a friction coefficient of {} between balls. Wave: deviations go in waves along the \
         grooves, else each ball's is random.",
        certificate.balls, certificate.seed, folded.fold.ball_friction,
    )?;
    unsolved(out, certificate.unsolved, "rows")
}

fn unsolved(out: &mut dyn Write, count: usize, of: &str) -> io::Result<()> {
    if count > 0 {
        writeln!(
            out,
            "Without an exact answer, and not counted: {count} {of}."
        )?;
    }
    Ok(())
}
