use super::*;

const USERS: &str = "\
# Rack drive, second sample.
name = \"rack\"   # drawing 7
nominal_diameter = 0.032
lead = 0.02

# From the data sheet.
friction = 0.1 # assumed
clearance = -1e-6 # sorted balls
ball_diameter = 6.35e-3
conformity = 0.528
contact_angle = 0.7853982
loaded_balls = 40

[limits]
nut_speed = 300 # of the motor
";

fn estimate(name: &str, value: f64) -> Estimate {
    Estimate::told(name, "", value, 0.1 * value)
}

fn calibration(parameters: Vec<Estimate>) -> Calibration {
    Calibration {
        parameters,
        residual_rms: 1.0,
        relative_error: 0.1,
        effective_rows: 100.0,
        ..Calibration::default()
    }
}

fn whole() -> Calibration {
    calibration(vec![
        estimate("friction", 0.1152),
        estimate("full_film_ratio", 0.5),
        estimate("half_share_speed", 6.0),
        Estimate::fixed("reference_temperature", "K", 303.0),
        Estimate::fixed("hysteresis_loss", "", 0.02),
        estimate("preload", 17.0),
        estimate("breakaway_angle", 2e-3),
        estimate("inertia", 4e-4),
        estimate("gain", 1.012),
        Estimate::fixed("drag", "N m s/rad", 3e-4),
        estimate("cosine_1", 1.5e-3),
        estimate("sine_1", -1e-3),
        estimate("sine_2", 8e-4),
        estimate("colour", 3.0),
    ])
}

#[test]
fn only_calibrated_numbers_change() {
    let Written {
        text,
        left_out,
        design,
        ..
    } = written(USERS, (&whole(), None), "weave\n17").unwrap();
    assert_eq!(left_out, ["colour"]);
    let own = |line: &&str| !line.contains("calibrated: ") && !line.trim().is_empty();
    let kept: Vec<_> = text.lines().filter(own).collect();
    for line in USERS.lines().filter(|line| !line.is_empty()) {
        let replaced = line.starts_with("friction") || line.starts_with("clearance");
        assert_eq!(kept.contains(&line), !replaced, "{line}");
    }
    for line in [
        "friction = 0.1152 # assumed; calibrated: 0.1037 to 0.1267 (95 %), from weave 17",
        "preload = 17.0 # calibrated: 15.30 to 18.70 (95 %), from weave 17",
        "full_film_ratio = 0.5 # calibrated: 0.4500 to 0.5500 (95 %), from weave 17",
        "reference_temperature = 303.0 # calibrated: set, not estimated, from weave 17",
    ] {
        assert!(text.contains(line), "{line}\n{text}");
    }
    // What was set is not written as if it had been measured.
    for name in ["hysteresis_loss", "drag"] {
        assert!(!text.contains(name), "{text}");
    }
    // It is read as what was calibrated.
    let again = read(&text, "other").unwrap();
    assert_eq!(again.caged, design.caged);
    assert_eq!(again.calibrated, design.calibrated);
    assert_eq!(again.caged.friction, 0.1152);
    let told = again.calibrated.unwrap();
    let found = [
        told.full_film_ratio,
        told.half_share_speed,
        told.reference_temperature,
        told.breakaway_angle,
        told.inertia,
        told.gain,
    ];
    let wanted = [0.5, 6.0, 303.0, 2e-3, 4e-4, 1.012].map(Some);
    assert_eq!(found, wanted);
    let waves = told.harmonics.iter();
    let waves: Vec<_> = waves
        .map(|wave| (wave.order, wave.cosine, wave.sine))
        .collect();
    assert_eq!(waves, [(1, 1.5e-3, -1e-3), (2, 0.0, 8e-4)]);
}

