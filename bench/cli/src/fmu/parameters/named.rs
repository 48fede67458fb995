//! What parameters of a screw and of a bearing have in common: values by names, and lists of them.

use epas_friction::{Error, GrooveSize, Material};

use crate::fmu::variables::{Causality, Kind, Variable, parameter};

pub struct Values<'a> {
    pub variables: &'a [Variable],
    pub values: &'a [f64],
}

impl Values<'_> {
    /// A parameter's value; NaN where there is none, which every range refuses.
    pub fn of(&self, name: &str) -> f64 {
        let mut pairs = self.variables.iter().zip(self.values);
        pairs
            .find(|(variable, _)| {
                variable.name == name && variable.causality == Causality::Parameter
            })
            .map_or(f64::NAN, |(_, value)| *value)
    }

    pub fn single(&self, name: &str) -> f32 {
        self.of(name) as f32
    }

    pub fn within(&self, name: &str, low: f64, high: f64) -> Result<f64, String> {
        let value = self.of(name);
        if (low..=high).contains(&value) {
            Ok(value)
        } else {
            Err(format!(
                "{name} = {value} is out of range; allowed: {low} to {high}"
            ))
        }
    }
}

pub struct MaterialNames([&'static str; 3]);

pub const BALL: MaterialNames = MaterialNames([
    "ball_material.youngs_modulus",
    "ball_material.poisson_ratio",
    "ball_material.density",
]);

/// Of screw and nut, or of rail and carriage.
pub const GROOVE: MaterialNames = MaterialNames([
    "groove_material.youngs_modulus",
    "groove_material.poisson_ratio",
    "groove_material.density",
]);

impl MaterialNames {
    pub fn list(&self, list: &mut Vec<Variable>, material: &Material) {
        let [modulus, ratio, density] = self.0;
        let about = [
            "Young's modulus, 1e6 to 1e13",
            "Poisson's ratio, 0 to 0.5",
            "density, 1 to 1e5",
        ];
        self::list(
            list,
            [
                (modulus, Some("Pa"), about[0], material.youngs_modulus),
                (ratio, None, about[1], material.poisson_ratio),
                (density, Some("kg/m3"), about[2], material.density),
            ],
        );
    }

    pub fn of(&self, values: &Values<'_>) -> Material {
        let [youngs_modulus, poisson_ratio, density] = self.0.map(|name| values.single(name));
        Material {
            youngs_modulus,
            poisson_ratio,
            density,
        }
    }
}

pub struct GrooveNames([&'static str; 2]);

pub const SCREW: GrooveNames = GrooveNames(["screw_conformity", "screw_groove_radius"]);
pub const NUT: GrooveNames = GrooveNames(["nut_conformity", "nut_groove_radius"]);
pub const BOTH: GrooveNames = GrooveNames(["conformity", "groove_radius"]);

impl GrooveNames {
    /// The size as the design has it: the one follows from the other only to rounding.
    pub fn list(&self, list: &mut Vec<Variable>, size: GrooveSize) {
        let [conformity, radius] = self.0;
        let row = match size {
            GrooveSize::Conformity(value) => {
                let about = "groove radius over ball diameter, 0.5005 to 0.7";
                (conformity, None, about, value)
            }
            GrooveSize::Radius(value) => {
                let about = "groove radius, 0.5005 to 0.7 ball diameters";
                (radius, Some("m"), about, value)
            }
        };
        self::list(list, [row]);
    }

    pub fn of(&self, values: &Values<'_>, as_in: GrooveSize) -> GrooveSize {
        let [conformity, radius] = self.0;
        match as_in {
            GrooveSize::Conformity(_) => GrooveSize::Conformity(values.single(conformity)),
            GrooveSize::Radius(_) => GrooveSize::Radius(values.single(radius)),
        }
    }
}

/// A parameter's name, unit, meaning with its range, and start.
pub type Row = (&'static str, Option<&'static str>, &'static str, f32);

pub fn list<const N: usize>(l: &mut Vec<Variable>, rows: [Row; N]) {
    for (name, unit, about, start) in rows {
        // The shortest text of the number stands in a model description, and is read in double precision.
        let start = start.to_string().parse().unwrap_or(f64::from(start));
        l.push(parameter(Kind::Float32, name, unit, about, start));
    }
}

pub fn named(error: &Error, ball: &Material) -> String {
    let text = error.to_string();
    let own = [
        ("youngs_modulus", ball.youngs_modulus),
        ("poisson_ratio", ball.poisson_ratio),
        ("density", ball.density),
    ];
    // The crate checks the balls' first.
    match own.iter().find(|(field, _)| *field == error.field()) {
        Some((_, value)) if value.to_bits() == error.value().to_bits() => {
            format!("ball_material.{text}")
        }
        Some(_) => format!("groove_material.{text}"),
        None => text,
    }
}
