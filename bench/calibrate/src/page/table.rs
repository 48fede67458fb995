//! Tables of a calibration's page: parameters, and manoeuvres that identify them.

use crate::answer::Estimate;
use crate::experiment::manoeuvre::Manoeuvre;
use crate::page::shown::digits;
use crate::page::truth::Truth;
use epas_page::document::{Block, Cell, Section, Table};

/// Parameters with their intervals, and the truth beside them where it is known.
pub fn parameters(estimates: &[Estimate], truth: &Truth) -> Table {
    let number = |value: f64| Cell::Number(value, digits(value, 4));
    let rows = estimates.iter().map(|estimate| {
        let mut row = vec![Cell::from(estimate.name.as_str()), number(estimate.value)];
        row.extend(if estimate.fixed {
            [Cell::from(""), Cell::from("")]
        } else {
            [number(estimate.low), number(estimate.high)]
        });
        row.push(estimate.unit.into());
        let origin = match (estimate.fixed, estimate.at_bound) {
            (true, _) => "set",
            (false, true) => "at its bound",
            (false, false) => "estimated",
        };
        row.push(origin.into());
        if !truth.is_empty() {
            row.extend(beside(estimate, truth.get(&estimate.name)));
        }
        row
    });
    let mut columns: Vec<String> = ["parameter", "value", "low", "high", "unit", "origin"]
        .map(String::from)
        .into();
    let mut caption = "Parameters with their 95 % intervals".to_owned();
    if !truth.is_empty() {
        columns.extend(["truth", "in the interval"].map(String::from));
        caption += ", beside what the synthetic trace was made with";
    }
    Table {
        name: "parameters",
        caption,
        columns,
        rows: rows.collect(),
    }
}

/// The true value, and whether the interval holds it.
fn beside(estimate: &Estimate, truth: Option<&f64>) -> [Cell; 2] {
    let Some(&truth) = truth else {
        return [Cell::from(""), Cell::from("")];
    };
    let held = match (
        estimate.fixed,
        (estimate.low..=estimate.high).contains(&truth),
    ) {
        (true, _) => "",
        (false, true) => "yes",
        (false, false) => "no",
    };
    [Cell::Number(truth, digits(truth, 4)), Cell::from(held)]
}

/// Which manoeuvre identifies what.
pub fn manoeuvres() -> Section {
    let rows = Manoeuvre::ALL.into_iter().map(|manoeuvre| {
        vec![
            Cell::from(manoeuvre.name()),
            Cell::from(manoeuvre.how()),
            Cell::from(manoeuvre.identifies().join(", ").as_str()),
        ]
    });
    Section {
        title: "Manoeuvres",
        blocks: vec![
            Block::Text(
                "For a parameter that this trace does not tell: `calibrate --wanted NAME --design ...` ranks these by the interval that each would give."
                    .into(),
            ),
            Block::Table(Table {
                name: "manoeuvres",
                caption: "What each manoeuvre identifies: a parameter stands with the two whose 95 % intervals are narrowest on a rack-assist gear"
                    .into(),
                columns: ["manoeuvre", "how", "identifies"].map(String::from).into(),
                rows: rows.collect(),
            }),
        ],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_truth_stands_beside_what_was_found() {
        let estimate = Estimate {
            low: 0.11,
            high: 0.12,
            fixed: false,
            ..Estimate::fixed("friction", "", 0.115)
        };
        let none = parameters(std::slice::from_ref(&estimate), &Truth::new());
        assert_eq!(none.columns.len(), 6);
        for (value, held) in [(0.115, "yes"), (0.13, "no")] {
            let truth = Truth::from([("friction".to_owned(), value)]);
            let table = parameters(std::slice::from_ref(&estimate), &truth);
            assert_eq!(table.columns.len(), table.rows[0].len());
            assert!(matches!(&table.rows[0][7], Cell::Text(text) if text == held));
        }
    }
}
