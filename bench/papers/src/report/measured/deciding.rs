//! What decides the friction of a screw: friction coefficient and clearance, and the choice of both.

use crate::measured::studies::{CLEARANCES, Choice, DecidingRow, LOADS, TABLE_3_6};

use epas_bench::report::draw::{chart, figure, known, table};
use epas_page::document::{Block, Cell, Table};
use epas_page::plot::{Axis, Mark, Series};

pub fn blocks(rows: &[DecidingRow], choices: &[Choice]) -> Vec<Block> {
    vec![
        Block::Text(format!(
            "What decides the friction of a screw. One screw under one load has friction torques that differ several times over: first by the friction \
             coefficient, then by clearance. {} The coefficient counts about twice over, because friction also presses the third contact on that makes the \
             ball spin. Play counts because it opens that contact, and what remains is the closed form of a rolling ball; oversize counts at small loads, \
             where it loads all four contacts. Who knows neither should take the crate's defaults, expect the torque within a factor of two, and fit the friction \
             coefficient to one measured torque.",
            spans(rows)
        )),
        Block::Table(torques(rows)),
        picture(rows),
        Block::Text(
            "The defaults are a choice from the next table. The friction coefficient is fitted, to the rule of drag alone: 0.1. Of the clearances, 1 um of oversize \
             spreads least over screws and loads, lets efficiency rise with load, and lies between the rule of efficiency in theory and in practice; balls that \
             just fit come nearer to the theory, without drag where there is no load; 2 um weigh too much where loads are small."
                .into(),
        ),
        Block::Table(choice(choices)),
    ]
}

fn spans(rows: &[DecidingRow]) -> String {
    let at = |load: f64, friction: f64, clearance: f64| {
        let column = CLEARANCES.iter().position(|other| *other == clearance);
        rows.iter()
            .find(|row| row.load == load && row.friction == friction)
            .and_then(|row| row.torques.get(column?).copied())
            .unwrap_or(f64::NAN)
    };
    let closed = rows
        .iter()
        .find(|row| row.load == LOADS[1] && row.friction == 0.1)
        .map_or(f64::NAN, |row| row.closed);
    format!(
        "At {:.1} kN and clearance 0 it is {:.2} N m with a coefficient of 0.05, {:.2} with 0.1, {:.2} with 0.15; with 0.1 it is {:.2} with 5 um of \
         oversize, {:.2} with 5 um and {:.2} with 20 um of play, and {closed:.2} by the closed form.",
        1e-3 * LOADS[1],
        at(LOADS[1], 0.05, 0.0),
        at(LOADS[1], 0.1, 0.0),
        at(LOADS[1], 0.15, 0.0),
        at(LOADS[1], 0.1, -5.0),
        at(LOADS[1], 0.1, 5.0),
        at(LOADS[1], 0.1, 20.0),
    )
}

fn torques(rows: &[DecidingRow]) -> Table {
    let clearances = CLEARANCES.map(|clearance| format!("{clearance} um"));
    let clearances = clearances.join(" | ");
    let columns = format!("load (N) | friction | {clearances} | rolling ball, eq. (3)");
    let row = |row: &DecidingRow| {
        let mut cells = vec![Cell::fixed(row.load, 0), Cell::fixed(row.friction, 3)];
        cells.extend(row.torques.iter().map(|torque| known(*torque, 3)));
        cells.push(Cell::fixed(row.closed, 3));
        cells
    };
    let caption = format!(
        "What decides the friction of a screw: torque of the grooves of {} (N m), slip and spin by the exact model, over load, friction coefficient and \
         clearance (radial gap of every contact; oversize below zero)",
        TABLE_3_6.name
    );
    let rows = rows.iter().map(row).collect();
    table("what_decides", caption, &columns, rows)
}

fn picture(rows: &[DecidingRow]) -> Block {
    let panels = LOADS.map(|load| {
        let rows = rows.iter().filter(|row| row.load == load);
        let line = |(colour, row): (usize, &DecidingRow)| {
            let points = CLEARANCES.into_iter().zip(row.torques.iter().copied());
            let points = points.filter(|point| point.1.is_finite()).collect();
            let name = format!("friction {}", row.friction);
            Series::new(&name, colour, Mark::Line, points)
        };
        let x = Axis::linear("clearance (um)");
        let y = Axis::log("friction torque (N m)");
        let title = format!("{:.1} kN", 1e-3 * load);
        chart(&title, x, y, rows.enumerate().map(line).collect())
    });
    let caption = format!(
        "Friction torque of the grooves of {} over clearance, by the exact model.",
        TABLE_3_6.name
    );
    figure(
        "what_decides_picture",
        caption,
        (2, 540, 460),
        panels.into(),
    )
}

fn choice(choices: &[Choice]) -> Table {
    let row = |choice: &Choice| {
        vec![
            Cell::fixed(choice.friction, 3),
            Cell::fixed(1e6 * choice.clearance, 0),
            known(choice.over_rule, 2),
            known(choice.spread, 2),
            known(choice.over_drag, 2),
            known(choice.gain_with_load, 3),
        ]
    };
    let columns = "friction | clearance (um) | torque over the rule of efficiency in theory | \
         factor of spread | drag over the rule of drag | efficiency at 150 N less that at 15 N";
    table(
        "choice_of_defaults",
        "Choice of the defaults: friction torque over that of makers' rules, 125x10, 29x7, 32x10 and 33x20 at 15, 50 and 150 N a ball; drag with two nuts \
         under 25 N a ball, whose balls just fit. The rule of efficiency in practice means 2 to 5 times the torque of the rule in theory",
        columns,
        choices.iter().map(row).collect(),
    )
}
