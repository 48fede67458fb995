//! `eval`: golden cases, and every way to ask wrongly.

use std::fs;

use serde_json::{Value, json};

use super::run;
use super::trains::{good_linear, good_screw};

/// Asks, and gives the answers in order.
pub fn ask(requests: &[String]) -> (i32, Vec<Value>) {
    let run = run(&["eval"], &requests.join("\n"));
    assert!(run.stderr.is_empty(), "{}", run.stderr);
    let answers = run
        .stdout
        .lines()
        .map(|line| serde_json::from_str(line).unwrap())
        .collect();
    (run.code, answers)
}

/// Asks, and gives the answers in order; none is an error.
pub fn answered(requests: &[Value]) -> Vec<Value> {
    let lines: Vec<_> = requests.iter().map(Value::to_string).collect();
    let (code, answers) = ask(&lines);
    assert_eq!((code, answers.len()), (0, requests.len()), "{answers:?}");
    answers
}

/// Asks what is wrong: every answer names its field, and says something.
pub fn refused(bad: &[(String, String)]) {
    let requests: Vec<_> = bad.iter().map(|(request, _)| request.clone()).collect();
    let (code, answers) = ask(&requests);
    assert_eq!((code, answers.len()), (1, bad.len()));
    for ((request, field), answer) in bad.iter().zip(&answers) {
        assert_eq!(answer["error"]["field"], *field, "{request}: {answer}");
        assert!(!answer["error"]["message"].as_str().unwrap().is_empty());
    }
}

/// The field that an error at a place names: the last of its pointer.
fn field_at(pointer: &str) -> String {
    let mut parts = pointer.rsplit('/');
    let name = parts.find(|part| part.parse::<usize>().is_err());
    name.unwrap().into()
}

/// Requests with one wrong value each, by its pointer.
pub fn wrong<'a>(
    good: &Value,
    rows: impl IntoIterator<Item = (&'a str, Value)>,
) -> Vec<(String, String)> {
    rows.into_iter()
        .map(|(pointer, value)| (changed(good, pointer, value), field_at(pointer)))
        .collect()
}

/// Requests without one field each, by its pointer.
pub fn lacking(good: &Value, pointers: &[&str]) -> Vec<(String, String)> {
    pointers
        .iter()
        .map(|pointer| (without(good, pointer), field_at(pointer)))
        .collect()
}

/// Wrong values of the design of a ball screw.
pub fn wrong_screw(good: &Value) -> Vec<(String, String)> {
    wrong(
        good,
        [
            ("/pitch_radius", json!(0.0)),
            ("/lead", json!(-1e-3)),
            ("/ball_radius", json!(1.0)),
            ("/groove_radius", json!(2e-3)),
            ("/contact_angle", json!(1.5)),
            ("/youngs_modulus", json!("steel")),
            ("/poisson_ratio", json!(0.5)),
            ("/clearance", json!(1e-3)),
        ],
    )
}

/// A request with this value at a place, by its pointer.
fn changed(request: &Value, pointer: &str, value: Value) -> String {
    let (parent, field) = pointer.rsplit_once('/').unwrap();
    let mut request = request.clone();
    let parent = request.pointer_mut(parent).unwrap();
    match field.parse::<usize>() {
        Ok(place) if parent.is_array() => parent[place] = value,
        _ => parent[field] = value,
    }
    request.to_string()
}

/// A request without what is at a place, by its pointer.
fn without(request: &Value, pointer: &str) -> String {
    let (parent, field) = pointer.rsplit_once('/').unwrap();
    let mut request = request.clone();
    let parent = request.pointer_mut(parent).unwrap();
    parent.as_object_mut().unwrap().remove(field).unwrap();
    request.to_string()
}

/// A request with this text at a place, by its pointer.
fn with(request: &Value, pointer: &str, text: &str) -> String {
    changed(request, pointer, json!("REPLACED")).replace("\"REPLACED\"", text)
}

/// What is not a finite number that single precision holds.
const NO_NUMBERS: [&str; 10] = [
    "\"NaN\"", "\"1\"", "null", "true", "[1]", "{}", "1e999", "-1e999", "1e300", "-1e300",
];

