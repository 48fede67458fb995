//! Plots as SVG text: charts of lines, points and areas, and maps of colour bands.
//!
//! Nothing is asked of the machine: text is SVG text in the viewer's sans-serif font. A logarithmic
//! axis is a linear one over the decimal logarithm.

mod chart;
mod map;
mod scale;

use plotters::prelude::*;

pub use chart::{Chart, Mark, Series};
pub use map::ColourMap;
pub use scale::Axis;

use crate::failure::Failure;

/// Colours that stay apart for every common kind of colour vision (Okabe and Ito 2008).
const PALETTE: [RGBColor; 7] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(230, 159, 0),
    RGBColor(86, 180, 233),
    RGBColor(60, 60, 60),
];

const TEXT: RGBColor = RGBColor(40, 40, 40);
const FONT: &str = "sans-serif";
const TITLE_SIZE: f64 = 17.0;
const LABEL_SIZE: f64 = 14.0;
const TICK_SIZE: f64 = 13.0;
/// Height of a line of title or legend, pixels.
const LINE_HEIGHT: u32 = 22;

/// Width of a text, pixels, near enough to set one entry of a legend beside the other.
fn text_width(text: &str, size: f64) -> i32 {
    (0.56 * size * text.chars().count() as f64).ceil() as i32
}

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
    let mut svg = String::new();
    {
        let size = (width * columns as u32, height * rows as u32);
        let root = SVGBackend::with_string(&mut svg, size).into_drawing_area();
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
    Ok(svg)
}
