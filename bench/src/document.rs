//! A report as data, and its forms: text on the screen, Markdown, HTML, SVG, CSV, JSON.

use std::fmt::Write as _;
use std::io::Write as _;
use std::path::Path;

use serde_json::{Value, json};

use crate::failure::Failure;
use crate::files::{Existing, write};
use crate::plot::{Panel, render};

/// One value of a table: what it is and how it is shown.
#[derive(Clone, Debug)]
pub enum Cell {
    /// A text.
    Text(String),
    /// A number and its shown form.
    Number(f64, String),
}

impl From<&str> for Cell {
    fn from(text: &str) -> Self {
        Self::Text(text.into())
    }
}

impl From<String> for Cell {
    fn from(text: String) -> Self {
        Self::Text(text)
    }
}

impl Cell {
    /// A number with so many decimals.
    pub fn fixed(value: f64, decimals: usize) -> Self {
        Self::Number(value, format!("{value:.decimals$}"))
    }

    /// A number with two significant digits and its power of ten.
    pub fn power(value: f64) -> Self {
        Self::Number(value, format!("{value:.1e}"))
    }

    fn shown(&self) -> &str {
        match self {
            Self::Text(text) | Self::Number(_, text) => text,
        }
    }

    fn json(&self) -> Value {
        match self {
            Self::Text(text) => json!(text),
            Self::Number(value, _) => json!(value),
        }
    }

    fn csv(&self) -> String {
        match self {
            Self::Text(text) => text.clone(),
            Self::Number(value, _) => value.to_string(),
        }
    }
}

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

/// A figure of one or more panels.
pub struct Figure {
    /// Name of its files.
    pub name: &'static str,
    /// What it shows.
    pub caption: String,
    /// Panels, row by row.
    pub panels: Vec<Panel>,
    /// Panels in a row.
    pub columns: usize,
    /// Width and height of a panel, pixels.
    pub size: (u32, u32),
}

/// A part of a section.
pub enum Block {
    /// A paragraph.
    Text(String),
    /// A table.
    Table(Table),
    /// A table too long for the screen: in the files only.
    Annex(Table),
    /// A figure.
    Figure(Figure),
}

/// A section.
pub struct Section {
    /// Heading.
    pub title: &'static str,
    /// What it holds.
    pub blocks: Vec<Block>,
}

/// A report.
pub struct Document {
    /// Heading.
    pub title: String,
    /// Its sections.
    pub sections: Vec<Section>,
}

impl Table {
    fn text(&self) -> String {
        let widths: Vec<usize> = (0..self.columns.len())
            .map(|column| {
                self.rows
                    .iter()
                    .filter_map(|row| row.get(column))
                    .map(|cell| cell.shown().chars().count())
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
                .any(|row| matches!(row.get(column), Some(Cell::Number(..))))
        };
        line(
            self.columns
                .iter()
                .enumerate()
                .map(|(column, name)| (name.as_str(), numeric(column)))
                .collect(),
        );
        for row in &self.rows {
            line(
                row.iter()
                    .map(|cell| (cell.shown(), matches!(cell, Cell::Number(..))))
                    .collect(),
            );
        }
        text
    }

    fn markdown(&self) -> String {
        let row = |cells: Vec<&str>| format!("| {} |\n", cells.join(" | ").replace('\n', " "));
        let mut text = format!("{}\n\n", self.caption);
        text += &row(self.columns.iter().map(String::as_str).collect());
        let _ = writeln!(text, "|{}", "---|".repeat(self.columns.len()));
        for cells in &self.rows {
            text += &row(cells.iter().map(Cell::shown).collect());
        }
        text
    }

    fn html(&self) -> String {
        let mut text = format!(
            "<figure><figcaption>{}</figcaption><div class=\"wide\"><table><thead><tr>",
            escaped(&self.caption)
        );
        for column in &self.columns {
            let _ = write!(text, "<th>{}</th>", escaped(column));
        }
        text += "</tr></thead><tbody>";
        for row in &self.rows {
            text += "<tr>";
            for cell in row {
                let class = match cell {
                    Cell::Number(..) => " class=\"number\"",
                    Cell::Text(_) => "",
                };
                let _ = write!(text, "<td{class}>{}</td>", escaped(cell.shown()));
            }
            text += "</tr>";
        }
        text + "</tbody></table></div></figure>\n"
    }

    fn csv(&self) -> Result<String, Failure> {
        let rows = self
            .rows
            .iter()
            .map(|row| row.iter().map(Cell::csv).collect());
        csv_text(&self.columns, rows)
    }

    fn json(&self) -> Value {
        json!({
            "caption": self.caption,
            "columns": self.columns,
            "rows": self.rows.iter()
                .map(|row| row.iter().map(Cell::json).collect::<Vec<_>>())
                .collect::<Vec<_>>(),
        })
    }
}

impl Figure {
    fn csv(&self) -> Result<String, Failure> {
        let columns = ["panel", "series", "x", "y", "value"].map(String::from);
        let mut rows: Vec<Vec<String>> = Vec::new();
        for (index, panel) in self.panels.iter().enumerate() {
            match panel {
                Panel::Chart(chart) => {
                    for series in &chart.series {
                        for (x, y) in &series.points {
                            rows.push(vec![
                                index.to_string(),
                                series.name.clone(),
                                x.to_string(),
                                y.to_string(),
                                String::new(),
                            ]);
                        }
                    }
                }
                Panel::Map(map) => {
                    for (x, y, value) in map.cells() {
                        rows.push(vec![
                            index.to_string(),
                            map.quantity.clone(),
                            x.to_string(),
                            y.to_string(),
                            value.to_string(),
                        ]);
                    }
                }
            }
        }
        csv_text(&columns, rows.into_iter())
    }

