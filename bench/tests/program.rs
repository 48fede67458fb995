//! The program as its users run it: requests in, answers out, exit codes, files.

use std::fs;
use std::io::Write as _;
use std::path::Path;
use std::process::{Command, Output, Stdio};

use serde_json::{Value, json};

fn program() -> Command {
    Command::new(env!("CARGO_BIN_EXE_epas-bench"))
}

/// Answers to requests given on stdin, with the exit code.
fn eval(lines: &str) -> (Vec<Value>, i32) {
    let mut child = program()
        .arg("eval")
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    // Beside the reading of the answers: a pipe holds only so much.
    let mut stdin = child.stdin.take().unwrap();
    let lines = lines.to_owned();
    let writer = std::thread::spawn(move || stdin.write_all(lines.as_bytes()).unwrap());
    let output = child.wait_with_output().unwrap();
    writer.join().unwrap();
    let answers = String::from_utf8(output.stdout)
        .unwrap()
        .lines()
        .map(|line| serde_json::from_str(line).unwrap())
        .collect();
    assert!(!String::from_utf8_lossy(&output.stderr).contains("panicked"));
    (answers, output.status.code().unwrap())
}

fn good_requests() -> Vec<Value> {
    vec![
        json!({"id": 1, "model": "groove_curvature", "groove": "screw", "pitch_radius": 0.016,
            "lead_angle": 0.19, "contact_angle": 0.78, "groove_radius": 0.0033528,
            "offset_h": 0.000126, "offset_l": 0.000126, "ball_radius": 0.003175}),
        json!({"id": "two", "model": "efficiency", "lead_angle": 0.17, "contact_angle": 0.78,
            "friction": 0.075, "ball_ratio": 0.18, "rolling_tangent": 0.001}),
        json!({"id": [3], "model": "steady_state", "lead_angle": 0.17, "contact_angle": 0.78,
            "friction": 0.075, "ball_radius": 0.00437, "pitch_radius": 0.0243, "speed": 209.4,
            "axial_load": 2113, "ball_density": 7800}),
        json!({"id": {"n": 4}, "model": "hertz", "relative_radius_1": 0.0025,
            "relative_radius_2": 0.05, "load": 120, "contact_modulus": 113.9e9}),
        json!({"id": null, "model": "contact_kinematics", "ball_diameter": 0.00794,
            "pitch_radius": 0.01925, "lead_angle": 0.1745, "groove_radius_screw": 0.0042,
            "groove_radius_nut": 0.0042, "contact_angle_screw": 0.7156,
            "contact_angle_nut": 0.7156, "pitch_angle": 0.698, "yaw_angle": 0.01,
            "rolling_radius_screw": 0.00397, "rolling_radius_nut": 0.00397, "speed": 104.7,
            "semi_major_screw": 0.000601, "semi_minor_screw": 0.0000829,
            "semi_major_nut": 0.000586, "semi_minor_nut": 0.0000975}),
    ]
}

fn lines(requests: &[Value]) -> String {
    requests.iter().fold(String::new(), |lines, request| {
        lines
            + &request.to_string()
            + "
"
    })
}

/// Every number of an answer, with its path.
fn numbers(value: &Value, path: &str, found: &mut Vec<(String, f64)>) {
    match value {
        Value::Number(number) => found.push((path.into(), number.as_f64().unwrap())),
        Value::Object(fields) => {
            for (name, value) in fields {
                numbers(value, &format!("{path}.{name}"), found);
            }
        }
        _ => {}
    }
}

#[test]
fn every_model_answers_in_order_and_crate_and_reference_agree() {
    let requests = good_requests();
    let (answers, code) = eval(&lines(&requests));
    assert_eq!((answers.len(), code), (requests.len(), 0));
    for (answer, request) in answers.iter().zip(&requests) {
        assert_eq!(answer["id"], request["id"]);
        assert!(answer.get("error").is_none(), "{answer}");
        let mut reference = Vec::new();
        numbers(&answer["reference"], "", &mut reference);
        let mut shared = 0;
        for (path, exact) in reference {
            let pointer = path.replace('.', "/");
            if let Some(computed) = answer["in_loop"].pointer(&pointer).and_then(Value::as_f64) {
                shared += 1;
                // The rolling slip is the difference of two radii that agree to 3e-4.
                let allowed = 2e-5 * exact.abs() + 1e-7;
                assert!(
                    (computed - exact).abs() < allowed,
                    "{path}: {computed} {exact}"
                );
            }
        }
        assert!(shared > 0, "{answer}");
    }
}

