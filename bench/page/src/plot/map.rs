//! A quantity over two axes, in bands of colour.

use std::ops::Range;

use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::chart::room;
use super::scale::Axis;
use super::series::Axes;
use super::style::{LABEL_SIZE, TICK_SIZE, px, text_width};
use super::words::{Area, Drawn, draw_lines, draw_title, label_style, tick_style};

/// Values on a grid of cells, in bands between the given bounds.
#[derive(Clone, Debug)]
pub struct ColourMap {
    /// Title.
    pub title: String,
    /// Horizontal axis, linear, with its ends.
    pub x: Axis,
    /// Vertical axis, linear, with its ends.
    pub y: Axis,
    /// Quantity and unit of the bands.
    pub quantity: String,
    /// Colours of the bands.
    pub colours: Colours,
    /// Bounds between bands, rising, each with its text.
    pub bounds: Vec<(f64, String)>,
    /// Rows from bottom to top, each from left to right.
    pub values: Vec<Vec<f64>>,
}

/// Colours of the bands of a map.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Colours {
    /// For sizes: from dark to light.
    Sequential,
    /// For values with a sign, their bounds even about zero: blue below, red above, and white in the middle.
    Diverging,
}

/// `RdBu` (Brewer 2003) turned round: its ends are told apart by every kind of colour vision.
const BLUE_TO_RED: [RGBColor; 7] = [
    RGBColor(33, 102, 172),
    RGBColor(103, 169, 207),
    RGBColor(209, 229, 240),
    RGBColor(247, 247, 247),
    RGBColor(253, 219, 199),
    RGBColor(239, 138, 98),
    RGBColor(178, 24, 43),
];

/// Cividis (Nunez, Anderton, Renslow 2018): even in lightness, the same for every kind of colour
/// vision.
const CIVIDIS: [RGBColor; 7] = [
    RGBColor(0, 34, 78),
    RGBColor(53, 69, 108),
    RGBColor(102, 105, 112),
    RGBColor(148, 142, 119),
    RGBColor(200, 184, 102),
    RGBColor(239, 220, 80),
    RGBColor(254, 240, 150),
];

/// Colour at `share`, 0 to 1, of the scale.
fn colour(colours: Colours, share: f64) -> RGBColor {
    let scale = match colours {
        Colours::Sequential => CIVIDIS,
        Colours::Diverging => BLUE_TO_RED,
    };
    let place = share.clamp(0.0, 1.0) * (scale.len() - 1) as f64;
    let index = (place as usize).min(scale.len() - 2);
    let rest = place - index as f64;
    let (low, high) = (scale[index], scale[index + 1]);
    let mix = |low: u8, high: u8| {
        (f64::from(low) + rest * (f64::from(high) - f64::from(low))).round() as u8
    };
    RGBColor(mix(low.0, high.0), mix(low.1, high.1), mix(low.2, high.2))
}

impl Colours {
    /// By the bounds of the bands: with a sign where some lie below zero and some above.
    pub fn of<'a>(bounds: impl IntoIterator<Item = &'a f64>) -> Self {
        let (below, above) = bounds
            .into_iter()
            .fold((false, false), |(below, above), bound| {
                (below || *bound < 0.0, above || *bound > 0.0)
            });
        if below && above {
            Self::Diverging
        } else {
            Self::Sequential
        }
    }
}

