//! Friction over temperature: the grease's film lowers the coefficient in the cold, and its drag rises.

use crate::measured::Usual;
use crate::measured::cold::{
    Friction, LEAST, LOADS, Lubricant, SPEEDS, STEERING, growth, over_temperature,
};

use epas_reference::error::ReferenceError;

use epas_page::document::{Block, Cell, Figure, Table};
use epas_page::failure::Failure;
use epas_page::plot::{Axis, Chart, Mark, Panel, Series};

/// Text, figure and table.
pub fn blocks(usual: &Usual, lubricant: &Lubricant) -> Result<Vec<Block>, Failure> {
    let failure = |error: ReferenceError| Failure::Data(error.to_string());
    let rows = over_temperature(usual, lubricant).map_err(failure)?;
    let least = growth(usual, lubricant, LEAST).map_err(failure)?;
    Ok(vec![
        Block::Text(text(&rows, least)),
        Block::Figure(picture(&rows)),
        Block::Annex(table(&rows)),
    ])
}

/// Torque at a state, N m.
fn at(rows: &[Friction], celsius: f64, speed: f64, load: f64) -> f64 {
    rows.iter()
        .find(|row| row.celsius == celsius && row.speed == speed && row.load == load)
        .map_or(f64::NAN, Friction::torque)
}

fn text(rows: &[Friction], least: f64) -> String {
    let growth = |speed: f64, load: f64| at(rows, -40.0, speed, load) / at(rows, 20.0, speed, load);
    let [_, loaded] = LOADS;
    format!(
        "Friction in the cold. Assumed, not measured: the screw {}, a grease with a poly-alpha-olefin of 48 mm2/s at 40 and 8 at 100 degrees Celsius (16 Pa s at \
         -40), a coefficient of 0.12 at standstill and 0.05 on a full film, 0.7 of the drag of flooded contacts (Biboulet and Houpert 2010) with SKF's inlet shear \
         heating. In the cold a film forms at lower speeds, which lowers the coefficient, and its drag rises. From 20 to -40 degrees friction \
         changes by a factor of {:.1} without load and {:.1} under 5 kN at 5 rad/s of the nut, {:.1} and {:.1} at 20 rad/s, and {:.1} and {:.1} at 1 rad/s; {least:.2} under 14 kN at 0.7 rad/s is the least. Above 5 rad/s the figures are upper bounds: the drag is that of contacts which lubricant \
         keeps supplied. Measured gears rise two- to threefold, by report; seals, yoke, churning and the yield stress of a grease are in them, and not in this figure.",
        STEERING.name,
        growth(5.0, 0.0),
        growth(5.0, loaded),
        growth(20.0, 0.0),
        growth(20.0, loaded),
        growth(1.0, 0.0),
        growth(1.0, loaded),
    )
}

fn picture(rows: &[Friction]) -> Figure {
    let panels = LOADS
        .iter()
        .map(|load| {
            let of = |row: &&Friction| row.load == *load;
            let mut series: Vec<Series> = SPEEDS
                .iter()
                .enumerate()
                .map(|(colour, speed)| {
                    let points = rows
                        .iter()
                        .filter(of)
                        .filter(|row| row.speed == *speed)
                        .map(|row| (row.celsius, row.torque()))
                        .collect();
                    Series::new(&format!("{speed} rad/s"), colour, Mark::Line, points)
                })
                .collect();
            series.extend(SPEEDS.iter().enumerate().map(|(colour, speed)| {
                let points = rows
                    .iter()
                    .filter(of)
                    .filter(|row| row.speed == *speed)
                    .map(|row| (row.celsius, row.grooves))
                    .collect();
                Series::new("", colour, Mark::Dashed, points)
            }));
            Panel::Chart(Chart {
                title: format!("{:.0} kN", 1e-3 * load),
                x: Axis::linear("temperature (C)"),
                y: Axis::linear("friction torque (N m)"),
                series,
                notes: Vec::new(),
            })
        })
        .collect();
    Figure {
        name: "cold",
        caption: format!(
            "Friction torque of a steering gear's screw ({}) over temperature; dashed: without the lubricant's drag. Assumed, not measured.",
            STEERING.name
        ),
        panels,
        columns: 2,
        size: (540, 460),
    }
}

fn table(rows: &[Friction]) -> Table {
    Table {
        name: "cold_friction",
        caption: "Friction of a steering gear's screw over temperature (N m): slip and spin of the grooves, drag of the lubricant".into(),
        columns: ["load (N)", "speed (rad/s)", "temperature (C)", "grooves", "drag"]
            .map(String::from)
            .to_vec(),
        rows: rows
            .iter()
            .map(|row| {
                vec![
                    Cell::fixed(row.load, 0),
                    Cell::fixed(row.speed, 0),
                    Cell::fixed(row.celsius, 0),
                    Cell::fixed(row.grooves, 4),
                    Cell::fixed(row.drag, 4),
                ]
            })
            .collect(),
    }
}
