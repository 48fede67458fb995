//! Lines, points and areas over two axes, with the legend above.

use std::error::Error;
use std::ops::Range;

use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::scale::Axis;
use super::style::{
    FONT, LABEL_SIZE, LINE_HEIGHT, PALETTE, STROKE, TEXT, TICK_SIZE, TITLE_SIZE, px, text_width,
};

/// How a series is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mark {
    /// A line.
    Line,
    /// A dashed line.
    Dashed,
    /// Round points.
    Circles,
    /// Crosses.
    Crosses,
    /// Triangles.
    Triangles,
    /// A line with the area down to the lower edge shaded.
    ShadedBelow,
    /// A line with the area up to the upper edge shaded.
    ShadedAbove,
}

/// One quantity of a chart.
#[derive(Clone, Debug)]
pub struct Series {
    /// Entry of the legend; none where empty.
    pub name: String,
    /// Index into the palette.
    pub colour: usize,
    /// How it is drawn.
    pub mark: Mark,
    /// Its points; those that are not finite interrupt a line.
    pub points: Vec<(f64, f64)>,
}

impl Series {
    /// A series.
    pub fn new(name: &str, colour: usize, mark: Mark, points: Vec<(f64, f64)>) -> Self {
        Self {
            name: name.into(),
            colour,
            mark,
            points,
        }
    }

    fn rgb(&self) -> RGBColor {
        PALETTE[self.colour % PALETTE.len()]
    }
}

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
    /// Whether it stands on the left of the point.
    pub left: bool,
}

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
type Drawn = Result<(), Box<dyn Error>>;

/// Draws a title in the first line of an area.
pub fn draw_title(area: &Area<'_>, title: &str) -> Drawn {
    let (width, _) = area.dim_in_pixel();
    let style = TextStyle::from((FONT, TITLE_SIZE).into_font())
        .color(&TEXT)
        .pos(Pos::new(HPos::Center, VPos::Top));
    area.draw(&Text::new(
        title.to_owned(),
        (width as i32 / 2, px(6)),
        style,
    ))?;
    Ok(())
}

/// Style of the numbers along an axis.
pub fn tick_style() -> TextStyle<'static> {
    TextStyle::from((FONT, TICK_SIZE).into_font()).color(&TEXT)
}

/// Style of an axis' label.
pub fn label_style() -> TextStyle<'static> {
    TextStyle::from((FONT, LABEL_SIZE).into_font()).color(&TEXT)
}

