//! What a column or a channel holds: which quantity, of what, in which unit. One table for every file that is read.
//!
//! A CSV file says the unit behind the name (`nut_speed_rpm`) or in brackets (`Nut speed [rpm]`); a measurement file
//! says it in the channel's metadata.

use std::f64::consts::{PI, TAU};

/// What moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// Not said.
    Plain,
    /// The motor's shaft.
    Motor,
    /// The nut.
    Nut,
    /// The carriage, or the rack.
    Carriage,
}

/// What a column holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// Time.
    Time,
    /// Position of a part.
    Position(Part),
    /// Speed of a part.
    Speed(Part),
    /// Wanted position, of the part whose position is measured.
    ReferencePosition,
    /// Force of the motor along the travel.
    MotorForce,
    /// Torque of the motor.
    MotorTorque,
    /// Axial load.
    Load,
    /// The load as its torque.
    LoadTorque,
    /// A force along the travel that is known and is not the motor's.
    KnownForce,
    /// A torque that is known and is not the motor's.
    KnownTorque,
    /// Load that presses a carriage on its rail.
    NormalLoad,
    /// Load across a rail.
    SideLoad,
    /// Temperature.
    Temperature,
}

/// How a unit becomes SI: `factor value + offset`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unit {
    /// What follows the quantity in a column's name.
    pub name: &'static str,
    /// How else it is written, in brackets or in metadata.
    pub spellings: &'static [&'static str],
    /// Factor to SI.
    pub factor: f64,
    /// Added after it.
    pub offset: f64,
    /// What it measures.
    pub dimension: Dimension,
}

/// What a unit measures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Dimension {
    /// The name has no unit: SI.
    Unsaid,
    /// An angle, or its speed.
    Angle,
    /// A length, or its speed.
    Length,
    /// A share of what a motor is rated for.
    Rated,
    /// Anything else.
    Other,
}

impl Unit {
    /// Where no unit is said.
    pub const SI: Self = UNSAID;

    /// A value of the unit in SI.
    pub fn si(self, value: f64) -> f64 {
        if self.factor == 1.0 && self.offset == 0.0 {
            // Adding nothing would take the sign of a zero.
            return value;
        }
        value * self.factor + self.offset
    }

    /// How messages show it.
    pub fn shown(self) -> &'static str {
        self.spellings.first().copied().unwrap_or(self.name)
    }
}

const fn unit(
    name: &'static str,
    spellings: &'static [&'static str],
    factor: f64,
    dimension: Dimension,
) -> Unit {
    Unit {
        name,
        spellings,
        factor,
        offset: 0.0,
        dimension,
    }
}

use Dimension::{Angle, Length, Other, Rated, Unsaid};

const UNSAID: Unit = unit("", &[], 1.0, Unsaid);

const TIME: &[Unit] = &[
    unit("s", &["s", "sec", "second", "seconds"], 1.0, Other),
    unit("ms", &["ms"], 1e-3, Other),
    unit("us", &["us"], 1e-6, Other),
    unit("ns", &["ns"], 1e-9, Other),
];
const POSITION: &[Unit] = &[
    unit("rad", &["rad"], 1.0, Angle),
    unit("mrad", &["mrad"], 1e-3, Angle),
    unit("deg", &["deg", "degree", "degrees"], PI / 180.0, Angle),
    unit("rev", &["rev", "revolutions"], TAU, Angle),
    unit("m", &["m"], 1.0, Length),
    unit("mm", &["mm"], 1e-3, Length),
    unit("um", &["um"], 1e-6, Length),
];
const SPEED: &[Unit] = &[
    unit(
        "rad_s",
        &["rad/s", "rad/sec", "rads^-1", "rads-1"],
        1.0,
        Angle,
    ),
    unit(
        "deg_s",
        &["deg/s", "deg/sec", "degs^-1", "degs-1"],
        PI / 180.0,
        Angle,
    ),
    unit(
        "rpm",
        &[
            "rpm", "1/min", "rev/min", "r/min", "u/min", "min^-1", "min-1",
        ],
        TAU / 60.0,
        Angle,
    ),
    unit("rps", &["rps", "rev/s"], TAU, Angle),
    unit("m_s", &["m/s", "m/sec", "ms^-1"], 1.0, Length),
    unit("mm_s", &["mm/s", "mm/sec"], 1e-3, Length),
    unit("um_s", &["um/s"], 1e-6, Length),
    unit("km_h", &["km/h", "kmh", "kph"], 1.0 / 3.6, Length),
];
const FORCE: &[Unit] = &[
    unit("N", &["N", "newton"], 1.0, Other),
    unit("kN", &["kN"], 1e3, Other),
];
const TORQUE: &[Unit] = &[
    unit("Nm", &["Nm", "N*m", "N.m"], 1.0, Other),
    unit("mNm", &["mNm"], 1e-3, Other),
    unit("percent", &["%"], 1e-2, Rated),
    unit("permille", &["\u{2030}", "1/1000"], 1e-3, Rated),
];
const TEMPERATURE: &[Unit] = &[
    unit("K", &["K", "kelvin"], 1.0, Other),
    Unit {
        name: "C",
        spellings: &["degC", "C", "celsius"],
        factor: 1.0,
        offset: 273.15,
        dimension: Other,
    },
];

