//! Errors in the words of the design file, and numbers that are allowed but mean another unit.

use epas_friction::{BallScrewParameters, Error, GrooveSize, Range};

/// Where the numbers of the built-in designs come from.
pub const SOURCES: &str = "
Sizes: 125x10x7.144 to 25x80x3.5 of Bertolino et al. 2023, Tables A1 and A2; 16x5x3.175 to 63x10x6.35 usual catalogue sizes;
25x7x3.5 to 30x8x4.762 assumed, near a steering gear's; lin-... of Lin 2019.
A name has these numbers in every scene, with a cage, without one, and with memory:
Friction: 0.1 for lin-3.6, as Lin 2019 prints it; 0.075 for the papers' other sizes, that of the example of Lin et al. 1994; 0.1 for
sizes of no paper, with which the drag torque of braced nuts is that of JIS B 1192.
Clearance: 0, balls that just fit, for the papers' sizes; for the others -1 um, an oversize, the least preload that sorted balls set.
Reversal speed: 0.5 rad/s for the papers' sizes, 2 rad/s for the others.
Rolling resistance of all: 0.01 of the elastic energy, hardened steel, without lubricant drag.
A design file sets friction, clearance or preload, hysteresis_loss and lubricant_drag; calibrate fits them to a trace. Without
them it has friction 0.1 and clearance -1 um.";

/// Which lengths a file gives as diameters.
#[derive(Clone, Copy, Debug, Default)]
pub struct Given {
    /// In place of the pitch radius.
    pub nominal_diameter: bool,
    /// In place of the ball radius.
    pub ball_diameter: bool,
}

/// Largest lead angle, as its tangent: 60 degrees. The steepest screw of the catalogues has 46.
const STEEPEST: f32 = 1.732;
/// Ball diameters over pitch diameters: those of catalogues go from 0.05 to 0.26.
const BALLS: [f32; 2] = [0.01, 0.5];
/// Largest conformity: those of catalogues go from 0.505 to 0.58.
const WIDEST: f32 = 0.7;
/// Smallest angle, rad, that is in degrees: a contact angle is below a right one.
const DEGREES: f32 = 2.0;
/// Largest speed of a trace over the limit of its design: above a limit by less, the limit is too tight; above it by more, the unit is another.
pub const FASTEST: f64 = 1.5;
/// Fastest balls about the screw's axis, m/s: twice what catalogues allow (150,000 mm/min of pitch diameter times revolutions).
pub const FASTEST_BALLS: f64 = 16.0;
/// Longest travel, m.
pub const LONGEST: f64 = 3.0;
/// Turns of a circuit: its return takes the balls back after 1 to 5.
const TURNS: [f32; 2] = [0.1, 10.0];

impl Given {
    /// An error with the name and the value that the file has, and the unit that it may be in.
    pub fn words(self, error: &Error) -> String {
        let error = &narrowed(*error);
        let (field, factor) = match error.field() {
            "pitch_radius" if self.nominal_diameter => ("nominal_diameter", 2.0),
            "ball_radius" if self.ball_diameter => ("ball_diameter", 2.0),
            field => (field, 1.0),
        };
        let allowed = error.allowed();
        let (value, hint) = (
            factor * error.value(),
            meant(error.field(), error.value(), allowed),
        );
        let said = if factor == 1.0 {
            error.to_string()
        } else {
            let [low, high] =
                [allowed.minimum, allowed.maximum].map(|end| shown(f64::from(factor * end)));
            let problem = if value.is_finite() {
                "is out of range"
            } else {
                "is not a finite number"
            };
            format!(
                "{field} = {value} {problem}; allowed: {low} to {high} m; lengths are in metres"
            )
        };
        // A screw without lead is refused by its own word.
        let said = match field {
            "lead" => said.replace("allowed: 0 to", "allowed: above 0 to"),
            _ => said,
        };
        match hint {
            Some(unit) => format!("{said} ({})", unit.asked(value)),
            None if field == "conformity" => format!("{said}{}", other_conformity(value)),
            None => said,
        }
    }

