//! `eval` of trains of balls: golden cases, and every way to ask wrongly.

use std::f64::consts::FRAC_PI_4;

use epas_friction::ball::{GrooveFit, RowContacts, ScrewRow};
use epas_friction::{BallScrew, BallScrewParameters, GrooveSize, LoadShare, Material};
use epas_reference::friction::linear_ball::contact_forces;
use epas_reference::hertz::{Hertz, contact_modulus};
use serde_json::{Value, json};

use super::eval::{answered, ask, golden, lacking, number, refused, relative, wrong};

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(number).collect()
}

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

/// The golden row of most balls, with friction between balls and without: deviations and forces of the reference, and forces of the published formula.
/// (The host tests hold the reference to all golden rows.)
#[test]
fn linear_trains_answer_a_golden_case() {
    let cases = golden("friction.json");
    let cases = cases["chain"].as_array().unwrap().iter();
    let case = cases
        .max_by_key(|case| numbers(&case["rho"]).len())
        .unwrap();
    let kinds = [(0.0, "mu0"), (0.1, "mu0.1")];
    let requests = kinds.map(|(friction, _)| {
        linear_row(&numbers(&case["dbeta"]), &numbers(&case["rho"]), friction)
    });
    let formula = numbers(&case["F_analytic"]);
    let largest = formula.iter().copied().fold(0.0, f64::max);
    for ((_, name), answer) in kinds.iter().zip(&answered(&requests)) {
        let row = &answer["reference"];
        let speeds = difference(
            &row["speed_deviation"],
            &numbers(&case[format!("eps_{name}")]),
        );
        let forces = difference(&row["contact_force"], &numbers(&case[format!("F_{name}")]));
        assert!(
            speeds <= 1e-9 && forces <= 1e-7,
            "{speeds} {forces}: {answer}"
        );
        // The stored formula takes the mean of the F^(2/3) of a diagonal, the crate that of the mean load, as the printed one does: they differ where
        // friction turns the bottom's loads away from the top's.
        let analytic = &answer["in_loop"]["analytic"]["contact_force"];
        assert!(difference(analytic, &formula) <= 2e-3 * largest, "{answer}");
        // Forces of the closed form are in proportion to its slope: 1.442 exactly, 1.38 as printed, at conformity 0.56.
        let scene = numbers(&answer["in_loop"]["scene"]["contact_force"]);
        for (scene, analytic) in scene.iter().zip(numbers(analytic)) {
            let apart = (scene * 1.38 - analytic * 1.442).abs();
            assert!(apart <= 5e-4 * analytic.max(1e-3), "{scene} {analytic}");
        }
        assert!(number(&row["power_loss"]) > 0.0);
    }
}

/// The screw of Lin 2019, Table 2.1, in m; the stored cases have E = 210 GPa and nu = 0.28.
fn screw_row(groove_radius: f64, friction: f64, nut_speed: f64, balls: &[Value]) -> Value {
    json!({
        "id": groove_radius, "model": "ball_screw_train", "pitch_radius": 16.5e-3, "lead": 20e-3,
        "ball_radius": 2.778e-3, "groove_radius": groove_radius, "youngs_modulus": 210e9,
        "poisson_ratio": 0.28, "friction": friction, "nut_speed": nut_speed, "balls": balls,
    })
}

/// A ball whose contacts are given by name, each as load and angle.
fn ball_of(contacts: impl IntoIterator<Item = (String, f64, f64)>) -> Value {
    let contacts: serde_json::Map<_, _> = contacts
        .into_iter()
        .map(|(name, load, angle)| (name, json!({"load": load, "contact_angle": angle})))
        .collect();
    json!({"contacts": contacts})
}

fn ball_of_arrays(contacts: &Value) -> Value {
    let contacts = contacts.as_object().unwrap().iter();
    ball_of(contacts.map(|(name, pair)| (name.clone(), number(&pair[0]), number(&pair[1]))))
}

/// A ball of a case whose contacts hold load and angle (degrees) by name.
fn ball_of_degrees(case: &Value) -> Value {
    let contacts = case["contacts"].as_object().unwrap().iter();
    ball_of(contacts.map(|(name, contact)| {
        let angle = number(&contact["angle"]).to_radians();
        (name.clone(), number(&contact["N"]), angle)
    }))
}

/// Orbital speeds of the stored balls, over the nut's.
fn stored_speeds(case: &Value) -> Vec<f64> {
    let names: &[&str] = if case["wB1"].is_null() {
        &["wB_over_wN"]
    } else {
        &["wB1", "wB2"]
    };
    names.iter().map(|name| number(&case[name])).collect()
}

