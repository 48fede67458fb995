//! The page of a calibration: what the trace tells, how well the model explains it, and what is left over against everything
//! that was measured.

use std::f64::consts::TAU;

use super::answer::{Calibration, Estimate, ModelScore};
use super::picture::{Picture, Profile};
use super::shown::digits;
use super::spectrum::welch;
use super::trace::Coordinate;
use crate::document::{Block, Cell, Document, Figure, Section, Table};
use crate::plot::{Axis, Chart, Mark, Panel, Series, thin};

/// Points of a cloud at the most: more of them cannot be told apart, and make a page slow.
const CLOUD: usize = 1500;

/// Groups of equal size whose means are drawn over a cloud.
const GROUPS: usize = 40;

/// Rise of minus twice the logarithm of the likelihood at the ends of a 95 % interval: that quantile of chi squared with one
/// degree of freedom.
const RISE: f64 = 3.841;

/// What quantities are called and measured in.
struct Words {
    effort: &'static str,
    unit: &'static str,
    speed: &'static str,
    position: &'static str,
    density: &'static str,
}

impl Words {
    const fn of(coordinate: Coordinate) -> Self {
        match coordinate {
            Coordinate::Rotation => Self {
                effort: "torque (N m)",
                unit: "N m",
                speed: "speed (rad/s)",
                position: "angle (rad)",
                density: "density (N² m²/Hz)",
            },
            Coordinate::Translation => Self {
                effort: "force (N)",
                unit: "N",
                speed: "speed (m/s)",
                position: "position (m)",
                density: "density (N²/Hz)",
            },
        }
    }
}

/// The page.
pub fn document(calibration: &Calibration, picture: &Picture) -> Document {
    let words = Words::of(picture.coordinate);
    let mut sections = vec![told(calibration, &words)];
    if !calibration.models.is_empty() {
        sections.push(models(calibration));
    }
    sections.push(Section {
        title: "Trace and model",
        blocks: vec![Block::Figure(over_time(picture, &words))],
    });
    sections.push(residual(picture, &words));
    if !picture.profiles.is_empty() {
        sections.push(profiles(&picture.profiles));
    }
    if !picture.correlations.names.is_empty() {
        sections.push(correlations(picture));
    }
    Document {
        title: format!("Calibration: {}", picture.name),
        sections,
    }
}

/// Parameters, and what the trace cannot tell.
fn told(calibration: &Calibration, words: &Words) -> Section {
    let mut blocks = vec![
        Block::Text(format!(
            "The model leaves a residual of {} {} rms, {} % of the effort's. {} rows count, with the correlation of the residual.",
            digits(calibration.residual_rms, 3),
            words.unit,
            digits(100.0 * calibration.relative_error, 3),
            digits(calibration.effective_rows.round(), 4),
        )),
        Block::Table(parameters(&calibration.parameters)),
    ];
    if !calibration.cannot_tell.is_empty() {
        blocks.push(Block::Text("What this trace cannot tell:".into()));
        blocks.extend(calibration.cannot_tell.iter().cloned().map(Block::Text));
    }
    Section {
        title: "What the trace tells",
        blocks,
    }
}

fn parameters(estimates: &[Estimate]) -> Table {
    let number = |value: f64| Cell::Number(value, digits(value, 4));
    let rows = estimates.iter().map(|estimate| {
        let mut row = vec![Cell::from(estimate.name.as_str()), number(estimate.value)];
        row.extend(if estimate.fixed {
            [Cell::from(""), Cell::from("")]
        } else {
            [number(estimate.low), number(estimate.high)]
        });
        row.push(estimate.unit.into());
        row.push(if estimate.fixed { "set" } else { "estimated" }.into());
        row
    });
    Table {
        name: "parameters",
        caption: "Parameters with their 95 % intervals".into(),
        columns: ["parameter", "value", "low", "high", "unit", "origin"]
            .map(String::from)
            .into(),
        rows: rows.collect(),
    }
}

/// Models of friction beside each other.
fn models(calibration: &Calibration) -> Section {
    let best = match &calibration.winner {
        Some(name) => format!("Best on what was not fitted: {name}."),
        None => "No model was tried on anything that was not fitted.".into(),
    };
    Section {
        title: "Models compared",
        blocks: vec![Block::Text(best), Block::Table(scores(&calibration.models))],
    }
}

