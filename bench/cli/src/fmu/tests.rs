//! The model description, parameters and arguments of units.

use std::collections::BTreeSet;

use clap::{Parser, ValueEnum as _};
use quick_xml::Reader;
use quick_xml::events::Event;

use super::description::{Version, description};
use super::unit::{Stored, Unit};
use super::{Arguments, Causality, Kind, Moment, Running, SceneName};

#[derive(Debug, Parser)]
struct Cli {
    #[command(flatten)]
    fmu: Arguments,
}

const fn design(scene: SceneName) -> &'static str {
    match scene {
        SceneName::Linear | SceneName::LinearWithMemory => "lin-3.3",
        SceneName::Uncaged | SceneName::UncagedWithMemory => "lin-3.6",
        _ => "lin-4.1",
    }
}

fn unit(scene: SceneName) -> Unit {
    Unit::new(scene, &design(scene).parse().unwrap()).unwrap()
}

fn with(unit: &Unit, name: &str, value: f64) -> Vec<f64> {
    let place = unit
        .variables
        .iter()
        .position(|variable| variable.name == name && variable.causality == Causality::Parameter);
    let mut values = unit.starts();
    values[place.unwrap()] = value;
    values
}

fn start(unit: &Unit, values: &[f64]) -> Result<(), String> {
    unit.start(values).map(drop)
}

fn elements(text: &str) -> Vec<(String, Vec<(String, String)>)> {
    let mut reader = Reader::from_str(text);
    let mut found = Vec::new();
    loop {
        match reader.read_event().unwrap() {
            Event::Eof => return found,
            Event::Start(element) | Event::Empty(element) => {
                let attributes = element.attributes().map(|attribute| {
                    let attribute = attribute.unwrap();
                    (
                        attribute.key.as_ref().to_string(),
                        attribute.value.to_string(),
                    )
                });
                let name = element.name().as_ref().to_string();
                found.push((name, attributes.collect()));
            }
            _ => {}
        }
    }
}

#[test]
fn scenes_are_in_order() {
    for (place, (scene, name, _)) in SceneName::ALL.into_iter().enumerate() {
        assert_eq!(scene as usize, place);
        assert_eq!(SceneName::from_str(name, false), Ok(scene));
    }
}

#[test]
fn every_variable_stands_in_the_description_once_with_its_place() {
    for (scene, ..) in SceneName::ALL {
        let unit = unit(scene);
        let names: BTreeSet<_> = unit
            .variables
            .iter()
            .map(|variable| variable.name)
            .collect();
        assert_eq!(names.len(), unit.variables.len(), "{scene:?}");
        for version in [Version::Two, Version::Three] {
            let text = description(&unit, version);
            let references: Vec<(String, usize)> = elements(&text)
                .into_iter()
                .filter_map(|(_, attributes)| {
                    let of = |name: &str| {
                        let pair = attributes.iter().find(|(key, _)| key == name);
                        pair.map(|(_, value)| value.clone())
                    };
                    Some((of("name")?, of("valueReference")?.parse().ok()?))
                })
                .collect();
            let own: Vec<(String, usize)> = unit
                .variables
                .iter()
                .enumerate()
                .map(|(place, variable)| (variable.name.to_owned(), place))
                .collect();
            assert_eq!(references, own, "{scene:?} {version:?}");
        }
    }
}

/// The documentation names the platform whose library is in the file, and the others by FMI's names; a name of a design is text.
#[test]
fn the_documentation_names_its_platforms() {
    let mut unit = unit(SceneName::Caged);
    unit.stored.design = "<b>&gear".into();
    for (version, other) in [
        (Version::Two, "binaries/win64"),
        (Version::Three, "binaries/aarch64-darwin"),
    ] {
        let place = super::library::place(version).unwrap();
        let page = super::documentation::documentation(&unit, version, &place);
        for words in [
            place.as_str(),
            other,
            "--scene caged",
            "design &lt;b&gt;&amp;gear",
        ] {
            assert!(page.contains(words), "{version:?} {words}: {page}");
        }
        assert!(!page.contains("<b>"), "{page}");
    }
}

#[test]
fn start_values_are_the_numbers_of_the_design_to_the_bit() {
    for (scene, ..) in SceneName::ALL {
        let unit = unit(scene);
        for variable in &unit.variables {
            if variable.kind == Kind::Float32 {
                let text = variable.start.to_string();
                let single: f32 = text.parse().unwrap();
                assert_eq!(
                    single.to_bits(),
                    (variable.start as f32).to_bits(),
                    "{scene:?} {}",
                    variable.name
                );
            }
        }
    }
    let unit = unit(SceneName::Caged);
    let friction = unit.variables.iter().find(|known| known.name == "friction");
    assert_eq!(friction.unwrap().start, 0.075);
}

#[test]
fn every_scene_starts_with_its_own_numbers_and_a_stored_unit_is_the_same() {
    for (scene, ..) in SceneName::ALL {
        let unit = unit(scene);
        start(&unit, &unit.starts()).unwrap();
        let text = toml::to_string(&unit.stored).unwrap();
        let stored: Stored = toml::from_str(&text).unwrap();
        let again = Unit::restored(&stored).unwrap();
        assert_eq!(again.token(), unit.token());
        assert_eq!(again.variables, unit.variables);
    }
}

