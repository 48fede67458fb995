//! Applications of the static model: Figures 4.3 and 4.5 of Lin 2019.

use crate::load_studies::lash::{LashCurves, LashTest, Pattern};
use crate::load_studies::tie_rod::{self, TieRodLoads};

use super::Context;
use super::loads::{by_ball, largest};
use epas_bench::report::draw::{chart, figure};
use epas_page::document::{Block, Section};
use epas_page::failure::Failure;
use epas_page::plot::{Axis, Mark, Series};
use epas_page::progress::Progress;

/// Oversize of the balls' radius in the lash tests, m, which the text does not print.
const OVERSIZE: f64 = 2e-6;
/// Tie-rod angles, degrees; the text names the first and the last.
const TIE_ROD_ANGLES: [f64; 4] = [0.0, 6.0, 12.0, 18.0];

pub fn section(context: &Context) -> Result<Section, Failure> {
    let steps = if context.quick { 5 } else { 21 };
    let progress = Progress::new(
        "static loads",
        Pattern::ALL.len() * steps + TIE_ROD_ANGLES.len(),
    );
    let tick = || progress.step();
    let test = LashTest {
        oversize: OVERSIZE,
        steps,
    };
    let curves = test.curves(&tick)?;
    let turned = tie_rod::over(&TIE_ROD_ANGLES.map(f64::to_radians), &tick)?;
    Ok(Section {
        title: "Applications of the static loads",
        blocks: vec![
            Block::Text(
                "Lin 2019, chapter 4, by the float64 reference. The text leaves parameters out, so that its \
                 numbers (table \"published\") are to be compared in kind: balls 2 um larger than fit and a lateral force of 10 N \
                 at the far end in the lash tests, balls on the track as Figure 4.2 shows them; a screw of \
                 28 mm; for the rack the ball screw of Table 4.1, the four-point bearing of Table 4.2 around \
                 its nut, and a pinion 0.65 m from the end, beyond which nothing reaches the nut."
                    .into(),
            ),
            figure_4_3(&curves),
            figure_4_5(&turned),
        ],
    })
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