impl Chart {
    /// Draws the chart into its area.
    pub fn draw(&self, area: &Area<'_>) -> Drawn {
        let legend = self.legend_lines(area.dim_in_pixel().0 as i32);
        let title_lines = i32::from(!self.title.is_empty());
        let header = px(8) + LINE_HEIGHT * (title_lines + legend.len() as i32);
        if title_lines > 0 {
            draw_title(area, &self.title)?;
        }
        draw_legend(area, &legend, px(4) + LINE_HEIGHT * title_lines)?;

        let (_, body) = area.split_vertically(header);
        let x = self.x.range(self.points().map(|(x, _)| x));
        let y = self.y.range(self.points().map(|(_, y)| y));
        let mut context = ChartBuilder::on(&body)
            .margin(px(6))
            .margin_right(px(22))
            .x_label_area_size(px(48))
            .y_label_area_size(px(74))
            .build_cartesian_2d(x.clone(), y.clone())?;
        context
            .configure_mesh()
            .x_labels(self.x.labels(&x))
            .y_labels(self.y.labels(&y))
            .x_label_formatter(&|place| self.x.text(*place, &x))
            .y_label_formatter(&|place| self.y.text(*place, &y))
            .x_desc(self.x.label.as_str())
            .y_desc(self.y.label.as_str())
            .label_style(tick_style())
            .axis_desc_style(label_style())
            .axis_style(RGBColor(120, 120, 120).stroke_width(px(1).unsigned_abs()))
            .bold_line_style(RGBColor(222, 222, 222).stroke_width(px(1).unsigned_abs()))
            .set_all_tick_mark_size(px(4))
            .light_line_style(TRANSPARENT)
            .draw()?;

        for series in &self.series {
            let colour = series.rgb();
            let line = colour.stroke_width(STROKE);
            let places = || {
                series
                    .points
                    .iter()
                    .map(|&(at_x, at_y)| Some((self.x.place(at_x)?, self.y.place(at_y)?)))
            };
            let visible = || {
                places().flatten().filter(|(at_x, at_y)| {
                    (x.start..=x.end).contains(at_x) && (y.start..=y.end).contains(at_y)
                })
            };
            match series.mark {
                Mark::Circles => {
                    context.draw_series(
                        visible().map(|point| Circle::new(point, px(5), colour.filled())),
                    )?;
                }
                Mark::Crosses => {
                    context.draw_series(visible().map(|point| Cross::new(point, px(5), line)))?;
                }
                Mark::Triangles => {
                    context.draw_series(
                        visible().map(|point| TriangleMarker::new(point, px(7), colour.filled())),
                    )?;
                }
                Mark::Line | Mark::Dashed | Mark::ShadedBelow | Mark::ShadedAbove => {
                    for piece in pieces(places(), &y) {
                        if matches!(series.mark, Mark::ShadedBelow | Mark::ShadedAbove) {
                            let base = if series.mark == Mark::ShadedBelow {
                                y.start
                            } else {
                                y.end
                            };
                            context.draw_series(AreaSeries::new(
                                piece.clone(),
                                base,
                                colour.mix(0.22),
                            ))?;
                        }
                        if series.mark == Mark::Dashed {
                            context.draw_series(DashedLineSeries::new(
                                piece,
                                px(7).unsigned_abs(),
                                px(5).unsigned_abs(),
                                line,
                            ))?;
                        } else {
                            context.draw_series(LineSeries::new(piece, line))?;
                        }
                    }
                }
            }
        }
        for Note { at, text, left } in &self.notes {
            if let (Some(x), Some(y)) = (self.x.place(at.0), self.y.place(at.1)) {
                let (side, distance) = if *left {
                    (HPos::Right, px(-10))
                } else {
                    (HPos::Left, px(10))
                };
                let style = tick_style().pos(Pos::new(side, VPos::Center));
                context.draw_series([
                    EmptyElement::at((x, y)) + Text::new(text.clone(), (distance, 0), style)
                ])?;
            }
        }
        Ok(())
    }

    fn points(&self) -> impl Iterator<Item = (f64, f64)> {
        self.series
            .iter()
            .flat_map(|series| series.points.iter().copied())
    }

    /// The legend's entries, with their places, broken into lines that fit.
    fn legend_lines(&self, width: i32) -> Vec<Vec<(i32, &Series)>> {
        const START: i32 = px(84);
        const SAMPLE: i32 = px(34);
        let mut lines: Vec<Vec<(i32, &Series)>> = Vec::new();
        let mut place = i32::MAX;
        for series in self.series.iter().filter(|series| !series.name.is_empty()) {
            let entry = SAMPLE + text_width(&series.name, TICK_SIZE) + px(16);
            if place.saturating_add(entry) > width {
                lines.push(Vec::new());
                place = START;
            }
            if let Some(line) = lines.last_mut() {
                line.push((place, series));
            }
            place += entry;
        }
        lines
    }
}

