//! A report as data, and its forms: text on the screen, Markdown, HTML, SVG, CSV, JSON.

mod cell;
mod figure;
mod inline;
mod page;
mod parts;
mod table;

use std::fmt::Write as _;
use std::io::Write as _;
use std::path::Path;

use serde_json::Value;

pub use cell::Cell;
pub use figure::Figure;
pub use parts::{Block, Document, Part, Section};
pub use table::Table;

use crate::failure::Failure;
use crate::files::{Existing, write};
use page::Page;

/// Prints a line.
pub fn print_line(line: &str) -> Result<(), Failure> {
    Ok(writeln!(std::io::stdout().lock(), "{line}")?)
}

impl Section {
    /// Prints its text and its tables.
    pub fn print(&self) -> Result<(), Failure> {
        let mut output = std::io::stdout().lock();
        writeln!(output, "\n== {}", self.title)?;
        for block in &self.blocks {
            match block {
                Block::Text(text) => writeln!(output, "\n{}", inline::wrapped(text))?,
                Block::Table(table) | Block::Answer(table) => {
                    write!(output, "\n{}", table.text())?;
                }
                Block::Annex(_) | Block::Figure(_) => {}
            }
        }
        Ok(())
    }
}

impl Document {
    /// Prints the text and the tables, and where the rest is.
    pub fn print(&self, folder: &Path) -> Result<(), Failure> {
        print_line(&self.title)?;
        for line in &self.made {
            print_line(line)?;
        }
        for (_, section) in self.parts.iter().flat_map(|part| &part.sections) {
            section.print()?;
        }
        self.print_where(folder)
    }

    /// Prints where the files are.
    pub fn print_where(&self, folder: &Path) -> Result<(), Failure> {
        print_line(&format!(
            "\nWritten to {}: report.html (open it in a browser), report.md, report.json, and every\n\
             figure as SVG and CSV.",
            folder.display()
        ))
    }

    /// Writes every form into a folder.
    pub fn write(&self, folder: &Path) -> Result<(), Failure> {
        std::fs::create_dir_all(folder).map_err(|error| Failure::file("write", folder, &error))?;
        let save = |name: &str, ending: &str, text: &str| {
            write(
                &folder.join(format!("{name}.{ending}")),
                text,
                Existing::Replace,
            )
        };
        let mut figures = serde_json::Map::new();
        for block in self.blocks() {
            match block {
                Block::Text(_) => {}
                Block::Table(table) | Block::Annex(table) | Block::Answer(table) => {
                    save(table.name, "csv", &table.csv()?)?;
                    figures.insert(table.name.into(), table.json());
                }
                Block::Figure(figure) => {
                    save(figure.name, "svg", &figure.svg()?)?;
                    save(figure.name, "csv", &figure.csv()?)?;
                    figures.insert(figure.name.into(), figure.json());
                }
            }
        }
        save("report", "md", &self.markdown())?;
        save("report", "html", &Page::of(self)?)?;
        let json = serde_json::to_string(&Value::Object(figures))
            .map_err(|error| Failure::Data(error.to_string()))?;
        save("report", "json", &json)
    }

    fn markdown(&self) -> String {
        let mut text = format!("# {}\n", self.title);
        if !self.made.is_empty() {
            let _ = write!(text, "\n{}\n", self.made.join("  \n"));
        }
        for (_, section) in self.parts.iter().flat_map(|part| &part.sections) {
            let _ = write!(text, "\n## {}\n", section.title);
            for block in &section.blocks {
                let _ = match block {
                    Block::Text(lines) => write!(text, "\n{}\n", inline::markdown(lines)),
                    Block::Table(table) | Block::Annex(table) | Block::Answer(table) => {
                        write!(text, "\n{}", table.markdown())
                    }
                    Block::Figure(Figure { caption, name, .. }) => {
                        write!(text, "\n![{caption}]({name}.svg)\n\n*{caption}*\n")
                    }
                };
            }
        }
        text
    }
}
