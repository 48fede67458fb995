//! Contact kinematics of Alberdi et al. beside its reference ([`epas_reference::kinematics`]): what the paper compares its revised
//! formulas with, and the data of its figures.
//!
//! - [`Traditional`], the formulation that the paper revises;
//! - [`pitch_angle`], the methods of the paper's Table 1;
//! - [`figures`], the data of its Figures 6 to 13. Its printed numbers are in [`crate::published::kinematics`].

pub mod figures;
pub mod pitch_angle;
mod traditional;

pub use traditional::Traditional;
