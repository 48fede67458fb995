//! Figures 3 and 5 of Lin, Velinsky, Ravani 1994: efficiency over lead, contact and slip angle.

use epas_friction::{DynamicCorrection, EfficiencyGeometry};
use epas_reference::efficiency::Screw;
use epas_reference::steady_state::BallScrewState;

use super::Context;
use super::document::{Block, Cell, Figure, Section, Table};
use crate::failure::Failure;
use crate::plot::{Axis, Chart, Mark, Panel, Series, render};

/// The paper's ball screw: 4.37 mm balls on a 24.3 mm pitch radius, 2113 N, 2000 rpm.
const BALL_RADIUS: f64 = 4.37e-3;
const PITCH_RADIUS: f64 = 24.3e-3;
const FRICTION: f64 = 0.075;
const LOAD: f64 = 2113.0;
const SPEED: f64 = 2000.0 / 60.0 * std::f64::consts::TAU;
const DENSITY: f64 = 7800.0;

/// Efficiencies at one lead and contact angle.
struct Point {
    lead_angle: f64,
    contact_angle: f64,
    /// Exact steady state, where it exists.
    exact: f64,
    /// Float64 closed forms.
    sliding: f64,
    sliding_backdrive: f64,
    rolling: f64,
    /// The crate's f32.
    sliding_f32: f64,
    corrected_f32: f64,
    rolling_f32: f64,
}

fn point(lead_degrees: f64, contact_degrees: f64) -> Result<Point, Failure> {
    let failure = |error: epas_friction::Error| Failure::Data(error.to_string());
    let (lead_angle, contact_angle) = (lead_degrees.to_radians(), contact_degrees.to_radians());
    let ball_ratio = BALL_RADIUS / PITCH_RADIUS;
    let screw = Screw {
        lead_angle,
        contact_angle,
        friction: FRICTION,
        ball_ratio,
        rolling_tangent: 0.0,
    };
    let state = BallScrewState {
        lead_angle,
        contact_angle,
        friction: FRICTION,
        ball_radius: BALL_RADIUS,
        pitch_radius: PITCH_RADIUS,
        speed: SPEED,
        axial_load: LOAD,
        ball_density: DENSITY,
    };
    let geometry =
        EfficiencyGeometry::new(lead_angle as f32, contact_angle as f32, ball_ratio as f32)
            .map_err(failure)?;
    let friction = FRICTION as f32;
    let correction = DynamicCorrection::new(&geometry, friction);
    Ok(Point {
        lead_angle: lead_degrees,
        contact_angle: contact_degrees,
        exact: state.solve().map_or(f64::NAN, |state| state.efficiency),
        sliding: screw.sliding_drive(),
        sliding_backdrive: screw.sliding_backdrive(),
        rolling: screw.rolling_screw(),
        sliding_f32: geometry.sliding_efficiency(friction).into(),
        corrected_f32: correction.efficiency(state.dynamic_number() as f32).into(),
        rolling_f32: geometry.rolling_efficiency(friction, 0.0).into(),
    })
}

fn sweep(points: impl Iterator<Item = (f64, f64)>) -> Result<Vec<Point>, Failure> {
    points.map(|(lead, contact)| point(lead, contact)).collect()
}

/// The section.
pub fn section(_: &Context) -> Result<Section, Failure> {
    let halves = |from: u32, to: u32| (from..=to).map(|index| 0.5 * f64::from(index));
    let over_lead = sweep(halves(2, 90).map(|lead| (lead, 45.0)))?;
    let over_contact = sweep(halves(20, 170).map(|contact| (10.0, contact)))?;
    let mut blocks = vec![
        Block::text(
            "Efficiency of the ball screw of Lin, Velinsky, Ravani 1994 (ball radius 4.37 mm, pitch \
             radius 24.3 mm, friction 0.075, 2113 N on a ball, 2000 rpm). Two answers stand side by \
             side: rolling, eq. (3), which a ball reaches from rest and which is the efficiency to \
             expect; and full sliding, eq. (14), the pessimistic bound, which the exact steady state of \
             the Newton-Euler equations (5)-(9) reproduces where it exists. That state needs a lead \
             angle of some degrees, lets the ball spin at a million rad/s, and is unstable nearly \
             everywhere.",
        ),
        Block::Figure(figure_3(&over_lead, &over_contact)?),
    ];
    blocks.push(Block::Table(agreement(&over_lead, &over_contact)));
    blocks.push(Block::text(
        "The paper prints 0.33 and 0.86 % for the largest difference of eq. (14) from the exact steady \
         state over lead and contact angle. It is several hundred times smaller: those differences must \
         have come from the paper's numerical solution.",
    ));
    blocks.push(Block::Figure(figure_5()?));
    Ok(Section {
        id: "efficiency-curves",
        title: "Efficiency: rolling, sliding and the exact steady state (Figures 3, 5)",
        blocks,
    })
}

fn curve(points: &[Point], x: fn(&Point) -> f64, y: fn(&Point) -> f64) -> Vec<(f64, f64)> {
    points.iter().map(|point| (x(point), y(point))).collect()
}