    /// Refuses what no screw has: turns of the groove that cross, balls of another size, a lead angle beyond 60 degrees, grooves that hardly
    /// guide a ball.
    pub fn plausible(self, parameters: &BallScrewParameters) -> Result<(), String> {
        let BallScrewParameters {
            pitch_radius,
            lead,
            ball_radius,
            screw_groove,
            nut_groove,
            ..
        } = *parameters;
        conformity("screw_groove", screw_groove, ball_radius)?;
        conformity("nut_groove", nut_groove, ball_radius)?;
        let ball = if self.ball_diameter {
            format!("ball_diameter = {}", 2.0 * ball_radius)
        } else {
            format!("ball_radius = {ball_radius}")
        };
        let screw = if self.nominal_diameter {
            format!("nominal_diameter = {}", 2.0 * pitch_radius)
        } else {
            format!("pitch_radius = {pitch_radius}")
        };
        let tangent = lead / (core::f32::consts::TAU * pitch_radius);
        let share = ball_radius / pitch_radius;
        if tangent > STEEPEST {
            return Err(format!(
                "lead = {lead} with {screw} is a lead angle of {:.0} degrees; allowed: 0 to 60. Lengths are in metres: 7 mm is 0.007",
                tangent.atan().to_degrees()
            ));
        }
        if !(BALLS[0]..=BALLS[1]).contains(&share) {
            return Err(format!(
                "{ball} with {screw}: the balls have {share} of the screw's diameter; allowed: {} to {}. Lengths are in metres: 4 mm is 0.004",
                BALLS[0], BALLS[1]
            ));
        }
        if lead == 0.0 {
            return Err(
                "lead = 0 is a bearing's: it moves nothing along the axis; allowed: above 0 to 0.2 m. Lengths are in metres: 7 mm is 0.007"
                    .into(),
            );
        }
        // Within a rounding, balls may fill the lead.
        if 2.0 * ball_radius > 1.001 * lead {
            return Err(format!(
                "lead = {lead} with {ball}: the groove's turns would cross; a lead is at least the ball's diameter. Lengths are in metres: 7 mm is 0.007"
            ));
        }
        Ok(())
    }
}

/// An error about a groove, with the widest one of a file: the crate's ends where the groove has twice the ball's radius.
fn narrowed(error: Error) -> Error {
    match error {
        Error::OutOfRange {
            field: field @ ("conformity" | "groove_radius"),
            value,
            allowed,
        } => Error::OutOfRange {
            field,
            value,
            allowed: Range::new(allowed.minimum, WIDEST * allowed.maximum),
        },
        _ => error,
    }
}

/// Refuses a groove that is much wider than its ball.
pub fn conformity(groove: &str, size: GrooveSize, ball_radius: f32) -> Result<(), String> {
    let (said, ratio) = match size {
        GrooveSize::Conformity(ratio) => (format!("conformity = {ratio}"), ratio),
        GrooveSize::Radius(radius) => {
            let ratio = radius / (2.0 * ball_radius);
            (
                format!("groove_radius = {radius} is {ratio} ball diameters, and"),
                ratio,
            )
        }
    };
    if ratio <= WIDEST {
        return Ok(());
    }
    Err(format!(
        "{groove}: {said} is out of range; allowed: 0.5005 to {WIDEST}{}",
        other_conformity(ratio)
    ))
}

/// The definition of conformity, and what a value is by another one where that gives a usual number.
fn other_conformity(value: f32) -> String {
    const USUAL: std::ops::RangeInclusive<f32> = 0.505..=0.6;
    const DEFINED: &str = "conformity is groove radius over ball diameter, 0.52 to 0.58 usual";
    let others = [
        ("ball radius over groove radius", 0.5 / value),
        ("groove radius over ball radius", 0.5 * value),
        ("a percentage", 0.01 * value),
    ];
    match others.iter().find(|(_, made)| USUAL.contains(made)) {
        Some((name, made)) => {
            format!("; {DEFINED}; if {value} is {name}, write conformity = {made:.4}")
        }
        None => format!("; {DEFINED}"),
    }
}

/// Refuses turns that no circuit has.
pub fn turns(turns: f32) -> Result<(), String> {
    let [least, most] = TURNS;
    if (least..=most).contains(&turns) {
        return Ok(());
    }
    Err(format!(
        "turns = {turns} is out of range; allowed: {least} to {most}, turns of one circuit: its return takes the balls back after 1 to 5; several circuits are several models"
    ))
}

