//! `design`: a block in every format, its certificate, and every way to ask wrongly.

use std::fs;
use std::path::Path;

use epas_friction::scene::{CagedConstants, FoldedBall};
use serde_json::Value;

use super::eval::number;
use super::{Run, STORED, names, ran, run_in, told};

/// A steering screw, without its friction coefficient.
const DESIGN: &str = "nominal_diameter = 0.028\nlead = 0.007\nball_diameter = 3.969e-3\nconformity = 0.54\n\
                      contact_angle = 0.7853982\nclearance = 0\nloaded_balls = 60\n";

fn design(folder: &Path, arguments: &str) -> Run {
    told(folder, &format!("design {arguments}"))
}

/// Words of a text form: each is written as `0x` and eight digits.
fn words(text: &str) -> Vec<u32> {
    text.split(|letter: char| !letter.is_ascii_alphanumeric())
        .filter_map(|word| u32::from_str_radix(word.strip_prefix("0x")?, 16).ok())
        .collect()
}

fn words_of_bytes(bytes: &[u8]) -> Vec<u32> {
    bytes
        .chunks(4)
        .map(|word| u32::from_le_bytes(word.try_into().unwrap()))
        .collect()
}

/// On standard output the block stands alone, and the certificate beside it.
#[test]
fn a_block_goes_to_standard_output() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let fold = "[fold]\naxial_load = [50, 200]\nseed = 7\n";
    fs::write(folder.join("screw.toml"), format!("{DESIGN}{fold}")).unwrap();
    let run = design(folder, "screw.toml --format rust");
    assert_eq!(run.code, 0, "{}", run.stderr);
    assert!(run.stdout.starts_with("// ") && run.stderr.contains("caged_torque"));
    assert!(run.stdout.contains("pub static SCREW: "));
    assert!(run.stderr.contains("seed 7"), "{}", run.stderr);
    assert!(run.stderr.contains("50 to 200 N"), "{}", run.stderr);
    CagedConstants::<1>::from_block(&words(&run.stdout)).unwrap();
    assert_eq!(names(folder), ["screw.toml"]);
}

/// Balls that press on each other have a block of their own, over the deviations of their grooves.
#[test]
#[ignore = "folds and certifies a ball that others press: twenty seconds"]
fn a_block_without_cage_holds_deviations_whole() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let row = "[uncaged]\nballs = 20\nturns = 1\nscrew_deviation = [{ order = 1, sine = 2e-3 }]\n";
    let fold = "[fold]\naxial_load = [20, 30]\n";
    let own = DESIGN.replace("loaded_balls = 60", "loaded_balls = 20");
    let text = format!("friction = 0.1\n{own}{row}{fold}");
    fs::write(folder.join("screw.toml"), &text).unwrap();
    let run = design(
        folder,
        "screw.toml --scene uncaged --json --output ball.bin",
    );
    assert_eq!(run.code, 0, "{}", run.stderr);
    let said: Value = serde_json::from_str(&run.stdout).unwrap();
    let words = words_of_bytes(&fs::read(folder.join("ball.bin")).unwrap());
    let block = FoldedBall::<1>::read(&words).unwrap();
    assert!((block.law.deviations[0] - 2e-3).abs() < 1e-5 && block.law.deviations[1] == 1e-4);
    assert_eq!(number(&said["bytes"]) as usize, 4 * words.len());
    assert_eq!(number(&said["domain"]["axial_load"][1]), 30.0);
    let reach = number(&said["domain"]["screw_deviation"][1]);
    assert_eq!(number(&said["domain"]["screw_deviation"][0]), -reach);
    for (place, (name, unit)) in [
        ("ring_torque", "relative"),
        ("ring_force", "of the largest"),
    ]
    .into_iter()
    .enumerate()
    {
        let figure = &said["certificate"][place];
        assert_eq!(
            (&figure["quantity"], &figure["unit"]),
            (&name.into(), &unit.into())
        );
        assert!(
            number(&figure["rms"]) <= number(&figure["largest"]),
            "{figure}"
        );
    }
}

