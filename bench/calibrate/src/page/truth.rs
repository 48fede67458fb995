//! What a trace was made with, where the lines above its headings say it: of a synthetic trace.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::{BufRead, BufReader, Read as _};
use std::path::Path;

use epas_page::files::standard;

/// Start of a line above a trace's headings that says a parameter: `# truth: friction = 0.115`.
const MARK: &str = "# truth: ";

/// Bytes within which such lines stand.
const LONGEST: u64 = 1 << 16;

/// Parameters by their names, in SI units.
pub type Truth = BTreeMap<String, f64>;

/// What the lines of a trace's file say; nothing where it has none, or is no text.
pub fn of(path: &Path) -> Truth {
    if standard(path) {
        // What is read from there is read once.
        return Truth::new();
    }
    let Ok(file) = File::open(path) else {
        return Truth::new();
    };
    let lines = BufReader::new(file.take(LONGEST)).lines();
    let lines = lines.map_while(Result::ok);
    let marked = lines.filter_map(|line| {
        let (name, value) = line.strip_prefix(MARK)?.split_once(" = ")?;
        Some((name.trim().to_owned(), value.trim().parse().ok()?))
    });
    marked.collect()
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    #[test]
    fn lines_above_the_headings_say_the_truth() {
        let place = tempfile::tempdir().unwrap();
        let path = place.path().join("trace.csv");
        let text = format!(
            "{MARK}friction = 0.115\n# by hand\n{MARK}drag = a lot\ntime,nut_position\n0,1\n"
        );
        fs::write(&path, text).unwrap();
        let truth = of(&path);
        assert_eq!(truth.len(), 1);
        assert_eq!(truth["friction"], 0.115);
        assert!(of(Path::new("absent.csv")).is_empty());
    }
}
