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
    let figures = [
        "figure-03",
        "figure-05",
        "figure-06",
        "figure-07",
        "figure-08",
        "figure-08-maps",
        "figure-09",
        "figure-10",
        "figure-11",
        "error-against-time",
        "hertz",
    ];
    for figure in figures {
        assert!(read(&format!("{figure}.svg")).starts_with("<svg"));
        assert!(page.contains(&format!("<figure id=\"{figure}\">")));
        assert!(markdown.contains(&format!("({figure}.svg)")));
    }
    for table in [
        "table-a1",
        "table-a2",
        "curvature-cost",
        "curvature-domains",
        "efficiency-agreement",
        "locking",
        "hertz-errors",
        "kernels",
    ] {
        assert!(page.contains(&format!("<table id=\"{table}\">")));
    }
    for data in fs::read_dir(&report).unwrap() {
        let path = data.unwrap().path();
        match path.extension().and_then(|end| end.to_str()) {
            Some("json") => {
                let table: Value =
                    serde_json::from_str(&fs::read_to_string(&path).unwrap()).unwrap();
                let columns = table["columns"].as_array().unwrap().len();
                let rows = table["rows"].as_array().unwrap();
                assert!(!rows.is_empty(), "{}", path.display());
                for row in rows {
                    assert_eq!(row.as_array().unwrap().len(), columns);
                }
                // The same numbers stand in the CSV.
                let csv = fs::read_to_string(path.with_extension("csv")).unwrap();
                assert!(csv.lines().count() > rows.len());
            }
            Some("csv" | "svg" | "md" | "html") => {}
            _ => panic!("{} is no part of a report", path.display()),
        }
    }
    // The page asks for nothing: no script, no style sheet, no picture from elsewhere.
    for link in ["src=", "<script", "<link", "@import", "url("] {
        assert!(!page.contains(link), "{link}");
    }
    assert_eq!(page.matches("<svg").count(), figures.len());
}

/// The forms keep the errors that the crate's documentation promises.
#[test]
fn the_table_of_errors_holds_what_is_promised() {
    let folder = tempdir().unwrap();
    let run = run_in(folder.path(), &["report", "--quick"], "");
    assert_eq!(run.code, 0, "{}", run.stderr);
    let report = folder.path().join("target").join("report");
    for table in ["table-a1", "table-a2"] {
        let mut reader = csv::Reader::from_path(report.join(format!("{table}.csv"))).unwrap();
        let heads = reader.headers().unwrap().clone();
        let place = |name: &str| heads.iter().position(|head| head == name).unwrap();
        let (fitted, exact) = (place("fitted max"), place("exact max"));
        let mut rows = 0;
        for record in reader.records() {
            let record = record.unwrap();
            let percent = |index: usize| record[index].parse::<f64>().unwrap();
            assert!(
                percent(fitted) < 1.5e-4 && percent(exact) < 1e-4,
                "{record:?}"
            );
            rows += 1;
        }
        assert_eq!(rows, 31);
    }
}
