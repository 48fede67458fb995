//! The float64 reference against the papers' tables and against independent solutions.

mod answers_reference;
mod ball_screw_efficiency_reference;
mod ball_screw_reference;
mod ball_screw_ring_reference;
mod ball_screw_row_reference;
mod chain_reference;
mod curvature_reference;
mod friction_maps_reference;
mod kinematics_reference;
mod linear_ball_reference;
mod load_shares;
mod presliding_reference;
mod published_records;
mod recorded_runs;
mod rolling_ball;
mod rotary_reference;
mod statics;
mod statics_measured;
mod statics_studies;
mod steady_state;
mod whole_screw_reference;
