//! The report as Markdown, its figures in files beside it.

use std::fmt::Write;

use super::document::{Block, Cell, Section, Table};

/// The whole report.
pub fn render(title: &str, sections: &[Section]) -> String {
    let mut text = format!("# {title}\n");
    for section in sections {
        push(&mut text, format_args!("\n## {}\n", section.title));
        for block in &section.blocks {
            match block {
                Block::Paragraph(paragraph) => {
                    push(&mut text, format_args!("\n{}\n", escape(paragraph)));
                }
                Block::Table(table) => push_table(&mut text, table),
                Block::Figure(figure) => {
                    let caption = escape(&figure.data.caption);
                    let id = figure.data.id;
                    push(
                        &mut text,
                        format_args!("\n![{caption}]({id}.svg)\n\n{caption} ([data]({id}.csv))\n"),
                    );
                }
            }
        }
    }
    text
}

/// Writing to a string does not fail.
fn push(text: &mut String, arguments: std::fmt::Arguments) {
    let _ = text.write_fmt(arguments);
}

fn push_table(text: &mut String, table: &Table) {
    push(text, format_args!("\n{}\n\n|", escape(&table.caption)));
    for column in &table.columns {
        push(text, format_args!(" {} |", escape(column)));
    }
    text.push_str("\n|");
    for index in 0..table.columns.len() {
        let is_text = table
            .rows
            .iter()
            .any(|row| matches!(row.get(index), Some(Cell::Text(_))));
        text.push_str(if is_text { "---|" } else { "---:|" });
    }
    text.push('\n');
    for row in &table.rows {
        text.push('|');
        for cell in row {
            push(text, format_args!(" {} |", escape(cell.shown_text())));
        }
        text.push('\n');
    }
}

/// Text that Markdown takes as it is.
fn escape(text: &str) -> String {
    text.replace('|', "\\|").replace('<', "&lt;")
}
