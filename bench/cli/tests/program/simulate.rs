//! `simulate`: manoeuvres, traces and designs of users, and what is refused.

use std::fs;

use tempfile::{TempDir, tempdir};

use super::{STORED, column, names, ran, run, run_in, texts, told, words};

const TRACE: &str = "time,nut_speed,axial_load\n0,10,1000\n0.001,0,-1000\n0.002,-10,1000\n";

const DESIGN: &str = "\
name = \"rack\"
nominal_diameter = 0.032
lead = 0.02
ball_diameter = 6.35e-3
conformity = 0.528
contact_angle = 0.7853982
friction = 0.1
preload = 7
loaded_balls = 40
";

fn folder() -> TempDir {
    let folder = tempdir().unwrap();
    fs::write(folder.path().join("trace.csv"), TRACE).unwrap();
    fs::write(folder.path().join("design.toml"), DESIGN).unwrap();
    folder
}

fn stored_folder() -> TempDir {
    let folder = folder();
    fs::write(folder.path().join("design.toml"), STORED).unwrap();
    folder
}

#[test]
fn the_list_holds_every_built_in_design() {
    let list = run(&["simulate", "--list"], "");
    let designs = list.stdout.lines().take_while(|line| !line.is_empty());
    assert_eq!((list.code, designs.count()), (0, 53));
    for name in words("25x5x3.175 28x7x3.969 32x20x6.35 20x60x3.5 lin-2.1 lin-3.3 lin-3.6 lin-4.1")
    {
        assert!(list.stdout.lines().any(|line| line.starts_with(name)));
    }
    // One friction coefficient for both scenes.
    let both = |line: &&str| {
        line.contains("friction 0.100, clearance  0.0 um") && line.contains("uncaged also: ")
    };
    assert_eq!(list.stdout.lines().filter(both).count(), 1);
}

#[test]
fn standard_input_and_output_are_a_dash() {
    let folder = stored_folder();
    ran(
        folder.path(),
        "simulate --design design.toml --input trace.csv --output out.csv",
    );
    let table = fs::read_to_string(folder.path().join("out.csv")).unwrap();
    let dash = words("simulate --design design.toml --input - --output -");
    let run = run_in(folder.path(), &dash, TRACE);
    assert_eq!((run.code, run.stdout), (0, table.clone()), "{}", run.stderr);
    let design = words("simulate --design - --input trace.csv --output -");
    let run = run_in(folder.path(), &design, STORED);
    assert_eq!((run.code, run.stdout), (0, table), "{}", run.stderr);
    let both = ["simulate", "--design", "-", "--input", "-"];
    let run = run_in(folder.path(), &both, STORED);
    run.refused("can be read once");
    assert!(!names(folder.path()).contains(&"-".to_string()));
}

#[test]
fn a_mapping_comes_from_standard_input_too() {
    let folder = stored_folder();
    let measured = "simulate --design design.toml --input trace.csv --output";
    ran(folder.path(), &format!("{measured} out.mf4"));
    let mapped = words("simulate --design design.toml --input out.mf4 --output - --channels -");
    let run = run_in(
        folder.path(),
        &mapped,
        "nut_speed = \"nut_speed\"\naxial_load = \"axial_load\"\n",
    );
    assert_eq!(run.code, 0, "{}", run.stderr);
    let there = told(folder.path(), &format!("{measured} -"));
    assert_eq!(run.stdout, there.stdout);
    let wrong = run_in(
        folder.path(),
        &mapped,
        "nut_speed = \"nut_speed\"\naxial_load = \"no_such\"\n",
    );
    wrong.refused("no_such");
}

#[test]
fn a_name_that_is_near_is_suggested() {
    let run = run(
        &words("simulate --design 25x5x3.17 --manoeuvre parking"),
        "",
    );
    assert!(
        run.code == 2 && run.stderr.contains("perhaps 25x5x3.175"),
        "{}",
        run.stderr
    );
}

