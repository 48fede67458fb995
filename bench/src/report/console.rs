//! The report on a terminal: headings, text and tables; figures are named.

use std::io::{self, Write};

use super::document::{Block, Cell, Section, Table};

/// Width that text is broken to.
const WIDTH: usize = 100;

/// Prints a section.
pub fn print(out: &mut impl Write, section: &Section) -> io::Result<()> {
    writeln!(
        out,
        "{}\n{}\n",
        section.title,
        "=".repeat(section.title.len())
    )?;
    for block in &section.blocks {
        match block {
            Block::Paragraph(text) => print_text(out, text)?,
            Block::Table(table) => print_table(out, table)?,
            Block::Figure(figure) => {
                print_text(
                    out,
                    &format!("[{}.svg] {}", figure.data.id, figure.data.caption),
                )?;
            }
        }
        writeln!(out)?;
    }
    Ok(())
}

fn print_text(out: &mut impl Write, text: &str) -> io::Result<()> {
    let mut column = 0;
    for word in text.split_whitespace() {
        let length = word.chars().count();
        if column > 0 && column + 1 + length > WIDTH {
            writeln!(out)?;
            column = 0;
        }
        if column > 0 {
            write!(out, " ")?;
            column += 1;
        }
        write!(out, "{word}")?;
        column += length;
    }
    writeln!(out)
}

fn print_table(out: &mut impl Write, table: &Table) -> io::Result<()> {
    print_text(out, &table.caption)?;
    let columns: Vec<Column> = table
        .columns
        .iter()
        .enumerate()
        .map(|(index, head)| Column::new(head, table.rows.iter().filter_map(|row| row.get(index))))
        .collect();
    let height = columns.iter().map(|column| column.head.len()).max();
    for line in 0..height.unwrap_or(0) {
        for Column { head, width } in &columns {
            let text = head.get(line).map_or("", String::as_str);
            write!(out, "{text:width$}  ")?;
        }
        writeln!(out)?;
    }
    for row in &table.rows {
        for (cell, &Column { width, .. }) in row.iter().zip(&columns) {
            let text = cell.shown_text();
            match cell {
                Cell::Text(_) => write!(out, "{text:width$}  ")?,
                Cell::Number(..) | Cell::Empty => write!(out, "{text:>width$}  ")?,
            }
        }
        writeln!(out)?;
    }
    Ok(())
}

/// A column's head, broken into lines as narrow as its cells and its longest word allow.
struct Column {
    head: Vec<String>,
    width: usize,
}

impl Column {
    fn new<'a>(head: &'a str, cells: impl Iterator<Item = &'a Cell>) -> Self {
        let words = head.split(' ');
        let width = cells
            .map(Cell::shown_text)
            .chain(words.clone())
            .map(|text| text.chars().count())
            .max()
            .unwrap_or(0);
        let mut lines: Vec<String> = Vec::new();
        for word in words {
            match lines.last_mut() {
                Some(line) if line.chars().count() + 1 + word.chars().count() <= width => {
                    line.push(' ');
                    line.push_str(word);
                }
                _ => lines.push(word.into()),
            }
        }
        Self { head: lines, width }
    }
}
