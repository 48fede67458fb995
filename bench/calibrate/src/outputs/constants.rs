//! A calibrated design as Rust constants for firmware: the block that it is folded into, its memory and its friction coefficient. Pasted into a
//! `no_std` crate they are checked by the compiler, and stand in flash.

use std::fmt::Write as _;

use epas_design::Folded;

use crate::outputs::firmware::{Numbers, coefficients};
use crate::page::shown::one_line;
use crate::screw::friction::{COLDEST, ElementsKind};
use epas_design::caged_scene::{certified, fold_for};
use epas_design::files::Design;
use epas_page::failure::Failure;
use epas_page::progress::Progress;

pub fn text(design: &Design, trace: &str) -> Result<String, Failure> {
    let numbers = Numbers::of(design)?;
    let friction = design.caged.friction;
    let fold = fold_for(design, coefficients(design)?)
        .map_err(|message| Failure::Data(format!("{}: {message}", design.name)))?;
    let progress = Progress::of_fold();
    let folded = certified(&fold, &|share| progress.share(share))
        .map_err(|failure| failure.of(&design.name))?;
    let what = format!("Ball screw {}", one_line(&design.name));
    let mut text = head(&what, trace);
    text.push('\n');
    text += &imports(&numbers);
    text += SOUND;
    text += &screw(&folded)?;
    text += &coefficient(&numbers, friction);
    let calibrated = design.calibrated.as_ref();
    let backlash = calibrated.and_then(|found| found.backlash).unwrap_or(0.0);
    text += &memory(&numbers, folded.block.nodes(), backlash)?;
    text += &rig(design);
    Ok(text)
}

pub(super) fn head(what: &str, trace: &str) -> String {
    format!(
        "// {what}, calibrated by trace {}.\n//\n\
         // For a crate that depends on `epas-friction`. Everything is checked when it is compiled: a number out of range\n\
         // stops the compiler.\n",
        one_line(trace)
    )
}

