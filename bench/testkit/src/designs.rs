//! Designs that many tests share.

use std::f32::consts::FRAC_PI_4;

use epas_friction::{
    BallScrew, BallScrewParameters, GrooveSize, LinearBearingParameters, Material,
};
use epas_reference::friction::ball_screw_ball::ScrewTrack;

/// The ball screw of Lin 2019, Tables 2.1 and 3.6 (m); two turns hold 37 balls.
pub const SCREW_TRACK: ScrewTrack = ScrewTrack {
    pitch_radius: 16.5e-3,
    lead: 20e-3,
    ball_radius: 2.778e-3,
};

/// The same screw with the groove radius of Table 2.1.
pub fn screw() -> BallScrew {
    BallScrew::new(BallScrewParameters {
        pitch_radius: SCREW_TRACK.pitch_radius as f32,
        lead: SCREW_TRACK.lead as f32,
        ball_radius: SCREW_TRACK.ball_radius as f32,
        screw_groove: GrooveSize::Radius(SCREW_GROOVE_RADIUS as f32),
        nut_groove: GrooveSize::Radius(SCREW_GROOVE_RADIUS as f32),
        contact_angle: FRAC_PI_4,
        ball_material: Material::STEEL,
        groove_material: Material::STEEL,
    })
    .unwrap()
}

/// Radius of its grooves, m.
pub const SCREW_GROOVE_RADIUS: f64 = 3.254e-3;

/// The linear bearing of Lin 2019, Table 3.3 (m).
pub const LINEAR_BEARING: LinearBearingParameters = LinearBearingParameters {
    ball_radius: 5e-3,
    groove: GrooveSize::Conformity(0.56),
    contact_angle: FRAC_PI_4,
    ball_material: Material::STEEL,
    groove_material: Material::STEEL,
};

/// Ball screws from small to large: nominal diameter, lead and ball diameter, mm; conformity of both grooves.
pub const SIZES: [(f64, f64, f64, f64); 10] = [
    (16.0, 5.0, 3.175, 0.53),
    (20.0, 10.0, 3.969, 0.55),
    (25.0, 10.0, 3.969, 0.54),
    (29.0, 7.0, 4.0, 0.54),
    (33.0, 20.0, 5.556, 0.5857),
    (33.0, 20.0, 5.556, 0.56),
    (32.0, 10.0, 6.35, 0.52),
    (40.0, 10.0, 6.35, 0.53),
    (50.0, 20.0, 9.525, 0.54),
    (63.0, 20.0, 9.525, 0.52),
];
