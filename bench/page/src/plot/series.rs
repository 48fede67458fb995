//! One quantity of a chart: points, lines, shaded areas.

use std::ops::Range;

use plotters::coord::types::RangedCoordf64;
use plotters::prelude::*;

use super::scale::Axis;
use super::style::{PALETTE, STROKE, px};
use super::thin::straightened;
use super::words::Drawn;

/// A chart with its axes, on the way to a picture.
pub type Axes<'a, 'b> =
    ChartContext<'a, SVGBackend<'b>, Cartesian2d<RangedCoordf64, RangedCoordf64>>;

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
    /// Small points, for clouds.
    Dots,
    /// A shaded area without a line: along its upper edge and back along the lower one.
    Band,
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

    /// Its colour.
    pub fn rgb(&self) -> RGBColor {
        PALETTE[self.colour % PALETTE.len()]
    }

    /// Whether points are joined.
    pub const fn is_line(&self) -> bool {
        matches!(
            self.mark,
            Mark::Line | Mark::Dashed | Mark::ShadedBelow | Mark::ShadedAbove
        )
    }

    /// Draws it between axes with these ends.
    pub fn draw(
        &self,
        context: &mut Axes<'_, '_>,
        (axis_x, axis_y): (&Axis, &Axis),
        (x, y): (&Range<f64>, &Range<f64>),
    ) -> Drawn {
        let colour = self.rgb();
        let line = colour.stroke_width(STROKE);
        let places = || {
            self.points
                .iter()
                .map(|&(at_x, at_y)| Some((axis_x.place(at_x)?, axis_y.place(at_y)?)))
        };
        // A tenth of a pixel of a common picture.
        let tolerance = (y.end - y.start).abs() / 4000.0;
        let visible = || {
            places().flatten().filter(|(at_x, at_y)| {
                (x.start..=x.end).contains(at_x) && (y.start..=y.end).contains(at_y)
            })
        };
        match self.mark {
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
            Mark::Dots => {
                context.draw_series(
                    visible().map(|point| Circle::new(point, px(2), colour.mix(0.5).filled())),
                )?;
            }
            Mark::Band => {
                let inside = |(at_x, at_y): (f64, f64)| {
                    (at_x.clamp(x.start, x.end), at_y.clamp(y.start, y.end))
                };
                let edges: Vec<_> = places().flatten().map(inside).collect();
                let (upper, lower) = edges.split_at(edges.len() / 2);
                let back: Vec<_> = lower.iter().rev().copied().collect();
                let mut edges = straightened(upper, tolerance);
                edges.extend(straightened(&back, tolerance).into_iter().rev());
                context.draw_series([Polygon::new(edges, colour.mix(0.3).filled())])?;
            }
            Mark::Line | Mark::Dashed | Mark::ShadedBelow | Mark::ShadedAbove => {
                for piece in pieces(places(), y) {
                    self.draw_piece(context, straightened(&piece, tolerance), y)?;
                }
            }
        }
        Ok(())
    }

    /// Draws a line without gaps, and what is shaded beside it.
    fn draw_piece(
        &self,
        context: &mut Axes<'_, '_>,
        piece: Vec<(f64, f64)>,
        y: &Range<f64>,
    ) -> Drawn {
        let colour = self.rgb();
        let line = colour.stroke_width(STROKE);
        let base = match self.mark {
            Mark::ShadedBelow => Some(y.start),
            Mark::ShadedAbove => Some(y.end),
            _ => None,
        };
        if let Some(base) = base {
            context.draw_series(AreaSeries::new(piece.clone(), base, colour.mix(0.22)))?;
        }
        if self.mark == Mark::Dashed {
            let (on, off) = (px(7).unsigned_abs(), px(5).unsigned_abs());
            context.draw_series(DashedLineSeries::new(piece, on, off, line))?;
        } else {
            context.draw_series(LineSeries::new(piece, line))?;
        }
        Ok(())
    }
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
