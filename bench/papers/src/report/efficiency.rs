//! Efficiency: Figures 3, 5, 6 and 7 of Lin, Velinsky, Ravani 1994, with the rolling branch and the dynamic correction in each.

use std::f64::consts::TAU;

use crate::published::efficiency::{ball, closed};
use crate::rolling_ball::RollingBall;
use epas_design::efficiency::{DynamicCorrection, optimum_contact_angle, optimum_efficiency};
use epas_friction::efficiency::{Drive, EfficiencyGeometry};
use epas_reference::efficiency::{self as reference, Screw};
use epas_reference::steady_state::BallScrewState;

use super::Context;
use epas_bench::report::draw::{chart, figure, table};
use epas_bench::report::statistics::evenly;
use epas_page::document::{Block, Cell, Section, Table};
use epas_page::failure::Failure;
use epas_page::plot::{Axis, Mark, Series};

const FRICTION: f64 = 0.075;

fn state(lead_degrees: f64, contact_degrees: f64) -> BallScrewState {
    ball(lead_degrees.to_radians(), contact_degrees.to_radians())
}

fn geometry(state: &BallScrewState) -> Result<EfficiencyGeometry, Failure> {
    Ok(EfficiencyGeometry::new(
        state.lead_angle as f32,
        state.contact_angle as f32,
        (state.ball_radius / state.pitch_radius) as f32,
    )?)
}

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
            figure_3(context.quick)?,
            figure_5(),
            figure_6()?,
            figure_7(),
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
    for (rpm, axial_load) in [
        (2000.0, 2113.0),
        (10_000.0, 2113.0),
        (2000.0, 21.13),
        (10_000.0, 211.3),
    ] {
        let state = BallScrewState {
            speed: rpm * TAU / 60.0,
            axial_load,
            ..state(10.0, 45.0)
        };
        let exact = state.solve()?.efficiency;
        let fast = geometry(&state)?;
        let correction = DynamicCorrection::new(&fast, FRICTION as f32);
        let closed = f64::from(fast.sliding_efficiency(FRICTION as f32));
        let corrected = f64::from(correction.efficiency(state.dynamic_number() as f32));
        rows.push(vec![
            Cell::fixed(rpm, 0),
            Cell::fixed(axial_load, 2),
            Cell::fixed(exact, 6),
            Cell::power(closed - exact),
            Cell::power(corrected - exact),
        ]);
    }
    let columns =
        "rpm | load of a ball (N) | exact | error of (14), f32 | with dynamic correction, f32";
    Ok(table(
        "efficiency_dynamic",
        "Full sliding against the exact steady state (lead angle 10, contact angle 45 degrees, friction 0.075)",
        columns,
        rows,
    ))
}

fn figure_3(quick: bool) -> Result<Block, Failure> {
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
        let mut series = [
            ("rolling (3)", 0, Mark::Line),
            ("full sliding (14)", 1, Mark::Line),
            ("exact steady state (5)-(9)", 2, Mark::Circles),
            ("in time, from a rolling start", 3, Mark::Crosses),
            ("nut driving (4) as printed", 6, Mark::Dashed),
        ]
        .map(|(name, colour, mark)| Series::new(name, colour, mark, Vec::new()));
        for (index, x) in evenly(range.0, range.1, steps).enumerate() {
            let (lead, contact) = place(x);
            let state = state(lead, contact);
            let (fast, friction) = (geometry(&state)?, FRICTION as f32);
            // Where there is no steady state, and where a contact opens or an integration stops, there is no point.
            let every = |stride| index % stride == 0;
            let exact = every(3).then(|| state.solve().ok()).flatten();
            let settled = every(6).then(|| RollingBall::new(state).settle(10.0).ok());
            let values = [
                Some(fast.rolling_efficiency(friction, 0.0).into()),
                Some(fast.sliding_efficiency(friction).into()),
                exact.map(|exact| exact.efficiency),
                settled.flatten().map(|settled| settled.efficiency),
                Some(closed(&state).rolling_nut()),
            ];
            for (series, value) in series.iter_mut().zip(values) {
                series.points.extend(value.map(|value| (x, value)));
            }
        }
        let y = Axis::linear("efficiency").between(0.5, 1.0);
        panels.push(chart(title, Axis::linear(label), y, series.into()));
    }
    Ok(figure(
        "efficiency_figure_3",
        "Lin, Velinsky, Ravani 1994, Figure 3: efficiency over lead and contact angle. Points: the exact steady state where it \
         exists; it differs from (14) by less than 2e-5 (the paper states 0.33 and 0.86 %, which do \
         not reproduce). Crosses: the same equations with their rates, integrated over ten turns from a rolling \
         start, lead to eq. (3).",
        (2, 540, 420),
        panels,
    ))
}

