//! A row of balls by the law that the scene of a ball screw without cage evaluates, folded for the request.
//!
//! The law is folded for the largest deviation of each groove, either sign, and for 5 to 300 N a ball, or down and up to the next power of two
//! where the request needs more. Requests with the same screw, friction coefficient, clearance and largest deviations share a law, which takes some
//! seconds to fold.

use epas_design::uncaged::{Folded, PressedRow};
use epas_design::{CagedDesign, UncagedDesign, UncagedFold};
use epas_friction::ball::pressed::{BallOfRow, RowConstants};
use epas_friction::scene::FoldedBall;
use epas_friction::{BallScrew, Clearance, Limits, RollingResistance};
use serde::Serialize;

use super::request::{Ball, Request, Row};
use epas_design::uncaged_scene::{LEAST_DEVIATION, folded, loads_holding};

/// Limits that no request meets.
const LIMITS: Limits = Limits {
    nut_speed: 10.0,
    axial_load: 1e6,
    friction_torque: 1e6,
};

/// What the law finds.
#[derive(Clone, Debug, Default, Serialize)]
pub struct FoldedRow {
    /// The row; it has no loads, and no torque of the balls' own.
    #[serde(flatten)]
    pub found: Row,
    /// Whether a step under these loads is flagged: forces, load, rubbing or grip are not held.
    pub flagged: Option<bool>,
}

/// What the law finds; nothing where the clearance is not among those of the crate, for loads of both signs in one row, and where no law
/// holds the box.
pub fn row(request: &Request, design: &BallScrew) -> FoldedRow {
    let one_side = request.balls.windows(2).all(|pair| match pair {
        [one, other] => one.axial_load * other.axial_load > 0.0,
        _ => true,
    });
    if !one_side {
        return FoldedRow::default();
    }
    let found = law(request, design).map(|law| answer(request, law));
    found.flatten().unwrap_or_default()
}

fn law(request: &Request, design: &BallScrew) -> Option<&'static FoldedBall> {
    let clearance = Clearance::new(request.clearance as f32).ok()?;
    let largest = |of: fn(&Ball) -> f64| {
        let sizes = request.balls.iter().map(|ball| of(ball).abs() as f32);
        sizes.fold(0.0, f32::max)
    };
    let mut fold = UncagedFold::of(UncagedDesign {
        gear: CagedDesign {
            design: *design,
            friction: request.friction as f32,
            rolling_resistance: RollingResistance::NONE,
            clearance,
            loaded_balls: 1,
            reversal_speed: 1e-6,
            limits: LIMITS,
        },
        deviations: [
            largest(|ball| ball.screw_deviation),
            largest(|ball| ball.nut_deviation),
        ]
        .map(|deviation| deviation.max(LEAST_DEVIATION)),
    });
    let loads = || {
        request
            .balls
            .iter()
            .map(|ball| ball.axial_load.abs() as f32)
    };
    let ends = [
        loads().fold(f32::MAX, f32::min),
        loads().fold(0.0, f32::max),
    ];
    fold.ball_friction = request.ball_friction as f32;
    fold.axial_load = loads_holding(fold.axial_load, ends);
    match folded(&fold).ok()? {
        Folded::One(law) => Some(law),
        Folded::Range(_) => None,
    }
}

/// None where a ball runs further from nominal rolling than a step takes.
fn answer(request: &Request, ball: &FoldedBall) -> Option<FoldedRow> {
    let law = &ball.law;
    let interval = law.interval(ball.friction);
    // In the frame in which the nut turns forward.
    let way = if request.nut_speed < 0.0 { -1.0 } else { 1.0 };
    let count = request.balls.len();
    let mean = request
        .balls
        .iter()
        .map(|ball| ball.axial_load)
        .sum::<f64>()
        / count as f64;
    let branch = usize::from(way * mean < 0.0);
    let load = law.load_of(mean as f32);
    let numbers = law.per_sliding(load, branch, interval);

    let [screw, nut] = law.deviations.map(|largest| way / f64::from(largest));
    let (balls, alone): (Vec<BallOfRow>, Vec<f32>) = request
        .balls
        .iter()
        .map(|ball| {
            let deviations = [screw * ball.screw_deviation, nut * ball.nut_deviation];
            let deviations = deviations.map(|part| part as f32);
            let load = law.load_of(ball.axial_load as f32);
            law.ball(load, branch, interval, deviations, 1.0)
        })
        .unzip();
    let ball_friction = request.ball_friction as f32;
    let constants = if request.chord {
        ball.row(ball_friction)
    } else {
        RowConstants {
            ball_friction,
            outward: 0.0,
            normal: 1.0,
            ..ball.row(0.0)
        }
    };
    let neighbours = law.neighbours(load, branch, interval, &numbers, constants);
    let sliding = law.sliding(load, interval);
    let row = PressedRow::of(&neighbours, &balls)?;
    let free_torque: f64 = alone.iter().copied().map(f64::from).sum();
    let added_torque = f64::from(row.torques.groove + row.torques.ball);
    let nominal = ball.path_radius - ball.speed;
    let orbital = |speed: f32| f64::from((nominal + ball.speed * speed) / ball.path_radius);
    let heaviest = request
        .balls
        .iter()
        .map(|ball| ball.axial_load.abs() as f32);
    let most = law.load_of(heaviest.fold(0.0, f32::max));
    let held = law.holds_forces(load, branch, interval)
        && law.holds_load(most)
        && law.holds_rubbing(constants.ball_friction * row.torques.largest, sliding);
    Some(FoldedRow {
        found: Row {
            free_speed: Some(balls.iter().map(|ball| orbital(ball.speed)).collect()),
            // The reference has them along the line between the centres.
            contact_force: Some(
                row.forces
                    .iter()
                    .map(|force| force * f64::from(constants.normal))
                    .collect(),
            ),
            groove_torque: Some(free_torque + added_torque),
            groove_torque_free: Some(free_torque),
            ball_torque: None,
            loads: None,
        },
        flagged: Some(!held),
    })
}