fn scores(models: &[ModelScore]) -> Table {
    let percent = |value: f64| Cell::Number(value, digits(100.0 * value, 3));
    let rows = models.iter().map(|model| {
        vec![
            model.name.as_str().into(),
            Cell::fixed(model.parameters as f64, 0),
            percent(model.relative_error),
            model.relative_error_unseen.map_or("".into(), percent),
            percent(model.relative_error_inverse),
            model
                .relative_error_inverse_unseen
                .map_or("".into(), percent),
            Cell::fixed(model.information_criterion, 1),
            model.cycles.map_or("".into(), |cycles| {
                let sign = if model.cycles_estimated { "~" } else { "" };
                Cell::Number(cycles.into(), format!("{sign}{cycles}"))
            }),
        ]
    });
    Table {
        name: "models",
        caption: "Models of friction on the same trace: error of the effort, rms, over the effort, in the closed loop where its \
                  controller is known; the same of the regression's rows; information criterion less the least one; modelled \
                  cycles of one tick, ~ where they are estimated"
            .into(),
        columns: [
            "model",
            "parameters",
            "error, fitted (%)",
            "error, not fitted (%)",
            "rows, fitted (%)",
            "rows, not fitted (%)",
            "information criterion",
            "cycles",
        ]
        .map(String::from)
        .into(),
        rows: rows.collect(),
    }
}

fn chart(title: &str, x: &str, y: &str, series: Vec<Series>) -> Panel {
    Panel::Chart(Chart {
        title: title.into(),
        x: Axis::linear(x),
        y: Axis::linear(y),
        series,
        notes: Vec::new(),
    })
}

/// A list over time, thinned to what a picture can show.
fn curve(time: &[f64], values: &[f64]) -> Vec<(f64, f64)> {
    let rows: Vec<(f64, f64)> = time.iter().copied().zip(values.iter().copied()).collect();
    thin(&rows, &|row| row.0, &|row| row.1)
}

fn over_time(picture: &Picture, words: &Words) -> Figure {
    let residual: Vec<f64> = picture.residual().collect();
    let line = |name: &str, colour, values: &[f64]| {
        Series::new(name, colour, Mark::Line, curve(&picture.time, values))
    };
    let time = "time (s)";
    let mut panels = vec![
        chart(
            &picture.name,
            time,
            words.effort,
            vec![
                line("measured", 0, &picture.measured),
                line("model", 1, &picture.model),
            ],
        ),
        chart(
            "",
            time,
            &format!("residual ({})", words.unit),
            vec![line("", 3, &residual)],
        ),
        chart("", time, words.speed, vec![line("", 2, &picture.speed)]),
    ];
    for (label, values) in [
        ("axial load (N)", &picture.load),
        ("temperature (K)", &picture.temperature),
    ] {
        if let Some(values) = values {
            panels.push(chart("", time, label, vec![line("", 2, values)]));
        }
    }
    Figure {
        name: "trace_and_model",
        caption: "Trace and model over time, both filtered without a shift".into(),
        panels,
        columns: 1,
        size: (1000, 270),
    }
}

/// The residual against everything that was measured, and its spectrum.
fn residual(picture: &Picture, words: &Words) -> Section {
    let residual: Vec<f64> = picture.residual().collect();
    let mut quantities = vec![(words.speed, picture.speed.clone())];
    quantities.extend(picture.load.clone().map(|load| ("axial load (N)", load)));
    quantities.push((words.position, picture.position.clone()));
    if picture.coordinate == Coordinate::Rotation {
        let turned = picture.position.iter().map(|angle| angle.rem_euclid(TAU));
        quantities.push(("angle in the turn (rad)", turned.collect()));
    }
    let temperature = picture.temperature.clone();
    quantities.extend(temperature.map(|temperature| ("temperature (K)", temperature)));
    let label = format!("residual ({})", words.unit);
    let panels: Vec<_> = quantities
        .iter()
        .map(|(name, values)| {
            let series = vec![
                Series::new("rows", 5, Mark::Circles, cloud(values, &residual)),
                Series::new("mean of a group", 1, Mark::Line, groups(values, &residual)),
            ];
            chart("", name, &label, series)
        })
        .collect();
    let mut blocks = vec![
        Block::Text(
            "What a model leaves out shows here as a mean that is not zero: a slope over speed is drag, over load a wrong \
             coefficient or gain, a wave over the turn an error of the screw."
                .into(),
        ),
        Block::Figure(Figure {
            name: "residual",
            caption: format!(
                "Residual against what was measured; means of {GROUPS} groups of equal size"
            ),
            panels,
            columns: 2,
            size: (560, 320),
        }),
    ];
    blocks.extend(spectrum(picture, &residual, words).map(Block::Figure));
    Section {
        title: "Residual",
        blocks,
    }
}

fn spectrum(picture: &Picture, residual: &[f64], words: &Words) -> Option<Figure> {
    let step = picture.step()?;
    let points = |values: &[f64]| -> Vec<(f64, f64)> {
        let lines = welch(values, step).into_iter();
        lines.filter(|(_, density)| *density > 0.0).collect()
    };
    let left = points(residual);
    (!left.is_empty()).then(|| Figure {
        name: "spectrum",
        caption: "Power spectral density by Welch's method".into(),
        panels: vec![Panel::Chart(Chart {
            title: String::new(),
            x: Axis::log("frequency (Hz)"),
            y: Axis::log(words.density),
            series: vec![
                Series::new("measured", 0, Mark::Line, points(&picture.measured)),
                Series::new("residual", 3, Mark::Line, left),
            ],
            notes: Vec::new(),
        })],
        columns: 1,
        size: (1000, 360),
    })
}

