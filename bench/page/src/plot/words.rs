//! Words in an area of a picture: titles, lines of text, and their styles.

use std::error::Error;

use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::style::{FONT, LABEL_SIZE, LINE_HEIGHT, TEXT, TICK_SIZE, TITLE_SIZE, lines, px};

pub type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
/// Whether something was drawn.
pub type Drawn = Result<(), Box<dyn Error>>;

/// Draws a title in the first lines of an area; the height that it takes.
pub fn draw_title(area: &Area<'_>, title: &str) -> Result<i32, Box<dyn Error>> {
    let width = area.dim_in_pixel().0 as i32;
    let style = TextStyle::from((FONT, TITLE_SIZE).into_font())
        .color(&TEXT)
        .pos(Pos::new(HPos::Center, VPos::Top));
    let lines = lines(title, TITLE_SIZE, width - px(12));
    for (index, line) in lines.iter().enumerate() {
        let top = px(6) + LINE_HEIGHT * index as i32;
        area.draw(&Text::new(line.clone(), (width / 2, top), style.clone()))?;
    }
    Ok(LINE_HEIGHT * lines.len() as i32)
}

/// Draws lines of text at the left from `top` on; the height that they take.
pub fn draw_lines(area: &Area<'_>, text: &str, top: i32) -> Result<i32, Box<dyn Error>> {
    let width = area.dim_in_pixel().0 as i32;
    let style = label_style().pos(Pos::new(HPos::Left, VPos::Top));
    let lines = lines(text, LABEL_SIZE, width - px(20));
    for (index, line) in lines.iter().enumerate() {
        let place = (px(10), top + LINE_HEIGHT * index as i32);
        area.draw(&Text::new(line.clone(), place, style.clone()))?;
    }
    Ok(LINE_HEIGHT * lines.len() as i32)
}

/// Style of the numbers along an axis.
pub fn tick_style() -> TextStyle<'static> {
    TextStyle::from((FONT, TICK_SIZE).into_font()).color(&TEXT)
}

pub fn label_style() -> TextStyle<'static> {
    TextStyle::from((FONT, LABEL_SIZE).into_font()).color(&TEXT)
}
