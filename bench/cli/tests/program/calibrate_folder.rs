//! `calibrate` of a folder: every trace by itself, all of them together, and what is not fitted twice.

use std::f64::consts::TAU;
use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use serde_json::Value;
use tempfile::tempdir;

use super::{Run, told, words};

/// A carriage of so many kilograms with 200 N s/m of drag and 20 N of friction, moved to and fro for ten seconds; noise of 0.5 N
/// that looks random.
fn trace(mass: f64) -> String {
    let mut text = String::from("time,position,motor_force\n");
    let mut state = 1u32;
    for tick in 0..10_000 {
        let time = 1e-3 * f64::from(tick);
        let (mut position, mut speed, mut acceleration) = (0.0, 0.0, 0.0);
        for (amplitude, frequency) in [(0.08, 0.3), (0.02, 1.1), (0.002, 4.3)] {
            let rate = TAU * frequency;
            let (sine, cosine) = (rate * time).sin_cos();
            position += amplitude * sine;
            speed += amplitude * rate * cosine;
            acceleration -= amplitude * rate * rate * sine;
        }
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        let noise = f64::from(state >> 8) / f64::from(1u32 << 24) - 0.5;
        let force = mass * acceleration + 200.0 * speed + 20.0 * speed.signum() + noise;
        writeln!(text, "{time:.3},{position:.9},{force:.4}").unwrap();
    }
    text
}

fn calibrate(folder: &Path, arguments: &str) -> Run {
    told(folder, &format!("calibrate {arguments}"))
}

fn json(run: &Run) -> Value {
    assert_eq!(run.code, 0, "{}", run.stderr);
    serde_json::from_str(&run.stdout).unwrap()
}

/// Masses are found within 1 %: two hundred times their noise would allow, 0.5 N of 200 N over 1000 rows that count.
#[test]
fn a_folder_is_the_sum_of_its_parts() {
    let place = tempdir().unwrap();
    let traces = place.path().join("traces");
    fs::create_dir(&traces).unwrap();
    let masses = [90.0, 100.0, 110.0];
    for mass in masses {
        fs::write(traces.join(format!("rig{mass}.csv")), trace(mass)).unwrap();
    }
    fs::write(traces.join("bad.csv"), "time,colour\n0,1\n").unwrap();

    let run = calibrate(place.path(), "traces --output whole --json");
    let whole = json(&run);
    for mass in masses {
        let told = &whole["traces"][format!("rig{mass}.csv")]["parameters"]["mass"];
        let value = told["value"].as_f64().unwrap();
        assert!((value - mass).abs() < 0.01 * mass, "{told}");
    }
    assert!(whole["traces"]["bad.csv"]["error"].is_string(), "{whole}");
    let population = whole["population"].as_array().unwrap();
    let mass = population
        .iter()
        .find(|parameter| parameter["name"] == "mass")
        .unwrap();
    assert_eq!(mass["traces"], 3);
    assert!(
        (mass["mean"].as_f64().unwrap() - 100.0).abs() < 2.0,
        "{mass}"
    );
    // 10 kg between traces, by value or by its logarithm.
    let spread = mass["spread"].as_f64().unwrap();
    assert!(
        (spread - 10.0).abs() < 1.0 || (spread - 0.1).abs() < 0.01,
        "{mass}"
    );
    for name in words("report.html report.md population.csv refused.csv by_trace.svg") {
        assert!(place.path().join("whole").join(name).is_file(), "{name}");
    }

    for part in ["1/2", "2/2"] {
        let output = format!("part{}", &part[..1]);
        let line = format!("traces --part {part} --output {output}");
        calibrate(place.path(), &line);
    }
    let merged = json(&calibrate(
        place.path(),
        "--merge part2 part1 --output merged --json",
    ));
    assert_eq!(merged, whole);
    // Again: nothing is left to fit, and the answer is the same to the letter.
    let again = calibrate(place.path(), "traces --output whole --json");
    assert_eq!(again.stdout, run.stdout);
}

#[test]
fn a_folder_that_tells_nothing_ends_with_code_1() {
    let place = tempdir().unwrap();
    for (text, word) in [(None, "no trace"), (Some("time,colour\n0,1\n"), "bad.csv")] {
        if let Some(text) = text {
            fs::write(place.path().join("bad.csv"), text).unwrap();
        }
        let run = calibrate(place.path(), ". --output out");
        assert_eq!(run.code, 1, "{}", run.stdout);
        assert!(run.stderr.contains(word), "{}", run.stderr);
    }
    for (arguments, word) in [
        (". --validate bad.csv", "--validate"),
        (
            ". --controller gain_position=1,gain_speed=1",
            "--controller",
        ),
        (". --design lin-4.1 --design-out gear.toml", "--design-out"),
        (". --design lin-4.1 --constants gear.rs", "--constants"),
        ("bad.csv --part 1/3", "--part"),
    ] {
        let run = calibrate(place.path(), arguments);
        assert_eq!(run.code, 1, "{arguments:?}: {}", run.stderr);
        let refused = format!("{word} is for");
        assert!(run.stderr.contains(&refused), "{}", run.stderr);
    }
    // A name that is wrong is no word of a trace.
    let run = calibrate(
        place.path(),
        ". --design lin-4.1 --estimate foo --output out",
    );
    run.refused("foo: unknown; known are friction");
    for arguments in [". --part 3/2", ". --part 1/2 --merge out"] {
        let run = calibrate(place.path(), arguments);
        assert_eq!(run.code, 2, "{arguments}");
    }
}
