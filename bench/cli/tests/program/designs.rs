//! Design files that users start from: each is solved or run, and the page's commands are what they say.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use crate::{Run, told};

fn designs() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../designs")
}

/// A place with the files where the page has them.
fn place() -> tempfile::TempDir {
    let place = tempfile::tempdir().unwrap();
    let folder = place.path().join("bench/designs");
    fs::create_dir_all(&folder).unwrap();
    for entry in fs::read_dir(designs()).unwrap() {
        let entry = entry.unwrap();
        fs::copy(entry.path(), folder.join(entry.file_name())).unwrap();
    }
    place
}

/// Every command of the page runs, in its order, without a flag or a default that the file should have said; every file is in one of them.
#[test]
fn the_commands_of_the_page_run() {
    let place = place();
    let page = fs::read_to_string(designs().join("README.md")).unwrap();
    let commands = page.lines().filter_map(|line| line.strip_prefix("epas "));
    let mut used = BTreeSet::new();
    for command in commands {
        let command = command.split('#').next().unwrap().trim_end();
        let run = told(place.path(), command);
        assert_eq!(run.code, 0, "{command}: {}", run.stderr);
        assert!(
            !run.stdout.contains("beyond the static limit"),
            "{command}: {}",
            run.stdout
        );
        // What a preload is, is said: in N and GPa, of a contact and of the nut.
        let preload = run
            .stdout
            .lines()
            .find(|line| line.starts_with("preload: "));
        assert!(
            !command.contains("preloaded")
                || preload.is_some_and(|line| line.contains("GPa a contact, 800 N of the nut")),
            "{command}: {}",
            run.stdout
        );
        let flagged = run.stdout.lines().find(|line| line.starts_with("flagged"));
        assert!(
            flagged.is_none_or(|line| line.ends_with(" 0")),
            "{command}: {flagged:?}"
        );
        used.extend(
            command
                .split(' ')
                .filter(|word| word.starts_with("bench/designs"))
                .map(|path| Path::new(path).file_name().unwrap().to_owned()),
        );
    }
    for entry in fs::read_dir(designs()).unwrap() {
        let name = entry.unwrap().file_name();
        assert!(
            name == "README.md" || used.contains(&name),
            "{}",
            name.display()
        );
    }
    for word in [
        "conformity",
        "contact angle",
        "PCD",
        "lead",
        "ball diameter",
        "C0a",
    ] {
        assert!(page.contains(word), "{word}");
    }
}

/// `--new` writes the explained file, asks nothing, and leaves a file that is there.
#[test]
fn a_new_file_is_there_to_start_from() {
    let place = tempfile::tempdir().unwrap();
    let folder = place.path();
    let run = told(folder, "design --new gear.toml");
    assert_eq!(run.code, 0, "{}", run.stderr);
    let text = fs::read_to_string(folder.join("gear.toml")).unwrap();
    assert_eq!(
        text,
        fs::read_to_string(designs().join("rack-29x7.toml")).unwrap()
    );
    // Every key that is set has a comment.
    let keys = text.lines().filter(|line| line.contains(" = "));
    for line in keys.filter(|line| !line.trim_start().starts_with('#')) {
        assert!(line.contains(" # "), "{line}");
    }
    fs::write(folder.join("gear.toml"), "mine").unwrap();
    for (arguments, code, word) in [
        ("design --new gear.toml", 1, "--force"),
        ("design --new gear.txt", 1, ".toml"),
        ("design --new absent/gear.toml", 1, "absent is missing"),
        ("design --new other.toml --json", 2, "--json"),
        ("design --new other.toml lin-4.1", 2, "--new"),
    ] {
        let run = told(folder, arguments);
        assert_eq!(run.code, code, "{arguments}: {}", run.stderr);
        assert!(run.stderr.contains(word), "{arguments}: {}", run.stderr);
    }
    assert_eq!(
        fs::read_to_string(folder.join("gear.toml")).unwrap(),
        "mine"
    );
    assert!(!folder.join("absent").exists());
    assert_eq!(told(folder, "design --new gear.toml --force").code, 0);
    assert_eq!(fs::read_to_string(folder.join("gear.toml")).unwrap(), text);
}

/// The tables that stand as comments in the explained file are read where their # is gone, with a chart of the rows that it shows.
#[test]
fn commented_tables_of_a_new_file_are_read() {
    let text = fs::read_to_string(designs().join("rack-29x7.toml")).unwrap();
    let (start, tables) = text.split_once("# [loads]").unwrap();
    let keys = tables.lines().map(|line| {
        let key = line
            .strip_prefix("# ")
            .filter(|line| line.contains(" = ") && !line.starts_with("--"));
        key.or_else(|| line.strip_prefix("# ").filter(|line| line.starts_with('[')))
            .unwrap_or_default()
    });
    let keys: Vec<&str> = keys.collect();
    let start = start.replace("loaded_balls = 71", "loaded_balls = 37");
    let place = tempfile::tempdir().unwrap();
    let file = place.path().join("gear.toml");
    fs::write(&file, format!("{start}[loads]\n{}\n", keys.join("\n"))).unwrap();
    let heading = "angle_deg,deviation_deg\n";
    let rows = (0..8).map(|row| format!("{},0.01{row}\n", 45 * row));
    assert!(text.contains(heading.trim_end()));
    fs::write(
        place.path().join("screw.csv"),
        heading.to_owned() + &rows.collect::<String>(),
    )
    .unwrap();
    let design = epas_design::files::DesignSource::File(file).load().unwrap();
    assert!(design.loads.is_some() && design.uncaged.is_some());
}

