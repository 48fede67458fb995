//! Series over two axes, with title, legend and texts beside points.

use std::ops::Range;

use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::legend;
use super::notes::{Ground, Placed, Rect, place};
use super::scale::Axis;
use super::series::{Axes, Series};
use super::style::{LABEL_SIZE, LINE_HEIGHT, TITLE_SIZE, lines, px, text_width};
use super::words::{Area, Drawn, draw_lines, draw_title, label_style, tick_style};

/// A chart.
#[derive(Clone, Debug)]
pub struct Chart {
    /// Title; none where empty.
    pub title: String,
    /// Horizontal axis.
    pub x: Axis,
    /// Vertical axis.
    pub y: Axis,
    /// What it shows.
    pub series: Vec<Series>,
    /// Texts beside points.
    pub notes: Vec<Note>,
}

/// A text beside a point.
#[derive(Clone, Debug)]
pub struct Note {
    /// The point.
    pub at: (f64, f64),
    /// What it is.
    pub text: String,
}

/// Height of the numbers and the label below a horizontal axis.
const X_LABELS: i32 = px(48);
/// Width of the numbers and the label beside a vertical axis.
const Y_LABELS: i32 = px(84);
/// Width of the numbers alone, where the label stands above.
const Y_NUMBERS: i32 = px(60);
/// Height of the shortest vertical axis.
const LEAST_AXIS: i32 = px(120);
/// Room for one number along a horizontal axis.
const X_ROOM: i32 = px(58);
/// Room for one number along a vertical axis.
const Y_ROOM: i32 = px(30);

/// How many numbers an axis of this length has room for.
pub fn room(length: i32, each: i32) -> usize {
    (length / each).max(2) as usize
}

impl Chart {
    /// Height, in pixels of the drawing, at which title and legend leave the axes room in a drawing so many pixels wide.
    pub fn least_height(&self, width: i32) -> i32 {
        let title = lines(&self.title, TITLE_SIZE, width - px(12)).len();
        let legend = legend::lines_of(&self.series, width).len();
        // A line for the label of the vertical axis.
        let header = LINE_HEIGHT * (title + legend + 1) as i32;
        header + px(20) + X_LABELS + LEAST_AXIS
    }

    /// Draws the chart into its area.
    pub fn draw(&self, area: &Area<'_>) -> Drawn {
        let (width, height) = area.dim_in_pixel();
        let (width, height) = (width as i32, height as i32);
        let legend = legend::lines_of(&self.series, width);
        let mut header = draw_title(area, &self.title)?;
        legend::draw(area, &legend, px(4) + header)?;
        header += px(8) + LINE_HEIGHT * legend.len() as i32;
        // A label that is longer than its axis stands above it.
        let left = height - header - X_LABELS - px(12);
        let above = text_width(&self.y.label, LABEL_SIZE) > left;
        if above {
            header += draw_lines(area, &self.y.label, header)?;
        }

        let (_, body) = area.split_vertically(header);
        let x = self.x.range(self.points().map(|(x, _)| x));
        let y = self.y.range(self.points().map(|(_, y)| y));
        // Charts below each other keep their edges in line where there is room.
        let narrow = above && width < px(500);
        let side = if narrow { Y_NUMBERS } else { Y_LABELS };
        let mut context = ChartBuilder::on(&body)
            .margin(px(6))
            .margin_right(px(22))
            .x_label_area_size(X_LABELS)
            .y_label_area_size(side)
            .build_cartesian_2d(x.clone(), y.clone())?;
        let mut mesh = context.configure_mesh();
        let (across, up) = (room(width - side, X_ROOM), room(left, Y_ROOM));
        let x_text = |place: &f64| self.x.text(*place, &x);
        let y_text = |place: &f64| self.y.text(*place, &y);
        mesh.x_labels(self.x.labels(&x).min(across))
            .y_labels(self.y.labels(&y).min(up))
            .x_label_formatter(&x_text)
            .y_label_formatter(&y_text)
            .x_desc(self.x.label.as_str())
            .label_style(tick_style())
            .axis_desc_style(label_style())
            .axis_style(RGBColor(120, 120, 120).stroke_width(px(1).unsigned_abs()))
            .bold_line_style(RGBColor(222, 222, 222).stroke_width(px(1).unsigned_abs()))
            .set_all_tick_mark_size(px(4))
            .light_line_style(TRANSPARENT);
        if !above {
            mesh.y_desc(self.y.label.as_str());
        }
        mesh.draw()?;

        for series in &self.series {
            series.draw(&mut context, (&self.x, &self.y), (&x, &y))?;
        }
        self.draw_notes(&context, area, &x, &y)
    }

