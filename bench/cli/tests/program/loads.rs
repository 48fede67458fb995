//! `simulate --loads`: load tables for the scene without a cage.

use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use epas_friction::LoadShare;
use tempfile::tempdir;

use super::{Run, STORED_UNCAGED, ran, run, told, words};

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

fn loads(folder: &Path, arguments: &str) -> Run {
    told(folder, &format!("simulate --loads {arguments}"))
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
        &words("simulate --loads --design lin-2.1 --format rust"),
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
    ran(
        path,
        "simulate --loads --design screw.toml --output shares.toml",
    );
    let table = fs::read_to_string(path.join("shares.toml")).unwrap();
    let built_in = run(&["simulate", "--loads", "--design", "lin-2.1"], "").stdout;
    let (own, built_in) = (shares(&table), shares(&built_in));
    assert_eq!(own.len(), 32);
    for (own, built_in) in own.iter().zip(&built_in) {
        // The file's angle is rounded to f32, and so are the built-in lengths.
        assert!((own - built_in).abs() < 1e-5, "{own} {built_in}");
    }
    let again = loads(path, "--design screw.toml --output shares.toml");
    again.refused("--force");

    // The scene takes the table of its own balls.
    ran(path, "simulate --loads --design lin-3.6 --output 37.toml");
    let table = fs::read_to_string(path.join("37.toml")).unwrap();
    let list = table.split_once("[uncaged]\n").unwrap().1;
    fs::write(path.join("whole.toml"), format!("{STORED_UNCAGED}{list}")).unwrap();
    ran(
        path,
        "simulate --scene uncaged --design whole.toml --manoeuvre turns --output out.csv",
    );
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
        let made = loads(path, &format!("--design {file} --axial-load=-1000"));
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

/// Text without the marks of comments and the breaks of lines.
fn folded_words(text: &str) -> String {
    text.split_whitespace()
        .filter(|word| *word != "#" && *word != "///" && *word != "//")
        .collect::<Vec<_>>()
        .join(" ")
}

/// The table of one load says which loads it serves: of a screw without errors most of 5 to 300 N a ball, of one with
/// 5 um of pitch error few around 500 N, and none where balls push against the load.
#[test]
fn a_table_says_which_loads_it_serves() {
    let made = run(&["simulate", "--loads", "--design", "lin-2.1"], "");
    let said = folded_words(&made.stdout);
    assert!(
        said.contains(
            "It serves loads of 667 to 9600 N and, the other way, of -552 to -9600 N within 1 % of"
        ),
        "{said}"
    );
    let folder = tempdir().unwrap();
    let path = folder.path();
    let file = format!("{DESIGN}{LOADS}pitch_error = 5e-6\n");
    fs::write(path.join("pitch.toml"), file).unwrap();
    for (axial_load, expected) in [
        ("5000", "It serves loads of 1"),
        (
            "500",
            "but none as large the other way, which takes a table of its own",
        ),
        (
            "100",
            "No table serves this load: even under it, this one errs by",
        ),
        (
            "-5000",
            "It serves loads of -1300 to -9600 N but none as large",
        ),
    ] {
        let made = loads(
            path,
            &format!("--design pitch.toml --axial-load={axial_load}"),
        );
        assert_eq!(made.code, 0, "{}", made.stderr);
        let said = folded_words(&made.stdout);
        assert!(said.contains(expected), "{axial_load}: {said}");
    }
}

/// Loads of a trace, from 5 N a ball on: one table where that serves, one for each sign where it does not, and the
/// sentence that says so; both go into the design file, and the scene runs with them.
#[test]
fn a_trace_gets_the_tables_it_needs() {
    let folder = tempdir().unwrap();
    let path = folder.path();
    fs::write(path.join("screw.toml"), format!("{DESIGN}{LOADS}")).unwrap();
    let trace = |name: &str, loads: &[f64]| {
        let mut text = String::from("time,nut_speed,axial_load\n");
        for (index, load) in loads.iter().enumerate() {
            let _ = writeln!(text, "{},1.0,{load}", index as f64 * 1e-3);
        }
        fs::write(path.join(name), text).unwrap();
    };
    trace("narrow.csv", &[4000.0, 0.0, 5000.0, -30.0, -5000.0]);
    trace("one.csv", &[100.0, 0.0, 3000.0, -20.0]);
    trace("wide.csv", &[50.0, 9000.0, -50.0, -9000.0]);
    let of = |name: &str| {
        let made = loads(path, &format!("--design screw.toml --input {name}"));
        assert_eq!(made.code, 0, "{name}: {}", made.stderr);
        (folded_words(&made.stdout), made.stdout)
    };
    // A hundredth of the largest load does not count: 20 N of 3000 N.
    let (said, _) = of("one.csv");
    assert!(
        said.contains("Loads of one: 160 to 3000 N. One table serves them all"),
        "{said}"
    );
    let (said, text) = of("wide.csv");
    for part in [
        "Loads of wide: 160 to 9000 N and -160 to -9000 N. One table does not serve them all",
        "160 to 9000 N: one table serves. The one computed at",
        "-160 to -9000 N: one table does not serve.",
        "It takes 2 tables, each of which --axial-load writes, to stay within 1 % of the grooves' friction \
         and 5 % of the largest ball load:",
    ] {
        assert!(said.contains(part), "{part}: {said}");
    }
    assert_eq!(shares(&text).len(), 2 * 32);
    assert!(text.contains("\nload_shares = [") && text.contains("\nnegative_load_shares = ["));
    let (said, text) = of("narrow.csv");
    assert!(said.contains("One table"), "{said}");
    assert!(text.contains("\nload_shares = ["));

    fs::write(
        path.join("uncaged.toml"),
        format!("{STORED_UNCAGED}{LOADS}"),
    )
    .unwrap();
    let made = loads(
        path,
        "--design uncaged.toml --input wide.csv --output shares.toml",
    );
    assert!(
        folded_words(&made.stdout).contains("one table does not serve"),
        "{}",
        made.stdout
    );
    let table = fs::read_to_string(path.join("shares.toml")).unwrap();
    let lists = table.split_once("[uncaged]\n").unwrap().1;
    fs::write(path.join("whole.toml"), format!("{STORED_UNCAGED}{lists}")).unwrap();
    let friction = |design: &str, trace: &str| {
        let line = "simulate --scene uncaged --output out.csv --force";
        ran(path, &format!("{line} --design {design} --input {trace}"));
        fs::read_to_string(path.join("out.csv")).unwrap()
    };
    trace("push.csv", &[1000.0; 20]);
    trace("pull.csv", &[-1000.0; 20]);
    let same = lists.split_once("# ").unwrap().0;
    fs::write(path.join("same.toml"), format!("{STORED_UNCAGED}{same}")).unwrap();
    assert_eq!(
        friction("whole.toml", "push.csv"),
        friction("same.toml", "push.csv")
    );
    assert_ne!(
        friction("whole.toml", "pull.csv"),
        friction("same.toml", "pull.csv")
    );
}

/// Several loads stand for all between them, and the other end of the screw gives other tables. Constants for
/// firmware have a name for each sign.
#[test]
fn several_loads_and_the_other_end() {
    let several = run(
        &words(
            "simulate --loads --design lin-3.6 --axial-load -11100,200,11100,-200 --format rust",
        ),
        "",
    );
    assert_eq!(several.code, 0, "{}", several.stderr);
    let said = folded_words(&several.stdout);
    assert!(
        said.contains("Loads of --axial-load: 200 to 11100 N and -200 to -11100 N."),
        "{said}"
    );
    assert!(said.contains("pub static LOAD_SHARES: [epas_friction::LoadShare; 37]"));
    assert!(said.contains("pub static NEGATIVE_LOAD_SHARES: [epas_friction::LoadShare; 37]"));

    let folder = tempdir().unwrap();
    let path = folder.path();
    let mut tables = Vec::new();
    for (end, way) in [("left", "from"), ("right", "towards")] {
        let file = format!("{DESIGN}{LOADS}loaded_end = \"{end}\"\n");
        fs::write(path.join("end.toml"), file).unwrap();
        let made = ran(path, "simulate --loads --design end.toml --output -");
        // The table alone, as it goes into a design file.
        let table: Result<toml::Table, _> = made.stdout.parse();
        assert!(table.is_ok(), "{}", made.stdout);
        let said = folded_words(&made.stdout);
        assert!(
            said.contains(&format!("along the loaded track {way} the end where")),
            "{said}"
        );
        tables.push(shares(&made.stdout));
    }
    assert_ne!(tables[0], tables[1]);
}

#[test]
fn what_gives_no_table_says_why() {
    let folder = tempdir().unwrap();
    let path = folder.path();
    fs::write(path.join("bare.toml"), DESIGN).unwrap();
    let bare = loads(path, "--design bare.toml");
    bare.refused("[loads]");
    // What the static model refuses, it names. (The tests of `epas_design::files` hold what is refused of the table.)
    for (from, to, said) in [
        ("axial_load = 5000", "axial_load = 0", "no ball carries"),
        (
            "screw_diameter = 0.032",
            "screw_diameter = 0.05",
            "screw_diameter",
        ),
    ] {
        let text = format!("{DESIGN}{}", LOADS.replace(from, to));
        fs::write(path.join("bad.toml"), text).unwrap();
        loads(path, "--design bad.toml").refused(said);
    }
    fs::write(path.join("good.toml"), format!("{DESIGN}{LOADS}")).unwrap();
    fs::write(
        path.join("idle.csv"),
        "time,nut_speed,axial_load\n0,1,0\n1,1,0\n",
    )
    .unwrap();
    for (arguments, said) in [
        ("--input idle.csv", "no load along the axis"),
        ("--input none.csv", "none.csv"),
        ("--axial-load=0,0", "no load along the axis"),
        ("--axial-load=1,inf", "axial_load"),
        ("--axial-load=1e9", "axial_load"),
        ("--manoeuvre stroke", "linear bearing"),
        ("--input idle.csv --output idle.csv", "idle.csv"),
    ] {
        let run = loads(path, &format!("--design good.toml {arguments}"));
        assert_eq!(
            (run.code, run.stdout.as_str()),
            (1, ""),
            "{arguments:?}: {}",
            run.stderr
        );
        assert!(run.stderr.contains(said), "{arguments:?}: {}", run.stderr);
    }
    for arguments in [
        "--loads",
        "--loads --design lin-2.1 --plot p.svg",
        "--loads --design lin-2.1 --manoeuvre parking --axial-load 5",
        "--loads --design lin-2.1 --manoeuvre parking --input t.csv",
        "--design lin-2.1 --manoeuvre parking --format rust",
    ] {
        let run = told(path, &format!("simulate {arguments}"));
        assert_eq!(run.code, 2, "{arguments}");
    }
}
