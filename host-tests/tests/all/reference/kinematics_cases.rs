//! Inputs of contact kinematics: the stored cases, and random ones.

use std::f64::consts::PI;

use epas_reference::kinematics::{KinematicsInput, Raceway};
use serde_json::Value;

use epas_testkit::random::Random;

const DEGREE: f64 = PI / 180.0;

pub fn cases() -> Vec<Value> {
    epas_testkit::golden::cases("kinematics", "cases")
}

pub fn number(value: &Value, path: &[&str]) -> f64 {
    path.iter()
        .fold(value, |value, key| &value[key])
        .as_f64()
        .unwrap()
}

/// Lengths stay in millimetres: the model is homogeneous in length, and every number of the case is the one that it was computed from.
pub fn input(case: &Value) -> KinematicsInput {
    input_in(case, 1.0)
}

/// Lengths are millimetres times `unit`.
pub fn input_in(case: &Value, unit: f64) -> KinematicsInput {
    let length = |group, key| unit * number(case, &[group, key]);
    let angle = |key| number(case, &["state", key]);
    KinematicsInput {
        ball_diameter: length("geom", "D"),
        pitch_radius: length("geom", "r_m"),
        lead_angle: number(case, &["geom", "psi"]),
        groove_radius_screw: length("geom", "r_i"),
        groove_radius_nut: length("geom", "r_o"),
        contact_angle_screw: angle("alpha_i"),
        contact_angle_nut: angle("alpha_o"),
        pitch_angle: angle("beta"),
        yaw_angle: angle("betap"),
        rolling_radius_screw: length("state", "rp_i"),
        rolling_radius_nut: length("state", "rp_o"),
        speed: angle("omega"),
        semi_major_screw: length("inner", "a"),
        semi_minor_screw: length("inner", "b"),
        semi_major_nut: length("outer", "a"),
        semi_minor_nut: length("outer", "b"),
    }
}

pub const fn side_of(raceway: Raceway) -> &'static str {
    match raceway {
        Raceway::Screw => "inner",
        Raceway::Nut => "outer",
    }
}

/// The domain that the documentation of the crate's `ContactKinematics` states.
pub fn random_input(random: &mut Random) -> KinematicsInput {
    let pitch_radius = random.between(2e-3, 80e-3);
    let ball_diameter = 2.0 * pitch_radius * random.between(0.04, 0.29);
    let half = 0.5 * ball_diameter;
    let contact_angle = random.between(10.0, 80.0) * DEGREE;
    let [major_screw, major_nut] = [(); 2].map(|()| half * random.between(0.005, 0.3 - 1e-6));
    // One in eight each: no lead; the customary axis and radii.
    let special = random.between(0.0, 8.0);
    let mut input = KinematicsInput {
        ball_diameter,
        pitch_radius,
        lead_angle: random.between(0.0, 40.0) * DEGREE,
        groove_radius_screw: ball_diameter * random.between(0.505, 0.58),
        groove_radius_nut: ball_diameter * random.between(0.505, 0.58),
        contact_angle_screw: contact_angle,
        contact_angle_nut: contact_angle + random.between(-0.1, 0.1),
        pitch_angle: contact_angle + random.between(-0.17, 0.17),
        yaw_angle: random.between(-0.1, 0.1),
        rolling_radius_screw: half * random.between(0.99, 1.01),
        rolling_radius_nut: half * random.between(0.99, 1.01),
        speed: random.between(-1000.0, 1000.0),
        semi_major_screw: major_screw,
        semi_minor_screw: major_screw * random.between(0.05, 0.3),
        semi_major_nut: major_nut,
        semi_minor_nut: major_nut * random.between(0.05, 0.3),
    };
    if special < 1.0 {
        input.lead_angle = 0.0;
    } else if special < 2.0 {
        input.yaw_angle = 0.0;
        input.rolling_radius_screw = half;
        input.rolling_radius_nut = half;
    }
    input
}
