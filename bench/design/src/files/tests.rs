use super::*;

#[test]
fn every_built_in_design_is_valid_and_found_by_its_name() {
    assert_eq!(built_in().count(), 52);
    for (name, ..) in built_in() {
        let design = name.parse::<DesignSource>().unwrap().load().unwrap();
        assert_eq!(design.name, name);
        design.check().unwrap();
    }
    assert!("33x20x6.35".parse::<DesignSource>().is_err());
}

/// A name has one friction coefficient, clearance, reversal speed and rolling resistance: the scene without cage runs the caged scene's gear.
#[test]
fn a_name_has_one_set_of_numbers_in_every_scene() {
    let mut without_cage = Vec::new();
    for (name, ..) in built_in() {
        let design = name.parse::<DesignSource>().unwrap().load().unwrap();
        let Some(balls) = design.uncaged else {
            continue;
        };
        assert_eq!(balls.gear, design.caged, "{name}");
        without_cage.push(name);
    }
    assert_eq!(without_cage, ["lin-3.6"]);
    let settings = Settings::of("lin-3.6");
    assert_eq!((settings.friction, settings.clearance.gap()), (0.1, 0.0));
}

fn parse(text: &str) -> Result<Design, String> {
    read(text, "stem")
}

const GOOD: &str = "nominal_diameter = 0.032\nlead = 0.02\nball_diameter = 6.35e-3\n\
                    conformity = 0.528\ncontact_angle = 0.7853982\n";

#[test]
fn a_design_file_equals_the_built_in_design() {
    let built_in = |name: &str| name.parse::<DesignSource>().unwrap().load().unwrap();
    let papers = "friction = 0.075\nclearance = 0\nreversal_speed = 0.5\n";
    let file = parse(&format!("{GOOD}{papers}")).unwrap();
    assert_eq!(file.caged, built_in("32x20x6.35").caged);
    assert_eq!(file.defaulted, ["loaded_balls"]);
    let named = parse(&format!("{GOOD}name = \"red\\u001b[31m\"\n")).unwrap();
    assert_eq!(named.name, "red [31m");
    // What a file leaves out is what the sizes of no paper have.
    let file = parse(&GOOD.replace("0.02\n", "0.01\n")).unwrap();
    assert_eq!(file.caged, built_in("32x10x6.35").caged);
    assert_eq!(file.caged.friction, defaults::FRICTION);
    assert_eq!(file.caged.clearance, defaults::CLEARANCE);
    assert_eq!(
        file.defaulted,
        ["friction", "clearance", "reversal_speed", "loaded_balls"]
    );
}

/// A refusal says what the file should have, in a file's words.
#[test]
fn a_wrong_value_is_explained() {
    for (addition, words) in [
        ("clearance = -20", "-20 um? that is -20e-6"),
        ("clearance = -30e-6\nloaded_balls = 50", "4.2 GPa"),
        ("axial_play = 10", "10 um? that is 10e-6"),
        ("axial_play = 0.02", "0.02 mm? that is 0.02e-3"),
        (
            "foo = 0.1",
            "`preload`, `axial_play`, `axial_preload`, `reversal_speed`",
        ),
        ("friction = 0,1", "a decimal point stands"),
        ("friction = \"0.1\"", "expected a number"),
        ("loaded_balls = 70000", "a whole number, 0 to 65535"),
        (
            "[fold]\naxial_load = [300, 5]",
            "[least, largest] of one ball",
        ),
        (
            "[fold]\naxial_load = [5, 1e9]",
            "fold: axial_load = 1000000000",
        ),
        ("[fold]\naxial_load = [nan, 5]", "fold: axial_load = NaN"),
        (
            "[fold]\naxial_load = 12000",
            "such as axial_load = [5, 300]",
        ),
        ("friction = [0.05, 0.15]", "[fold] friction = [least, most]"),
        (
            "[uncaged]\nballs = 16\nturns = 50",
            "uncaged: turns = 50 is out of range; allowed: 0.1 to 10",
        ),
        (
            "loaded_balls = 40\n[uncaged]\nballs = 16\nturns = 1.5\nreturn_length = 0.05",
            "loaded_balls = 40 does not follow from [uncaged]: of balls = 16 with turns = 1.5 and return_length = 0.05, 12.1 are loaded; \
             allowed: 12 to 13",
        ),
        (
            "[[limits]]\nnut_speed = 300",
            "write [limits], not an array of tables [[limits]]",
        ),
        ("fold = 3", "fold is a table: write [fold]"),
        ("[friction]\nlow = 1", "expected a number"),
        (
            "[uncaged]\nballs = 16\nturns = 1\nscrew_deviation = [2]",
            "is a list of 1 numbers",
        ),
        (
            "[uncaged]\nballs = 16\nturns = 1\nscrew_deviation = 2",
            "expected a list",
        ),
        (
            "[fold]\nfriction = [0.2, 0.3]",
            "fold: the design's friction",
        ),
        ("[fold]\nfriction = [0.05, 0.9]", "fold: friction = 0.9"),
    ] {
        let error = parse(&format!("{GOOD}{addition}\n")).unwrap_err();
        assert!(error.contains(words), "{addition}: {error}");
        assert!(!error.contains("struct "), "{addition}: {error}");
    }
    // A place for a ball more or less.
    let row = "[uncaged]\nballs = 16\nturns = 1.5\nreturn_length = 0.05\n";
    parse(&format!("{GOOD}loaded_balls = 12\n{row}")).unwrap();
}

