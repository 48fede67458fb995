//! What holds when: one bar for each state, coloured while it holds, over the same time axis as charts.

use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::scale::Axis;
use super::style::{PALETTE, px};
use super::words::{Area, Drawn, tick_style};

/// States over a horizontal axis.
#[derive(Clone, Debug)]
pub struct Strip {
    /// Horizontal axis, with its ends.
    pub x: Axis,
    /// Names of the states.
    pub states: Vec<String>,
    /// Stretches in which a state holds: its index, start and end.
    pub stretches: Vec<(usize, f64, f64)>,
}

/// Height of a bar with its gap.
const BAR: i32 = px(22);

impl Strip {
    /// Its height, pixels.
    pub const fn height(&self) -> u32 {
        (self.states.len() as u32) * 22 + 16
    }

    /// Draws the strip: the name of each state at the left, where numbers of a chart stand.
    pub fn draw(&self, area: &Area<'_>) -> Drawn {
        let width = area.dim_in_pixel().0 as i32;
        // The edges of a chart with its label beside the axis.
        let (start, end) = (px(90), width - px(22));
        let range = self.x.range(std::iter::empty());
        let place = |x: f64| {
            let share = ((x - range.start) / (range.end - range.start)).clamp(0.0, 1.0);
            start + (share * f64::from(end - start)) as i32
        };
        let grey = RGBColor(222, 222, 222);
        for (index, name) in self.states.iter().enumerate() {
            let top = px(8) + BAR * index as i32;
            let middle = top + BAR / 2;
            let style = tick_style().pos(Pos::new(HPos::Right, VPos::Center));
            area.draw(&Text::new(name.clone(), (start - px(8), middle), style))?;
            area.draw(&PathElement::new(
                vec![(start, middle), (end, middle)],
                grey.stroke_width(px(1).unsigned_abs()),
            ))?;
        }
        for &(state, from, to) in &self.stretches {
            let top = px(8) + BAR * state as i32;
            let colour = PALETTE[state % PALETTE.len()];
            // A stretch of one sample still shows.
            let (left, right) = (place(from), place(to));
            area.draw(&Rectangle::new(
                [
                    (left, top + px(3)),
                    (right.max(left + px(1)), top + BAR - px(3)),
                ],
                colour.filled(),
            ))?;
        }
        Ok(())
    }
}