/// Zero, negative, large and tiny numbers.
const ENDS: &str = "0 -0.0 -1 -1e-30 1e-45 1e-30 1e-300 1e30 3.5e38 0.5 1.5707964 1.5707963267948966 1 1e9 1e6 1e-9 1e-6";

pub fn golden(name: &str) -> Value {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../host-tests/golden/");
    serde_json::from_str(&fs::read_to_string(format!("{folder}{name}")).unwrap()).unwrap()
}

/// A number, which some golden files hold as text.
pub fn number(value: &Value) -> f64 {
    match value {
        Value::String(text) => text.parse().unwrap(),
        other => other
            .as_f64()
            .unwrap_or_else(|| panic!("{other} is not a number")),
    }
}

pub fn relative(found: &Value, truth: f64) -> f64 {
    (number(found) / truth - 1.0).abs()
}

/// A request, and what is expected at places of its answer: pointer, truth, allowed error.
type Asked = (Value, Vec<(String, f64, f64)>);

/// Asks all, and compares every place.
fn hold(asked: &[Asked]) {
    let requests: Vec<_> = asked.iter().map(|(request, _)| request.clone()).collect();
    let answers = answered(&requests);
    for ((request, expected), answer) in asked.iter().zip(&answers) {
        for (pointer, truth, allowed) in expected {
            let found = match answer.pointer(pointer).unwrap() {
                Value::Bool(holds) => f64::from(u8::from(*holds)),
                other => number(other),
            };
            assert!(
                (found - truth).abs() <= *allowed,
                "{request}: {pointer} {truth}: {answer}"
            );
        }
    }
}

/// What is expected of a quantity by the crate and by the reference, with the allowed error of each.
fn both(name: &str, truth: f64, allowed: [f64; 2]) -> [(String, f64, f64); 2] {
    let [in_loop, reference] = allowed;
    [
        (format!("/in_loop/{name}"), truth, in_loop),
        (format!("/reference/{name}"), truth, reference),
    ]
}

fn list(value: &Value) -> &[Value] {
    value.as_array().unwrap()
}

/// One golden case of each formula, whose numbers all differ: each field of a request reaches its argument. (The host tests hold crate and reference to
/// all cases.)
#[test]
fn formulas_answer_their_golden_cases() {
    let cases = golden("curvature.json");
    let distinct = |case: &&Value| case["H"] != case["L"] && number(&case["L"]) != 0.0;
    let case = list(&cases["cases"]).iter().find(distinct).unwrap();
    let mut asked = Vec::new();
    for groove in ["screw", "nut"] {
        let request = json!({
            "id": 0, "model": "groove_curvature", "groove": groove,
            "pitch_radius": case["r_m"], "lead_angle": case["alpha"],
            "contact_angle": case["phi"], "groove_radius": case["r_s"],
            "offset_h": case["H"], "offset_l": case["L"],
        });
        let expected = ["kappa1", "kappa2"].map(|name| {
            let truth = number(&case[groove][name]);
            both(name, truth, [5e-6, 1e-12].map(|part| part * truth.abs()))
        });
        asked.push((request, expected.concat()));
    }
    let cases = golden("efficiency.json");
    let case = &cases["closed_form"][5];
    let names = [
        ("rolling_screw", "eta3"),
        ("rolling_nut", "eta4"),
        ("sliding_drive", "eta14"),
        ("sliding_backdrive", "eta17"),
        ("loss_drive", "loss14"),
    ];
    let request = json!({
        "id": 0, "model": "efficiency", "lead_angle": number(&case["alpha"]),
        "contact_angle": number(&case["beta"]), "friction": number(&case["f"]),
        "ball_ratio": number(&case["a"]), "rolling_tangent": number(&case["t_rho"]),
    });
    let expected = names.map(|(field, name)| both(field, number(&case[name]), [1e-6, 1e-12]));
    asked.push((request, expected.concat()));
    let case = &cases["exact"][3];
    let names = [
        ("efficiency", "eta"),
        ("torque", "torque"),
        ("normal_screw", "Q_B"),
        ("normal_nut", "Q_A"),
        ("normal_nut_minor", "Q_Ap"),
    ];
    let mut expected = Vec::from(names.map(|(field, name)| {
        let truth = number(&case[name]);
        (format!("/reference/{field}"), truth, 1e-12 * truth.abs())
    }));
    expected.push(("/reference/exists".into(), 1.0, 0.0));
    expected.push((
        "/in_loop/efficiency".into(),
        number(&case["eta_dyn1"]),
        3e-7,
    ));
    asked.push((steady_state(case), expected));
    hold(&asked);
    let none = steady_state(&cases["exact_no_steady_state"][0]);
    let answer = &answered(&[none])[0];
    assert_eq!(answer["reference"]["exists"], false);
    assert!(answer["reference"]["efficiency"].is_null());
    assert!(answer["in_loop"]["efficiency"].is_f64());
}

