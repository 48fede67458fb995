//! The report as one page that needs nothing else.

use std::fmt::Write;

use super::document::{Block, Cell, Section, Table};

const STYLE: &str = "
body { font: 16px/1.5 system-ui, sans-serif; color: #222; background: #fff; max-width: 72rem;
  margin: 2rem auto; padding: 0 1.5rem; }
h1 { font-size: 1.8rem; } h2 { margin-top: 3rem; border-bottom: 2px solid #0072b2; }
p { max-width: 48rem; }
nav ul { columns: 2; padding-left: 1.2rem; }
figure { margin: 1.5rem 0; } figure svg { max-width: 100%; height: auto; }
figcaption, caption { text-align: left; font-size: .92rem; color: #444; margin-bottom: .4rem; }
.wide { overflow-x: auto; }
table { border-collapse: collapse; font-size: .88rem; font-variant-numeric: tabular-nums; }
th { text-align: right; vertical-align: bottom; border-bottom: 2px solid #888; padding: .2rem .6rem; }
td { text-align: right; padding: .15rem .6rem; border-bottom: 1px solid #e4e4e4; white-space: nowrap; }
td.text { text-align: left; }
tbody tr:hover { background: #f2f7fb; }
";

/// The whole report.
pub fn render(title: &str, sections: &[Section]) -> String {
    let mut page = format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <title>{title}</title>\n<style>{STYLE}</style>\n</head>\n<body>\n<h1>{title}</h1>\n\
         <nav><ul>\n",
        title = escape(title)
    );
    for section in sections {
        push(
            &mut page,
            format_args!(
                "<li><a href=\"#{}\">{}</a></li>\n",
                section.id,
                escape(section.title)
            ),
        );
    }
    page.push_str("</ul></nav>\n");
    for section in sections {
        push(
            &mut page,
            format_args!(
                "<section id=\"{}\">\n<h2>{}</h2>\n",
                section.id,
                escape(section.title)
            ),
        );
        for block in &section.blocks {
            match block {
                Block::Paragraph(text) => {
                    push(&mut page, format_args!("<p>{}</p>\n", escape(text)));
                }
                Block::Table(table) => push_table(&mut page, table),
                Block::Figure(figure) => push(
                    &mut page,
                    format_args!(
                        "<figure id=\"{}\">\n{}\n<figcaption>{}</figcaption>\n</figure>\n",
                        figure.data.id,
                        figure.svg,
                        escape(&figure.data.caption)
                    ),
                ),
            }
        }
        page.push_str("</section>\n");
    }
    page.push_str("</body>\n</html>\n");
    page
}

/// Writing to a string does not fail.
fn push(page: &mut String, arguments: std::fmt::Arguments) {
    let _ = page.write_fmt(arguments);
}

fn push_table(page: &mut String, table: &Table) {
    push(
        page,
        format_args!(
            "<div class=\"wide\"><table id=\"{}\">\n<caption>{}</caption>\n<thead><tr>",
            table.id,
            escape(&table.caption)
        ),
    );
    for column in &table.columns {
        push(page, format_args!("<th>{}</th>", escape(column)));
    }
    page.push_str("</tr></thead>\n<tbody>\n");
    for row in &table.rows {
        page.push_str("<tr>");
        for cell in row {
            let class = match cell {
                Cell::Text(_) => " class=\"text\"",
                Cell::Number(..) | Cell::Empty => "",
            };
            push(
                page,
                format_args!("<td{class}>{}</td>", escape(cell.shown_text())),
            );
        }
        page.push_str("</tr>\n");
    }
    page.push_str("</tbody></table></div>\n");
}

/// Text that HTML takes as it is.
fn escape(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
        .replace('"', "&quot;")
}
