//! Efficiency: Figures 3, 5, 6 and 7 of Lin, Velinsky, Ravani 1994, with the rolling branch and the
//! dynamic correction in each.

use std::f64::consts::TAU;

use crate::rolling_ball::RollingBall;
use epas_design::efficiency::{DynamicCorrection, optimum_contact_angle, optimum_efficiency};
use epas_friction::efficiency::{Drive, EfficiencyGeometry};
use epas_reference::efficiency::{self as reference, Screw};
use epas_reference::steady_state::BallScrewState;

use super::context::Context;
use epas_bench::report::statistics::evenly;
use epas_page::document::{Block, Cell, Figure, Section, Table};
use epas_page::failure::Failure;
use epas_page::plot::{Axis, Chart, Mark, Panel, Series};

/// The paper's case: 2113 N on one ball at 2000 rpm.
const BALL_RADIUS: f64 = 4.37e-3;
const PITCH_RADIUS: f64 = 24.3e-3;
const FRICTION: f64 = 0.075;
const SPEED: f64 = 2000.0 * TAU / 60.0;
const LOAD: f64 = 2113.0;

fn state(lead_degrees: f64, contact_degrees: f64) -> BallScrewState {
    BallScrewState {
        lead_angle: lead_degrees.to_radians(),
        contact_angle: contact_degrees.to_radians(),
        friction: FRICTION,
        ball_radius: BALL_RADIUS,
        pitch_radius: PITCH_RADIUS,
        speed: SPEED,
        axial_load: LOAD,
        ball_density: 7800.0,
    }
}

fn screw(lead_degrees: f64, contact_degrees: f64, ball_ratio: f64) -> Screw {
    Screw {
        lead_angle: lead_degrees.to_radians(),
        contact_angle: contact_degrees.to_radians(),
        friction: FRICTION,
        ball_ratio,
        rolling_tangent: 0.0,
    }
}

fn geometry(lead_degrees: f64, contact_degrees: f64) -> Result<EfficiencyGeometry, Failure> {
    EfficiencyGeometry::new(
        lead_degrees.to_radians() as f32,
        contact_degrees.to_radians() as f32,
        (BALL_RADIUS / PITCH_RADIUS) as f32,
    )
    .map_err(|error| Failure::Data(error.to_string()))
}

/// The section.
pub fn section(context: &Context) -> Result<Section, Failure> {
    Ok(Section {
        title: "Efficiency",
        blocks: vec![
            Block::Text(
                "Two answers to one question. Rolling, eq. (3), is where the ball's equations of motion \
                 lead from a rolling start: the efficiency to expect. Full sliding, eq. (14), is the \
                 limit of the paper's exact steady state, which exists only above a lead angle of some \
                 degrees and is unstable nearly everywhere: the pessimistic bound."
                    .into(),
            ),
            Block::Table(dynamic_table()?),
            Block::Figure(figure_3(context.quick)?),
            Block::Figure(figure_5()),
            Block::Figure(figure_6()?),
            Block::Figure(figure_7()),
            Block::Text(format!(
                "The optimum of full sliding is {:.4} at a friction of 0.075 (printed: 86.1 %), for lead \
                 angles up to 42.9 degrees driving and 47.1 degrees back-driving, not for all.",
                optimum_efficiency(FRICTION as f32)
            )),
        ],
    })
}

fn dynamic_table() -> Result<Table, Failure> {
    let mut rows = Vec::new();
    for (rpm, load) in [
        (2000.0, 2113.0),
        (10_000.0, 2113.0),
        (2000.0, 21.13),
        (10_000.0, 211.3),
    ] {
        let state = BallScrewState {
            speed: rpm * TAU / 60.0,
            axial_load: load,
            ..state(10.0, 45.0)
        };
        let exact = state
            .solve()
            .map_err(|error| Failure::Data(format!("{error:?}")))?
            .efficiency;
        let fast = geometry(10.0, 45.0)?;
        let correction = DynamicCorrection::new(&fast, FRICTION as f32);
        let closed = f64::from(fast.sliding_efficiency(FRICTION as f32));
        let corrected = f64::from(correction.efficiency(state.dynamic_number() as f32));
        rows.push(vec![
            Cell::fixed(rpm, 0),
            Cell::fixed(load, 2),
            Cell::fixed(exact, 6),
            Cell::power(closed - exact),
            Cell::power(corrected - exact),
        ]);
    }
    Ok(Table {
        name: "efficiency_dynamic",
        caption:
            "Full sliding against the exact steady state (lead angle 10, contact angle 45 degrees, \
                  friction 0.075)"
                .into(),
        columns: [
            "rpm",
            "load of a ball (N)",
            "exact",
            "error of (14), f32",
            "with dynamic correction, f32",
        ]
        .map(String::from)
        .to_vec(),
        rows,
    })
}

