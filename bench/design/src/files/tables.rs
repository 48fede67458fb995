//! What design files of screws and of bearings have in common.

use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

use epas_friction::{GrooveSize, Material};
use serde::Deserialize;
use serde::de::DeserializeOwned;

use super::plausible;
use crate::Failure;

/// Elastic constants and density of a body, as they are written.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MaterialTable {
    /// Young's modulus, Pa.
    pub youngs_modulus: Option<f32>,
    pub poisson_ratio: Option<f32>,
    pub density: Option<f32>,
}

/// Largest design file, bytes: a hundred times what one needs.
const LARGEST_FILE: u64 = 1 << 18;

pub fn text_of(path: &Path) -> Result<String, Failure> {
    let name = path.display();
    let opened = if standard(path) {
        Ok(Box::new(io::stdin()) as Box<dyn Read>)
    } else {
        File::open(path).map(|file| Box::new(file) as Box<dyn Read>)
    };
    let input = opened.map_err(|error| Failure::Domain(format!("cannot open {name}: {error}")))?;
    let mut text = String::new();
    let read = input.take(LARGEST_FILE + 1).read_to_string(&mut text);
    match read {
        Ok(_) if text.len() as u64 > LARGEST_FILE => Err(Failure::Domain(format!(
            "cannot read {name}: it is larger than {LARGEST_FILE} bytes"
        ))),
        Ok(_) => Ok(text),
        Err(error) if error.kind() == io::ErrorKind::InvalidData => Err(Failure::Domain(format!(
            "{name}: this is not UTF-8; save the file as UTF-8 (> in a PowerShell writes UTF-16)"
        ))),
        Err(error) => Err(Failure::Domain(format!("cannot read {name}: {error}"))),
    }
}

/// Whether a path is standard input.
pub fn standard(path: &Path) -> bool {
    path.as_os_str() == "-"
}

/// Whether a file's name ends in one of these, in letters of either case.
pub fn ends(path: &Path, endings: &[&str]) -> bool {
    path.extension()
        .is_some_and(|own| endings.iter().any(|one| own.eq_ignore_ascii_case(one)))
}

pub fn from_text<Table: DeserializeOwned, Made>(
    path: &Path,
    text: &str,
    design: impl FnOnce(Table, &str) -> Result<Made, String>,
) -> Result<Made, Failure> {
    let failure = |message: String| Failure::Domain(format!("{}: {message}", path.display()));
    let file: Table = parsed(text).map_err(failure)?;
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    design(file, &stem).map_err(failure)
}

/// A design file's keys. What is wrong is said in a file's words, without a key that is none any more.
pub fn parsed<Table: DeserializeOwned>(text: &str) -> Result<Table, String> {
    // The parser takes an array for a table, by position, and a number beyond single precision for an infinite one.
    let values: toml::Table = text
        .parse()
        .map_err(|error: toml::de::Error| in_words(&error))?;
    for (key, value) in &values {
        readable(key, value)?;
    }
    toml::from_str(text).map_err(|error| in_words(&error))
}

const TABLES: [&str; 9] = [
    "screw_groove",
    "nut_groove",
    "ball_material",
    "groove_material",
    "limits",
    "uncaged",
    "loads",
    "fold",
    "calibration",
];

/// Refuses what is no table in the place of one, and a number that single precision does not hold.
fn readable(key: &str, value: &toml::Value) -> Result<(), String> {
    let is_table = TABLES.contains(&key);
    match value {
        toml::Value::Array(values)
            if is_table && !values.is_empty() && values.iter().all(toml::Value::is_table) =>
        {
            Err(format!(
                "{key} is a table: write [{key}], not an array of tables [[{key}]]"
            ))
        }
        toml::Value::Table(table) => table
            .iter()
            .try_for_each(|(key, value)| readable(key, value)),
        _ if is_table => Err(format!(
            "{key} is a table: write [{key}], and its keys below"
        )),
        toml::Value::Array(values) => {
            if values.iter().any(toml::Value::is_array) {
                return Err(format!(
                    "{key} = [[...]] is a list in a list; a wave is a table, such as {{ order = 2, sine = 0.01 }}"
                ));
            }
            values.iter().try_for_each(|value| readable(key, value))
        }
        toml::Value::Float(number) if number.is_finite() && number.abs() > f64::from(f32::MAX) => {
            Err(format!(
                "{key} = {number:e} is out of range; allowed: -3.4e38 to 3.4e38, what single precision holds"
            ))
        }
        _ => Ok(()),
    }
}

