//! Ball of a ball screw: stored single balls and pairs, Table 3.7, given contacts, and the laws of the model.

use epas_reference::friction::ball_screw_ball::{ElasticGrooves, Groove, ScrewContact, ScrewTrack, motion_from, motion_with_contacts};
use epas_reference::friction::ball_screw_elastic::{BallSlip, ElasticBalls, ScrewSupport};
use epas_reference::friction::contact_law::HertzLaw;
use epas_reference::friction::linear_ball::EllipseLaw;
use serde_json::Value;
use std::f64::consts::{FRAC_PI_4, TAU};

fn golden(name: &str) -> Value {
    let path = format!("{}/golden/{name}.json", env!("CARGO_MANIFEST_DIR"));
    serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap()
}

/// Table 3.6.
const TRACK: ScrewTrack = ScrewTrack { pitch_radius: 16.5e-3, lead: 20e-3, ball_radius: 2.778e-3 };

/// Hertz constants with the right curvatures, as stored for the two groove radii (mm).
fn law(side: &str, groove_radius: &str) -> HertzLaw {
    let all = golden("ballscrew");
    let stored = &all["hertz"][format!("{side}_rG{groove_radius}")]["correct"];
    let value = |key: &str| stored[key].as_f64().unwrap() * 1e-3;
    HertzLaw {
        ellipse: EllipseLaw { semi_major_constant: value("Ca"), axis_ratio: value("Cb") / value("Ca") },
        compliance: value("C"),
    }
}

fn grooves(groove_radius: &str, theta_degrees: f64, oversize: f64) -> ElasticGrooves {
    let theta = theta_degrees.to_radians();
    ElasticGrooves {
        track: TRACK,
        groove_radius: groove_radius.parse::<f64>().unwrap() * 1e-3,
        arc_angles: [FRAC_PI_4 - theta, FRAC_PI_4 + theta, FRAC_PI_4, FRAC_PI_4],
        screw: law("S", groove_radius),
        nut: law("N", groove_radius),
        oversize,
    }
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap()
}

#[test]
fn stored_single_balls() {
    for case in golden("ballscrew")["single_ball"].as_array().unwrap() {
        let radius = case["rG"].as_f64().unwrap().to_string();
        let mu = number(&case["mu"]);
        let load = number(&case["Fax"]) * if case["pair"] == "SRNL" { -1.0 } else { 1.0 };
        let balls = ElasticBalls {
            grooves: vec![grooves(&radius, 0.0, 0.0)],
            friction: mu,
            ball_friction: 0.0,
            nut_speed: TAU,
            ball_slip: BallSlip::Orbiting,
        };
        let motion = balls.solve(ScrewSupport::Load(load)).unwrap();
        println!("{} {radius} {load} {mu}: {} {:?} {} residual {:e}; stored {} {} {}", case["pair"], motion.balls[0].orbital_speed / TAU, motion.positions[0], motion.screw_displacement, motion.residual, case["wB_over_wN"], case["p_um"], case["uz_um"]);
    }
}