const NAMES: &[(&str, Quantity)] = &[
    ("time", Quantity::Time),
    ("timestamps", Quantity::Time),
    ("timestamp", Quantity::Time),
    ("position", Quantity::Position(Part::Plain)),
    ("motor_position", Quantity::Position(Part::Motor)),
    ("nut_position", Quantity::Position(Part::Nut)),
    ("carriage_position", Quantity::Position(Part::Carriage)),
    ("speed", Quantity::Speed(Part::Plain)),
    ("motor_speed", Quantity::Speed(Part::Motor)),
    ("nut_speed", Quantity::Speed(Part::Nut)),
    ("carriage_speed", Quantity::Speed(Part::Carriage)),
    ("reference_position", Quantity::ReferencePosition),
    ("motor_force", Quantity::MotorForce),
    ("motor_torque", Quantity::MotorTorque),
    ("known_force", Quantity::KnownForce),
    ("known_torque", Quantity::KnownTorque),
    ("axial_load", Quantity::Load),
    ("load_torque", Quantity::LoadTorque),
    ("normal_load", Quantity::NormalLoad),
    ("side_load", Quantity::SideLoad),
    ("rack_force", Quantity::Load),
    ("temperature", Quantity::Temperature),
    // Objects of drives after CiA 402, as recorders of motion controllers name them.
    ("position_actual_value", Quantity::Position(Part::Motor)),
    ("position_demand_value", Quantity::ReferencePosition),
    (
        "velocity_actual_value_averaged",
        Quantity::Speed(Part::Motor),
    ),
    ("velocity_actual_value", Quantity::Speed(Part::Motor)),
    ("torque_actual_value_averaged", Quantity::MotorTorque),
    ("torque_actual_value", Quantity::MotorTorque),
];

impl Quantity {
    /// Units that may follow its name.
    pub fn units(self) -> &'static [Unit] {
        match self {
            Self::Time => TIME,
            Self::Position(_) | Self::ReferencePosition => POSITION,
            Self::Speed(_) => SPEED,
            Self::MotorForce
            | Self::Load
            | Self::NormalLoad
            | Self::SideLoad
            | Self::KnownForce => FORCE,
            Self::MotorTorque | Self::LoadTorque | Self::KnownTorque => TORQUE,
            Self::Temperature => TEMPERATURE,
        }
    }
}

impl Quantity {
    /// Units that the quantity of this part can have.
    pub fn accepted(self) -> impl Iterator<Item = Unit> {
        let units = self.units().iter().copied();
        units.filter(move |unit| fits(self, unit.dimension))
    }
}

/// What a column's name says; `None` where it is none of the names. Its unit may stand behind it, or in brackets; capitals,
/// spaces and hyphens count as their plain letters and underscores.
pub fn heading(heading: &str) -> Result<Option<(Quantity, Unit)>, String> {
    let (name, bracketed) = brackets(heading);
    let plain: String = name
        .chars()
        .map(|letter| match letter {
            ' ' | '-' => '_',
            _ => letter,
        })
        .collect();
    let Some((quantity, stem, suffix)) = split(&plain, str::eq_ignore_ascii_case) else {
        return Ok(None);
    };
    match (suffix, bracketed) {
        (None, None) => Ok(Some((quantity, UNSAID))),
        (Some(suffix), None) => known(heading, quantity, stem, suffix).map(Some),
        (None, Some(unit)) => written(quantity, unit)
            .map(|unit| Some((quantity, unit)))
            .map_err(|accepted| {
                format!(
                    "column {}: its unit {unit:?} is not known; known are {accepted}",
                    cut(heading)
                )
            }),
        (Some(suffix), Some(unit)) => match known(heading, quantity, stem, suffix) {
            Ok(own) if written(quantity, unit) == Ok(own.1) => Ok(Some(own)),
            Ok((_, own)) => Err(format!(
                "column {}: its name says {}, and the brackets {}",
                cut(heading),
                own.shown(),
                cut(unit)
            )),
            Err(_) => Ok(None),
        },
    }
}

