//! `eval` of one ball that no other ball presses.

use std::f64::consts::FRAC_PI_4;

use serde_json::{Value, json};

use super::eval::{answered, lacking, number, refused, wrong, wrong_screw};

fn request(clearance: f64, friction: f64, axial_load: &[f64], direction: f64) -> Value {
    json!({
        "id": 1, "model": "caged_torque", "pitch_radius": 0.0165, "lead": 0.02, "ball_radius": 2.778e-3,
        "groove_radius": 3.254e-3, "contact_angle": FRAC_PI_4, "youngs_modulus": 2.08e11, "poisson_ratio": 0.3,
        "friction": friction, "clearance": clearance, "axial_load": axial_load, "direction": direction,
    })
}

/// Two balls of a row, none pressing, under opposite loads in one direction: each by itself, from nothing. Such a row has no law: nothing is folded for it.
fn pair(of: &Value, load: f64) -> Value {
    let mut pair = of.clone();
    let fields = pair.as_object_mut().unwrap();
    let direction = fields.remove("direction").unwrap();
    fields.remove("axial_load");
    let balls = [load, -load]
        .map(|load| json!({ "screw_deviation": 0.0, "nut_deviation": 0.0, "axial_load": load }));
    fields.insert("model".into(), "ball_screw_pair".into());
    fields.insert("nut_speed".into(), json!(3.0 * number(&direction)));
    fields.insert("balls".into(), json!(balls));
    pair
}

fn torques(answer: &Value, side: &str) -> Vec<f64> {
    let list = answer[side]["torque"].as_array();
    list.unwrap_or_else(|| panic!("{answer}"))
        .iter()
        .map(number)
        .collect()
}

/// The reference is the one of rows of balls, whose contact integrals have half as many nodes; the block is within 1 % of it.
#[test]
fn one_ball_is_a_free_ball_of_a_row() {
    let loads = [20.0, 100.0, 300.0];
    let both = loads.map(|load| [load, -load]).concat();
    let mut requests = Vec::new();
    let mut asked = Vec::new();
    for (clearance, friction) in [(0.0, 0.1), (-2e-6, 0.05), (5e-6, 0.15)] {
        for direction in [1.0, -1.0] {
            let one = request(clearance, friction, &both, direction);
            requests.push(one.clone());
            requests.extend(loads.map(|load| pair(&one, load)));
            asked.push(one);
        }
    }
    let answers = answered(&requests);
    for (one, answers) in asked.iter().zip(answers.chunks(1 + loads.len())) {
        let [found, folded] = ["reference", "in_loop"].map(|side| torques(&answers[0], side));
        for (place, pair) in answers[1..].iter().enumerate() {
            let truth = number(&pair["reference"]["groove_torque_free"]);
            assert!(truth > 0.0);
            for (torques, bound) in [(&found, 1e-3), (&folded, 0.01)] {
                let sum = torques[2 * place] + torques[2 * place + 1];
                assert!(
                    (sum / truth - 1.0).abs() < bound,
                    "{one} {place}: {sum} {truth}"
                );
            }
        }
    }
}

/// A screw that turns backward is its own mirror image; no load is no torque but that of the preload; a list wider than the usual loads
/// widens the block.
#[test]
fn directions_and_no_load() {
    let loads = [1_000.0, 0.0, 2.0, -50.0, 50.0];
    let mirrored: Vec<f64> = loads.iter().map(|load| -load).collect();
    let requests = [
        request(0.0, 0.1, &loads, 1.0),
        request(0.0, 0.1, &mirrored, -1.0),
        request(-2e-6, 0.1, &[0.0, 1e-3, -1e-3, 50.0], 1.0),
        // The crate takes no such clearance.
        request(1e-4 * 3.0, 0.1, &[50.0], 1.0),
    ];
    let answers = answered(&requests);
    for side in ["in_loop", "reference"] {
        let forward = torques(&answers[0], side);
        assert_eq!(forward, torques(&answers[1], side));
        assert_eq!(forward[1], 0.0);
        assert!(forward[3] != forward[4] && forward.iter().all(|torque| *torque >= 0.0));
        let preloaded = torques(&answers[2], side);
        assert!(preloaded[0] > 0.0);
        for near in &preloaded[1..3] {
            assert!((preloaded[0] / near - 1.0).abs() < 1e-3, "{preloaded:?}");
        }
    }
    for answer in &answers[..3] {
        let (folded, exact) = (torques(answer, "in_loop"), torques(answer, "reference"));
        for (folded, exact) in folded.iter().zip(&exact) {
            assert!((folded - exact).abs() <= 0.01 * exact, "{answer}");
        }
    }
    assert!(answers[3]["in_loop"]["torque"].is_null());
}

#[test]
fn bad_fields_of_one_ball_are_named() {
    let good = request(0.0, 0.1, &[50.0], 1.0);
    let mut bad = wrong_screw(&good);
    bad.extend(wrong(
        &good,
        [
            ("/friction", json!(5e-4)),
            ("/friction", json!(0.6)),
            ("/axial_load", json!([])),
            ("/axial_load", json!(50.0)),
            ("/axial_load", json!([50.0, null])),
            ("/axial_load", json!([2e5])),
            ("/direction", json!(0)),
            ("/direction", json!("forward")),
            ("/balls", json!(1)),
        ],
    ));
    bad.extend(lacking(&good, &["/clearance", "/axial_load", "/direction"]));
    refused(&bad);
}