fn steady_state(case: &Value) -> Value {
    json!({
        "id": 0, "model": "steady_state", "lead_angle": number(&case["alpha"]),
        "contact_angle": number(&case["beta"]), "friction": number(&case["f"]),
        "ball_radius": number(&case["r_b"]), "pitch_radius": number(&case["r_m"]),
        "speed": number(&case["omega"]), "axial_load": number(&case["f_a"]),
        "ball_density": number(&case["rho"]),
    })
}

#[test]
fn literature_formula_needs_the_ball_radius() {
    let request = json!({
        "id": null, "model": "groove_curvature", "groove": "screw", "pitch_radius": 8.0,
        "lead_angle": 0.0, "contact_angle": 0.0, "groove_radius": 1.7, "offset_h": 0.0,
        "offset_l": 0.0, "ball_radius": 1.5,
    });
    let without = serde_json::from_str(&without(&request, "/ball_radius")).unwrap();
    let answers = answered(&[request, without]);
    assert!(answers[1]["in_loop"]["literature"].is_null());
    assert!(answers[1]["in_loop"]["fitted"].is_f64());
    // 1 / (8 - 1.5), and without lead and offsets 1 / (8 - 1.7) by every other form.
    assert!(relative(&answers[0]["in_loop"]["literature"], 1.0 / 6.5) < 2e-7);
    assert!(relative(&answers[0]["in_loop"]["circular_groove"], 1.0 / 6.3) < 2e-7);
    assert!(relative(&answers[0]["reference"]["kappa1"], 1.0 / 6.3) < 1e-15);
}

/// Each form slides fully with the limit of its direction, over the load.
#[test]
fn presliding_ends_in_its_limits() {
    let asked = [
        json!({"form": "proportional", "table": "slip8"}),
        json!({"form": "load_exact", "largest_load": 1.05}),
    ];
    let asked = asked.map(|mut request| {
        let whole = json!({
            "id": 1, "model": "presliding", "angle": [0.0, 3.0, -3.0], "load": [1.0, 1.0, 0.5],
            "limit_ratio": [1.0, 0.6],
        });
        request
            .as_object_mut()
            .unwrap()
            .append(&mut whole.as_object().unwrap().clone());
        let places = [0.0, 1.0, -0.3].into_iter().enumerate();
        let expected =
            places.flat_map(|(place, limit)| both(&format!("torque/{place}"), limit, [1e-6, 1e-9]));
        (request, expected.collect())
    });
    hold(&asked);
}

#[test]
fn presliding_names_what_is_wrong() {
    let sound = json!({
        "id": 1, "model": "presliding", "form": "proportional", "table": "slip8",
        "angle": [0.0, 1.0], "limit_ratio": [1.0, 1.0],
    });
    let mut bad = wrong(
        &sound,
        [
            ("/form", json!("elastic")),
            ("/table", json!("slip9")),
            ("/angle", json!([])),
            ("/angle", json!(1.0)),
            ("/angle", json!([0.0, 1e9])),
            ("/load", json!([1.0])),
            ("/load", json!([1.0, -1.0])),
            ("/limit_ratio", json!([1.0])),
            ("/limit_ratio", json!([1.0, -1.0])),
            ("/largest_load", json!(1.0)),
        ],
    );
    let mut request = sound.clone();
    request["form"] = "load_exact".into();
    request.as_object_mut().unwrap().remove("table");
    bad.extend(wrong(&request, [("/largest_load", json!(0.0))]));
    refused(&bad);
}