/// A unit that a value may be in.
#[derive(Clone, Copy, Debug)]
enum Meant {
    Micrometres,
    Millimetres,
    Degrees,
}

impl Meant {
    fn asked(self, value: f32) -> String {
        let double = f64::from(value);
        match self {
            Self::Micrometres if value.abs() < 1.0 => format!("{value} mm? that is {value}e-3"),
            Self::Micrometres => format!("{value} um? that is {value}e-6"),
            Self::Millimetres => format!("{value} mm? that is {}", shown(double / 1e3)),
            Self::Degrees => format!("{value} degrees? that is {:.5}", double.to_radians()),
        }
    }
}

fn shown(value: f64) -> String {
    let digits = format!("{value:.6}");
    digits.trim_end_matches('0').trim_end_matches('.').into()
}

/// The unit that a number out of its range may be in, as a question; none where no unit of its field brings it into the range.
pub fn asked(field: &str, value: f32, allowed: Range) -> Option<String> {
    meant(field, value, allowed).map(|unit| unit.asked(value))
}

fn meant(field: &str, value: f32, allowed: Range) -> Option<Meant> {
    let has = |parts: &[&str]| parts.iter().any(|part| field.contains(part));
    if has(&["clearance", "axial_play"]) && allowed.contains(value * 1e-6) {
        return Some(Meant::Micrometres);
    }
    let length = field == "lead" || has(&["radius", "diameter", "length", "spacing"]);
    if length && allowed.contains(value * 1e-3) {
        return Some(Meant::Millimetres);
    }
    let angle = has(&["contact_angle", "lead_angle"]);
    (angle && value >= DEGREES && allowed.contains(value.to_radians())).then_some(Meant::Degrees)
}

/// The names that a text may mean: those that go on where it ends, else the one most like it.
pub fn nearest<'a>(text: &str, names: impl Iterator<Item = &'a str> + Clone) -> String {
    // What is long is like nothing, and need not be looked at whole.
    let text: String = text.chars().take(40).collect();
    let whole = format!("{}x", text.trim_end_matches('x'));
    let longer: Vec<&str> = names
        .clone()
        .filter(|name| name.starts_with(&whole))
        .collect();
    if !longer.is_empty() {
        return longer.join(" or ");
    }
    names
        .min_by_key(|name| strsim::damerau_levenshtein(&text, name))
        .unwrap_or_default()
        .into()
}