/// A load beyond what a ball bears at rest gets a word, in `design` and in `simulate`.
#[test]
fn a_load_beyond_the_static_limit_gets_a_word() {
    let place = tempfile::tempdir().unwrap();
    let text = fs::read_to_string(designs().join("rack-29x7.toml")).unwrap();
    let text = text.replace("axial_load = [5, 300] ", "axial_load = [5, 3000] ");
    let text = text.replace("axial_load = 20000.0", "axial_load = 200000.0");
    fs::write(place.path().join("gear.toml"), text).unwrap();
    let trace = "time,nut_speed,axial_load\n0,10,100000\n0.001,10,100000\n";
    fs::write(place.path().join("trace.csv"), trace).unwrap();
    for arguments in [
        "design gear.toml",
        "simulate --design lin-4.1 --input trace.csv --output out.csv",
    ] {
        let run = told(place.path(), arguments);
        let line = run
            .stdout
            .lines()
            .find(|line| line.starts_with("beyond the static limit"));
        let line = line.unwrap_or_else(|| panic!("{arguments}: {} {}", run.stdout, run.stderr));
        assert!(line.contains("4.2 GPa"), "{line}");
    }
}

/// A 28 mm screw with play.
const PLAY: &str = "nominal_diameter = 0.028\nlead = 0.007\nball_diameter = 3.969e-3\nconformity = 0.54\ncontact_angle = 0.7853982\n\
                    loaded_balls = 60\nclearance = 2e-5\n";

/// What `design` refuses, `simulate` refuses with the same sentence, and writes nothing. (The tests of `epas-design` hold what is refused.)
#[test]
#[ignore = "folds a range of coefficients twice"]
fn a_block_that_is_far_off_is_refused_alike_whole() {
    let place = tempfile::tempdir().unwrap();
    let fold = "[fold]\nfriction = [0.02, 0.3]\naxial_load = [0.5, 300]\n";
    fs::write(place.path().join("gear.toml"), format!("{PLAY}{fold}")).unwrap();
    let [design, simulate] = [
        "design gear.toml",
        "simulate --design gear.toml --manoeuvre weave --output out.csv",
    ]
    .map(|arguments| told(place.path(), arguments));
    let sentence = |run: &Run| {
        let line = run.stderr.lines().find(|line| line.starts_with("error"));
        line.unwrap_or_else(|| panic!("{}", run.stdout)).to_owned()
    };
    assert_eq!((design.code, simulate.code), (1, 1));
    assert!(sentence(&design).contains("narrow the domain"));
    assert_eq!(sentence(&design), sentence(&simulate));
    assert!(!place.path().join("out.csv").exists());
}

/// Samples above the block say so with their loads; a manoeuvre is scaled to what the block holds, and a trace is not; one in degrees is asked for.
#[test]
fn loads_beyond_the_block_are_told() {
    let place = tempfile::tempdir().unwrap();
    let more = "[limits]\nnut_speed = 300\n[fold]\naxial_load = [5, 100]\n";
    fs::write(place.path().join("gear.toml"), format!("{PLAY}{more}")).unwrap();
    let trace = "time,nut_speed,axial_load\n0,1000,1000\n0.001,1000,12000\n0.002,-1000,9000\n";
    fs::write(place.path().join("trace.csv"), trace).unwrap();
    let simulate = |what: &str| {
        let run = told(
            place.path(),
            &format!("simulate --design gear.toml {what} --output out.csv --force"),
        );
        assert_eq!(run.code, 0, "{}", run.stderr);
        run.stdout
    };
    let said = simulate("--input trace.csv");
    for words in [
        "9000 to 12000 N on the screw (150 to 200 N a ball): the block holds 5 to 100 N a ball (axial_load in [fold])",
        "1000 rad/s, and nut_speed in [limits] is 300; is it in degrees or turns?",
    ] {
        assert!(said.contains(words), "{said}");
    }
    let said = simulate("--manoeuvre parking");
    for words in [
        "loads scaled by 0.414, from 14500 to 6000 N at most: the largest load of its block",
        "peak axial load                6000.0 N",
        "flagged samples                0",
    ] {
        assert!(said.contains(words), "{said}");
    }
}