/// What cannot be folded says why, and leaves nothing.
#[test]
fn refusals_name_their_reason_and_leave_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    for (addition, word) in [
        ("branch = \"rolling\"", "closed form"),
        ("[fold]\nscrew_deviation = 0.2", "0.0001 to 0.1"),
        ("[fold]\nnut_deviation = -0.01", "nut_deviation"),
        ("[fold]\nfriction = 0.9", "friction"),
        ("[fold]\nfriction = [0.2, 0.3]", "0.1 (default)"),
        ("[fold]\nfriction = [0.12, 0.08]", "friction"),
        ("[fold]\nfriction = \"low\"", "[least, most]"),
        ("[fold]\naxial_load = [300, 5]", "axial_load"),
        ("[fold]\naxial_load = [0, 5]", "axial_load"),
        ("[fold]\naxial_load = 5", "axial_load"),
        ("[fold]\nseed = -1", "seed"),
        ("[fold]\nloads = [1, 2]", "loads"),
        ("conformity = 0.5", "conformity"),
    ] {
        let text = if addition.starts_with("conformity") {
            DESIGN.replace("conformity = 0.54", addition)
        } else {
            format!("{DESIGN}{addition}\n")
        };
        fs::write(folder.join("screw.toml"), text).unwrap();
        let run = design(folder, "screw.toml --output gear.rs");
        assert_eq!(run.code, 1, "{addition}: {}", run.stderr);
        assert!(run.stderr.contains(word), "{addition}: {}", run.stderr);
        assert!(run.stdout.is_empty());
        assert_eq!(names(folder), ["screw.toml"]);
    }
    // Simulation with a cage takes the file: its balls feel no deviations.
    let fold = "[fold]\nscrew_deviation = 0.01\n";
    fs::write(folder.join("screw.toml"), format!("{STORED}{fold}")).unwrap();
    let line = "simulate --design screw.toml --manoeuvre kerb --output kerb.csv";
    ran(folder, line);
}

/// A file that is there stays, and an output is not called what it is not. What replaces it is of the table's coefficient.
#[test]
fn outputs_of_a_block_are_safe() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let fold = "[fold]\nfriction = 0.05\naxial_load = [100, 120]\n";
    let text = format!("friction = 0.1\n{DESIGN}{fold}");
    fs::write(folder.join("screw.toml"), &text).unwrap();
    fs::write(folder.join("gear.rs"), "mine").unwrap();
    for (arguments, code, word) in [
        ("screw.toml --output gear.rs", 1, "--force"),
        ("screw.toml --output screw.toml --force", 1, "twice"),
        ("screw.toml --output gear.csv", 1, ".bin"),
        ("screw.toml --output gear.h --format rust", 1, ".rs"),
        ("lin-3.3", 1, "linear"),
        ("lin-4.1 --scene uncaged", 1, "[uncaged]"),
        ("absent.toml", 1, "absent.toml"),
        ("screw.toml --output gear.dat", 2, "--format"),
        ("screw.toml --format rust --json", 2, "--output"),
        ("screw.toml --output - --format c --json", 2, "--output"),
        ("screw.toml --force", 2, "--output"),
        ("screw.toml --format pdf", 2, "binary"),
        ("screw.toml --format c99", 2, "gear.c"),
        (
            "screw.toml --scene uncaged --output gear.c",
            1,
            "static library",
        ),
        ("33x20x6.35", 2, "simulate --list"),
    ] {
        let run = design(folder, arguments);
        assert_eq!(run.code, code, "{arguments}: {}", run.stderr);
        assert!(run.stderr.contains(word), "{arguments}: {}", run.stderr);
        assert!(run.stdout.is_empty());
    }
    assert_eq!(run_in(folder, &["design"], "").code, 2);
    assert_eq!(names(folder), ["gear.rs", "screw.toml"]);
    assert_eq!(fs::read_to_string(folder.join("gear.rs")).unwrap(), "mine");
    assert_eq!(fs::read_to_string(folder.join("screw.toml")).unwrap(), text);
    let run = design(folder, "screw.toml --output gear.rs --force");
    assert_eq!(run.code, 0, "{}", run.stderr);
    // The type that a struct or a static takes.
    let typed = "let mut model: FrictionModel<CagedBallScrew, &'static CagedConstants> = FrictionModel::of(&GEAR);";
    assert!(run.stdout.contains(typed), "{}", run.stdout);
    let text = fs::read_to_string(folder.join("gear.rs")).unwrap();
    assert!(
        text.contains("friction coefficients 0.05 to 0.05"),
        "{text}"
    );
    CagedConstants::<1>::from_block(&words(&text)).unwrap();
}

