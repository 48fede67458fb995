//! The ball of a ball screw: a third contact, slip across the track, and what follows from them.

mod across;
mod chain;
mod given;
mod refined;
mod row;
mod slip_map;

pub use chain::ScrewChain;
pub use given::{
    CONTACT_ANGLE_RANGE, ScrewBall, ScrewBallMotion, ScrewBallState, ScrewContactMotion,
    ScrewContacts,
};
pub use refined::DEFAULT_IMPEDANCE_STEPS;
pub(crate) use row::LoopSums;
pub(crate) use row::largest_deviation;
pub use row::{GrooveFit, LoadShare, ScrewBallLoop, ScrewRow, ScrewTick};
pub use slip_map::{SlipFriction, SlipMap};