    fn json(&self) -> Value {
        let panels: Vec<_> = self
            .panels
            .iter()
            .map(|panel| match panel {
                Panel::Chart(chart) => json!({
                    "title": chart.title,
                    "x": chart.x.label,
                    "y": chart.y.label,
                    "series": chart.series.iter()
                        .map(|series| json!({"name": series.name, "points": series.points}))
                        .collect::<Vec<_>>(),
                }),
                Panel::Map(map) => json!({
                    "title": map.title,
                    "x": map.x.label,
                    "y": map.y.label,
                    "quantity": map.quantity,
                    "cells": map.cells().collect::<Vec<_>>(),
                }),
            })
            .collect();
        json!({"caption": self.caption, "panels": panels})
    }

    fn svg(&self) -> Result<String, Failure> {
        render(&self.panels, self.columns, self.size)
    }
}

impl Document {
    /// Prints the text and the tables, and where the rest is.
    pub fn print(&self, folder: &Path) -> Result<(), Failure> {
        let mut output = std::io::stdout().lock();
        writeln!(output, "{}", self.title)?;
        for section in &self.sections {
            writeln!(output, "\n== {}", section.title)?;
            for block in &section.blocks {
                match block {
                    Block::Text(text) => writeln!(output, "\n{}", wrapped(text))?,
                    Block::Table(table) => write!(output, "\n{}", table.text())?,
                    Block::Annex(_) | Block::Figure(_) => {}
                }
            }
        }
        writeln!(
            output,
            "\nWritten to {}: report.html (open it in a browser), report.md, report.json, and every\n\
             figure as SVG and CSV.",
            folder.display()
        )?;
        Ok(())
    }

    /// Writes every form into a folder.
    pub fn write(&self, folder: &Path) -> Result<(), Failure> {
        let mut markdown = format!("# {}\n", self.title);
        let mut html = format!(
            "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\
             <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\
             <title>{0}</title><style>{STYLE}</style></head><body>\n<h1>{0}</h1>\n",
            escaped(&self.title)
        );
        let mut figures = serde_json::Map::new();
        let save = |name: &str, ending: &str, text: &str| {
            write(
                &folder.join(format!("{name}.{ending}")),
                text,
                Existing::Replace,
            )
        };
        for section in &self.sections {
            let _ = write!(markdown, "\n## {}\n", section.title);
            let _ = writeln!(html, "<h2>{}</h2>", escaped(section.title));
            for block in &section.blocks {
                match block {
                    Block::Text(text) => {
                        let _ = write!(markdown, "\n{text}\n");
                        let _ = writeln!(html, "<p>{}</p>", escaped(text));
                    }
                    Block::Table(table) | Block::Annex(table) => {
                        let _ = write!(markdown, "\n{}", table.markdown());
                        html += &table.html();
                        save(table.name, "csv", &table.csv()?)?;
                        figures.insert(table.name.into(), table.json());
                    }
                    Block::Figure(figure) => {
                        let svg = figure.svg()?;
                        let _ = write!(
                            markdown,
                            "\n![{0}]({1}.svg)\n\n*{0}*\n",
                            figure.caption, figure.name
                        );
                        let _ = writeln!(
                            html,
                            "<figure><div class=\"wide\">{svg}</div><figcaption>{}</figcaption></figure>",
                            escaped(&figure.caption)
                        );
                        save(figure.name, "svg", &svg)?;
                        save(figure.name, "csv", &figure.csv()?)?;
                        figures.insert(figure.name.into(), figure.json());
                    }
                }
            }
        }
        html += "</body></html>\n";
        save("report", "md", &markdown)?;
        save("report", "html", &html)?;
        let json = serde_json::to_string(&Value::Object(figures))
            .map_err(|error| Failure::Data(error.to_string()))?;
        save("report", "json", &json)
    }
}

const STYLE: &str = "body{font:16px/1.5 system-ui,sans-serif;max-width:1180px;margin:2rem auto;\
padding:0 1rem;color:#222}h1,h2{line-height:1.2}h2{margin-top:2.5rem;border-bottom:1px solid #ccc}\
table{border-collapse:collapse;font-size:14px}th,td{padding:.25rem .6rem;border-bottom:1px solid #ddd;\
text-align:left}td.number{text-align:right;font-variant-numeric:tabular-nums}thead th{border-bottom:2px \
solid #888}figure{margin:1.2rem 0}figcaption{color:#444;margin:.4rem 0}.wide{overflow-x:auto}\
svg{max-width:100%;height:auto}";

/// The text in lines that a terminal holds.
fn wrapped(text: &str) -> String {
    const WIDTH: usize = 100;
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        match lines.last_mut() {
            Some(line) if line.chars().count() + 1 + word.chars().count() <= WIDTH => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.into()),
        }
    }
    lines.join("\n")
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
}

fn csv_text(
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
