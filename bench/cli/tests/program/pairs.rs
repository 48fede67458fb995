//! `eval` of rows of balls with an axial load of each and a clearance: stored pairs, and every way to ask wrongly.

use serde_json::{Value, json};

use super::eval::{answered, golden, lacking, number, refused, relative, wrong, wrong_screw};

/// The request for a stored pair. A stored force has a sign; where it is negative, the balls press in the other order.
fn request(all: &Value, case: &Value) -> Value {
    let design = &all["meta"]["designs"][case["design"].as_str().unwrap()];
    let length = |name: &str| 1e-3 * number(&design[name]);
    let side = if case["pair"] == "SRNL" { -1.0 } else { 1.0 };
    let mut balls: Vec<_> = (0..2)
        .map(|index| {
            let of = |name: &str| number(&case[name][index]);
            json!({
                "screw_deviation": of("screw_deviation_deg").to_radians(),
                "nut_deviation": of("nut_deviation_deg").to_radians(),
                "axial_load": side * of("axial_load_N"),
            })
        })
        .collect();
    if number(&case["ball_force_N"]) < 0.0 {
        balls.reverse();
    }
    json!({
        "id": case["ball_force_N"], "model": "ball_screw_pair", "pitch_radius": length("pitch_radius"),
        "lead": length("pitch"), "ball_radius": length("ball_radius"), "groove_radius": length("groove_radius"),
        "contact_angle": number(&design["contact_angle_deg"]).to_radians(),
        "youngs_modulus": 1e6 * number(&design["E"]), "poisson_ratio": design["nu"],
        "friction": case["friction"], "clearance": 1e-6 * number(&case["clearance_um"]),
        "nut_speed": 3.0, "balls": balls,
    })
}

/// The reference answers as two stored pairs of one screw do, but for the nine digits that they have, in both orders of the balls; the law of the scene
/// has free speeds and torques that are near. (The host tests ask the reference for the pairs of all screws.)
#[test]
fn stored_pairs() {
    let all = golden("ballscrew_exact.json");
    let cases = all["cases"].as_array().unwrap().iter().filter(|case| {
        case["design"] == "lin36"
            && number(&case["friction"]) == 0.1
            && number(&case["clearance_um"]) == 0.0
    });
    let (forward, backward): (Vec<_>, Vec<_>) =
        cases.partition(|case| number(&case["ball_force_N"]) > 0.0);
    let cases = [forward[0], backward[0]];
    let answers = answered(&cases.map(|case| request(&all, case)));
    for ((case, answer), order) in cases.iter().zip(&answers).zip([[0, 1], [1, 0]]) {
        let (reference, in_loop) = (&answer["reference"], &answer["in_loop"]);
        let found = number(&reference["contact_force"][0]);
        let stored = number(&case["ball_force_N"]).abs();
        assert!((found - stored).abs() < 1e-7, "{case}: {answer}");
        for (name, stored) in [
            ("groove_torque", "groove_torque_pressed_Nm"),
            ("groove_torque_free", "groove_torque_free_Nm"),
        ] {
            let sum: f64 = (0..2).map(|i| number(&case[stored][i])).sum();
            assert!(relative(&reference[name], sum) < 2e-8, "{case}: {answer}");
            // No block is written whose rows of balls are not accurate to 3 %.
            assert!(relative(&in_loop[name], sum) < 0.03, "{case}: {answer}");
        }
        assert!(in_loop["loads"].is_null() && in_loop["flagged"].is_boolean());
        for (place, ball) in order.into_iter().enumerate() {
            let stored = number(&case["free_orbital_speed"][ball]);
            let found = number(&reference["free_speed"][place]);
            assert!((found - stored).abs() < 1e-8, "{case}: {answer}");
            let loads = &case[format!("free_loads_ball{}_N", ball + 1)];
            for flank in 0..4 {
                let stored = number(&loads[flank]);
                let found = number(&reference["loads"][place][flank]);
                assert!((found - stored).abs() < 2e-6, "{case}: {answer}");
            }
        }
    }
}

/// Loads of opposite signs in one row, a nut that turns backward, balls that rub, and standstill.
#[test]
fn odd_rows_have_answers() {
    let all = golden("ballscrew_exact.json");
    let mut request = request(&all, &all["cases"][5]);
    request["balls"][1]["axial_load"] = json!(30.0);
    request["nut_speed"] = json!(-3.0);
    request["ball_friction"] = json!(0.1);
    let mut still = request.clone();
    still["nut_speed"] = json!(0.0);
    let answers = answered(&[request, still]);
    let reference = &answers[0]["reference"];
    assert!(number(&reference["contact_force"][0]) >= 0.0);
    // A negative load is carried by SR and NL, a positive one by SL and NR.
    let load = |ball: usize, flank: usize| number(&reference["loads"][ball][flank]);
    assert!(load(0, 1).min(load(0, 2)) > load(0, 0).max(load(0, 3)));
    assert!(load(1, 0).min(load(1, 3)) > load(1, 1).max(load(1, 2)));
    for name in [
        "free_speed",
        "contact_force",
        "groove_torque",
        "groove_torque_free",
        "loads",
    ] {
        assert!(!reference[name].is_null(), "{name}: {answers:?}");
        // Balls of a scene are loaded alike, and nothing rubs at rest.
        for nothing in [
            &answers[0]["in_loop"],
            &answers[1]["in_loop"],
            &answers[1]["reference"],
        ] {
            assert!(nothing[name].is_null(), "{name}: {answers:?}");
        }
    }
}

#[test]
fn bad_fields_of_pairs_are_named() {
    let all = golden("ballscrew_exact.json");
    let mut good = request(&all, &all["cases"][0]);
    // Loads of both signs have no law, which nothing is folded for.
    good["balls"][0]["axial_load"] = json!(-30.0);
    good["balls"][1]["axial_load"] = json!(30.0);
    let mut bad = wrong_screw(&good);
    bad.extend(wrong(
        &good,
        [
            ("/friction", json!(0.0)),
            ("/ball_friction", json!(-0.1)),
            ("/nut_speed", json!(null)),
            ("/balls", json!([good["balls"][0]])),
            ("/balls", json!([])),
            ("/pairs", json!(1)),
            ("/balls/1/screw_deviation", json!(0.3)),
            ("/balls/1/nut_deviation", json!(-0.3)),
            ("/balls/1/axial_load", json!([1.0])),
            ("/balls/1/load", json!(1.0)),
        ],
    ));
    bad.extend(lacking(&good, &["/clearance", "/balls", "/nut_speed"]));
    refused(&bad);
    answered(&[good]);
}
