//! `target`; what needs QEMU and the target is skipped by default and run by `.ci/run`.

use std::env;
use std::path::{Path, PathBuf};

use super::{run, run_with};

use epas_firmware::gears::GEAR_33X20;
use epas_firmware::inputs::CASES;
use epas_firmware::scenes::course;
use epas_firmware::spread::Spread;
use epas_firmware::subjects::{PEERS, SUBJECTS, WIDEST};
use epas_friction::scene::CagedBallScrew;
use epas_friction::{FrictionModel, Inputs};

/// What the debug firmware sends through defmt is what the same ticks give here, number by number.
#[test]
#[ignore = "needs QEMU and the target"]
fn the_log_of_the_firmware_decodes() {
    let log = run(&["target", "--log"], "");
    assert_eq!(log.code, 0, "{}", log.stderr);
    let mut caged = FrictionModel::<CagedBallScrew, _>::of(&GEAR_33X20);
    let mut lines = log.stdout.lines();
    for tick in [100, 300, 500] {
        let (nut_speed, axial_load) = course(tick);
        let inputs = Inputs {
            nut_speed,
            axial_load,
        };
        let outputs = caged.step(inputs);
        let line = lines
            .by_ref()
            .find(|line| line.contains("caged "))
            .unwrap_or_else(|| panic!("tick {tick} is missing in\n{}", log.stdout));
        assert!(
            line.contains(&format!("friction_torque: {}", outputs.friction_torque)),
            "{line}\n{outputs:?}"
        );
        assert!(
            line.contains(&format!("regime: {:?}", outputs.regime)),
            "{line}\n{outputs:?}"
        );
    }
    // An error names the field and the value.
    assert!(log.stdout.contains("lead"), "{}", log.stdout);
}

/// One object with every function and scene, and no budget of the proofs broken.
#[test]
#[ignore = "needs QEMU and the target"]
fn figures_are_one_object() {
    let target = run(&["target", "--json", "--gate"], "");
    assert_eq!(target.code, 0, "{}", target.stderr);
    let figures: serde_json::Value = serde_json::from_str(&target.stdout).unwrap();
    let names = |list: &str| -> Vec<String> {
        figures[list]
            .as_array()
            .unwrap()
            .iter()
            .map(|entry| entry["name"].as_str().unwrap().to_owned())
            .collect()
    };
    for name in [
        "curvature_literature",
        "hertz_ellipse",
        "kinematics_tick",
        "ball_screw_ball",
        "train_37",
        "step_efficiency",
        "step_closed_form",
        "step_load_proportional",
        "step_caged",
        "step_train_37",
        "libm_cosf",
        "micromath_powf",
    ] {
        assert!(
            names("functions").iter().any(|known| known == name),
            "{name}"
        );
    }
    assert_eq!(
        names("scenes"),
        [
            "curvature",
            "efficiency",
            "caged_ball_screw",
            "caged_from_page",
            "caged_with_memory",
            "linear_bearing",
            "ball_screw_37",
            "ball_screw_37_with_memory",
            "everything"
        ]
    );
    assert_eq!(figures["panic_free"], true);
    assert_eq!(figures["soft_double"], false);
}

/// What is missing is named, with the command that adds it.
#[test]
fn without_qemu_the_command_that_adds_it_is_printed() {
    let folder = tempfile::tempdir().unwrap();
    let variables = [("PATH", Path::new("")), ("RUSTC", &rustc())];
    let run = run_with(folder.path(), &["target", "--gate"], "", &variables);
    assert_ne!(run.code, 0);
    assert!(
        run.stderr.contains("qemu-system-arm is not installed"),
        "{}",
        run.stderr
    );
    assert!(
        run.stderr.contains("apt-get install qemu-system-arm"),
        "{}",
        run.stderr
    );
}

/// Where the compiler is.
fn rustc() -> PathBuf {
    let folders = env::var_os("PATH").unwrap();
    env::split_paths(&folders)
        .map(|folder| {
            folder
                .join("rustc")
                .with_extension(env::consts::EXE_EXTENSION)
        })
        .find(|path| path.is_file())
        .unwrap()
}

/// Inputs differ from case to case, and fit into the firmware's buffers.
#[test]
fn the_firmware_has_inputs_for_every_function() {
    for subject in SUBJECTS.iter().chain(PEERS) {
        assert!(subject.inputs <= WIDEST && subject.outputs <= WIDEST);
        let inputs: Vec<Vec<u32>> = (0..CASES)
            .map(|case| {
                let mut inputs = vec![0.0; subject.inputs];
                (subject.fill)(&mut Spread::new(case), &mut inputs);
                inputs.iter().map(|input: &f32| input.to_bits()).collect()
            })
            .collect();
        let mut distinct = inputs.clone();
        distinct.sort();
        distinct.dedup();
        assert!(
            distinct.len() > inputs.len() * 9 / 10,
            "{}: {} of {}",
            subject.name,
            distinct.len(),
            inputs.len()
        );
    }
}