#[test]
fn the_circle_is_a_contact_ellipse_too() {
    let request = json!({
        "id": 0, "model": "hertz", "relative_radius_1": 2e-3, "relative_radius_2": 2e-3,
        "load": 100.0, "contact_modulus": 1e11,
    });
    // Sphere on plane with R = 1/(1/R1 + 1/R2) doubled: a = (3 F R / (4 E*))^(1/3).
    let a = (3.0 * 100.0 * 2e-3 / (4.0 * 1e11_f64)).cbrt();
    let expected = [
        ("axis_ratio", 1.0),
        ("semi_major", a),
        ("semi_minor", a),
        ("deflection", a * a / 2e-3),
        ("max_pressure", 1.5 * 100.0 / (std::f64::consts::PI * a * a)),
    ];
    // The axis ratio's rational function is within 1.1e-5.
    let expected = expected.map(|(field, truth)| both(field, truth, [2e-5 * truth, 1e-12 * truth]));
    hold(&[(request, expected.into_iter().flatten().collect())]);
}

fn good_requests() -> Vec<Value> {
    vec![
        json!({
            "id": 0, "model": "groove_curvature", "groove": "nut", "pitch_radius": 8e-3,
            "lead_angle": 0.2, "contact_angle": 0.8, "groove_radius": 1.7e-3, "offset_h": 6e-5,
            "offset_l": 6e-5, "ball_radius": 1.6e-3,
        }),
        json!({
            "id": 0, "model": "efficiency", "lead_angle": 0.2, "contact_angle": 0.8,
            "friction": 0.1, "ball_ratio": 0.2, "rolling_tangent": 0.001,
        }),
        json!({
            "id": 0, "model": "steady_state", "lead_angle": 0.2, "contact_angle": 0.8,
            "friction": 0.05, "ball_radius": 4e-3, "pitch_radius": 24e-3, "speed": 200.0,
            "axial_load": 2000.0, "ball_density": 7800.0,
        }),
        json!({
            "id": 0, "model": "hertz", "relative_radius_1": 3e-3, "relative_radius_2": 6e-2,
            "load": 100.0, "contact_modulus": 1.1e11,
        }),
        json!({
            "id": 0, "model": "contact_kinematics", "ball_diameter": 6.35e-3,
            "pitch_radius": 16e-3, "lead_angle": 0.2, "groove_radius_screw": 3.4e-3,
            "groove_radius_nut": 3.4e-3, "contact_angle_screw": 0.8, "contact_angle_nut": 0.75,
            "pitch_angle": 0.7, "yaw_angle": 0.1, "rolling_radius_screw": 3.1e-3,
            "rolling_radius_nut": 3.1e-3, "speed": 100.0, "semi_major_screw": 4e-4,
            "semi_minor_screw": 6e-5, "semi_major_nut": 4e-4, "semi_minor_nut": 6e-5,
        }),
        static_load(&json!({"balls": 4, "ball_oversize": 1e-6, "end_offset": 1e-4})),
        good_linear(),
        good_screw(),
    ]
}

/// The ball screw of Lin 2019, Table 2.1, with some fields changed or added.
fn static_load(changes: &Value) -> Value {
    let mut request = json!({
        "id": 0, "model": "static_load", "pitch_radius": 16.5e-3, "lead": 20e-3,
        "ball_radius": 2.778e-3, "groove_radius": 3.254e-3,
        "contact_angle": std::f64::consts::FRAC_PI_4, "youngs_modulus": 210e9,
        "poisson_ratio": 0.28, "screw_length": 0.8, "screw_diameter": 32e-3, "balls": 32,
        "ball_spacing": std::f64::consts::PI / 8.0, "nut_position": 0.4, "axial_load": 5000.0,
    });
    for (field, value) in changes.as_object().unwrap() {
        request[field] = value.clone();
    }
    request
}

