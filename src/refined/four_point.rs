//! A ball in up to four contacts on a straight or circular track, moving with the least loss.

mod ball;
mod chain;
mod contacts;
mod linear;
mod motion;
mod newton;
mod rotary;
mod start;

pub use ball::{FourPointBall, LARGEST_ANGLE_DEVIATION};
pub use chain::BallChain;
pub use contacts::FourPointContacts;
pub use motion::{BallMotion, BallState, ContactMotion};
pub use newton::DEFAULT_NEWTON_STEPS;
pub use rotary::{RotaryBall, RotaryBallParameters, RotaryMotion};
