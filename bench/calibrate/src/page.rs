//! The page of a calibration: what the trace tells, how well the model explains it, and what is left over against everything
//! that was measured.

pub mod picture;
pub(crate) mod shown;
pub(crate) mod truth;

use std::f64::consts::TAU;

use crate::answer::{Calibration, Estimate, ModelScore};
use crate::experiment::manoeuvre::{MANOEUVRES, Manoeuvre};
use crate::page::picture::{Correlations, Picture};
use crate::page::shown::{chart, digits, number, table};
use crate::page::truth::Truth;
use crate::steady::{Run, Steady};
use crate::trace::Coordinate;
use epas_page::document::{Block, Cell, Document, Figure, Section, Table};
use epas_page::plot::{Axis, Mark, Panel, Series, thin};

/// Points of a cloud at the most: more of them cannot be told apart, and make a page slow.
const CLOUD: usize = 1500;

/// Groups of equal size whose means are drawn over a cloud.
const GROUPS: usize = 40;

/// Error over the effort from which on a model explains nothing.
const WORTHLESS: f64 = 0.5;

struct Words([&'static str; 4]);

impl Words {
    const fn of(coordinate: Coordinate) -> Self {
        Self(match coordinate {
            Coordinate::Rotation => ["torque", "N m", "angle", "rad"],
            Coordinate::Translation => ["force", "N", "position", "m"],
        })
    }
}

pub(crate) fn document(
    calibration: &Calibration,
    picture: &Picture,
    truth: &Truth,
    with_design: bool,
) -> Document {
    let words = Words::of(picture.coordinate);
    let of = |title, blocks| Section { title, blocks };
    let mut sections = vec![of("What the trace tells", told(calibration, truth, &words))];
    if !calibration.models.is_empty() {
        sections.push(of("Models compared", models(calibration)));
    }
    let over_time = Block::Figure(over_time(picture, &words));
    sections.push(of("Trace and model", vec![over_time]));
    sections.push(of("Residual", residual(picture, &words)));
    if !picture.correlations.names.is_empty() {
        let note = "Two parameters whose errors correlate by more than 0.95 are told together, hardly each by itself.";
        let table = Block::Table(correlations(&picture.correlations));
        sections.push(of("Correlations", vec![Block::Text(note.into()), table]));
    }
    if with_design {
        let note = "For a parameter that this trace does not tell: `calibrate --wanted NAME --design ...` ranks these by the interval that each would give.";
        let table = Block::Table(manoeuvres());
        sections.push(of("Manoeuvres", vec![Block::Text(note.into()), table]));
    }
    Document::of(format!("Calibration: {}", picture.name), sections)
}

pub(crate) fn of_runs(steady: &Steady, name: &str) -> Document {
    let words = Words::of(steady.coordinate);
    let Words([effort, unit, _, length]) = words;
    let points = |of: fn(&Run) -> f64| steady.runs.iter().map(|run| (run.speed, of(run))).collect();
    let series = vec![
        Series::new("runs", 0, Mark::Dots, points(|run| run.effort)),
        Series::new("numbers", 1, Mark::Line, points(|run| run.model)),
    ];
    let figure = Figure {
        name: "friction_over_speed",
        caption: "Mean effort of each run, without the load's, over its speed".into(),
        panels: vec![linear(
            name,
            &format!("speed ({length}/s)"),
            &format!("{effort} ({unit})"),
            series,
        )],
        columns: 1,
        size: (1000, 400),
    };
    let rows = steady.runs.iter().map(|run| {
        let values = [run.speed, run.effort, run.effort - run.model].map(number);
        [run.name.as_str().into()]
            .into_iter()
            .chain(values)
            .collect()
    });
    let runs = table(
        "runs",
        "Runs, each one row of the regression",
        &format!("run | speed ({length}/s) | {effort} ({unit}) | not explained ({unit})"),
        rows,
    );
    let of = |title, blocks| Section { title, blocks };
    let sections = vec![
        of(
            "What the runs tell",
            told(&steady.answer, &Truth::new(), &words),
        ),
        of(
            "Friction over speed",
            vec![Block::Figure(figure), Block::Table(runs)],
        ),
    ];
    Document::of(format!("Calibration: {name}"), sections)
}

fn told(calibration: &Calibration, truth: &Truth, words: &Words) -> Vec<Block> {
    let mut blocks = vec![
        Block::Answer(parameters(&calibration.parameters, truth)),
        Block::Text(format!(
            "The model leaves a residual of {} {} rms, {} % of the effort's. They count as {} independent samples.",
            digits(calibration.residual_rms, 3),
            words.0[1],
            digits(100.0 * calibration.relative_error, 3),
            digits(calibration.effective_rows.round(), 4),
        )),
    ];
    if !calibration.cannot_tell.is_empty() {
        blocks.push(Block::Text("What this trace cannot tell:".into()));
        blocks.extend(calibration.cannot_tell.iter().cloned().map(Block::Text));
    }
    blocks
}

fn parameters(estimates: &[Estimate], truth: &Truth) -> Table {
    let row = |estimate: &Estimate| {
        let Estimate {
            value, low, high, ..
        } = *estimate;
        let (ends, origin) = match (estimate.fixed, estimate.at_bound) {
            (true, _) => ([Cell::from(""), Cell::from("")], "set"),
            (false, true) => ([number(low), number(high)], "at its bound"),
            (false, false) => ([number(low), number(high)], "estimated"),
        };
        let mut row = vec![estimate.name.as_str().into(), number(value)];
        row.extend(ends);
        row.extend([estimate.unit, origin].map(Cell::from));
        if !truth.is_empty() {
            let known = truth.get(&estimate.name);
            let held = match known.map(|truth| (low..=high).contains(truth)) {
                Some(held) if !estimate.fixed => ["no", "yes"][usize::from(held)],
                _ => "",
            };
            row.extend([shown::perhaps(known.copied()), held.into()]);
        }
        row
    };
    let mut table = table(
        "parameters",
        "Parameters with their 95 % intervals",
        "parameter | value | low | high | unit | origin",
        estimates.iter().map(row),
    );
    if !truth.is_empty() {
        table.caption += ", beside what the synthetic trace was made with";
        table
            .columns
            .extend(["truth", "in the interval"].map(String::from));
    }
    table
}

fn models(calibration: &Calibration) -> Vec<Block> {
    let best = match &calibration.winner {
        Some(name) => format!("Best on what was not fitted: {name}."),
        None => "No model was tried on anything that was not fitted.".into(),
    };
    let mut blocks = vec![Block::Text(best)];
    blocks.extend(doubt(calibration).map(Block::Text));
    blocks.push(Block::Table(scores(&calibration.models)));
    blocks
}

/// What is said of a comparison in which even the best model explains little.
fn doubt(calibration: &Calibration) -> Option<String> {
    let unseen = calibration.models.iter();
    let best = unseen
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
    let percent = |value: Option<f64>| {
        value.map_or("".into(), |value| {
            Cell::Number(value, digits(100.0 * value, 3))
        })
    };
    let rows = models.iter().map(|model| {
        vec![
            model.name.as_str().into(),
            Cell::fixed(model.parameters as f64, 0),
            percent(Some(model.relative_error)),
            percent(model.relative_error_unseen),
            percent(Some(model.relative_error_inverse)),
            percent(model.relative_error_inverse_unseen),
            Cell::fixed(model.information_criterion, 1),
            model.cycles.map_or("".into(), |cycles| {
                let sign = if model.cycles_estimated { "~" } else { "" };
                Cell::Number(cycles.into(), format!("{sign}{cycles}"))
            }),
        ]
    });
    table(
        "models",
        "Models of friction on the same trace: error of the effort, rms, over the effort, in the closed loop where its \
         controller is known; the same of the regression's rows; information criterion less the least one; modelled \
         cycles of one tick, ~ where they are estimated",
        "model | parameters | error, fitted (%) | error, not fitted (%) | rows, fitted (%) | rows, not fitted (%) | information criterion | cycles",
        rows,
    )
}

fn linear(title: &str, x: &str, y: &str, series: Vec<Series>) -> Panel {
    chart(title, Axis::linear(x), Axis::linear(y), series)
}

fn over_time(picture: &Picture, words: &Words) -> Figure {
    let Words([effort, unit, _, length]) = words;
    let line = |name: &str, colour, values: &[f64]| {
        let time = picture.time.iter().copied();
        let rows: Vec<(f64, f64)> = time.zip(values.iter().copied()).collect();
        let points = thin(&rows, &|row| row.0, &|row| row.1);
        Series::new(name, colour, Mark::Line, points)
    };
    let panel = |title: &str, y: &str, series| linear(title, "time (s)", y, series);
    let both = vec![
        line("measured", 0, &picture.measured),
        line("model", 1, &picture.model),
    ];
    let left = vec![line("", 3, &picture.residual())];
    let mut panels = vec![
        panel(&picture.name, &format!("{effort} ({unit})"), both),
        panel("", &format!("residual ({unit})"), left),
        panel(
            "",
            &format!("speed ({length}/s)"),
            vec![line("", 2, &picture.speed)],
        ),
    ];
    for (label, values) in [
        ("axial load (N)", &picture.load),
        ("temperature (K)", &picture.temperature),
    ] {
        panels.extend(
            values
                .as_deref()
                .map(|values| panel("", label, vec![line("", 2, values)])),
        );
    }
    Figure {
        name: "trace_and_model",
        caption: "Trace and model over time, both filtered without a shift".into(),
        panels,
        columns: 1,
        size: (1000, 270),
    }
}

fn residual(picture: &Picture, words: &Words) -> Vec<Block> {
    let residual = picture.residual();
    let turn = picture.position.iter().map(|angle| angle.rem_euclid(TAU));
    let turn: Option<Vec<f64>> =
        (picture.coordinate == Coordinate::Rotation).then(|| turn.collect());
    let Words([_, unit, position, length]) = words;
    let label = format!("residual ({unit})");
    let panels = [
        (format!("speed ({length}/s)"), Some(&picture.speed)),
        ("axial load (N)".into(), picture.load.as_ref()),
        (format!("{position} ({length})"), Some(&picture.position)),
        ("angle in the turn (rad)".into(), turn.as_ref()),
        ("temperature (K)".into(), picture.temperature.as_ref()),
    ]
    .into_iter()
    .filter_map(|(name, values)| {
        let rows = rows(values?, &residual);
        let stride = rows.len().div_ceil(CLOUD).max(1);
        let cloud = rows.iter().copied().step_by(stride).collect();
        let series = vec![
            Series::new("rows", 5, Mark::Dots, cloud),
            Series::new("mean of a group", 1, Mark::Line, groups(rows)),
        ];
        Some(linear("", &name, &label, series))
    });
    let note = "What a model leaves out shows here as a mean that is not zero: a slope over speed is drag, over load a wrong \
                coefficient or gain, a wave over the turn an error of the screw.";
    let blocks = vec![
        Block::Text(note.into()),
        Block::Figure(Figure {
            name: "residual",
            caption: format!(
                "Residual against what was measured; means of {GROUPS} groups of equal size"
            ),
            panels: panels.collect(),
            columns: 2,
            size: (560, 320),
        }),
    ];
    blocks
}

fn rows(x: &[f64], y: &[f64]) -> Vec<(f64, f64)> {
    let rows = x.iter().copied().zip(y.iter().copied());
    rows.filter(|(x, y)| x.is_finite() && y.is_finite())
        .collect()
}

/// Means of groups of equal size along the first number.
fn groups(mut rows: Vec<(f64, f64)>) -> Vec<(f64, f64)> {
    rows.sort_by(|one, other| one.0.total_cmp(&other.0));
    let size = rows.len().div_ceil(GROUPS).max(1);
    let mean = |group: &[(f64, f64)]| {
        let sum = group
            .iter()
            .fold((0.0, 0.0), |sum, row| (sum.0 + row.0, sum.1 + row.1));
        (sum.0 / group.len() as f64, sum.1 / group.len() as f64)
    };
    rows.chunks(size).map(mean).collect()
}

fn correlations(correlations: &Correlations) -> Table {
    let rows = correlations.names.iter().zip(&correlations.rows);
    let rows = rows.map(|(name, row)| {
        let values = row.iter().map(|value| Cell::fixed(*value, 3));
        [Cell::from(name.as_str())]
            .into_iter()
            .chain(values)
            .collect()
    });
    let mut table = table(
        "correlations",
        "Correlations of the parameters' errors",
        "",
        rows,
    );
    table.columns.extend(correlations.names.iter().cloned());
    table
}

fn manoeuvres() -> Table {
    let row = |of: Manoeuvre| {
        let identifies = of.identifies.replace(' ', ", ");
        vec![of.name.into(), of.how.into(), identifies.into()]
    };
    table(
        "manoeuvres",
        "What each manoeuvre identifies: a parameter stands with the two whose 95 % intervals are narrowest on a rack-assist gear",
        "manoeuvre | how | identifies",
        MANOEUVRES.into_iter().map(row),
    )
}

#[cfg(test)]
mod tests;
