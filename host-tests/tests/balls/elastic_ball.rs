//! The ball in elastic grooves, renewed step by step, against equilibrium with exact contact integrals.

use epas_friction::ball::elastic::{BallInputs, ElasticGrooves, Settled};
use epas_friction::{BallScrew, BallScrewParameters, GrooveSize, Material};
use epas_reference::design::BallScrewDesign;
use epas_reference::friction::ball_screw_row::{ElasticRow, RowBall};
use epas_reference::friction::patch::Integration;
use epas_reference::material::Elastic;
use serde_json::Value;
use std::f64::consts::TAU;

fn crate_design(d: &BallScrewDesign) -> BallScrew {
    let steel = Material {
        youngs_modulus: 210e9,
        poisson_ratio: 0.28,
        ..Material::STEEL
    };
    BallScrew::new(BallScrewParameters {
        pitch_radius: d.pitch_radius as f32,
        lead: d.lead as f32,
        ball_radius: d.ball_radius as f32,
        screw_groove: GrooveSize::Radius(d.screw_groove_radius as f32),
        nut_groove: GrooveSize::Radius(d.nut_groove_radius as f32),
        contact_angle: d.contact_angle as f32,
        ball_material: steel,
        groove_material: steel,
    })
    .unwrap()
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap()
}

#[test]
fn scratch() {
    let all: Value =
        serde_json::from_str(include_str!("../../golden/ballscrew_exact.json")).unwrap();
    for case in all["cases"].as_array().unwrap() {
        let stored = &all["meta"]["designs"][case["design"].as_str().unwrap()];
        let length = |key: &str| number(&stored[key]) * 1e-3;
        let steel = Elastic {
            youngs_modulus: number(&stored["E"]) * 1e6,
            poisson_ratio: number(&stored["nu"]),
        };
        let design = BallScrewDesign {
            pitch_radius: length("pitch_radius"),
            lead: length("pitch"),
            ball_radius: length("ball_radius"),
            screw_groove_radius: length("groove_radius"),
            nut_groove_radius: length("groove_radius"),
            contact_angle: number(&stored["contact_angle_deg"]).to_radians(),
            ball: steel,
            groove: steel,
        };
        let side = if case["pair"] == "SRNL" { -1.0 } else { 1.0 };
        let of = |key: &str, i: usize| number(&case[key][i]);
        let grooves = ElasticGrooves::new(&crate_design(&design)).unwrap();
        let path = design.pitch_radius / (design.lead / TAU / design.pitch_radius).atan().cos();
        for i in 0..2 {
            let inputs = BallInputs {
                axial_load: (side * of("axial_load_N", i)) as f32,
                force: 0.0,
                rubbing: [0.0; 2],
                screw_deviation: of("screw_deviation_deg", i).to_radians() as f32,
                nut_deviation: of("nut_deviation_deg", i).to_radians() as f32,
                friction: number(&case["friction"]) as f32,
                clearance: (number(&case["clearance_um"]) * 1e-6) as f32,
            };
            let exact_speed = of("free_orbital_speed", i);
            let y = of("free_compliance_per_N", i);
            let key = format!("free_loads_ball{}_N", i + 1);
            let loads: Vec<f64> = case[&key].as_array().unwrap().iter().map(number).collect();
            let nominal = BallInputs {
                screw_deviation: 0.0,
                nut_deviation: 0.0,
                ..inputs
            };
            let mut state = grooves.start(&nominal);
            for _ in 0..40 {
                let _ = grooves.renew(&mut state, &nominal);
            }
            let mut errors = vec![];
            let mut last = None;
            for _ in 0..40 {
                let r = grooves.renew(&mut state, &inputs);
                errors.push((f64::from(r.speed) / path / exact_speed - 1.0).abs());
                last = Some(r);
            }
            let r = last.unwrap();
            let push = number(&case["ball_force_N"]) * if i == 0 { -1.0 } else { 1.0 };
            let forced = BallInputs {
                force: push as f32,
                ..inputs
            };
            let mut pressed = state;
            let mut p = r;
            for _ in 0..20 {
                p = grooves.renew(&mut pressed, &forced);
            }
            let exact_pressed = number(&case["pressed_orbital_speed"]);
            println!(
                "pressed {} vs exact {} free {}; F {push} linear {}",
                f64::from(p.speed) / path,
                exact_pressed,
                exact_speed,
                exact_speed + push * of("free_compliance_per_N", i)
            );
            let count = errors.iter().rposition(|e| *e > 1e-5).map_or(0, |p| p + 1);
            println!(
                "{} {} mu {} g {} L {} dev {:.2} {:.2} -> n {count} err5 {:.1e} err10 {:.1e} end {:.1e} torque {:.1e} Y {:.4e} {:.4e} carried {:.5} loads {:?} {:?}",
                case["design"],
                case["pair"],
                case["friction"],
                case["clearance_um"],
                of("axial_load_N", i),
                of("screw_deviation_deg", i),
                of("nut_deviation_deg", i),
                errors[5],
                errors[10],
                errors[39],
                f64::from(r.torque) / of("groove_torque_free_Nm", i) - 1.0,
                r.compliance,
                y,
                r.carried,
                r.loads,
                loads
                    .iter()
                    .map(|l| (l * 100.0).round() / 100.0)
                    .collect::<Vec<_>>()
            );
        }
    }
}