fn figure_3(quick: bool) -> Result<Figure, Failure> {
    let steps = if quick { 30 } else { 120 };
    let mut panels = Vec::new();
    for (title, label, range, place) in [
        (
            "contact angle 45 degrees",
            "lead angle (deg)",
            (1.0, 45.0),
            (|x| (x, 45.0)) as fn(f64) -> (f64, f64),
        ),
        (
            "lead angle 10 degrees",
            "contact angle (deg)",
            (5.0, 85.0),
            |x| (10.0, x),
        ),
    ] {
        let mut curves: [Vec<(f64, f64)>; 5] = Default::default();
        for (index, x) in evenly(range.0, range.1, steps).enumerate() {
            let (lead, contact) = place(x);
            let fast = geometry(lead, contact)?;
            let friction = FRICTION as f32;
            curves[0].push((x, f64::from(fast.rolling_efficiency(friction, 0.0))));
            curves[1].push((x, f64::from(fast.sliding_efficiency(friction))));
            if index % 3 == 0
                && let Ok(exact) = state(lead, contact).solve()
            {
                curves[2].push((x, exact.efficiency));
            }
            // A contact that opens or an integration that stops leaves its point out.
            if index % 6 == 0
                && let Ok(settled) = RollingBall::new(state(lead, contact)).settle(10.0)
            {
                curves[4].push((x, settled.efficiency));
            }
            curves[3].push((
                x,
                screw(lead, contact, BALL_RADIUS / PITCH_RADIUS).rolling_nut(),
            ));
        }
        let [rolling, sliding, exact, printed, settled] = curves;
        panels.push(Panel::Chart(Chart {
            title: title.into(),
            x: Axis::linear(label),
            y: Axis::linear("efficiency").between(0.5, 1.0),
            series: vec![
                Series::new("rolling (3)", 0, Mark::Line, rolling),
                Series::new("full sliding (14)", 1, Mark::Line, sliding),
                Series::new("exact steady state (5)-(9)", 2, Mark::Circles, exact),
                Series::new("in time, from a rolling start", 3, Mark::Crosses, settled),
                Series::new("nut driving (4) as printed", 6, Mark::Dashed, printed),
            ],
            notes: Vec::new(),
        }));
    }
    Ok(Figure {
        name: "efficiency_figure_3",
        caption: "Lin, Velinsky, Ravani 1994, Figure 3: efficiency over lead and contact angle. Points: the exact steady state where it \
                  exists; it differs from (14) by less than 2e-5 (the paper states 0.33 and 0.86 %, which do \
                  not reproduce). Crosses: the same equations with their rates, integrated over ten turns from a rolling \
                  start, lead to eq. (3)."
            .into(),
        panels,
        columns: 2,
        size: (540, 420),
    })
}

fn figure_5() -> Figure {
    let screw = screw(10.0, 45.0, 0.1);
    let curve = evenly(0.0, 90.0, 180)
        .map(|degrees| (degrees, screw.at_slip_angle(degrees.to_radians())))
        .collect();
    let own = screw.slip_angle().to_degrees();
    Figure {
        name: "efficiency_figure_5",
        caption: "Lin, Velinsky, Ravani 1994, Figure 5: efficiency over the slip angle at the screw, eq. (11) with its sign corrected; \
                  ball ratio 0.1, lead angle 10 degrees. Friction across the groove costs least."
            .into(),
        panels: vec![Panel::Chart(Chart {
            title: String::new(),
            x: Axis::linear("slip angle (deg)").between(0.0, 90.0),
            y: Axis::linear("efficiency").between(0.6, 1.0),
            series: vec![
                Series::new("eq. (11)", 0, Mark::Line, curve),
                Series::new(
                    "full sliding (14), slip angle of eq. (13)",
                    1,
                    Mark::Circles,
                    vec![(own, screw.sliding_drive())],
                ),
                Series::new(
                    "rolling (3), slip angle 0",
                    2,
                    Mark::Triangles,
                    vec![(0.0, screw.rolling_screw())],
                ),
            ],
            notes: Vec::new(),
        })],
        columns: 1,
        size: (1080, 360),
    }
}

