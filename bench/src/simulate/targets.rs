//! Which files a run writes, and that none of them is one of its inputs.

use std::fs;
use std::path::{Path, PathBuf};

use crate::failure::Failure;

/// The table and the picture: those asked for, or both under their default names where none is.
pub fn targets(
    [output, plot]: [&Option<PathBuf>; 2],
    trace: &str,
    design: &str,
) -> [Option<PathBuf>; 2] {
    if output.is_some() || plot.is_some() {
        return [output.clone(), plot.clone()];
    }
    // A design's name comes from a file and may hold anything.
    let stem: String = format!("{trace}-{design}")
        .chars()
        .map(|letter| {
            if letter.is_alphanumeric() || "-_.".contains(letter) {
                letter
            } else {
                '_'
            }
        })
        .collect();
    let folder = Path::new("target").join("simulate");
    ["csv", "svg"].map(|ending| Some(folder.join(format!("{stem}.{ending}"))))
}

/// Trace and design are never overwritten, nor one output by the other.
pub fn refuse_same<'a, const N: usize>(
    inputs: [Option<&Path>; N],
    outputs: impl Iterator<Item = &'a PathBuf>,
) -> Result<(), Failure> {
    let mut taken: Vec<PathBuf> = inputs.into_iter().flatten().map(place).collect();
    for output in outputs {
        let place = place(output);
        if taken.contains(&place) {
            return Err(Failure::Data(format!(
                "{} is named twice",
                output.display()
            )));
        }
        taken.push(place);
    }
    Ok(())
}

/// Where a file is or will be, under one name however it is spelled.
fn place(path: &Path) -> PathBuf {
    fs::canonicalize(path).unwrap_or_else(|_| {
        let absolute = std::path::absolute(path).unwrap_or_else(|_| path.into());
        match (absolute.parent().map(fs::canonicalize), path.file_name()) {
            (Some(Ok(folder)), Some(name)) => folder.join(name),
            _ => absolute,
        }
    })
}
