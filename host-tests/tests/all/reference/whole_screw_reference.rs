//! Whole ball screw with recirculation: stored runs, the features of Figure 3.24, and the laws of contact.

use super::ball_screw_reference::law;
use crate::refusals::assert_refused;
use epas_reference::friction::ball_screw_closed::ThreePointModel;
use epas_reference::friction::ball_screw_elastic::BallSlip;
use epas_reference::friction::whole_screw::WholeScrew;
use epas_testkit::designs::SCREW_TRACK;
use epas_testkit::golden::{file as golden, list_of as list};
use epas_testkit::measured;
use std::f64::consts::{FRAC_PI_4, TAU};

fn screw(groove_radius: &str, theta_degrees: f64, ball_slip: BallSlip) -> WholeScrew {
    WholeScrew {
        model: ThreePointModel {
            track: SCREW_TRACK,
            screw: law("S", groove_radius),
            nut: law("N", groove_radius),
            friction: 0.1,
            contact_angle: FRAC_PI_4,
        },
        balls: 37,
        turns: 2.0,
        axial_load: -1500.0,
        nut_speed: TAU,
        deviation: theta_degrees.to_radians(),
        cycles: 2.0,
        ball_friction: 0.1,
        ball_slip,
    }
}

#[test]
fn stored_runs() {
    let all = golden("ballscrew");
    for (theta, key) in [(2.0, "theta2"), (2.5, "theta2.5")] {
        let stored = &all["whole_screw"][key];
        let [groove, between, contacts] =
            ["T_groove", "T_b2b", "ncontact"].map(|name| list(&stored[name]));
        // The stored runs take one step of 3.6 degrees of nut angle at a time, count the main contacts as groove torque, and the
        // slip between balls with the total spin.
        let run = screw("3.254", theta, BallSlip::Total)
            .simulate(2.0 * TAU, 200, 1)
            .unwrap();
        for (i, state) in run.iter().enumerate() {
            let errors = [
                state.main_torque * 1e3 / groove[i] - 1.0,
                state.ball_torque * 1e3 - between[i],
            ];
            // N mm. The stored compliances rest on a 48-point rule, 1e-6 off.
            measured::assert_at(
                "whole screw, stored groove torque",
                errors[0],
                format_args!(
                    "{key} step {i}: groove {} stored {}",
                    state.main_torque * 1e3,
                    groove[i]
                ),
            );
            measured::assert_at(
                "whole screw, stored ball torque in N mm",
                errors[1],
                format_args!(
                    "{key} step {i}: balls {} stored {}",
                    state.ball_torque * 1e3,
                    between[i]
                ),
            );
            assert_eq!(state.contacts(), contacts[i] as usize, "{key} step {i}");
        }
    }
}

#[test]
fn balls_never_overlap_and_forces_only_push() {
    for (theta, speed) in [(2.5, TAU), (-2.5, TAU), (3.0, -TAU), (3.0, 0.1)] {
        for load in [-1500.0, 1500.0] {
            let one = WholeScrew {
                nut_speed: speed,
                axial_load: load,
                ..screw("3.254", theta, BallSlip::Orbiting)
            };
            let run = one.simulate(2.0 * TAU, 150, 4).unwrap();
            for state in &run {
                // Roundings of azimuths. Measured: 2.7e-15.
                assert!(
                    state.smallest_gap > -9e-15,
                    "theta {theta}, speed {speed}, load {load}: {:e}",
                    state.smallest_gap
                );
                assert!(
                    state
                        .contact_forces
                        .iter()
                        .all(|f| *f >= 0.0 && f.is_finite())
                );
                assert!(state.ball_torque * speed >= 0.0 && state.groove_torque() * speed > 0.0);
                // Balls that press are equally fast at the end of the substep; here within the gap they still close. Measured: 1.3e-13.
                for j in 0..37 {
                    let closing = (state.speeds[j] - state.speeds[(j + 1) % 37]) * speed.signum();
                    if state.contact_forces[j] > 0.0 {
                        assert!(closing > -4e-13 * speed.abs(), "pressing balls part");
                    }
                }
            }
        }
    }
}

#[test]
fn refinement_converges() {
    // The mean ball torque over the first turn, against the step: first order in the step of the contact's closing.
    let mean = |substeps: usize| {
        let run = screw("3.254", 2.5, BallSlip::Orbiting)
            .simulate(TAU, 100, substeps)
            .unwrap();
        run.iter().map(|s| s.ball_torque).sum::<f64>() / run.len() as f64
    };
    let [coarse, middle, fine] = [1, 8, 64].map(mean);
    measured::assert("whole screw, eight steps", middle / fine - 1.0);
    measured::assert("whole screw, one step", coarse / fine - 1.0);
}

#[test]
fn bad_input_is_named() {
    let good = screw("3.254", 2.0, BallSlip::Orbiting);
    assert_refused(
        &good,
        |screw| screw.simulate(1.0, 10, 1),
        &[
            ("balls", |s, _| s.balls = 39, &[]),
            ("axial_load", |s, v| s.axial_load = v, &[0.0]),
            ("deviation", |s, v| s.deviation = v, &[]),
        ],
    );
    let still = WholeScrew {
        nut_speed: 0.0,
        ..good
    };
    assert!(still.simulate(1.0, 10, 1).is_err() && good.simulate(1.0, 0, 1).is_err());
    let even = WholeScrew {
        deviation: 0.0,
        ..good
    };
    let run = even.simulate(TAU, 20, 1).unwrap();
    assert!(run.iter().all(|s| s.ball_torque == 0.0));
}