/// Forces within 1e-9 of the largest, by another solver whose residual is 2e-9 N. (The host tests hold the reference to all its cases.)
#[test]
fn static_load_answers_a_golden_case() {
    let truth = &golden("ballscrew.json")["static"]["case3_offset300um"];
    let mut answered = vec![
        (
            "axial_displacement".into(),
            1e-3 * number(&truth["uz_left"]),
        ),
        ("balls_lost".into(), 0.0),
    ];
    for (field, short) in [
        ("screw_left", "SL"),
        ("screw_right", "SR"),
        ("nut_left", "NL"),
        ("nut_right", "NR"),
    ] {
        let forces = list(&truth["F"][short]).iter().map(number).enumerate();
        answered.extend(forces.map(|(ball, force)| (format!("{field}/{ball}"), force)));
    }
    let expected = answered.into_iter().map(|(place, truth): (String, f64)| {
        // Displacements are 1e-5 m, forces 100 N.
        let allowed = if place.contains('/') {
            2e-7
        } else {
            1e-9 * truth.abs()
        };
        (format!("/reference/{place}"), truth, allowed)
    });
    let expected: Vec<_> = expected.collect();
    assert_eq!(expected.len(), 2 + 4 * 32);
    let request = static_load(&json!({"ball_oversize": 7e-6, "end_offset": 3e-4}));
    hold(&[(request, expected)]);
}

/// Small balls under no load touch nothing; lists of another length, parts of balls and balls off the
/// screw are refused.
#[test]
fn static_load_of_odd_requests() {
    let lost = static_load(&json!({"axial_load": 0, "ball_oversize": -1e-5}));
    assert_eq!(answered(&[lost])[0]["reference"]["balls_lost"], 32);
    let bad = [
        (json!({"ball_oversize": [0.0]}), "ball_oversize"),
        (json!({"ball_oversize": []}), "ball_oversize"),
        (json!({"ball_oversize": [[0.0], 0.0]}), "ball_oversize"),
        (json!({"ball_oversize": {}}), "ball_oversize"),
        (json!({"ball_oversize": 1e-3}), "ball_oversize"),
        (json!({"balls": 1.5}), "balls"),
        (json!({"balls": 0}), "balls"),
        (json!({"balls": 10_000_000}), "balls"),
        (json!({"nut_position": 0.01}), "nut_position"),
        (json!({"ball_spacing": 60.0}), "nut_position"),
        (json!({"screw_diameter": 40e-3}), "screw_diameter"),
        (json!({"screw_diameter": 20e-3}), "screw_diameter"),
        (json!({"groove_radius": 2.7e-3}), "groove_radius"),
        (json!({"end_offset": 1.0}), "end_offset"),
    ];
    refused(&bad.map(|(changes, field)| (static_load(&changes).to_string(), field.into())));
}

/// Places of the numbers in a request, of lists those in the last element.
fn places_of_numbers(value: &Value, pointer: &str, places: &mut Vec<String>) {
    match value {
        Value::Number(_) => places.push(pointer.into()),
        Value::Array(list) => {
            let last = list.len() - 1;
            places_of_numbers(&list[last], &format!("{pointer}/{last}"), places);
        }
        Value::Object(fields) => {
            for (field, value) in fields.iter().filter(|(field, _)| *field != "id") {
                places_of_numbers(value, &format!("{pointer}/{field}"), places);
            }
        }
        _ => {}
    }
}

/// Good requests with each of these texts in place of each number, and the number's name.
fn replaced(texts: &[&str]) -> Vec<(String, String)> {
    let mut requests = Vec::new();
    for good in good_requests() {
        let mut places = Vec::new();
        places_of_numbers(&good, "", &mut places);
        for place in places {
            requests.extend(
                texts
                    .iter()
                    .map(|text| (with(&good, &place, text), field_at(&place))),
            );
        }
    }
    requests
}

#[test]
fn what_is_no_finite_number_names_its_field() {
    refused(&replaced(&NO_NUMBERS));
}

#[test]
fn missing_and_unknown_fields_are_named() {
    const OPTIONAL: [(&str, &str); 6] = [
        ("groove_curvature", "ball_radius"),
        ("efficiency", "rolling_tangent"),
        ("steady_state", "ball_density"),
        ("static_load", "ball_oversize"),
        ("static_load", "end_offset"),
        ("linear_train", "ball_friction"),
    ];
    for good in good_requests() {
        let mut bad = wrong(&good, [("/colour", json!(1))]);
        let model = good["model"].as_str().unwrap();
        for field in good.as_object().unwrap().keys() {
            let request = without(&good, &format!("/{field}"));
            if OPTIONAL.contains(&(model, field)) {
                assert_eq!(ask(&[request]).0, 0, "{model} {field}");
            } else {
                bad.push((request, field.clone()));
            }
        }
        refused(&bad);
    }
}