/// What the name of a channel says, letter by letter; `None` where it is none of the names.
pub fn channel(name: &str) -> Result<Option<(Quantity, Unit)>, String> {
    match split(name, |own, stem| own == stem) {
        None => Ok(None),
        Some((quantity, _, None)) => Ok(Some((quantity, UNSAID))),
        Some((quantity, stem, Some(suffix))) => known(name, quantity, stem, suffix).map(Some),
    }
}

/// The quantity of one of our column names, as a mapping names it.
pub fn quantity(name: &str) -> Option<Quantity> {
    NAMES
        .iter()
        .find(|(own, _)| *own == name)
        .map(|(_, quantity)| *quantity)
}

/// Every name of a column, without units.
pub fn names() -> impl Iterator<Item = &'static str> {
    NAMES.iter().map(|(name, _)| *name)
}

/// The unit that a text stands for, in the ways that units are written.
pub fn written(quantity: Quantity, text: &str) -> Result<Unit, String> {
    let plain = plain(text);
    let units = quantity
        .units()
        .iter()
        .filter(|unit| fits(quantity, unit.dimension));
    let same = |own: &str| {
        // M and m are mega and milli; words may be written in capitals.
        own == plain
            || (own.len() > 2 && !own.starts_with(['m', 'k']) && own.eq_ignore_ascii_case(&plain))
    };
    units
        .clone()
        .find(|unit| unit.name == plain || unit.spellings.iter().any(|own| same(own)))
        .copied()
        .ok_or_else(|| {
            units
                .map(|unit| unit.shown())
                .collect::<Vec<_>>()
                .join(", ")
        })
}

/// A unit with the letters of the table.
fn plain(text: &str) -> String {
    text.trim()
        .replace("\u{b0}", "deg")
        .replace(['\u{b5}', '\u{3bc}'], "u")
        .replace(['\u{b7}', '\u{22c5}', ' '], "")
        .replace('\u{2212}', "-")
        .replace("\u{207b}\u{b9}", "^-1")
}

/// A name, and the unit in brackets behind it.
fn brackets(heading: &str) -> (&str, Option<&str>) {
    let heading = heading.trim();
    for (open, close) in [('(', ')'), ('[', ']')] {
        let inside = heading
            .strip_suffix(close)
            .and_then(|rest| rest.split_once(open));
        if let Some((name, unit)) = inside {
            return (name.trim_end(), Some(unit.trim()));
        }
    }
    (heading, None)
}

/// The quantity of the longest of our names that a name starts with, our name, and what follows.
fn split(
    name: &str,
    same: impl Fn(&str, &str) -> bool,
) -> Option<(Quantity, &'static str, Option<&str>)> {
    let all = NAMES.iter().filter_map(|(stem, quantity)| {
        let own = name.get(..stem.len()).filter(|own| same(own, stem))?;
        let rest = &name[own.len()..];
        match rest.strip_prefix('_') {
            Some(suffix) => Some((*quantity, *stem, Some(suffix))),
            None => rest.is_empty().then_some((*quantity, *stem, None)),
        }
    });
    // A name may start with another one.
    all.max_by_key(|(_, stem, _)| stem.len())
}

fn known(
    name: &str,
    quantity: Quantity,
    stem: &str,
    suffix: &str,
) -> Result<(Quantity, Unit), String> {
    let units = quantity.units().iter();
    units
        .filter(|unit| fits(quantity, unit.dimension))
        .find(|unit| unit.name == suffix)
        .map(|unit| (quantity, *unit))
        .ok_or_else(|| unknown(name, quantity, stem, suffix))
}

/// A name, cut where it is long.
pub fn cut(name: &str) -> String {
    name.chars().take(40).collect()
}

/// Whether a part can be measured so: a shaft and a nut turn, a carriage travels.
fn fits(quantity: Quantity, dimension: Dimension) -> bool {
    match quantity {
        Quantity::Position(part) | Quantity::Speed(part) => match part {
            Part::Plain => true,
            Part::Motor | Part::Nut => dimension != Length,
            Part::Carriage => dimension != Angle,
        },
        Quantity::LoadTorque => dimension != Rated,
        _ => true,
    }
}

fn unknown(name: &str, quantity: Quantity, stem: &str, suffix: &str) -> String {
    let shown = cut(name);
    if suffix == "counts" {
        return format!(
            "column {shown}: counts are no unit without the sensor's counts of a turn; give the position in rad or deg"
        );
    }
    let units: Vec<String> = quantity
        .units()
        .iter()
        .filter(|unit| fits(quantity, unit.dimension))
        .map(|unit| format!("{stem}_{}", unit.name))
        .collect();
    format!(
        "column {shown}: it starts like {stem}, but ends in no unit that is known; known are {stem} (SI), {}",
        units.join(", ")
    )
}

#[cfg(test)]
mod tests;