/// The name that a key is a misspelling of, by up to a quarter of its letters.
pub fn misspelt<'a>(key: &str, names: impl Iterator<Item = &'a str>) -> Option<&'a str> {
    let most = (key.len() / 4).max(1);
    let distances = names.map(|name| (strsim::damerau_levenshtein(key, name), name));
    let (_, name) = distances.filter(|(distance, _)| *distance <= most).min()?;
    Some(name)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::files::{built_in, read};

    const REST: &str = "conformity = 0.54\ncontact_angle = 0.785\n";

    #[test]
    fn errors_have_the_words_of_the_file_and_suggest_a_unit() {
        for (text, words) in [
            (
                "nominal_diameter = 29\nlead = 7e-3\nball_diameter = 4e-3\n",
                "nominal_diameter = 29 is out of range; allowed: 0.002 to 1 m; lengths are in metres (29 mm? that is 0.029)",
            ),
            (
                "nominal_diameter = 29e-3\nlead = 7\nball_diameter = 4e-3\n",
                "lead = 7 is out of range; allowed: above 0 to 0.2 m; lengths are in metres (7 mm? that is 0.007)",
            ),
            (
                "pitch_radius = 14.5e-3\nlead = 7e-3\nball_radius = 2\n",
                "ball_radius = 2 is out of range",
            ),
            (
                "nominal_diameter = 29e-3\nlead = 7e-3\nball_diameter = 4\n",
                "ball_diameter = 4 is out of range",
            ),
            (
                "nominal_diameter = nan\nlead = 7e-3\nball_diameter = 4e-3\n",
                "nominal_diameter = NaN is not a finite number",
            ),
            (
                "nominal_diameter = 29e-3\nlead = 0.19\nball_diameter = 4e-3\n",
                "a lead angle of 64 degrees",
            ),
            (
                "nominal_diameter = 29e-3\nlead = 7e-3\nball_diameter = 2.1e-4\n",
                "ball_diameter = 0.00021 with nominal_diameter = 0.029",
            ),
            (
                "nominal_diameter = 29e-3\nlead = 7e-4\nball_diameter = 4e-3\n",
                "turns would cross",
            ),
            (
                "nominal_diameter = 29e-3\nlead = 0\nball_diameter = 4e-3\n",
                "lead = 0 is a bearing's",
            ),
        ] {
            let message = read(&format!("{text}{REST}"), "x").unwrap_err();
            assert!(message.contains(words), "{text}: {message}");
        }
        for (text, words) in [
            ("0.943", "write conformity = 0.5302"),
            (
                "1.06",
                "if 1.06 is groove radius over ball radius, write conformity = 0.5300",
            ),
            ("54", "write conformity = 0.5400"),
            (
                "0.5",
                "conformity = 0.5 is out of range; allowed: 0.5005 to 0.7",
            ),
            (
                "0.75",
                "conformity = 0.75 is out of range; allowed: 0.5005 to 0.7",
            ),
        ] {
            let text = format!(
                "nominal_diameter = 29e-3\nlead = 7e-3\nball_diameter = 4e-3\ncontact_angle = 0.785\nconformity = {text}\n"
            );
            let message = read(&text, "x").unwrap_err();
            assert!(message.contains(words), "{message}");
            assert!(
                message.contains("groove radius over ball diameter"),
                "{message}"
            );
        }
        let degrees = "nominal_diameter = 29e-3\nlead = 7e-3\nball_diameter = 4e-3\nconformity = 0.54\ncontact_angle = 45\n";
        let message = read(degrees, "x").unwrap_err();
        assert!(message.contains("45 degrees? that is 0.78540"), "{message}");
        // One range, whichever end is passed by how much, and no unit where the number may be in radians.
        for angle in ["0.005", "0.03", "1.51", "1.57"] {
            let text = degrees.replace("= 45", &format!("= {angle}"));
            let message = read(&text, "x").unwrap_err();
            let words = format!("contact_angle = {angle} is out of range; allowed: 0.05 to 1.5");
            assert_eq!(message, words);
        }
    }

    #[test]
    fn built_in_designs_are_plausible_and_near_names_are_found() {
        let given = Given {
            nominal_diameter: true,
            ball_diameter: true,
        };
        for (name, parameters, _) in built_in() {
            given
                .plausible(&parameters)
                .unwrap_or_else(|message| panic!("{name}: {message}"));
        }
        let near = |text| nearest(text, built_in().map(|(name, ..)| name));
        assert_eq!(near("25x5x3.17"), "25x5x3.175");
        assert_eq!(near("lin4.1"), "lin-4.1");
        assert_eq!(near("25x5"), "25x5x3.175");
        assert_eq!(near("32x5"), "32x5x3.175 or 32x5x3.5");
    }

    /// A misspelt key is named with the one that is meant, in every table; another key is not.
    #[test]
    fn a_misspelt_key_is_asked_for() {
        let design = "nominal_diameter = 29e-3\nlead = 7e-3\nball_diameter = 4e-3\nconformity = 0.54\ncontact_angle = 0.785\n";
        for (text, meant) in [
            ("frictoin = 0.1", Some("friction")),
            ("loaded_bals = 71", Some("loaded_balls")),
            ("[limits]\nnut_sped = 300", Some("nut_speed")),
            (
                "[calibration]\nbrakaway_angle = 1e-3",
                Some("breakaway_angle"),
            ),
            ("axial_load = 3e3", None),
            ("colour = 3", None),
        ] {
            let message = read(&format!("{design}{text}\n"), "x").unwrap_err();
            let asked = meant.map(|key| format!("`; did you mean `{key}`? expected one of `"));
            match asked {
                Some(words) => assert!(message.contains(&words), "{message}"),
                None => assert!(!message.contains("did you mean"), "{message}"),
            }
        }
    }
}
