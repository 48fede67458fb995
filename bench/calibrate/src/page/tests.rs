use std::fs;

use tempfile::tempdir;

use super::*;
use crate::answer::Estimate;
use crate::page::picture::Correlations;

/// A trace of so many rows that the model explains but for a wave over the turn.
fn picture(rows: usize, coordinate: Coordinate) -> Picture {
    let time: Vec<f64> = (0..rows).map(|row| 0.01 * row as f64).collect();
    let of = |value: fn(f64) -> f64| -> Vec<f64> { time.iter().map(|at| value(*at)).collect() };
    let model = of(|at| 0.04 * (0.3 * at).sin().signum());
    let position = of(|at| 9.0 * (0.3 * at).sin());
    Picture {
        name: "weave <17>".into(),
        coordinate,
        measured: model
            .iter()
            .zip(&position)
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
                name: "friction".into(),
                unit: "",
                value: 0.115,
                low: 0.11,
                high: f64::INFINITY,
                fixed: false,
                at_bound: false,
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
    let picture = picture(6000, Coordinate::Rotation);
    document(&calibration(), &picture, &Truth::new(), true)
        .write(folder.path())
        .unwrap();
    let read = |name: &str| fs::read_to_string(folder.path().join(name)).unwrap();
    let html = read("report.html");
    // The parameters come first, and are open.
    let place = |text: &str| html.find(text).unwrap();
    assert!(place("table-parameters") < place("The model leaves a residual"));
    assert!(!html[..place("The model leaves a residual")].contains("class=\"long\""));
    assert!(html.contains("micro reversals") && html.contains("breakaway_angle"));
    // Nothing is loaded from elsewhere: links go to places of the page and to its files, the one address is the name of the
    // SVG format.
    let without_name = html.replace("http://www.w3.org/2000/svg", "");
    for link in ["http", "src=", "href=\"/", "stylesheet", "@import"] {
        assert!(!without_name.contains(link), "{link}");
    }
    assert!(html.contains("weave &lt;17&gt;"));
    let markdown = read("report.md");
    assert!(!markdown.contains("No model explains"));
    let mut lost = calibration();
    lost.models[0].relative_error_unseen = Some(1.3);
    assert!(doubt(&lost).unwrap().contains("leaves 130 % of the effort"));
    for text in [
        "| friction | 0.1150 | 0.1100 | inf |  | estimated |",
        "| gain | 1.000 |  |  |  | set |",
        "gain: the load does not vary",
        "| LuGre | 6 | 12.0 |  | 10.0 | 14.0 | 321.0 | ~120 |",
        "| friction | 1.000 | -0.970 |",
    ] {
        assert!(markdown.contains(text), "{text}\n{markdown}");
    }
    for name in ["trace_and_model", "residual", "spectrum"] {
        assert!(read(&format!("{name}.svg")).starts_with("<svg"), "{name}");
        assert!(read(&format!("{name}.csv")).lines().count() > 3, "{name}");
    }
    assert!(read("parameters.csv").lines().count() == 3);
}

/// The wave over the turn is what is left, and shows as a mean against the angle in the turn alone.
#[test]
fn what_is_left_shows_against_its_cause() {
    let picture = picture(6000, Coordinate::Rotation);
    let left: Vec<f64> = picture.residual().collect();
    let spread = |values: &[f64]| {
        let means = groups(values, &left);
        means.iter().map(|mean| mean.1.abs()).fold(0.0, f64::max)
    };
    let turned: Vec<f64> = picture
        .position
        .iter()
        .map(|at| at.rem_euclid(TAU))
        .collect();
    // A group is a fortieth of the turn: the wave's peak of 2e-3 is within 1 % of its mean there.
    assert!(spread(&turned) > 1.9e-3);
    assert!(spread(&picture.load.clone().unwrap()) < 1e-3);
}

#[test]
fn long_traces_are_thinned() {
    let folder = tempdir().unwrap();
    let long = picture(300_000, Coordinate::Translation);
    document(&calibration(), &long, &Truth::new(), false)
        .write(folder.path())
        .unwrap();
    let size = fs::metadata(folder.path().join("report.html"))
        .unwrap()
        .len();
    // 4 curves of at most 3600 points, 3 clouds of 1500 circles, 2 spectra of 2048 lines: below 100 bytes each.
    assert!(size < 2_500_000, "{size}");
}

#[test]
fn very_little_still_makes_a_page() {
    let folder = tempdir().unwrap();
    for rows in [0, 1, 2] {
        let mut little = picture(rows, Coordinate::Translation);
        little.correlations = Correlations::default();
        document(&calibration(), &little, &Truth::new(), false)
            .write(folder.path())
            .unwrap();
    }
}