/// Stored pairs and single balls: the reference has their speeds within 1e-5 of the nut's. What the closed form finds on them in elastic grooves
/// without play, whose contacts it finds itself from axial load and deviations, is bounded by what was measured against the reference: 1.7 % of the
/// force, 3.0e-3 of the nut's speed and 5.1 % of the power. Four contacts have a preload that nothing tells.
#[test]
fn regression_closed_form_finds_the_contacts() {
    let stored = golden("ballscrew.json");
    let [pairs, singles] =
        ["impedance", "single_ball"].map(|name| stored[name].as_array().unwrap());
    let of_pair = |case: &Value| {
        let balls = ["contacts1", "contacts2"].map(|name| ball_of_arrays(&case[name]));
        screw_row(3.254e-3, 0.1, 5.0, &balls)
    };
    let of_single = |case: &Value| {
        let (groove, friction) = (1e-3 * number(&case["rG"]), number(&case["mu"]));
        screw_row(groove, friction, 5.0, &[ball_of_degrees(case)])
    };
    let requests: Vec<_> = pairs
        .iter()
        .map(of_pair)
        .chain(singles.iter().map(of_single))
        .collect();
    let answers = answered(&requests);
    let mut compared = 0;
    let cases = pairs.iter().chain(singles);
    for ((case, request), answer) in cases.zip(&requests).zip(&answers) {
        let (closed, exact) = (&answer["in_loop"], &answer["reference"]);
        let speeds: Vec<f64> = stored_speeds(case)
            .iter()
            .map(|ratio| 5.0 * ratio)
            .collect();
        assert!(
            difference(&exact["orbital_speed"], &speeds) <= 5e-5,
            "{case}: {answer}"
        );
        let four = request["balls"][0]["contacts"].as_object().unwrap().len() == 4;
        for name in [
            "orbital_speed",
            "contact_force",
            "power_loss",
            "load_mismatch",
        ] {
            assert_eq!(closed[name].is_null(), four, "{request}: {answer}");
        }
        if four {
            continue;
        }
        compared += 1;
        let largest = numbers(&exact["contact_force"])
            .into_iter()
            .fold(1e-9, f64::max);
        let found = [
            difference(&closed["contact_force"], &numbers(&exact["contact_force"])) / largest,
            difference(&closed["orbital_speed"], &numbers(&exact["orbital_speed"])) / 5.0,
            relative(&closed["power_loss"], number(&exact["power_loss"])),
        ];
        assert!(
            found[0] < 0.02 && found[1] < 3.1e-3 && found[2] < 0.055,
            "{found:?}: {request}"
        );
        assert!(number(&closed["load_mismatch"]) < 0.05, "{answer}");
        assert!(number(&closed["angle_mismatch"]) < 3e-4, "{answer}");
    }
    assert_eq!(compared, 29);
}

/// A row on the same screw seen from its other end: the nut turns the other way, left and right are changed.
fn mirrored(request: &Value) -> Value {
    let mut row = request.clone();
    row["nut_speed"] = json!(-number(&row["nut_speed"]));
    for ball in row["balls"].as_array_mut().unwrap() {
        let contacts: serde_json::Map<_, _> = ball["contacts"]
            .as_object()
            .unwrap()
            .iter()
            .map(|(name, contact)| {
                let side = if name.ends_with('L') { "R" } else { "L" };
                (format!("{}{side}", &name[..1]), contact.clone())
            })
            .collect();
        ball["contacts"] = contacts.into();
    }
    row
}

