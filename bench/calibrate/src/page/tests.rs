use std::fs;

use tempfile::tempdir;

use super::*;

/// A trace of so many rows that the model explains but for a wave over the turn.
fn picture(rows: usize, coordinate: Coordinate) -> Picture {
    let time: Vec<f64> = (0..rows).map(|row| 0.01 * row as f64).collect();
    let of = |value: fn(f64) -> f64| -> Vec<f64> { time.iter().map(|at| value(*at)).collect() };
    let model = of(|at| 0.04 * (0.3 * at).sin().signum());
    let position = of(|at| 9.0 * (0.3 * at).sin());
    let left = model.iter().zip(&position);
    Picture {
        name: "weave <17>".into(),
        coordinate,
        measured: left
            .map(|(model, angle)| model + 2e-3 * angle.sin())
            .collect(),
        model,
        speed: of(|at| 2.7 * (0.3 * at).cos()),
        position,
        load: Some(of(|at| 1000.0 * (7.3 * at).sin())),
        temperature: None,
        correlations: Correlations {
            names: vec!["friction".into(), "preload".into()],
            rows: vec![vec![1.0, -0.97], vec![-0.97, 1.0]],
        },
        time,
    }
}

fn calibration() -> Calibration {
    Calibration {
        parameters: vec![
            Estimate {
                low: 0.11,
                high: f64::INFINITY,
                fixed: false,
                ..Estimate::fixed("friction", "", 0.115)
            },
            Estimate::fixed("gain", "", 1.0),
        ],
        residual_rms: 1.4e-3,
        relative_error: 0.04,
        effective_rows: 1234.5,
        cannot_tell: vec!["gain: the load does not vary; measure at two loads.".into()],
        models: vec![ModelScore {
            name: "LuGre".into(),
            relative_error: 0.12,
            relative_error_unseen: None,
            relative_error_inverse: 0.1,
            relative_error_inverse_unseen: Some(0.14),
            position_error: None,
            residual_unseen: None,
            information_criterion: 321.0,
            parameters: 6,
            cycles: Some(120),
            cycles_estimated: true,
            values: Vec::new(),
        }],
        winner: None,
    }
}

#[test]
fn a_page_stands_by_itself() {
    let folder = tempdir().unwrap();
    let truth = Truth::from([("friction".into(), 0.1)]);
    document(
        &calibration(),
        &picture(6000, Coordinate::Rotation),
        &truth,
        true,
    )
    .write(folder.path())
    .unwrap();
    let read = |name: &str| fs::read_to_string(folder.path().join(name)).unwrap();
    let html = read("report.html");
    // The parameters come first, and are open.
    let place = |text: &str| html.find(text).unwrap();
    assert!(place("table-parameters") < place("The model leaves a residual"));
    assert!(!html[..place("The model leaves a residual")].contains("class=\"long\""));
    assert!(html.contains("weave &lt;17&gt;"));
    // Nothing is loaded from elsewhere: the one address is the name of the SVG format.
    let without_name = html.replace("http://www.w3.org/2000/svg", "");
    for link in ["http", "src=", "href=\"/", "stylesheet", "@import"] {
        assert!(!without_name.contains(link), "{link}");
    }
    let markdown = read("report.md");
    assert!(!markdown.contains("No model explains"));
    for text in [
        "| friction | 0.1150 | 0.1100 | inf |  | estimated | 0.1000 | no |",
        "| gain | 1.000 |  |  |  | set |  |  |",
        "gain: the load does not vary",
        "| LuGre | 6 | 12.0 |  | 10.0 | 14.0 | 321.0 | ~120 |",
        "| friction | 1.000 | -0.970 |",
        "| micro reversals | reversals at rest by 0.5 to 4 times the pre-sliding travel, 0.8 times a second | breakaway_angle, ",
    ] {
        assert!(markdown.contains(text), "{text}\n{markdown}");
    }
    for name in ["trace_and_model", "residual"] {
        assert!(read(&format!("{name}.svg")).starts_with("<svg"), "{name}");
        assert!(read(&format!("{name}.csv")).lines().count() > 3, "{name}");
    }
    let mut lost = calibration();
    lost.models[0].relative_error_unseen = Some(1.3);
    assert!(doubt(&lost).unwrap().contains("leaves 130 % of the effort"));
}

/// The wave over the turn is what is left, and shows as a mean against the angle in the turn alone.
#[test]
fn what_is_left_shows_against_its_cause() {
    let picture = picture(6000, Coordinate::Rotation);
    let spread = |values: &[f64]| {
        let means = groups(rows(values, &picture.residual())).into_iter();
        means.map(|mean| mean.1.abs()).fold(0.0, f64::max)
    };
    let turned = picture.position.iter().map(|at| at.rem_euclid(TAU));
    // A group is a fortieth of the turn: the wave's peak of 2e-3 is within 1 % of its mean there.
    assert!(spread(&turned.collect::<Vec<_>>()) > 1.9e-3);
    assert!(spread(picture.load.as_ref().unwrap()) < 1e-3);
}

/// Of any length a trace makes a page, and of 300,000 rows a small one: 4 curves of at most 3600 points, 3 clouds of 1500 circles, 2
/// spectra of 2048 lines, below 100 bytes each.
#[test]
fn pages_of_any_length_are_small() {
    let folder = tempdir().unwrap();
    for rows in [0, 1, 2, 300_000] {
        let picture = Picture {
            correlations: Correlations::default(),
            ..picture(rows, Coordinate::Translation)
        };
        let page = document(&calibration(), &picture, &Truth::new(), false);
        page.write(folder.path()).unwrap();
        let size = fs::metadata(folder.path().join("report.html"))
            .unwrap()
            .len();
        assert!(size < 2_500_000, "{size}");
    }
}
