//! The page of a folder of traces.

use super::population::Together;
use super::store::{Parameter, Told};
use crate::page::shown::digits;
use crate::sums::Population;
use epas_page::document::{Block, Cell, Document, Figure, Section, Table};
use epas_page::plot::{Axis, Chart, Mark, Panel, Series};

/// The page: population, outliers, every trace.
pub fn document(together: &Together) -> Document {
    let told = together.told().count();
    let refused = together.traces.len() - told;
    let mut first = vec![Block::Text(format!(
        "{told} of {} traces tell something; {refused} were refused.",
        together.traces.len()
    ))];
    if !together.population.is_empty() {
        first.push(Block::Table(population(
            "population",
            "All traces: mean with its 95 % interval, standard deviation between traces beyond their own errors, and the \
             interval that holds the next one",
            &together.population,
        )));
    }
    if !together.without_outliers.is_empty() {
        first.push(Block::Table(population(
            "population_without_outliers",
            "The same without the traces that stand out",
            &together.without_outliers,
        )));
    }
    let mut sections = vec![Section {
        title: "What the traces tell together",
        blocks: first,
    }];
    if !together.outliers.is_empty() {
        sections.push(Section {
            title: "Traces that stand out",
            blocks: vec![Block::Table(outliers(together))],
        });
    }
    if told > 0 {
        sections.push(Section {
            title: "Every trace",
            blocks: vec![
                Block::Figure(by_trace(together)),
                Block::Annex(every_parameter(together)),
            ],
        });
    }
    if refused > 0 {
        sections.push(Section {
            title: "Refused traces",
            blocks: vec![Block::Table(Table {
                name: "refused",
                caption: "Traces that were not fitted".into(),
                columns: ["trace", "reason"].map(String::from).into(),
                rows: together
                    .refused()
                    .map(|(trace, word)| vec![trace.into(), word.into()])
                    .collect(),
            })],
        });
    }
    Document::of("Calibration of a folder".into(), sections)
}

/// A number with four digits.
fn number(value: f64) -> Cell {
    Cell::Number(value, digits(value, 4))
}

/// A number, or nothing.
fn perhaps(value: Option<f64>) -> Cell {
    value.map_or("".into(), number)
}

fn population(name: &'static str, caption: &str, population: &[Population]) -> Table {
    let rows = population.iter().map(|parameter| {
        let [low, high] = parameter.mean_interval;
        vec![
            parameter.name.as_str().into(),
            Cell::fixed(parameter.traces as f64, 0),
            number(parameter.mean),
            number(low),
            number(high),
            perhaps(parameter.spread),
            perhaps(parameter.next.map(|next| next[0])),
            perhaps(parameter.next.map(|next| next[1])),
        ]
    });
    Table {
        name,
        caption: caption.into(),
        columns: [
            "parameter",
            "traces",
            "mean",
            "low",
            "high",
            "spread",
            "next, low",
            "next, high",
        ]
        .map(String::from)
        .into(),
        rows: rows.collect(),
    }
}

fn outliers(together: &Together) -> Table {
    let rows = together.outliers.iter().map(|out| {
        vec![
            out.trace.as_str().into(),
            out.parameter.as_str().into(),
            number(out.value),
            number(out.median),
            Cell::fixed(out.deviations, 1),
        ]
    });
    Table {
        name: "outliers",
        caption: "Parameters more than five standard deviations from the median of all traces"
            .into(),
        columns: ["trace", "parameter", "value", "median", "deviations"]
            .map(String::from)
            .into(),
        rows: rows.collect(),
    }
}

fn every_parameter(together: &Together) -> Table {
    let row = |trace: &str, parameter: &Parameter| {
        vec![
            trace.into(),
            parameter.name.as_str().into(),
            perhaps(parameter.value),
            perhaps(parameter.low),
            perhaps(parameter.high),
            parameter.unit.as_str().into(),
        ]
    };
    let estimated = |told: &Told| -> Vec<Parameter> {
        let parameters = told.parameters.iter();
        parameters
            .filter(|parameter| !parameter.fixed)
            .cloned()
            .collect()
    };
    let rows = together.told().flat_map(|(trace, told)| {
        let parameters = estimated(told);
        parameters
            .iter()
            .map(|parameter| row(trace, parameter))
            .collect::<Vec<_>>()
    });
    Table {
        name: "traces",
        caption: "Estimated parameters of every trace with their 95 % intervals".into(),
        columns: ["trace", "parameter", "value", "low", "high", "unit"]
            .map(String::from)
            .into(),
        rows: rows.collect(),
    }
}

/// Every parameter by the number of its trace, with the mean of all.
fn by_trace(together: &Together) -> Figure {
    let panels = together.population.iter().map(|parameter| {
        let values: Vec<(f64, f64)> = together
            .told()
            .enumerate()
            .filter_map(|(index, (_, told))| {
                let own = told
                    .parameters
                    .iter()
                    .find(|own| own.name == parameter.name);
                Some((index as f64 + 1.0, own?.value?))
            })
            .collect();
        let last = values.last().map_or(1.0, |point| point.0);
        let mean = vec![(1.0, parameter.mean), (last.max(2.0), parameter.mean)];
        Panel::Chart(Chart {
            title: String::new(),
            x: Axis::linear("trace"),
            y: Axis::linear(&parameter.name),
            series: vec![
                Series::new("trace", 0, Mark::Circles, values),
                Series::new("mean", 1, Mark::Dashed, mean),
            ],
            notes: Vec::new(),
        })
    });
    Figure {
        name: "by_trace",
        caption: "Parameters of every trace, in the order of their names".into(),
        panels: panels.collect(),
        columns: 2,
        size: (560, 280),
    }
}
