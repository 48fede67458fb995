//! A caged screw as C99 with its step and its memory: the templates in `c99`, with the numbers of one screw in them.
//!
//! No number is computed in C that the crate folds: the block's constants are those of `CagedConstants`, the elements' and the coefficient law's
//! those of their constructors. Floats are written as hexadecimal ones, which are exact.

use std::f32::consts::TAU;
use std::fmt::Write as _;

use epas_friction::Error;
use epas_friction::ball::folded::{FrictionNode, LoadCurve, log2_biased};
use epas_friction::law::coefficient::{CoefficientLaw, CoefficientParameters};
use epas_friction::law::memory::{
    Hysteresis as _, LoadExactElements, PreloadedElements, ProportionalElements,
};
use epas_friction::scene::{CagedBallScrewConfiguration, CagedConstants};

const HEADER: &str = include_str!("../c99/gear.h");
const SOURCE: &str = include_str!("../c99/gear.c");

/// Elements of the memory in C.
pub const ELEMENTS: usize = 8;

const IN_A_LINE: usize = 4;

/// Elements of a memory in C.
#[derive(Clone, Copy, Debug)]
pub enum Elements {
    /// In constant shares of the friction.
    Proportional(ProportionalElements<ELEMENTS>),
    /// That come into contact with the load.
    LoadExact(LoadExactElements<ELEMENTS>),
    /// The same at the load that both flanks of a preloaded nut share.
    Preloaded(PreloadedElements<LoadExactElements<ELEMENTS>>),
}

impl Elements {
    /// Their type in Rust.
    const fn name(&self) -> &'static str {
        match self {
            Self::Proportional(_) => "ProportionalElements<8>",
            Self::LoadExact(_) => "LoadExactElements<8>",
            Self::Preloaded(_) => "PreloadedElements<LoadExactElements<8>>",
        }
    }

    /// Angle of full sliding at the reference load, rad.
    #[must_use]
    pub fn breakaway(&self) -> f32 {
        match self {
            Self::Proportional(elements) => elements.breakaway(),
            Self::LoadExact(elements) => elements.breakaway(),
            Self::Preloaded(elements) => elements.breakaway(),
        }
    }
}

/// What the memory of a screw follows from.
#[derive(Clone, Copy, Debug)]
pub struct Memory {
    /// Its elements.
    pub elements: Elements,
    /// Axial load, preload counted, at which the elements were designed, N.
    pub reference_load: f32,
    /// The friction coefficient by speed, temperature and direction.
    pub law: CoefficientParameters,
}

/// The two files of a screw.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Files {
    /// `NAME.h`
    pub header: String,
    /// `NAME.c`
    pub source: String,
}

/// A screw in C99: what was folded, as lines of a comment; the name with which every function begins, in small letters, and that of both files
/// without an ending; its block and its memory.
///
/// # Errors
/// [`Error`] naming a field of the block or of the law that the crate refuses.
pub fn files<const NODES: usize>(
    summary: &[String],
    [name, stem]: [&str; 2],
    block: &CagedBallScrewConfiguration<NODES>,
    memory: &Memory,
) -> Result<Files, Error> {
    CagedConstants::new(block)?;
    let (least_friction, most_friction) = CoefficientLaw::new(&memory.law)?.extremes();
    let remembers = format!(
        "memory: full sliding after {:.4} mrad of the nut under {:.0} N, preload counted; friction coefficient {least_friction} to {most_friction} by speed, temperature \
         and direction",
        1e3 * memory.elements.breakaway(),
        memory.reference_load,
    );
    let lines = summary.iter().chain([&remembers]);
    let comment: Vec<_> = lines.map(|line| format!(" * {line}")).collect();
    let (least, largest) = block.law.friction_range();
    let numbers = numbers(block, memory)?;
    let places = [
        ("@SUMMARY@", comment.join("\n")),
        ("@LEAST@", hex(least)),
        ("@LARGEST@", hex(largest)),
        ("@FRICTION@", block.friction.to_string()),
        ("@HEADER@", format!("{stem}.h")),
        ("@NODES@", NODES.to_string()),
        ("@ELEMENTS@", memory.elements.name().into()),
        ("@BLOCK@", numbers.trim_end().to_owned()),
        ("epas_gear", name.to_owned()),
        ("EPAS_GEAR", name.to_ascii_uppercase()),
    ];
    let [header, source] = [HEADER, SOURCE].map(|template| {
        let text = template.to_owned();
        places
            .iter()
            .fold(text, |text, (place, with)| text.replace(place, with))
    });
    Ok(Files { header, source })
}

