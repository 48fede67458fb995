//! Plots as SVG text: charts of lines, points and areas, and maps of colour bands.
//!
//! No fonts of this machine are needed: text is SVG text in the viewer's sans-serif font. A logarithmic
//! axis is a linear one over the decimal logarithm.

// Counts of pixels, lines and bands are far below the largest i32, which the drawing library counts in.
#![allow(clippy::cast_possible_wrap)]

mod chart;
mod map;
mod scale;
mod style;
mod thin;

use plotters::prelude::*;

pub use chart::{Chart, Mark, Note, Series};
pub use map::{ColourMap, Colours};
pub use scale::Axis;
pub use thin::thin;

use crate::failure::Failure;
use style::SCALE;

/// One panel of a figure.
pub enum Panel {
    /// Lines, points and areas over two axes.
    Chart(Chart),
    /// Colour bands over two axes.
    Map(ColourMap),
}

/// Draws the panels row by row, each of the given size in pixels.
pub fn render(
    panels: &[Panel],
    columns: usize,
    (width, height): (u32, u32),
) -> Result<String, Failure> {
    let columns = columns.clamp(1, panels.len().max(1));
    let rows = panels.len().div_ceil(columns);
    let size = (width * columns as u32, height * rows as u32);
    let drawn = (size.0 * SCALE.unsigned_abs(), size.1 * SCALE.unsigned_abs());
    let mut svg = String::new();
    {
        let root = SVGBackend::with_string(&mut svg, drawn).into_drawing_area();
        let draw = || -> Result<(), Box<dyn std::error::Error>> {
            root.fill(&WHITE)?;
            for (panel, area) in panels.iter().zip(root.split_evenly((rows, columns))) {
                match panel {
                    Panel::Chart(chart) => chart.draw(&area)?,
                    Panel::Map(map) => map.draw(&area)?,
                }
            }
            root.present()?;
            Ok(())
        };
        draw().map_err(|error| Failure::Data(format!("cannot draw a figure: {error}")))?;
    }
    // The view box stays as large as it was drawn.
    Ok(svg.replacen(
        &format!(r#"width="{}" height="{}""#, drawn.0, drawn.1),
        &format!(r#"width="{}" height="{}""#, size.0, size.1),
        1,
    ))
}
