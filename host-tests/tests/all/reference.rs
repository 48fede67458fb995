//! The float64 reference against the papers' tables and against independent solutions.

mod answers_reference;
mod area;
mod ball_screw_efficiency_reference;
mod ball_screw_reference;
mod ball_screw_ring_reference;
mod ball_screw_row_reference;
mod brush;
mod chain_reference;
mod curvature_reference;
mod friction_maps_reference;
pub mod kinematics_cases;
pub mod kinematics_reference;
mod linear_ball_reference;
pub mod linear_cases;
mod load_shares;
pub mod presliding_reference;
mod recorded_runs;
mod statics;
mod steady_state;
mod whole_screw_reference;
