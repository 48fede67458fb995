//! The ball of a ball screw with contacts that are given, and balls that press on each other.

mod ball;
mod chain;
mod closed_form;
mod contacts;
mod equations;
mod impedance;
mod iteration;
mod motion;

pub use ball::ScrewBall;
pub use chain::ScrewChain;
pub use contacts::ScrewContacts;
pub use iteration::DEFAULT_IMPEDANCE_STEPS;
pub use motion::{ScrewBallMotion, ScrewBallState, ScrewContactMotion};
