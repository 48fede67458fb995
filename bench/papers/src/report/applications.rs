//! Applications of the static model (Lin 2019, chapter 4) and what it costs.

use std::time::Instant;

use crate::load_studies::lash::{LashCurves, LashTest, Pattern, range, spread};
use crate::load_studies::scaling::long_nut;
use crate::load_studies::tie_rod::{TieRodLoad, TieRodLoads};
use crate::load_studies::waviness::{Waviness, compare};
use epas_reference::statics::cases::CaseStudy;

use super::context::Context;
use epas_page::document::{Block, Cell, Figure, Section, Table};
use epas_page::failure::Failure;
use epas_page::plot::{Axis, Chart, Mark, Panel, Series};
use epas_page::progress::Progress;

/// Oversize of the balls' radius in the lash tests, m, which the text does not print.
const OVERSIZE: f64 = 2e-6;
/// Tie-rod angles, degrees; the text names the first and the last.
const TIE_ROD_ANGLES: [f64; 4] = [0.0, 6.0, 12.0, 18.0];
/// Amplitude of pitch and roundness error, m.
const AMPLITUDE: f64 = 5e-6;
/// Balls of the ball screws that are timed.
const TRAINS: [usize; 6] = [32, 64, 125, 250, 500, 1000];

fn failed(error: impl std::fmt::Display) -> Failure {
    Failure::Data(error.to_string())
}

/// The section.
pub fn section(context: &Context) -> Result<Section, Failure> {
    let steps = if context.quick { 5 } else { 21 };
    let progress = Progress::new(
        "static loads",
        Pattern::ALL.len() * steps + TIE_ROD_ANGLES.len() + Waviness::ALL.len() + TRAINS.len(),
    );
    let tick = || {
        progress.step();
        true
    };
    let test = LashTest {
        steps,
        ..LashTest::table_4_1(OVERSIZE)
    };
    let curves = test.curves(&tick).map_err(failed)?;
    let rack = TieRodLoad::default();
    let turned = rack
        .over(&TIE_ROD_ANGLES.map(f64::to_radians), &tick)
        .map_err(failed)?;
    let waves = compare(&CaseStudy::table_4_1(), AMPLITUDE, &tick).map_err(failed)?;
    let cost = cost(context.quick, &progress)?;
    Ok(Section {
        title: "Applications of the static loads",
        blocks: vec![
            Block::Text(
                "Lin 2019, chapter 4, by the float64 reference. The text leaves parameters out, so that its \
                 numbers are to be compared in kind: balls 2 um larger than fit and a lateral force of 10 N \
                 at the far end in the lash tests, balls on the track as Figure 4.2 shows them; a screw of \
                 28 mm; for the rack the ball screw of Table 4.1, the four-point bearing of Table 4.2 around \
                 its nut, and a pinion 0.65 m from the end, beyond which nothing reaches the nut."
                    .into(),
            ),
            Block::Table(in_kind(&test, &curves, &turned, &waves)),
            Block::Figure(figure_4_3(&curves)),
            Block::Figure(figure_4_5(&turned)),
            Block::Table(cost),
        ],
    })
}

/// Spread between ball patterns of the axial displacement over the range of the force, of the lateral
/// displacement at its end, and of that over the range, per cent.
fn spreads(curves: &[LashCurves]) -> [f64; 3] {
    let of = |pick: fn(&LashCurves) -> f64| {
        let values: Vec<f64> = curves.iter().map(pick).collect();
        100.0 * spread(&values)
    };
    [
        of(|curves| range(&curves.axial)),
        of(|curves| curves.conical.last().map_or(f64::NAN, |point| point.1)),
        of(|curves| range(&curves.conical)),
    ]
}

fn in_kind(
    test: &LashTest,
    curves: &[LashCurves],
    turned: &[TieRodLoads],
    waves: &[(Waviness, epas_reference::statics::StaticSolution)],
) -> Table {
    let [axial, conical, conical_range] = spreads(curves);
    let grows = |body: usize| match (turned.first(), turned.last()) {
        (Some(first), Some(last)) => last.largest()[body] / first.largest()[body],
        _ => f64::NAN,
    };
    let lost = |error: Waviness| {
        waves
            .iter()
            .find(|(other, _)| *other == error)
            .map_or(f64::NAN, |(_, loads)| loads.balls_lost as f64)
    };
    let balls = test.case.balls;
    let row = |what: String, printed: &str, value: f64, decimals: usize| {
        vec![
            Cell::from(what),
            Cell::from(printed),
            Cell::fixed(value, decimals),
        ]
    };
    Table {
        name: "applications",
        caption:
            "What the text says of its applications, and what the reference computes with the \
                  parameters above"
                .into(),
        columns: ["quantity", "printed", "computed"]
            .map(String::from)
            .to_vec(),
        rows: vec![
            row(
                "axial lash: spread between ball patterns (%)".into(),
                "3.72",
                axial,
                2,
            ),
            row(
                "conical lash under 10 N: spread between ball patterns (%)".into(),
                "14.7",
                conical,
                1,
            ),
            row(
                "conical lash from -10 to 10 N: spread between ball patterns (%)".into(),
                "",
                conical_range,
                1,
            ),
            row(
                "largest load in the bearing, 18 over 0 degrees".into(),
                "1.47",
                grows(1),
                2,
            ),
            row(
                "largest load in the ball screw, 18 over 0 degrees".into(),
                "3.32",
                grows(0),
                2,
            ),
            row(
                format!("balls of {balls} lost by pitch error"),
                "none",
                lost(Waviness::Pitch),
                0,
            ),
            row(
                format!("balls of {balls} lost by roundness error"),
                "some",
                lost(Waviness::Roundness),
                0,
            ),
        ],
    }
}