#[test]
fn every_wrong_field_is_named() {
    for (addition, field) in [
        ("friktion = 0.1", "friktion"),
        ("friction = -0.1", "friction"),
        ("friction = nan", "friction"),
        ("friction = inf", "friction"),
        ("friction = 1e300", "friction"),
        ("friction = \"low\"", "friction"),
        ("rolling_tangent = 0.2", "rolling_tangent"),
        ("branch = \"fast\"", "branch"),
        ("preload = -1", "preload"),
        ("preload = 2e5", "preload"),
        ("clearance = -2e-4", "clearance"),
        ("clearance = 2", "clearance"),
        ("clearance = nan", "clearance"),
        ("clearance = 0\npreload = 100", "clearance and preload"),
        ("preload = 100", "loaded_balls"),
        ("axial_play = -1e-5", "axial_play"),
        ("axial_preload = 1e6\nloaded_balls = 50", "axial_preload"),
        ("fit = \"zero\"", "clearance"),
        ("reversal_speed = 0", "reversal_speed"),
        ("loaded_balls = 0", "loaded_balls"),
        ("loaded_balls = -3", "loaded_balls"),
        ("youngs_modulus = 0", "youngs_modulus"),
        ("poisson_ratio = 0.6", "poisson_ratio"),
        ("density = 0", "density"),
        ("pitch_radius = 0.016", "pitch_radius"),
        ("ball_radius = 0.003", "ball_radius"),
        ("groove_radius = 0.0034", "groove_radius"),
        ("[screw_groove]\nradius = 0.0034", "radius"),
        ("[screw_groove]\nconformity = 0.5", "conformity"),
        ("[nut_groove]", "nut_groove"),
        ("[limits]\nnut_speed = 0", "nut_speed"),
        ("[limits]\nspeed = 1", "speed"),
        ("[ball_material]\nyoungs_modulus = -1", "youngs_modulus"),
        ("[calibration]\nfilm = 1", "film"),
        ("[calibration]\nfull_film_ratio = 0.5", "half_share_speed"),
        ("[calibration]\nhalf_share_speed = 5", "full_film_ratio"),
        ("[calibration]\nlargest_load = 500", "breakaway_angle"),
        (
            "[calibration]\nbreakaway_angle = 1e-3\nlargest_load = 500",
            "largest_load",
        ),
        ("[calibration]\nelements = \"load_exact\"", "largest_load"),
        ("[calibration]\nelements = \"springs\"", "elements"),
        (
            "[calibration]\nreference_temperature = 30",
            "reference_temperature",
        ),
        ("[calibration]\nviscosity_pole = 290", "viscosity_pole"),
        (
            "[calibration]\ndirection_asymmetry = nan",
            "direction_asymmetry",
        ),
        ("[calibration]\nbreakaway_angle = 0", "breakaway_angle"),
        ("[calibration]\nreference_load = -1", "reference_load"),
        ("[calibration]\ninertia = inf", "inertia"),
        ("[calibration]\ndrag = nan", "drag"),
        ("[calibration]\noffset = 1e9", "offset"),
        ("[calibration]\ngain = 11", "gain"),
        ("[calibration]\nbacklash = -1", "backlash"),
        ("[calibration]\nchurning = -1", "churning"),
        ("[calibration]\nrolling_drag = -1", "rolling_drag"),
        ("[calibration]\nharmonics = [{ order = 0 }]", "order"),
        ("limits = [1, 2, 3]", "limits is a table"),
        ("[uncaged]\nturns = 1", "balls"),
        ("[uncaged]\nballs = 16\nturns = -2", "turns"),
        ("friction = 1e300", "friction = 1e300"),
        (
            "[uncaged]\nballs = 16\nturns = 0.75\nscrew_deviation = [[1]]",
            "screw_deviation = [[...]]",
        ),
        (
            "[calibration]\nharmonics = [{ order = 1, sine = nan }]",
            "sine",
        ),
    ] {
        let error = parse(&format!("{GOOD}{addition}\n")).unwrap_err();
        assert!(error.contains(field), "{addition}: {error}");
    }
    for (more, field) in [
        ("screw_deviation = [{ order = 9, sine = 0.01 }]", "order"),
        ("screw_deviation = [{ order = 2, sine = 0.5 }]", "sine"),
        ("screw_deviation = [{ order = 2, sinus = 0.04 }]", "sinus"),
        ("load_shares = [1.0, nan]", "load_shares"),
        (
            "load_shares = [1]\nnegative_load_shares = [nan]",
            "negative_load_shares",
        ),
        (
            "load_shares = [1.2, 0.8]\nnegative_load_shares = [1]",
            "has 1 entries",
        ),
        (
            "negative_load_shares = [1.0]",
            "negative_load_shares needs load_shares",
        ),
        ("fit = { preload = -1 }", "clearance (m"),
        ("fit = \"play\"", "clearance (m"),
    ] {
        let row = format!("{GOOD}[uncaged]\nballs = 15\nturns = 1\n{more}\n");
        let error = parse(&row).unwrap_err();
        assert!(error.contains(field), "{more}: {error}");
    }
    for (from, to, field) in [
        ("turns = 2", "", "turns"),
        ("turns = 2", "turns = 2\nball_spacing = 0.4", "turns"),
        ("screw_length = 0.8", "", "screw_length"),
        ("turns = 2", "turns = 2\ncolour = 1", "colour"),
        ("turns = 2", "turns = 2\npitch_error = 1", "pitch_error"),
        ("turns = 2", "turns = 2\nloaded_end = \"top\"", "loaded_end"),
    ] {
        let loads = "[loads]\nscrew_length = 0.8\nscrew_diameter = 0.03\nnut_position = 0.4\naxial_load = 5000\nturns = 2\n";
        let table = format!("{GOOD}loaded_balls = 32\n{}", loads.replace(from, to));
        let error = parse(&table).unwrap_err();
        assert!(error.contains(field), "{to}: {error}");
    }
    for field in [
        "nominal_diameter",
        "lead",
        "ball_diameter",
        "conformity",
        "contact_angle",
    ] {
        let rest: String = GOOD
            .lines()
            .filter(|line| !line.starts_with(field))
            .flat_map(|line| [line, "\n"])
            .collect();
        let error = parse(&rest).unwrap_err();
        assert!(error.contains(field), "{field}: {error}");
    }
}

/// The file that explains every key shows the default steel: without its keys it is the same design.
#[test]
fn the_first_design_file_shows_the_default_material() {
    const TEXT: &str = include_str!("../../../designs/rack-29x7.toml");
    let material = ["youngs_modulus", "poisson_ratio", "density"];
    let (lines, rest): (Vec<&str>, Vec<&str>) = TEXT
        .lines()
        .partition(|line| material.iter().any(|key| line.starts_with(key)));
    assert_eq!(lines.len(), material.len());
    let [given, without] = [TEXT, &rest.join("\n")].map(|text| read(text, "rack").unwrap());
    assert_eq!(given.caged, without.caged);
}

/// A name is text of one line in one direction, and no longer than a line.
#[test]
fn a_name_is_a_line_of_text() {
    let design = parse(&format!("name = \"a\\u202Eb\\u001Bc\"\n{GOOD}")).unwrap();
    assert_eq!(design.name, "a b c");
    let error = parse(&format!("name = \"{}\"\n{GOOD}", "x".repeat(201))).unwrap_err();
    assert_eq!(error, "name has 201 letters; allowed: up to 200");
}
