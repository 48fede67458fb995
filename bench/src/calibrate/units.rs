//! What a column's name says: which quantity, of what, in which unit.

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
    /// Temperature.
    Temperature,
}

/// How a unit becomes SI: `factor value + offset`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unit {
    /// What follows the quantity in a column's name.
    pub name: &'static str,
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
    /// Anything else.
    Other,
}

const fn unit(name: &'static str, factor: f64, dimension: Dimension) -> Unit {
    Unit {
        name,
        factor,
        offset: 0.0,
        dimension,
    }
}

use Dimension::{Angle, Length, Other, Unsaid};

const TIME: &[Unit] = &[
    unit("s", 1.0, Other),
    unit("ms", 1e-3, Other),
    unit("us", 1e-6, Other),
    unit("ns", 1e-9, Other),
];
const POSITION: &[Unit] = &[
    unit("rad", 1.0, Angle),
    unit("mrad", 1e-3, Angle),
    unit("deg", PI / 180.0, Angle),
    unit("rev", TAU, Angle),
    unit("m", 1.0, Length),
    unit("mm", 1e-3, Length),
    unit("um", 1e-6, Length),
];
const SPEED: &[Unit] = &[
    unit("rad_s", 1.0, Angle),
    unit("deg_s", PI / 180.0, Angle),
    unit("rpm", TAU / 60.0, Angle),
    unit("rps", TAU, Angle),
    unit("m_s", 1.0, Length),
    unit("mm_s", 1e-3, Length),
    unit("um_s", 1e-6, Length),
];
const FORCE: &[Unit] = &[unit("N", 1.0, Other), unit("kN", 1e3, Other)];
const TORQUE: &[Unit] = &[unit("Nm", 1.0, Other), unit("mNm", 1e-3, Other)];
const TEMPERATURE: &[Unit] = &[
    unit("K", 1.0, Other),
    Unit {
        name: "C",
        factor: 1.0,
        offset: 273.15,
        dimension: Other,
    },
];

/// Every name without a unit. A longer name stands before one that it starts with.
const NAMES: &[(&str, Quantity)] = &[
    ("time", Quantity::Time),
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
    ("axial_load", Quantity::Load),
    ("rack_force", Quantity::Load),
    ("temperature", Quantity::Temperature),
];

impl Quantity {
    /// Units that may follow its name.
    pub fn units(self) -> &'static [Unit] {
        match self {
            Self::Time => TIME,
            Self::Position(_) | Self::ReferencePosition => POSITION,
            Self::Speed(_) => SPEED,
            Self::MotorForce | Self::Load => FORCE,
            Self::MotorTorque => TORQUE,
            Self::Temperature => TEMPERATURE,
        }
    }
}

/// What a column's name says; `None` where it is none of the names.
///
/// # Errors
/// A name that goes on with what is no unit of its quantity.
pub fn column(name: &str) -> Result<Option<(Quantity, Unit)>, String> {
    for (stem, quantity) in NAMES {
        let Some(rest) = name.strip_prefix(stem) else {
            continue;
        };
        if rest.is_empty() {
            return Ok(Some((*quantity, unit("", 1.0, Unsaid))));
        }
        let Some(suffix) = rest.strip_prefix('_') else {
            continue;
        };
        let known = quantity.units().iter().find(|unit| unit.name == suffix);
        return match known {
            Some(unit) if fits(*quantity, unit.dimension) => Ok(Some((*quantity, *unit))),
            _ => Err(unknown(name, *quantity, stem, suffix)),
        };
    }
    Ok(None)
}

/// Whether a part can be measured so: a shaft and a nut turn, a carriage travels.
fn fits(quantity: Quantity, dimension: Dimension) -> bool {
    match quantity {
        Quantity::Position(part) | Quantity::Speed(part) => match part {
            Part::Plain => true,
            Part::Motor | Part::Nut => dimension != Length,
            Part::Carriage => dimension != Angle,
        },
        _ => true,
    }
}

fn unknown(name: &str, quantity: Quantity, stem: &str, suffix: &str) -> String {
    let shown: String = name.chars().take(40).collect();
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
mod tests {
    use super::*;

    #[test]
    fn names_say_quantity_and_unit() {
        for (name, quantity, one) in [
            ("time", Quantity::Time, 1.0),
            ("time_ms", Quantity::Time, 1e-3),
            (
                "nut_position_deg",
                Quantity::Position(Part::Nut),
                PI / 180.0,
            ),
            ("motor_speed_rpm", Quantity::Speed(Part::Motor), PI / 30.0),
            ("position_um", Quantity::Position(Part::Plain), 1e-6),
            ("carriage_speed_mm_s", Quantity::Speed(Part::Carriage), 1e-3),
            ("motor_torque_mNm", Quantity::MotorTorque, 1e-3),
            ("motor_force", Quantity::MotorForce, 1.0),
            ("axial_load_kN", Quantity::Load, 1e3),
            ("rack_force", Quantity::Load, 1.0),
            ("temperature_C", Quantity::Temperature, 274.15),
            ("temperature_K", Quantity::Temperature, 1.0),
            ("reference_position_mm", Quantity::ReferencePosition, 1e-3),
        ] {
            let (found, unit) = column(name).unwrap().unwrap();
            assert_eq!(found, quantity, "{name}");
            let value = unit.factor + unit.offset;
            assert!((value - one).abs() <= 1e-15 * one, "{name}: {value}");
        }
    }

    #[test]
    fn other_names_are_left_alone_and_wrong_units_refused() {
        for name in ["gear", "", "steering_angle", "positions", "timer", "Time"] {
            assert_eq!(column(name), Ok(None), "{name}");
        }
        for (name, word) in [
            ("nut_position_counts", "counts of a turn"),
            ("nut_position_mm", "nut_position_deg"),
            ("carriage_position_deg", "carriage_position_mm"),
            ("motor_torque_Ncm", "motor_torque_mNm"),
            ("temperature_F", "temperature_C"),
            ("time_h", "time_ms"),
        ] {
            let message = column(name).unwrap_err();
            assert!(message.contains(word), "{message}");
        }
    }
}
