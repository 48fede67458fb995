//! Which files a run writes.

use std::fs;
use std::path::{Path, PathBuf};

/// Where outputs go that are not asked for by name: a folder of this program's own.
const FOLDER: &str = "target/simulate";

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
    let folder = Path::new(FOLDER);
    // Where it cannot be made, writing says so.
    let _ = fs::create_dir_all(folder);
    ["csv", "svg"].map(|ending| Some(folder.join(format!("{stem}.{ending}"))))
}