pub(super) const SOUND: &str = "
/// The value; a refused one stops the compiler here.
const fn sound<T: Copy>(checked: Result<T, Error>) -> T {
    match checked {
        Ok(value) => value,
        Err(_) => panic!(\"a calibrated number is out of range\"),
    }
}
";

fn imports(numbers: &Numbers) -> String {
    let law = match (numbers.law.is_some(), numbers.reference.is_some()) {
        (_, true) => "use epas_friction::law::{coefficient, memory, motion};\n",
        (true, false) => "use epas_friction::law::coefficient;\n",
        (false, false) => "",
    };
    format!("{law}use epas_friction::{{Error, scene}};\n")
}

fn screw(folded: &Folded) -> Result<String, Failure> {
    let words = folded.words()?;
    let (count, nodes) = (words.len(), folded.block.nodes());
    let mut text = String::from("\n");
    for line in folded.summary() {
        let _ = writeln!(text, "// {line}");
    }
    let _ = writeln!(
        text,
        "#[rustfmt::skip]\n#[allow(clippy::unreadable_literal)]\nconst SCREW_BLOCK: [u32; {count}] = ["
    );
    for line in words.chunks(6) {
        let line = line.iter().map(|word| format!(" 0x{word:08x},"));
        let _ = writeln!(text, "   {}", line.collect::<String>());
    }
    let _ = write!(
        text,
        "];\n\n/// The screw without memory: for a `static` that stands in flash.\n\
         pub const SCREW: scene::CagedConstants<{nodes}> =\n    sound(scene::CagedConstants::from_block(&SCREW_BLOCK));\n"
    );
    Ok(text)
}

fn coefficient(numbers: &Numbers, friction: f32) -> String {
    let Some(law) = &numbers.law else {
        return numbers.reference.map_or_else(String::new, |_| {
            format!(
                "\n/// One friction coefficient at every speed and temperature.\n\
                 pub const COEFFICIENT: coefficient::OneCoefficient =\n    sound(coefficient::OneCoefficient::new({friction:?}));\n"
            )
        });
    };
    let [cold, warm] = numbers.screw.viscosities(&numbers.values);
    format!(
        "\n/// Friction coefficient by speed, temperature and direction.\n\
         pub const COEFFICIENT: coefficient::CoefficientLaw = sound(coefficient::CoefficientLaw::new(&coefficient::CoefficientParameters {{\n    \
         boundary: {:?},\n    full_film: {:?},\n    half_share_speed: {:?},\n    reference_temperature: {:?},\n    \
         viscosity: sound(coefficient::Viscosity::through({cold:?}, {warm:?}, {COLDEST:?})),\n    forward: {:?},\n    backward: {:?},\n    \
         churning: {:?},\n    drag: coefficient::RollingDrag {{ torque: {:?}, heating: {:?} }},\n}}));\n",
        law.boundary,
        law.full_film,
        law.half_share_speed,
        law.reference_temperature,
        law.forward,
        law.backward,
        law.churning,
        law.drag.torque,
        law.drag.heating,
    )
}

/// Elements, and the constants of the scene with them: behind a dead band of the sensor's step and of the backlash, rad.
fn memory(numbers: &Numbers, nodes: usize, backlash: f32) -> Result<String, Failure> {
    let Some(reference) = &numbers.reference else {
        return Ok(String::new());
    };
    let Numbers { screw, values, .. } = numbers;
    let (torque, load, play) = (reference.torque, reference.load, numbers.play(reference)?);
    let breakaway_angle = values.breakaway_angle as f32;
    let largest_load = screw.largest_load_of_elements(reference);
    let exact = format!(
        "memory::LoadExactElements::new({torque:?}, {breakaway_angle:?}, {largest_load:?})"
    );
    let (kind, made) = match screw.elements {
        ElementsKind::Proportional => (
            "memory::ProportionalElements<8>",
            format!(
                "sound(memory::ProportionalElements::new(\n    {torque:?},\n    &[memory::Part {{\n        backbone: \
                 &memory::SLIP_8.elements,\n        share: 1.0,\n        breakaway_angle: {breakaway_angle:?},\n    }}],\n))"
            ),
        ),
        ElementsKind::LoadExact => ("memory::LoadExactElements<8>", format!("sound({exact})")),
        ElementsKind::Preloaded => (
            "memory::PreloadedElements<memory::LoadExactElements<8>>",
            format!("memory::PreloadedElements::new(sound({exact}))"),
        ),
    };
    let law = ["OneCoefficient", "CoefficientLaw"][usize::from(numbers.law.is_some())];
    let types = format!("scene::CagedConstants<{nodes}>, {kind}, ");
    let temperature = screw.reference_temperature as f32;
    // Plays in a row are one of the sum of their widths.
    let (band, width) = if backlash > 0.0 {
        ("the step and the backlash", "(step + BACKLASH)")
    } else {
        ("the step", "step")
    };
    Ok(format!(
        "
/// Friction after a reversal: {torque:?} N m of sliding after {breakaway_angle:?} rad.
pub const ELEMENTS: {kind} = {made};

/// The screw with memory, for a sensor of the nut's angle and the sensor's step, rad of the nut: for a `static` that stands in flash.
/// Flicker within the step moves nothing; after a reversal friction starts once the sensor has gone back by {band}.
///
/// ```text
/// static GEAR: scene::WithMemoryConstants<{types}motion::Deadband<CountSensor>, coefficient::{law}> =
///     with_memory(SENSOR, TURN_PER_COUNT);
/// ```
pub const fn with_memory<A: Copy>(
    angle: A,
    step: f32,
) -> scene::WithMemoryConstants<{types}motion::Deadband<A>, coefficient::{law}> {{
    sound(scene::WithMemoryConstants::new(
        SCREW,
        &scene::WithMemoryConfiguration {{
            scene: (),
            elements: ELEMENTS,
            angle: sound(motion::Deadband::new(angle, 0.5 * {width})),
            reference_load: {load:?},
            play: {play:?},
            coefficient: COEFFICIENT,
            temperature: sound(coefficient::TemperatureFade::new({temperature:?}, 60.0, 60.0)),
            freshness: scene::Freshness::DEFAULT,
        }},
    ))
}}
"
    ))
}

/// What a trace may tell beside the friction of the screw: name and what it is, one a line.
const RIG: &str = "\
INERTIA: Inertia of all that turns, about the nut's axis, kg m²
DRAG: Drag without a load over the speed, N m s/rad
CHURNING: Torque of churned lubricant over its viscosity and the nut's speed, m³
OFFSET: Torque that the motor's channel shows without any, N m
GAIN: Torque of the load over that of a screw without friction
BACKLASH: Free play between the sensor's angle and the nut's, rad";

/// What a trace has told beside the friction of the screw.
fn rig(design: &Design) -> String {
    let Some(told) = &design.calibrated else {
        return String::new();
    };
    let mut text = String::new();
    let values = [
        told.inertia,
        told.drag,
        told.churning,
        told.offset,
        told.gain,
        told.backlash,
    ];
    for (line, value) in RIG.lines().zip(values) {
        if let (Some((name, what)), Some(value)) = (line.split_once(": "), value) {
            let _ = write!(text, "\n/// {what}.\npub const {name}: f32 = {value:?};\n");
        }
    }
    if !told.harmonics.is_empty() {
        let _ = writeln!(
            text,
            "\n/// Waves of the torque over a turn: order, amplitudes with cosine and sine of the angle, N m.\n\
             pub const HARMONICS: [(u8, f32, f32); {}] = [",
            told.harmonics.len()
        );
        for wave in &told.harmonics {
            let all = (wave.order, wave.cosine, wave.sine);
            let _ = writeln!(text, "    {all:?},");
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
        // A name cannot end the comment.
        let plain = of(&DESIGN.replace("rack", "rack\\nmod evil;"));
        assert!(plain.contains("// Ball screw rack mod evil;, calibrated"));
        for word in ["COEFFICIENT", "ELEMENTS", "INERTIA", "with_memory"] {
            assert!(!plain.contains(word), "{word}");
        }
        let exact = of(&format!(
            "{DESIGN}[calibration]\nbreakaway_angle = 1e-3\nreference_load = 500\nelements = \"load_exact\"\nlargest_load = 3000\n"
        ));
        for word in [
            "sound(memory::LoadExactElements::new",
            "OneCoefficient::new",
        ] {
            assert!(exact.contains(word), "{word}");
        }
        assert!(!exact.contains("CoefficientLaw"));
    }
}