    fn points(&self) -> impl Iterator<Item = (f64, f64)> {
        self.series
            .iter()
            .flat_map(|series| series.points.iter().copied())
    }

    /// Texts beside points, where there is room for them.
    fn draw_notes(
        &self,
        context: &Axes<'_, '_>,
        area: &Area<'_>,
        x: &Range<f64>,
        y: &Range<f64>,
    ) -> Drawn {
        if self.notes.is_empty() {
            return Ok(());
        }
        // Places count from the whole picture, those of texts from the area.
        let (origin_x, origin_y) = area.get_base_pixel();
        let pixel = |&(at_x, at_y): &(f64, f64)| {
            let (at_x, at_y) = (self.x.place(at_x)?, self.y.place(at_y)?);
            let inside = (x.start..=x.end).contains(&at_x) && (y.start..=y.end).contains(&at_y);
            let (at_x, at_y) = context.backend_coord(&(at_x, at_y));
            inside.then_some((at_x - origin_x, at_y - origin_y))
        };
        let notes: Vec<_> = self
            .notes
            .iter()
            .filter_map(|note| Some((pixel(&note.at)?, note.text.as_str())))
            .collect();
        let (lines, points): (Vec<&Series>, Vec<&Series>) =
            self.series.iter().partition(|series| series.is_line());
        let pixels =
            |series: &Series| -> Vec<_> { series.points.iter().filter_map(pixel).collect() };
        let range = context.plotting_area().get_pixel_range();
        let ground = Ground {
            area: Rect {
                left: range.0.start - origin_x,
                top: range.1.start - origin_y,
                right: range.0.end - origin_x,
                bottom: range.1.end - origin_y,
            },
            points: &points.into_iter().flat_map(pixels).collect::<Vec<_>>(),
            lines: &lines.into_iter().map(pixels).collect::<Vec<_>>(),
        };
        let places = place(&notes, &ground);
        for ((point, text), placed) in notes.iter().zip(places) {
            if let Some(placed) = placed {
                draw_note(area, *point, text, &placed)?;
            }
        }
        Ok(())
    }
}

/// Draws one text, with a line to its point where that is not right beside it.
fn draw_note(area: &Area<'_>, point: (i32, i32), text: &str, placed: &Placed) -> Drawn {
    let Rect {
        left,
        top,
        right,
        bottom,
    } = placed.place;
    if placed.leads {
        let nearest = (point.0.clamp(left, right), point.1.clamp(top, bottom));
        let thin = RGBColor(120, 120, 120).stroke_width(px(1).unsigned_abs());
        area.draw(&PathElement::new(vec![point, nearest], thin))?;
    }
    // The end towards the point is exact; the width of the text is an estimate.
    let (side, x) = if left > point.0 {
        (HPos::Left, left)
    } else if right < point.0 {
        (HPos::Right, right)
    } else {
        (HPos::Center, i32::midpoint(left, right))
    };
    let style = tick_style().pos(Pos::new(side, VPos::Center));
    let place = (x, i32::midpoint(top, bottom));
    area.draw(&Text::new(text.to_owned(), place, style))?;
    Ok(())
}
