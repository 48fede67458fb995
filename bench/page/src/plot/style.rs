//! Colours and sizes of all figures.

use plotters::style::RGBColor;

/// Colours that stay apart for every common kind of colour vision (Okabe and Ito 2008).
pub const PALETTE: [RGBColor; 7] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(230, 159, 0),
    RGBColor(86, 180, 233),
    RGBColor(60, 60, 60),
];

/// The drawing library rounds to whole pixels: everything is drawn so many times too large, and the
/// picture scaled down.
pub const SCALE: i32 = 8;

/// A length in pixels of the finished picture, as it is drawn.
pub const fn px(pixels: i32) -> i32 {
    pixels * SCALE
}

pub const TEXT: RGBColor = RGBColor(40, 40, 40);
pub const FONT: &str = "sans-serif";
/// Height of letters of a title. The drawing library draws letters a fifth smaller.
pub const TITLE_SIZE: i32 = px(19);
/// Height of letters of the label of an axis.
pub const LABEL_SIZE: i32 = px(16);
/// Height of letters of a number at an axis, of a legend and of a note.
pub const TICK_SIZE: i32 = px(16);
/// Height of a line of title or legend.
pub const LINE_HEIGHT: i32 = px(21);
/// Width of a line.
pub const STROKE: u32 = px(2).unsigned_abs();

/// Width of a text, near enough to set one entry of a legend beside the other: seven twelfths of a letter's height, which is that
/// of wide fonts.
pub fn text_width(text: &str, size: i32) -> i32 {
    size * 26 / 50 * text.chars().count() as i32
}

/// A text in lines that are no wider than `width`; a word that is wider has a line of its own.
pub fn lines(text: &str, size: i32, width: i32) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        match lines.last_mut() {
            Some(line) if text_width(line, size) + text_width(word, size) + size / 2 <= width => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.into()),
        }
    }
    lines
}
