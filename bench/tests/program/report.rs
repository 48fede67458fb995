//! `report`: what it prints and what it writes.

use std::fs;

use serde_json::Value;
use tempfile::tempdir;

use super::{run, run_in};

#[test]
fn the_report_reproduces_the_printed_tables_and_writes_every_figure() {
    let folder = tempdir().unwrap();
    fs::create_dir(folder.path().join("out")).unwrap();
    let run = run_in(
        folder.path(),
        &["report", "--quick", "--output", "out/report"],
        "",
    );
    assert_eq!(run.code, 0, "{}", run.stderr);
    assert!(run.stdout.contains("248 of 248"), "{}", run.stdout);

    let report = folder.path().join("out").join("report");
    let read = |name: &str| fs::read_to_string(report.join(name)).unwrap();
    let (page, markdown) = (read("report.html"), read("report.md"));
    let json: Value = serde_json::from_str(&read("report.json")).unwrap();
    let figures = [
        "friction_over_a_manoeuvre",
        "error_against_time",
        "curvature_figure_8",
        "curvature_figure_9",
        "curvature_figure_10",
        "curvature_figure_11",
        "efficiency_figure_3",
        "efficiency_figure_5",
        "efficiency_figure_6",
        "efficiency_figure_7",
        "hertz",
        "linear_ball_errors",
        "screw_pair_force",
        "exact_pairs_maps",
        "lin_figures_3_24_3_25_exact",
        "closed_forms_of_a_ball",
        "train_times_picture",
        "lin_figure_4_3",
        "lin_figure_4_5",
        "lin_figures_2_9_2_10",
        "lin_figures_2_11_2_12",
        "lin_figure_2_14",
        "lin_figure_4_10",
        "lin_figure_3_7",
        "lin_figure_3_14",
        "lin_figure_3_15",
        "lin_figure_4_7",
        "efficiency_over_lead_picture",
        "what_decides_picture",
        "stability_maps",
        "two_point_contact",
        "memory_loops",
        "memory_error_against_cycles",
        "memory_drift",
        "memory_energy_picture",
        "memory_load_maps",
        "memory_noise_picture",
    ];
    for figure in figures {
        assert!(read(&format!("{figure}.svg")).starts_with("<svg"));
        assert!(markdown.contains(&format!("({figure}.svg)")), "{figure}");
        assert!(json[figure]["panels"].is_array(), "{figure}");
    }
    for table in [
        "friction",
        "table_a1",
        "table_a2",
        "summary",
        "curvature_times",
        "kernels",
        "linear_ball",
        "linear_ball_published",
        "screw_ball",
        "flagship",
        "whole_screws",
        "exact_pairs",
        "lin_figure_3_25_exact",
        "pair_times",
        "train_times",
        "applications",
        "static_cost",
        "hertzian_constants",
        "load_share_tables",
        "published",
        "published_open",
        "measured",
        "measured_verdicts",
        "efficiency_over_lead",
        "what_decides",
        "choice_of_defaults",
        "stability",
        "two_point_linear",
        "recorded_sweeps",
        "recorded_runs",
        "mended",
        "known_limits",
        "promises",
        "memory_laws",
        "memory_under_load",
        "memory_energy",
        "memory_noise",
        "memory_breakaway",
    ] {
        let rows = json[table]["rows"].as_array().unwrap();
        assert!(!rows.is_empty());
        assert_eq!(
            read(&format!("{table}.csv")).lines().count(),
            rows.len() + 1
        );
    }
    worst_cases_are_reproduced(&json["stability"]);
    // Whatever figures there are, the page holds each of them, and no picture is left out.
    let pictures = fs::read_dir(&report)
        .unwrap()
        .filter(|entry| {
            let path = entry.as_ref().unwrap().path();
            path.extension().is_some_and(|end| end == "svg")
        })
        .count();
    assert_eq!(page.matches("<figure id=\"figure-").count(), pictures);
    // The page asks for nothing: no script, no style sheet, no picture from elsewhere.
    let own = page
        .replace("http://www.w3.org/2000/svg", "")
        .replace("<link rel=\"icon\" href=\"data:,\">", "");
    for link in ["src=", "<link", "@import", "url(", "http:", "https:"] {
        assert!(!own.contains(link), "{link}");
    }
    // Every section has its link, in the order of the page; friction comes first.
    let links: Vec<_> = page
        .split("<a href=\"#")
        .skip(1)
        .filter_map(|rest| rest.split('"').next())
        .collect();
    let sections: Vec<_> = page
        .split("<details class=\"section\" id=\"")
        .skip(1)
        .filter_map(|rest| rest.split('"').next())
        .collect();
    assert_eq!(links, sections);
    assert_eq!(sections.first(), Some(&"friction-of-the-whole-screw"));
    // The processor, the compiler and the day are named.
    assert!(markdown.contains("built by rustc ") && markdown.contains("Made on 2"));
}

