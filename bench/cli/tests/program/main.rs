//! The program as its users start it.

mod caged_torque;
mod calibrate;
mod calibrate_folder;
mod calibrated;
mod design;
mod designs;
mod eval;
mod help;
mod loads;
mod pairs;
mod simulate;
mod simulate_trains;
mod temperature;
mod trains;
mod untrusted;

use epas_friction::defaults;
use std::io::Write;
use std::path::Path;
use std::process::{Command, Stdio};

/// The built-in design `lin-4.1` as a file: its block comes with the program, and none is folded for it.
const STORED: &str = "\
pitch_radius = 0.0145
lead = 0.007
ball_radius = 2e-3
groove_radius = 2.16e-3
contact_angle = 0.7853982
friction = 0.075
clearance = 0
loaded_balls = 71
reversal_speed = 0.5
";

/// `lin-3.6` without a cage, likewise.
const STORED_UNCAGED: &str = "\
pitch_radius = 0.0165
lead = 0.02
ball_radius = 2.778e-3
conformity = 0.56
contact_angle = 0.7853982
friction = 0.1
clearance = 0
loaded_balls = 37
reversal_speed = 0.5
[uncaged]
balls = 37
turns = 2
screw_deviation = [{ order = 2, sine = 0.040143 }]
";

struct Run {
    code: i32,
    stdout: String,
    stderr: String,
}

fn run_in(folder: &Path, arguments: &[&str], input: &str) -> Run {
    run_with(folder, arguments, input, &[])
}

/// What `simulate` makes of `design.toml` and `trace.csv` in a folder: `out.csv` there.
fn simulated_design(folder: &Path, more: &str) -> Run {
    let line = "simulate --design design.toml --input trace.csv --force --output out.csv";
    ran(folder, format!("{line} {more}").trim_end())
}

/// Runs the program in a folder with some input and some variables of its environment changed.
fn run_with(folder: &Path, arguments: &[&str], input: &str, variables: &[(&str, &Path)]) -> Run {
    let mut child = Command::new(env!("CARGO_BIN_EXE_epas"))
        .args(arguments)
        .current_dir(folder)
        .envs(variables.iter().copied())
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    // From a thread of its own: the program answers while it reads, and a full pipe would stop both.
    let mut stdin = child.stdin.take().unwrap();
    let input = input.to_owned();
    let writer = std::thread::spawn(move || stdin.write_all(input.as_bytes()));
    let output = child.wait_with_output().unwrap();
    let _ = writer.join().unwrap();
    let run = Run {
        code: output.status.code().unwrap(),
        stdout: String::from_utf8(output.stdout).unwrap(),
        stderr: String::from_utf8(output.stderr).unwrap(),
    };
    assert!(
        !run.stderr.contains("panicked"),
        "{arguments:?}: {}",
        run.stderr
    );
    run
}

fn run(arguments: &[&str], input: &str) -> Run {
    run_in(Path::new("."), arguments, input)
}

fn words(line: &str) -> Vec<&str> {
    line.split(' ').collect()
}

fn told(folder: &Path, line: &str) -> Run {
    run_in(folder, &words(line), "")
}

/// A run of a line in a folder that succeeds.
fn ran(folder: &Path, line: &str) -> Run {
    let run = told(folder, line);
    assert_eq!(run.code, 0, "{line}: {}", run.stderr);
    run
}

fn names(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).unwrap();
    let mut names: Vec<_> = entries
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

/// A column of a table in a folder, by its name.
fn texts(table: &Path, name: &str) -> Vec<String> {
    let mut reader = csv::Reader::from_path(table).unwrap();
    let place = reader
        .headers()
        .unwrap()
        .iter()
        .position(|head| head == name);
    let place = place.unwrap_or_else(|| panic!("no column {name}"));
    let records = reader.records();
    records
        .map(|record| record.unwrap()[place].to_owned())
        .collect()
}

/// The numbers of a column of `out.csv` in a folder.
fn column(folder: &Path, name: &str) -> Vec<f64> {
    let texts = texts(&folder.join("out.csv"), name);
    texts.iter().map(|text| text.parse().unwrap()).collect()
}

