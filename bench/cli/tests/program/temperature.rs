//! A trace's temperature, and what friction makes of it where no calibration says it.

use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use epas_design::files::read;
use epas_friction::law::coefficient::CoefficientLaw;
use tempfile::tempdir;

use super::{column, simulated_design};

/// A steering gear's screw.
const DESIGN: &str = "\
nominal_diameter = 0.029
lead = 0.007
ball_diameter = 4e-3
conformity = 0.54
contact_angle = 0.7853982
loaded_balls = 71
clearance = 0
reversal_speed = 0.01
";

/// 4 kN at 5 rad/s, 20 degrees Celsius and then -20.
fn trace() -> String {
    let mut trace = String::from("time,nut_speed,axial_load,temperature_C\n");
    for tick in 0..200 {
        let celsius = if tick < 100 { 20 } else { -20 };
        writeln!(trace, "{},5,4000,{celsius}", 1e-3 * f64::from(tick)).unwrap();
    }
    trace
}

/// What a run says, and the friction torque of its samples, N m.
fn simulated(folder: &Path, design: &str, more: &str) -> (String, Vec<f64>) {
    fs::write(folder.join("design.toml"), design).unwrap();
    let run = simulated_design(folder, more);
    (run.stdout, column(folder, "friction_torque"))
}

/// With memory and without, friction goes by the default law: the coefficient of each tick gives its torque, and the lubricant's drag is added.
#[test]
fn a_trace_is_followed_by_the_default_law() {
    let folder = tempdir().unwrap();
    fs::write(folder.path().join("trace.csv"), trace()).unwrap();
    let design = read(DESIGN, "design").unwrap();
    let law = CoefficientLaw::new(&design.default_coefficient().unwrap()).unwrap();
    let expected = [20.0_f32, -20.0].map(|celsius| {
        let now = law.at_temperature(celsius + 273.15);
        let drag = f64::from(now.drag_torque(5.0, 4e3, 0.0));
        let friction = now.at(5.0);
        let text =
            DESIGN.to_owned() + &format!("friction = {friction}\nfriction_law = \"constant\"\n");
        let (_, alone) = simulated(folder.path(), &text, "--no-memory");
        alone[90] + drag
    });
    for memory in ["--no-memory", "--memory"] {
        let (said, torques) = simulated(folder.path(), DESIGN, memory);
        assert!(
            said.contains("253.1 to 293.1 K, followed by the friction coefficient"),
            "{said}"
        );
        for (torque, expected) in [torques[90], torques[190]].into_iter().zip(expected) {
            // The promise of a block for a range of friction coefficients.
            assert!(
                (torque / expected - 1.0).abs() < 0.01,
                "{memory}: {torque} {expected}"
            );
        }
    }
    let [warm, cold] = expected;
    // Under load and at this speed the film of cold grease saves more than its drag costs.
    assert!(cold < 0.75 * warm, "{cold} {warm}");
}

/// A design file switches it off: friction is that without a temperature, and the summary says why.
#[test]
fn a_design_file_switches_the_law_off() {
    let folder = tempdir().unwrap();
    fs::write(folder.path().join("trace.csv"), trace()).unwrap();
    let constant = DESIGN.to_owned() + "friction_law = \"constant\"\n";
    for memory in ["--no-memory", "--memory"] {
        let (said, torques) = simulated(folder.path(), &constant, memory);
        assert!(
            said.contains("the trace's is ignored: the design file says friction_law"),
            "{said}"
        );
        assert!(torques[90] == torques[80] && torques[190] == torques[180]);
        assert!((torques[190] / torques[90] - 1.0).abs() < 1e-6);
    }
}

/// Beside a reference, which has one coefficient, so has the model.
#[test]
fn a_reference_has_one_coefficient() {
    let folder = tempdir().unwrap();
    fs::write(folder.path().join("trace.csv"), trace()).unwrap();
    let (said, torques) = simulated(folder.path(), DESIGN, "--no-memory --reference");
    assert!(
        said.contains("the trace's is ignored: the reference has one"),
        "{said}"
    );
    let exact = column(folder.path(), "reference_friction_torque");
    assert!(
        (torques[190] / exact[190] - 1.0).abs() < 3e-3,
        "{} {}",
        torques[190],
        exact[190]
    );
}

/// A design that follows a closed form stands beside the exact ball, not beside itself: a rolling ball has less than half of its friction.
#[test]
fn a_closed_form_is_compared_with_the_exact_ball() {
    let folder = tempdir().unwrap();
    fs::write(folder.path().join("trace.csv"), trace()).unwrap();
    let rolling = DESIGN.to_owned() + "branch = \"rolling\"\n";
    let (said, torques) = simulated(folder.path(), &rolling, "--no-memory --reference=exact");
    assert!(
        said.contains("one ball in elastic balance, another model"),
        "{said}"
    );
    let exact = column(folder.path(), "reference_friction_torque");
    let ratio = torques[90] / exact[90];
    println!("{ratio}");
    assert!(ratio < 0.7, "{ratio}");
    let (said, torques) = simulated(
        folder.path(),
        &rolling,
        "--no-memory --reference=closed-form",
    );
    assert!(said.contains("the design's closed form"), "{said}");
    let same = column(folder.path(), "reference_friction_torque");
    assert!((torques[90] / same[90] - 1.0).abs() < 1e-5);
}
