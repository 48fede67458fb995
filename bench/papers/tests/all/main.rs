//! The program as its users start it: what it refuses, and what stands on the page of a run.
//!
//! No test makes the page: CI does, and then the tests that are ignored here look at what it has left in `target/papers`:
//!
//! ```text
//! cargo run --release -p epas-papers
//! cargo test -p epas-papers --test all -- --ignored of_the_last_run
//! ```

use std::fs;
use std::path::Path;
use std::process::Command;

use serde_json::Value;

/// Exit code, standard output and standard error of a run.
fn run(arguments: &[&str]) -> (Option<i32>, String, String) {
    let output = Command::new(env!("CARGO_BIN_EXE_epas-papers"))
        .args(arguments)
        .output()
        .unwrap();
    let text = |bytes| String::from_utf8(bytes).unwrap();
    (
        output.status.code(),
        text(output.stdout),
        text(output.stderr),
    )
}

#[test]
fn wrong_usage_ends_with_code_2() {
    for (arguments, word) in [
        (&["screws", "--screws", "-1"][..], "1..=100000"),
        (&["screws", "--screws", "0"], "1..=100000"),
        (&["screws", "--first", "-1"], "invalid value"),
        (&["--output"], "a value is required"),
        (&["figures"], "unrecognized subcommand"),
    ] {
        let (code, out, message) = run(arguments);
        assert_eq!(code, Some(2), "{arguments:?}: {message}");
        assert!(
            out.is_empty() && message.contains(word),
            "{arguments:?}: {message}"
        );
    }
    for arguments in [&["--help"][..], &["screws", "--help"]] {
        assert_eq!(run(arguments).0, Some(0));
    }
}

/// What is missing or of another stands in the way before anything is computed.
#[test]
fn a_folder_in_the_way_is_named_at_once() {
    for (output, word) in [
        ("absent/page", "the folder absent is missing"),
        ("src", "files that are not of this program"),
        ("Cargo.toml", "is no folder"),
    ] {
        let (code, out, message) = run(&["--output", output]);
        assert_eq!(code, Some(1), "{message}");
        assert!(out.is_empty() && message.contains(word), "{message}");
    }
}

/// The published tables reproduce digit for digit, and every table and figure stands in its file and on the page.
#[test]
#[ignore = "reads target/papers, which epas-papers makes"]
fn the_page_of_the_last_run() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../target/papers");
    let read = |name: &str| {
        let path = folder.join(name);
        fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
    };
    let markdown = read("report.md");
    assert!(markdown.contains("248 of 248"));
    let json: Value = serde_json::from_str(&read("report.json")).unwrap();
    let blocks = json.as_object().unwrap();
    let mut pictures = 0;
    for (name, block) in blocks {
        let csv = read(&format!("{name}.csv"));
        if block["panels"].is_array() {
            pictures += 1;
            assert!(read(&format!("{name}.svg")).starts_with("<svg"), "{name}");
            assert!(markdown.contains(&format!("({name}.svg)")), "{name}");
        } else {
            let rows = block["rows"].as_array().unwrap();
            assert!(!rows.is_empty(), "{name}");
            assert_eq!(csv.lines().count(), rows.len() + 1, "{name}");
        }
    }
    assert_eq!(
        read("report.html").matches("<figure id=\"figure-").count(),
        pictures
    );
    for name in include_str!("figures.txt").lines() {
        assert!(blocks.contains_key(name), "{name}");
    }
}
