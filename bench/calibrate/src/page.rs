//! The page of a calibration: what the trace tells, how well the model explains it, and what is left over against everything
//! that was measured.
//!
//! | module | what |
//! |---|---|
//! | [`picture`] | what the page draws, as plain data |
//! | [`shown`] | numbers as they are shown |
//! | [`truth`] | what a synthetic trace was made with |
//! | [`table`] | parameters, and manoeuvres that identify them |

pub mod picture;
pub mod shown;
pub mod table;
pub mod truth;

use std::f64::consts::TAU;

use crate::answer::{Calibration, ModelScore};
use crate::page::picture::Picture;
use crate::page::shown::digits;
use crate::page::truth::Truth;
use crate::signals::spectrum::welch;
use crate::trace::Coordinate;
use epas_page::document::{Block, Cell, Document, Figure, Section, Table};
use epas_page::plot::{Axis, Chart, Mark, Panel, Series, thin};

/// Points of a cloud at the most: more of them cannot be told apart, and make a page slow.
const CLOUD: usize = 1500;

/// Groups of equal size whose means are drawn over a cloud.
const GROUPS: usize = 40;

/// Error over the effort from which on a model explains nothing.
const WORTHLESS: f64 = 0.5;

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
pub fn document(
    calibration: &Calibration,
    picture: &Picture,
    truth: &Truth,
    with_design: bool,
) -> Document {
    let words = Words::of(picture.coordinate);
    let mut sections = vec![told(calibration, truth, &words)];
    if !calibration.models.is_empty() {
        sections.push(models(calibration));
    }
    sections.push(Section {
        title: "Trace and model",
        blocks: vec![Block::Figure(over_time(picture, &words))],
    });
    sections.push(residual(picture, &words));
    if !picture.correlations.names.is_empty() {
        sections.push(correlations(picture));
    }
    if with_design {
        sections.push(table::manoeuvres());
    }
    Document::of(format!("Calibration: {}", picture.name), sections)
}

/// Parameters, and what the trace cannot tell.
fn told(calibration: &Calibration, truth: &Truth, words: &Words) -> Section {
    let mut blocks = vec![
        Block::Answer(table::parameters(&calibration.parameters, truth)),
        Block::Text(format!(
            "The model leaves a residual of {} {} rms, {} % of the effort's. {} rows count, with the correlation of the residual.",
            digits(calibration.residual_rms, 3),
            words.unit,
            digits(100.0 * calibration.relative_error, 3),
            digits(calibration.effective_rows.round(), 4),
        )),
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

/// Models of friction beside each other.
fn models(calibration: &Calibration) -> Section {
    let best = match &calibration.winner {
        Some(name) => format!("Best on what was not fitted: {name}."),
        None => "No model was tried on anything that was not fitted.".into(),
    };
    let mut blocks = vec![Block::Text(best)];
    blocks.extend(doubt(calibration).map(Block::Text));
    blocks.push(Block::Table(scores(&calibration.models)));
    Section {
        title: "Models compared",
        blocks,
    }
}

/// What is said of a comparison in which even the best model explains little.
fn doubt(calibration: &Calibration) -> Option<String> {
    let best = calibration
        .models
        .iter()
        .filter_map(|model| model.relative_error_unseen)
        .min_by(f64::total_cmp)?;
    (best > WORTHLESS).then(|| {
        format!(
            "No model explains the trace: the best one leaves {} % of the effort, and their order says nothing. Check units, load and controller.",
            digits(100.0 * best, 3)
        )
    })
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
                Series::new("rows", 5, Mark::Dots, cloud(values, &residual)),
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
mod tests;
