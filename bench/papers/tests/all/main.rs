//! The papers' printed numbers, figures and studies against the exact models, first principles and stored cases.

mod kinematics;
#[path = "../../../../host-tests/tests/all/reference/kinematics_cases.rs"]
mod kinematics_cases;
mod load_studies;
mod measured_figures;
mod program;
mod published;
mod rolling_ball;
mod rotary_ball;
mod rotary_bearing;
mod whole_screw_figures;
