//! The page of a folder of traces.

use super::Together;
use super::population::Population;
use crate::page::shown::{chart, number, perhaps, table};
use epas_page::document::{Block, Cell, Document, Figure, Section, Table};
use epas_page::plot::{Axis, Mark, Series};

pub fn document(together: &Together) -> Document {
    let told = together.told().count();
    let refused = together.traces.len() - told;
    let mut first = vec![Block::Text(format!(
        "{told} of {} traces tell something; {refused} were refused.",
        together.traces.len()
    ))];
    let mut shown = |name, caption, rows: &[Population]| {
        if !rows.is_empty() {
            first.push(Block::Table(population(name, caption, rows)));
        }
    };
    shown(
        "population",
        "All traces: mean with its 95 % interval, standard deviation between traces beyond their own errors, and the interval \
         that holds the next one",
        &together.population,
    );
    shown(
        "population_without_outliers",
        "The same without the traces that stand out",
        &together.without_outliers,
    );
    let mut sections = Vec::new();
    let mut add = |title, blocks| sections.push(Section { title, blocks });
    add("What the traces tell together", first);
    if !together.outliers.is_empty() {
        add(
            "Traces that stand out",
            vec![Block::Table(outliers(together))],
        );
    }
    if told > 0 {
        let figure = Block::Figure(by_trace(together));
        let all = Block::Annex(every_parameter(together));
        add("Every trace", vec![figure, all]);
    }
    if refused > 0 {
        let refused = table(
            "refused",
            "Traces that were not fitted",
            "trace | reason",
            together
                .refused()
                .map(|(trace, word)| vec![trace.into(), word.into()]),
        );
        add("Refused traces", vec![Block::Table(refused)]);
    }
    Document::of("Calibration of a folder".into(), sections)
}

fn population(name: &'static str, caption: &str, population: &[Population]) -> Table {
    let row = |parameter: &Population| {
        let [low, high] = parameter.mean_interval.map(number);
        vec![
            parameter.name.as_str().into(),
            Cell::fixed(parameter.traces as f64, 0),
            number(parameter.mean),
            low,
            high,
            perhaps(parameter.spread),
            perhaps(parameter.next.map(|next| next[0])),
            perhaps(parameter.next.map(|next| next[1])),
        ]
    };
    let columns = "parameter | traces | mean | low | high | spread | next, low | next, high";
    table(name, caption, columns, population.iter().map(row))
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
    table(
        "outliers",
        "Parameters more than five standard deviations from the median of all traces",
        "trace | parameter | value | median | deviations",
        rows,
    )
}

fn every_parameter(together: &Together) -> Table {
    let rows = together.told().flat_map(|(trace, told)| {
        told.estimates().map(move |(name, entry)| {
            let ends = ["value", "low", "high"].map(|key| perhaps(entry[key].as_f64()));
            let mut row = vec![trace.into(), name.into()];
            row.extend(ends);
            row.push(entry["unit"].as_str().unwrap_or_default().into());
            row
        })
    });
    table(
        "traces",
        "Estimated parameters of every trace with their 95 % intervals",
        "trace | parameter | value | low | high | unit",
        rows,
    )
}

/// Every parameter by the number of its trace, with the mean of all.
fn by_trace(together: &Together) -> Figure {
    let panels = together.population.iter().map(|parameter| {
        let told = together.told().enumerate();
        let values: Vec<(f64, f64)> = told
            .filter_map(|(index, (_, told))| {
                let mut own = told.estimates().filter(|(name, _)| *name == parameter.name);
                Some((index as f64 + 1.0, own.next()?.1["value"].as_f64()?))
            })
            .collect();
        let last = values.last().map_or(1.0, |point| point.0).max(2.0);
        let mean = vec![(1.0, parameter.mean), (last, parameter.mean)];
        let series = vec![
            Series::new("trace", 0, Mark::Circles, values),
            Series::new("mean", 1, Mark::Dashed, mean),
        ];
        chart(
            "",
            Axis::linear("trace"),
            Axis::linear(&parameter.name),
            series,
        )
    });
    Figure {
        name: "by_trace",
        caption: "Parameters of every trace, in the order of their names".into(),
        panels: panels.collect(),
        columns: 2,
        size: (560, 280),
    }
}
