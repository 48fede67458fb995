//! Contact kinematics of a ball screw. [`Revised`]: Alberdi et al., eqs. (12) to (40), as printed but for the corrections that each
//! function names; [`operating`]: contact load, contact angle and ellipse of the paper's screw.
//!
//! Frame: screw turning by `speed` about its axis `Z` without translation; nut translating without rotation; right-hand thread. At the
//! contact with the screw (inner, upper sign in the paper) `x` is the tangent of the ball's path, at the nut (outer, lower sign) its
//! reverse; `y = (0, sin alpha, cos alpha)` in (tangent, normal, binormal); `z` points to the ball's centre. Slip is ball minus raceway.

mod input;
pub mod operating;
mod revised;
mod slip;
mod yaw_angle;

pub use input::{ContactInput, KinematicsInput, Raceway};
pub use revised::Revised;
pub use slip::{BallKinematics, ContactKinematics};
pub use yaw_angle::yaw_without_side_slip;
