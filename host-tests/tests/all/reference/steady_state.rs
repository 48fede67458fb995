//! The exact steady state against 17-digit values, its own equations, and the closed form it leads to.

use crate::refusals::assert_refused;
use epas_reference::ReferenceError;
use epas_reference::steady_state::BallScrewState;
use epas_testkit::golden::cases;
use epas_testkit::measured;
use serde_json::Value;

fn number(case: &Value, name: &str) -> f64 {
    case[name].as_str().unwrap().parse().unwrap()
}

fn state(case: &Value) -> BallScrewState {
    BallScrewState {
        lead_angle: number(case, "alpha"),
        contact_angle: number(case, "beta"),
        friction: number(case, "f"),
        ball_radius: number(case, "r_b"),
        pitch_radius: number(case, "r_m"),
        speed: number(case, "omega"),
        axial_load: number(case, "f_a"),
        ball_density: number(case, "rho"),
    }
}

/// Both solvers stop at residuals of 1e-13 (1e-10 at worst).
#[test]
fn equals_17_digit_values() {
    for case in cases("efficiency", "exact") {
        let found = state(&case)
            .solve()
            .unwrap_or_else(|error| panic!("{case}: {error:?}"));
        let relative = |computed: f64, name: &str| (computed / number(&case, name) - 1.0).abs();
        for (computed, name) in [
            (found.efficiency, "eta"),
            (found.torque, "torque"),
            (found.normal_nut, "Q_A"),
            (found.normal_screw, "Q_B"),
            (found.normal_nut_minor, "Q_Ap"),
            (found.ball_speed[1], "omega_n"),
            (found.ball_speed[0], "omega_t"),
            (found.slip_angles[0], "psi_A"),
            (found.slip_angles[1], "psi_B"),
            (found.slip_speeds[0], "slip_A"),
            (found.slip_speeds[1], "slip_B"),
        ] {
            let error = relative(computed, name);
            measured::assert_at(&format!("steady state, {name}"), error, &case);
        }
        assert!(found.steps <= 12, "{case}: {} steps", found.steps);
    }
}

#[test]
fn below_the_limit_there_is_no_steady_state() {
    for case in cases("efficiency", "exact_no_steady_state") {
        assert!(state(&case).solve().is_err(), "{case}");
    }
}

#[test]
fn extreme_inputs_converge_or_name_the_reason() {
    let (mut solved, mut refused) = (0, 0);
    for friction in [0.0, 1e-6, 0.001, 0.075, 0.3, 0.9] {
        for speed in [1e-5, 1.0, -200.0, 1e4, 1e6] {
            for axial_load in [1e-5, 1.0, 2000.0, 1e8] {
                for lead_degrees in [0.01_f64, 5.0, 20.0, 60.0, 85.0] {
                    for contact_degrees in [1.0_f64, 45.0, 89.0] {
                        let state = BallScrewState {
                            lead_angle: lead_degrees.to_radians(),
                            contact_angle: contact_degrees.to_radians(),
                            friction,
                            ball_radius: 2e-3,
                            pitch_radius: 14.5e-3,
                            speed,
                            axial_load,
                            ball_density: 7800.0,
                        };
                        match state.solve() {
                            Ok(found) => {
                                solved += 1;
                                assert!(found.efficiency.is_finite(), "{state:?}");
                                assert!(found.efficiency < 1.0, "{state:?} {found:?}");
                            }
                            Err(error) if error.field().is_some() => panic!("{state:?}: {error}"),
                            Err(_) => refused += 1,
                        }
                    }
                }
            }
        }
    }
    println!("{solved} solved, {refused} without a steady state");
    assert!(solved > 100);
}

#[test]
fn bad_inputs_are_refused_by_name() {
    assert_refused(
        &state(&cases("efficiency", "exact")[0]),
        BallScrewState::solve,
        &[
            ("lead_angle", |s, v| s.lead_angle = v, &[-1e300]),
            ("contact_angle", |s, v| s.contact_angle = v, &[-1e300]),
            ("friction", |s, v| s.friction = v, &[-1e300]),
            ("ball_radius", |s, v| s.ball_radius = v, &[-1e300]),
            ("pitch_radius", |s, v| s.pitch_radius = v, &[-1e300]),
            ("speed", |s, v| s.speed = v, &[-1e300, 0.0]),
            ("axial_load", |s, v| s.axial_load = v, &[-1e300]),
            ("ball_density", |s, v| s.ball_density = v, &[-1e300]),
        ],
    );
}

/// From no load to 100 kN, without friction and with 0.3, at the published screw and below its existence limit.
#[test]
fn no_load_and_no_friction_are_named() {
    let case = |friction, axial_load, lead_degrees: f64| BallScrewState {
        lead_angle: lead_degrees.to_radians(),
        contact_angle: 45f64.to_radians(),
        friction,
        ball_radius: 4.37e-3,
        pitch_radius: 24.3e-3,
        speed: 200.0,
        axial_load,
        ball_density: 7800.0,
    };
    let no_load = case(0.075, 0.0, 10.0).solve().unwrap_err();
    assert_eq!(no_load.field(), Some("axial_load"));
    for axial_load in [1e-6, 1e-3, 1.0, 1e3, 1e5] {
        assert_eq!(
            case(0.0, axial_load, 10.0).solve(),
            Err(ReferenceError::Frictionless)
        );
        assert_eq!(
            case(0.3, axial_load, 10.0).solve(),
            Err(ReferenceError::NoSlip)
        );
        for (friction, lead) in [(0.075, 10.0), (0.3, 25.0)] {
            match case(friction, axial_load, lead).solve() {
                Ok(found) => assert!(
                    (0.0..1.0).contains(&found.efficiency),
                    "{axial_load} N: {found:?}"
                ),
                // A light ball at 200 rad/s is thrown off its screw: the centrifugal force passes the load.
                Err(error) => {
                    assert!(axial_load < 1.5, "{axial_load} N: {error:?}");
                }
            }
        }
    }
}
