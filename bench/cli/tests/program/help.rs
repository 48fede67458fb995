//! Help that is read: short paragraphs, flags in words, every way in.

use crate::run;

/// Most words of a paragraph.
const MOST: usize = 60;

fn subcommands() -> Vec<String> {
    let help = run(&["--help"], "").stdout;
    let commands = help.lines().skip_while(|line| *line != "Commands:").skip(1);
    commands
        .take_while(|line| !line.starts_with("Options"))
        .filter(|line| line.starts_with("  ") && !line.starts_with("   "))
        .filter_map(|line| line.split_whitespace().next().map(String::from))
        .filter(|name| name != "help")
        .collect()
}

#[test]
fn no_paragraph_of_the_help_is_long() {
    let mut all = vec![vec!["--help".to_owned()]];
    let subcommands = subcommands();
    assert!(subcommands.len() == 6, "{subcommands:?}");
    all.extend(
        subcommands
            .into_iter()
            .map(|name| vec![name, "--help".to_owned()]),
    );
    for arguments in all {
        let arguments: Vec<_> = arguments.iter().map(String::as_str).collect();
        let help = run(&arguments, "").stdout;
        // A table is read by its lines.
        let text = help.split("\nFlags of a sample").next().unwrap();
        // Of a list each line counts by itself.
        let listed = ["Commands:", "Options:", "Possible values:"];
        let paragraphs = text.split("\n\n").flat_map(|paragraph| {
            let start = paragraph.trim_start();
            if listed.iter().any(|head| start.starts_with(head)) {
                paragraph.lines().collect()
            } else {
                vec![paragraph]
            }
        });
        for paragraph in paragraphs {
            let words = paragraph.split_whitespace().count();
            assert!(words <= MOST, "{arguments:?}, {words} words: {paragraph}");
        }
    }
}

#[test]
fn the_help_has_the_table_of_flags() {
    let help = run(&["simulate", "--help"], "").stdout;
    for word in [
        "BEYOND_MODEL",
        "keep compensating; do not adapt",
        "fault_words",
    ] {
        assert!(help.contains(word), "{word}");
    }
}

#[test]
fn without_arguments_every_way_in_is_named() {
    for arguments in [
        vec!["simulate"],
        vec!["simulate", "--design", "lin-4.1"],
        vec!["simulate", "--input", "trace.csv"],
    ] {
        let run = run(&arguments, "");
        assert_eq!(run.code, 2);
        for word in ["--input", "--manoeuvre", "--loads", "--list", "--mechanism"] {
            assert!(run.stderr.contains(word), "{}", run.stderr);
        }
    }
}

/// No folder is made on the way to an output.
#[test]
fn a_missing_folder_is_named_and_not_made() {
    let place = tempfile::tempdir().unwrap();
    for arguments in [
        "simulate --manoeuvre kerb --output absent/out.csv",
        "simulate --manoeuvre kerb --plot absent/out.svg",
        "design lin-4.1 --output absent/gear.rs",
        "fmu --scene caged --design lin-4.1 --output absent/gear.fmu",
        "a2l --image a.elf --output absent/a.a2l",
    ] {
        let run = crate::told(place.path(), arguments);
        assert_eq!(run.code, 1, "{arguments}: {}", run.stderr);
        assert!(
            run.stderr.contains("the folder absent is missing"),
            "{arguments}: {}",
            run.stderr
        );
        assert!(!place.path().join("absent").exists(), "{arguments}");
    }
}