/// A source and the header that it includes, of a caged screw with its memory.
#[test]
fn c99_is_a_source_and_its_header() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let fold = "[fold]\naxial_load = [100, 120]\n";
    fs::write(
        folder.join("screw.toml"),
        format!("friction = 0.1\n{DESIGN}{fold}"),
    )
    .unwrap();
    let more = "branch = \"rolling\"\n";
    fs::write(folder.join("no.toml"), format!("{DESIGN}{more}")).unwrap();
    let run = design(folder, "no.toml --output my-gear.c");
    assert_eq!(run.code, 1, "{}", run.stderr);
    assert!(run.stderr.contains("static library"), "{}", run.stderr);
    let calibration =
        "[calibration]\nbreakaway_angle = 1e-3\nelements = \"preloaded\"\nlargest_load = 2e4\n";
    let oversize = DESIGN.replace("clearance = 0", "clearance = -2e-6");
    fs::write(
        folder.join("calibrated.toml"),
        format!("friction = 0.1\n{oversize}{fold}{calibration}"),
    )
    .unwrap();
    let run = design(folder, "calibrated.toml --output calibrated.c");
    assert_eq!(run.code, 0, "{}", run.stderr);
    let source = fs::read_to_string(folder.join("calibrated.c")).unwrap();
    assert!(source.contains("#define FLANKS_SUM "), "{source}");
    let run = design(folder, "screw.toml --output my-gear.c");
    assert_eq!(run.code, 0, "{}", run.stderr);
    assert_eq!(
        names(folder),
        [
            "calibrated.c",
            "calibrated.h",
            "calibrated.toml",
            "my-gear.c",
            "my-gear.h",
            "no.toml",
            "screw.toml"
        ]
    );
    let read = |name| fs::read_to_string(folder.join(name)).unwrap();
    let (source, header) = (read("my-gear.c"), read("my-gear.h"));
    assert!(source.contains("#include \"my-gear.h\"") && source.contains("#define NODES 1u"));
    assert!(
        source.contains("0x1.111112p-6f /* 0.016666668, 1 over loaded balls */"),
        "{source}"
    );
    assert!(
        header.contains("void my_gear_step(my_gear_t *model,") && header.contains("certificate: ")
    );
    assert!(!source.contains('@') && !header.contains('@'));
    assert!(run.stdout.contains("-ffp-contract=off"), "{}", run.stdout);
}

/// Each block that the program brings with it has the bits of a new fold.
#[test]
#[ignore = "folds every built-in design, which takes a minute"]
fn built_in_designs_are_stored_as_they_are_folded() {
    let run = design(Path::new("."), "--gate");
    assert_eq!(run.code, 0, "{}", run.stderr);
    assert!(
        run.stdout.contains("the bits of a new fold"),
        "{}",
        run.stdout
    );
}

#[test]
fn storing_and_comparing_take_no_design() {
    for arguments in [
        "lin-4.1 --gate",
        "lin-4.1 --store",
        "--store --gate",
        "--json",
    ] {
        let run = design(Path::new("."), arguments);
        assert_eq!(run.code, 2, "{arguments}: {}", run.stderr);
    }
}

/// Elsewhere than in their own checkout both do nothing, at once: sources of another folder are not the user's to change.
#[test]
fn storing_and_comparing_are_refused_outside_the_checkout() {
    let place = tempfile::tempdir().unwrap();
    for arguments in ["--store", "--gate"] {
        let run = design(place.path(), arguments);
        assert_eq!(run.code, 1, "{arguments}: {}", run.stderr);
        assert!(run.stderr.contains("in the checkout"), "{}", run.stderr);
        assert!(names(place.path()).is_empty());
    }
}
