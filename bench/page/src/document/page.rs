//! A document as one HTML page that needs nothing else: contents that stay in view, sections that fold, pictures for wide and for
//! narrow windows, in the colours of the reader's scheme.

use std::fmt::Write as _;

use super::cell::Cell;
use super::figure::Figure;
use super::inline::{escaped, html, with_code};
use super::parts::{Block, Document, Part, Section};
use super::table::Table;
use crate::failure::Failure;
use crate::plot::{Panel, narrow, render_one, themed};

const STYLE: &str = include_str!("page.css");
/// What the page does: the menu, links that unfold what they lead to, and the place in the contents.
const SCRIPT: &str = include_str!("page.js");

/// Rows of a table that a page shows unfolded.
const ROWS: usize = 14;

/// Letters of a text in a table that a page shows in one line.
const LONG: usize = 36;

/// Width of a picture for a narrow window, pixels.
const NARROW: u32 = 344;

/// A page that is being written.
pub struct Page {
    text: String,
    figures: usize,
    tables: usize,
}

impl Page {
    pub fn of(document: &Document) -> Result<String, Failure> {
        let title = escaped(&document.title);
        let mut page = Self {
            text: format!(
                "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\
                 <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\
                 <meta name=\"color-scheme\" content=\"light dark\"><link rel=\"icon\" href=\"data:,\">\
                 <title>{title}</title><style>{STYLE}</style></head><body>\n"
            ),
            figures: 0,
            tables: 0,
        };
        page.contents(document);
        let _ = writeln!(page.text, "<main><h1>{title}</h1>");
        for line in &document.made {
            let _ = writeln!(page.text, "<p class=\"made\">{}</p>", with_code(line));
        }
        for part in &document.parts {
            page.part(part)?;
        }
        let _ = writeln!(page.text, "</main><script>{SCRIPT}</script></body></html>");
        Ok(page.text)
    }

    fn contents(&mut self, document: &Document) {
        self.text += "<nav><button type=\"button\" aria-expanded=\"false\">Contents</button><div class=\"links\">";
        for part in &document.parts {
            if !part.title.is_empty() {
                let _ = write!(self.text, "<p>{}</p>", escaped(part.title));
            }
            self.text += "<ul>";
            for (_, section) in &part.sections {
                let (id, title) = (id(section.title), escaped(section.title));
                let _ = write!(self.text, "<li><a href=\"#{id}\">{title}</a></li>");
            }
            self.text += "</ul>";
        }
        self.text +=
            "<p><button type=\"button\" class=\"all\">Unfold everything</button></p></div></nav>\n";
    }

    fn part(&mut self, part: &Part) -> Result<(), Failure> {
        if !part.title.is_empty() {
            let _ = writeln!(self.text, "<h2 class=\"part\">{}</h2>", escaped(part.title));
        }
        for (lead, section) in &part.sections {
            self.section(lead, section, part.open)?;
        }
        Ok(())
    }

    fn section(&mut self, lead: &str, section: &Section, open: bool) -> Result<(), Failure> {
        let open = if open { " open" } else { "" };
        let _ = writeln!(
            self.text,
            "<details class=\"section\" id=\"{}\"{open}><summary><h3>{}</h3><span>{}</span></summary>",
            id(section.title),
            escaped(section.title),
            escaped(lead)
        );
        for block in &section.blocks {
            match block {
                Block::Text(text) => {
                    let _ = writeln!(self.text, "<p>{}</p>", html(text));
                }
                Block::Table(table) | Block::Annex(table) => {
                    self.table(table, table.rows.len() > ROWS);
                }
                Block::Answer(table) => self.table(table, false),
                Block::Figure(figure) => self.figure(figure)?,
            }
        }
        self.text += "</details>\n";
        Ok(())
    }

    fn table(&mut self, table: &Table, folds: bool) {
        self.tables += 1;
        let number = self.tables;
        let caption = html(&table.caption);
        let file = format!("<a href=\"{0}.csv\">{0}.csv</a>", table.name);
        let _ = write!(self.text, "<figure id=\"table-{}\">", table.name);
        let _ = if folds {
            write!(
                self.text,
                "<details class=\"long\"><summary><b>Table {number}</b>, {} rows: {caption}</summary>",
                table.rows.len()
            )
        } else {
            write!(
                self.text,
                "<figcaption><b>Table {number}</b> {caption}</figcaption>"
            )
        };
        self.text += "<div class=\"wide\" tabindex=\"0\"><table><thead><tr>";
        for column in &table.columns {
            let _ = write!(self.text, "<th>{}</th>", with_code(column));
        }
        self.text += "</tr></thead><tbody>";
        for row in &table.rows {
            self.text += "<tr>";
            for cell in row {
                self.text += &cell_html(cell);
            }
            self.text += "</tr>\n";
        }
        self.text += "</tbody></table></div>";
        if folds {
            self.text += "</details>";
        }
        let _ = writeln!(self.text, "<p class=\"files\">{file}</p></figure>");
    }

    fn figure(&mut self, figure: &Figure) -> Result<(), Failure> {
        self.figures += 1;
        let Figure { name, caption, .. } = figure;
        // The first sentence is the title.
        let (title, rest) = sentence(caption);
        let _ = write!(
            self.text,
            "<figure id=\"figure-{name}\"><figcaption><b>Figure {}: {}.</b> {}</figcaption>",
            self.figures,
            with_code(title),
            html(rest)
        );
        let columns = figure.columns.clamp(1, 2).min(figure.panels.len().max(1));
        let _ = write!(self.text, "<div class=\"panels columns-{columns}\">");
        for panel in &figure.panels {
            self.panel(panel, figure.size, title)?;
        }
        let _ = writeln!(
            self.text,
            "</div><p class=\"files\"><a href=\"{name}.svg\">{name}.svg</a> <a href=\"{name}.csv\">{name}.csv</a></p></figure>"
        );
        Ok(())
    }

