//! The exact steady state of a ball in a ball screw: Newton-Euler equations (5), slip velocities (6)-(8) and the equilibrium of screw and
//! nut (9) of Lin, Velinsky, Ravani 1994, solved together.
//!
//! The ball spins about the line of its two main contacts at a rate that grows as one over the speed: the friction couple `2 f r_b Q` is
//! balanced by the gyroscopic moment alone. In the unknowns used here (differences and small loads divided by `eps = I Omega² / (f r_b
//! F0)`, the spin multiplied by it) the equations stay regular down to standstill. The state exists only above a lead angle of some
//! degrees, and is unstable nearly everywhere; it stands here because the closed form (14) is its limit.

mod ball;
mod equilibrium;

pub use ball::BallScrewState;
pub use equilibrium::SteadyState;
