//! The legend above a chart.

use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::series::{Mark, Series};
use super::style::{LINE_HEIGHT, STROKE, TICK_SIZE, lines as pieces, px, text_width};
use super::words::{Area, Drawn, tick_style};

/// An entry of a legend: its place, its series where its sample stands before it, and its words.
pub type Entry<'a> = (i32, Option<&'a Series>, String);

pub type Lines<'a> = Vec<Vec<Entry<'a>>>;

/// Width of the sample before a name.
const SAMPLE: i32 = px(34);

/// The legend's entries, with their places, broken into lines that fit; a name that is longer goes on in the next line.
pub fn lines_of(series: &[Series], width: i32) -> Lines<'_> {
    // Narrow pictures have no room to stand in.
    let start = if width < px(700) { px(12) } else { px(84) };
    let mut lines: Lines<'_> = Vec::new();
    let mut place = i32::MAX;
    for series in series.iter().filter(|series| !series.name.is_empty()) {
        let room = width - start - SAMPLE - px(8);
        for (index, piece) in pieces(&series.name, TICK_SIZE, room)
            .into_iter()
            .enumerate()
        {
            let entry = SAMPLE + text_width(&piece, TICK_SIZE) + px(14);
            if index > 0 || place.saturating_add(entry) > width {
                lines.push(Vec::new());
                place = start;
            }
            if let Some(line) = lines.last_mut() {
                line.push((place, (index == 0).then_some(series), piece));
            }
            place += entry;
        }
    }
    lines
}

/// Draws the legend's lines from `top` on.
pub fn draw(area: &Area<'_>, lines: &Lines<'_>, top: i32) -> Drawn {
    for (index, line) in lines.iter().enumerate() {
        let middle = top + LINE_HEIGHT * index as i32 + LINE_HEIGHT / 2;
        for (place, series, words) in line {
            let place = *place;
            let style = tick_style().pos(Pos::new(HPos::Left, VPos::Center));
            area.draw(&Text::new(words.clone(), (place + SAMPLE, middle), style))?;
            let Some(series) = series else { continue };
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
                Mark::Dots => area.draw(&Circle::new(centre, px(2), colour.filled()))?,
                Mark::ShadedBelow | Mark::ShadedAbove | Mark::Band => {
                    area.draw(&Rectangle::new(
                        [(place, middle - px(6)), (place + px(26), middle + px(6))],
                        colour.mix(0.4).filled(),
                    ))?;
                }
            }
        }
    }
    Ok(())
}
