//! Plots as SVG text: charts of lines, points and areas, and maps of colour bands.
//!
//! No fonts of this machine are needed: text is SVG text in the viewer's sans-serif font. A logarithmic
//! axis is a linear one over the decimal logarithm.

// Counts of pixels, lines and bands are far below the largest i32, which the drawing library counts in.
#![allow(clippy::cast_possible_wrap)]

mod chart;
mod legend;
mod map;
mod notes;
mod panel;
mod scale;
mod series;
mod strip;
mod style;
mod theme;
mod thin;
mod words;
mod zoom;

pub use chart::{Chart, Note};
pub use map::{ColourMap, Colours};
pub use panel::{Panel, narrow, render, render_one};
pub use scale::Axis;
pub use series::{Mark, Series};
pub use strip::Strip;
pub use theme::themed;
pub use thin::{BUCKETS, thin, thin_to};
pub use zoom::zoomable;