impl Run {
    /// It ended with code 1 and these words.
    fn refused(&self, words: &str) {
        assert_eq!(self.code, 1, "{words}: {}", self.stderr);
        assert!(self.stderr.contains(words), "{words}: {}", self.stderr);
    }
}

#[test]
fn help_names_every_subcommand() {
    let help = run(&["--help"], "");
    assert_eq!(help.code, 0);
    for subcommand in ["simulate", "design", "eval", "calibrate", "fmu", "a2l"] {
        assert!(help.stdout.contains(subcommand));
        assert_eq!(run(&[subcommand, "--help"], "").code, 0);
    }
    let help = run(&["simulate", "--help"], "").stdout.replace('\n', " ");
    let clearance = f64::from(defaults::CLEARANCE.gap());
    assert!(help.contains(&format!("friction ({} without)", defaults::FRICTION)));
    assert!(help.contains(&format!("clearance = {clearance:.0e})")));
}

/// An output is not called what it is not.
#[test]
fn foreign_endings_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("a.csv"), "time\n0\n").unwrap();
    for (arguments, word) in [
        ("simulate --manoeuvre kerb --plot out.png", ".svg or .html"),
        ("simulate --manoeuvre kerb --output o.XLSX", ".csv or .mf4"),
        (
            "simulate --loads --design lin-3.6 --output l.mf4",
            ".toml or .rs",
        ),
        (
            "fmu --scene caged --design lin-4.1 --output a.zip.toml",
            ".fmu",
        ),
        ("fmu --scene caged --design lin-4.1 --output x.txt", ".fmu"),
        ("fmu --scene caged --design lin-4.1 --output unit", ".fmu"),
        ("a2l --image a.elf --output a.csv", ".a2l"),
        (
            "calibrate a.csv --design lin-4.1 --design-out a.json",
            ".toml",
        ),
        ("calibrate a.csv --design lin-4.1 --constants a.csv", ".rs"),
        ("simulate --manoeuvre kerb --design gear.TOML", "gear.TOML"),
    ] {
        let run = told(folder.path(), arguments);
        assert_eq!(run.code, 1, "{arguments}: {}", run.stderr);
        assert!(run.stderr.contains(word), "{}", run.stderr);
    }
}

/// A number below zero is a wrong value, and no option.
#[test]
fn numbers_below_zero_are_told_their_range() {
    for (arguments, word) in [
        ("simulate --inertia -1", "an inertia is"),
        ("calibrate a.csv --ratio -2", "a ratio is"),
        (
            "calibrate a.csv --rated-torque -2e1",
            "a rated torque in N m is",
        ),
        (
            "calibrate --wanted nonsense --design lin-4.1",
            "allowed: friction, ",
        ),
    ] {
        let run = run(&words(arguments), "");
        assert_eq!(run.code, 2, "{arguments}");
        assert!(run.stderr.contains("invalid value"), "{}", run.stderr);
        assert!(run.stderr.contains(word), "{}", run.stderr);
    }
}

/// Where nothing can be said, the exit code says it.
#[cfg(target_os = "linux")]
#[test]
fn a_full_error_output_is_no_panic() {
    let full = std::fs::File::create("/dev/full").unwrap();
    let status = Command::new(env!("CARGO_BIN_EXE_epas"))
        .args(["calibrate", "none.csv"])
        .stderr(full)
        .status()
        .unwrap();
    assert_eq!(status.code(), Some(1));
}

#[test]
fn wrong_usage_ends_with_code_2() {
    for arguments in [
        "fly",
        "eval --fast",
        "simulate",
        "simulate --design 33x20x6.35 --manoeuvre parking",
        "simulate --manoeuvre jump",
        "simulate --input trace.csv",
        "simulate --input trace.csv --manoeuvre kerb",
        "simulate --list --force",
        "simulate --manoeuvre kerb --channels nope.toml",
        "simulate --manoeuvre kerb --inertia 1e-3",
        "simulate --loads --design lin-4.1 --memory",
        "simulate --mechanism --design lin-3.6 --input trace.csv --scene uncaged",
    ] {
        let run = run(&words(arguments), "");
        assert_eq!(run.code, 2, "{arguments}: {}", run.stderr);
        assert!(!run.stderr.is_empty() && run.stdout.is_empty());
    }
}
