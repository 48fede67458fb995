//! Panels of a figure, and the figure drawn from them.

use plotters::prelude::*;

use super::chart::Chart;
use super::map::ColourMap;
use super::strip::Strip;
use super::style::SCALE;
use super::words::{Area, Drawn};
use crate::failure::Failure;

/// One panel of a figure.
#[derive(Clone)]
pub enum Panel {
    /// Lines, points and areas over two axes.
    Chart(Chart),
    /// The same, half as high again.
    Tall(Chart),
    /// Colour bands over two axes.
    Map(ColourMap),
    /// What holds when, as coloured bars over time.
    Strip(Strip),
}

impl Panel {
    /// A chart half as high again.
    #[must_use]
    pub fn tall(self) -> Self {
        match self {
            Self::Chart(chart) => Self::Tall(chart),
            other => other,
        }
    }

    /// Its height in a figure whose panels are so high, pixels.
    const fn height(&self, height: u32) -> u32 {
        match self {
            Self::Strip(strip) => strip.height(),
            Self::Tall(_) => height * 3 / 2,
            Self::Chart(_) | Self::Map(_) => height,
        }
    }

    fn draw(&self, area: &Area<'_>) -> Drawn {
        match self {
            Self::Chart(chart) | Self::Tall(chart) => chart.draw(area),
            Self::Map(map) => map.draw(area),
            Self::Strip(strip) => strip.draw(area),
        }
    }
}

/// Draws the panels row by row, each of the given size in pixels.
pub fn render(
    panels: &[Panel],
    columns: usize,
    (width, height): (u32, u32),
) -> Result<String, Failure> {
    let columns = columns.clamp(1, panels.len().max(1));
    let rows: Vec<(&[Panel], u32)> = panels
        .chunks(columns)
        .map(|row| {
            let heights = row.iter().map(|panel| panel.height(height));
            (row, heights.max().unwrap_or(height))
        })
        .collect();
    let size = (
        width * columns as u32,
        rows.iter().map(|(_, height)| height).sum::<u32>(),
    );
    let mut top = 0;
    let mut places = Vec::new();
    for (row, height) in rows {
        for (column, panel) in row.iter().enumerate() {
            places.push((panel, (column as u32 * width, top), (width, height)));
        }
        top += height;
    }
    draw(size, &places)
}

/// A panel for a narrow window: a map has fewer cells.
pub fn narrow(panel: &Panel) -> Panel {
    match panel {
        Panel::Map(map) => Panel::Map(map.coarser()),
        other => other.clone(),
    }
}

/// Draws one panel, so many pixels wide and, where it is no strip, so many high, or more where a long legend needs it.
pub fn render_one(panel: &Panel, (width, height): (u32, u32)) -> Result<String, Failure> {
    let least = match panel {
        Panel::Chart(chart) | Panel::Tall(chart) => {
            (chart.least_height(width as i32 * SCALE) / SCALE).unsigned_abs()
        }
        Panel::Map(_) | Panel::Strip(_) => 0,
    };
    let height = panel.height(height).max(least);
    draw((width, height), &[(panel, (0, 0), (width, height))])
}

type Place<'a> = (&'a Panel, (u32, u32), (u32, u32));

fn draw(size: (u32, u32), places: &[Place<'_>]) -> Result<String, Failure> {
    let scale = SCALE.unsigned_abs();
    let drawn = (size.0 * scale, size.1 * scale);
    let mut svg = String::new();
    {
        let root = SVGBackend::with_string(&mut svg, drawn).into_drawing_area();
        let draw = || -> Drawn {
            root.fill(&WHITE)?;
            for (panel, (left, top), (width, height)) in places {
                let area = root
                    .clone()
                    .shrink((left * scale, top * scale), (width * scale, height * scale));
                panel.draw(&area)?;
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