/// A page of another stands in the way before anything is computed; a folder that is a file as well.
#[test]
fn the_report_of_another_stays() {
    let folder = tempdir().unwrap();
    let mine = folder.path().join("report.md");
    fs::write(&mine, "# Minutes of Monday\n").unwrap();
    for output in [".", "report.md", "report.md/below"] {
        let run = run_in(
            folder.path(),
            &["report", "--quick", "--output", output],
            "",
        );
        assert_eq!(run.code, 1, "{}", run.stderr);
        assert!(!run.stderr.contains("[1/"), "{}", run.stderr);
    }
    assert_eq!(fs::read_to_string(mine).unwrap(), "# Minutes of Monday\n");
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
}

/// Every worst case of the error maps, run as the line that the table prints, gives the error of the table;
/// and no map is empty.
fn worst_cases_are_reproduced(table: &Value) {
    let columns: Vec<_> = table["columns"]
        .as_array()
        .unwrap()
        .iter()
        .map(|column| column.as_str().unwrap())
        .collect();
    let rows = table["rows"].as_array().unwrap();
    assert_eq!(rows.len(), 18);
    let cell = |row: &Value, name: &str| {
        let place = columns.iter().position(|column| *column == name).unwrap();
        row[place].clone()
    };
    let lines: Vec<_> = rows
        .iter()
        .map(|row| cell(row, "worst case").as_str().unwrap().to_owned())
        .collect();
    let answers = run(&["eval"], &lines.join("\n"));
    assert_eq!(answers.code, 0, "{}", answers.stdout);
    for (row, answer) in rows.iter().zip(answers.stdout.lines()) {
        let answer: Value = serde_json::from_str(answer).unwrap();
        let number = |side: &str, place: &str| {
            answer[side]
                .pointer(cell(row, place).as_str().unwrap())
                .and_then(Value::as_f64)
        };
        let over = if cell(row, "error over") == "" {
            1.0
        } else {
            number("reference", "error over").unwrap()
        };
        let truth = number("reference", "reference").unwrap();
        let error = (number("in_loop", "in_loop").unwrap() - truth) / over;
        let printed = cell(row, "largest").as_f64().unwrap();
        // The program and this test read the same digits.
        assert!(
            (error.abs() - printed).abs() <= 1e-12 * printed,
            "{row}: {error}"
        );
        assert!(cell(row, "inputs").as_f64().unwrap() >= 30.0, "{row}");
    }
}

/// Files are written when everything is computed, each beside its place first: a run that is cancelled leaves
/// none.
#[test]
fn a_cancelled_report_leaves_no_file() {
    use std::process::{Command, Stdio};
    let folder = tempdir().unwrap();
    let mut child = Command::new(env!("CARGO_BIN_EXE_epas-bench"))
        .args(["report", "--output", "out"])
        .current_dir(folder.path())
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    std::thread::sleep(std::time::Duration::from_millis(300));
    child.kill().unwrap();
    assert!(!child.wait().unwrap().success());
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
}
