//! A calibrated design as Rust constants for firmware: the block that it is folded into, its memory and its friction coefficient. Pasted into a
//! `no_std` crate they are checked by the compiler, and stand in flash.

use std::fmt::Write as _;

use epas_design::Folded;

use crate::outputs::firmware::{ElementsNumbers, Numbers};
use crate::page::shown::one_line;
use epas_design::caged_scene::{certified, fold_for};
use epas_design::files::Design;
use epas_design::files::calibration::ElementsName;
use epas_page::failure::Failure;
use epas_page::progress::Progress;

/// Constants of a design, to be pasted.
///
/// # Errors
/// What the crate refuses of the design, or what of it cannot be folded.
pub fn text(design: &Design, trace: &str) -> Result<String, Failure> {
    let numbers = Numbers::of(design)?;
    let friction = design.caged.friction;
    let coefficients = match &numbers.law {
        Some(law) => law.law()?.extremes(),
        None => (friction, friction),
    };
    let fold = fold_for(design, coefficients)
        .map_err(|message| Failure::Data(format!("{}: {message}", design.name)))?;
    let progress = Progress::of_fold();
    let folded = certified(&fold, &|share| progress.share(share))
        .map_err(|failure| failure.of(&design.name))?;
    let mut text = format!(
        "// Ball screw {}, calibrated by trace {}.\n//\n\
         // For a crate that depends on `epas-friction`. Everything is checked when it is compiled: a number out of range\n\
         // stops the compiler.\n\n",
        one_line(&design.name),
        one_line(trace)
    );
    text += &imports(&numbers);
    text += SOUND;
    text += &screw(&folded)?;
    if let Some(law) = &numbers.law {
        let _ = write!(
            text,
            "\n/// Friction coefficient by speed, temperature and direction.\n\
             pub const COEFFICIENT: CoefficientLaw = sound(CoefficientLaw::new(&CoefficientParameters {{\n    \
             boundary: {:?},\n    full_film: {:?},\n    half_share_speed: {:?},\n    reference_temperature: {:?},\n    \
             viscosity: sound(Viscosity::through({:?}, {:?}, {:?})),\n    forward: {:?},\n    backward: {:?},\n    \
             churning: {:?},\n    drag: RollingDrag {{ torque: {:?}, heating: {:?} }},\n}}));\n",
            law.boundary,
            law.full_film,
            law.half_share_speed,
            law.reference_temperature,
            law.viscosity[0],
            law.viscosity[1],
            law.pour_point,
            law.forward,
            law.backward,
            law.churning,
            law.drag.torque,
            law.drag.heating,
        );
    } else if numbers.elements.is_some() {
        let _ = write!(
            text,
            "\n/// One friction coefficient at every speed and temperature.\n\
             pub const COEFFICIENT: OneCoefficient = sound(OneCoefficient::new({friction:?}));\n"
        );
    }
    let calibrated = design.calibrated.as_ref();
    let backlash = calibrated.and_then(|found| found.backlash).unwrap_or(0.0);
    text += &memory(&numbers, folded.block.nodes(), backlash);
    text += &rig(design);
    Ok(text)
}

