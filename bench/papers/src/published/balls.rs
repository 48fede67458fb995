//! The computable numbers of Lin 2019 on ball-to-ball friction: sections 3.3 and 3.4, appendix G.

use std::f64::consts::{FRAC_PI_4, PI, SQRT_2, TAU};

use super::Computed;
use epas_bench::study;
use epas_page::failure::Failure;
use epas_reference::curvature::Groove;
use epas_reference::design::{BallScrewDesign, LinearBearingDesign};
use epas_reference::error::ReferenceError;
use epas_reference::friction::ball_screw_closed::ThreePointModel;
use epas_reference::friction::ball_screw_elastic::{BallSlip, ElasticBalls, ScrewSupport};
use epas_reference::friction::chain::solve_chain;
use epas_reference::friction::contact_law::HertzLaw;
use epas_reference::friction::linear_ball::{
    LinearBall, PUBLISHED_FORCE_SLOPE, analytic_contact_force, contact_forces,
};
use epas_reference::friction::maps::FrictionMap;
use epas_reference::friction::whole_screw::WholeScrew;
use epas_reference::material::Elastic;

/// Ball radius of Table 3.3, m.
const LINEAR_BALL_RADIUS: f64 = 5e-3;

/// Contact law of the linear bearing, by conformity: relative radii `R_B` and `R_B / (1 - 1/(2 conf))`.
pub fn linear_law(conformity: f64) -> Result<HertzLaw, ReferenceError> {
    let design = LinearBearingDesign {
        ball_radius: LINEAR_BALL_RADIUS,
        groove_radius: 2.0 * conformity * LINEAR_BALL_RADIUS,
        ball: Elastic::STEEL,
        groove: Elastic::STEEL,
    };
    Ok(design.contact()?.into())
}

/// Ball of Table 3.3 with contact angles BL, BR, TR, TL deviating from 45 degrees, rad, under 100 N and a side force of
/// `side_force_ratio` times that; loads from statics.
pub fn linear_ball(
    deviations: [f64; 4],
    side_force_ratio: f64,
) -> Result<LinearBall, ReferenceError> {
    let contact_angles = deviations.map(|deviation| FRAC_PI_4 + deviation);
    Ok(LinearBall {
        ball_radius: LINEAR_BALL_RADIUS,
        friction: 0.1,
        contact_angles,
        contact_forces: contact_forces(contact_angles, 100.0 * side_force_ratio, 100.0),
        ellipse: linear_law(0.56)?.ellipse,
    })
}

/// The two balls of Figure 3.13: deviation `-theta`, `theta` of the bottom groove, side force `rho` on the rear ball and
/// `-rho` on the front one, as the two-ball module carries a yaw moment.
pub fn linear_pair(theta: f64, rho: f64) -> Result<[LinearBall; 2], ReferenceError> {
    Ok([
        linear_ball([-theta, theta, 0.0, 0.0], rho)?,
        linear_ball([-theta, theta, 0.0, 0.0], -rho)?,
    ])
}

pub fn symmetric_pair(theta: f64, rho: f64) -> Result<[LinearBall; 2], ReferenceError> {
    let with = |ball: LinearBall, rho: f64| {
        let (up, down) = (100.0 * (1.0 - rho) / SQRT_2, 100.0 * (1.0 + rho) / SQRT_2);
        LinearBall {
            contact_forces: [up, down, up, down],
            ..ball
        }
    };
    let [rear, front] = linear_pair(theta, rho)?;
    Ok([with(rear, rho), with(front, -rho)])
}

/// Force between the balls of a pair by the closed form (3.51) with the printed slope.
pub fn analytic_force(pair: &[LinearBall; 2]) -> f64 {
    analytic_contact_force(
        pair.each_ref()
            .map(|ball| ball.analytic_speed_deviation(FRAC_PI_4)),
        pair.each_ref()
            .map(|ball| ball.analytic_compliance(FRAC_PI_4, PUBLISHED_FORCE_SLOPE)),
    )
}

/// Contact law of the ball screw of Tables 2.1 and 3.6 with its right curvatures.
pub fn screw_law(groove: Groove) -> Result<HertzLaw, ReferenceError> {
    Ok(BallScrewDesign::LIN.contact(groove)?.into())
}

/// The two balls of Table 3.7: deviations 0 and `degrees` of the contact angles on the screw.
fn screw_pair(degrees: f64) -> Result<ElasticBalls, Failure> {
    Ok(ElasticBalls {
        nut_speed: TAU,
        ball_slip: BallSlip::Total,
        ..study::screw_pair([0.0, degrees])?
    })
}

/// The screw of section 3.4.4: 37 balls on two turns under 1500 N, with an amplitude of the contact-angle deviation, rad.
pub fn whole_screw(deviation: f64) -> Result<WholeScrew, ReferenceError> {
    Ok(WholeScrew {
        model: ThreePointModel {
            track: (&BallScrewDesign::LIN).into(),
            screw: screw_law(Groove::Screw)?,
            nut: screw_law(Groove::Nut)?,
            friction: 0.1,
            contact_angle: FRAC_PI_4,
        },
        balls: 37,
        turns: 2.0,
        axial_load: -1500.0,
        nut_speed: TAU,
        deviation,
        cycles: 2.0,
        ball_friction: 0.1,
        ball_slip: BallSlip::Total,
    })
}

