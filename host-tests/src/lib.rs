//! The float64 reference of `epas-friction`: the exact models of four papers on ball-screw curvature, efficiency, contact kinematics and
//! friction.
//!
//! It is written from the papers, with their misprints corrected and named, and shares no code with the fast library that is measured
//! against it. Lengths are in m, forces in N, angles in rad unless a function is free of units. A [`ReferenceError`] names an input that is
//! out of range, or the balance that was not found.

#![allow(
    clippy::missing_errors_doc,
    clippy::must_use_candidate,
    clippy::return_self_not_must_use,
    reason = "errors are described once, above; nearly every function here is pure"
)]

pub mod closed_loop;
pub mod coefficient;
pub mod curvature;
pub mod design;
pub mod drag;
pub mod efficiency;
pub mod error;
pub mod friction;
pub mod hertz;
pub mod kinematics;
pub mod material;
pub mod presliding;
#[cfg(feature = "promises")]
pub mod promises;
pub mod statics;
pub mod steady_state;

pub use error::ReferenceError;
