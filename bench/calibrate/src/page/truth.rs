//! What a trace was made with, where the lines above its headings say it: of a synthetic trace.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::{BufRead, BufReader, Read as _};
use std::path::Path;

use epas_page::files::standard;

/// Start of a line above a trace's headings that says a parameter: `# truth: friction = 0.115`.
const MARK: &str = "# truth: ";

const LONGEST: u64 = 1 << 16;

/// Parameters by their names, in SI units.
pub type Truth = BTreeMap<String, f64>;

pub fn of(path: &Path) -> Truth {
    // What is read from standard input is read once.
    let file = (!standard(path)).then(|| File::open(path).ok()).flatten();
    let lines = file.map(|file| BufReader::new(file.take(LONGEST)).lines());
    let lines = lines.into_iter().flatten().map_while(Result::ok);
    let marked = lines.filter_map(|line| {
        let (name, value) = line.strip_prefix(MARK)?.split_once(" = ")?;
        Some((name.trim().to_owned(), value.trim().parse().ok()?))
    });
    marked.collect()
}

/// What the rig writes above its traces is what is read here.
#[test]
fn lines_above_the_headings_say_the_truth() {
    let parameters = epas_rig::parameters::Parameters::default();
    let path = tempfile::NamedTempFile::new().unwrap();
    let text = parameters.header() + "# by hand\n# truth: drag = a lot\ntime,nut_position\n0,1\n";
    std::fs::write(&path, text).unwrap();
    assert_eq!(of(path.path()), parameters.named().into_iter().collect());
    assert!(of(Path::new("absent.csv")).is_empty());
}
