//! Contact kinematics of a ball screw, exact in float64.
//!
//! Two routes to the same slip, one test between them:
//! - [`Revised`]: Alberdi et al., eqs. (12) to (40), as printed but for the corrections that each
//!   function names;
//! - [`RigidBody`]: positions of material points of ball, screw and nut as functions of time,
//!   differentiated by dual numbers, with orbital and spin speed from the condition of rolling.
//!
//! Beside them [`Traditional`], the formulation that the paper revises; [`HertzMean`], quadrature over a
//! contact ellipse, and [`friction_power`]; [`pitch_angle`], the methods of the paper's Table 1;
//! [`operating`], contact load, contact angle and ellipse of the paper's screw; [`figures`], the data
//! of its Figures 6 to 13. Its printed numbers stand in [`crate::published::kinematics`].
//!
//! Frame: screw turning by `speed` about its axis `Z` without translation; nut translating without
//! rotation; right-hand thread. At the contact with the screw (inner, upper sign in the paper) `x`
//! is the tangent of the ball's path, at the nut (outer, lower sign) its reverse;
//! `y = (0, sin alpha, cos alpha)` in (tangent, normal, binormal); `z` points to the ball's centre.
//! Slip is ball minus raceway.

pub mod figures;
mod input;
pub mod operating;
pub mod pitch_angle;
mod power;
mod revised;
mod rigid_body;
mod slip;
mod traditional;
mod yaw_angle;

pub use input::{ContactInput, KinematicsInput, Raceway};
pub use power::{HertzMean, MeanSlip, friction_power, least_friction_power, mean_slip};
pub use revised::Revised;
pub use rigid_body::RigidBody;
pub use slip::{BallKinematics, ContactKinematics};
pub use traditional::Traditional;
pub use yaw_angle::yaw_without_side_slip;