fn figure_3(over_lead: &[Point], over_contact: &[Point]) -> Result<Figure, Failure> {
    let panel = |title: &str, label: &str, points: &[Point], x: fn(&Point) -> f64, every: usize| {
        let exact = points
            .iter()
            .step_by(every)
            .map(|point| (x(point), point.exact))
            .collect();
        Panel::Chart(Chart {
            title: title.into(),
            x: Axis::linear(label),
            y: Axis::linear("efficiency").between(0.5, 1.0),
            series: vec![
                Series::new(
                    "rolling (3)",
                    2,
                    Mark::Line,
                    curve(points, x, |point| point.rolling),
                ),
                Series::new(
                    "full sliding (14)",
                    0,
                    Mark::Line,
                    curve(points, x, |point| point.sliding),
                ),
                Series::new(
                    "back-driving (17)",
                    3,
                    Mark::Dashed,
                    curve(points, x, |point| point.sliding_backdrive),
                ),
                Series::new("exact steady state", 1, Mark::Circles, exact),
            ],
            notes: Vec::new(),
        })
    };
    let panels = [
        panel(
            "Over the lead angle, contact angle 45\u{b0}",
            "lead angle (deg)",
            over_lead,
            |point| point.lead_angle,
            4,
        ),
        panel(
            "Over the contact angle, lead angle 10\u{b0}",
            "contact angle (deg)",
            over_contact,
            |point| point.contact_angle,
            6,
        ),
    ];
    let mut data = Table::new(
        "figure-03",
        "Figure 3 of Lin, Velinsky, Ravani 1994: efficiency over lead angle and over contact angle; the \
         exact steady state (points, where it exists), full sliding by eq. (14) and, back-driving, (17), \
         and the efficiency of rolling by eq. (3).",
        &[
            "lead angle (deg)",
            "contact angle (deg)",
            "exact steady state",
            "sliding (14)",
            "back-driving (17)",
            "rolling (3)",
            "sliding (14), f32",
            "sliding with dynamic correction, f32",
            "rolling (3), f32",
        ],
    );
    for point in over_lead.iter().chain(over_contact) {
        data.rows.push(
            [
                point.lead_angle,
                point.contact_angle,
                point.exact,
                point.sliding,
                point.sliding_backdrive,
                point.rolling,
                point.sliding_f32,
                point.corrected_f32,
                point.rolling_f32,
            ]
            .map(Cell::raw)
            .into(),
        );
    }
    Ok(Figure {
        svg: render(&panels, 2, (620, 460))?,
        data,
    })
}

fn agreement(over_lead: &[Point], over_contact: &[Point]) -> Table {
    let mut table = Table::new(
        "efficiency-agreement",
        "Largest differences of efficiency over the two sweeps of Figure 3 (absolute)",
        &["sweep", "what", "largest difference", "printed"],
    );
    type Difference = (&'static str, fn(&Point) -> f64, [&'static str; 2]);
    let differences: [Difference; 4] = [
        (
            "(14) from the exact steady state",
            |point| point.sliding - point.exact,
            ["3.3e-3", "8.6e-3"],
        ),
        (
            "(14) with dynamic correction, f32, from the exact steady state",
            |point| point.corrected_f32 - point.exact,
            ["", ""],
        ),
        (
            "(14), f32 from float64",
            |point| point.sliding_f32 - point.sliding,
            ["", ""],
        ),
        (
            "(3), f32 from float64",
            |point| point.rolling_f32 - point.rolling,
            ["", ""],
        ),
    ];
    for (index, (sweep, points)) in [("lead angle", over_lead), ("contact angle", over_contact)]
        .into_iter()
        .enumerate()
    {
        for (what, difference, printed) in &differences {
            // `max` passes over the points where there is no steady state.
            let largest = points
                .iter()
                .map(|point| difference(point).abs())
                .fold(0.0, f64::max);
            table.rows.push(vec![
                Cell::text(sweep),
                Cell::text(*what),
                Cell::error(largest),
                Cell::text(printed[index]),
            ]);
        }
    }
    table
}

fn figure_5() -> Result<Figure, Failure> {
    let screw = Screw {
        lead_angle: 10f64.to_radians(),
        contact_angle: 45f64.to_radians(),
        friction: FRICTION,
        ball_ratio: 0.1,
        rolling_tangent: 0.0,
    };
    let points: Vec<_> = (0..=90)
        .map(|degrees| {
            let slip_angle = f64::from(degrees);
            (slip_angle, screw.at_slip_angle(slip_angle.to_radians()))
        })
        .collect();
    let marked = [
        (
            "rolling (3): slip across the groove",
            2,
            Mark::Circles,
            (0.0, screw.rolling_screw()),
        ),
        (
            "full sliding (14): slip angle (13)",
            1,
            Mark::Triangles,
            (screw.slip_angle().to_degrees(), screw.sliding_drive()),
        ),
    ];
    let mut series = vec![Series::new(
        "eq. (11), sign corrected",
        0,
        Mark::Line,
        points.clone(),
    )];
    for (name, colour, mark, place) in marked {
        series.push(Series::new(name, colour, mark, vec![place]));
    }
    let mut data = Table::new(
        "figure-05",
        "Figure 5 of Lin, Velinsky, Ravani 1994: efficiency over the slip angle at the screw (lead angle \
         10 degrees, contact angle 45 degrees, ball ratio 0.1, friction 0.075). Slip along the path costs \
         most. Equation (11) is printed with a wrong sign in its numerator.",
        &["slip angle (deg)", "efficiency"],
    );
    for (slip_angle, efficiency) in points {
        data.rows
            .push(vec![Cell::raw(slip_angle), Cell::raw(efficiency)]);
    }
    let chart = Chart {
        title: "Efficiency over the slip angle at the screw".into(),
        x: Axis::linear("slip angle (deg)").between(0.0, 90.0),
        y: Axis::linear("efficiency").between(0.5, 1.0),
        series,
        notes: Vec::new(),
    };
    Ok(Figure {
        svg: render(&[Panel::Chart(chart)], 1, (900, 440))?,
        data,
    })
}
