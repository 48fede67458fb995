//! Variables of a unit: what a model description lists, and what an instance keeps.

use super::scene::SceneName;
use crate::model::TEMPERATURE;

/// What a variable is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Causality {
    /// Time.
    Independent,
    /// Of the design; fixed once a unit is initialised.
    Parameter,
    /// Set before a step.
    Input,
    /// Told after a step.
    Output,
}

/// What a variable holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A number of double precision.
    Float64,
    /// A number of single precision: what the model computes with.
    Float32,
    /// A whole number.
    Int32,
    /// One of some names.
    Choice(Choice),
}

/// A type of some names, numbered from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Choice {
    /// What a mechanism does.
    Regime,
    /// Which state of a ball friction is computed for.
    Branch,
}

impl Choice {
    /// All of them.
    pub const ALL: [Self; 2] = [Self::Regime, Self::Branch];

    /// Its name.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Regime => "Regime",
            Self::Branch => "Branch",
        }
    }

    /// Its names in their order, with what each means.
    pub const fn items(self) -> &'static [(&'static str, &'static str)] {
        match self {
            Self::Regime => &[
                ("standing", "slower than the reversal speed"),
                ("driving", "the motor moves the load"),
                ("back-driving", "the load turns the nut"),
                (
                    "locked",
                    "no torque moves the load, or the load alone does not sustain the motion",
                ),
            ],
            Self::Branch => &[
                ("contacts", "balance of the ball between elastic grooves"),
                ("rolling", "closed form of a rolling ball"),
                ("sliding", "closed form of a sliding ball"),
            ],
        }
    }
}

/// A variable. Its value reference is its place in the list.
#[derive(Clone, Debug, PartialEq)]
pub struct Variable {
    /// Name, dots between structure and field.
    pub name: &'static str,
    /// What it is for.
    pub causality: Causality,
    /// What it holds.
    pub kind: Kind,
    /// Unit, one of `units`; none for a plain number.
    pub unit: Option<&'static str>,
    /// What it is, in words, with its range where it has one.
    pub about: &'static str,
    /// Value before anything is set.
    pub start: f64,
}

const fn variable(
    causality: Causality,
    kind: Kind,
    name: &'static str,
    unit: Option<&'static str>,
    about: &'static str,
    start: f64,
) -> Variable {
    Variable {
        name,
        causality,
        kind,
        unit,
        about,
        start,
    }
}

pub const TIME: Variable = variable(
    Causality::Independent,
    Kind::Float64,
    "time",
    Some("s"),
    "simulation time",
    0.0,
);

pub const fn parameter(
    kind: Kind,
    name: &'static str,
    unit: Option<&'static str>,
    about: &'static str,
    start: f64,
) -> Variable {
    variable(Causality::Parameter, kind, name, unit, about, start)
}

/// Inputs of a scene, in the order in which it reads them.
pub fn inputs(scene: SceneName) -> Vec<Variable> {
    let input = |name, unit, about, start| {
        variable(
            Causality::Input,
            Kind::Float64,
            name,
            Some(unit),
            about,
            start,
        )
    };
    let mut inputs = if scene.is_linear() {
        vec![
            input("speed", "m/s", "speed of the carriage on the rail", 0.0),
            input(
                "normal_load",
                "N",
                "force that presses the carriage on the row of balls",
                0.0,
            ),
            input("side_load", "N", "force across", 0.0),
        ]
    } else {
        let first = if scene == SceneName::Mechanism {
            input("motor_torque", "N.m", "torque of the motor at the nut", 0.0)
        } else {
            input(
                "nut_speed",
                "rad/s",
                "angular speed of the nut relative to the screw",
                0.0,
            )
        };
        let about = "axial force of the load, positive where it opposes the travel that a positive nut speed makes";
        vec![first, input("axial_load", "N", about, 0.0)]
    };
    if scene.has_memory() {
        inputs.push(input(
            "temperature",
            "K",
            "temperature of the lubricant, 150 to 500",
            TEMPERATURE.into(),
        ));
    }
    inputs
}

