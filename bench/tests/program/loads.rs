//! `simulate --loads`: load tables for the scene without a cage.

use std::fs;
use std::path::Path;

use epas_friction::LoadShare;
use tempfile::tempdir;

use super::{Run, run, run_in};

mod pasted {
    include!("load_shares.rs");
}

const DESIGN: &str = "\
pitch_radius = 0.0165
lead = 0.02
ball_radius = 2.778e-3
groove_radius = 3.254e-3
contact_angle = 0.7853982
loaded_balls = 32
[uncaged]
balls = 40
turns = 2.0
return_length = 0.05
";

const LOADS: &str = "\
[loads]
screw_length = 0.8
screw_diameter = 0.032
nut_position = 0.4
axial_load = 5000
turns = 2
";

fn loads(folder: &Path, arguments: &[&str]) -> Run {
    let all: Vec<_> = ["simulate", "--loads"]
        .iter()
        .chain(arguments)
        .copied()
        .collect();
    run_in(folder, &all, "")
}

fn shares(toml: &str) -> Vec<f64> {
    toml.lines()
        .filter_map(|line| line.trim().strip_suffix(',')?.parse().ok())
        .collect()
}

/// Constants that compile into firmware are the program's output, to the last letter, and hold the figures
/// of case 1 of Lin 2019: 1.301 between the largest and the smallest.
#[test]
fn rust_constants_are_ready_to_paste() {
    let printed = run(
        &[
            "simulate", "--loads", "--design", "lin-2.1", "--format", "rust",
        ],
        "",
    );
    assert_eq!(printed.code, 0, "{}", printed.stderr);
    assert_eq!(printed.stdout, include_str!("load_shares.rs"));
    let shares = pasted::LOAD_SHARES.map(|share| f64::from(share.share()));
    let mean = shares.iter().sum::<f64>() / 32.0;
    assert!((mean - 1.0).abs() < 1e-6, "{mean}");
    let largest = shares.iter().fold(0.0_f64, |most, share| most.max(*share));
    let smallest = shares
        .iter()
        .fold(9.0_f64, |least, share| least.min(*share));
    assert!(
        (largest / smallest - 1.301).abs() < 2e-3,
        "{}",
        largest / smallest
    );
    for share in pasted::LOAD_SHARES {
        assert_eq!(Ok(share), LoadShare::new(share.share()));
    }
}

/// The table goes back into the design file, and the scene runs with it.
#[test]
fn a_table_goes_into_the_design_file() {
    let folder = tempdir().unwrap();
    let path = folder.path();
    fs::write(path.join("screw.toml"), format!("{DESIGN}{LOADS}")).unwrap();
    let made = loads(path, &["--design", "screw.toml", "--output", "shares.toml"]);
    assert_eq!(made.code, 0, "{}", made.stderr);
    let table = fs::read_to_string(path.join("shares.toml")).unwrap();
    let built_in = run(&["simulate", "--loads", "--design", "lin-2.1"], "").stdout;
    let (own, built_in) = (shares(&table), shares(&built_in));
    assert_eq!(own.len(), 32);
    for (own, built_in) in own.iter().zip(&built_in) {
        // The file's angle is rounded to f32, and so are the built-in lengths.
        assert!((own - built_in).abs() < 1e-5, "{own} {built_in}");
    }
    let again = loads(path, &["--design", "screw.toml", "--output", "shares.toml"]);
    assert!(
        again.code == 1 && again.stderr.contains("--force"),
        "{}",
        again.stderr
    );

    let list = table.split_once("[uncaged]\n").unwrap().1;
    let whole = format!("{DESIGN}{list}");
    fs::write(path.join("whole.toml"), whole).unwrap();
    let run = run_in(
        path,
        &[
            "simulate",
            "--scene",
            "uncaged",
            "--design",
            "whole.toml",
            "--manoeuvre",
            "turns",
            "--output",
            "out.csv",
        ],
        "",
    );
    assert_eq!(run.code, 0, "{}", run.stderr);
}

#[test]
fn other_loads_and_errors_change_the_table() {
    let folder = tempdir().unwrap();
    let path = folder.path();
    let mut tables = Vec::new();
    for (name, more) in [
        ("plain", ""),
        ("pitch", "pitch_error = 5e-6\n"),
        ("round", "roundness_error = 5e-6\n"),
        ("large", "ball_oversize = 7e-6\nend_offset = 3e-4\n"),
    ] {
        let file = format!("{name}.toml");
        fs::write(path.join(&file), format!("{DESIGN}{LOADS}{more}")).unwrap();
        let made = loads(path, &["--design", &file, "--axial-load=-1000"]);
        assert_eq!(made.code, 0, "{}", made.stderr);
        assert!(made.stdout.contains("-1000 N"), "{}", made.stdout);
        let shares = shares(&made.stdout);
        let mean = shares.iter().sum::<f64>() / 32.0;
        // Balls that push against the load stand with 0.01.
        assert!((mean - 1.0).abs() < 0.02, "{name}: {mean}");
        assert!(!tables.contains(&shares), "{name}");
        tables.push(shares);
    }
}

#[test]
fn what_gives_no_table_says_why() {
    let folder = tempdir().unwrap();
    let path = folder.path();
    fs::write(path.join("bare.toml"), DESIGN).unwrap();
    let bare = loads(path, &["--design", "bare.toml"]);
    assert!(
        bare.code == 1 && bare.stderr.contains("[loads]"),
        "{}",
        bare.stderr
    );
    for (from, to, said) in [
        ("turns = 2\n", "", "turns"),
        ("turns = 2\n", "turns = 2\nball_spacing = 0.4\n", "turns"),
        ("screw_length = 0.8\n", "", "screw_length"),
        ("screw_length = 0.8", "screw_length = nan", "screw_length"),
        (
            "screw_diameter = 0.032",
            "screw_diameter = 0.05",
            "screw_diameter",
        ),
        ("nut_position = 0.4", "nut_position = 0.01", "nut_position"),
        ("axial_load = 5000", "axial_load = inf", "axial_load"),
        ("axial_load = 5000", "axial_load = 0", "no ball carries"),
        (
            "turns = 2\n",
            "turns = 2\nball_oversize = [0.0]\n",
            "ball_oversize",
        ),
        ("turns = 2\n", "turns = 2\npitch_error = 1\n", "pitch_error"),
        ("turns = 2\n", "turns = 2\ncolour = 1\n", "colour"),
    ] {
        let text = format!("{DESIGN}{}", LOADS.replace(from, to));
        fs::write(path.join("bad.toml"), text).unwrap();
        let run = loads(path, &["--design", "bad.toml"]);
        assert_eq!(
            (run.code, run.stdout.as_str()),
            (1, ""),
            "{to}: {}",
            run.stderr
        );
        assert!(run.stderr.contains(said), "{to}: {}", run.stderr);
    }
    for arguments in [
        &["--loads"][..],
        &["--loads", "--design", "lin-2.1", "--manoeuvre", "parking"],
        &[
            "--design",
            "lin-2.1",
            "--manoeuvre",
            "parking",
            "--format",
            "rust",
        ],
    ] {
        let all: Vec<_> = ["simulate"].iter().chain(arguments).copied().collect();
        assert_eq!(run(&all, "").code, 2, "{arguments:?}");
    }
}