/// However a design says how its balls fit, the calibrated preload takes that key's place.
#[test]
fn a_preload_takes_the_place_of_any_fit() {
    for fit in [
        "clearance = -1e-6",
        "preload = 7",
        "axial_preload = 300 # of the nut, N",
        "axial_play = 1e-5",
    ] {
        let users = USERS.replace("clearance = -1e-6 # sorted balls", fit);
        let Written { text, design, .. } = written(&users, (&whole(), None), "weave").unwrap();
        let key = |line: &&str| has(FITS, line.split(' ').next().unwrap_or_default());
        assert_eq!(text.lines().filter(key).count(), 1, "{text}");
        assert!(text.contains("preload = 17.0 # calibrated: "), "{text}");
        // Turned into a gap and back: two powers, each of some roundings of 6e-8.
        let preload = design.caged.clearance.preload(&design.caged.design);
        assert!((preload - 17.0).abs() < 17.0 * 1e-5, "{preload}");
    }
}

/// Comments stay beside what they speak of: below the new key those of the one that it replaces, and at the end of a table its own.
/// A second calibration replaces the comments of the first.
#[test]
fn comments_stay_in_their_places() {
    let users = format!("{USERS}# The motor's, not the nut's.\n").replace(
        "clearance = -1e-6 # sorted balls\n",
        "\n# -- Fit, one of four\nclearance = -1e-6 # sorted balls\n#   nominal ball\n# axial_play = 1e-5\n",
    );
    let of = |text: &str, trace| written(text, (&whole(), None), trace).unwrap().text;
    let text = of(&users, "trace");
    for lines in [
        "\n# -- Fit, one of four\npreload = 17.0 # calibrated: 15.30 to 18.70 (95 %), from trace\n# clearance = -1e-6 # sorted balls\n#   nominal ball\n# axial_play = 1e-5\nball_diameter",
        "nut_speed = 300 # of the motor\n# The motor's, not the nut's.\n\n[calibration]\n",
    ] {
        assert!(text.contains(lines), "{text}");
    }
    assert_eq!(text, of(&text, "trace"));
    let other = of(&text, "parking");
    assert!(!other.contains("from trace") && other.contains("assumed; calibrated"));
}

#[test]
fn circumstances_of_a_screw_stand_beside_its_numbers() {
    let screw = Screw {
        caged: read(USERS, "design").unwrap().caged,
        elements: ElementsKind::LoadExact,
        preloaded: true,
        reference_temperature: 300.0,
        reference_load: 250.0,
        largest_load: 3000.0,
    };
    let mut told = whole();
    let parameters = &mut told.parameters;
    parameters.retain(|estimate| estimate.name != "reference_temperature");
    let written = written(USERS, (&told, Some(&screw)), "weave").unwrap();
    let found = written.design.calibrated.unwrap();
    let numbers = [
        found.reference_temperature,
        found.reference_load,
        found.largest_load,
    ];
    assert_eq!(numbers, [300.0, 250.0, 3000.0].map(Some));
    assert_eq!(found.elements, Some(ElementsKind::LoadExact));
}

#[test]
fn what_is_wrong_is_named() {
    for (users, parameters, word) in [
        (USERS, vec![estimate("friction", 7.0)], "friction"),
        (USERS, vec![estimate("drag", f64::NAN)], "drag"),
        ("friction = ", Vec::new(), ""),
        (
            "calibration = 3",
            vec![estimate("drag", 1.0)],
            "calibration",
        ),
    ] {
        let wrong = calibration(parameters);
        let error = written(users, (&wrong, None), "weave").unwrap_err();
        assert!(error.contains(word), "{error}");
    }
}

/// What ended at a bound is none of the user's numbers, nor of the constants that follow from them.
#[test]
fn what_is_at_a_bound_is_not_written() {
    let mut calibration = whole();
    for estimate in &mut calibration.parameters {
        let ended = ["full_film_ratio", "gain", "preload"];
        estimate.at_bound = ended.contains(&estimate.name.as_str());
    }
    let written = written(USERS, (&calibration, None), "weave").unwrap();
    let names = ["full_film_ratio", "half_share_speed", "preload", "gain"];
    assert_eq!(written.at_bound, names);
    for name in names {
        assert!(!written.text.contains(name), "{}", written.text);
    }
    assert!(written.text.contains("clearance = -1e-6"));
}