/// Every so many rows, so that few are left.
fn cloud(x: &[f64], y: &[f64]) -> Vec<(f64, f64)> {
    let stride = x.len().div_ceil(CLOUD).max(1);
    let rows = x.iter().copied().zip(y.iter().copied());
    rows.step_by(stride)
        .filter(|(x, y)| x.is_finite() && y.is_finite())
        .collect()
}

/// Means of groups of equal size along `x`.
fn groups(x: &[f64], y: &[f64]) -> Vec<(f64, f64)> {
    let mut rows: Vec<(f64, f64)> = x
        .iter()
        .copied()
        .zip(y.iter().copied())
        .filter(|(x, y)| x.is_finite() && y.is_finite())
        .collect();
    rows.sort_by(|one, other| one.0.total_cmp(&other.0));
    let size = rows.len().div_ceil(GROUPS).max(1);
    rows.chunks(size)
        .map(|group| {
            let count = group.len() as f64;
            let (x, y) = group
                .iter()
                .fold((0.0, 0.0), |sum, row| (sum.0 + row.0, sum.1 + row.1));
            (x / count, y / count)
        })
        .collect()
}

fn profiles(profiles: &[Profile]) -> Section {
    let panels = profiles.iter().map(|profile| {
        let label = if profile.unit.is_empty() {
            profile.name.clone()
        } else {
            format!("{} ({})", profile.name, profile.unit)
        };
        let (low, high) = profile
            .points
            .iter()
            .fold((profile.best, profile.best), |ends, point| {
                (ends.0.min(point.0), ends.1.max(point.0))
            });
        chart(
            "",
            &label,
            "rise of -2 log likelihood",
            vec![
                Series::new("profile", 0, Mark::Line, profile.points.clone()),
                Series::new("95 %", 6, Mark::Dashed, vec![(low, RISE), (high, RISE)]),
                Series::new("fitted", 1, Mark::Crosses, vec![(profile.best, 0.0)]),
            ],
        )
    });
    Section {
        title: "Profiles",
        blocks: vec![Block::Figure(Figure {
            name: "profiles",
            caption: "How much worse the trace is explained with a parameter held, and all others fitted again; a parabola \
                      is a normal distribution"
                .into(),
            panels: panels.collect(),
            columns: 2,
            size: (560, 300),
        })],
    }
}

fn correlations(picture: &Picture) -> Section {
    let correlations = &picture.correlations;
    let rows = correlations.names.iter().zip(&correlations.rows);
    let rows = rows.map(|(name, row)| {
        let mut cells = vec![Cell::from(name.as_str())];
        cells.extend(row.iter().map(|value| Cell::fixed(*value, 3)));
        cells
    });
    let mut columns = vec![String::new()];
    columns.extend(correlations.names.iter().cloned());
    Section {
        title: "Correlations",
        blocks: vec![
            Block::Text(
                "Two parameters whose errors correlate by more than 0.95 are told together, hardly each by itself.".into(),
            ),
            Block::Table(Table {
                name: "correlations",
                caption: "Correlations of the parameters' errors".into(),
                columns,
                rows: rows.collect(),
            }),
        ],
    }
}

#[cfg(test)]
mod tests {
    use std::fs;

    use tempfile::tempdir;

    use super::super::picture::Correlations;
    use super::*;

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
            profiles: vec![Profile {
                name: "friction".into(),
                unit: String::new(),
                best: 0.115,
                points: vec![(0.10, 9.0), (0.115, 0.0), (0.13, 9.0)],
            }],
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
        document(&calibration(), &picture)
            .write(folder.path())
            .unwrap();
        let read = |name: &str| fs::read_to_string(folder.path().join(name)).unwrap();
        let html = read("report.html");
        // Nothing is loaded from elsewhere; the one address is the name of the SVG format.
        let without_name = html.replace("http://www.w3.org/2000/svg", "");
        for link in ["http", "src=", "href=", "<script"] {
            assert!(!without_name.contains(link), "{link}");
        }
        assert!(html.contains("weave &lt;17&gt;"));
        let markdown = read("report.md");
        for text in [
            "| friction | 0.1150 | 0.1100 | inf |  | estimated |",
            "| gain | 1.000 |  |  |  | set |",
            "gain: the load does not vary",
            "| LuGre | 6 | 12.0 |  | 10.0 | 14.0 | 321.0 | ~120 |",
            "| friction | 1.000 | -0.970 |",
        ] {
            assert!(markdown.contains(text), "{text}\n{markdown}");
        }
        for name in ["trace_and_model", "residual", "spectrum", "profiles"] {
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
        document(&calibration(), &long)
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
            little.profiles.clear();
            document(&calibration(), &little)
                .write(folder.path())
                .unwrap();
        }
    }
}
