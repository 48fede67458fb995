//! Which files a run writes.

use std::path::{Path, PathBuf};

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
