//! Efficiency over lead and load: the exact model, the papers' closed forms, makers' rules.

use crate::measured::catalogue;
use crate::measured::studies::{EfficiencyRow, FIT_LOAD};
use epas_reference::friction::ball_screw_efficiency::ScrewFriction;

use epas_bench::report::draw::{chart, figure, known, table};
use epas_page::document::{Block, Cell, Table};
use epas_page::plot::{Axis, Mark, Series};

/// Diameter of the screws that differ in nothing but their lead, mm.
const ONE_DIAMETER: f64 = 32.0;

pub fn blocks(rows: &[EfficiencyRow]) -> Vec<Block> {
    vec![
        Block::Text(
            "Makers print an efficiency that falls with the lead: friction is much the same torque at every lead, and a small lead makes little \
             torque of a load. In the exact model that torque is spin: a third light contact holds the ball, so that it spins in its two main contacts \
             whatever the lead. The closed form of a rolling ball leaves spin out; its friction is slip along the helix, which falls with the lead as the \
             torque of the load does, and its efficiency is the same for every lead. At large leads slip along the helix comes on top of spin, and the \
             model lies below the rule; under heavy loads and small leads the third contact no longer holds the ball, and it lies above."
                .into(),
        ),
        Block::Table(efficiencies(rows)),
        picture(rows),
    ]
}

/// Efficiency by the exact model; NaN where it has no answer.
fn exact(row: &EfficiencyRow) -> f64 {
    row.exact
        .as_ref()
        .map_or(f64::NAN, ScrewFriction::efficiency)
}

fn efficiencies(rows: &[EfficiencyRow]) -> Table {
    let row = |row: &EfficiencyRow| {
        let contacts = row.exact.as_ref().map(ScrewFriction::contacts);
        vec![
            Cell::from(row.size.name),
            Cell::fixed(row.size.design().lead_angle().to_degrees(), 2),
            Cell::fixed(row.ball_load, 0),
            known(exact(row), 3),
            known(contacts.map_or(f64::NAN, |contacts| contacts as f64), 0),
            known(1e3 * row.torque_over_diameter(), 2),
            Cell::fixed(row.rolling, 3),
            Cell::fixed(row.sliding, 3),
            Cell::fixed(row.rule, 3),
            Cell::fixed(catalogue::PRACTICE * row.rule, 3),
            known(row.friction_for_rule.unwrap_or(f64::NAN), 3),
            known(1e6 * row.clearance_for_rule.unwrap_or(f64::NAN), 1),
        ]
    };
    let columns = "screw | lead angle (deg) | load a ball (N) | exact | contacts | \
         torque/(load diameter) (1e-3) | rolling ball, eq. (3) | sliding ball, eq. (14) | \
         rule in theory | rule in practice | friction for the rule | clearance for the rule (um)";
    let caption = format!(
        "Efficiency of driving over lead and load, with the crate's defaults. The rule in theory means a friction torque of 2.86e-3 of load \
         times diameter; in practice {} of its efficiency. Friction coefficient and clearance that meet the rule in theory are sought one at a time, at \
         {FIT_LOAD} N a ball",
        catalogue::PRACTICE
    );
    let rows = rows.iter().map(row).collect();
    table("efficiency_over_lead", caption, columns, rows)
}

type Line = (&'static str, usize, Mark, f64, fn(&EfficiencyRow) -> f64);

const LINES: [Line; 7] = [
    ("exact, 30 N a ball", 0, Mark::Circles, 30.0, exact),
    ("exact, 100 N a ball", 0, Mark::Triangles, 100.0, exact),
    ("exact, 300 N a ball", 0, Mark::Line, 300.0, exact),
    ("rolling ball, eq. (3)", 1, Mark::Line, FIT_LOAD, |row| {
        row.rolling
    }),
    ("sliding ball, eq. (14)", 2, Mark::Line, FIT_LOAD, |row| {
        row.sliding
    }),
    ("maker's rule, theory", 3, Mark::Line, FIT_LOAD, |row| {
        row.rule
    }),
    ("maker's rule, practice", 4, Mark::Line, FIT_LOAD, |row| {
        catalogue::PRACTICE * row.rule
    }),
];

fn picture(rows: &[EfficiencyRow]) -> Block {
    let line = |(name, colour, mark, load, value): Line| {
        let points = rows
            .iter()
            .filter(|row| row.size.diameter == ONE_DIAMETER && row.ball_load == load)
            .map(|row| (row.size.lead, value(row)))
            .filter(|point| point.1.is_finite());
        Series::new(name, colour, mark, points.collect())
    };
    let x = Axis::linear("lead (mm)").between(0.0, 66.0);
    let y = Axis::linear("efficiency").between(0.76, 1.0);
    let panel = chart("Efficiency over lead", x, y, LINES.map(line).into());
    figure(
        "efficiency_over_lead_picture",
        "Efficiency of driving over the lead of a screw of 32 mm with balls of 4.762 mm: the exact model with the crate's defaults, the closed forms \
         with the same friction coefficient, and a maker's rule.",
        (1, 760, 480),
        vec![panel],
    )
}