/// Draws the legend's lines from `top` on.
fn draw_legend(area: &Area<'_>, lines: &[Vec<(i32, &Series)>], top: i32) -> Drawn {
    for (index, line) in lines.iter().enumerate() {
        let middle = top + LINE_HEIGHT * index as i32 + LINE_HEIGHT / 2;
        for &(place, series) in line {
            let colour = series.rgb();
            let stroke = colour.stroke_width(STROKE);
            let centre = (place + px(13), middle);
            match series.mark {
                Mark::Line => area.draw(&PathElement::new(
                    vec![(place, middle), (place + px(26), middle)],
                    stroke,
                ))?,
                Mark::Dashed => {
                    for start in [place, place + px(10), place + px(20)] {
                        area.draw(&PathElement::new(
                            vec![(start, middle), (start + px(6), middle)],
                            stroke,
                        ))?;
                    }
                }
                Mark::Circles => area.draw(&Circle::new(centre, px(5), colour.filled()))?,
                Mark::Crosses => area.draw(&Cross::new(centre, px(5), stroke))?,
                Mark::Triangles => {
                    area.draw(&TriangleMarker::new(centre, px(7), colour.filled()))?;
                }
                Mark::ShadedBelow | Mark::ShadedAbove => area.draw(&Rectangle::new(
                    [(place, middle - px(6)), (place + px(26), middle + px(6))],
                    colour.mix(0.4).filled(),
                ))?,
            }
            let style = tick_style().pos(Pos::new(HPos::Left, VPos::Center));
            area.draw(&Text::new(
                series.name.clone(),
                (place + px(34), middle),
                style,
            ))?;
        }
    }
    Ok(())
}

/// Cuts a line where it is interrupted or leaves the axis, so that nothing is drawn outside.
fn pieces(
    points: impl Iterator<Item = Option<(f64, f64)>>,
    range: &Range<f64>,
) -> Vec<Vec<(f64, f64)>> {
    let inside = |y: f64| (range.start..=range.end).contains(&y);
    let mut pieces = vec![Vec::new()];
    let mut last: Option<(f64, f64)> = None;
    for point in points {
        match (last, point) {
            (Some(from), Some(to)) => {
                // Where the segment crosses an edge of the axis, between its ends.
                let mut cuts: Vec<_> = [range.start, range.end]
                    .into_iter()
                    .map(|edge| ((edge - from.1) / (to.1 - from.1), edge))
                    .filter(|(share, _)| *share > 0.0 && *share < 1.0)
                    .collect();
                cuts.sort_by(|one, other| one.0.total_cmp(&other.0));
                for (share, edge) in cuts {
                    push(&mut pieces, (from.0 + share * (to.0 - from.0), edge));
                    // A segment that leaves ends its piece; one that enters began a new one.
                    if inside(from.1) && !inside(to.1) {
                        pieces.push(Vec::new());
                    }
                }
                if inside(to.1) {
                    push(&mut pieces, to);
                } else if !pieces.last().is_some_and(Vec::is_empty) && !inside(from.1) {
                    pieces.push(Vec::new());
                }
            }
            (None, Some(to)) if inside(to.1) => push(&mut pieces, to),
            (_, None) => pieces.push(Vec::new()),
            (None, Some(_)) => {}
        }
        last = point;
    }
    pieces.retain(|piece| piece.len() > 1);
    pieces
}

fn push(pieces: &mut [Vec<(f64, f64)>], point: (f64, f64)) {
    if let Some(piece) = pieces.last_mut() {
        piece.push(point);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_is_cut_at_the_edges_and_at_gaps() {
        let points = [(0.0, 0.0), (1.0, 2.0), (2.0, 0.0), (3.0, 0.5)].map(Some);
        assert_eq!(
            pieces(points.into_iter(), &(0.0..1.0)),
            vec![
                vec![(0.0, 0.0), (0.5, 1.0)],
                vec![(1.5, 1.0), (2.0, 0.0), (3.0, 0.5)]
            ]
        );
        let through = [Some((0.0, -1.0)), Some((3.0, 2.0)), None, Some((4.0, 0.5))];
        assert_eq!(
            pieces(through.into_iter(), &(0.0..1.0)),
            vec![vec![(1.0, 0.0), (2.0, 1.0)]]
        );
    }
}
