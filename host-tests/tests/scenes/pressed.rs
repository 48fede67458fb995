//! Screws whose balls press on each other, by a folded law: every tick against exact balls.

mod exact;
mod ticks;