/// A step has every output of the description; from a stored state the same step has the same bits.
#[test]
fn every_scene_steps_and_goes_on_from_its_state() {
    for (scene, ..) in SceneName::ALL {
        let unit = unit(scene);
        let mut model = unit.start(&unit.starts()).unwrap();
        // A motor torque for the mechanism, a speed for the others; the loads; the temperature.
        let linear = [0.2, 500.0, 100.0, 300.0];
        let screw = [5.0, 1000.0, 300.0];
        let inputs = if scene.is_linear() {
            &linear[..]
        } else {
            &screw
        };
        let size = unit.tick(&unit.starts()).unwrap_or(1e-3);
        let step = |model: &mut Box<dyn Running>, number: u32| {
            let time = f64::from(number) * size;
            let moment = Moment {
                inputs,
                time,
                size,
                ticks: 1,
            };
            model.step(&moment).unwrap()
        };
        for number in 0..10 {
            let outputs = step(&mut model, number);
            assert_eq!(outputs.len(), unit.places(Causality::Output).count());
        }
        let state = model.save().unwrap();
        let next = step(&mut model, 10);
        let place = unit.places(Causality::Output).position(|place| {
            let name = unit.variables[place].name;
            name == "friction_torque" || name == "friction_force"
        });
        assert!(next[place.unwrap()] > 0.0, "{scene:?}: {next:?}");
        let mut other = unit.start(&unit.starts()).unwrap();
        other.load(&state).unwrap();
        assert_eq!(step(&mut other, 10), next, "{scene:?}");
    }
}

#[test]
fn a_wrong_parameter_is_told_with_its_value_and_range() {
    for (scene, name, value) in [
        (SceneName::Caged, "friction", -1.0),
        (SceneName::Caged, "loaded_balls", 0.0),
        (SceneName::Caged, "branch", 3.0),
        (SceneName::Caged, "ball_material.density", 0.5),
        (SceneName::Caged, "groove_material.density", 0.5),
        (SceneName::CagedWithMemory, "mean_load", f64::NAN),
        (SceneName::Mechanism, "inertia", 0.0),
        (SceneName::Mechanism, "tick", 2.0),
        (SceneName::Mechanism, "gain", 11.0),
        (SceneName::Uncaged, "tick", 2.0),
        (SceneName::Uncaged, "turns", 0.0),
        (SceneName::Uncaged, "ball_friction", 2.0),
        (SceneName::UncagedWithMemory, "clearance", 1.0),
        (SceneName::Linear, "wavelength", -1.0),
        (SceneName::LinearWithMemory, "mean_load", -1.0),
        (SceneName::CagedWithMemory, "encoder_step", -1.0),
        (SceneName::UncagedWithMemory, "encoder_step", 1.0),
        (SceneName::LinearWithMemory, "encoder_step", f64::NAN),
    ] {
        let unit = unit(scene);
        let message = start(&unit, &with(&unit, name, value)).unwrap_err();
        assert!(
            message.contains(name) && message.contains("allowed"),
            "{scene:?} {name}: {message}"
        );
    }
}

/// What a design file refuses beyond the ranges of the crate, the end of the initialisation refuses too, before it folds.
#[test]
fn a_parameter_that_a_design_file_refuses_is_refused() {
    for (scene, name, value, words) in [
        (SceneName::Caged, "clearance", -3e-5, "4.2 GPa"),
        (SceneName::Caged, "clearance", -1.6e-5, "4.2 GPa"),
        (SceneName::Caged, "lead", 0.0, "is a bearing's"),
        (SceneName::Caged, "lead", 1e-4, "turns would cross"),
        (SceneName::Caged, "lead", 0.19, "lead angle"),
        (SceneName::Caged, "pitch_radius", 0.3, "allowed: 0.01"),
        (
            SceneName::Caged,
            "screw_groove_radius",
            3e-3,
            "0.5005 to 0.7",
        ),
        (SceneName::Uncaged, "clearance", -3e-5, "4.2 GPa"),
        (SceneName::Uncaged, "turns", 11.0, "allowed: 0.1 to 10"),
        (SceneName::Linear, "conformity", 0.75, "0.5005 to 0.7"),
    ] {
        let unit = unit(scene);
        let message = start(&unit, &with(&unit, name, value)).unwrap_err();
        assert!(message.contains(words), "{scene:?} {name}: {message}");
    }
}

#[test]
fn a_design_without_the_scene_is_refused() {
    let refused = |scene, design: &str| {
        let failure = Unit::new(scene, &design.parse().unwrap()).unwrap_err();
        format!("{failure:?}")
    };
    assert!(refused(SceneName::Uncaged, "lin-4.1").contains("lin-3.6"));
    assert!(refused(SceneName::Linear, "lin-4.1").contains("ball screw"));
    assert!(refused(SceneName::Caged, "lin-3.3").contains("linear bearing"));
}

#[test]
fn wrong_arguments_are_refused() {
    let parsed = |arguments: &[&str]| Cli::try_parse_from([&["fmu"], arguments].concat());
    let good = [
        "--scene", "caged", "--design", "lin-4.1", "--output", "a.fmu",
    ];
    assert!(parsed(&good).is_ok());
    assert!(parsed(&["--list"]).is_ok());
    assert!(parsed(&[]).is_err());
    assert!(parsed(&good[..4]).is_err());
    assert!(parsed(&[&good[..], &["--fmi", "1"]].concat()).is_err());
    assert!(parsed(&[&good[..], &["--fmi", "3.0"]].concat()).is_ok());
    let unknown = good.map(|word| if word == "caged" { "efficiency" } else { word });
    assert!(parsed(&unknown).is_err());
}