/// The model runs over a manoeuvre beside one ball in exact balance.
fn runs_beside_the_reference(manoeuvre: &str) {
    let folder = tempdir().unwrap();
    let line =
        format!("simulate --manoeuvre {manoeuvre} --output out.csv --plot out.svg --reference");
    let run = ran(folder.path(), &line);
    assert_eq!(names(folder.path()), ["out.csv", "out.svg"]);
    let svg = fs::read_to_string(folder.path().join("out.svg")).unwrap();
    assert!(svg.starts_with("<svg") && svg.contains("friction torque (N m)"));

    let mut reader = csv::Reader::from_path(folder.path().join("out.csv")).unwrap();
    let heads: Vec<_> = reader.headers().unwrap().iter().map(String::from).collect();
    assert_eq!(
        heads,
        words(
            "time nut_speed axial_load friction_torque load_torque efficiency regime faults fault_words reference_friction_torque reference_efficiency"
        )
    );
    let mut largest = 0.0_f64;
    let mut worst = 0.0_f64;
    let mut count = 0;
    for record in reader.records() {
        let record = record.unwrap();
        let number = |index: usize| record[index].parse::<f64>().unwrap();
        assert_eq!(&record[7], "0");
        assert_eq!(&record[8], "");
        largest = largest.max(number(9).abs());
        worst = worst.max((number(3) - number(9)).abs());
        // The law over the load and the slip maps against a ball with exact integrals: 1.1 % of the friction, which is a
        // tenth of the work.
        assert!((number(5) - number(10)).abs() < 3e-3, "{record:?}");
        count += 1;
    }
    assert!(
        count > 5000 && worst < 1.5e-2 * largest,
        "{worst:e} of {largest}"
    );
    assert!(run.stdout.contains("peak friction torque"));
    assert!(run.stdout.contains("f64 is one ball in elastic balance\n"));
}

#[test]
fn a_manoeuvre_runs_beside_the_reference() {
    runs_beside_the_reference("weave");
}

#[test]
#[ignore = "the exact ball over two more manoeuvres"]
fn manoeuvres_run_beside_the_reference_whole() {
    for manoeuvre in ["parking", "kerb"] {
        runs_beside_the_reference(manoeuvre);
    }
}

#[test]
fn a_users_trace_and_design_give_their_own_numbers() {
    let folder = folder();
    let run = ran(
        folder.path(),
        "simulate --design design.toml --input trace.csv --output out.csv",
    );
    assert_eq!(
        names(folder.path()),
        ["design.toml", "out.csv", "trace.csv"]
    );
    let regimes = texts(&folder.path().join("out.csv"), "regime");
    assert_eq!(regimes, ["driving", "standing", "back-driving"]);
    assert!(run.stdout.contains("rack") && run.stdout.contains("40 loaded balls"));
    assert!(run.stdout.contains("2 rad/s (default)") && !run.stdout.contains("um (default)"));
}

#[test]
fn default_names_say_what_was_run() {
    let folder = folder();
    ran(folder.path(), "simulate --design lin-3.6 --input trace.csv");
    assert_eq!(
        names(&folder.path().join("target").join("simulate")),
        ["trace-lin-3.6.csv", "trace-lin-3.6.svg"]
    );
}

/// In a parking manoeuvre balls of `lin-3.6` lose contacts while they press, for a moment; its torque is held all the time.
#[test]
fn a_flag_says_which_output_is_not_held() {
    let folder = folder();
    let run = ran(
        folder.path(),
        "simulate --design lin-3.6 --scene uncaged --manoeuvre parking",
    );
    let said = format!("{}{}", run.stdout, run.stderr);
    let line = said
        .lines()
        .find(|line| line.starts_with("flagged samples"));
    let flagged = line.unwrap_or_else(|| panic!("{said}"));
    // Of 12001 samples.
    let count: usize = flagged.split_whitespace().nth(2).unwrap().parse().unwrap();
    assert!((1..=600).contains(&count), "{flagged}");
    assert!(!flagged.contains("beyond the model"), "{flagged}");
    assert!(said.lines().any(|line| line.starts_with("forces not held")));
}

#[test]
fn a_plot_in_the_way_leaves_no_table() {
    let folder = folder();
    fs::write(folder.path().join("out.svg"), "precious").unwrap();
    let run = told(
        folder.path(),
        "simulate --design lin-4.1 --input trace.csv --output out.csv --plot out.svg",
    );
    assert_eq!(run.code, 1);
    assert_eq!(
        names(folder.path()),
        ["design.toml", "out.svg", "trace.csv"]
    );
}

/// (The tests of `simulate::trace` hold what is refused of a table, each with its word.)
#[test]
fn a_malformed_trace_stops_with_its_line_and_leaves_nothing() {
    let folder = folder();
    let text = "time,nut_speed,axial_load\n0,1,2\n1,fast,2\n";
    fs::write(folder.path().join("trace.csv"), text).unwrap();
    let run = told(
        folder.path(),
        "simulate --design lin-4.1 --input trace.csv --output out.csv --plot out.svg",
    );
    run.refused("trace.csv: line 3: nut_speed");
    assert_eq!(names(folder.path()), ["design.toml", "trace.csv"]);
}

