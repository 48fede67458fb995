//! What the tests share.
#![allow(dead_code, reason = "each program of tests takes what it needs")]

pub mod absurd;
pub mod designs;
pub mod errors;
pub mod exact_ball;
pub mod exact_friction;
pub mod gears;
pub mod given;
pub mod golden;
pub mod measured;
pub mod objects;
pub mod promised;
pub mod random;
pub mod recorded;
pub mod remembering;
