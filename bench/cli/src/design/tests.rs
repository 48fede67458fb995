//! A block in every format, and what is said of it.

use std::fs;

use epas_friction::scene::{CagedBallScrew, CagedConstants};
use epas_friction::{FrictionModel, Inputs};
use serde_json::Value;

use super::*;

#[test]
fn a_constant_is_named_after_its_file() {
    for (name, wanted) in [
        ("gear", "GEAR"),
        ("lin-4.1", "LIN_4_1"),
        ("29x7x4", "GEAR_29X7X4"),
        ("größe", "GR_E"),
        ("_ä", "GEAR"),
        ("-", "GEAR"),
        ("", "GEAR"),
    ] {
        assert_eq!(constant(name.as_ref()), wanted);
    }
}

const DESIGN: &str = "friction = 0.1\nnominal_diameter = 0.028\nlead = 0.007\nball_diameter = 3.969e-3\nconformity = 0.54\n\
                      contact_angle = 0.7853982\nclearance = 0\nloaded_balls = 60\n";

fn design(more: &str) -> Design {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("screw.toml");
    fs::write(&path, format!("{DESIGN}{more}")).unwrap();
    let source: DesignSource = path.to_str().unwrap().parse().unwrap();
    source.load().unwrap()
}

/// A deviation in the table says that balls press, and needs no row of balls; what is asked for by name is what is folded.
#[test]
fn a_deviation_in_the_table_says_that_balls_press() {
    for (more, asked, pressing) in [
        ("", None, false),
        ("[fold]\nnut_deviation = 1e-3\n", None, true),
        ("[fold]\nscrew_deviation = 1e-3\n", None, true),
        (
            "[fold]\nscrew_deviation = 1e-3\n",
            Some(Scene::Caged),
            false,
        ),
        ("", Some(Scene::Uncaged), true),
    ] {
        let chosen = chosen(&design(more).fold, asked);
        assert_eq!(matches!(chosen, Scene::Uncaged), pressing, "{more}");
    }
}

/// Words of a text form: each is written as `0x` and eight digits.
fn words(text: &str) -> Vec<u32> {
    text.split(|letter: char| !letter.is_ascii_alphanumeric())
        .filter_map(|word| u32::from_str_radix(word.strip_prefix("0x")?, 16).ok())
        .collect()
}

/// Every format holds the same words; what they say is what `--json` says.
#[test]
fn every_format_is_the_same_block() {
    let made = made(&design(""), None, false).unwrap();
    let block = made.words().unwrap();
    let written = |format| made.written(format, "GEAR").unwrap();
    let text = |format| String::from_utf8(written(format)).unwrap();
    let bytes: Vec<u8> = block.iter().flat_map(|word| word.to_le_bytes()).collect();
    assert_eq!(written(Format::Binary), bytes);
    let read: toml::Table = text(Format::Toml).parse().unwrap();
    let listed: Vec<i64> = read["words"]
        .as_array()
        .unwrap()
        .iter()
        .map(|word| word.as_integer().unwrap())
        .collect();
    assert_eq!(
        listed,
        block.iter().map(|&word| word.into()).collect::<Vec<i64>>()
    );
    for (format, name) in [
        (Format::Rust, "pub static GEAR: "),
        (Format::C, "GEAR_BLOCK["),
    ] {
        assert_eq!(words(&text(format)), block);
        for words in [
            name,
            "certificate: caged_torque",
            read["digest"].as_str().unwrap(),
        ] {
            assert!(text(format).contains(words), "{words}");
        }
    }

    let constants = CagedConstants::<1>::from_block(&block).unwrap();
    let mut model = FrictionModel::<CagedBallScrew, _>::of(&constants);
    let outputs = model.step(Inputs {
        nut_speed: 50.0,
        axial_load: 6_000.0,
    });
    assert!(outputs.friction_torque > 0.1 && !outputs.faults.any());
    said_of(
        &serde_json::to_value(made.shown().unwrap()).unwrap(),
        &block,
        &read["digest"],
    );
}

fn said_of(said: &Value, block: &[u32], digest: &toml::Value) {
    let number = |value: &Value| value.as_f64().unwrap();
    let mut wanted = [
        "version",
        "digest",
        "bytes",
        "domain",
        "certificate",
        "seed",
        "two_answers",
        "unsolved",
        "seconds",
    ];
    wanted.sort_unstable();
    let mut keys: Vec<&str> = said
        .as_object()
        .unwrap()
        .keys()
        .map(String::as_str)
        .collect();
    keys.sort_unstable();
    assert_eq!(keys, wanted);
    assert_eq!(said["version"], block[1]);
    assert_eq!(said["bytes"], 4 * block.len());
    assert_eq!(said["digest"], digest.as_str().unwrap());
    assert_eq!(
        said["domain"]["axial_load"],
        serde_json::json!([5.0, 300.0])
    );
    let friction = &said["domain"]["friction"];
    assert!((number(&friction[0]) - 0.1).abs() < 1e-8 && friction[0] == friction[1]);
    let figure = &said["certificate"][0];
    assert_eq!(
        (&figure["quantity"], &figure["unit"]),
        (&"caged_torque".into(), &"relative".into())
    );
    assert!(number(&figure["states"]) >= 2_000.0 && number(&figure["flagged"]) == 0.0);
    let (largest, rms) = (number(&figure["largest"]), number(&figure["rms"]));
    assert!(rms < largest && largest < 0.006, "{figure}");
    assert!(number(&figure["mean"]).abs() <= rms);
}