/// Contacts that the closed form finds are told as such in both directions of load and motion, with play and
/// without: what is recovered are the row's own state and its own speeds.
#[test]
fn contacts_of_the_row_are_recovered() {
    let design = BallScrew::new(BallScrewParameters {
        pitch_radius: 16.5e-3,
        lead: 20e-3,
        ball_radius: 2.778e-3,
        screw_groove: GrooveSize::Radius(3.254e-3),
        nut_groove: GrooveSize::Radius(3.254e-3),
        contact_angle: std::f32::consts::FRAC_PI_4,
        ball_material: Material::STEEL,
        groove_material: Material::STEEL,
    })
    .unwrap();
    let path = f64::from(design.pitch_radius() / design.cos_lead_angle());
    for fit in [GrooveFit::Zero, GrooveFit::Play] {
        let row = ScrewRow::new(&design, 0.1, fit).unwrap();
        for (speed, load) in [(3.0, 80.0), (3.0, -80.0), (-3.0, 80.0), (-3.0, -80.0)] {
            // Two contacts do not tell the nominal angle: deviations alike leave their mean at it.
            let states = [(0.02, 0.02), (-0.03, -0.03), (0.01, 0.01)];
            let balls = states.map(|(screw, nut)| {
                let RowContacts {
                    angles,
                    forces: loads,
                } = row.contacts(speed, load, screw, nut);
                let contacts = (0..4).filter(|place| loads[*place] > 0.0).map(|place| {
                    let name = ["SL", "SR", "NL", "NR"][place].into();
                    (name, loads[place].into(), angles[place].into())
                });
                ball_of(contacts)
            });
            let answers = answered(&[screw_row(3.254e-3, 0.1, speed.into(), &balls)]);
            let closed = &answers[0]["in_loop"];
            assert!(
                number(&closed["load_mismatch"]) < 1e-4,
                "{fit:?} {}",
                answers[0]
            );
            assert!(number(&closed["angle_mismatch"]) < 1e-5, "{}", answers[0]);
            let tick = row.at(speed, load);
            let wanted = states.map(|(screw, nut)| {
                let ball = tick.ball(screw, nut, &LoadShare::MEAN);
                let along = tick.nominal_speed() + ball.speed_deviation;
                f64::from(speed) * f64::from(along) / path
            });
            assert!(
                difference(&closed["orbital_speed"], &wanted) < 1e-5,
                "{fit:?} {speed} {load}: {wanted:?} {}",
                answers[0]
            );
        }
    }
}

/// Rows of up to 64 balls, of those of the stored pairs in turn, and the same seen from the other end: the closed form's forces,
/// over the row's largest one, and its power. In the last row twenty and more balls push each other until their third contacts
/// slide.
#[test]
fn long_rows_in_a_ball_screw() {
    let cases = golden("ballscrew.json");
    let cases = cases["impedance"].as_array().unwrap();
    // Without oversize, loads alike.
    let balls: Vec<_> = [3, 4]
        .into_iter()
        .flat_map(|case| ["contacts1", "contacts2"].map(|name| ball_of_arrays(&cases[case][name])))
        .collect();
    let mixed = |place: usize| balls[(place * place / 3 + place / 7) % 4].clone();
    let mut requests = Vec::new();
    for count in [3, 12, 37, 64] {
        let row: Vec<_> = (0..count).map(|place| mixed(place % 12)).collect();
        let row = screw_row(3.254e-3, 0.1, 5.0, &row);
        requests.push(mirrored(&row));
        requests.push(row);
    }
    let jammed: Vec<_> = (0..37).map(mixed).collect();
    requests.push(screw_row(3.254e-3, 0.1, 5.0, &jammed));

    let answers = answered(&requests);
    let mut pressing = 0;
    for (index, answer) in answers.iter().enumerate() {
        let truth = numbers(&answer["reference"]["contact_force"]);
        let largest = truth.iter().fold(0.0_f64, |most, &force| most.max(force));
        pressing += truth.iter().filter(|force| **force > 0.0).count();
        let force = difference(&answer["in_loop"]["contact_force"], &truth) / largest;
        let power = number(&answer["in_loop"]["power_loss"])
            / number(&answer["reference"]["power_loss"])
            - 1.0;
        // Measured: 5.0 % and 1.6 %; in the last row 17 % and 9.3 %.
        let bounds = if index < 8 {
            [0.075, 0.024]
        } else {
            [0.26, 0.14]
        };
        assert!(
            force <= bounds[0] && power.abs() <= bounds[1],
            "{index}: {force} {power}: {answer}"
        );
    }
    assert!(pressing > 50);
}

pub fn good_linear() -> Value {
    let mut request = linear_row(&[0.02, -0.03, 0.01, 0.0], &[-0.4, 0.1, 0.5], 0.1);
    request["id"] = json!(0);
    request
}

pub fn good_screw() -> Value {
    let contacts = |angle: f64| {
        let contact = |load: f64| json!({"load": load, "contact_angle": angle});
        json!({"contacts": {"SL": contact(9.0), "SR": contact(75.0), "NL": contact(76.0)}})
    };
    screw_row(3.254e-3, 0.1, 3.0, &[contacts(0.75), contacts(0.8)])
}

