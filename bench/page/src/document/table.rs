//! A table and its forms: text, Markdown, CSV, JSON.

use std::borrow::Cow;
use std::fmt::Write as _;

use serde_json::{Value, json};

use super::cell::Cell;
use crate::failure::Failure;

/// A table.
#[derive(Clone, Debug)]
pub struct Table {
    /// Name of its files.
    pub name: &'static str,
    /// What it shows.
    pub caption: String,
    /// Headings, with units.
    pub columns: Vec<String>,
    /// Rows as long as the headings.
    pub rows: Vec<Vec<Cell>>,
}

impl Table {
    /// How a value reads in a text: a line for a program stands in the file alone.
    fn brief<'a>(&self, cell: &'a Cell) -> Cow<'a, str> {
        match cell {
            Cell::Code(_) => format!("in {}.csv", self.name).into(),
            cell => cell.shown().into(),
        }
    }

    /// As text in columns.
    pub fn text(&self) -> String {
        let widths: Vec<usize> = (0..self.columns.len())
            .map(|column| {
                self.rows
                    .iter()
                    .filter_map(|row| row.get(column))
                    .map(|cell| self.brief(cell).chars().count())
                    .chain([self.columns[column].chars().count()])
                    .max()
                    .unwrap_or(0)
            })
            .collect();
        let mut text = format!("{}\n\n", self.caption);
        let mut line = |cells: Vec<(&str, bool)>| {
            for ((shown, right), width) in cells.into_iter().zip(&widths) {
                let _ = if right {
                    write!(text, "  {shown:>width$}")
                } else {
                    write!(text, "  {shown:<width$}")
                };
            }
            text.truncate(text.trim_end().len());
            text.push('\n');
        };
        let numeric = |column: usize| {
            self.rows
                .iter()
                .any(|row| row.get(column).is_some_and(Cell::is_number))
        };
        line(
            self.columns
                .iter()
                .enumerate()
                .map(|(column, name)| (name.as_str(), numeric(column)))
                .collect(),
        );
        for row in &self.rows {
            let shown: Vec<_> = row.iter().map(|cell| self.brief(cell)).collect();
            let right = row.iter().map(Cell::is_number);
            line(shown.iter().map(AsRef::as_ref).zip(right).collect());
        }
        text
    }

    /// As Markdown.
    pub fn markdown(&self) -> String {
        let row = |cells: Vec<&str>| format!("| {} |\n", cells.join(" | ").replace('\n', " "));
        let mut text = format!("{}\n\n", self.caption);
        text += &row(self.columns.iter().map(String::as_str).collect());
        let _ = writeln!(text, "|{}", "---|".repeat(self.columns.len()));
        for cells in &self.rows {
            let shown: Vec<_> = cells.iter().map(|cell| self.brief(cell)).collect();
            text += &row(shown.iter().map(AsRef::as_ref).collect());
        }
        text
    }

    /// As CSV.
    pub fn csv(&self) -> Result<String, Failure> {
        let rows = self
            .rows
            .iter()
            .map(|row| row.iter().map(Cell::csv).collect());
        csv_text(&self.columns, rows)
    }

    /// As JSON.
    pub fn json(&self) -> Value {
        json!({
            "caption": self.caption,
            "columns": self.columns,
            "rows": self.rows.iter()
                .map(|row| row.iter().map(Cell::json).collect::<Vec<_>>())
                .collect::<Vec<_>>(),
        })
    }
}

/// Rows under their headings as CSV.
pub fn csv_text(
    columns: &[String],
    rows: impl Iterator<Item = Vec<String>>,
) -> Result<String, Failure> {
    let failed =
        |error: &dyn std::fmt::Display| Failure::Data(format!("cannot write CSV: {error}"));
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer
        .write_record(columns)
        .map_err(|error| failed(&error))?;
    for row in rows {
        writer.write_record(row).map_err(|error| failed(&error))?;
    }
    let bytes = writer.into_inner().map_err(|error| failed(&error))?;
    String::from_utf8(bytes).map_err(|error| failed(&error))
}