/// Numbers at the ends: an error that names a field, or an answer.
#[test]
fn numbers_at_the_ends_are_refused_or_answered() {
    let requests = replaced(&ENDS.split(' ').collect::<Vec<_>>());
    let requests: Vec<_> = requests.into_iter().map(|(request, _)| request).collect();
    let (_, answers) = ask(&requests);
    assert_eq!(answers.len(), requests.len());
    for (request, answer) in requests.iter().zip(&answers) {
        let holds = match answer["error"]["field"].as_str() {
            Some(field) => request.contains(&format!("\"{field}\"")),
            // The crate has no model of a whole nut.
            None => {
                answer["reference"].is_object()
                    && (answer["in_loop"].is_object() || request.contains("static_load"))
            }
        };
        assert!(holds, "{request}: {answer}");
    }
}

#[test]
fn the_run_goes_on_in_order_after_a_bad_line() {
    let good = good_requests()[3].to_string();
    let long = format!(r#"{{"id": 1, "model": "{}"}}"#, "x".repeat(2 << 20));
    let input = [
        "",
        &good.replace("\"id\":0", r#""id":{"a": [1, 2.50]}"#),
        "   \t ",
        "no json",
        "[1, 2]",
        r#"{"id": 7, "model": "astrology"}"#,
        r#"{"id": 8}"#,
        &good.replace("\"id\":0,", ""),
        &good.replace("100.0", "NaN"),
        &long,
        &good.replace("\"id\":0", "\"id\":12345678901234567890123"),
        &good.replace("\"load\"", "\"l\\u006fad\":1,\"load\""),
    ]
    .join("\r\n");
    let run = run(&["eval", "-"], &input);
    assert_eq!(run.code, 1);
    let lines: Vec<_> = run.stdout.lines().collect();
    let expected = [
        (r#"{"id":{"a": [1, 2.50]},"in_loop""#, ""),
        (r#"{"id":null,"#, "request"),
        (r#"{"id":null,"#, "request"),
        (r#"{"id":7,"#, "model"),
        (r#"{"id":8,"#, "model"),
        (r#"{"id":null,"#, "id"),
        (r#"{"id":null,"#, "request"),
        (r#"{"id":null,"#, "request"),
        (r#"{"id":12345678901234567890123,"in_loop""#, ""),
        (r#"{"id":0,"#, "load"),
    ];
    assert_eq!(lines.len(), expected.len(), "{}", run.stdout);
    for (line, (start, field)) in lines.iter().zip(expected) {
        assert!(line.starts_with(start), "{line}");
        let answer: Value = serde_json::from_str(line).unwrap();
        assert_eq!(answer["error"]["field"].as_str().unwrap_or(""), field);
    }
}

#[test]
fn a_file_is_read_and_a_missing_one_named() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("requests.jsonl");
    let requests: String = good_requests()
        .iter()
        .flat_map(|request| [request.to_string(), "\n".into()])
        .collect();
    // As an editor may save it.
    let text = format!("\u{feff}{requests}");
    fs::write(&path, text).unwrap();
    let good = run(&["eval", path.to_str().unwrap()], "");
    assert_eq!(good.code, 0, "{}", good.stdout);
    assert_eq!(good.stdout.lines().count(), good_requests().len());
    let missing = run(&["eval", "no-such-file.jsonl"], "");
    missing.refused("no-such-file.jsonl");
}

#[test]
fn nothing_in_nothing_out() {
    let run = run(&["eval"], "\n\n");
    assert_eq!((run.code, run.stdout.as_str()), (0, ""));
}

/// A reader that goes away early is no error of this program.
#[test]
fn a_closed_pipe_is_quiet() {
    use std::io::Write;
    use std::process::{Command, Stdio};
    let mut child = Command::new(env!("CARGO_BIN_EXE_epas"))
        .arg("eval")
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    drop(child.stdout.take());
    let mut stdin = child.stdin.take().unwrap();
    // The program may have gone before all is written.
    let _ = stdin.write_all(format!("{}\n", good_requests()[3]).repeat(1000).as_bytes());
    drop(stdin);
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(0));
    assert!(output.stderr.is_empty());
}