/// What a value has to be, without the names of this program's types.
const TYPES: [(&str, &str); 8] = [
    ("u8", "a whole number, 0 to 255"),
    ("u16", "a whole number, 0 to 65535"),
    ("u32", "a whole number, 0 to 4294967295"),
    ("f32", "a number"),
    ("f64", "a number"),
    (
        "struct Wavelet",
        "a wave, such as { order = 2, sine = 0.01 }",
    ),
    ("a sequence", "a list"),
    ("a string", "a text in quotes"),
];

fn in_words(error: &toml::de::Error) -> String {
    let said = error.to_string();
    let said = asked_for_key(said.trim_end().replace("`fit`, ", ""));
    let said = said
        .replace("invalid type: sequence", "invalid type: a list")
        .replace("invalid type: map", "invalid type: a table");
    if let Some((before, wanted)) = said.rsplit_once("expected ") {
        if let Some((_, words)) = TYPES.iter().find(|(own, _)| *own == wanted) {
            return format!("{before}expected {words}");
        }
        if wanted.starts_with("struct ") {
            return format!("{before}expected a table");
        }
    }
    // The line that the parser shows, as `7 | friction = 0,1`.
    let comma = said.lines().any(|line| {
        let value = line.split_once('=').map_or("", |(_, value)| value.trim());
        value.split_once(',').is_some_and(|(whole, parts)| {
            [whole, parts]
                .iter()
                .all(|digits| digits.trim_start_matches('-').parse::<u64>().is_ok())
        })
    });
    let hint = if comma {
        "; a decimal point stands in the place of a comma"
    } else {
        ""
    };
    format!("{said}{hint}")
}

/// The refusal of an unknown key, with the allowed one that it is a misspelling of.
fn asked_for_key(said: String) -> String {
    const UNKNOWN: &str = "unknown field `";
    let Some((before, rest)) = said.split_once(UNKNOWN) else {
        return said;
    };
    let mut names = rest.split('`').step_by(2);
    let key = names.next().unwrap_or_default();
    let Some(meant) = plausible::misspelt(key, names) else {
        return said;
    };
    let rest = rest.replacen(
        "`, expected",
        &format!("`; did you mean `{meant}`? expected"),
        1,
    );
    format!("{before}{UNKNOWN}{rest}")
}

/// Puts a given value in the place of another one.
pub fn replace<T>(value: &mut T, given: Option<T>) {
    if let Some(given) = given {
        *value = given;
    }
}

/// The word behind a setting that its file leaves to the default.
pub fn mark(defaulted: &[&str], key: &str) -> &'static str {
    if defaulted.contains(&key) {
        " (default)"
    } else {
        ""
    }
}

pub fn radius(
    (radius_field, radius): (&str, Option<f32>),
    (diameter_field, diameter): (&str, Option<f32>),
) -> Result<f32, String> {
    match (radius, diameter) {
        (Some(radius), None) => Ok(radius),
        (None, Some(diameter)) => Ok(0.5 * diameter),
        (None, None) => Err(format!("{radius_field} or {diameter_field} is missing")),
        (Some(_), Some(_)) => Err(format!(
            "{radius_field} and {diameter_field} are both given; one of them follows from the other"
        )),
    }
}

pub fn groove_size(
    name: &str,
    conformity: Option<f32>,
    groove_radius: Option<f32>,
) -> Result<GrooveSize, String> {
    match (conformity, groove_radius) {
        (Some(conformity), None) => Ok(GrooveSize::Conformity(conformity)),
        (None, Some(radius)) => Ok(GrooveSize::Radius(radius)),
        (None, None) => Err(format!("{name}: conformity or groove_radius is missing")),
        (Some(_), Some(_)) => Err(format!(
            "{name}: conformity and groove_radius are both given; one of them follows from the other"
        )),
    }
}

/// A body's own constants, those given for both, or steel's.
pub fn material(own: Option<&MaterialTable>, common: &MaterialTable) -> Material {
    let pick = |of: fn(&MaterialTable) -> Option<f32>, steel: f32| {
        own.and_then(of).or_else(|| of(common)).unwrap_or(steel)
    };
    let steel = Material::STEEL;
    Material {
        youngs_modulus: pick(|table| table.youngs_modulus, steel.youngs_modulus),
        poisson_ratio: pick(|table| table.poisson_ratio, steel.poisson_ratio),
        density: pick(|table| table.density, steel.density),
    }
}
