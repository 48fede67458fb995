//! Every printed number of the four papers beside the computed one.

use crate::published::records;
use crate::record::{Paper, Record, Verdict};

use super::context::Context;
use epas_page::document::{Block, Cell, Section, Table};
use epas_page::failure::Failure;

/// The section.
pub fn section(_: &Context) -> Result<Section, Failure> {
    let records = records().map_err(|error| Failure::Data(error.to_string()))?;
    let rest: Vec<_> = records
        .iter()
        .filter(|record| {
            matches!(
                record.verdict,
                Verdict::Misprint(_) | Verdict::NotReproducible(_)
            )
        })
        .collect();
    Ok(Section {
        title: "Published and computed",
        blocks: vec![
            Block::Text(format!(
                "{} printed numbers of the four papers, computed again with the float64 reference: {} come out to their last \
                 digit or within the stated tolerance. The table \"published\" has them all; the {} that do not come \
                 first, and why. Run times and finite-element results are not computed again.",
                records.len(),
                records.iter().filter(|record| record.agrees()).count(),
                rest.len(),
            )),
            Block::Table(counts(&records)),
            Block::Table(table(
                "published_open",
                "Misprints, and numbers that the text does not suffice for",
                &rest,
            )),
            Block::Annex(table(
                "published",
                "Every printed number that can be computed",
                &records.iter().collect::<Vec<_>>(),
            )),
        ],
    })
}

fn counts(records: &[Record]) -> Table {
    let rows = Paper::ALL
        .iter()
        .map(|paper| {
            let mut counts = [0; 4];
            for record in records.iter().filter(|record| record.paper == *paper) {
                let column = match record.verdict {
                    Verdict::Reproduces => 0,
                    Verdict::Convention(_) => 1,
                    Verdict::Misprint(_) => 2,
                    Verdict::NotReproducible(_) => 3,
                };
                counts[column] += 1;
            }
            let mut cells = vec![Cell::from(paper.name())];
            cells.extend(counts.map(|count| Cell::fixed(f64::from(count), 0)));
            cells
        })
        .collect();
    Table {
        name: "published_counts",
        caption: "Printed numbers by verdict".into(),
        columns: [
            "paper",
            "reproduces",
            "reproduces with stated convention",
            "misprint",
            "not reproducible",
        ]
        .map(String::from)
        .to_vec(),
        rows,
    }
}

fn table(name: &'static str, caption: &str, records: &[&Record]) -> Table {
    let rows = records
        .iter()
        .map(|record| {
            let printed = record.printed_value();
            let known = record.computed.is_finite();
            let (computed, deviation) = if known {
                (
                    Cell::Number(record.computed, digits(record)),
                    if printed == 0.0 {
                        Cell::power(record.deviation())
                    } else {
                        let percent = 100.0 * record.deviation() / printed.abs();
                        percent_cell(percent)
                    },
                )
            } else {
                ("".into(), "".into())
            };
            vec![
                Cell::from(record.paper.name()),
                record.place.clone().into(),
                record.quantity.clone().into(),
                record.unit.into(),
                Cell::Number(printed, record.printed.clone()),
                computed,
                deviation,
                record.verdict.name().into(),
                record.verdict.reason().into(),
            ]
        })
        .collect();
    Table {
        name,
        caption: caption.into(),
        columns: [
            "paper",
            "place",
            "quantity",
            "unit",
            "printed",
            "computed",
            "deviation",
            "verdict",
            "why, or which convention",
        ]
        .map(String::from)
        .to_vec(),
        rows,
    }
}

/// A deviation in per cent with its sign; one that rounding makes zero has none.
fn percent_cell(percent: f64) -> Cell {
    if percent.abs() < 5e-4 {
        Cell::Number(percent, "0.000 %".into())
    } else {
        Cell::Number(percent, format!("{percent:+.3} %"))
    }
}

/// The computed number with one digit more than the printed one.
fn digits(record: &Record) -> String {
    let (mantissa, power) = record
        .printed
        .split_once('e')
        .map_or((record.printed.as_str(), None), |(mantissa, power)| {
            (mantissa, power.parse::<i32>().ok())
        });
    let decimals = mantissa.split_once('.').map_or(0, |(_, after)| after.len()) + 1;
    match power {
        Some(power) => format!(
            "{:.decimals$}e{power}",
            record.computed / 10_f64.powi(power)
        ),
        None if record.computed == 0.0 => "0".into(),
        None if record.printed == "0" => format!("{:.1e}", record.computed),
        None => format!("{:.decimals$}", record.computed),
    }
}