/// Over nut angle (rad), groove and ball torque in the first turn of the nut: largest torque between balls over that of the grooves,
/// percent, its angle, and the angle from which no balls press any more, degrees.
pub fn peak_and_release(run: impl IntoIterator<Item = (f64, f64, f64)>) -> [f64; 3] {
    let (mut peak, mut at, mut release) = (0.0, 0.0, f64::NAN);
    for (angle, groove, ball) in run.into_iter().filter(|(angle, ..)| *angle < TAU) {
        let share = 100.0 * ball / groove;
        if share > peak {
            (peak, at, release) = (share, angle.to_degrees(), f64::NAN);
        }
        if peak > 1.0 && ball == 0.0 && release.is_nan() {
            release = angle.to_degrees();
        }
    }
    [peak, at, release]
}

/// Contact constant and slope of the friction force of the ball of Table 3.3.
fn contact_of_table_3_3() -> Result<[f64; 2], ReferenceError> {
    let law = linear_law(0.56)?;
    let map = FrictionMap::new(law.ellipse.axis_ratio)?;
    // Least squares of kf x - k3 x³ over |x| < 0.5 by a line through zero: kf - k3 * (3/5) * 0.25.
    let cubic = (map.initial_slope() - 2.0 * map.at(0.5).force) * 4.0;
    Ok([
        law.ellipse.semi_major_constant / LINEAR_BALL_RADIUS.cbrt(),
        map.initial_slope() - 0.15 * cubic,
    ])
}

/// Size of the contact at the pressure that limits the load, over the ball's radius (appendix G).
fn largest_contact() -> Result<f64, ReferenceError> {
    // Pressure 3 F / (2 pi a b): F^(1/3) = 2 pi k Ca² sigma / 3.
    let ellipse = linear_law(0.52)?.ellipse;
    let root = 2.0 * PI * ellipse.axis_ratio * ellipse.semi_major_constant.powi(2) * 1554e6 / 3.0;
    Ok(ellipse.semi_major_constant * root / LINEAR_BALL_RADIUS)
}

/// The two balls of Figure 3.13: only the bottom groove turned, case (a), or both alike, case (b); speed deviations and forces.
fn two_linear_balls() -> Result<[Vec<f64>; 2], ReferenceError> {
    let theta = 2_f64.to_radians();
    let pair = linear_pair(theta, -0.6)?;
    let symmetric = symmetric_pair(theta, -0.6)?;
    let mated_ball = |rho| linear_ball([-theta, theta, -theta, theta], rho);
    let mated = [mated_ball(-0.6)?, mated_ball(0.6)?];
    let mut speeds = Vec::new();
    for ball in [0, 1] {
        speeds.extend([
            100.0 * pair[ball].solve(0.01)?.speed_deviation,
            100.0 * symmetric[ball].analytic_speed_deviation(FRAC_PI_4),
            100.0 * mated[ball].solve(0.01)?.speed_deviation,
            100.0 * mated[ball].analytic_speed_deviation(FRAC_PI_4),
        ]);
    }
    let forces = vec![
        solve_chain(&pair, 0.0, 0.01)?.contact_forces[0],
        analytic_force(&symmetric),
        solve_chain(&mated, 0.0, 0.01)?.contact_forces[0],
        analytic_force(&mated),
    ];
    Ok([speeds, forces])
}

/// The edge of Figure 3.15: loss with friction between the balls over that without, percent.
fn friction_over_the_baseline() -> Result<f64, ReferenceError> {
    let edge = linear_pair(3_f64.to_radians(), -0.6)?;
    let mut baseline = 0.0;
    for ball in &edge {
        baseline += ball.solve(0.01)?.power_loss;
    }
    let chain = solve_chain(&edge, 0.1, 0.01)?;
    Ok(100.0 * (1.0 + chain.ball_loss / baseline))
}

/// Force between the balls of Table 3.7, N, and what their contact adds to the friction, percent.
fn two_screw_balls(degrees: f64) -> Result<[f64; 2], Failure> {
    let load = ScrewSupport::Load(-100.0);
    let balls = screw_pair(degrees)?;
    let touching = balls.solve(load)?;
    let apart = balls.solve_apart(load)?.groove_loss();
    let growth = (touching.groove_loss() + touching.ball_loss) / apart - 1.0;
    Ok([touching.contact_force, 100.0 * growth])
}

pub(super) fn computed() -> Result<Computed, Failure> {
    let [psi, slope] = contact_of_table_3_3()?;
    let ratio = largest_contact()?;
    let [speeds, forces] = two_linear_balls()?;
    let [[force_a, growth_a], [force_b, growth_b]] = [two_screw_balls(2.0)?, two_screw_balls(3.0)?];
    let more = |printed: f64, elements: f64| 100.0 * (printed / elements - 1.0);
    let whole = whole_screw(2.3_f64.to_radians())?;
    let run = whole.simulate(2.0 * TAU, 200, 1)?;
    let run = run
        .iter()
        .map(|state| (state.nut_angle, state.main_torque, state.ball_torque));
    Ok(vec![
        ("Table 3.3", vec![psi]),
        ("Figure 3.11 and (3.35)", vec![slope]),
        (
            "appendix G",
            vec![ratio, 0.5 * ratio, (0.5 * ratio).to_degrees()],
        ),
        ("Table 3.4", speeds),
        ("Table 3.5", forces),
        ("section 3.3.5", vec![more(4.01, 3.96)]),
        ("Figure 3.15", vec![friction_over_the_baseline()?]),
        ("Table 3.7", vec![force_a, force_b]),
        (
            "section 3.4.3",
            vec![growth_a, more(1.92, 1.80), growth_b, more(2.89, 2.71)],
        ),
        ("section 3.4.4", vec![100.0 * whole.occupation()]),
        ("Figure 3.25", peak_and_release(run).into()),
    ])
}