fn figure_6() -> Result<Figure, Failure> {
    let mut series = Vec::new();
    for (colour, drive, name) in [
        (0, Drive::Driving, "driving (15)"),
        (1, Drive::BackDriving, "back-driving (18)"),
    ] {
        let mut curve = Vec::new();
        let mut points = Vec::new();
        for (index, lead) in evenly(0.0, 48.0, 480).enumerate() {
            let best = optimum_contact_angle(drive, lead.to_radians() as f32, FRICTION as f32)
                .map_err(|error| Failure::Data(error.to_string()))?;
            let exact = match drive {
                Drive::Driving => reference::optimum_drive(lead.to_radians(), FRICTION),
                Drive::BackDriving => reference::optimum_backdrive(lead.to_radians(), FRICTION),
            };
            if let Some(angle) = best.contact_angle {
                curve.push((lead, f64::from(angle).to_degrees()));
            }
            if let (Some(exact), 0) = (exact, index % 40) {
                points.push((lead, exact.to_degrees()));
            }
        }
        series.push(Series::new(name, colour, Mark::Line, curve));
        series.push(Series::new("", colour, Mark::Circles, points));
    }
    Ok(Figure {
        name: "efficiency_figure_6",
        caption: "Lin, Velinsky, Ravani 1994, Figure 6: contact angle of highest efficiency in full sliding, in closed form (lines: the \
                  crate in f32; points: the reference). Each ends where the optimum ceases to exist."
            .into(),
        panels: vec![Panel::Chart(Chart {
            title: String::new(),
            x: Axis::linear("lead angle (deg)").between(0.0, 50.0),
            y: Axis::linear("contact angle (deg)").between(40.0, 92.0),
            series,
            notes: Vec::new(),
        })],
        columns: 1,
        size: (1080, 380),
    })
}

fn figure_7() -> Figure {
    let frictions = [0.075, 0.15, 0.3];
    let mut panels = Vec::new();
    type Border = fn(f64, f64) -> Option<f64>;
    for (title, border, mark, leads, contacts) in [
        (
            "7a: driving locks below the line",
            reference::locking_border_drive as Border,
            Mark::ShadedBelow,
            (0.0, 85.0),
            (0.0, 90.0),
        ),
        (
            "7b: back-driving locks above the line",
            reference::locking_border_backdrive as Border,
            Mark::ShadedAbove,
            (0.0, 18.0),
            (70.0, 90.0),
        ),
    ] {
        let series = frictions
            .iter()
            .enumerate()
            .map(|(colour, friction)| {
                // Beyond the end of its border driving locks at every contact angle, back-driving at none.
                let beyond = if mark == Mark::ShadedBelow {
                    contacts.1
                } else {
                    f64::NAN
                };
                let curve = evenly(leads.0, leads.1, 400)
                    .map(|lead| {
                        let contact = border(lead.to_radians(), *friction);
                        (lead, contact.map_or(beyond, f64::to_degrees))
                    })
                    .collect();
                Series::new(&format!("friction {friction}"), colour, mark, curve)
            })
            .collect();
        panels.push(Panel::Chart(Chart {
            title: title.into(),
            x: Axis::linear("lead angle (deg)").between(leads.0, leads.1),
            y: Axis::linear("contact angle (deg)").between(contacts.0, contacts.1),
            series,
            notes: Vec::new(),
        }));
    }
    Figure {
        name: "efficiency_figure_7",
        caption: "Lin, Velinsky, Ravani 1994, Figure 7: the space of designs that brake themselves in full sliding, eq. (16) and (19); the \
                  paper draws friction 0.075."
            .into(),
        panels,
        columns: 2,
        size: (540, 400),
    }
}
