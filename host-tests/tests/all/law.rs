//! Friction as a law of motion: elements that remember, and the turn that they follow.

mod elements;
mod golden;
mod motion;
mod passive;
mod seat;
