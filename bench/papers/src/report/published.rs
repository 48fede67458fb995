//! Every printed number of the four papers beside the computed one.

use std::collections::BTreeMap;

use crate::published::{Printed, Record, Verdict, records};

use super::Context;
use epas_bench::report::draw::table;
use epas_page::document::{Block, Cell, Section, Table};
use epas_page::failure::Failure;

pub fn section(_: &Context) -> Result<Section, Failure> {
    let records = records()?;
    let (agreeing, rest): (Vec<&Record>, Vec<&Record>) = records
        .iter()
        .partition(|record| record.printed.verdict.agrees());
    Ok(Section {
        title: "Published and computed",
        blocks: vec![
            Block::Text(format!(
                "{} printed numbers of the four papers, computed again with the float64 reference: {} come out to their last \
                 digit or within the stated tolerance. The table \"published\" has them all; the {} that do not come \
                 first, and why. Run times and finite-element results are not computed again.",
                records.len(),
                agreeing.len(),
                rest.len(),
            )),
            Block::Table(counts(&records)),
            Block::Table(numbers(
                "published_open",
                "Misprints, and numbers that the text does not suffice for",
                &rest,
            )),
            Block::Annex(numbers(
                "published",
                "Every printed number that can be computed",
                &records.iter().collect::<Vec<_>>(),
            )),
        ],
    })
}

fn counts(records: &[Record]) -> Table {
    let mut counts: BTreeMap<&str, [f64; 4]> = BTreeMap::new();
    for record in records {
        let of_paper = counts.entry(&record.paper).or_default();
        for (count, verdict) in of_paper.iter_mut().zip(Verdict::ALL) {
            *count += f64::from(u8::from(record.printed.verdict == verdict));
        }
    }
    let rows = counts.into_iter().map(|(paper, counts)| {
        let counts = counts.map(|count| Cell::fixed(count, 0));
        std::iter::once(paper.into()).chain(counts).collect()
    });
    let columns = format!("paper | {}", Verdict::ALL.map(Verdict::name).join(" | "));
    let caption = "Printed numbers by verdict";
    table("published_counts", caption, &columns, rows.collect())
}

fn numbers(name: &'static str, caption: &str, records: &[&Record]) -> Table {
    let columns = "paper | place | quantity | unit | printed | computed | deviation | verdict | \
         why, or which convention";
    let rows = records.iter().map(|record| row(record)).collect();
    table(name, caption, columns, rows)
}

fn row(record: &Record) -> Vec<Cell> {
    let value = record.value();
    let (computed, deviation) = if !record.computed.is_finite() {
        ("".into(), "".into())
    } else if value == 0.0 {
        (shown(record), Cell::power(record.deviation()))
    } else {
        let percent = 100.0 * record.deviation() / value.abs();
        // One that rounding makes zero has no sign.
        let text = if percent.abs() < 5e-4 {
            "0.000 %".into()
        } else {
            format!("{percent:+.3} %")
        };
        (shown(record), Cell::Number(percent, text))
    };
    let Printed {
        quantity,
        unit,
        digits,
        verdict,
        reason,
        ..
    } = record.printed.clone();
    vec![
        record.paper.clone().into(),
        record.place.clone().into(),
        quantity.into(),
        unit.into(),
        Cell::Number(value, digits),
        computed,
        deviation,
        verdict.name().into(),
        reason.into(),
    ]
}

/// The computed number with one digit more than the printed one.
fn shown(record: &Record) -> Cell {
    let Record {
        printed, computed, ..
    } = record;
    let (mantissa, power) = printed.digits.split_once('e').unzip();
    let mantissa = mantissa.unwrap_or(&printed.digits);
    let decimals = mantissa.split_once('.').map_or(0, |(_, after)| after.len()) + 1;
    let text = match power.and_then(|power| power.parse().ok()) {
        Some(power) => format!("{:.decimals$}e{power}", computed / 10_f64.powi(power)),
        None if *computed == 0.0 => "0".into(),
        None if printed.digits == "0" => format!("{computed:.1e}"),
        None => format!("{computed:.decimals$}"),
    };
    Cell::Number(*computed, text)
}
