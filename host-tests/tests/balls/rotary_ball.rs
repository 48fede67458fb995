//! One ball in a rotary four-point contact bearing: Lin 2019, Table 3.2.

use crate::kit::golden;
use crate::kit::measured;
use epas_friction::refined::{RotaryBall, RotaryBallParameters, RotaryMotion};
use serde_json::Value;

const INNER_SPEED: f32 = 62.831_853;

fn single(values: &[f64]) -> [f32; 4] {
    [0, 1, 2, 3].map(|index| values[index] as f32)
}

/// The ball of a tabulated case, and its contact angles and forces.
fn ball(case: &Value) -> (RotaryBall, [f32; 4], [f32; 4]) {
    let [angles, forces, semi_major, axis_ratio] =
        ["beta", "F", "a", "k"].map(|name| golden::numbers(case, name));
    let parameters = RotaryBallParameters {
        ball_radius: golden::number(case, "RB") as f32,
        pitch_radius: golden::number(case, "RP") as f32,
        contact_angle: std::f32::consts::FRAC_PI_4,
        axis_ratio_inner: axis_ratio[0] as f32,
        axis_ratio_outer: axis_ratio[2] as f32,
        semi_major_coefficient_inner: (semi_major[0] / forces[0].cbrt()) as f32,
        semi_major_coefficient_outer: (semi_major[2] / forces[2].cbrt()) as f32,
        friction: golden::number(case, "mu") as f32,
    };
    let ball = RotaryBall::new(&parameters).unwrap();
    (ball, single(&angles), single(&forces))
}

/// The table's model scales friction by `tanh(50 w/(omega_I sin beta))`, this one replaces the spin in
/// the dissipation: they differ where a contact hardly spins, in case I by the order of the square of
/// 0.02, twice.
#[test]
fn table_3_2_friction_torque() {
    for case in &golden::list("rotary") {
        let name = case["case"].as_str().unwrap();
        let (ball, angles, forces) = ball(case);
        let contacts = ball.contacts(&angles, &forces);
        let first = ball.four_point().solve(&contacts);
        let state = ball.four_point().refine(&contacts, &first, 0.0, 3);
        let published = golden::number(case, "Mf");
        let error = f64::from(ball.friction_torque(&first)) / published - 1.0;
        measured::assert(&format!("Table 3.2, torque of case {name}, solved"), error);
        let torque = f64::from(ball.friction_torque(&state));
        let RotaryMotion {
            orbital_speed,
            roll,
            yaw,
        } = ball.motion(&state, INNER_SPEED);
        println!(
            "case {}: torque {:.4} against {:.4} N mm ({:+.3} %), omega_B {orbital_speed:.4} ({:+.1e}), \
             omega_x {roll:.3} ({:.3}), omega_y {yaw:.3} ({:.3})",
            case["case"],
            torque * 1e3,
            published * 1e3,
            (torque / published - 1.0) * 100.0,
            f64::from(orbital_speed) / golden::number(case, "omega_B") - 1.0,
            golden::number(case, "omega_x"),
            golden::number(case, "omega_y"),
        );
        measured::assert(
            &format!("Table 3.2, torque of case {name}, settled"),
            torque / published - 1.0,
        );
        let orbital = golden::number(case, "omega_B");
        measured::assert_at(
            "Table 3.2, orbital speed",
            f64::from(orbital_speed) / orbital - 1.0,
            format_args!("{case}"),
        );
        // Two contacts leave the rotation open (raceway control): only the loss is determined there.
        if case["case"] != "I" {
            for (found, name) in [(roll, "omega_x"), (yaw, "omega_y")] {
                let given = golden::number(case, name);
                measured::assert_at(
                    "Table 3.2, axis of rotation in rad/s",
                    f64::from(found) - given,
                    format_args!("{name} {found} {case}"),
                );
            }
        }
    }
}