fn output(
    kind: Kind,
    name: &'static str,
    unit: Option<&'static str>,
    about: &'static str,
) -> Variable {
    variable(Causality::Output, kind, name, unit, about, 0.0)
}

/// Outputs of a scene, in the order in which it writes them; named as those of the crate and of C.
pub fn outputs(scene: SceneName) -> Vec<Variable> {
    let mut outputs = if scene.is_linear() {
        let about = "force along the rail that overcomes friction, with the sign of the speed where the bearing does not stand";
        vec![output(Kind::Float32, "friction_force", Some("N"), about)]
    } else {
        let friction = "torque about the nut's axis that overcomes friction, with the sign of the nut speed where the nut does not stand";
        let load = "torque about the nut's axis that holds the load without friction";
        let efficiency = "work out over work in, in the direction of motion; 0 without a load, while standing or in a fault, negative where it is locked";
        vec![
            output(Kind::Float32, "friction_torque", Some("N.m"), friction),
            output(Kind::Float32, "load_torque", Some("N.m"), load),
            output(Kind::Float32, "efficiency", None, efficiency),
        ]
    };
    let regime = Kind::Choice(Choice::Regime);
    outputs.push(output(regime, "regime", None, "what the mechanism does"));
    outputs.push(output(Kind::Int32, "faults", None, FAULTS));
    if scene == SceneName::Mechanism {
        let motion = |name, unit, about| output(Kind::Float64, name, Some(unit), about);
        outputs.push(motion("nut_position", "rad", "angle of the nut"));
        outputs.push(motion("nut_speed", "rad/s", "angular speed of the nut"));
    }
    if scene.has_row() {
        outputs.extend(of_row(scene.is_linear()));
    }
    outputs
}

const FAULTS: &str = "what was wrong with the last tick, a sum: 1 speed not finite, 2 load not finite, 4 speed limit, 8 load limit, \
                      16 friction limit, 32 beyond the model, 64 forces between balls not held, 128 angle not valid, 256 temperature out of range";

fn of_row(linear: bool) -> [Variable; 5] {
    let (motion, unit, about) = if linear {
        ("travel", "m", "travel of the carriage")
    } else {
        ("nut_angle", "rad", "angle that the nut has turned by")
    };
    let (groove, ball, friction) = if linear {
        ("groove_force", "ball_force", Some("N"))
    } else {
        ("groove_torque", "ball_torque", Some("N.m"))
    };
    let of_grooves = "part of the friction from the grooves";
    let of_balls = "part of the friction from balls that rub against each other";
    let contacts = "pairs of balls that press on each other";
    let force = "largest force between two balls";
    [
        output(Kind::Float64, motion, Some(unit), about),
        output(Kind::Float32, groove, friction, of_grooves),
        output(Kind::Float32, ball, friction, of_balls),
        output(Kind::Int32, "contacts", None, contacts),
        output(Kind::Float32, "largest_contact_force", Some("N"), force),
    ]
}

/// A unit by the exponents of its base units.
pub struct Known {
    pub name: &'static str,
    /// Base units with their exponents, zeros left out.
    pub exponents: &'static [(&'static str, i8)],
}

pub const UNITS: [Known; 12] = [
    known("s", &[("s", 1)]),
    known("m", &[("m", 1)]),
    known("m/s", &[("m", 1), ("s", -1)]),
    known("rad", &[("rad", 1)]),
    known("rad/s", &[("s", -1), ("rad", 1)]),
    known("N", &[("kg", 1), ("m", 1), ("s", -2)]),
    known("N.m", &[("kg", 1), ("m", 2), ("s", -2)]),
    known("N.m.s/rad", &[("kg", 1), ("m", 2), ("s", -1), ("rad", -1)]),
    known("Pa", &[("kg", 1), ("m", -1), ("s", -2)]),
    known("kg/m3", &[("kg", 1), ("m", -3)]),
    known("kg.m2", &[("kg", 1), ("m", 2)]),
    known("K", &[("K", 1)]),
];

const fn known(name: &'static str, exponents: &'static [(&'static str, i8)]) -> Known {
    Known { name, exponents }
}
