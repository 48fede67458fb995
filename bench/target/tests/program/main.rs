//! The program as its users start it, and the firmware's parts that the host runs too. Counts and their gate are a step of `.ci/run`.

mod friction_task;

use std::collections::BTreeSet;
use std::env;
use std::path::{Path, PathBuf};
use std::process::Command;

use epas_bench::counts::stored;

use epas_firmware::gears::GEAR_33X20;
use epas_firmware::inputs::CASES;
use epas_firmware::scenes::course;
use epas_firmware::spread::Spread;
use epas_firmware::subjects::{PEERS, SUBJECTS, WIDEST};
use epas_friction::scene::CagedBallScrew;
use epas_friction::{FrictionModel, Inputs};
use epas_reference::promises::PROMISES;

/// The program with its arguments.
fn program(arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_epas-target"));
    command.args(arguments);
    command
}

/// Exit code, standard output and standard error of a run.
fn run(command: &mut Command) -> (Option<i32>, String, String) {
    let output = command.output().unwrap();
    let text = |bytes| String::from_utf8(bytes).unwrap();
    (
        output.status.code(),
        text(output.stdout),
        text(output.stderr),
    )
}

/// What the debug firmware sends through defmt is what the same ticks give here, number by number.
#[test]
#[ignore = "needs QEMU and the target"]
fn the_log_of_the_firmware_decodes() {
    let (code, log, message) = run(&mut program(&["--log"]));
    assert_eq!(code, Some(0), "{message}");
    let mut caged = FrictionModel::<CagedBallScrew, _>::of(&GEAR_33X20);
    let mut lines = log.lines();
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
            .unwrap_or_else(|| panic!("tick {tick} is missing in\n{log}"));
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
    assert!(log.contains("lead"), "{}", log);
}

/// What is stored is of every function and scene that the firmware has, and every function of the crate has its promise.
#[test]
fn stored_figures_are_of_every_function_and_scene() {
    let figures = stored().unwrap();
    let counted: BTreeSet<&str> = figures
        .functions
        .iter()
        .map(|entry| entry.name.as_str())
        .collect();
    assert_eq!(counted.len(), figures.functions.len());
    let subjects = SUBJECTS.iter().chain(PEERS).map(|subject| subject.name);
    assert_eq!(counted, subjects.collect());
    let promised: BTreeSet<&str> = PROMISES
        .all()
        .flat_map(|promise| promise.counted.iter().map(String::as_str))
        .collect();
    assert_eq!(
        promised,
        SUBJECTS.iter().map(|subject| subject.name).collect()
    );
    let scenes: Vec<&str> = figures
        .scenes
        .iter()
        .map(|scene| scene.name.as_str())
        .collect();
    assert_eq!(
        scenes,
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
    assert!(figures.panic_free && !figures.soft_double);
}

/// What is missing is named, with the command that adds it.
#[test]
fn without_qemu_the_command_that_adds_it_is_printed() {
    let folder = tempfile::tempdir().unwrap();
    let (code, _, message) = run(program(&["--gate"])
        .current_dir(folder.path())
        .env("PATH", Path::new(""))
        .env("RUSTC", rustc()));
    assert_eq!(code, Some(1), "{message}");
    for word in [
        "qemu-system-arm is not installed",
        "apt-get install qemu-system-arm",
    ] {
        assert!(message.contains(word), "{message}");
    }
}

/// Help of every switch; two jobs at once, and words that are none, are refused.
#[test]
fn wrong_usage_ends_with_code_2() {
    let (code, help, _) = run(&mut program(&["--help"]));
    assert_eq!(code, Some(0));
    for switch in [
        "--json",
        "--gate",
        "--store",
        "--store-cases",
        "--log",
        "--longest",
    ] {
        assert!(help.contains(switch), "{switch}");
    }
    for arguments in [
        &["target"][..],
        &["--gate", "--store"],
        &["--log", "--json"],
        &["--longest", "--gate"],
        &["--fast"],
    ] {
        let (code, out, message) = run(&mut program(arguments));
        assert_eq!(code, Some(2), "{arguments:?}: {message}");
        assert!(out.is_empty() && !message.is_empty());
    }
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
