//! Which files a run writes, and its table as it is written.

use std::fs;
use std::io::{Seek, Write};
use std::path::{Path, PathBuf};

use super::measurement;
use epas_page::failure::Failure;
use epas_traces::mdf4;

/// Writes the rows of a table: as a measurement file where the path ends in .mf4, else as CSV.
pub fn write_table(
    writer: &mut (impl Write + Seek),
    path: &Path,
    (group, columns): (&str, &[&'static str]),
    rows: impl Iterator<Item = Vec<String>>,
) -> Result<(), Failure> {
    if mdf4::named(path) {
        let described = measurement::described(columns).map_err(Failure::Data)?;
        return mdf4::write::write(writer, group, &described, rows)
            .map_err(|message| Failure::file("write", path, &message));
    }
    let failure = |error: csv::Error| Failure::file("write", path, &error);
    let mut table = csv::Writer::from_writer(writer);
    table.write_record(columns).map_err(failure)?;
    for row in rows {
        // What is NaN or infinite is left open, as spreadsheets and data frames read it.
        let cells = row.iter().map(|cell| if cell == "NaN" { "" } else { cell });
        table.write_record(cells).map_err(failure)?;
    }
    table
        .flush()
        .map_err(|error| Failure::file("write", path, &error))
}

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
