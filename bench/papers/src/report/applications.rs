//! Applications of the static model (Lin 2019, chapter 4) and what it costs.

use std::time::Instant;

use crate::load_studies::lash::{LashCurves, LashTest, Pattern, range, spread};
use crate::load_studies::tie_rod::{TieRodLoad, TieRodLoads};
use crate::load_studies::{Waviness, long_nut};
use epas_reference::statics::cases::CaseStudy;

use super::Context;
use super::loads::{by_ball, largest};
use epas_bench::report::draw::{chart, figure, table};
use epas_page::document::{Block, Cell, Section, Table};
use epas_page::failure::Failure;
use epas_page::plot::{Axis, Mark, Series};
use epas_page::progress::Progress;

/// Oversize of the balls' radius in the lash tests, m, which the text does not print.
const OVERSIZE: f64 = 2e-6;
/// Tie-rod angles, degrees; the text names the first and the last.
const TIE_ROD_ANGLES: [f64; 4] = [0.0, 6.0, 12.0, 18.0];
/// Amplitude of pitch and roundness error, m.
const AMPLITUDE: f64 = 5e-6;
/// Balls of the ball screws that are timed.
const TRAINS: [usize; 6] = [32, 64, 125, 250, 500, 1000];

/// The section.
pub fn section(context: &Context) -> Result<Section, Failure> {
    let steps = if context.quick { 5 } else { 21 };
    let progress = Progress::new(
        "static loads",
        Pattern::ALL.len() * steps + TIE_ROD_ANGLES.len() + TRAINS.len(),
    );
    let tick = || progress.step();
    let test = LashTest {
        steps,
        ..LashTest::table_4_1(OVERSIZE)
    };
    let curves = test.curves(&tick)?;
    let turned = TieRodLoad::default().over(&TIE_ROD_ANGLES.map(f64::to_radians), &tick)?;
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
            Block::Table(in_kind(&test, &curves, &turned)?),
            figure_4_3(&curves),
            figure_4_5(&turned),
            Block::Table(cost(context.quick, &progress)?),
        ],
    })
}

fn in_kind(
    test: &LashTest,
    curves: &[LashCurves],
    turned: &[TieRodLoads],
) -> Result<Table, Failure> {
    // Spread between the patterns, per cent.
    let spread = |pick: fn(&LashCurves) -> f64| {
        let values: Vec<f64> = curves.iter().map(pick).collect();
        100.0 * spread(&values)
    };
    let grows = |body: usize| match turned {
        [first, .., last] => last.largest()[body] / first.largest()[body],
        _ => f64::NAN,
    };
    let lost = |error: Waviness| -> Result<f64, Failure> {
        let loads = error.loads(&CaseStudy::table_4_1(), AMPLITUDE)?;
        Ok(loads.balls_lost as f64)
    };
    let balls = test.case.balls;
    let end = |curves: &LashCurves| curves.conical.last().map_or(f64::NAN, |point| point.1);
    let rows = [
        (
            "axial lash: spread between ball patterns (%)".into(),
            "3.72",
            spread(|curves| range(&curves.axial)),
            2,
        ),
        (
            "conical lash under 10 N: spread between ball patterns (%)".into(),
            "14.7",
            spread(end),
            1,
        ),
        (
            "conical lash from -10 to 10 N: spread between ball patterns (%)".into(),
            "",
            spread(|curves| range(&curves.conical)),
            1,
        ),
        (
            "largest load in the bearing, 18 over 0 degrees".into(),
            "1.47",
            grows(1),
            2,
        ),
        (
            "largest load in the ball screw, 18 over 0 degrees".into(),
            "3.32",
            grows(0),
            2,
        ),
        (
            format!("balls of {balls} lost by pitch error"),
            "none",
            lost(Waviness::Pitch)?,
            0,
        ),
        (
            format!("balls of {balls} lost by roundness error"),
            "some",
            lost(Waviness::Roundness)?,
            0,
        ),
    ]
    .map(|(what, printed, value, decimals): (String, &str, _, _)| {
        vec![what.into(), printed.into(), Cell::fixed(value, decimals)]
    });
    Ok(table(
        "applications",
        "What the text says of its applications, and what the reference computes with the parameters above",
        &["quantity", "printed", "computed"],
        rows.into(),
    ))
}

fn figure_4_3(curves: &[LashCurves]) -> Block {
    type Pick = fn(&LashCurves) -> &[(f64, f64)];
    let panels = [
        (
            "axial",
            "axial displacement (um)",
            (|curves| &curves.axial) as Pick,
        ),
        ("conical", "lateral displacement (um)", |curves| {
            &curves.conical
        }),
    ]
    .map(|(title, label, pick)| {
        let series = curves.iter().enumerate().map(|(index, curves)| {
            let points = pick(curves)
                .iter()
                .map(|(force, moved)| (*force, 1e6 * moved));
            Series::new(curves.pattern.name(), index, Mark::Line, points.collect())
        });
        let (x, y) = (Axis::linear("force (N)"), Axis::linear(label));
        chart(title, x, y, series.collect())
    });
    figure(
        "lin_figure_4_3",
        "Lin 2019, Figure 4.3: lash curves of a ball screw with its balls in four places of the track.",
        (2, 540, 420),
        panels.into(),
    )
}

fn figure_4_5(turned: &[TieRodLoads]) -> Block {
    let panels = [("four-point bearing", true), ("ball screw", false)].map(|(title, bearing)| {
        let series = turned.iter().enumerate().map(|(index, loads)| {
            let body = if bearing {
                &loads.bearing
            } else {
                &loads.screw
            };
            let points = by_ball(body.forces.iter().map(|four| largest(four)));
            let name = format!("{:.0} degrees", loads.angle.to_degrees());
            Series::new(&name, index, Mark::Line, points)
        });
        let (x, y) = (
            Axis::linear("ball"),
            Axis::linear("largest contact force (N)"),
        );
        chart(title, x, y, series.collect())
    });
    figure(
        "lin_figure_4_5",
        "Lin 2019, Figure 4.5: loads of each ball under 14500 N of rack load at four tie-rod angles.",
        (2, 540, 420),
        panels.into(),
    )
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
            let solution = case.load()?.solve()?;
            time = time.min(start.elapsed().as_secs_f64());
            unknowns = 6 * solution.positions.len() + 2 * balls;
            iterations = solution.iterations;
        }
        let faster = if balls == 32 {
            format!("{:.0} times", 3.87 / time)
        } else {
            String::new()
        };
        rows.push(vec![
            Cell::fixed(balls as f64, 0),
            Cell::fixed(unknowns as f64, 0),
            Cell::fixed(iterations as f64, 0),
            Cell::fixed(1e3 * time, 2),
            Cell::fixed(1e6 * time / balls as f64, 1),
            faster.into(),
        ]);
        progress.step();
    }
    let columns = [
        "balls",
        "unknowns",
        "Newton steps",
        "time (ms)",
        "per ball (us)",
        "faster than 3.87 s",
    ];
    Ok(table(
        "static_cost",
        "Shortest time to find the loads of all balls on one core, set-up included: case 1 of section 2.4 (32 \
         balls) and longer nuts under the same load per ball. The dissertation took 3.87 s for case 1, its finite elements 7.35 h.",
        &columns,
        rows,
    ))
}
