//! One ball and pairs of balls in a linear bearing: published tables, tabulated cases, and the exact ball of the reference.

use crate::reference::linear_cases;
use crate::refusals::assert_refused;
use epas_friction::ball::{AnalyticLinearBall, LinearBallParameters, PUBLISHED_SLOPE};
use epas_reference::friction::linear_ball::LinearBall;
use epas_reference::promises;
use epas_testkit::errors::Errors;
use epas_testkit::random::Random;
use std::f64::consts::FRAC_PI_4;

const BALL_RADIUS: f64 = 0.005;
const AXIS_RATIO: f64 = 0.232_146_373_366_069_72;
const PSI: f64 = 5.307e-4;
const FRICTION: f64 = 0.1;

/// The ball of Lin 2019, Table 3.3.
fn parameters() -> LinearBallParameters {
    LinearBallParameters {
        ball_radius: BALL_RADIUS as f32,
        contact_angle: FRAC_PI_4 as f32,
        axis_ratio: AXIS_RATIO as f32,
        semi_major_coefficient: (PSI * BALL_RADIUS.cbrt()) as f32,
        friction: FRICTION as f32,
    }
}

fn analytic() -> AnalyticLinearBall {
    AnalyticLinearBall::new(&parameters(), PUBLISHED_SLOPE).unwrap()
}

fn exact(angles: [f64; 4], forces: [f64; 4]) -> f64 {
    let ball = LinearBall {
        contact_angles: angles,
        contact_forces: forces,
        ..linear_cases::ball([0.0; 4], 0.0)
    };
    ball.solve(1.0).unwrap().speed_deviation
}

/// Contact angles and forces where the grooves are turned, without forces of contacts that are lost.
fn loaded(deviations: [f64; 4], rho: f64) -> ([f64; 4], [f64; 4]) {
    let ball = linear_cases::ball(deviations, rho);
    (
        ball.contact_angles,
        ball.contact_forces.map(|force| force.max(0.0)),
    )
}

/// The case of Lin 2019, Section 3.3.4: only the bottom groove is turned.
fn turned(degrees: f64, rho: f64) -> ([f64; 4], [f64; 4]) {
    let turn = degrees.to_radians();
    loaded([-turn, turn, 0.0, 0.0], rho)
}

fn single(values: [f64; 4]) -> [f32; 4] {
    values.map(|value| value as f32)
}

#[test]
fn table_3_4_velocity_deviations() {
    // Case (a): ±0.75 % by the formula.
    for (rho, formula) in [(-0.6, 0.0075), (0.6, -0.0075)] {
        let (angles, forces) = turned(2.0, rho);
        // The formula takes the two diagonals with the forces (1 ± rho)/sqrt 2.
        let [_, _, right, left] = single(forces);
        let found = analytic().speed_deviation(&single(angles), &[right, left, right, left]);
        // Printed to 0.01 %: half a unit of the last digit.
        assert!(
            (f64::from(found.speed_deviation) - formula).abs() < 5e-5,
            "{found:?}"
        );
    }
}

#[test]
fn table_3_5_ball_to_ball_force() {
    // 3.74 N by the formula.
    let [rear, front] = [-0.6, 0.6].map(|rho| {
        let (angles, forces) = turned(2.0, rho);
        let [_, _, right, left] = single(forces);
        analytic().speed_deviation(&single(angles), &[right, left, right, left])
    });
    // Half a unit of its last digit.
    assert!((rear.contact_force(&front) - 3.745).abs() < 5e-4);
    assert_eq!(front.contact_force(&rear), 0.0);
}

#[test]
fn random_contact_angles_and_side_forces() {
    let mut random = Random(1);
    let mut errors = Errors::of("random linear ball, (3.43)");
    for _ in 0..400 {
        let deviations = [0; 4].map(|_| 3_f64.to_radians() * random.signed());
        let rho = 0.8 * random.signed();
        let (angles, forces) = loaded(deviations, rho);
        let eps = exact(angles, forces);
        let formula = analytic().speed_deviation(&single(angles), &single(forces));
        let error = f64::from(formula.speed_deviation) - eps;
        errors.add_at(error, format_args!("deviations {deviations:?} rho {rho}"));
    }
    errors.assert_promised(promises::of("analytic_ball"));
}

#[test]
fn a_parameter_out_of_range_is_named() {
    #[rustfmt::skip]
    assert_refused(
        &(parameters(), PUBLISHED_SLOPE),
        |(parameters, slope)| AnalyticLinearBall::new(parameters, *slope),
        &[
            ("ball_radius", |(p, _), v| p.ball_radius = v, &[0.0]),
            ("contact_angle", |(p, _), v| p.contact_angle = v, &[]),
            ("axis_ratio", |(p, _), v| p.axis_ratio = v, &[2.0]),
            ("semi_major_coefficient", |(p, _), v| p.semi_major_coefficient = v, &[-1.0]),
            ("friction", |(p, _), v| p.friction = v, &[]),
            ("slope", |(_, slope), v| *slope = v, &[0.0]),
        ],
    );
}
