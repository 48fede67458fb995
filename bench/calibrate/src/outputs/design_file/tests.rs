use super::*;
use epas_design::files::calibration::ElementsName;

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
    Estimate {
        name: name.into(),
        unit: "",
        value,
        low: 0.9 * value,
        high: 1.1 * value,
        fixed: false,
        at_bound: false,
    }
}

fn calibration(parameters: Vec<Estimate>) -> Calibration {
    Calibration {
        parameters,
        residual_rms: 1.0,
        relative_error: 0.1,
        effective_rows: 100.0,
        cannot_tell: Vec::new(),
        models: Vec::new(),
        winner: None,
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
    let Written { text, left_out, .. } = written(USERS, (&whole(), None), "weave\n17").unwrap();
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
        let lines = text.lines().filter(|line| {
            let key = line.split(' ').next().unwrap_or_default();
            FITS.contains(&key)
        });
        assert_eq!(lines.count(), 1, "{text}");
        assert!(text.contains("preload = 17.0 # calibrated: "), "{text}");
        let preload = design.caged.clearance.preload(&design.caged.design);
        assert!((preload - 17.0).abs() < 17.0 * 1e-5, "{preload}");
    }
}

/// Comments stay beside what they speak of: below the new key those of the one that it replaces, and at the end of a table its own.
#[test]
fn comments_stay_in_their_places() {
    let users = format!(
        "{USERS}# The motor's, not the nut's.\n"
    )
    .replace(
        "clearance = -1e-6 # sorted balls\n",
        "\n# -- Fit, one of four\nclearance = -1e-6 # sorted balls\n#   nominal ball\n# axial_play = 1e-5\n",
    );
    let text = written(&users, (&whole(), None), "trace").unwrap().text;
    for lines in [
        "\n# -- Fit, one of four\npreload = 17.0 # calibrated: 15.30 to 18.70 (95 %), from trace\n# clearance = -1e-6 # sorted balls\n#   nominal ball\n# axial_play = 1e-5\nball_diameter",
        "nut_speed = 300 # of the motor\n# The motor's, not the nut's.\n\n[calibration]\n",
    ] {
        assert!(text.contains(lines), "{text}");
    }
    let again = written(&text, (&whole(), None), "trace").unwrap().text;
    assert_eq!(text, again);
}

#[test]
fn what_is_written_is_read_as_what_was_calibrated() {
    let Written { text, design, .. } = written(USERS, (&whole(), None), "weave").unwrap();
    let again = read(&text, "other").unwrap();
    assert_eq!(again.caged, design.caged);
    assert_eq!(again.calibrated, design.calibrated);
    assert_eq!(again.caged.friction, 0.1152);
    let screw = &again.caged.design;
    // Of a preload that is turned into a gap and back: two powers, each of some roundings of 6e-8.
    let preload = again.caged.clearance.preload(screw);
    assert!((preload - 17.0).abs() < 17.0 * 1e-5, "{preload}");
    let calibrated = again.calibrated.unwrap();
    assert_eq!(
        (
            calibrated.full_film_ratio,
            calibrated.half_share_speed,
            calibrated.reference_temperature
        ),
        (Some(0.5), Some(6.0), Some(303.0))
    );
    assert_eq!(calibrated.breakaway_angle, Some(2e-3));
    assert_eq!(
        (calibrated.inertia, calibrated.gain),
        (Some(4e-4), Some(1.012))
    );
    let waves: Vec<_> = calibrated
        .harmonics
        .iter()
        .map(|wave| (wave.order, wave.cosine, wave.sine))
        .collect();
    assert_eq!(waves, [(1, 1.5e-3, -1e-3), (2, 0.0, 8e-4)]);
}

#[test]
fn circumstances_of_a_screw_stand_beside_its_numbers() {
    let design = read(USERS, "design").unwrap();
    let screw = Screw {
        caged: design.caged,
        elements: ElementsKind::LoadExact,
        preloaded: true,
        reference_temperature: 300.0,
        reference_load: 250.0,
        largest_load: 3000.0,
    };
    let mut told = whole();
    told.parameters
        .retain(|estimate| estimate.name != "reference_temperature");
    let calibrated = written(USERS, (&told, Some(&screw)), "weave")
        .unwrap()
        .design
        .calibrated
        .unwrap();
    assert_eq!(
        (
            calibrated.reference_temperature,
            calibrated.reference_load,
            calibrated.largest_load,
            calibrated.elements
        ),
        (
            Some(300.0),
            Some(250.0),
            Some(3000.0),
            Some(ElementsName::LoadExact)
        )
    );
}

#[test]
fn a_second_calibration_replaces_the_first() {
    let first = written(USERS, (&whole(), None), "weave").unwrap().text;
    let again = written(&first, (&whole(), None), "weave").unwrap().text;
    assert_eq!(first, again);
    let other = written(&first, (&whole(), None), "parking").unwrap().text;
    assert!(!other.contains("weave") && other.contains("assumed; calibrated"));
}

#[test]
fn a_number_out_of_range_is_named() {
    let wrong = calibration(vec![estimate("friction", 7.0)]);
    let error = written(USERS, (&wrong, None), "weave").unwrap_err();
    assert!(error.contains("friction"), "{error}");
    let wrong = calibration(vec![estimate("drag", f64::NAN)]);
    let error = written(USERS, (&wrong, None), "weave").unwrap_err();
    assert!(error.contains("drag"), "{error}");
    assert!(written("friction = ", (&whole(), None), "weave").is_err());
    assert!(written("calibration = 3", (&whole(), None), "weave").is_err());
}

/// What ended at a bound is none of the user's numbers, nor of the constants that follow from them.
#[test]
fn what_is_at_a_bound_is_not_written() {
    let mut calibration = whole();
    for name in ["full_film_ratio", "gain", "preload"] {
        let parameters = &mut calibration.parameters;
        let found = parameters
            .iter_mut()
            .find(|found| found.name == name)
            .unwrap();
        found.at_bound = true;
    }
    let written = written(USERS, (&calibration, None), "weave").unwrap();
    assert_eq!(
        written.at_bound,
        ["full_film_ratio", "half_share_speed", "preload", "gain"]
    );
    for name in ["full_film_ratio", "half_share_speed", "gain", "preload"] {
        assert!(!written.text.contains(name), "{}", written.text);
    }
    assert!(written.text.contains("clearance = -1e-6"));
}