#[test]
fn table_3_2_slips() {
    // Case III: every contact spins; slips and spins of eqs. (3.11)-(3.13). The table holds omega_IR
    // and omega_OR in the sense of eq. (3.14).
    let case = &golden::list("rotary")[2];
    let (ball, angles, forces) = ball(case);
    let contacts = ball.contacts(&angles, &forces);
    let state = ball.four_point().solve(&contacts);
    let motions = ball.four_point().contact_motion(&contacts, &state.motion);
    let track_speed = INNER_SPEED * 0.035;
    let spins = golden::numbers(case, "w");
    let slips = golden::numbers(case, "V");
    for ((motion, spin), slip) in motions.iter().zip(spins).zip(slips) {
        let found = f64::from(motion.spin * track_speed / 0.00625);
        measured::assert_at(
            "Table 3.2, spins in rad/s",
            found - spin,
            format_args!("{found} {spin}"),
        );
        let found = f64::from(motion.slip * track_speed);
        measured::assert_at(
            "Table 3.2, slips in m/s",
            found - slip,
            format_args!("{found} {slip}"),
        );
    }
}

#[test]
fn a_large_pitch_radius_is_a_straight_track() {
    use epas_friction::ball::LinearBallParameters;
    use epas_friction::refined::FourPointBall;
    let straight = FourPointBall::linear(&LinearBallParameters {
        ball_radius: 0.005,
        contact_angle: 0.8,
        axis_ratio: 0.23,
        semi_major_coefficient: 9e-5,
        friction: 0.1,
    })
    .unwrap();
    let circular = RotaryBall::new(&RotaryBallParameters {
        ball_radius: 0.005,
        pitch_radius: 100.0,
        contact_angle: 0.8,
        axis_ratio_inner: 0.23,
        axis_ratio_outer: 0.23,
        semi_major_coefficient_inner: 9e-5,
        semi_major_coefficient_outer: 9e-5,
        friction: 0.1,
    })
    .unwrap();
    let (angles, forces) = ([0.77, 0.82, 0.79, 0.81], [90.0, 50.0, 88.0, 51.0]);
    let first = straight.solve(&straight.contacts(&angles, &forces));
    let second = circular
        .four_point()
        .solve(&circular.contacts(&angles, &forces));
    // On the ring the inner groove moves and the outer one rests: bottom and top change places, and
    // with them the sign of the deviation.
    let swapped = straight.solve(&straight.contacts(
        &[angles[3], angles[2], angles[1], angles[0]],
        &[forces[3], forces[2], forces[1], forces[0]],
    ));
    measured::assert(
        "large pitch radius, speed deviation",
        second.speed_deviation - swapped.speed_deviation,
    );
    measured::assert(
        "large pitch radius, speed deviation",
        second.speed_deviation + first.speed_deviation,
    );
    measured::assert(
        "large pitch radius, friction force",
        second.friction_force / first.friction_force - 1.0,
    );
}

#[test]
fn a_parameter_out_of_range_is_named() {
    let good = RotaryBallParameters {
        ball_radius: 0.005,
        pitch_radius: 0.035,
        contact_angle: 0.8,
        axis_ratio_inner: 0.23,
        axis_ratio_outer: 0.23,
        semi_major_coefficient_inner: 9e-5,
        semi_major_coefficient_outer: 9e-5,
        friction: 0.1,
    };
    let with = |change: fn(&mut RotaryBallParameters)| {
        let mut parameters = good;
        change(&mut parameters);
        RotaryBall::new(&parameters).unwrap_err().field()
    };
    assert_eq!(with(|p| p.ball_radius = f32::NAN), "ball_radius");
    assert_eq!(with(|p| p.pitch_radius = 0.005), "pitch_radius");
    assert_eq!(with(|p| p.contact_angle = 2.0), "contact_angle");
    assert_eq!(with(|p| p.axis_ratio_inner = 0.0), "axis_ratio_inner");
    assert_eq!(with(|p| p.axis_ratio_outer = 1.5), "axis_ratio_outer");
    assert_eq!(
        with(|p| p.semi_major_coefficient_outer = 0.0),
        "semi_major_coefficient_outer"
    );
    assert_eq!(
        with(|p| p.semi_major_coefficient_inner = -1.0),
        "semi_major_coefficient_inner"
    );
    assert_eq!(with(|p| p.friction = 0.0), "friction");
}
