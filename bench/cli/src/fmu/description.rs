//! The model description of a unit, `modelDescription.xml`, for FMI 2.0 and 3.0.

use std::io;

use quick_xml::Writer;
use quick_xml::events::{BytesDecl, Event};

use super::unit::Unit;
use super::variables::{Causality, Choice, Kind, UNITS, Variable};

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Version {
    Two,
    Three,
}

/// Name of the shared library in a unit's file, without its ending.
pub const LIBRARY: &str = "epas_friction";

type Xml = Writer<Vec<u8>>;

type Attributes<'a> = Vec<(&'a str, String)>;

fn element(
    xml: &mut Xml,
    name: &str,
    attributes: &Attributes<'_>,
    inner: impl FnOnce(&mut Xml) -> io::Result<()>,
) -> io::Result<()> {
    let pairs = attributes
        .iter()
        .map(|(name, value)| (*name, value.as_str()));
    xml.create_element(name)
        .with_attributes(pairs)
        .write_inner_content(inner)?;
    Ok(())
}

fn empty(xml: &mut Xml, name: &str, attributes: &Attributes<'_>) -> io::Result<()> {
    let pairs = attributes
        .iter()
        .map(|(name, value)| (*name, value.as_str()));
    xml.create_element(name)
        .with_attributes(pairs)
        .write_empty()?;
    Ok(())
}

pub fn description(unit: &Unit, version: Version) -> String {
    let mut xml = Writer::new_with_indent(Vec::new(), b' ', 2);
    // Nothing fails that writes into memory.
    let _ = xml.write_event(Event::Decl(BytesDecl::new("1.0", Some("UTF-8"), None)));
    let _ = whole(&mut xml, unit, version);
    String::from_utf8_lossy(&xml.into_inner()).into_owned()
}

fn whole(xml: &mut Xml, unit: &Unit, version: Version) -> io::Result<()> {
    element(xml, "fmiModelDescription", &model(unit, version), |xml| {
        empty(xml, "CoSimulation", &capabilities(version))?;
        units(xml, unit)?;
        types(xml, unit, version)?;
        element(xml, "LogCategories", &Vec::new(), |xml| {
            for (name, about) in [
                ("logStatusWarning", "inputs that the model has flagged"),
                ("logStatusError", "calls and values that are refused"),
            ] {
                let attributes = vec![("name", name.to_owned()), ("description", about.to_owned())];
                empty(xml, "Category", &attributes)?;
            }
            Ok(())
        })?;
        let step = unit.tick(&unit.starts()).unwrap_or(1e-3).to_string();
        let experiment = vec![("startTime", "0".to_owned()), ("stepSize", step)];
        empty(xml, "DefaultExperiment", &experiment)?;
        element(xml, "ModelVariables", &Vec::new(), |xml| {
            for (place, known) in unit.variables.iter().enumerate() {
                variable(xml, place, known, version)?;
            }
            Ok(())
        })?;
        structure(xml, unit, version)
    })
}

fn model(unit: &Unit, version: Version) -> Attributes<'static> {
    let scene = unit.stored.scene;
    let (number, token) = match version {
        Version::Two => ("2.0", "guid"),
        Version::Three => ("3.0", "instantiationToken"),
    };
    let about = format!(
        "Friction of a {}; design {}",
        scene.about(),
        unit.stored.design
    );
    let tool = format!("epas {}", env!("CARGO_PKG_VERSION"));
    vec![
        ("fmiVersion", number.to_owned()),
        ("modelName", format!("epas-friction {}", scene.name())),
        (token, unit.token()),
        ("description", about),
        ("version", env!("CARGO_PKG_VERSION").to_owned()),
        ("license", "MIT OR Apache-2.0".to_owned()),
        ("generationTool", tool),
        ("variableNamingConvention", "structured".to_owned()),
    ]
}

fn capabilities(version: Version) -> Attributes<'static> {
    let [get, serialise] = match version {
        Version::Two => ["canGetAndSetFMUstate", "canSerializeFMUstate"],
        Version::Three => ["canGetAndSetFMUState", "canSerializeFMUState"],
    };
    vec![
        ("modelIdentifier", LIBRARY.to_owned()),
        ("canHandleVariableCommunicationStepSize", "true".to_owned()),
        (get, "true".to_owned()),
        (serialise, "true".to_owned()),
    ]
}

