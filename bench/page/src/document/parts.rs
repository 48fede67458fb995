//! What a report is made of.

use super::figure::Figure;
use super::table::Table;

/// A piece of a section.
pub enum Block {
    /// A paragraph; lines of it stay lines.
    Text(String),
    /// A table.
    Table(Table),
    /// A table that a page is made for: never folded.
    Answer(Table),
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

/// Sections that belong together, under a heading of their own.
pub struct Part {
    /// Heading; none where empty.
    pub title: &'static str,
    /// Sections, each with a line on what stands there.
    pub sections: Vec<(&'static str, Section)>,
    /// Whether a page shows its sections unfolded.
    pub open: bool,
}

/// A report.
pub struct Document {
    /// Heading.
    pub title: String,
    /// Where, when and with what it was made: lines below the heading.
    pub made: Vec<String>,
    /// Its parts.
    pub parts: Vec<Part>,
}

impl Document {
    /// A document of one part, unfolded.
    pub fn of(title: String, sections: Vec<Section>) -> Self {
        Self {
            title,
            made: Vec::new(),
            parts: vec![Part {
                title: "",
                sections: sections.into_iter().map(|section| ("", section)).collect(),
                open: true,
            }],
        }
    }

    /// Every block, from the first part to the last.
    pub(super) fn blocks(&self) -> impl Iterator<Item = &Block> {
        self.parts
            .iter()
            .flat_map(|part| &part.sections)
            .flat_map(|(_, section)| &section.blocks)
    }
}
