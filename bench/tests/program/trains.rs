//! `eval` of trains of balls: golden cases, and every way to ask wrongly.

use std::f64::consts::FRAC_PI_4;

use epas_reference::friction::linear_ball::contact_forces;
use epas_reference::hertz::{Hertz, contact_modulus};
use serde_json::{Value, json};

use super::eval::{ask, golden, number};

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(number).collect()
}

/// Largest difference of two lists of the same length.
fn difference(found: &Value, truth: &[f64]) -> f64 {
    let found = numbers(found);
    assert_eq!(found.len(), truth.len());
    let differences = found.iter().zip(truth).map(|(a, b)| (a - b).abs());
    differences.fold(0.0, f64::max)
}

/// A row of balls that the dissertation's study of Section 3.3.4 is made of: 100 N on each, contact
/// angles that deviate from 45 degrees, one side-force ratio for each ball.
fn linear_row(deviations: &[f64], side_force_ratios: &[f64], ball_friction: f64) -> Value {
    const POISSON_RATIO: f64 = 0.28;
    let deviations: [f64; 4] = deviations.try_into().unwrap();
    let angles = deviations.map(|deviation| FRAC_PI_4 + deviation);
    // The stored cases round Psi = a/(R_B F)^(1/3) to 5.307e-4: with E'/E the cube of what that changes
    // they are met to their last digit.
    let (radius, conformity, printed) = (0.005_f64, 0.56, 5.307e-4);
    let steel = (210e9, POISSON_RATIO);
    let groove = 2.0 * conformity / (2.0 * conformity - 1.0) * radius;
    let exact = Hertz::new(radius, groove, contact_modulus(steel, steel)).unwrap();
    let psi = exact.semi_major / radius.cbrt();
    let balls: Vec<_> = side_force_ratios
        .iter()
        .map(|ratio| {
            let forces = contact_forces(angles, 100.0 * ratio, 100.0).map(|force| force.max(0.0));
            json!({"contact_angles": angles, "contact_forces": forces})
        })
        .collect();
    json!({
        "id": side_force_ratios, "model": "linear_train", "ball_radius": radius,
        "conformity": conformity, "nominal_contact_angle": FRAC_PI_4,
        "youngs_modulus": steel.0 * (psi / printed).powi(3), "poisson_ratio": POISSON_RATIO,
        "friction": 0.1, "ball_friction": ball_friction, "speed": 0.01, "balls": balls,
    })
}

struct LinearCase {
    request: Value,
    deviations: Vec<f64>,
    forces: Vec<f64>,
    /// Published formula; none for what the golden cases do not hold.
    formula: Option<Vec<f64>>,
    near_two_point: bool,
}

fn linear_cases() -> Vec<LinearCase> {
    let cases = golden("friction.json");
    let turned = |case: &Value| {
        let turn = number(&case["theta_deg"]).to_radians();
        [-turn, turn, 0.0, 0.0]
    };
    let mut all = Vec::new();
    for case in cases["single"].as_array().unwrap() {
        all.push(LinearCase {
            request: linear_row(&turned(case), &[number(&case["rho"])], 0.1),
            deviations: vec![number(&case["eps"])],
            forces: vec![],
            formula: None,
            near_two_point: case["near_two_point"] == true,
        });
    }
    for case in cases["pair"].as_array().unwrap() {
        let ratio = number(&case["rho"]);
        for (friction, name) in [(0.0, "mu0"), (0.1, "mu0.1")] {
            all.push(LinearCase {
                request: linear_row(&turned(case), &[ratio, -ratio], friction),
                deviations: numbers(&case[format!("eps_{name}")]),
                forces: vec![number(&case[format!("F_{name}")])],
                formula: Some(vec![number(&case["F_analytic"])]),
                near_two_point: case["near_two_point"] == true,
            });
        }
    }
    for case in cases["chain"].as_array().unwrap() {
        for (friction, name) in [(0.0, "mu0"), (0.1, "mu0.1")] {
            all.push(LinearCase {
                request: linear_row(&numbers(&case["dbeta"]), &numbers(&case["rho"]), friction),
                deviations: numbers(&case[format!("eps_{name}")]),
                forces: numbers(&case[format!("F_{name}")]),
                formula: Some(numbers(&case["F_analytic"])),
                near_two_point: false,
            });
        }
    }
    all
}

/// Bounds of the refined variant: 5e-4 of half the track speed and 0.1 N as far as the ball is in
/// four-point contact. Stored where a contact sticks, values rest on a smoothing that is good to 2e-4 N.
#[test]
fn linear_trains_are_those_of_the_golden_cases() {
    let cases = linear_cases();
    let requests: Vec<_> = cases.iter().map(|case| case.request.to_string()).collect();
    let (code, answers) = ask(&requests);
    assert_eq!((code, answers.len()), (0, cases.len()));
    // Reference, refined up to two-point rolling, refined beyond, formula: speed and force.
    let mut worst = [[0.0_f64; 2]; 4];
    for (case, answer) in cases.iter().zip(&answers) {
        let errors = |row: &Value| {
            [
                difference(&row["speed_deviation"], &case.deviations),
                difference(&row["contact_force"], &case.forces),
            ]
        };
        let reference = errors(&answer["reference"]);
        let refined = errors(&answer["in_loop"]["refined"]);
        let formula = case.formula.as_ref().map_or(0.0, |forces| {
            difference(&answer["in_loop"]["analytic"]["contact_force"], forces)
        });
        let (reference_bound, bound, kind) = if case.near_two_point {
            ([1e-6, 2e-4], [3e-3, 0.3], 2)
        } else {
            ([1e-9, 1e-7], [5e-4, 0.1], 1)
        };
        for index in 0..2 {
            worst[0][index] = worst[0][index].max(reference[index]);
            worst[kind][index] = worst[kind][index].max(refined[index]);
            assert!(
                reference[index] <= reference_bound[index] && refined[index] <= bound[index],
                "reference {reference:?}, refined {refined:?}: {} {answer}",
                case.request
            );
        }
        worst[3][1] = worst[3][1].max(formula);
        // The stored formula takes the mean of the F^(2/3) of a diagonal, the crate that of the mean load, as
        // the printed one does: they differ where friction turns the bottom's loads away from the top's.
        let largest = numbers(&answer["in_loop"]["analytic"]["contact_force"]);
        let largest = largest.into_iter().fold(0.0, f64::max);
        worst[3][0] = worst[3][0].max(formula / largest.max(1e-3));
        assert!(
            formula <= if case.near_two_point { 1e-2 } else { 2e-3 } * largest,
            "formula {formula}: {} {answer}",
            case.request
        );
        assert!(number(&answer["reference"]["power_loss"]) > 0.0);
    }
    println!(
        "{} cases; speed (v/2), force (N): reference, refined, near two points, formula {worst:?}",
        cases.len()
    );
}
