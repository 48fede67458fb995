//! Friction as a law of motion: elements that remember, and the turn that they follow.

#[path = "../kit/mod.rs"]
mod kit;

mod elements;
mod golden;
mod motion;
mod passive;
mod seat;
mod transcription;
