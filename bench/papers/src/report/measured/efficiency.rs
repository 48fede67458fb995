//! Efficiency over lead and load: the exact model, the papers' closed forms, makers' rules.

use crate::measured::catalogue;
use crate::measured::studies::{EfficiencyRow, FIT_LOAD};
use epas_reference::friction::ball_screw_efficiency::ScrewFriction;

use super::known::known;
use epas_page::document::{Block, Cell, Figure, Table};
use epas_page::plot::{Axis, Chart, Mark, Panel, Series};

/// Diameter of the screws that differ in nothing but their lead, mm.
const ONE_DIAMETER: f64 = 32.0;

/// Table and figure.
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
        Block::Table(table(rows)),
        Block::Figure(picture(rows)),
    ]
}

fn table(rows: &[EfficiencyRow]) -> Table {
    Table {
        name: "efficiency_over_lead",
        caption: format!(
            "Efficiency of driving over lead and load, with the crate's defaults. The rule in theory means a friction torque of 2.86e-3 of load \
             times diameter; in practice {} of its efficiency. Friction coefficient and clearance that meet the rule in theory are sought one at a time, at \
             {FIT_LOAD} N a ball",
            catalogue::PRACTICE
        ),
        columns: [
            "screw",
            "lead angle (deg)",
            "load a ball (N)",
            "exact",
            "contacts",
            "torque/(load diameter) (1e-3)",
            "rolling ball, eq. (3)",
            "sliding ball, eq. (14)",
            "rule in theory",
            "rule in practice",
            "friction for the rule",
            "clearance for the rule (um)",
        ]
        .map(String::from)
        .to_vec(),
        rows: rows
            .iter()
            .map(|row| {
                let found = row.exact.as_ref().ok();
                vec![
                    Cell::from(row.size.name),
                    Cell::fixed(row.size.design().lead_angle().to_degrees(), 2),
                    Cell::fixed(row.ball_load, 0),
                    known(found.map_or(f64::NAN, ScrewFriction::efficiency), 3),
                    known(
                        found.map_or(f64::NAN, |friction| friction.contacts() as f64),
                        0,
                    ),
                    known(1e3 * row.torque_over_diameter(), 2),
                    Cell::fixed(row.rolling, 3),
                    Cell::fixed(row.sliding, 3),
                    Cell::fixed(row.rule, 3),
                    Cell::fixed(catalogue::PRACTICE * row.rule, 3),
                    known(row.friction_for_rule.unwrap_or(f64::NAN), 3),
                    known(1e6 * row.clearance_for_rule.unwrap_or(f64::NAN), 1),
                ]
            })
            .collect(),
    }
}

fn picture(rows: &[EfficiencyRow]) -> Figure {
    let of = |load: f64, value: &dyn Fn(&EfficiencyRow) -> f64| -> Vec<(f64, f64)> {
        rows.iter()
            .filter(|row| row.size.diameter == ONE_DIAMETER && row.ball_load == load)
            .map(|row| (row.size.lead, value(row)))
            .filter(|point| point.1.is_finite())
            .collect()
    };
    let exact = |row: &EfficiencyRow| {
        let found = row.exact.as_ref();
        found.map_or(f64::NAN, ScrewFriction::efficiency)
    };
    let mut series: Vec<Series> = [30.0, 100.0, 300.0]
        .iter()
        .zip([Mark::Circles, Mark::Triangles, Mark::Line])
        .map(|(load, mark)| {
            Series::new(
                &format!("exact, {load} N a ball"),
                0,
                mark,
                of(*load, &exact),
            )
        })
        .collect();
    series.push(Series::new(
        "rolling ball, eq. (3)",
        1,
        Mark::Line,
        of(FIT_LOAD, &|row| row.rolling),
    ));
    series.push(Series::new(
        "sliding ball, eq. (14)",
        2,
        Mark::Line,
        of(FIT_LOAD, &|row| row.sliding),
    ));
    series.push(Series::new(
        "maker's rule, theory",
        3,
        Mark::Line,
        of(FIT_LOAD, &|row| row.rule),
    ));
    series.push(Series::new(
        "maker's rule, practice",
        4,
        Mark::Line,
        of(FIT_LOAD, &|row| catalogue::PRACTICE * row.rule),
    ));
    Figure {
        name: "efficiency_over_lead_picture",
        caption: "Efficiency of driving over the lead of a screw of 32 mm with balls of 4.762 mm: the exact model with the crate's defaults, the closed forms \
                  with the same friction coefficient, and a maker's rule."
            .into(),
        panels: vec![Panel::Chart(Chart {
            title: "Efficiency over lead".into(),
            x: Axis::linear("lead (mm)").between(0.0, 66.0),
            y: Axis::linear("efficiency").between(0.76, 1.0),
            series,
            notes: Vec::new(),
        })],
        columns: 1,
        size: (760, 480),
    }
}
