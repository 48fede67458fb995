//! The ball of a ball screw with contacts that are given, and balls that press on each other.

mod chain;
mod given;
mod iteration;

pub use chain::ScrewChain;
pub use given::{
    CONTACT_ANGLE_RANGE, ScrewBall, ScrewBallMotion, ScrewBallState, ScrewContactMotion,
    ScrewContacts,
};
pub use iteration::DEFAULT_IMPEDANCE_STEPS;
