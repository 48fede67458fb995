//! `report`: what it prints and what it writes.

use std::fs;

use serde_json::Value;
use tempfile::tempdir;

use super::run_in;

#[test]
fn the_report_reproduces_the_printed_tables_and_writes_every_figure() {
    let folder = tempdir().unwrap();
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
        "linear_ball_error_against_time",
        "linear_ball_errors",
        "linear_pair_errors",
        "screw_ball_error_against_time",
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
    ];
    for figure in figures {
        assert!(read(&format!("{figure}.svg")).starts_with("<svg"));
        assert!(markdown.contains(&format!("({figure}.svg)")), "{figure}");
        assert!(json[figure]["panels"].is_array(), "{figure}");
    }
    for table in [
        "table_a1",
        "table_a2",
        "summary",
        "curvature_times",
        "kernels",
        "linear_ball",
        "linear_ball_published",
        "screw_ball",
        "pair_times",
        "train_times",
        "applications",
        "static_cost",
        "hertzian_constants",
        "published",
        "published_open",
    ] {
        let rows = json[table]["rows"].as_array().unwrap();
        assert!(!rows.is_empty());
        assert_eq!(
            read(&format!("{table}.csv")).lines().count(),
            rows.len() + 1
        );
    }
    // Whatever figures there are, the page holds each of them, and no picture is left out.
    let pictures = fs::read_dir(&report)
        .unwrap()
        .filter(|entry| {
            let path = entry.as_ref().unwrap().path();
            path.extension().is_some_and(|end| end == "svg")
        })
        .count();
    assert_eq!(page.matches("<svg").count(), pictures);
    // The page asks for nothing: no script, no style sheet, no picture from elsewhere.
    for link in ["src=", "<script", "<link", "@import", "url("] {
        assert!(!page.contains(link), "{link}");
    }
}

#[test]
fn without_a_subcommand_the_report_goes_to_its_folder() {
    let folder = tempdir().unwrap();
    let run = run_in(folder.path(), &[], "");
    assert_eq!(run.code, 0, "{}", run.stderr);
    let report = folder.path().join("target").join("report");
    assert!(report.join("report.html").is_file());
    assert!(run.stdout.contains("report.html"));
}
