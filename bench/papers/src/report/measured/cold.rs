//! Friction over temperature: the grease's film lowers the coefficient in the cold, and its drag rises.

use crate::measured::Usual;
use crate::measured::cold::{
    Friction, LEAST, LOADS, Lubricant, SPEEDS, STEERING, growth, over_temperature,
};

use epas_bench::report::draw::{chart, figure, table};
use epas_page::document::{Block, Cell, Table};
use epas_page::failure::Failure;
use epas_page::plot::{Axis, Mark, Series};

pub fn blocks(usual: &Usual, lubricant: &Lubricant) -> Result<Vec<Block>, Failure> {
    let rows = over_temperature(usual, lubricant)?;
    let least = growth(usual, lubricant, LEAST)?;
    Ok(vec![
        Block::Text(text(&rows, least)),
        picture(&rows),
        Block::Annex(torques(&rows)),
    ])
}

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

fn picture(rows: &[Friction]) -> Block {
    let panels = LOADS.map(|load| {
        let mut series = Vec::new();
        type Part = fn(&Friction) -> f64;
        for (mark, part) in [
            (Mark::Line, Friction::torque as Part),
            (Mark::Dashed, |row| row.grooves),
        ] {
            for (colour, speed) in SPEEDS.into_iter().enumerate() {
                let points = rows
                    .iter()
                    .filter(|row| row.load == load && row.speed == speed)
                    .map(|row| (row.celsius, part(row)));
                let name = if mark == Mark::Line {
                    format!("{speed} rad/s")
                } else {
                    String::new()
                };
                series.push(Series::new(&name, colour, mark, points.collect()));
            }
        }
        let x = Axis::linear("temperature (C)");
        let y = Axis::linear("friction torque (N m)");
        chart(&format!("{:.0} kN", 1e-3 * load), x, y, series)
    });
    let caption = format!(
        "Friction torque of a steering gear's screw ({}) over temperature; dashed: without the lubricant's drag. Assumed, not measured.",
        STEERING.name
    );
    figure("cold", caption, (2, 540, 460), panels.into())
}

fn torques(rows: &[Friction]) -> Table {
    let row = |row: &Friction| {
        vec![
            Cell::fixed(row.load, 0),
            Cell::fixed(row.speed, 0),
            Cell::fixed(row.celsius, 0),
            Cell::fixed(row.grooves, 4),
            Cell::fixed(row.drag, 4),
        ]
    };
    table(
        "cold_friction",
        "Friction of a steering gear's screw over temperature (N m): slip and spin of the grooves, drag of the lubricant",
        "load (N) | speed (rad/s) | temperature (C) | grooves | drag",
        rows.iter().map(row).collect(),
    )
}
