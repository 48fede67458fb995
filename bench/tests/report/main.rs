//! The program as its users start it: what it refuses, and what stands in the folder of a run.
//!
//! No test makes a report: CI runs the main job, and then the tests that are ignored here look at what it has left in `target/report`:
//!
//! ```text
//! cargo run --release -p epas-bench -- --gate
//! cargo test -p epas-bench --test report -- --ignored
//! ```

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use serde_json::Value;
use tempfile::tempdir;

/// The program with its arguments, in a folder.
fn program(folder: &Path, arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_epas-bench"));
    command.args(arguments).current_dir(folder);
    command
}

/// Exit code, standard output and standard error of a run.
fn run(folder: &Path, arguments: &[&str]) -> (Option<i32>, String, String) {
    let output = program(folder, arguments).output().unwrap();
    let text = |bytes| String::from_utf8(bytes).unwrap();
    (
        output.status.code(),
        text(output.stdout),
        text(output.stderr),
    )
}

#[test]
fn help_names_every_option_in_short_paragraphs() {
    let (code, help, _) = run(Path::new("."), &["--help"]);
    assert_eq!(code, Some(0));
    for option in [
        "--output", "--full", "--rounds", "--store", "--gate", "--force",
    ] {
        assert!(help.contains(option), "{option}");
    }
    for paragraph in help.split("\n\n") {
        let words = paragraph.split_whitespace().count();
        assert!(words <= 60, "{words} words: {paragraph}");
    }
}

/// A value out of its range is told the range; what is no option ends with code 2 as well.
#[test]
fn wrong_usage_ends_with_code_2() {
    for (arguments, word) in [
        (&["--rounds", "-1"][..], "rounds are 1 to"),
        (&["--rounds", "0"], "rounds are 1 to"),
        (&["--rounds", "many"], "rounds are 1 to"),
        (&["--output"], "a value is required"),
        (&["--store", "--full"], "cannot be used"),
        (&["report"], "unexpected argument"),
        (&["--quick"], "unexpected argument"),
    ] {
        let (code, out, message) = run(Path::new("."), arguments);
        assert_eq!(code, Some(2), "{arguments:?}: {message}");
        assert!(
            out.is_empty() && message.contains(word),
            "{arguments:?}: {message}"
        );
    }
}

/// A page of another stands in the way before anything is computed; a folder that is a file as well, and one whose parent is missing.
#[test]
fn the_report_of_another_stays() {
    let folder = tempdir().unwrap();
    let mine = folder.path().join("report.md");
    fs::write(&mine, "# Minutes of Monday\n").unwrap();
    for output in [".", "report.md", "report.md/below", "absent/report"] {
        let (code, out, message) = run(folder.path(), &["--output", output]);
        assert_eq!(code, Some(1), "{message}");
        assert!(out.is_empty() && !message.contains("[1/"), "{message}");
    }
    assert_eq!(fs::read_to_string(mine).unwrap(), "# Minutes of Monday\n");
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
}

/// Files are written when everything is computed, each beside its place first: a run that is cancelled leaves none.
#[test]
fn a_cancelled_report_leaves_no_file() {
    let folder = tempdir().unwrap();
    let mut child = program(folder.path(), &["--full", "--output", "out"])
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    std::thread::sleep(std::time::Duration::from_millis(300));
    child.kill().unwrap();
    assert!(!child.wait().unwrap().success());
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
}

/// The folder that the main job fills by default.
fn report() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../target/report")
}

