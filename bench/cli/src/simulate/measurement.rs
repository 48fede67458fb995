//! What the columns of the tables are, for measurement files: unit, comment, kind.

use epas_traces::mdf4::write::{Described, Kind};

const fn number(name: &'static str, unit: &'static str, comment: &'static str) -> Described {
    Described {
        name,
        unit,
        comment,
        kind: Kind::Number,
    }
}

const fn count(name: &'static str, comment: &'static str) -> Described {
    Described {
        name,
        unit: "",
        comment,
        kind: Kind::Count,
    }
}

/// Words of [`super::summary::regime_name`].
const REGIMES: &[&str] = &["standing", "driving", "back-driving", "locked"];

/// Every column of a scene or a mechanism, whose unit is the same in all of them.
const COLUMNS: &[Described] = &[
    number("time", "s", "time"),
    number("nut_speed", "rad/s", "speed of the nut"),
    number(
        "axial_load",
        "N",
        "axial load, positive where it opposes the travel that a positive nut speed makes",
    ),
    number("speed", "m/s", "speed of the carriage"),
    number(
        "normal_load",
        "N",
        "load that presses the carriage on the rail",
    ),
    number("side_load", "N", "load across the rail"),
    number("motor_torque", "Nm", "torque of the motor on the nut"),
    number(
        "known_torque",
        "Nm",
        "known effort beside the motor, as a torque on the nut",
    ),
    number("reference_position", "rad", "wanted angle of the nut"),
    number("nut_position", "rad", "angle of the nut"),
    number(
        "friction_torque",
        "Nm",
        "friction at the nut, in the direction of the motion that it opposes",
    ),
    number(
        "load_torque",
        "Nm",
        "torque of the axial load on a screw without friction",
    ),
    number("efficiency", "", "power out over power in"),
    Described {
        name: "regime",
        unit: "",
        comment: "what the screw does",
        kind: Kind::Words(REGIMES),
    },
    count("faults", "bits of the faults that were counted"),
    Described {
        name: "fault_words",
        unit: "",
        comment: "names of the faults that were counted",
        kind: Kind::Flags,
    },
    number("nut_angle", "rad", "angle of the nut, summed up"),
    number("travel", "m", "travel of the carriage, summed up"),
    number("friction_force", "N", "friction of the carriage"),
    count("contacts", "balls that press their neighbour"),
    number(
        "largest_contact_force",
        "N",
        "largest force between two balls",
    ),
    number(
        "reference_friction_torque",
        "Nm",
        "friction torque of the float64 reference",
    ),
    number(
        "reference_efficiency",
        "",
        "efficiency of the float64 reference",
    ),
];

/// Parts of the friction, which are torques at a nut and forces at a carriage.
const PARTS: [(&str, &str); 2] = [
    ("groove_friction", "friction in the grooves"),
    ("ball_friction", "friction between balls"),
];

pub fn described(columns: &[&'static str]) -> Result<Vec<Described>, String> {
    let part = if columns.contains(&"friction_force") {
        "N"
    } else {
        "Nm"
    };
    let one = |name: &&'static str| {
        let plain = COLUMNS.iter().find(|column| column.name == *name).copied();
        let parts = || {
            PARTS
                .iter()
                .find(|(own, _)| own == name)
                .map(|(own, comment)| number(own, part, comment))
        };
        plain
            .or_else(parts)
            .ok_or_else(|| format!("column {name} has no place in a measurement file"))
    };
    columns.iter().map(one).collect()
}

#[cfg(test)]
mod tests {
    use epas_friction::Regime;

    use super::*;
    use crate::simulate::caged::Caged;
    use crate::simulate::linear::Linear;
    use crate::simulate::scene::columns;
    use crate::simulate::summary::regime_name;
    use crate::simulate::uncaged::Uncaged;

    #[test]
    fn every_column_and_regime_has_a_place() {
        for columns in [
            columns::<Caged>(true),
            columns::<Uncaged>(true),
            columns::<Linear>(false),
            crate::simulate::mechanism::columns(true),
        ] {
            assert_eq!(described(&columns).unwrap().len(), columns.len());
        }
        for regime in [
            Regime::Standing,
            Regime::Driving,
            Regime::BackDriving,
            Regime::Locked,
        ] {
            assert!(REGIMES.contains(&regime_name(regime)));
        }
    }
}
