//! Errors over whole domains to their edges, with the request that reproduces each worst case; balls near
//! two-point contact; runs too long for every report.

mod maps;
mod recorded;
mod two_point;

use epas_reference::promises::PROMISES;

pub use recorded::errors as recorded_errors;

use super::Context;
use super::statistics::Errors;
use crate::report::draw::{figure, table};
use epas_page::document::{Block, Cell, Section, Table};
use epas_page::failure::Failure;

fn table_of_promises() -> Table {
    table(
        "promises",
        "What the functions of the loop promise; cycles of a Cortex-M4F, ceilings",
        "function | domain | error | largest | rms | mean | outside | NaN, infinities | cycles",
        PROMISES
            .all()
            .map(|promise| {
                vec![
                    promise.function.clone().into(),
                    promise.domain.clone().into(),
                    promise.error.clone().into(),
                    Cell::power(promise.largest),
                    Cell::power(promise.rms),
                    Cell::power(promise.mean),
                    promise.outside.clone().into(),
                    promise.not_finite.clone().into(),
                    Cell::fixed(f64::from(promise.cycles), 0),
                ]
            })
            .collect(),
    )
}

pub fn section(context: &Context) -> Result<Section, Failure> {
    let cells = if context.quick { 24 } else { 60 };
    let mut panels = Vec::new();
    let mut rows = Vec::new();
    let mut all = Errors::default();
    let mut requests = 0;
    for map in &maps::MAPS {
        let drawn = map.draw(cells)?;
        panels.push(drawn.panel);
        rows.push(drawn.row);
        requests += drawn.requests;
        all.add(drawn.largest);
    }
    let mut blocks = vec![
        Block::Text(
            "Errors over whole domains, to their edges: what is promised holds on the domain that the promise \
             names, a part of the map. The last column, in stability.csv, is a line for `epas eval` that reproduces the worst \
             case: the error is that between the values at the two places of its answer, over a third one of \
             the reference where one is named."
                .into(),
        ),
        Block::Table(table("stability", "Worst cases over the maps below. Apart from the inputs that are compared, points are counted that crate or reference \
                      refuse, those where the reference has no number or none that counts, and those where the crate alone has none", maps::COLUMNS, rows)),
        figure("stability_maps", "Errors of the formulas in f32 against the reference, from the same numbers; nothing is \
                      drawn where a request is refused or the quantity does not exist.", (3, 540, 420), panels),
    ];
    blocks.extend(two_point::blocks()?);
    blocks.extend(recorded::blocks(&all, requests)?);
    blocks.push(Block::Table(table_of_promises()));
    Ok(Section {
        title: "Stability",
        blocks,
    })
}
