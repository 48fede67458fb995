//! The mutants as `cargo mutants --list` names them.

use std::path::Path;
use std::process::Command;

use serde::{Deserialize, Serialize};

use crate::failure::Failure;

/// A place in a file, both from 1, columns in characters.
#[derive(Clone, Copy, Debug, Deserialize, Eq, Ord, PartialEq, PartialOrd, Serialize)]
pub struct Place {
    /// Line.
    pub line: usize,
    /// Column.
    pub column: usize,
}

/// From one place to another.
#[derive(Clone, Copy, Debug, Deserialize, Eq, PartialEq, Serialize)]
pub struct Span {
    /// Its first character.
    pub start: Place,
    /// The character after its last one.
    pub end: Place,
}

/// What is changed.
#[derive(Clone, Copy, Debug, Deserialize, Eq, PartialEq, Serialize)]
pub enum Genre {
    /// The body of a function is a value.
    FnValue,
    /// Another operator.
    BinaryOperator,
    /// No operator.
    UnaryOperator,
    /// An arm of a match is not there.
    MatchArm,
    /// A condition of an arm holds always or never.
    MatchArmGuard,
    /// A field keeps the value of the rest.
    StructField,
}

/// One mutant.
#[derive(Clone, Debug, Deserialize)]
pub struct Mutant {
    /// File, from the root of the tree.
    pub file: String,
    /// Its name for `cargo mutants --re`.
    pub name: String,
    /// What it changes.
    pub genre: Genre,
    /// What stands instead.
    pub replacement: String,
    /// Where.
    pub span: Span,
}

/// Asks `cargo mutants` for the mutants of a tree.
pub fn mutants(tree: &Path, files: &[String]) -> Result<Vec<Mutant>, Failure> {
    let mut command = Command::new("cargo");
    command
        .current_dir(tree)
        .args(["mutants", "--list", "--json", "-p", "epas-friction"]);
    for file in files {
        command.args(["-f", file]);
    }
    let output = command.output()?;
    if !output.status.success() {
        return Err(String::from_utf8_lossy(&output.stderr).into());
    }
    Ok(serde_json::from_slice(&output.stdout)?)
}
