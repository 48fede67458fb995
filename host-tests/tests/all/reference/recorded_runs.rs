//! `recorded.json`: every recorded run names a command that is there, and none has failures. `mutants.json`: each fault that no test saw has a
//! reason.

use std::path::Path;

use serde_json::Value;

fn read(name: &str) -> Value {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(name);
    serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap()
}

fn recorded() -> Value {
    read("recorded.json")
}

fn list<'a>(recorded: &'a Value, name: &str) -> &'a [Value] {
    recorded[name].as_array().unwrap()
}

/// The source of the test that a command runs; of any other command, the script that must be there.
fn source(command: &str) -> String {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let path = if command.starts_with("cargo test") {
        let (_, test) = command.split_once("--test ").expect(command);
        let mut names = test.split_whitespace();
        let (program, module) = (names.next().unwrap(), names.next().unwrap());
        root.join("tests")
            .join(program)
            .join(format!("{}.rs", module.replace("::", "/")))
    } else {
        root.join("..")
            .join(command.split_whitespace().next().unwrap())
    };
    std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{command}: {error}"))
}

#[test]
fn every_command_is_there() {
    let recorded = recorded();
    for run in list(&recorded, "runs")
        .iter()
        .chain(list(&recorded, "sweeps"))
    {
        let command = run["command"].as_str().unwrap();
        let source = source(command);
        assert_eq!(
            command.contains("--ignored"),
            source.contains("#[ignore"),
            "{command}"
        );
        // What is recorded is what the tests print of themselves.
        assert!(
            !command.starts_with("cargo test") || source.contains("recorded::"),
            "{command}"
        );
    }
}

#[test]
fn nothing_fails_and_as_much_has_run_as_is_asked_for() {
    let recorded = recorded();
    let runs = list(&recorded, "runs");
    for run in runs {
        assert_eq!(run["failures"].as_u64(), Some(0), "{run}");
        assert!(run["count"].as_u64().unwrap() > 0, "{run}");
    }
    let random: u64 = runs
        .iter()
        .filter(|run| run["what"].as_str().unwrap().contains("random inputs"))
        .map(|run| run["count"].as_u64().unwrap())
        .sum();
    assert!(random >= 1_000_000_000);
    for sweep in list(&recorded, "sweeps") {
        let number = |name: &str| sweep[name].as_f64().unwrap();
        assert!(number("inputs") >= 1e9, "{sweep}");
        assert!(number("rms") <= number("largest"), "{sweep}");
        assert!(number("mean").abs() <= number("rms"), "{sweep}");
    }
    assert!(list(&recorded, "mended").len() > 10 && list(&recorded, "limits").len() > 5);
}

/// The faults that were tried add up, and each that no test has seen stands in a file that is there, with a reason.
#[test]
fn survivors_have_reasons() {
    let mutants = read("mutants.json");
    let count = |name: &str| mutants[name].as_u64().unwrap();
    let survivors = list(&mutants, "survivors");
    assert_eq!(
        count("tried"),
        count("seen") + count("unviable") + count("of_code_that_is_gone") + survivors.len() as u64
    );
    assert!(count("tried") * 8 >= count("listed"));
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    for survivor in survivors {
        let (file, _) = survivor["mutant"]
            .as_str()
            .unwrap()
            .split_once(':')
            .unwrap();
        assert!(root.join(file).is_file(), "{survivor}");
        assert!(!survivor["why"].as_str().unwrap().is_empty(), "{survivor}");
    }
}