fn figure_5() -> Block {
    let screw = Screw {
        ball_ratio: 0.1,
        ..closed(&state(10.0, 45.0))
    };
    let curve = evenly(0.0, 90.0, 180)
        .map(|degrees| (degrees, screw.at_slip_angle(degrees.to_radians())))
        .collect();
    let own = (screw.slip_angle().to_degrees(), screw.sliding_drive());
    let rolling = (0.0, screw.rolling_screw());
    let point = |name, colour, mark, at| Series::new(name, colour, mark, vec![at]);
    let series = vec![
        Series::new("eq. (11)", 0, Mark::Line, curve),
        point(
            "full sliding (14), slip angle of eq. (13)",
            1,
            Mark::Circles,
            own,
        ),
        point("rolling (3), slip angle 0", 2, Mark::Triangles, rolling),
    ];
    let x = Axis::linear("slip angle (deg)").between(0.0, 90.0);
    let y = Axis::linear("efficiency").between(0.6, 1.0);
    figure(
        "efficiency_figure_5",
        "Lin, Velinsky, Ravani 1994, Figure 5: efficiency over the slip angle at the screw, eq. (11) with its sign corrected; \
         ball ratio 0.1, lead angle 10 degrees. Friction across the groove costs least.",
        (1, 1080, 360),
        vec![chart("", x, y, series)],
    )
}

fn figure_6() -> Result<Block, Failure> {
    type Optimum = fn(f64, f64) -> Option<f64>;
    let mut series = Vec::new();
    for (colour, drive, exact, name) in [
        (
            0,
            Drive::Driving,
            reference::optimum_drive as Optimum,
            "driving (15)",
        ),
        (
            1,
            Drive::BackDriving,
            reference::optimum_backdrive,
            "back-driving (18)",
        ),
    ] {
        let (mut curve, mut points) = (Vec::new(), Vec::new());
        for (index, lead) in evenly(0.0, 48.0, 480).enumerate() {
            let best = optimum_contact_angle(drive, lead.to_radians() as f32, FRICTION as f32)?;
            if let Some(angle) = best.contact_angle {
                curve.push((lead, f64::from(angle).to_degrees()));
            }
            if let (Some(exact), 0) = (exact(lead.to_radians(), FRICTION), index % 40) {
                points.push((lead, exact.to_degrees()));
            }
        }
        series.push(Series::new(name, colour, Mark::Line, curve));
        series.push(Series::new("", colour, Mark::Circles, points));
    }
    let x = Axis::linear("lead angle (deg)").between(0.0, 50.0);
    let y = Axis::linear("contact angle (deg)").between(40.0, 92.0);
    Ok(figure(
        "efficiency_figure_6",
        "Lin, Velinsky, Ravani 1994, Figure 6: contact angle of highest efficiency in full sliding, in closed form (lines: the \
         crate in f32; points: the reference). Each ends where the optimum ceases to exist.",
        (1, 1080, 380),
        vec![chart("", x, y, series)],
    ))
}

fn figure_7() -> Block {
    type Border = fn(f64, f64) -> Option<f64>;
    // Beyond the end of its border driving locks at every contact angle, back-driving at none.
    let panels = [
        (
            "7a: driving locks below the line",
            reference::locking_border_drive as Border,
            (Mark::ShadedBelow, 90.0),
            (0.0, 85.0),
            (0.0, 90.0),
        ),
        (
            "7b: back-driving locks above the line",
            reference::locking_border_backdrive,
            (Mark::ShadedAbove, f64::NAN),
            (0.0, 18.0),
            (70.0, 90.0),
        ),
    ]
    .map(|(title, border, (mark, beyond), leads, contacts)| {
        let curve = |(colour, friction): (usize, f64)| {
            let points = evenly(leads.0, leads.1, 400).map(|lead| {
                let contact = border(lead.to_radians(), friction);
                (lead, contact.map_or(beyond, f64::to_degrees))
            });
            let name = format!("friction {friction}");
            Series::new(&name, colour, mark, points.collect())
        };
        let series = [0.075, 0.15, 0.3].into_iter().enumerate().map(curve);
        let x = Axis::linear("lead angle (deg)").between(leads.0, leads.1);
        let y = Axis::linear("contact angle (deg)").between(contacts.0, contacts.1);
        chart(title, x, y, series.collect())
    });
    figure(
        "efficiency_figure_7",
        "Lin, Velinsky, Ravani 1994, Figure 7: the space of designs that brake themselves in full sliding, eq. (16) and (19); the \
         paper draws friction 0.075.",
        (2, 540, 400),
        panels.into(),
    )
}