fn read(name: &str) -> String {
    let path = report().join(name);
    fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// Every figure and table is there in each of its forms, with as many rows in one as in the other.
#[test]
#[ignore = "reads target/report, which the main job makes"]
fn every_figure_and_table_is_a_file_of_the_last_run() {
    let json: Value = serde_json::from_str(&read("report.json")).unwrap();
    let markdown = read("report.md");
    let blocks = json.as_object().unwrap();
    for (name, block) in blocks {
        let csv = read(&format!("{name}.csv"));
        if block["panels"].is_array() {
            assert!(read(&format!("{name}.svg")).starts_with("<svg"), "{name}");
            assert!(markdown.contains(&format!("({name}.svg)")), "{name}");
            assert!(csv.lines().count() > 1, "{name}");
        } else {
            let rows = block["rows"].as_array().unwrap();
            assert!(!rows.is_empty(), "{name}");
            assert_eq!(csv.lines().count(), rows.len() + 1, "{name}");
        }
    }
    // One of each section at least: what a run has left out is missed here.
    for name in [
        "summary",
        "error_against_time",
        "accuracy",
        "friction",
        "friction_over_a_manoeuvre",
        "flagship",
        "exact_pairs_maps",
        "train_times_picture",
        "stability",
        "stability_maps",
        "two_point_contact",
        "recorded_sweeps",
        "known_limits",
        "promises",
        "target_functions",
        "target_scenes",
        "target_budgets",
        "error_against_cycles",
        "linear_ball_errors",
        "screw_pair_force",
        "curvature_times",
        "hertz",
        "kernels",
    ] {
        assert!(blocks.contains_key(name), "{name}");
    }
    // The processor, the compiler and the day are named.
    assert!(markdown.contains("built by rustc ") && markdown.contains("Made on 2"));
}

/// The page holds each picture, links each section in its order, and asks for nothing: no script, style sheet or picture from elsewhere.
#[test]
#[ignore = "reads target/report, which the main job makes"]
fn the_page_is_whole_in_itself_of_the_last_run() {
    let json: Value = serde_json::from_str(&read("report.json")).unwrap();
    let page = read("report.html");
    let pictures = json
        .as_object()
        .unwrap()
        .values()
        .filter(|block| block["panels"].is_array())
        .count();
    assert_eq!(page.matches("<figure id=\"figure-").count(), pictures);
    let own = page
        .replace("http://www.w3.org/2000/svg", "")
        .replace("<link rel=\"icon\" href=\"data:,\">", "");
    for link in ["src=", "<link", "@import", "url(", "http:", "https:"] {
        assert!(!own.contains(link), "{link}");
    }
    let after = |mark: &str| -> Vec<String> {
        page.split(mark)
            .skip(1)
            .filter_map(|rest| rest.split('"').next().map(String::from))
            .collect()
    };
    let sections = after("<details class=\"section\" id=\"");
    assert_eq!(after("<a href=\"#"), sections);
    assert!(sections.len() >= 7, "{sections:?}");
}

/// Every worst case of the error maps, asked as the line that the table prints, gives the error of the table; no map is empty.
#[test]
#[ignore = "reads target/report, which the main job makes"]
fn worst_cases_are_reproduced_of_the_last_run() {
    let json: Value = serde_json::from_str(&read("report.json")).unwrap();
    let table = &json["stability"];
    let columns = table["columns"].as_array().unwrap();
    let rows = table["rows"].as_array().unwrap();
    assert_eq!(rows.len(), 18);
    for row in rows {
        let cell = |name: &str| {
            let place = columns.iter().position(|column| column == name).unwrap();
            &row[place]
        };
        let request = cell("worst case").as_str().unwrap();
        let answer: Value = serde_json::from_str(&epas_eval::answer_line(request)).unwrap();
        let number = |side: &str, place: &str| {
            let number = answer[side].pointer(cell(place).as_str().unwrap());
            number.and_then(Value::as_f64).unwrap()
        };
        let over = if cell("error over") == "" {
            1.0
        } else {
            number("reference", "error over")
        };
        let error = (number("in_loop", "in_loop") - number("reference", "reference")) / over;
        let printed = cell("largest").as_f64().unwrap();
        // The report and this test read the same digits.
        assert!(
            (error.abs() - printed).abs() <= 1e-12 * printed,
            "{row}: {error}"
        );
        assert!(cell("inputs").as_f64().unwrap() >= 30.0, "{row}");
    }
}
