//! The table of a run, as it is written.

use std::io::{Seek, Write};
use std::path::Path;

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
