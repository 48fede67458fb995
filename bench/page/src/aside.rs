//! What is said beside an answer.

use std::fmt::Display;
use std::io::{self, Write as _};

/// A line on standard error. Where that cannot be written, the work goes on without.
pub fn say(line: impl Display) {
    let _ = writeln!(io::stderr(), "{line}");
}