/// The constants as definitions, and the tables of nodes and elements.
fn numbers<const NODES: usize>(
    block: &CagedBallScrewConfiguration<NODES>,
    memory: &Memory,
) -> Result<String, Error> {
    let law = &block.law;
    let balls = f32::from(block.loaded_balls);
    let reversal = block.reversal_speed;
    let CoefficientParameters {
        boundary,
        full_film,
        forward,
        backward,
        drag,
        ..
    } = memory.law;
    let [scale, pole, coldest, warmest, churning, fluidity] =
        CoefficientLaw::new(&memory.law)?.numbers();
    let [least_log2, most_log2] = law.ends;
    let mut text = String::new();
    for (name, number, what) in [
        ("FRICTION", block.friction, "before it is set"),
        ("LEAST_LOG2", least_log2, "of a ball's load, biased"),
        ("MOST_LOG2", most_log2, "of a ball's load, biased"),
        (
            "SHIFTED_FROM",
            law.shifted_from,
            "the same, from which on nodes differ",
        ),
        ("PER_BALL", 1.0 / balls, "1 over loaded balls"),
        ("LIFT_OFF", balls * law.lift_off, "N, of all balls"),
        ("REDUCED_LEAD", block.lead / TAU, "m, over 2 pi"),
        ("REVERSAL_SPEED", reversal, "rad/s"),
        ("REVERSAL_SQUARED", reversal * reversal, "its square"),
        ("SPEED_LIMIT", block.limits.nut_speed, "rad/s"),
        ("LOAD_LIMIT", block.limits.axial_load, "N"),
        ("TORQUE_LIMIT", block.limits.friction_torque, "N m"),
        ("BOUNDARY", boundary, "friction coefficient at standstill"),
        ("FULL_FILM", full_film, "friction coefficient at high speed"),
        ("SCALE", scale, "1/K, of the half-share speed"),
        ("POLE", pole, "K"),
        ("COLDEST", coldest, "temperature above the pole, scaled"),
        ("WARMEST", warmest, "temperature above the pole, scaled"),
        ("CHURNING", churning, "N m"),
        ("FLUIDITY", fluidity, "of the drag, at the reference"),
        ("DRAG_TORQUE", drag.torque, "N m at 1 Pa s, 1 rad/s, 1 N"),
        ("DRAG_HEATING", drag.heating, "at 1 Pa s, 1 rad/s"),
    ] {
        // One node is not shifted.
        if NODES > 1 || name != "SHIFTED_FROM" {
            let _ = writeln!(
                text,
                "#define {name} {} /* {number}, {what} */",
                hex(number)
            );
        }
    }
    text.push_str(&elements(memory));
    text.push_str(&table("direction_factors[2]", &[forward, backward]));
    let _ = writeln!(text, "\nstatic const node_t nodes[NODES] = {{");
    for node in &law.nodes {
        text.push_str(&node_of(node));
    }
    text.push_str("};\n");
    Ok(text)
}

/// Definitions and tables of the elements.
fn elements(memory: &Memory) -> String {
    let exact = ["stiffnesses", "onsets"];
    let (names, numbers, flanks) = match &memory.elements {
        Elements::Proportional(elements) => (["rates", "shares"], elements.numbers(), None),
        Elements::LoadExact(elements) => (exact, elements.numbers(), None),
        Elements::Preloaded(elements) => (
            exact,
            elements.elements().numbers(),
            Some(elements.numbers()),
        ),
    };
    let mut text = format!("#define FOLLOWS_LOAD {}\n", u8::from(names == exact));
    if names == exact {
        let _ = writeln!(
            text,
            "#define PRELOADED {}\n#define PER_REFERENCE_LOAD {} /* 1 over {} N */",
            u8::from(flanks.is_some()),
            hex(1.0 / memory.reference_load),
            memory.reference_load,
        );
    }
    let of_flanks = ["LIFT_OFF", "SUM", "SQUARE", "QUARTIC", "PER_SUM"];
    for (name, number) in of_flanks.into_iter().zip(flanks.into_iter().flatten()) {
        let _ = writeln!(text, "#define FLANKS_{name} {} /* {number} */", hex(number));
    }
    for (name, of) in names.into_iter().zip(numbers) {
        text.push_str(&table(&format!("{name}[EPAS_GEAR_ELEMENTS]"), &of));
    }
    text
}

fn table(name: &str, of: &[f32]) -> String {
    format!("\nstatic const float {name} = {{\n{}}};\n", listed(of, 1))
}

fn node_of(node: &FrictionNode) -> String {
    let curves: String = node.curves.iter().map(curve).collect();
    format!(
        "    {{\n        {}, /* {} */\n        {},\n        {{\n{curves}        }},\n        {{\n{}        }},\n    }},\n",
        hex(node.friction),
        node.friction,
        hex(log2_biased(node.friction)),
        listed(&node.shift, 3),
    )
}

fn curve(curve: &LoadCurve) -> String {
    let cubic = |cubic: &[f32; 4]| cubic.map(hex).join(", ");
    let cubics: Vec<_> = curve.cubics.iter().map(cubic).collect();
    format!(
        "            {{\n                {{\n{}                }},\n                {{\n                    {{{}}},\n                }},\n            }},\n",
        listed(&curve.starts, 5),
        cubics.join("},\n                    {"),
    )
}

/// Numbers in lines that stand in so many steps.
fn listed(numbers: &[f32], depth: usize) -> String {
    let mut text = String::new();
    for line in numbers.chunks(IN_A_LINE) {
        let line: Vec<_> = line.iter().map(|&number| hex(number)).collect();
        let _ = writeln!(text, "{:1$}{2},", "", 4 * depth, line.join(", "));
    }
    text
}

/// A finite number as a hexadecimal constant of C99, which is exact.
fn hex(number: f32) -> String {
    let bits = number.to_bits();
    let sign = if number.is_sign_negative() { "-" } else { "" };
    let (exponent, mantissa) = ((bits >> 23) & 0xff, bits & 0x7f_ffff);
    match (exponent, mantissa) {
        (0, 0) => format!("{sign}0.0f"),
        (0, _) => format!("{sign}0x0.{:06x}p-126f", mantissa << 1),
        _ => format!(
            "{sign}0x1.{:06x}p{:+}f",
            mantissa << 1,
            exponent as i32 - 127
        ),
    }
}