#[test]
fn balls_that_are_none_are_refused_by_name() {
    let (linear, screw) = (good_linear(), good_screw());
    let mut bad = Vec::new();
    for good in [&linear, &screw] {
        let none = [
            json!([]),
            json!(vec![good["balls"][0].clone(); 65]),
            json!({}),
            json!(3),
            json!("none"),
            json!([7]),
            json!([[]]),
            json!(null),
        ];
        bad.extend(wrong(good, none.map(|value| ("/balls", value))));
        bad.extend(wrong(good, [("/balls/1/colour", json!(1))]));
    }
    bad.extend(wrong(
        &linear,
        [
            ("/balls/0/contact_angles", json!([0.7, 0.7, 0.7])),
            ("/balls/0/contact_angles", json!(vec![0.7; 5])),
            ("/balls/0/contact_angles", json!(0.7)),
            ("/balls/0/contact_angles", json!(["a", 0, 0, 0])),
            ("/balls/0/contact_angles", json!({})),
            ("/balls/0/contact_angles/1", json!(1.2)),
            ("/balls/0/contact_forces/0", json!(-1)),
            ("/poisson_ratio", json!(0.6)),
        ],
    ));
    let contact = json!({"SL": {"load": 1, "contact_angle": 0.7}});
    bad.extend(wrong(
        &screw,
        [
            ("/balls/0/contacts", json!([])),
            ("/balls/0/contacts", json!({})),
            ("/balls/0/contacts", json!(1)),
            ("/balls/0/contacts", contact),
            ("/balls/0/contacts/XL", json!({})),
            ("/balls/0/contacts/NR", json!(3)),
            ("/balls/0/contacts/SL/angle", json!(1)),
            ("/balls/0/contacts/SL/load", json!(-1)),
            ("/groove_radius", json!(2.7e-3)),
            ("/ball_radius", json!(0.1)),
        ],
    ));
    bad.push((
        wrong(&screw, [("/balls/0/contacts/NR", json!({}))])[0]
            .0
            .clone(),
        "load".into(),
    ));
    bad.extend(lacking(&linear, &["/balls/2/contact_forces"]));
    bad.extend(lacking(
        &screw,
        &["/balls/0/contacts", "/balls/0/contacts/SL/load"],
    ));
    for (good, field, twice) in [
        (&linear, "friction", "\"friction\":1,"),
        (&linear, "contact_angles", "\"contact_angles\":1,"),
        (&screw, "SR", "\"SR\":{},"),
    ] {
        let given = format!("\"{field}\":");
        let text = good
            .to_string()
            .replacen(&given, &format!("{twice}{given}"), 1);
        bad.push((text, field.into()));
    }
    refused(&bad);
    // The number of the ball helps to find it.
    let force = wrong(&linear, [("/balls/2/contact_forces/0", json!(-1))]);
    let (_, answers) = ask(&[force[0].0.clone()]);
    let message = answers[0]["error"]["message"].as_str().unwrap();
    assert!(message.contains("ball 2"), "{message}");
}

/// At standstill nothing is lost and nothing moves; balls that nothing drives have no motion to tell.
#[test]
fn standstill_and_lost_contacts_of_trains() {
    let mut linear = good_linear();
    linear["speed"] = json!(0);
    let mut screw = good_screw();
    screw["nut_speed"] = json!(0.0);
    let mut lost = good_screw();
    lost["balls"][1]["contacts"]["NL"]["load"] = json!(0);
    let mut free = good_linear();
    free["balls"][1]["contact_forces"] = json!([0, 0, 0, 0]);
    let mut light = good_screw();
    light["balls"][0]["contacts"]["SL"]["load"] = json!(0);
    let answers = answered(&[linear, screw, lost, free, light]);
    let [linear, screw, lost, free, light] = &answers[..] else {
        unreachable!()
    };
    assert_eq!(linear["reference"]["power_loss"], 0.0);
    assert!(linear["reference"]["contact_force"].is_null());
    for side in ["in_loop", "reference"] {
        assert_eq!(screw[side]["orbital_speed"], json!([0.0, 0.0]));
        assert_eq!(screw[side]["power_loss"], 0.0);
        assert!(screw[side]["contact_force"].is_null());
        assert!(lost[side]["orbital_speed"].is_null() && lost[side]["power_loss"].is_null());
    }
    // With the third contact lost the ball rolls on two: (1 + r cos beta)/2. The closed form has one fit for all balls.
    let speed = number(&light["reference"]["orbital_speed"][0]);
    assert!((speed / 3.0 - 0.5594).abs() < 2e-4, "{light}");
    assert!(light["in_loop"]["orbital_speed"].is_null(), "{light}");
    assert!(free["reference"]["speed_deviation"].is_null());
    assert!(free["in_loop"]["analytic"]["speed_deviation"].is_array());
}