/// (The tests of `epas_design::files` hold what is refused of a design file, each with its word.)
#[test]
fn a_wrong_design_file_is_named_with_its_field() {
    let folder = folder();
    for (addition, words) in [
        ("", "design.toml: loaded_balls is missing"),
        (
            "loaded_balls = 40\nlimits = { nut_speed = -1 }",
            "limits: nut_speed = -1",
        ),
        ("name = ", "line 9"),
    ] {
        let design = DESIGN.replace("loaded_balls = 40", addition);
        fs::write(folder.path().join("design.toml"), design).unwrap();
        let run = told(
            folder.path(),
            "simulate --design design.toml --manoeuvre kerb --output out.csv",
        );
        run.refused(words);
        assert_eq!(names(folder.path()), ["design.toml", "trace.csv"]);
    }
    let missing = told(
        folder.path(),
        "simulate --design no-such-design.toml --manoeuvre kerb",
    );
    missing.refused("no-such-design.toml");
}

#[test]
fn a_mechanism_tells_one_moment_in_a_row() {
    const INERTIA: f64 = 1e-3;
    const TICK: f64 = 1e-4;
    let folder = stored_folder();
    let rows = (0..100).map(|tick| format!("{},{},1000\n", f64::from(tick) * TICK, 4.0));
    let trace: String = std::iter::once("time,motor_torque,axial_load\n".to_owned())
        .chain(rows)
        .collect();
    fs::write(folder.path().join("torque.csv"), trace).unwrap();
    let line = format!(
        "simulate --mechanism --design design.toml --inertia {INERTIA} --input torque.csv --output out.csv"
    );
    let run = ran(folder.path(), &line);
    assert!(
        run.stdout.contains("flagged samples                0"),
        "{}",
        run.stdout
    );
    let [time, position, speed, friction, load] = [
        "time",
        "nut_position",
        "nut_speed",
        "friction_torque",
        "load_torque",
    ]
    .map(|name| column(folder.path(), name));
    assert_eq!([time[0], position[0], speed[0], friction[0]], [0.0; 4]);
    // It slides; the step is divided in four, over which friction hardly changes.
    for row in 60..100 {
        let torque = 4.0 - load[row] - friction[row];
        let difference = speed[row] - speed[row - 1] - torque * TICK / INERTIA;
        assert!(
            friction[row] > 0.01 && difference.abs() < 1e-3 * speed[row],
            "{row}"
        );
    }
}

/// Away from reversals friction is that without memory; a reversal takes an angle, not a speed, and the summary names
/// stiffness and breakaway.
#[test]
fn friction_remembers_where_it_is_asked_for() {
    let folder = stored_folder();
    // The design's reversal speed is far below the speed of the trace: without memory friction is full there.
    // Forward, back by little, forward again, and back for good; 1 kHz.
    let rows = (0..400).map(|tick| {
        let speed = match tick {
            100..102 => -0.02,
            0..200 => 5.0,
            _ => -5.0,
        };
        format!("{},{speed},1000\n", f64::from(tick) * 1e-3)
    });
    let trace: String = std::iter::once("time,nut_speed,axial_load\n".to_owned())
        .chain(rows)
        .collect();
    fs::write(folder.path().join("reversal.csv"), trace).unwrap();
    for (design, scene) in [("design.toml", "caged"), ("lin-3.6", "uncaged")] {
        let run = |memory: &str| {
            let line = format!(
                "simulate --design {design} --scene {scene} --input reversal.csv --output out.csv --force{memory}"
            );
            let said = ran(folder.path(), &line).stdout;
            let regimes = texts(&folder.path().join("out.csv"), "regime");
            (column(folder.path(), "friction_torque"), regimes, said)
        };
        let (plain, _, said) = run("");
        assert!(!said.contains("initial stiffness"));
        let (friction, regimes, said) = run(" --memory");
        assert!(
            said.contains("initial stiffness") && said.contains("breakaway angle"),
            "{said}"
        );
        // Friction builds up; sliding, both are the same but for what the passage by the speed leaves off.
        assert!(friction[0] < 0.99 * friction[99]);
        for tick in [99, 199, 399] {
            let difference = (friction[tick] - plain[tick]).abs();
            assert!(
                difference < 0.02 * plain[tick].abs(),
                "{scene} {tick}: {friction:?}"
            );
        }
        // Back by 40 microradians: without memory friction turns round, with it hardly a part is lost.
        assert!(
            plain[101] < 0.0 && friction[101] > 0.5 * friction[99],
            "{scene}"
        );
        assert_eq!(regimes[101], "standing");
        assert_ne!(regimes[399], "standing");
    }
    let stroke = ran(
        folder.path(),
        "simulate --manoeuvre stroke --memory --output s.csv",
    );
    assert!(stroke.stdout.contains("N/m, full sliding after"));
}
