//! `calibrate` without a design, on a slide whose numbers are known.

use std::f64::consts::TAU;
use std::fmt::Write as _;
use std::fs;

use super::{ran, told};

/// Truth: mass, kg; viscous friction, N s/m; Coulomb friction, N; offset, N.
const MASS: f64 = 40.0;
const VISCOUS: f64 = 150.0;
const COULOMB: f64 = 12.0;
const OFFSET: f64 = 2.0;
/// Controller, 1/s and N s/m.
const POSITION: f64 = 60.0;
const SPEED: f64 = 4000.0;
const TICK: f64 = 1e-3;

/// A slide with Coulomb and viscous friction under its controller, whose speed is a difference over two ticks: twenty explicit steps a
/// tick, and friction that holds it at rest where the effort is below it. `shift` moves the programme in time.
fn trace(seconds: usize, shift: f64) -> String {
    let mut text = String::from("time,position,reference_position,motor_force\n");
    let wanted = |time: f64| {
        let time = time + shift;
        0.05 * (1.0 - (TAU * 0.4 * time).cos()) + 0.01 * (TAU * 1.3 * time).sin()
    };
    let (mut position, mut speed) = (wanted(0.0), 0.0);
    let mut history = [position; 2];
    for sample in 0..seconds * 1000 {
        let time = sample as f64 * TICK;
        // An encoder of 0.1 micrometres.
        let seen = (position * 1e7).round() * 1e-7;
        let effort =
            SPEED * (POSITION * (wanted(time) - seen) - (seen - history[1]) / (2.0 * TICK));
        history = [seen, history[0]];
        writeln!(text, "{time:.4},{seen:.7},{:.9},{effort:.6}", wanted(time)).unwrap();
        for _ in 0..20 {
            let step = TICK / 20.0;
            let pushing = effort - OFFSET - VISCOUS * speed;
            let friction = COULOMB * speed.signum();
            let moved = speed + step * (pushing - friction) / MASS;
            speed = if speed != 0.0 && moved * speed > 0.0 {
                moved
            } else if pushing.abs() > COULOMB {
                step * (pushing - COULOMB * pushing.signum()) / MASS
            } else {
                0.0
            };
            position += step * speed;
        }
    }
    text
}

#[test]
fn a_folder_of_the_users_stays() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("slide.csv"), "time,position\n0,0\n").unwrap();
    let line = "calibrate slide.csv --output .";
    // Before the trace is looked at.
    told(folder.path(), line).refused("such as slide.csv");
    let forced = told(folder.path(), &format!("{line} --force"));
    forced.refused("motor_force is missing");
}

#[test]
fn a_slide_is_told_with_intervals_that_hold_the_truth() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("slide.csv"), trace(8, 0.0)).unwrap();
    fs::write(folder.path().join("other.csv"), trace(6, 0.7)).unwrap();
    let controller = format!("gain_position={POSITION},gain_speed={SPEED}");
    let line = "calibrate slide.csv --json --output out --validate other.csv --controller";
    let run = ran(folder.path(), &format!("{line} {controller}"));
    let answer: serde_json::Value = serde_json::from_str(&run.stdout).unwrap();
    // Half a tick of the controller's hold is a delay, which the estimate puts into its numbers: measured 0.2 % of the mass, 0.7 % of both
    // frictions. Its intervals know nothing of it.
    for (name, truth) in [
        ("mass", MASS),
        ("viscous_friction", VISCOUS),
        ("coulomb_friction", COULOMB),
        ("offset", OFFSET),
    ] {
        let told = answer["parameters"][name]["value"].as_f64().unwrap();
        assert!((told / truth - 1.0).abs() < 0.01, "{name}: {told}");
    }
    let models = answer["models"].as_array().unwrap();
    let model = |name: &str| models.iter().find(|model| model["name"] == name).unwrap();
    // The truth is Coulomb and viscous, to which every law comes down: it closes the loop on what was not fitted, and none does much better.
    let truth = "Coulomb and viscous, with the drive's other terms";
    let error = |name: &str| model(name)["relative_error_unseen"].as_f64().unwrap();
    for law in [
        truth,
        "Stribeck",
        "Dahl",
        "LuGre",
        "this crate, with memory",
    ] {
        let found = error(law);
        assert!(0.5 * error(truth) < found && found < 0.02, "{law}: {found}");
    }
    // With the delay the intervals hold the truth.
    let values = &model(truth)["values"];
    for (name, truth) in [
        ("mass", MASS),
        ("viscous_friction_forward", VISCOUS),
        ("viscous_friction_backward", VISCOUS),
        ("coulomb_friction", COULOMB),
        ("offset", OFFSET),
        ("effort_delay", 0.5 * TICK),
    ] {
        let number = |key: &str| values[name][key].as_f64().unwrap();
        assert!(
            number("low") < truth && truth < number("high"),
            "{name}: {}",
            values[name]
        );
    }
    let sentences = answer["cannot_tell"].to_string();
    assert!(
        sentences.contains("losses in proportion to a load"),
        "{sentences}"
    );
    assert!(folder.path().join("out/report.html").exists());
}

#[test]
fn what_cannot_be_is_refused_with_a_word() {
    let folder = tempfile::tempdir().unwrap();
    let slide = trace(2, 0.0);
    fs::write(folder.path().join("slide.csv"), &slide).unwrap();
    let screw = slide
        .replace("position", "nut_position")
        .replace("reference_nut_position", "reference_position")
        .replace("motor_force", "motor_torque");
    fs::write(folder.path().join("screw.csv"), screw).unwrap();
    for (arguments, code, word) in [
        ("none.csv", 1, "none.csv"),
        ("slide.csv --controller gain_position=1", 2, "gain_speed"),
        ("slide.csv --ratio 2", 1, "--design"),
        ("slide.csv --design lin-4.1 --fix friction", 2, "NAME=VALUE"),
        ("slide.csv --validate none.csv", 1, "none.csv"),
        (
            "screw.csv --design lin-4.1 --validate none.csv",
            1,
            "none.csv",
        ),
    ] {
        let run = told(folder.path(), &format!("calibrate {arguments}"));
        assert_eq!(run.code, code, "{arguments:?}: {}", run.stderr);
        assert!(run.stderr.contains(word), "{arguments:?}: {}", run.stderr);
    }
}