/// The value, or a stop of the compiler.
const SOUND: &str = "
/// The value; a refused one stops the compiler here.
const fn sound<T: Copy>(checked: Result<T, Error>) -> T {
    match checked {
        Ok(value) => value,
        Err(_) => panic!(\"a calibrated number is out of range\"),
    }
}
";

fn imports(numbers: &Numbers) -> String {
    let mut text = String::new();
    let memory = numbers.elements.is_some();
    match (&numbers.law, memory) {
        (Some(_), true) => {
            text += "use epas_friction::law::coefficient::{\n    CoefficientLaw, CoefficientParameters, RollingDrag, TemperatureFade, Viscosity,\n};\n";
        }
        (Some(_), false) => {
            text += "use epas_friction::law::coefficient::{\n    CoefficientLaw, CoefficientParameters, RollingDrag, Viscosity,\n};\n";
        }
        (None, true) => {
            text += "use epas_friction::law::coefficient::{OneCoefficient, TemperatureFade};\n";
        }
        (None, false) => {}
    }
    if let Some(memory) = &numbers.elements {
        text += match memory.kind {
            ElementsName::Proportional => {
                "use epas_friction::law::memory::{Part, ProportionalElements, SLIP_8};\n"
            }
            ElementsName::LoadExact => "use epas_friction::law::memory::LoadExactElements;\n",
            ElementsName::Preloaded => {
                "use epas_friction::law::memory::{LoadExactElements, PreloadedElements};\n"
            }
        };
        text += "use epas_friction::law::motion::Deadband;\n";
        text += "use epas_friction::scene::{\n    CagedConstants, Freshness, WithMemoryConfiguration, WithMemoryConstants,\n};\n";
    } else {
        text += "use epas_friction::scene::CagedConstants;\n";
    }
    text + "use epas_friction::Error;\n"
}

/// Words in a line.
const IN_A_LINE: usize = 6;

/// The block of the screw, and the constants of the scene without memory.
fn screw(folded: &Folded) -> Result<String, Failure> {
    let words = folded.words()?;
    let (count, nodes) = (words.len(), folded.block.nodes());
    let mut text = String::from("\n");
    for line in folded.summary() {
        let _ = writeln!(text, "// {line}");
    }
    let _ = write!(
        text,
        "#[rustfmt::skip]\nconst SCREW_BLOCK: [u32; {count}] = [\n"
    );
    for line in words.chunks(IN_A_LINE) {
        text.push_str("   ");
        for word in line {
            let _ = write!(text, " 0x{word:08x},");
        }
        text.push('\n');
    }
    let _ = write!(
        text,
        "];\n\n/// The screw without memory: for a `static` that stands in flash.\n\
         pub const SCREW: CagedConstants<{nodes}> = sound(CagedConstants::from_block(&SCREW_BLOCK));\n"
    );
    Ok(text)
}

/// Elements, and the constants of the scene with them: behind a dead band of the sensor's step and of the backlash, rad.
fn memory(numbers: &Numbers, nodes: usize, backlash: f32) -> String {
    let Some(memory) = &numbers.elements else {
        return String::new();
    };
    let ElementsNumbers {
        torque,
        breakaway_angle,
        load,
        kind,
        largest_load,
        play,
    } = *memory;
    let exact =
        format!("LoadExactElements::new({torque:?}, {breakaway_angle:?}, {largest_load:?})");
    let (kind, made) = match kind {
        ElementsName::Proportional => (
            "ProportionalElements<8>",
            format!(
                "sound(ProportionalElements::new(\n    {torque:?},\n    &[Part {{\n        backbone: &SLIP_8.elements,\n        \
                 share: 1.0,\n        breakaway_angle: {breakaway_angle:?},\n    }}],\n))"
            ),
        ),
        ElementsName::LoadExact => ("LoadExactElements<8>", format!("sound({exact})")),
        ElementsName::Preloaded => (
            "PreloadedElements<LoadExactElements<8>>",
            format!("PreloadedElements::new(sound({exact}))"),
        ),
    };
    let law = if numbers.law.is_some() {
        "CoefficientLaw"
    } else {
        "OneCoefficient"
    };
    let temperature = numbers.reference_temperature;
    // Plays in a row are one of the sum of their widths.
    let (band, width) = if backlash > 0.0 {
        ("the step and the backlash", "(step + BACKLASH)")
    } else {
        ("the step", "step")
    };
    format!(
        "
/// Friction after a reversal: {torque:?} N m of sliding after {breakaway_angle:?} rad.
pub const ELEMENTS: {kind} = {made};

/// The screw with memory, for a sensor of the nut's angle and the sensor's step, rad of the nut: for a `static` that stands in flash.
/// Flicker within the step moves nothing; after a reversal friction starts once the sensor has gone back by {band}.
///
/// ```text
/// static GEAR: WithMemoryConstants<CagedConstants<{nodes}>, {kind}, Deadband<CountSensor>, {law}> =
///     with_memory(SENSOR, TURN_PER_COUNT);
/// ```
pub const fn with_memory<A: Copy>(
    angle: A,
    step: f32,
) -> WithMemoryConstants<CagedConstants<{nodes}>, {kind}, Deadband<A>, {law}> {{
    sound(WithMemoryConstants::new(
        SCREW,
        &WithMemoryConfiguration {{
            scene: (),
            elements: ELEMENTS,
            angle: sound(Deadband::new(angle, 0.5 * {width})),
            reference_load: {load:?},
            play: {play:?},
            coefficient: COEFFICIENT,
            temperature: sound(TemperatureFade::new({temperature:?}, 60.0, 60.0)),
            freshness: Freshness::DEFAULT,
        }},
    ))
}}
"
    )
}

/// What a trace has told beside the friction of the screw.
fn rig(design: &Design) -> String {
    let Some(calibrated) = &design.calibrated else {
        return String::new();
    };
    let mut text = String::new();
    for (name, what, value) in [
        (
            "INERTIA",
            "Inertia of all that turns, about the nut's axis, kg m²",
            calibrated.inertia,
        ),
        (
            "DRAG",
            "Drag without a load over the speed, N m s/rad",
            calibrated.drag,
        ),
        (
            "CHURNING",
            "Torque of churned lubricant over its viscosity and the nut's speed, m³",
            calibrated.churning,
        ),
        (
            "OFFSET",
            "Torque that the motor's channel shows without any, N m",
            calibrated.offset,
        ),
        (
            "GAIN",
            "Torque of the load over that of a screw without friction",
            calibrated.gain,
        ),
        (
            "BACKLASH",
            "Free play between the sensor's angle and the nut's, rad",
            calibrated.backlash,
        ),
    ] {
        if let Some(value) = value {
            let _ = write!(text, "\n/// {what}.\npub const {name}: f32 = {value:?};\n");
        }
    }
    if !calibrated.harmonics.is_empty() {
        let _ = write!(
            text,
            "\n/// Waves of the torque over a turn: order, amplitudes with cosine and sine of the angle, N m.\n\
             pub const HARMONICS: [(u8, f32, f32); {}] = [\n",
            calibrated.harmonics.len()
        );
        for wave in &calibrated.harmonics {
            let _ = writeln!(
                text,
                "    ({}, {:?}, {:?}),",
                wave.order, wave.cosine, wave.sine
            );
        }
        text += "];\n";
    }
    text
}

#[cfg(test)]
mod tests {
    use epas_design::files::read;

    const DESIGN: &str = "\
name = \"rack\"
nominal_diameter = 0.032
lead = 0.02
ball_diameter = 6.35e-3
conformity = 0.528
contact_angle = 0.7853982
friction = 0.115
preload = 17
loaded_balls = 40
";

    const CALIBRATION: &str = "
[calibration]
full_film_ratio = 0.522
half_share_speed = 6.0
reference_temperature = 303.15
viscosity_pole = 210.0
direction_asymmetry = 0.02
breakaway_angle = 2e-3
inertia = 4e-4
drag = 3e-4
offset = 6e-3
gain = 1.012
harmonics = [{ order = 1, cosine = 1.5e-3, sine = -1e-3 }, { order = 2, sine = 8e-4 }]
";

    fn of(text: &str) -> String {
        super::text(&read(text, "design").unwrap(), "weave").unwrap()
    }

    /// The program's tests compile the stored text, and run it.
    #[test]
    fn the_stored_constants_are_what_is_written() {
        let stored = include_str!("../../../cli/tests/program/calibrated_constants.rs");
        let text = of(&format!("{DESIGN}{CALIBRATION}"));
        assert!(
            text == stored,
            "bench/cli/tests/program/calibrated_constants.rs is to be\n{text}"
        );
    }

    #[test]
    fn what_was_not_calibrated_is_left_out() {
        let plain = of(DESIGN);
        for word in ["COEFFICIENT", "ELEMENTS", "INERTIA", "with_memory"] {
            assert!(!plain.contains(word), "{word}");
        }
        let exact = of(&format!(
            "{DESIGN}[calibration]\nbreakaway_angle = 1e-3\nreference_load = 500\nelements = \"load_exact\"\nlargest_load = 3000\n"
        ));
        for word in ["sound(LoadExactElements::new", "OneCoefficient::new"] {
            assert!(exact.contains(word), "{word}");
        }
        assert!(!exact.contains("CoefficientLaw"));
    }

    #[test]
    fn a_name_cannot_end_the_comment() {
        let design = DESIGN.replace("rack", "rack\\nmod evil;");
        assert!(of(&design).contains("// Ball screw rack mod evil;, calibrated"));
    }
}