fn figure_4_3(curves: &[LashCurves]) -> Figure {
    let panel = |title: &str, y: &str, pick: fn(&LashCurves) -> &[(f64, f64)]| {
        Panel::Chart(Chart {
            title: title.into(),
            x: Axis::linear("force (N)"),
            y: Axis::linear(y),
            series: curves
                .iter()
                .enumerate()
                .map(|(index, curves)| {
                    let points = pick(curves)
                        .iter()
                        .map(|(force, moved)| (*force, 1e6 * moved));
                    Series::new(curves.pattern.name(), index, Mark::Line, points.collect())
                })
                .collect(),
            notes: Vec::new(),
        })
    };
    Figure {
        name: "lin_figure_4_3",
        caption:
            "Lin 2019, Figure 4.3: lash curves of a ball screw with its balls in four places of the track."
                .into(),
        panels: vec![
            panel("axial", "axial displacement (um)", |curves| &curves.axial),
            panel("conical", "lateral displacement (um)", |curves| {
                &curves.conical
            }),
        ],
        columns: 2,
        size: (540, 420),
    }
}

fn figure_4_5(turned: &[TieRodLoads]) -> Figure {
    let panel = |title: &str, bearing: bool| {
        Panel::Chart(Chart {
            title: title.into(),
            x: Axis::linear("ball"),
            y: Axis::linear("largest contact force (N)"),
            series: turned
                .iter()
                .enumerate()
                .map(|(index, loads)| {
                    let solution = if bearing {
                        &loads.bearing
                    } else {
                        &loads.screw
                    };
                    let points = solution.forces.iter().enumerate().map(|(ball, four)| {
                        (ball as f64 + 1.0, four.iter().copied().fold(0.0, f64::max))
                    });
                    let name = format!("{:.0} degrees", loads.angle.to_degrees());
                    Series::new(&name, index, Mark::Line, points.collect())
                })
                .collect(),
            notes: Vec::new(),
        })
    };
    Figure {
        name: "lin_figure_4_5",
        caption:
            "Lin 2019, Figure 4.5: loads of each ball under 14500 N of rack load at four tie-rod angles."
                .into(),
        panels: vec![
            panel("four-point bearing", true),
            panel("ball screw", false),
        ],
        columns: 2,
        size: (540, 420),
    }
}

/// Time of the static model over the number of balls, set-up included, on one core: the shortest of some runs, because
/// whatever else the machine does only adds to it.
fn cost(quick: bool, progress: &Progress) -> Result<Table, Failure> {
    let runs = if quick { 5 } else { 25 };
    let mut rows = Vec::new();
    for balls in TRAINS {
        let case = if balls == 32 {
            CaseStudy::table_2_1()
        } else {
            long_nut(balls)
        };
        let mut time = f64::INFINITY;
        let (mut unknowns, mut iterations) = (0, 0);
        for _ in 0..runs {
            let start = Instant::now();
            let solution = case.load().map_err(failed)?.solve().map_err(failed)?;
            time = time.min(start.elapsed().as_secs_f64());
            unknowns = 6 * solution.positions.len() + 2 * balls;
            iterations = solution.iterations;
        }
        rows.push(vec![
            Cell::fixed(balls as f64, 0),
            Cell::fixed(unknowns as f64, 0),
            Cell::fixed(iterations as f64, 0),
            Cell::fixed(1e3 * time, 2),
            Cell::fixed(1e6 * time / balls as f64, 1),
            Cell::from(if balls == 32 {
                format!("{:.0} times", 3.87 / time)
            } else {
                String::new()
            }),
        ]);
        progress.step();
    }
    Ok(Table {
        name: "static_cost",
        caption: "Shortest time to find the loads of all balls on one core, set-up included: case 1 of section 2.4 (32 \
                  balls) and longer nuts under the same load per ball. The dissertation took 3.87 s for \
                  case 1, its finite elements 7.35 h."
            .into(),
        columns: [
            "balls",
            "unknowns",
            "Newton steps",
            "time (ms)",
            "per ball (us)",
            "faster than 3.87 s",
        ]
        .map(String::from)
        .to_vec(),
        rows,
    })
}