#[test]
fn literature_is_null_without_a_ball_radius() {
    let mut request = good_requests().swap_remove(0);
    request.as_object_mut().unwrap().remove("ball_radius");
    let (answers, code) = eval(&lines(&[request]));
    assert_eq!(code, 0);
    assert!(answers[0]["in_loop"]["literature"].is_null());
    assert!(answers[0]["in_loop"]["kappa1"].is_f64());
}

/// Every field of every model, with every kind of bad value: an error that names a field, or finite
/// numbers; the run goes on, and the exit code says that something was wrong.
#[test]
fn every_field_survives_every_bad_value() {
    let bad = [
        json!("NaN"),
        json!("Infinity"),
        json!(null),
        json!(true),
        json!([1]),
        json!({}),
        json!(-1.0),
        json!(0),
        json!(-0.0),
        json!(1e-300),
        json!(1e-45),
        json!(1e300),
        json!(-1e300),
        json!(f64::MAX),
        json!(1e38),
    ];
    let mut requests = Vec::new();
    for request in good_requests() {
        for field in request
            .as_object()
            .unwrap()
            .keys()
            .filter(|key| *key != "id")
        {
            for value in &bad {
                let mut request = request.clone();
                request[field] = value.clone();
                request["id"] = json!(field);
                requests.push(request);
            }
        }
    }
    let (answers, code) = eval(&lines(&requests));
    assert_eq!((answers.len(), code), (requests.len(), 1));
    let mut refused = 0;
    for (answer, request) in answers.iter().zip(&requests) {
        let field = request["id"].as_str().unwrap();
        if let Some(error) = answer.get("error") {
            refused += 1;
            let named = error["field"].as_str().unwrap();
            assert!(request.get(named).is_some(), "{answer} to {request}");
            assert!(!error["message"].as_str().unwrap().is_empty());
            if !request[field].is_number() {
                assert_eq!(named, field, "{answer}");
            }
        } else {
            assert!(
                request[field].is_number(),
                "{request} was accepted: {answer}"
            );
        }
    }
    assert!(
        2 * refused > requests.len(),
        "{refused} of {}",
        requests.len()
    );
}

#[test]
fn missing_unknown_and_malformed_requests_are_answered_in_place() {
    for request in good_requests() {
        for field in request.as_object().unwrap().keys() {
            if ["id", "ball_radius", "rolling_tangent", "ball_density"].contains(&field.as_str()) {
                // May be left out; `ball_radius` of another model is not optional and is tried below.
                continue;
            }
            let mut missing = request.clone();
            missing.as_object_mut().unwrap().remove(field);
            let (answers, code) = eval(&lines(&[missing]));
            assert_eq!(code, 1);
            assert_eq!(answers[0]["error"]["field"], json!(field), "{}", answers[0]);
        }
        let mut unknown = request.clone();
        unknown["colour"] = json!(1);
        let (answers, code) = eval(&lines(&[unknown]));
        assert_eq!((&answers[0]["error"]["field"], code), (&json!("colour"), 1));
    }
    let good = good_requests().swap_remove(3);
    let text = format!(
        "\n   \nnot json\n{{\"id\": 7}}\n{{\"id\": 8, \"model\": \"magic\"}}\n[1, 2]\n{good}\n\
         {{\"id\": 9, \"model\": \"hertz\", \"load\": 1, \"load\": 2}}\n"
    );
    let (answers, code) = eval(&text);
    assert_eq!((answers.len(), code), (6, 1));
    assert_eq!(answers[0]["id"], Value::Null);
    assert_eq!(answers[1]["error"]["field"], "model");
    assert_eq!(answers[2]["error"]["field"], "model");
    assert_eq!(answers[3]["id"], Value::Null);
    assert!(answers[4].get("error").is_none());
    assert_eq!(answers[5]["error"]["field"], "load");
}

#[test]
fn wrong_usage_exits_with_2_and_a_missing_file_with_1() {
    let code = |arguments: &[&str]| program().args(arguments).output().unwrap().status.code();
    assert_eq!(code(&["eval", "--colour"]), Some(2));
    assert_eq!(code(&["dance"]), Some(2));
    assert_eq!(code(&["eval", "no/such/file"]), Some(1));
    assert_eq!(code(&["--help"]), Some(0));
    assert_eq!(code(&["simulate", "--list"]), Some(0));
}

fn simulate(folder: &Path, trace: &str, more: &[&str]) -> Output {
    fs::write(folder.join("trace.csv"), trace).unwrap();
    program()
        .current_dir(folder)
        .args(["simulate", "--design", "lin-4.1", "--input", "trace.csv"])
        .args(["--output", "out.csv", "--plot", "out.svg"])
        .args(more)
        .output()
        .unwrap()
}