fn units(xml: &mut Xml, unit: &Unit) -> io::Result<()> {
    let used = UNITS.iter().filter(|known| {
        unit.variables
            .iter()
            .any(|variable| variable.unit == Some(known.name))
    });
    element(xml, "UnitDefinitions", &Vec::new(), |xml| {
        for known in used {
            let name = vec![("name", known.name.to_owned())];
            element(xml, "Unit", &name, |xml| {
                let base: Attributes<'_> = known
                    .exponents
                    .iter()
                    .map(|(name, exponent)| (*name, exponent.to_string()))
                    .collect();
                empty(xml, "BaseUnit", &base)
            })?;
        }
        Ok(())
    })
}

fn types(xml: &mut Xml, unit: &Unit, version: Version) -> io::Result<()> {
    let used = Choice::ALL.into_iter().filter(|choice| {
        unit.variables
            .iter()
            .any(|variable| variable.kind == Kind::Choice(*choice))
    });
    element(xml, "TypeDefinitions", &Vec::new(), |xml| {
        for choice in used {
            let name = vec![("name", choice.name().to_owned())];
            let items = |xml: &mut Xml| {
                for (value, (name, about)) in choice.items().iter().enumerate() {
                    let attributes = vec![
                        ("name", (*name).to_owned()),
                        ("value", value.to_string()),
                        ("description", (*about).to_owned()),
                    ];
                    empty(xml, "Item", &attributes)?;
                }
                Ok(())
            };
            match version {
                Version::Two => element(xml, "SimpleType", &name, |xml| {
                    element(xml, "Enumeration", &Vec::new(), items)
                })?,
                Version::Three => element(xml, "EnumerationType", &name, items)?,
            }
        }
        Ok(())
    })
}

fn roles(variable: &Variable) -> Attributes<'static> {
    let number = matches!(variable.kind, Kind::Float64 | Kind::Float32);
    let changing = if number { "continuous" } else { "discrete" };
    let (causality, variability, initial) = match variable.causality {
        Causality::Independent => ("independent", "continuous", None),
        Causality::Parameter => ("parameter", "fixed", Some("exact")),
        Causality::Input => ("input", changing, None),
        Causality::Output => ("output", changing, Some("exact")),
    };
    let mut roles = vec![
        ("causality", causality.to_owned()),
        ("variability", variability.to_owned()),
    ];
    roles.extend(initial.map(|initial| ("initial", initial.to_owned())));
    roles
}

fn start(variable: &Variable) -> Option<(&'static str, String)> {
    (variable.causality != Causality::Independent).then(|| ("start", variable.start.to_string()))
}

fn variable(xml: &mut Xml, place: usize, variable: &Variable, version: Version) -> io::Result<()> {
    let mut attributes = vec![
        ("name", variable.name.to_owned()),
        ("valueReference", place.to_string()),
        ("description", variable.about.to_owned()),
    ];
    attributes.extend(roles(variable));
    let mut typed: Attributes<'_> = Vec::new();
    let name = match (variable.kind, version) {
        (Kind::Choice(choice), _) => {
            typed.push(("declaredType", choice.name().to_owned()));
            "Enumeration"
        }
        (Kind::Float64 | Kind::Float32, Version::Two) => "Real",
        (Kind::Int32, Version::Two) => "Integer",
        (Kind::Float64, Version::Three) => "Float64",
        (Kind::Float32, Version::Three) => "Float32",
        (Kind::Int32, Version::Three) => "Int32",
    };
    typed.extend(variable.unit.map(|unit| ("unit", unit.to_owned())));
    typed.extend(start(variable));
    match version {
        Version::Two => element(xml, "ScalarVariable", &attributes, |xml| {
            empty(xml, name, &typed)
        }),
        Version::Three => empty(xml, name, &[attributes, typed].concat()),
    }
}

/// Outputs follow inputs of a step before, and the state: dependencies are left to the default, all.
fn structure(xml: &mut Xml, unit: &Unit, version: Version) -> io::Result<()> {
    element(xml, "ModelStructure", &Vec::new(), |xml| {
        let outputs = |xml: &mut Xml| {
            for place in unit.places(Causality::Output) {
                match version {
                    // Counted from 1.
                    Version::Two => {
                        empty(xml, "Unknown", &vec![("index", (place + 1).to_string())])?;
                    }
                    Version::Three => {
                        empty(xml, "Output", &vec![("valueReference", place.to_string())])?;
                    }
                }
            }
            Ok(())
        };
        match version {
            Version::Two => element(xml, "Outputs", &Vec::new(), outputs),
            Version::Three => outputs(xml),
        }
    })
}
