//! One ball of a caged ball screw: no neighbour presses, see [`HeldBall::along`].

use super::held_ball::{HeldBall, HeldBallFriction};

/// A ball in the grooves of a screw.
pub type CagedBall = HeldBall;

/// How it runs while the nut turns forward, and its friction torque.
pub type CagedBallFriction = HeldBallFriction;