/// What is wrong is said with its line, and no file is left.
#[test]
fn a_bad_trace_is_refused_with_its_line_and_leaves_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let head = "time,nut_speed,axial_load\n";
    for (trace, said) in [
        (String::new(), "empty"),
        (head.to_owned(), "line 2"),
        ("time,nut_speed\n0,1\n".to_owned(), "axial_load"),
        (format!("{head}0,1,2\n0.1,fast,2\n"), "line 3"),
        (format!("{head}0,1,2\n0.1,NaN,2\n"), "line 3"),
        (format!("{head}0,1,2\n0.1,1,inf\n"), "line 3"),
        (format!("{head}0,1,2\n0.2,1,2\n0.1,1,2\n"), "line 4"),
        (format!("{head}0,1,2\n0.1,1\n"), "line 3"),
    ] {
        let output = simulate(folder.path(), &trace, &[]);
        let message = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(1), "{trace:?}: {message}");
        assert!(
            message.to_lowercase().contains(said),
            "{trace:?}: {message}"
        );
        let left: Vec<_> = fs::read_dir(folder.path())
            .unwrap()
            .map(|entry| entry.unwrap().file_name())
            .filter(|name| name != "trace.csv")
            .collect();
        assert!(left.is_empty(), "{trace:?} left {left:?}");
    }
}

#[test]
fn a_trace_runs_and_existing_files_stay_without_force() {
    let folder = tempfile::tempdir().unwrap();
    let trace = "axial_load,time,nut_speed\n1000,0,10\n1000,0.001,10\n-1000,0.002,10\n";
    let output = simulate(folder.path(), trace, &["--reference"]);
    assert_eq!(
        output.status.code(),
        Some(0),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    let written = fs::read_to_string(folder.path().join("out.csv")).unwrap();
    assert_eq!(written.lines().count(), 4);
    assert!(
        fs::read_to_string(folder.path().join("out.svg"))
            .unwrap()
            .contains("</svg>")
    );
    let again = simulate(folder.path(), trace, &[]);
    assert_eq!(again.status.code(), Some(1));
    assert!(String::from_utf8_lossy(&again.stderr).contains("--force"));
    assert_eq!(
        fs::read_to_string(folder.path().join("out.csv")).unwrap(),
        written
    );
    assert_eq!(
        simulate(folder.path(), trace, &["--force"]).status.code(),
        Some(0)
    );
}

#[test]
fn every_manoeuvre_runs_without_a_design() {
    let folder = tempfile::tempdir().unwrap();
    for manoeuvre in ["parking", "weave", "kerb"] {
        let output = program()
            .current_dir(folder.path())
            .args(["simulate", "--manoeuvre", manoeuvre])
            .output()
            .unwrap();
        assert_eq!(output.status.code(), Some(0), "{manoeuvre}");
        assert!(String::from_utf8_lossy(&output.stdout).contains("lin-4.1"));
    }
}

/// The report, coarse: every printed table value reproduces, and every form is written.
#[test]
fn the_report_reproduces_the_printed_tables() {
    let folder = tempfile::tempdir().unwrap();
    let output = program()
        .current_dir(folder.path())
        .args(["report", "--quick", "--output", "out"])
        .output()
        .unwrap();
    assert_eq!(
        output.status.code(),
        Some(0),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    let shown = String::from_utf8_lossy(&output.stdout);
    assert!(shown.contains("248 of 248 printed error values reproduce"));
    let html = fs::read_to_string(folder.path().join("out/report.html")).unwrap();
    for outside in [
        "http://www.w3.org/2000/svg\"",
        "src=",
        "href=\"http",
        "<script",
    ] {
        // The name space of SVG is a name, not a place.
        assert!(
            outside.starts_with("http://www.w3.org") || !html.contains(outside),
            "{outside}"
        );
    }
    let json: Value =
        serde_json::from_str(&fs::read_to_string(folder.path().join("out/report.json")).unwrap())
            .unwrap();
    for figure in [
        "table_a1",
        "table_a2",
        "curvature_figure_8",
        "curvature_figure_9",
        "curvature_figure_10",
        "curvature_figure_11",
        "efficiency_figure_3",
        "efficiency_figure_5",
        "efficiency_figure_6",
        "efficiency_figure_7",
        "kinematics_figure_6",
        "kinematics_figure_13",
        "error_against_time",
    ] {
        assert!(json.get(figure).is_some(), "{figure}");
        assert!(
            folder.path().join(format!("out/{figure}.csv")).exists(),
            "{figure}"
        );
    }
}
