//! Screws without cage: every tick against exact balls, and what holds of any tick.

mod blocks;
mod course;
pub mod exact;
mod laws;
mod running;
mod setting;
mod sharing;
mod ticks;
