//! Contact kinematics of Alberdi et al. beside its reference ([`epas_reference::kinematics`]): what the paper compares its revised
//! formulas with, and the data of its figures.
//!
//! - [`RigidBody`]: positions of material points of ball, screw and nut as functions of time, differentiated by dual numbers, with
//!   orbital and spin speed from the condition of rolling: a second route to the same slip;
//! - [`Traditional`], the formulation that the paper revises;
//! - [`HertzMean`], quadrature over a contact ellipse, and [`mean_slip`];
//! - [`pitch_angle`], the methods of the paper's Table 1;
//! - [`figures`], the data of its Figures 6 to 13. Its printed numbers are in [`crate::published::kinematics`].

pub mod figures;
pub mod pitch_angle;
mod power;
mod rigid_body;
mod traditional;

pub use power::{HertzMean, MeanSlip, mean_slip};
pub use rigid_body::RigidBody;
pub use traditional::Traditional;
