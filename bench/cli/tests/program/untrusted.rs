//! Files that someone made to do harm: refused in bounded time and memory, nothing overwritten.

use std::fmt::Write;
use std::fs;
use std::path::Path;
use std::time::{Duration, Instant};

use super::{ran, run, told, words};

const KERB: &str = "simulate --design design.toml --manoeuvre kerb";

/// Runs `simulate` on a trace and says how it ended; outputs go to `out.csv`.
fn trace(folder: &Path, path: &str) -> super::Run {
    let line = format!("simulate --design lin-4.1 --input {path} --output out.csv");
    told(folder, &line)
}

#[test]
fn deep_and_long_json_is_refused() {
    let deep = "[".repeat(500_000);
    let nested = format!(
        r#"{{"id": 1, "model": "hertz", "load": {}1{}}}"#,
        "[".repeat(100_000),
        "]".repeat(100_000)
    );
    let many_fields = (0..50_000).fold(String::new(), |mut fields, field| {
        write!(fields, r#","f{field}":0"#).unwrap();
        fields
    });
    let many_fields = format!(r#"{{"id":2,"model":"hertz"{many_fields}}}"#);
    let ball = r#"{"contact_angles":[0.7,0.7,0.7,0.7],"contact_forces":[1,1,1,1]}"#;
    let many_balls = format!(
        r#"{{"id":3,"model":"linear_train","ball_radius":0.005,"conformity":0.56,"nominal_contact_angle":0.7854,"youngs_modulus":2.1e11,"poisson_ratio":0.3,"friction":0.1,"speed":0.5,"balls":[{}]}}"#,
        vec![ball; 10_000].join(",")
    );
    let long_number = format!(
        r#"{{"id":4,"model":"friction_map","axis_ratio":0.{},"offset":1}}"#,
        "3".repeat(500_000)
    );
    let long_id = format!(
        r#"{{"id":"{}","model":"friction_map","axis_ratio":0.3,"offset":1}}"#,
        "x".repeat(900_000)
    );
    let good = r#"{"id":5,"model":"friction_map","axis_ratio":0.3,"offset":1}"#;
    let input = [
        &deep,
        &nested,
        &many_fields,
        &many_balls,
        &long_number,
        &long_id,
        good,
    ]
    .join("\n");
    let start = Instant::now();
    let run = run(&["eval"], &input);
    assert_eq!(run.code, 1);
    let lines: Vec<_> = run.stdout.lines().collect();
    assert_eq!(lines.len(), 7);
    for line in &lines[..4] {
        assert!(line.contains("\"error\"") && line.len() < 2000, "{line}");
    }
    assert!(lines[6].contains("\"in_loop\""));
    assert!(start.elapsed() < Duration::from_secs(60));
}

#[test]
fn a_line_that_never_ends_is_not_kept() {
    // 64 MiB without an end of line, then a good one.
    let mut input = "7".repeat(64 << 20);
    input.push_str("\n{\"id\":5,\"model\":\"friction_map\",\"axis_ratio\":0.3,\"offset\":1}\n");
    let run = run(&["eval"], &input);
    assert_eq!(run.code, 1);
    assert!(run.stdout.lines().next().unwrap().contains("longer than"));
    assert!(run.stdout.lines().nth(1).unwrap().contains("in_loop"));
}

#[test]
fn invalid_traces_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let header = "time,nut_speed,axial_load\n";
    for (name, text) in [
        (
            "quote.csv",
            format!("{header}0,1,\"{}", "2\n".repeat(1 << 20)),
        ),
        ("columns.csv", format!("{header}{}\n", "1,".repeat(1 << 20))),
        (
            "header.csv",
            format!("time,nut_speed,axial_load{}\n", ",x".repeat(1 << 20)),
        ),
        (
            "number.csv",
            format!("{header}0,1,{}x\n", "9".repeat(1 << 20)),
        ),
        ("nul.csv", format!("{header}0,1,\0\n")),
    ] {
        fs::write(folder.path().join(name), text).unwrap();
        let run = trace(folder.path(), name);
        assert_eq!(run.code, 1, "{name}");
        assert!(
            run.stderr.contains(name) && run.stderr.len() < 2000,
            "{name}: {}",
            run.stderr.len()
        );
        assert!(!folder.path().join("out.csv").exists(), "{name}");
    }
    let run = trace(folder.path(), ".");
    assert_eq!(run.code, 1);
}

#[test]
fn answers_are_as_short_as_what_they_say() {
    let name = "x".repeat(900_000);
    let deep = |depth: usize| {
        format!(
            r#"{{"id":{}{},"model":"friction_map","axis_ratio":0.3,"offset":1}}"#,
            "[".repeat(depth),
            "]".repeat(depth)
        )
    };
    let input = [
        format!(r#"{{"id":1,"model":"friction_map","{name}":1,"axis_ratio":0.3,"offset":1}}"#),
        format!(
            r#"{{"id":2,"model":"friction_map","{0}":1,"{0}":2}}"#,
            &name[..400_000]
        ),
        deep(100_000),
        deep(101),
        deep(100),
    ]
    .join("\n");
    let run = run(&["eval"], &input);
    let lines: Vec<_> = run.stdout.lines().collect();
    for line in &lines[..4] {
        assert!(line.contains("\"error\"") && line.len() < 300, "{line}");
    }
    // What cannot be echoed is not.
    assert!(lines[2].starts_with(r#"{"id":null,"error":{"field":"id""#));
    assert!(lines[4].contains("in_loop"));
}

/// What a file holds is quoted so that a terminal shows it.
#[test]
fn messages_are_short_and_obey_no_file() {
    let folder = tempfile::tempdir().unwrap();
    for text in [
        format!("lead = {}\n", "9".repeat(100_000)),
        "lead = \"\u{1b}]0;title\u{7}\"\n\u{1b}[2J".to_owned(),
    ] {
        fs::write(folder.path().join("design.toml"), text).unwrap();
        let run = told(folder.path(), KERB);
        assert_eq!(run.code, 1);
        assert!(run.stderr.len() < 2100, "{}", run.stderr.len());
        assert!(
            !run.stderr.contains(['\u{1b}', '\u{7}']),
            "{:?}",
            run.stderr
        );
    }
}

/// Neither an input nor what is no file is replaced, with `--force` either.
#[cfg(unix)]
#[test]
fn force_replaces_outputs_only() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    let design = "pitch_radius = 0.016\nlead = 0.02\nball_radius = 0.003175\nconformity = 0.528\n\
                  contact_angle = 0.785\nloaded_balls = 30\n[loads]\nscrew_length = 0.8\n\
                  screw_diameter = 0.03\nnut_position = 0.4\naxial_load = 5000.0\nturns = 2.5\n";
    fs::write(path("design.toml"), design).unwrap();
    fs::write(path("precious.csv"), "precious").unwrap();
    fs::create_dir(path("folder")).unwrap();
    std::os::unix::fs::symlink("precious.csv", path("link.csv")).unwrap();
    std::os::unix::fs::symlink("nowhere.csv", path("dangling.csv")).unwrap();
    // A socket stands for every file that is none; a pipe or a device would be gone as well.
    let _socket = std::os::unix::net::UnixListener::bind(path("socket")).unwrap();
    let simulate = |output: &str| {
        let line = format!("simulate --design design.toml --manoeuvre kerb --output {output}");
        told(folder.path(), &line)
    };
    for output in words("link.csv dangling.csv precious.csv socket folder") {
        assert_eq!(simulate(output).code, 1, "{output}");
    }
    simulate("precious.csv").refused("--force");
    for output in ["design.toml", "./folder/../design.toml", "socket", "folder"] {
        let run = simulate(&format!("{output} --force"));
        assert_eq!(run.code, 1, "{output}: {}", run.stderr);
    }
    let line = "simulate --loads --design design.toml --output design.toml --force";
    let loads = told(folder.path(), line);
    assert_eq!(loads.code, 1, "{}", loads.stderr);
    // Nor is what stands beside the first input.
    let beside = ["gear.toml", "map.csv", "image.a2l", "trace.csv"];
    for file in beside {
        fs::write(path(file), "precious").unwrap();
    }
    std::os::unix::fs::symlink("design.toml", path("alias.csv")).unwrap();
    let mechanism = "simulate --mechanism --inertia 1 --design design.toml --input trace.csv";
    let mapped = "simulate --design design.toml --input trace.csv --channels map.csv";
    let calibrated = "calibrate trace.csv --design lin-4.1";
    for (command, outputs) in [
        (mechanism, "--output alias.csv"),
        (mapped, "--output map.csv"),
        (mapped, "--output ./trace.csv"),
        ("simulate --manoeuvre kerb", "--output out --plot ./out"),
        ("a2l --image image.a2l", "--output image.a2l"),
        (calibrated, "--validate gear.toml --design-out gear.toml"),
        (calibrated, "--channels gear.toml --design-out gear.toml"),
    ] {
        let all = format!("{command} {outputs} --force");
        let run = told(folder.path(), &all);
        assert_eq!(run.code, 1, "{all}: {}", run.stderr);
        assert!(run.stderr.contains("named twice"), "{all}: {}", run.stderr);
    }
    for file in beside {
        assert_eq!(fs::read_to_string(path(file)).unwrap(), "precious");
    }
    // A link is replaced, not what it leads to.
    assert_eq!(simulate("link.csv --force").code, 0);
    assert_eq!(
        fs::read_to_string(path("precious.csv")).unwrap(),
        "precious"
    );
    assert_eq!(fs::read_to_string(path("design.toml")).unwrap(), design);
    assert!(!path("nowhere.csv").exists());
    assert!(path("socket").exists() && path("folder").is_dir());
}

/// A device says that it is empty, and never ends.
#[cfg(unix)]
#[test]
fn a_device_is_read_no_further_than_a_file() {
    let folder = tempfile::tempdir().unwrap();
    let endless = folder.path().join("endless.toml");
    std::os::unix::fs::symlink("/dev/zero", &endless).unwrap();
    let line = "simulate --design endless.toml --manoeuvre kerb";
    let run = told(folder.path(), line);
    run.refused("larger than");
    let run = told(folder.path(), "eval endless.toml");
    assert_eq!(run.code, 1);
    assert!(run.stderr.contains("more than") && run.stdout.is_empty());
}

#[test]
fn a_deep_design_file_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    for text in [
        format!("lead = {}", "[".repeat(100_000)),
        format!("{}lead = 1{}", "a.".repeat(50_000), "\n"),
        format!("name = \"{}\"", "x".repeat(1 << 20)),
    ] {
        fs::write(folder.path().join("design.toml"), text).unwrap();
        let run = told(folder.path(), KERB);
        run.refused("design.toml");
    }
}

/// A design's name comes from its file and becomes part of a path only after what could lead elsewhere is
/// gone.
#[test]
fn a_name_leads_nowhere_else() {
    let folder = tempfile::tempdir().unwrap();
    let work = folder.path().join("work");
    fs::create_dir(&work).unwrap();
    fs::write(
        work.join("design.toml"),
        "name = \"../../../escape\"\npitch_radius = 0.016\nlead = 0.02\nball_radius = 0.003175\n\
         conformity = 0.528\ncontact_angle = 0.785\n",
    )
    .unwrap();
    ran(&work, KERB);
    let outside: Vec<_> = fs::read_dir(folder.path()).unwrap().collect();
    assert_eq!(outside.len(), 1);
    assert_eq!(
        fs::read_dir(work.join("target").join("simulate"))
            .unwrap()
            .count(),
        2
    );
}
