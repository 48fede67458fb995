//! What a report is made of: sections of paragraphs, tables and figures, each with its data.

use serde_json::{Value, json};

use crate::failure::Failure;

/// A section.
pub struct Section {
    /// Name of the link to it.
    pub id: &'static str,
    /// Heading.
    pub title: &'static str,
    /// What stands in it.
    pub blocks: Vec<Block>,
}

/// Part of a section.
pub enum Block {
    /// Plain text.
    Paragraph(String),
    /// A table that is shown.
    Table(Table),
    /// A figure.
    Figure(Figure),
}

impl Block {
    /// A paragraph.
    pub fn text(text: impl Into<String>) -> Self {
        Self::Paragraph(text.into())
    }
}

/// A figure with the numbers that it was drawn from, whose id and caption are the figure's.
pub struct Figure {
    /// The picture.
    pub svg: String,
    /// The numbers.
    pub data: Table,
}

/// A table, or the numbers behind a figure.
pub struct Table {
    /// Name of its files.
    pub id: &'static str,
    /// What it shows.
    pub caption: String,
    /// Heads of the columns, each with its unit in brackets.
    pub columns: Vec<String>,
    /// Rows of as many cells.
    pub rows: Vec<Vec<Cell>>,
}

/// A cell.
#[derive(Clone, Debug, PartialEq)]
pub enum Cell {
    /// Text.
    Text(String),
    /// A number with the text that shows it.
    Number(f64, String),
    /// Nothing.
    Empty,
}

impl Cell {
    /// Text.
    pub fn text(text: impl Into<String>) -> Self {
        Self::Text(text.into())
    }

    /// A number with so many decimals.
    pub fn fixed(value: f64, decimals: usize) -> Self {
        Self::shown(value, |value| format!("{value:.decimals$}"))
    }

    /// A number with two digits and an exponent, as errors are shown.
    pub fn error(value: f64) -> Self {
        Self::shown(value, |value| {
            if value == 0.0 {
                "0".into()
            } else {
                format!("{value:.1e}")
            }
        })
    }

    /// A number that no one reads but a program.
    pub fn raw(value: f64) -> Self {
        Self::shown(value, |value| value.to_string())
    }

    fn shown(value: f64, show: impl Fn(f64) -> String) -> Self {
        if value.is_finite() {
            Self::Number(value, show(value))
        } else {
            Self::Empty
        }
    }

    /// What a reader sees.
    pub fn shown_text(&self) -> &str {
        match self {
            Self::Text(text) | Self::Number(_, text) => text,
            Self::Empty => "",
        }
    }

    fn value(&self) -> Value {
        match self {
            Self::Text(text) => json!(text),
            Self::Number(value, _) => json!(value),
            Self::Empty => Value::Null,
        }
    }
}

impl Table {
    /// A table without rows.
    pub fn new(id: &'static str, caption: impl Into<String>, columns: &[&str]) -> Self {
        Self {
            id,
            caption: caption.into(),
            columns: columns.iter().map(|&column| column.into()).collect(),
            rows: Vec::new(),
        }
    }

    /// The table as CSV, with all digits.
    pub fn csv(&self) -> Result<String, Failure> {
        let failure =
            |error: &dyn std::fmt::Display| Failure::Data(format!("{}: {error}", self.id));
        let mut writer = csv::Writer::from_writer(Vec::new());
        writer
            .write_record(&self.columns)
            .map_err(|error| failure(&error))?;
        for row in &self.rows {
            let record = row.iter().map(|cell| match cell {
                Cell::Text(text) => text.clone(),
                Cell::Number(value, _) => value.to_string(),
                Cell::Empty => String::new(),
            });
            writer
                .write_record(record)
                .map_err(|error| failure(&error))?;
        }
        let bytes = writer.into_inner().map_err(|error| failure(&error))?;
        String::from_utf8(bytes).map_err(|error| failure(&error))
    }

    /// The table as JSON: caption, heads of the columns, and a list for each row.
    pub fn json(&self) -> Result<String, Failure> {
        let rows: Vec<Vec<Value>> = self
            .rows
            .iter()
            .map(|row| row.iter().map(Cell::value).collect())
            .collect();
        let table = json!({
            "id": self.id,
            "caption": self.caption,
            "columns": self.columns,
            "rows": rows,
        });
        serde_json::to_string(&table)
            .map_err(|error| Failure::Data(format!("{}: {error}", self.id)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn data_keep_all_digits_and_shown_text_few() {
        let mut table = Table::new("t", "A table", &["name", "error (1)"]);
        let third = 1.0 / 3.0;
        table
            .rows
            .push(vec![Cell::text("a, b"), Cell::error(third)]);
        table
            .rows
            .push(vec![Cell::text("c"), Cell::error(f64::NAN)]);
        assert_eq!(table.rows[0][1].shown_text(), "3.3e-1");
        assert_eq!(
            table.csv().unwrap(),
            format!("name,error (1)\n\"a, b\",{third}\nc,\n")
        );
        let json: Value = serde_json::from_str(&table.json().unwrap()).unwrap();
        assert_eq!(json["rows"][0][1], json!(third));
        assert_eq!(json["rows"][1][1], Value::Null);
    }
}
