//! What tests of several packages share.
#![allow(
    clippy::missing_panics_doc,
    clippy::missing_errors_doc,
    reason = "a test fails by a panic, and an error is its message"
)]

pub mod designs;
pub mod errors;
pub mod folded;
pub mod gears;
pub mod given;
pub mod golden;
pub mod measured;
pub mod promised;
pub mod random;
pub mod random_scenes;