    /// A panel drawn for a wide and for a narrow window: a picture that is only made smaller cannot be read.
    fn panel(
        &mut self,
        panel: &Panel,
        (width, height): (u32, u32),
        title: &str,
    ) -> Result<(), Failure> {
        let small = (NARROW, (height * 4 / 5).clamp(250, 330));
        let label = format!("<svg role=\"img\" aria-label=\"{}\" ", escaped(title));
        let (wide, narrow) = (
            render_one(panel, (width, height))?,
            render_one(&narrow(panel), small)?,
        );
        for (class, svg) in [("on-wide", wide), ("on-narrow", narrow)] {
            let svg = themed(&svg).replacen("<svg ", &label, 1);
            let _ = write!(self.text, "<div class=\"{class}\">{svg}</div>");
        }
        Ok(())
    }
}

fn cell_html(cell: &Cell) -> String {
    match cell {
        Cell::Number(_, shown) => format!("<td class=\"number\">{}</td>", number(shown)),
        Cell::Code(line) => format!(
            "<td><details><summary>request</summary><code>{}</code></details></td>",
            escaped(line)
        ),
        Cell::Text(text) if text.chars().count() > LONG => {
            format!("<td class=\"text\">{}</td>", with_code(text))
        }
        Cell::Text(text) => format!("<td>{}</td>", with_code(text)),
    }
}

/// A number as it is printed in books: a power of ten in its own line of height, a minus sign, thin spaces between thousands.
fn number(shown: &str) -> String {
    let digits = |text: &str| text.replace('-', "\u{2212}");
    match shown.split_once('e') {
        Some((mantissa, exponent)) if exponent.parse::<i32>().is_ok() => format!(
            "{}\u{202f}\u{b7}\u{202f}10<sup>{}</sup>",
            digits(mantissa),
            digits(exponent)
        ),
        _ => digits(&thousands(shown)),
    }
}

/// Thin spaces between thousands, from five digits on.
fn thousands(shown: &str) -> String {
    let start = shown.find(|letter: char| letter.is_ascii_digit());
    let whole = start.map_or("", |start| &shown[start..]);
    let end = whole.find(|letter: char| !letter.is_ascii_digit());
    let count = end.unwrap_or(whole.len());
    if count < 5 {
        return escaped(shown);
    }
    let start = start.unwrap_or(0);
    let grouped: String = shown[start..start + count]
        .char_indices()
        .flat_map(|(index, digit)| {
            let gap = index > 0 && (count - index).is_multiple_of(3);
            gap.then_some('\u{202f}').into_iter().chain([digit])
        })
        .collect();
    format!(
        "{}{grouped}{}",
        escaped(&shown[..start]),
        escaped(&shown[start + count..])
    )
}

/// The first sentence, without its full stop, and what follows; an abbreviation does not end one.
fn sentence(text: &str) -> (&str, &str) {
    let end = text.match_indices(". ").find(|(place, _)| {
        let after = text[place + 2..].chars().next();
        after.is_some_and(char::is_uppercase)
            && !text[..*place].ends_with(" al")
            && !text[..*place].ends_with(" eq")
    });
    match end {
        Some((place, _)) => (&text[..place], &text[place + 2..]),
        None => (text.trim_end_matches('.'), ""),
    }
}

fn id(title: &str) -> String {
    title
        .chars()
        .map(|letter| {
            if letter.is_ascii_alphanumeric() {
                letter.to_ascii_lowercase()
            } else {
                '-'
            }
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_sentence_is_the_title() {
        assert_eq!(
            sentence("Alberdi et al. Slip by eq. (3), so far. The rest. More."),
            ("Alberdi et al. Slip by eq. (3), so far", "The rest. More.")
        );
        assert_eq!(sentence("One."), ("One", ""));
    }

    #[test]
    fn numbers_read_as_in_books() {
        assert_eq!(
            number("-3.2e-7"),
            "\u{2212}3.2\u{202f}\u{b7}\u{202f}10<sup>\u{2212}7</sup>"
        );
        assert_eq!(number("13102330"), "13\u{202f}102\u{202f}330");
        assert_eq!(number("< 4123.5"), "&lt; 4123.5");
        assert_eq!(number("-12345.678"), "\u{2212}12\u{202f}345.678");
        assert_eq!(number("infinite"), "infinite");
    }

    #[test]
    fn a_page_links_its_sections_and_folds_long_tables() {
        let table = |rows: usize| Table {
            name: "lengths",
            caption: "Lengths".into(),
            columns: vec!["size".into()],
            rows: vec![vec![Cell::fixed(1.0, 1)]; rows],
        };
        let section = Section {
            title: "One & all",
            blocks: vec![
                Block::Table(table(ROWS)),
                Block::Table(table(ROWS + 1)),
                Block::Text("`a` < b".into()),
            ],
        };
        let page = Page::of(&Document::of("Title".into(), vec![section])).unwrap();
        assert!(page.contains("<a href=\"#one---all\">One &amp; all</a>"));
        assert!(page.contains("<details class=\"section\" id=\"one---all\" open>"));
        assert_eq!(page.matches("<details class=\"long\">").count(), 1);
        assert!(page.contains("<code>a</code> &lt; b"));
    }
}