impl ColourMap {
    /// Centre and value of every cell.
    pub fn cells(&self) -> impl Iterator<Item = (f64, f64, f64)> + '_ {
        let x = self.x.range(std::iter::empty());
        let y = self.y.range(std::iter::empty());
        let centre = |range: &std::ops::Range<f64>, index: usize, count: usize| {
            range.start + (range.end - range.start) * (index as f64 + 0.5) / count.max(1) as f64
        };
        let rows = self.values.len();
        self.values
            .iter()
            .enumerate()
            .flat_map(move |(row, values)| {
                let height = centre(&y, row, rows);
                let x = x.clone();
                values
                    .iter()
                    .enumerate()
                    .map(move |(column, value)| (centre(&x, column, values.len()), height, *value))
            })
    }

    /// Index of the band of a value; none where it is NaN or infinite.
    fn band(&self, value: f64) -> Option<usize> {
        (!value.is_nan()).then(|| {
            self.bounds
                .iter()
                .take_while(|(bound, _)| value >= *bound)
                .count()
        })
    }

    fn band_colour(&self, band: usize) -> RGBColor {
        let last = self.bounds.len().max(1) as f64;
        let place = band as f64;
        if self.colours == Colours::Sequential {
            return colour(self.colours, place / last);
        }
        // White is at zero, wherever that is among the bounds: between two bands, or in the middle of one.
        let below = |bound: &&(f64, String)| bound.0 < 0.0;
        let at_zero = self.bounds.iter().any(|(bound, _)| *bound == 0.0);
        let half = if at_zero { 0.5 } else { 0.0 };
        let zero = self.bounds.iter().filter(below).count() as f64 + half;
        let share = if place < zero {
            0.5 * place / zero
        } else {
            0.5 + 0.5 * (place - zero) / (last - zero).max(1e-9)
        };
        colour(self.colours, share)
    }

    /// This map with every second cell each way where it has many, for a small picture.
    #[must_use]
    pub fn coarser(&self) -> Self {
        const MANY: usize = 60;
        let stride = |count: usize| count.div_ceil(MANY).max(1);
        let rows = self.values.iter().step_by(stride(self.values.len()));
        Self {
            values: rows
                .map(|row| row.iter().step_by(stride(row.len())).copied().collect())
                .collect(),
            ..self.clone()
        }
    }

    /// Draws the map into its area, its bands in a column at the right.
    pub fn draw(&self, area: &Area<'_>) -> Drawn {
        let mut header = draw_title(area, &self.title)? + px(8);
        header += draw_lines(area, &format!("colour: {}", self.quantity), header)?;
        // A label that is longer than its axis stands above it.
        let axis = area.dim_in_pixel().1 as i32 - header - px(66);
        let above = text_width(&self.y.label, LABEL_SIZE) > axis;
        if above {
            header += draw_lines(area, &format!("upwards: {}", self.y.label), header)?;
        }
        let (_, body) = area.split_vertically(header);
        let (width, height) = body.dim_in_pixel();
        let widest = self
            .bounds
            .iter()
            .map(|(_, label)| text_width(label, TICK_SIZE))
            .max();
        let key_width = px(40) + widest.unwrap_or(0);
        let (left, key) = body.split_horizontally(width as i32 - key_width);

        let x = self.x.range(std::iter::empty());
        let y = self.y.range(std::iter::empty());
        let mut context = ChartBuilder::on(&left)
            .margin(px(6))
            .x_label_area_size(px(48))
            .y_label_area_size(px(64))
            .build_cartesian_2d(x.clone(), y.clone())?;
        let (x_text, y_text) = (
            |place: &f64| self.x.text(*place, &x),
            |place: &f64| self.y.text(*place, &y),
        );
        let mut mesh = context.configure_mesh();
        mesh.disable_mesh()
            .axis_style(RGBColor(120, 120, 120).stroke_width(px(1).unsigned_abs()))
            .set_all_tick_mark_size(px(4))
            .x_labels(
                self.x
                    .labels(&x)
                    .min(room(width as i32 - key_width, px(64))),
            )
            .y_labels(self.y.labels(&y).min(room(height as i32, px(40))))
            .x_label_formatter(&x_text)
            .y_label_formatter(&y_text)
            .x_desc(self.x.label.as_str())
            .label_style(tick_style())
            .axis_desc_style(label_style());
        if !above {
            mesh.y_desc(self.y.label.as_str());
        }
        mesh.draw()?;

        self.draw_cells(&mut context, &x, &y)?;
        self.draw_key(&key, height as i32)
    }

    /// Draws the cells; neighbours of one band are one rectangle.
    fn draw_cells(&self, context: &mut Axes<'_, '_>, x: &Range<f64>, y: &Range<f64>) -> Drawn {
        let cell_height = (y.end - y.start) / self.values.len().max(1) as f64;
        for (row, values) in self.values.iter().enumerate() {
            let bottom = y.start + row as f64 * cell_height;
            let cell_width = (x.end - x.start) / values.len().max(1) as f64;
            let mut start = 0;
            for run in values.chunk_by(|one, other| self.band(*one) == self.band(*other)) {
                let end = start + run.len();
                if let Some(band) = run.first().and_then(|value| self.band(*value)) {
                    // Half a cell too wide and too high: what comes next is drawn over it, and no seam
                    // of background shines through between neighbours.
                    context.draw_series([Rectangle::new(
                        [
                            (x.start + start as f64 * cell_width, bottom),
                            (
                                (x.start + (end as f64 + 0.5) * cell_width).min(x.end),
                                (bottom + 1.5 * cell_height).min(y.end),
                            ),
                        ],
                        self.band_colour(band).filled(),
                    )])?;
                }
                start = end;
            }
        }
        Ok(())
    }

    /// Draws the bands in a column, with their bounds.
    fn draw_key(&self, key: &Area<'_>, height: i32) -> Drawn {
        let bands = self.bounds.len() as i32 + 1;
        let top = px(8);
        let step = ((height - px(70) - top) / bands).clamp(px(8), px(34));
        // Every so many bounds have their text, so that none stands over another.
        let stride = (px(17) / step.max(1) + 1).max(1) as usize;
        let text = tick_style().pos(Pos::new(HPos::Left, VPos::Center));
        for band in 0..bands {
            let upper = top + (bands - 1 - band) * step;
            key.draw(&Rectangle::new(
                [(px(4), upper), (px(24), upper + step)],
                self.band_colour(band as usize).filled(),
            ))?;
        }
        for (index, (_, label)) in self.bounds.iter().enumerate().step_by(stride) {
            let place = top + (bands - 1 - index as i32) * step;
            let label = label.replace('-', "\u{2212}");
            key.draw(&Text::new(label, (px(30), place), text.clone()))?;
        }
        Ok(())
    }
}
