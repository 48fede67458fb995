//! Formulas that are called directly, at set-up or beside a step, against their papers and float64.

mod clearance;
pub mod constants;
mod curvature;
mod efficiency;
mod friction_map;
mod geometry;
mod hertz;
mod kinematics;
mod math_sweeps;
mod ranges;
mod rolling;
