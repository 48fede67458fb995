//! The papers' printed numbers, figures and studies against the exact models, first principles and stored cases.

mod kinematics;
#[path = "../../../host-tests/tests/all/reference/kinematics_cases.rs"]
#[allow(dead_code, reason = "the reference's own tests use more of it")]
mod kinematics_cases;
mod load_studies;
mod measured_figures;
mod published;
mod rigid_body;
mod rolling_ball;
mod rotary_ball;
mod rotary_bearing;
mod stability;
mod whole_screw_figures;
